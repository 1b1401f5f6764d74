//! Measured gears: files, evaluation, waves, flanks.
#![allow(clippy::print_stdout, reason = "the figures are what the tests are for")]

mod evaluating;
mod files;
mod flanks;
mod made;
mod waves;
