//! How do the bodies move?
