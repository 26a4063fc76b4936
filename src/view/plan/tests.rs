//! Plans of houses and graphs.
