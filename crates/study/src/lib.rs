//! Statistics, spectra and stability measures of computed motions.
//!
//! The statistics are for histories sampled evenly over whole mesh cycles. So a mesh harmonic has its exact amplitude,
//! without window function or leakage. For records that are not whole cycles there are spectra with windows and
//! sidebands. The crate also has Poincare sections, bifurcation diagrams, Lyapunov exponents, phase portraits and
//! Campbell diagrams of any motion; the contact pattern on a flank over mesh cycles; and accuracy against cost of the
//! ways to compute a cycle, including CalculiX ([`calculix`]).

mod between;
mod bifurcation;
pub mod calculix;
mod campbell;
mod columns;
mod correlation;
mod cycle;
mod error;
mod flank_pattern;
mod harmonics;
mod lyapunov;
mod order_tracking;
mod phase_portrait;
mod poincare;
mod power_law;
mod spectrum;
mod transform;
mod waterfall;
mod work_precision;

pub use between::Between;
pub use bifurcation::{Bifurcation, Branch, sweep_both_ways};
pub use campbell::{Campbell, Resonance, campbell};
pub use columns::{Columns, extent, mean, peak_to_peak, root_mean_square};
pub use correlation::correlation;
pub use cycle::{CycleStatistics, cycle_statistics};
pub use error::StudyError;
pub use flank_pattern::{FlankPattern, Touch};
pub use harmonics::{Harmonic, mesh_harmonics, order_amplitudes, unresolved_share};
pub use lyapunov::{Lyapunov, LyapunovPlan, largest_lyapunov};
pub use order_tracking::{CutPeak, cut_peak, order_amplitude};
pub use phase_portrait::{PhasePortrait, phase_portrait};
pub use poincare::{
    crossing_section, iterated_section, section_period, section_points, section_times, stroboscopic_section,
};
pub use power_law::{PowerLaw, power_law};
pub use spectrum::{Peak, Sidebands, Spectrum, Window, scalloping_loss, spectrum};
pub use waterfall::{MotionSpectrum, Stretches, Waterfall, WaterfallLine, waterfall};
pub use work_precision::{Answer, AnswerError, Work};
