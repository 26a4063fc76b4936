//! Laws of learning: what was put in comes out.
