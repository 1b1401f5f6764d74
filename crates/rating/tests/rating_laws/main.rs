//! Laws of the ratings, and numbers that standards and other programs print.

mod factors;
mod life;
mod pair;
mod rings;
mod tribology;
