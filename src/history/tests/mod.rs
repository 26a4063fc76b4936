//! Tests of this module, on small worlds.

mod arbitrary;
mod bisect;
mod diff;
mod fixture;
mod why;
