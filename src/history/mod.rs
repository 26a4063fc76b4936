//! Questions about the past.
