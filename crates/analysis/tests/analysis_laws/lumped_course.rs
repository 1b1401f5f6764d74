//! A motion of a cheaper model, cut short at a checkpoint and gone on with.

use std::sync::Arc;

use analysis::{
    AnalysisError, NoObserver, SinkResult,
    lumped::{LumpedAnalysis, LumpedCheckpoint, LumpedResult, LumpedResume, LumpedRow, LumpedSink, LumpedSoFar},
};
use scene::{Scene, SceneBuilder};

use super::{continuation::lumped8, mapped::small};

/// Keeps every checkpoint, out of its text; ends the run at the last one that it may have.
struct Kept {
    all: Vec<LumpedResume>,
    most: usize,
}

impl LumpedSink for Kept {
    fn row(&mut self, _: &LumpedRow) -> SinkResult {
        Ok(())
    }

    fn checkpoint(&mut self, state: LumpedCheckpoint, (rows, energy): LumpedSoFar<'_>) -> SinkResult {
        let checkpoint = serde_json::from_str(&serde_json::to_string(&state)?)?;
        let (rows, energy) = (Arc::new(rows.copied()?), Arc::new(energy.copied()?));
        self.all.push(LumpedResume { checkpoint, rows, energy });
        if self.all.len() == self.most { Err("killed".into()) } else { Ok(()) }
    }
}

fn solved(scene: &Scene, every: u64, from: Option<&LumpedResume>) -> LumpedResult {
    let analysis = LumpedAnalysis::new(scene).with_checkpoints(every);
    let analysis = from.map_or(analysis, |from| analysis.resume(from));
    analysis.solve().unwrap_or_else(|e| panic!("{e}"))
}

/// Models whose forces are formulas, by fixed and adaptive steps and with events, through the warm-up with its jumps to the
/// periodic state; and a map of the contact: killed at any checkpoint, a run ends in the same bits.
#[test]
fn a_model_taken_up_again_goes_the_same_way() {
    let formulas = || lumped8().set("analysis.cycles", 5).set("motion.steps_per_mesh_cycle", 32);
    let steady = |s: SceneBuilder| s.set("motion.run", "steady").set("motion.periodic_tolerance", 1e-4);
    let scenes = [
        (steady(formulas()).set("motion.warm_up_cycles", 200), 4),
        (steady(formulas()).set("motion.warm_up_cycles", 30).set("motion.error_tolerance", 1e-6), 7),
        (formulas().set("motion.run", "span").set("motion.stop_at_events", true), 2),
        (formulas().set("motion.run", "span").set("motion.method", "dormand-prince"), 2),
        (small("mapped").set("motion.warm_up_cycles", 12).set("analysis.cycles", 3), 5),
    ];
    for (i, (scene, every)) in scenes.into_iter().enumerate() {
        let scene = scene.build().unwrap_or_else(|e| panic!("{e}"));
        let whole = solved(&scene, every, None);
        let mut kept = Kept { all: Vec::new(), most: 3 };
        let analysis = LumpedAnalysis::new(&scene).with_checkpoints(every);
        match analysis.solve_into(&mut NoObserver, &mut kept) {
            Ok(_) => assert!(!kept.all.is_empty(), "{i}: no checkpoint"),
            Err(e) => assert!(matches!(e, AnalysisError::Sink(_)), "{i}: {e}"),
        }
        for from in &kept.all {
            let again = solved(&scene, every, Some(from));
            let cycle = from.checkpoint.cycle;
            assert!(
                again.rows.to_vec().unwrap() == whole.rows.to_vec().unwrap(),
                "{i}: from cycle {cycle} on rows differ"
            );
            assert!(
                again.energy.to_vec().unwrap() == whole.energy.to_vec().unwrap(),
                "{i}: from cycle {cycle} on the energy differs"
            );
            assert_eq!(again.end, whole.end, "{i}: from cycle {cycle} on");
            assert_eq!(format!("{:?}", again.headline), format!("{:?}", whole.headline), "{i}: from cycle {cycle} on");
        }
    }
}
