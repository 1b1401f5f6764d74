//! Number of elements that a face width needs.

/// Least number of elements along a face.
const LEAST: u32 = 6;
/// Longest element along the face, in modules: a tooth deflects under a load over some two modules of its length.
const LENGTH_MODULES: f64 = 1.7;
/// Longest element where root stress is wanted, in modules: towards an end face the stress falls within a module.
const LENGTH_FOR_STRESS_MODULES: f64 = 1.0;

/// What the mesh must resolve along the face.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FaceResolution {
    /// Deflections and contact.
    Contact,
    /// Deflections, contact and stress in the root fillets.
    RootStress,
}

/// Number of elements along the face for this face width and normal module (both mm). It is at least six, and large
/// enough that an element is shorter than 1.7 modules, which is three quarters of a tooth's height; for root stress,
/// shorter than one module. Linear elements (`order` 1) are half as long.
///
/// The limits were measured with slices on pairs of 5, 15 and 40 modules of face width, crowned and misaligned
/// (`crates/ltca/tests/ltca_laws/width_and_crowning.rs`). Root stress was compared with CalculiX
/// (`crates/ltca/tests/ltca_laws/root_stress_calculix.rs`): with elements of 1.2 modules it is 3.2 % low, with 0.9
/// modules 0.2 %.
pub fn face_elements(face_width: f64, normal_module: f64, order: u32, resolution: FaceResolution) -> u32 {
    let modules = match resolution {
        FaceResolution::Contact => LENGTH_MODULES,
        FaceResolution::RootStress => LENGTH_FOR_STRESS_MODULES,
    };
    let longest = modules * normal_module * if order == 1 { 0.5 } else { 1.0 };
    let count = (face_width / longest).ceil();
    if count.is_finite() { (count as u32).clamp(LEAST, 2000) } else { LEAST }
}
