//! How good, how fast, how stable?
