//! Laws of the contracts: what is written reads back, and nothing else is read.

mod bytes;
mod pinned;
mod refusals;
mod ros2;
mod roundtrip;
