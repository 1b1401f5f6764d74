//! What are K and M?
