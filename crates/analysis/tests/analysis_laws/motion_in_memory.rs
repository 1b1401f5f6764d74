//! A motion without a folder: rows through a sink, a stop, and on again from the state that it left.

use analysis::{
    AnalysisError, Blame, NoObserver, SinkResult,
    motion::{
        MotionAnalysis, MotionCheckpoint, MotionLayout, MotionOutcome, MotionResult, MotionRow, MotionSink,
        SweepAnalysis,
    },
};
use answer::RowStore;
use scene::{Scene, SceneBuilder};

/// A small pair from its quasi-static start on, three mesh cycles of 16 rows.
fn small() -> SceneBuilder {
    let mesher = ["pinion.mesher", "wheel.mesher"];
    let base = Scene::builder().pinion(24, 15.0).wheel(31).normal_module_mm(3.0).face_width_mm(20.0).torque_nm(300.0);
    let meshed = mesher.iter().fold(base, |scene, gear| {
        let keys = [("order", 1), ("sector_teeth", 1), ("elements_profile", 3), ("elements_thickness", 4)];
        let all = keys.iter().chain(&[("elements_face", 4), ("elements_rim", 2)]);
        all.fold(scene, |scene, (key, value)| scene.set(&format!("{gear}.{key}"), *value))
    });
    meshed
        .set("operation.speed_rpm", 3000.0)
        .set("contact.slices", 12)
        .set("analysis.kind", "dynamic")
        .set("analysis.positions_per_cycle", 8)
        .set("analysis.cycles", 3)
        .set("motion.run", "span")
        .set("motion.steps_per_mesh_cycle", 16)
        .set("motion.mesh_damping_ratio", 0.06)
}

/// Keeps what it is given; refuses the row of that number.
#[derive(Default)]
struct Kept {
    rows: Vec<MotionRow>,
    cycles: Vec<u64>,
    checkpoint: Option<MotionCheckpoint>,
    finished: bool,
    refuse: Option<usize>,
}

impl MotionSink for Kept {
    fn begin_rows(&mut self, layout: &MotionLayout, _: Option<&MotionCheckpoint>) -> SinkResult {
        assert!(layout.pairs().count() >= 3, "{layout:?}");
        Ok(())
    }

    fn row(&mut self, row: &MotionRow) -> SinkResult {
        if self.refuse == Some(self.rows.len()) {
            return Err("enough".into());
        }
        self.rows.push(row.clone());
        Ok(())
    }

    fn end_cycle(&mut self, recorded: u64) -> SinkResult {
        self.cycles.push(recorded);
        Ok(())
    }

    fn checkpoint(&mut self, state: MotionCheckpoint) -> SinkResult {
        self.checkpoint = Some(state);
        Ok(())
    }

    fn finish(&mut self) -> SinkResult {
        self.finished = true;
        Ok(())
    }
}

fn finished(outcome: MotionOutcome) -> MotionResult {
    match outcome {
        MotionOutcome::Finished(result) => *result,
        MotionOutcome::Stopped { cycles } => panic!("stopped after {cycles} cycles"),
    }
}

/// A run that stops after a mesh cycle and goes on from its state ends in the same rows and numbers, to the bit, as one
/// in one
/// piece; the sink gets each row once, in order.
#[test]
fn a_motion_in_two_pieces_is_the_one_in_one_piece() {
    let scene = small().build().unwrap();
    let mut whole = Kept::default();
    let result = finished(MotionAnalysis::new(&scene).solve_into(&mut NoObserver, &mut whole).unwrap());
    assert_eq!((whole.rows.len(), &whole.cycles[..], whole.finished), (48, &[1, 2, 3][..], true));
    assert_eq!(whole.rows, result.rows.to_vec().unwrap());
    assert!(result.facts.certificate.missed().next().is_none(), "{:?}", result.facts.certificate);

    let mut first = Kept::default();
    let stopped = MotionAnalysis::new(&scene).stop_after(Some(1)).solve_into(&mut NoObserver, &mut first).unwrap();
    assert!(matches!(stopped, MotionOutcome::Stopped { cycles: 1 }), "{stopped:?}");
    let state = first.checkpoint.expect("a stop leaves a state");
    // Through text, as a file would have it.
    let state: MotionCheckpoint = serde_json::from_str(&serde_json::to_string(&state).unwrap()).unwrap();
    assert_eq!(first.rows[..], whole.rows[..16]);

    let mut second = Kept::default();
    let analysis = MotionAnalysis::new(&scene).resume(state.clone(), RowStore::of(first.rows.clone()).unwrap());
    let resumed = finished(analysis.solve_into(&mut NoObserver, &mut second).unwrap());
    assert_eq!(second.rows[..], whole.rows[16..]);
    assert_eq!(resumed.rows.to_vec().unwrap(), whole.rows);
    assert_eq!(resumed.headline, result.headline);
    assert_eq!(resumed.spectrum, result.spectrum);
    assert_eq!(resumed.patterns, result.patterns);

    let rows = RowStore::of(first.rows[..15].to_vec()).unwrap();
    let short = MotionAnalysis::new(&scene).resume(state, rows).solve().unwrap_err();
    assert!(short.to_string().ends_with("15 rows are given, 16 came before the checkpoint"), "{short}");
}

/// A sink that refuses a row ends the analysis with what it says.
#[test]
fn a_sink_ends_a_motion() {
    let scene = small().build().unwrap();
    let mut sink = Kept { refuse: Some(5), ..Kept::default() };
    let error = MotionAnalysis::new(&scene).solve_into(&mut NoObserver, &mut sink).unwrap_err();
    assert!(matches!(&error, AnalysisError::Sink(said) if said.to_string() == "enough"), "{error}");
    assert_eq!((sink.rows.len(), sink.finished), (5, false));
}

/// A scene is refused by an analysis that is not its own, before any mesh is made.
#[test]
fn a_scene_is_refused_by_another_analysis() {
    let scene = small().build().unwrap();
    let error = SweepAnalysis::new(&scene).solve().unwrap_err();
    assert!(error.to_string().ends_with(": no sweep of reduced gears over speed"), "{error}");
    let at_rest = Scene::builder().pinion(24, 15.0).wheel(31).normal_module_mm(3.0).face_width_mm(20.0).torque_nm(1.0);
    let error = MotionAnalysis::new(&at_rest.build().unwrap()).solve().unwrap_err();
    assert!(error.to_string().ends_with(": no single motion of reduced gears"), "{error}");
    assert_eq!(error.blame(), Blame::Input);
}
