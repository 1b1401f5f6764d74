//! The documents against the program: links, columns and keys of results, tutorials.

mod documents;
#[path = "../markdown/mod.rs"]
mod markdown;
mod notices;
mod output_lists;
mod outputs;
#[path = "../quantities/mod.rs"]
mod quantities;
mod tutorials;
#[path = "../util/mod.rs"]
mod util;
