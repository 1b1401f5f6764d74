//! Folds of a branch: where its parameter turns.

use crate::{Bifurcation, Loss, PeriodicMotion};

/// Way back of the parameter from which on a branch turns, over the scale of the parameter. Equations at phases have kinks
/// where contact is lost between two of them, and waver by less.
const TURN: f64 = 1e-3;
/// Distance from a turn, over the same scale, within which a multiplier of +1 is that of the turn.
const SAME: f64 = 1e-2;

/// Bifurcations that are listed, of those that were passed: each turn of the branch once, as the fold passed next to it;
/// multipliers of +1 far from any turn; period doublings and torus bifurcations.
///
/// Next to a turn a multiplier can pass +1 to and fro, and the tangent of the branch with it: harmonics and tangents at phases
/// set both a little apart.
pub(crate) fn listed(motions: &[PeriodicMotion], passed: Vec<Bifurcation>, scale: f64) -> Vec<Bifurcation> {
    let turns = turns(motions, &passed, TURN * scale);
    let near = |turn: &Turn, own: &Bifurcation| (own.motion.parameter - turn.parameter).abs() <= SAME * scale;
    let mut all: Vec<Bifurcation> = Vec::new();
    for turn in &turns {
        let folds = passed.iter().filter(|own| own.loss == Loss::Fold && near(turn, own));
        let nearest = folds.min_by_key(|own| own.after.abs_diff(turn.after));
        let motion = || Bifurcation { loss: Loss::Fold, motion: motions[turn.after].clone(), after: turn.after };
        all.push(nearest.cloned().unwrap_or_else(motion));
    }
    all.extend(passed.into_iter().filter(|own| own.loss != Loss::Fold || !turns.iter().any(|turn| near(turn, own))));
    all.sort_by_key(|own| own.after);
    all
}

/// A place where the parameter turns.
struct Turn {
    parameter: f64,
    /// Number of the motion at it or before it.
    after: usize,
}

/// Where the parameter turns by `back` or more.
fn turns(motions: &[PeriodicMotion], passed: &[Bifurcation], back: f64) -> Vec<Turn> {
    let at_motions = motions.iter().enumerate().map(|(after, own)| Turn { parameter: own.parameter, after });
    let at_folds = passed.iter().filter(|own| own.loss == Loss::Fold);
    let at_folds = at_folds.map(|own| Turn { parameter: own.motion.parameter, after: own.after });
    let mut places: Vec<Turn> = at_motions.chain(at_folds).collect();
    // A fold comes behind the motion before it.
    places.sort_by_key(|own| own.after);
    let mut found = Vec::new();
    let mut way = 0.0;
    let mut farthest: Option<Turn> = None;
    for place in places {
        let Some(last) = farthest.take() else {
            farthest = Some(place);
            continue;
        };
        let gone = place.parameter - last.parameter;
        if way == 0.0 || gone * way >= 0.0 {
            // The first way is known once it is longer than it may waver.
            if way != 0.0 || gone.abs() >= back {
                way = if way == 0.0 { gone.signum() } else { way };
                farthest = Some(place);
            } else {
                farthest = Some(last);
            }
        } else if gone.abs() >= back {
            way = gone.signum();
            found.push(last);
            farthest = Some(place);
        } else {
            farthest = Some(last);
        }
    }
    found
}
