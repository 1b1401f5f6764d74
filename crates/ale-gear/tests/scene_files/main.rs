//! The scene file: its keys, what is set beside it, its meshes and the way they are reduced.

mod keys;
mod measured;
mod meshes;
mod reduction_way;
mod scene;
mod settings;
#[path = "../util/mod.rs"]
mod util;
mod waves;
