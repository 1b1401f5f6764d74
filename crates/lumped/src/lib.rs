//! The same pair with few degrees of freedom
