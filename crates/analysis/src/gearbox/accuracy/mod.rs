//! Error bounds of static gearbox values, and settings that are accurate enough.
//!
//! A run is compared with others of the same gearbox: on coarser meshes, with half the slices, positions and shaft
//! elements. The error laws calibrated on random pairs are used for every mesh under its mean load and misalignment.
//! Theory, section 15.
//!
//! | file | question |
//! |---|---|
//! | `calibration` | how much of such bounds do errors fill? |
//! | `ladder` | which settings are exact enough? |
//! | `settings` | which settings are there, and which of them are the program's to choose? |
//! | `sample` | which numbers are bounded? |
//! | `pairs` | what do laws of pairs say of the meshes? |
//! | `seen` | what is seen of the error of a run, and what are its bounds? |

mod calibration;
mod ladder;
mod pairs;
mod sample;
mod seen;
mod settings;

use scene::gearbox::Gearbox;

use super::{GearboxResult, GearboxSink};
use crate::{
    AnalysisError, GearCache, Observer, SharedModels,
    accuracy::{Accuracy, Climbed, GearMemo, climb},
};
pub use calibration::{GearboxCalibration, GearboxLaw};
use ladder::GearboxLadder;

/// Solves a gearbox that asks for an accuracy, with settings from coarse to fine until the bounds keep it.
///
/// What cannot be kept with the finest is an answer all the same: [`Accuracy::is_met`] says so.
///
/// # Errors
/// [`AnalysisError`].
pub(super) fn solve_accurately(
    file: &Gearbox,
    cache: &dyn GearCache,
    observer: &mut dyn Observer,
    sink: &mut dyn GearboxSink,
) -> Result<GearboxResult, AnalysisError> {
    let kept = GearMemo::new(cache);
    let models = SharedModels::new(&kept);
    let mut ladder = GearboxLadder::new(file, &models, sink)?;
    let Climbed { solved, accuracy, tried, .. } = climb(&mut ladder, observer)?;
    Ok(GearboxResult { accuracy: Some(Accuracy { settings: tried, ..accuracy }), ..solved })
}
