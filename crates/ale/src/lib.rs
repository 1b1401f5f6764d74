//! Which teeth are in the window now, and how do coordinates carry over?
