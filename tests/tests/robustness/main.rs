//! Scenes of chance, threads, caches, interruptions: results stand, or there is a true reason why there are none.

mod determinism;
mod found;
mod kills;
mod random_scenes;
mod starts;

use std::path::Path;

/// A binary of this crate that is `ale-gear` where its first word says so.
fn program() -> &'static Path {
    Path::new(env!("CARGO_BIN_EXE_random_scenes"))
}
