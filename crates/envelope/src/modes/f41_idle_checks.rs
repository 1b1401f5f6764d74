//! F41: checks that cannot fail.

use analysis::static_certificate;
use ltca::{Certificate, StaticPosition};

use super::FailureMode;
use crate::{
    EnvelopeError, Figure, Shown,
    bench::{AS_IT_IS, Bench},
};

pub(super) const MODE: FailureMode = FailureMode {
    number: 41,
    name: "checks that cannot fail",
    file: "F41-idle-checks",
    scene: scene_text!("F41-idle-checks"),
    fails: "A number is compared with itself, a maximum begins at 0 and loses what is not a number, a bound is beyond all numbers: the check passes whatever the program does.",
    does: "Each check is seen failing: a result is spoilt, one measure at a time, and its certificate must say so.",
    naive: &[],
    look,
};

/// A measure of a position.
type Measure = fn(&mut Certificate) -> &mut f64;

const MEASURES: [Measure; 5] = [
    |c| &mut c.torque_residual,
    |c| &mut c.complementarity_residual,
    |c| &mut c.action_reaction_residual,
    |c| &mut c.round_off_share,
    |c| &mut c.pose_residual,
];
/// What they are spoilt with.
const SPOILT: [f64; 3] = [0.1, f64::INFINITY, f64::NAN];

/// Largest measure of positions as it is often written: what is no number is passed over.
fn largest_but_nan(positions: &[StaticPosition], measure: Measure) -> f64 {
    positions.iter().map(|p| *measure(&mut { p.certificate })).fold(0.0, f64::max)
}

fn look(bench: &Bench) -> Result<Vec<Figure>, EnvelopeError> {
    let (scene, sound) = (bench.scene(&AS_IT_IS)?, bench.at_rest(&AS_IT_IS)?.history.positions);
    let bound = 0.05;
    let (mut unseen, mut naive) = (0, 0);
    for measure in MEASURES {
        for value in SPOILT {
            let mut spoilt = sound.clone();
            // Neither the first position nor the last: a comparison by pairs may lose one in the middle.
            let middle = spoilt.len() / 2;
            *measure(&mut spoilt[middle].certificate) = value;
            unseen += usize::from(static_certificate(&scene, &spoilt).missed().count() != 1);
            naive += usize::from(largest_but_nan(&spoilt, measure) <= bound);
        }
    }
    Ok(vec![
        Figure::new(
            "spoilt results, of fifteen, that their certificate does not see, or sees for another reason; naive: maxima from 0 on",
            Shown::at_most(unseen as f64, 0.0),
        )
        .beside(Shown::at_least(naive as f64, 5.0)),
        Figure::new(
            "checks that the sound result misses",
            Shown::at_most(static_certificate(&scene, &sound).missed().count() as f64, 0.0),
        ),
    ])
}
