//! F20: the step in which flanks meet.

use super::FailureMode;
use crate::{
    EnvelopeError, Figure, Shown,
    bench::{AS_IT_IS, Bench},
};

pub(super) const MODE: FailureMode = FailureMode {
    number: 20,
    name: "overlap at first contact",
    file: "F20-step-at-impact",
    scene: scene_text!("F20-step-at-impact"),
    fails: "Flanks that fly meet within a step; the longer it is, the deeper they overlap before the contact knows, and the harder it throws them back.",
    does: "Steps follow the mesh resonance whatever rows are asked for, and may end at the moment of contact.",
    naive: &["motion.steps_per_mesh_cycle=8", "motion.steps_per_resonance=0"],
    look,
};

fn look(bench: &Bench) -> Result<Vec<Figure>, EnvelopeError> {
    let force =
        |settings: &[String]| Ok::<_, EnvelopeError>(bench.unchecked_motion(settings)?.headline.max_normal_force_n);
    let fine = force(&["motion.steps_per_mesh_cycle=256".to_owned()])?;
    let off = |f: f64| 100.0 * (f / fine - 1.0).abs();
    let usual = bench.in_motion(&AS_IT_IS)?;
    let events = force(&["motion.stop_at_events=true".to_owned()])?;
    let naive = force(&bench.naive(&[]))?;
    Ok(vec![
        Figure::new(
            "largest force against 256 steps a mesh cycle, % off",
            Shown::at_most(off(usual.headline.max_normal_force_n), 2.0),
        )
        .beside(Shown::at_least(off(naive), 5.0)),
        Figure::new("the same with steps that end at the moment of contact, % off", Shown::at_most(off(events), 2.0)),
        Figure::new(
            "losses of contact in the motion",
            Shown::at_least(usual.headline.certificate.flanks.contact_losses as f64, 1.0),
        ),
    ])
}
