//! Bounds of headline numbers where they might fail: scenes built against the estimate, meshes of other programs,
//! references that this program did not make.

mod adversarial;
mod gearboxes;
mod held_out_pairs;
mod references;
mod spur_positions;
