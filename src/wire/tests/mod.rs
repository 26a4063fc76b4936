//! Laws of the contracts: what is written reads back, and nothing else is read.

mod bytes;
mod refusals;
mod roundtrip;
