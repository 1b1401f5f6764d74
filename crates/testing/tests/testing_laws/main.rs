//! Laws of the tests themselves: each is run, and what was left out is told.

mod left_out;
