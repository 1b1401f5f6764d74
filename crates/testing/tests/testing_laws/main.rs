//! Laws of the tests themselves: each is run, commands in documents run something, and what was left out is told.

mod commands;
mod every_test_is_run;
mod left_out;
mod program;
