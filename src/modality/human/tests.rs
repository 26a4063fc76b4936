//! Tests of what sentences come to.
