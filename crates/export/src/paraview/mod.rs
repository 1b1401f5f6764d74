//! Files for ParaView: meshes with fields (`.vtu`), series of them (`.pvd`), the contact pattern as a surface.

mod fields;
mod pattern_vtu;
mod pvd;
mod vtu;

pub use fields::FieldWriter;
pub use pattern_vtu::write_pattern_vtu;
pub use pvd::{PvdEntry, write_pvd};
pub use vtu::{Encoding, Field, write_surface, write_vtu};
