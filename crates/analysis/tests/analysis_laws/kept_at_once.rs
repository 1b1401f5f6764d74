//! A gear that takes long is kept as soon as it is made, not at the end of the run that made it.

use std::sync::Mutex;

use analysis::{AnalysisError, GearCache, NoObserver, SinkResult, StaticAnalysis, StaticSink};
use ltca::{StaticModel, StaticPosition};
use reduction::{RecordKey, ReductionRecord};
use scene::Scene;

/// Names of what was kept.
#[derive(Default)]
struct Remembers(Mutex<Vec<String>>);

impl GearCache for Remembers {
    fn is_on(&self) -> bool {
        true
    }

    fn load(
        &self,
        _: &RecordKey,
    ) -> (Option<analysis::Kept<RecordKey, ReductionRecord>>, Option<analysis::remark::Remark>) {
        (None, None)
    }

    fn save(&self, key: &RecordKey, _: &ReductionRecord) -> Option<analysis::remark::Remark> {
        self.0.lock().unwrap().push(key.to_string());
        None
    }
}

/// Ends the run at its first position.
struct Stopped;

impl StaticSink for Stopped {
    fn begin(&mut self, _: &Scene) {}

    fn position(&mut self, _: usize, _: &StaticPosition, _: &StaticModel) -> SinkResult {
        Err("the user has stopped it".into())
    }

    fn finish(&mut self) -> SinkResult {
        Ok(())
    }
}

/// Whole gears of 34 000 degrees of freedom, each by one factor: both are kept though the run ends at its first position.
#[test]
fn a_run_that_is_stopped_has_kept_its_gears() {
    let meshes = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../meshes");
    let mesh = |gear: &str| meshes.join(format!("coarse_hex8_{gear}.msh")).display().to_string();
    let scene = Scene::builder()
        .pinion(30, 20.0)
        .wheel(30)
        .normal_module_mm(3.0)
        .face_width_mm(20.0)
        .torque_nm(150.0)
        .set("pinion.bore_diameter_mm", 60.0)
        .set("wheel.bore_diameter_mm", 60.0)
        .set("pinion.thickness_allowance_mm", 0.05)
        .set("wheel.thickness_allowance_mm", 0.05)
        .set("pinion.mesh", mesh("pinion").as_str())
        .set("wheel.mesh", mesh("wheel").as_str())
        .set("analysis.reduction", "general")
        .build()
        .unwrap();
    let kept = Remembers::default();
    let ended = StaticAnalysis::new(&scene).with_cache(&kept).solve_into(&mut NoObserver, &mut Stopped);
    assert!(matches!(ended, Err(AnalysisError::Sink(_))), "{ended:?}");
    let mut names = kept.0.into_inner().unwrap();
    names.sort();
    names.dedup();
    assert_eq!(names.len(), 2, "kept of pinion and wheel: {names:?}");
}
