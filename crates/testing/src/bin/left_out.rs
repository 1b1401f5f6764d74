//! Says which tests were left out for want of a program: the last line of `.ci/run`.
#![allow(clippy::print_stdout, reason = "this is what it is for")]

fn main() {
    print!("{}", testing::summary(&testing::folder()));
}
