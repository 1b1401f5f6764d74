//! F26: friction at the pitch point.

use super::FailureMode;
use crate::{
    EnvelopeError, Figure, Shown,
    bench::{AS_IT_IS, Bench, least},
};

pub(super) const MODE: FailureMode = FailureMode {
    number: 26,
    name: "friction sign chatter",
    file: "F26-friction-sign",
    scene: scene_text!("F26-friction-sign"),
    fails: "Friction that follows a computed sliding velocity chatters where it passes zero, and may give power.",
    does: "The side of the pitch line decides, slice by slice; friction takes power at every position.",
    naive: &[],
    look,
};

/// Sliding changes its sign at the pitch line: on the loaded slices of a pair, in the order of z, once at the most.
fn most_changes_of_sign(result: &analysis::StaticResult) -> usize {
    let pitch = result.pair.working_pressure_angle().tan();
    let of_pair = |slices: &[contact::SliceResult]| {
        let side = |s: &contact::SliceResult| s.roll[0] > pitch;
        slices.windows(2).filter(|w| side(&w[0]) != side(&w[1])).count()
    };
    let pairs = result.history.positions.iter().flat_map(|p| &p.pairs);
    pairs.map(|pair| of_pair(&pair.slices)).max().unwrap_or(0)
}

/// Least work of positions where friction keeps one sign over the cycle, N mm/rad: what is found at a position, times
/// the sum of load and signed sliding over that of load and sliding.
fn least_with_one_sign(result: &analysis::StaticResult) -> f64 {
    let pitch = result.pair.working_pressure_angle().tan();
    let works = result.history.positions.iter().map(|position| {
        let slices = position.pairs.iter().flat_map(|pair| &pair.slices);
        let (signed, all) = slices.fold((0.0, 0.0), |(signed, all), s| {
            let sliding = s.line_load * (s.roll[0] - pitch);
            (signed + sliding, all + sliding.abs())
        });
        position.friction_work * signed / all
    });
    least(works)
}

fn look(bench: &Bench) -> Result<Vec<Figure>, EnvelopeError> {
    let result = bench.at_rest(&AS_IT_IS)?;
    let least_work = least(result.history.positions.iter().map(|p| p.friction_work));
    let frictionless = bench.at_rest(&["contact.friction=0"])?;
    let sliding: f64 = result.history.positions.iter().map(|p| p.friction_work).sum();
    let none: f64 = frictionless.history.positions.iter().map(|p| p.friction_work).sum();
    Ok(vec![
        Figure::new(
            "least work of friction of 32 positions, N mm/rad; naive: one sign over the cycle",
            Shown::at_least(least_work, 0.0),
        )
        .beside(Shown::at_most(least_with_one_sign(&result), -1.0)),
        Figure::new("mean work of friction, N mm/rad", Shown::at_least(sliding / 32.0, 1.0)),
        Figure::new("work without friction, N mm/rad", Shown::at_most(none.abs(), 0.0)),
        Figure::new(
            "changes of sign along a contact line, most",
            Shown::at_most(most_changes_of_sign(&result) as f64, 1.0),
        ),
        Figure::new(
            "the same: lines that cross the pitch line are among them",
            Shown::at_least(most_changes_of_sign(&result) as f64, 1.0),
        ),
    ])
}
