//! A pair that is asked many things: what is held changes no bit, and work that nobody waits for ends.

use std::sync::{
    Arc,
    atomic::{AtomicU64, Ordering},
};

use analysis::{AnalysisError, Blame, NoCache, NoSink, Observer, PhaseWork, Progress, SharedModels, StaticAnalysis};
use scene::{Scene, SceneBuilder};

fn quick() -> SceneBuilder {
    let pair = Scene::builder().pinion(24, 15.0).wheel(31).normal_module_mm(3.0).face_width_mm(20.0);
    ["pinion", "wheel"].into_iter().fold(pair.set("analysis.positions_per_cycle", 4), |all, gear| {
        all.set(&format!("{gear}.mesher.order"), 1).set(&format!("{gear}.mesher.sector_teeth"), 1)
    })
}

/// Positions, remarks and facts are those of an analysis by itself, whatever was asked before.
#[test]
fn a_held_pair_answers_as_a_new_one() {
    let models = SharedModels::new(&NoCache);
    let relieved = quick().torque_nm(200.0).set("wheel.modification.drive.lead_crowning_um", 8.0);
    for scene in [quick().torque_nm(300.0), relieved, quick().torque_nm(80.0)] {
        let scene = scene.build().unwrap();
        let held = StaticAnalysis::new(&scene).with_shared(&models).solve().unwrap();
        let alone = StaticAnalysis::new(&scene).solve().unwrap();
        assert_eq!(held.history, alone.history, "{} N m", scene.operation.torque_nm);
        let facts = |facts: &analysis::facts::RunInfo| serde_json::to_string(facts).unwrap();
        assert_eq!(facts(&held.facts), facts(&alone.facts));
    }
}

/// Gears that the caller brings take the place of those of every scene.
#[test]
fn a_held_pair_takes_meshes_of_the_caller() {
    let scene = quick().torque_nm(100.0).build().unwrap();
    let pair = scene.gear_pair().unwrap();
    let options = mesh::StructuredOptions { order: 1, extent: mesh::Extent::Periodic, ..Default::default() };
    let meshes = [&pair.pinion, &pair.wheel].map(|gear| mesh::generate(gear, &options).unwrap());
    let alone = StaticAnalysis::new(&scene).with_meshes([&meshes[0], &meshes[1]]).solve().unwrap();
    let models = SharedModels::new(&NoCache).with_meshes(meshes);
    let held = StaticAnalysis::new(&scene).with_shared(&models).solve().unwrap();
    assert_eq!(held.history.positions, alone.history.positions);
    assert_eq!(held.facts.meshes.len(), 2);
    assert!(held.facts.meshes.iter().all(|m| m.source.contains("in memory")), "{:?}", held.facts.meshes);
}

/// A model without reduced gears has nothing to hold, and says so.
#[test]
fn a_model_without_gears_is_not_reduced() {
    let scene = quick().torque_nm(100.0).set("analysis.model", "iso").build().unwrap();
    let refused = SharedModels::new(&NoCache).reduce(&scene).unwrap_err();
    assert!(refused.to_string().ends_with("this model reduces nothing") && refused.hint().is_some(), "{refused}");
    assert!(StaticAnalysis::new(&scene).with_shared(&SharedModels::new(&NoCache)).solve().is_ok());
}

/// Gives up after so many steps.
struct Impatient {
    steps: AtomicU64,
    most: u64,
}

impl Progress for Impatient {
    fn tick(&self) {
        self.steps.fetch_add(1, Ordering::Relaxed);
    }

    fn say(&self, _: String) {}

    fn is_cancelled(&self) -> bool {
        self.steps.load(Ordering::Relaxed) >= self.most
    }
}

struct Watch(Arc<Impatient>);

impl Observer for Watch {
    fn begin(&mut self, _: &str, _: PhaseWork) -> Arc<dyn Progress> {
        Arc::clone(&self.0) as Arc<dyn Progress>
    }

    fn end(&mut self) {}
}

/// Two of a thousand positions are solved when who waits gives up after two.
#[test]
fn work_that_nobody_waits_for_ends_at_the_next_step() {
    let scene = quick().torque_nm(100.0).set("analysis.positions_per_cycle", 1000).build().unwrap();
    let impatient = Arc::new(Impatient { steps: AtomicU64::new(0), most: 2 });
    let ended = StaticAnalysis::new(&scene).solve_into(&mut Watch(Arc::clone(&impatient)), &mut NoSink).unwrap_err();
    assert!(matches!(ended, AnalysisError::Cancelled), "{ended}");
    assert_eq!(impatient.steps.load(Ordering::Relaxed), 2);
    assert_eq!(ended.blame(), Blame::NoResult);
}

/// A motion that nobody waits for ends at the next step, in its quasi-static cycle and in its rows.
#[test]
fn a_motion_that_nobody_waits_for_ends_at_the_next_step() {
    let scene = quick()
        .torque_nm(100.0)
        .set("analysis.kind", "dynamic")
        .set("motion.run", "span")
        .set("motion.duration_s", 0.05)
        .set("motion.mesh_damping_ratio", 0.05)
        .build()
        .unwrap();
    // Four positions at rest come first.
    for most in [2, 6] {
        let impatient = Arc::new(Impatient { steps: AtomicU64::new(0), most });
        let mut watch = Watch(Arc::clone(&impatient));
        let analysis = analysis::motion::MotionAnalysis::new(&scene);
        let ended = analysis.solve_into(&mut watch, &mut analysis::motion::NoMotionSink).map(|_| ()).unwrap_err();
        assert!(matches!(ended, AnalysisError::Cancelled), "{ended}");
        // A step that is under way is told when it is done.
        let steps = impatient.steps.load(Ordering::Relaxed);
        assert!((most..=most + 1).contains(&steps), "{steps} steps, wanted were {most}");
    }
}
