//! One static scene with all degrees of freedom and reduced, on the same meshes: the savings by the reduction.

use scene::{Flanks, Kind, Scene};
use serde::Serialize;

use super::{
    MemoryGauge, Point,
    measure::measure,
    measured::{ChartTools, Measured},
    plan::{FULL_WAY, SLICE_WAY},
};
use crate::AnalysisError;

described::described! {
    /// Times of both models; units are in the names.
    #[derive(Debug, Clone, PartialEq, Serialize)]
    pub struct SpeedUp {
        /// degrees of freedom of both meshes, bores held
        pub dof: usize,
        /// degrees of freedom that the reduced pair keeps
        pub dof_kept: usize,
        /// positions of the quasi-static cycle
        pub positions_of_cycle: usize,
        /// positions that were run with every degree of freedom
        pub full_positions_run: usize,
        /// wall time of the matrices with every degree of freedom
        pub full_offline_s: f64,
        /// wall time of one position with every degree of freedom: Newton steps, each with a factorisation of the whole system
        pub full_position_s: f64,
        /// wall time of the reduction
        pub reduced_offline_s: f64,
        /// wall time of one reduced position of a further cycle on the same gears
        pub reduced_position_s: f64,
        /// ratio of the wall times of a position
        pub times_faster_position: f64,
        /// ratio of the wall times of the first cycle with everything before it; the full one is scaled from the positions run
        pub times_faster_first_cycle: f64,
        /// mean transmission error of the whole model over that of the reduced one at the same positions, minus 1
        pub relative_difference_of_ste: f64,
    }
}

/// Runs `positions` positions (at most; a divisor of those of the cycle) of the scene with all degrees of freedom, and
/// its whole quasi-static cycle reduced. Both start without cache, one after the other.
///
/// # Errors
/// The errors of the runs, and an error if the two cannot be compared.
pub fn speed_up(scene: &Scene, positions: u32, memory: &dyn MemoryGauge) -> Result<SpeedUp, AnalysisError> {
    let still = at_rest(scene);
    let run = |way| -> Result<Measured, AnalysisError> {
        measure(&Point::new(&still, way, None, positions), ChartTools { memory, scratch: None }, None)
    };
    let (reduced, full) = (run(SLICE_WAY)?, run(FULL_WAY)?);
    let error = full.answer.error_against(&reduced.answer)?;
    let (f, r) = (&full.work, &reduced.work);
    Ok(SpeedUp {
        dof: f.dof_before,
        dof_kept: r.dof_after,
        positions_of_cycle: f.positions_asked,
        full_positions_run: f.positions_run,
        full_offline_s: f.offline_s,
        full_position_s: f.position_s(),
        reduced_offline_s: r.offline_s,
        reduced_position_s: r.position_s(),
        times_faster_position: f.position_s() / r.position_s(),
        times_faster_first_cycle: f.first_cycle_s() / r.first_cycle_s(),
        relative_difference_of_ste: error.mean_ste,
    })
}

/// The pair under the same load, without motion; only the flanks that the torque presses.
fn at_rest(scene: &Scene) -> Scene {
    let mut own = scene.clone();
    own.analysis.kind = Kind::Static;
    own.contact.flanks = Flanks::Driving;
    (own.motion, own.drive, own.load, own.modes) = (None, None, None, None);
    own
}
