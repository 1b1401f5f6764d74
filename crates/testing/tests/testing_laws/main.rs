//! Laws of the tests themselves: each is run, commands in documents run something, what was left out is told, and files
//! do not import each other in a circle.

mod circles;
mod commands;
mod every_test_is_run;
mod left_out;
mod program;
