//! A static gearbox: from its file to the equilibrium of shafts, bearings and gears.
//!
//! | module | what it does |
//! |---|---|
//! | `solve` | all of it once, with the settings of the document |
//! | `accuracy` | again with finer settings, until bounds keep what is asked |
//! | `parts`, `bearings` | shafts, discs and bearings of the file |
//! | `meshes` | pairs, their reduced gears, and the contact of each mesh |
//! | `loads` | what equilibrium alone says of teeth and bearings, before any work |
//! | `checks` | what must hold |
//! | `headline` | the numbers that it is judged by |
//! | `at_rest` | its meshes at rest as a motion begins with them: stiffness, damping, springs and maps |
//! | `motion`, `moved`, `reached`, `orders`, `sink` | from rest on, in time; what that comes to, what its rows reach, orders of its meshes and waterfall; who gets rows and checkpoints |
//! | `motion_checks`, `motion_remarks` | what must hold of a motion, what is said of it |
//! | `branch` | its periodic motions over the speed, stable and unstable |
//! | `rating` | whether its meshes will hold |
//! | `root_bending` | root stress of every gear by all its meshes |
//! | `result` | what is read off all positions, and what is said of large deflections |
//! | `clearance` | what is said of parts that have no room |
//! | `inertia`, `vibration`, `swings` | how it swings about that: masses, the search, and what it finds |

mod accuracy;
mod at_rest;
mod bearings;
mod branch;
mod checks;
mod clearance;
mod headline;
mod inertia;
mod loads;
mod meshes;
mod motion;
mod motion_checks;
mod motion_remarks;
mod moved;
mod orders;
mod parts;
mod rating;
mod reached;
mod result;
mod root_bending;
mod sink;
mod solve;
mod solved_positions;
mod spectrum;
mod swings;
mod vibration;

use gearbox::motion::GearboxCheckpoint;
use scene::gearbox::Gearbox;

pub use crate::run_up::RunUpTorque;
use crate::{
    AnalysisError, SharedModels,
    context::{Context, Ending, Question},
};
use accuracy::solve_accurately;
pub use accuracy::{GearboxCalibration, GearboxLaw};
pub use bearings::{BearingLife, RollingLoad};
pub use branch::GearboxBranchResult;
use motion::Span;
pub use moved::{GearboxMotionResult, GearboxRows};
pub use orders::MotionOrder;
pub use reached::{Range, ReachedByMesh, ReachedByRows};
pub use result::{BearingLoad, GearboxResult, MeshResult, OutputResult, Rates};
pub use root_bending::RootBending;
pub use sink::GearboxSink;
use sink::NoGearboxSink;
use solve::{Asked, Slices, solve};
pub use swings::{GearFrequencies, GearboxCampbell, VibrationResult};

impl Question for Gearbox {
    type Answer = GearboxResult;
    type Sink<'s> = dyn GearboxSink + 's;
    type State = (GearboxCheckpoint, GearboxRows);

    /// What is at rest is solved again where its motion is gone on with; of a gearbox that asks for an accuracy, which has
    /// no motion, with finer settings until that is kept.
    fn answer(&self, context: Context<'_, Self>) -> Result<Ending<GearboxResult>, AnalysisError> {
        let Context { observer, cache, models, sink, from, stop_after, .. } = context;
        let own = SharedModels::new(cache);
        let models = models.unwrap_or(&own);
        let mut none = NoGearboxSink;
        let sink: &mut dyn GearboxSink = match sink {
            Some(sink) => sink,
            None => &mut none,
        };
        if !self.accuracy.is_none() {
            return solve_accurately(self, models.cache(), observer, sink).map(Ending::Finished);
        }
        let asked = Asked { file: self, models, slices: Slices::Settled };
        let (result, stopped) = solve(asked, Span { from, stop_after }, observer, sink)?;
        Ok(stopped.map_or(Ending::Finished(result), |cycles| Ending::Stopped { cycles }))
    }
}
