//! A file that is replaced as a whole, and what is refused when it is read.
//!
//! `cargo run -p files --example whole_file`
#![allow(clippy::print_stdout, reason = "an example prints")]

use std::path::Path;

use files::{most, read_regular_text, write_file};

fn main() -> std::io::Result<()> {
    let scratch = tempfile::tempdir()?;
    let file = scratch.path().join("scene.toml");
    for text in ["teeth = 30\n", "teeth = 31\n"] {
        write_file(&file, text.as_bytes())?;
    }
    println!("{}", read_regular_text(&file, most::DOCUMENT)?.trim_end());
    println!("{} entry in the folder", std::fs::read_dir(scratch.path())?.count());
    for path in [scratch.path(), Path::new("/dev/zero")] {
        if let Err(refused) = read_regular_text(path, most::DOCUMENT) {
            println!("refused: {refused}");
        }
    }
    Ok(())
}
