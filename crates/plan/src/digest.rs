//! What says that two plans, or two studies, have the same cases.

use scene::{Machine, plan::Plan, study::Study};
use store::checkpoint::InputDigests;

/// What says that two plans have the same cases: scene, files that it names, axes, samples, outputs, program.
pub fn plan_digest(plan: &Plan) -> String {
    let mut hasher = blake3::Hasher::new();
    let mut take = |text: &str| {
        hasher.update(text.as_bytes());
        hasher.update(&[0]);
    };
    take(env!("CARGO_PKG_VERSION"));
    take(&plan.document.blake3());
    plan.settings.iter().for_each(|setting| take(&setting.word()));
    take(&format!("{:?} {:?} {:?} {:?}", plan.axes, plan.cases.axes(), plan.sampling, plan.outputs));
    // Files of a case may be varied as little as their names: those of the first stand for all.
    match plan.machine(0) {
        Ok(Machine::Pair(scene)) => take(&format!("{:?}", InputDigests::of(&*scene))),
        Ok(Machine::Gearbox(file)) => take(&format!("{:?}", InputDigests::of(&*file))),
        Err(_) => {}
    }
    hasher.finalize().to_hex().to_string()
}

/// What says that two studies have the same cases: scenes, files that they name, program; and whether cases have
/// reports.
pub fn study_digest(study: &Study, reports: bool) -> String {
    let mut hasher = blake3::Hasher::new();
    hasher.update(format!("{} {reports}", env!("CARGO_PKG_VERSION")).as_bytes());
    for case in &study.cases {
        let digests = InputDigests::of(&case.scene);
        // A motion that is made longer goes on from its checkpoint; a case that is done does not.
        let cycles = case.scene.analysis.cycles;
        hasher.update(format!("{} {digests:?} {cycles}\n", case.label).as_bytes());
    }
    hasher.finalize().to_hex().to_string()
}
