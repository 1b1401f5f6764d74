//! Loaded tooth contact analysis: quasi-static equilibrium of a gear pair over the mesh cycle.
//!
//! The driver is at a given angle; the driven gear rotates until the contact forces balance its torque. This is solved
//! station by station over mesh cycles, with tooth changes in between.

mod cycle;
mod cycle_solver;
mod deflection_course;
mod equilibrium;
mod error;
mod face_load;
mod flank_gap;
mod kinematic;
mod line;
mod load_sharing;
mod loads;
mod nominal_lines;
mod options;
mod pose_solver;
mod pose_steps;
mod result;
mod root_stress;
mod sensitivity;
mod slice_count;
mod statics;
mod windowed_pair;

pub use deflection_course::DeflectionCourse;
pub use equilibrium::{Equilibrium, GUESSED_LINE_STIFFNESS};
pub use error::StaticError;
pub use face_load::{envelope as load_envelope, face_load_factor};
pub use kinematic::{ForeseenWindow, kinematic_transmission_error};
pub use load_sharing::{face_load_factor_of, load_sharing_ratio, transverse_load_factor};
pub use nominal_lines::NominalLines;
pub use options::StaticOptions;
pub use pose_steps::round_off_of_places;
pub use result::{Certificate, LoadCycle, PairResult, StaticHistory, StaticPosition, ToothChange, ToothChangeRecord};
pub use root_stress::{
    FilletField, FilletPlace, FilletStress, ROOT_STRESS_DEFINITION, ROOT_STRESS_RECOVERY, RootPattern, RootStress,
    StressPeak,
};
pub use sensitivity::{PositionRates, Sensitivities, Sensitivity, Variation};
pub use slice_count::{SliceCount, SpringErrors, slice_errors, slices_needed, slices_needed_on};
pub use statics::StaticModel;
pub use windowed_pair::WindowedPair;
