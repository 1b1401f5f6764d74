//! Values computed from a solved history before it is written: numbers of pairs in the mesh cycle, contact patterns,
//! position of the largest pressure, largest root stresses, headline of a static run. No files here.

pub mod pairs;
mod pattern;
mod pressure_place;
mod root_stress;
mod static_headline;
mod tooth_change;

pub use ltca::{face_load_factor_of as face_load_factor, load_sharing_ratio, transverse_load_factor};
pub(crate) use pattern::pressed;
pub use pattern::{GearPattern, diameter, on_flank, patterns, touch, untouched};
pub use pressure_place::{PressurePlace, PressureSpot, base_radius_mm, place_values};
pub(crate) use root_stress::{DOUBTFUL_PERCENT, mesh_roots, mesh_tensions};
pub use root_stress::{
    GearRootStress, MAX_PRINCIPAL, MIN_PRINCIPAL, Measure, Place, RootStressHeadline, VON_MISES, error_percent,
    fillet_peaks, largest_tensions, root_stress_headline, root_stress_remarks,
};
pub use static_headline::{StaticHeadline, static_headline};
pub use tooth_change::ToothChangeHeadline;
