//! Modified, crowned and misaligned flanks, unloaded and loaded.

mod crowning;
mod harris_map;
mod kinematic;
mod modified;
mod scale;
mod sensitivity;
mod width_and_crowning;
