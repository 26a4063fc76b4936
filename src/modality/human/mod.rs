//! Human language: what people say has changed.

mod reading;

pub use reading::{Mention, Quantity, Reading, Statement, When};
