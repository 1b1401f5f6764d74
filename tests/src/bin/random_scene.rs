//! The scene of a random pair, as a file.
//!
//! `cargo run --release -p verification --bin random_scene -- SEED INDEX > pair.toml`
#![allow(clippy::print_stdout, reason = "the scene is what it is for")]

use std::error::Error;

use verification::random_scene::random_scene;

fn main() -> Result<(), Box<dyn Error>> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let [seed, index] = &words[..] else { return Err("SEED INDEX are wanted".into()) };
    print!("{}", random_scene(seed.parse()?, index.parse()?).to_toml());
    Ok(())
}
