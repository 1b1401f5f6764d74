//! Companion of a run for comparison: the same pair on another mesh, at a part of the positions.

use scene::{Method, Model, Reduction, Scene};

use super::{CalibratedMesh, Calibration, Rung, Sample, SolvedCycle};
use crate::{AnalysisError, GearCache, StaticResult, reduced, statics::CycleAnalysis};

/// Positions of a cycle at which a run is held against another one, at least.
const LEAST_POSITIONS: u32 = 8;
/// Rung whose meshes stand beside others, and that beside itself and coarser ones.
const BESIDE: Rung = Rung::ALL[1];
const BESIDE_COARSE: Rung = Rung::ALL[2];
/// Where a run stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Standing {
    /// Slices on a mesh, of a scene like those of the calibration: its laws say how large the errors are.
    Calibrated(CalibratedMesh),
    /// On meshes that anybody made, or without any, or of a scene unlike those: a rung of the ladder goes along.
    Beside(Rung),
}

impl Standing {
    /// `covered` tells whether the scene is similar to those of the calibration.
    pub fn of(scene: &Scene, covered: bool) -> Self {
        let sliced = scene.analysis.model == Model::Reduced && scene.contact.method == Method::Slice;
        let mesh = CalibratedMesh::of(scene).filter(|mesh| sliced && Calibration::committed().knows(*mesh));
        match mesh {
            Some(mesh) if covered => Self::Calibrated(mesh),
            Some(CalibratedMesh::Rung(n)) if n <= BESIDE.elements_profile => Self::Beside(BESIDE_COARSE),
            _ => Self::Beside(BESIDE),
        }
    }

    /// The mesh whose laws are used.
    pub fn mesh(self) -> CalibratedMesh {
        match self {
            Self::Calibrated(mesh) => mesh,
            Self::Beside(rung) => CalibratedMesh::Rung(rung.elements_profile),
        }
    }

    /// Text that describes the companion.
    pub fn words(self) -> String {
        match self {
            Self::Calibrated(mesh) => format!("random pairs on {}", mesh.words()),
            Self::Beside(_) => format!("{} of the built-in mesher", self.mesh().words()),
        }
    }
}

/// Every so manieth position of a run at which it is held against another one.
pub(crate) fn stride(positions: u32) -> u32 {
    let fits = |s: &u32| positions.is_multiple_of(*s) && positions / s >= LEAST_POSITIONS;
    [8, 4, 2].into_iter().find(fits).unwrap_or(1)
}

/// Samples of the companion of a run.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Companion {
    /// At the slices of the run.
    pub sample: Sample,
    /// At half of them.
    pub fewer_slices: Sample,
}

/// The last companion, for runs that differ in their positions alone.
#[derive(Debug, Default)]
pub(crate) struct Companions(Option<(Scene, Companion)>);

impl Companions {
    /// The companion of a run; it is solved if the last companion belongs to another scene.
    ///
    /// # Errors
    /// [`AnalysisError`].
    pub fn of(
        &mut self,
        (scene, rung): (&Scene, Rung),
        result: &StaticResult,
        cache: &dyn GearCache,
    ) -> Result<Companion, AnalysisError> {
        let scene = companion_scene(scene, rung, result);
        if let Some((_, companion)) = self.0.as_ref().filter(|(of, _)| *of == scene) {
            return Ok(*companion);
        }
        let companion = Companion::solve(&scene, cache)?;
        self.0 = Some((scene, companion));
        Ok(companion)
    }
}

impl Companion {
    fn solve(scene: &Scene, cache: &dyn GearCache) -> Result<Self, AnalysisError> {
        let solved = SolvedCycle::new(scene, cache)?;
        let sample = solved.sample(1)?;
        let slices = scene.contact.slices.unwrap_or(2).max(2);
        let fewer = solved.again(slices / 2, scene.analysis.positions_per_cycle)?;
        Ok(Self { sample, fewer_slices: fewer.sample(1)? })
    }
}

fn companion_scene(scene: &Scene, rung: Rung, result: &StaticResult) -> Scene {
    let mut own = scene.clone();
    for (i, gear) in [&mut own.pinion, &mut own.wheel].into_iter().enumerate() {
        let mesher = Rung::ALL[0].mesher(scene);
        let mut mesher = gear.mesher.unwrap_or(mesher);
        // A mesh of some teeth with free cuts is held against as many.
        if let Some(meshed) = result.model.as_ref().and_then(|m| reduced(&m.gears()[i])) {
            let teeth = meshed.gear().teeth().len() as u32;
            let open = !meshed.is_cyclic() && teeth < meshed.gear().tooth_count();
            mesher.sector_teeth = if open { teeth } else { 0 };
        }
        gear.mesher = Some(mesher);
    }
    let mut own = rung.scene(&own);
    // It is never rated.
    own.rating = None;
    own.analysis.model = Model::Reduced;
    own.analysis.reduction = Some(Reduction::Auto);
    own.analysis.positions_per_cycle /= stride(own.analysis.positions_per_cycle);
    if own.contact.slices.is_none() {
        own.contact.method = Method::Slice;
        (own.contact.gap, own.contact.points_per_face_edge) = (None, None);
        own.contact.penalty_mpa_per_mm = None;
        own.contact.corner_contact = Some(true);
        own.contact.slices = Some(LEAST_SLICES);
        own.contact.slices = CycleAnalysis::new(&own).slices();
    }
    own
}

/// Slices of a pair that asks for no more.
const LEAST_SLICES: u32 = 32;
