//! Tests of this module, on small worlds.

mod arbitrary;
mod diff;
mod fixture;
mod why;
