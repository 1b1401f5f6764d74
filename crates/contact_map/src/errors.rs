//! Comparison of a map with the contact between its samples. Theory (73), (74b).

use rayon::prelude::*;

use crate::{ContactMap, MapError, MapPlan, PhaseContact, certificate::FrictionError, map::Wanted};

/// Places at which a map is held against the contact; of flanks with friction, which turns round within a few hundredths of
/// a cycle.
const CHECKS: [usize; 2] = [64, 256];

/// How many these are.
pub(crate) fn checks(plan: &MapPlan) -> usize {
    CHECKS[usize::from(plan.half_path.is_some())]
}

/// Errors at places of a map.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Errors {
    /// Root mean square and largest error of the approach, mm.
    pub approach: [f64; 2],
    pub friction: FrictionError,
}

impl Errors {
    /// Those of places with these errors of approach and friction.
    fn of(places: &[[f64; 2]]) -> Self {
        let [approach, friction] = [0, 1].map(|k| {
            let squares = places.iter().map(|e| e[k] * e[k]).sum::<f64>() / places.len() as f64;
            [squares.sqrt(), places.iter().fold(0.0, |m: f64, e| m.max(e[k].abs()))]
        });
        Self { approach, friction: FrictionError { rms: friction[0], largest: friction[1] } }
    }

    /// The larger relative error: of the approach divided by the mean deflection, or of friction divided by the force.
    pub fn relative(&self, deflection: f64) -> f64 {
        (self.approach[0] / deflection).max(self.friction.rms)
    }
}

/// Errors at places all over the map, at places between its phases alone, between its forces alone and between its tilts
/// alone.
pub(crate) fn errors<C, E>(
    map: &ContactMap,
    plan: &MapPlan,
    at: &(impl Fn(f64) -> Result<C, E> + Sync),
    contacts: &mut usize,
) -> Result<[Errors; 4], MapError<E>>
where
    C: PhaseContact<Error = E>,
    E: Send,
{
    let mut all = [Errors::default(); 4];
    let kinds = if map.tilts == 0 { 3 } else { 4 };
    for (kind, out) in all.iter_mut().enumerate().take(kinds) {
        let off: Vec<[f64; 2]> = (0..checks(plan))
            .into_par_iter()
            .map(|i| {
                let [p, l, t] = [2, 3, 5].map(|base| halton(i + 1, base));
                let on_grid = |part: f64, n: usize| (part * n as f64).floor().max(1.0);
                // Forces as they occur: around the mean, up to twice that, seldom more.
                let places = map.loads as f64;
                let reach = map.load_axis().place((2.0 * plan.mean_force).min(plan.largest_force));
                let load = if i % 4 == 0 { l * places } else { (0.25 + 0.75 * l) * reach };
                let phase = if kind > 1 { on_grid(p, map.phases) / map.phases as f64 } else { p };
                let load = if kind == 1 || kind == 3 { on_grid(load / places, map.loads) } else { load };
                let t = if kind == 1 || kind == 2 { on_grid(t, map.tilts.max(1)) / map.tilts.max(1) as f64 } else { t };
                let tilt = map.tilts().map_or(0.0, |[low, high]| low + t * (high - low));
                error_at((map, plan), at, (phase, load, tilt))
            })
            .collect::<Result<_, MapError<E>>>()?;
        *contacts += checks(plan);
        *out = Errors::of(&off);
    }
    Ok(all)
}

/// Errors at one place: of the approach, mm, and of friction, over the force there or the mean one where that is more.
fn error_at<C, E>(
    (map, plan): (&ContactMap, &MapPlan),
    at: &(impl Fn(f64) -> Result<C, E> + Sync),
    (phase, load, tilt): (f64, f64, f64),
) -> Result<[f64; 2], MapError<E>>
where
    C: PhaseContact<Error = E>,
{
    let force = map.load_axis().force(load);
    let approach = map.approach(phase, tilt, force);
    let fail = |source| MapError::Contact { phase, approach_um: 1e3 * approach, source };
    let mut contact = at(phase).map_err(fail)?;
    let sample = contact.sample(approach, tilt).map_err(fail)?;
    let rubbing = plan.half_path.map_or(0.0, |half| {
        map.friction_error((phase, tilt, load), &sample.slices, [1.0, half, plan.width, plan.width])
            / plan.mean_force.max(force)
    });
    if sample.stiffness > 0.0 {
        return Ok([(sample.force - force) / sample.stiffness, rubbing]);
    }
    // Apart where the map presses: by the gap, and what its own force needs.
    let own = map.at(phase, approach, tilt, Wanted::default());
    Ok([contact.overlap(approach, tilt) - own.force / own.stiffness[0][0].max(f64::MIN_POSITIVE), rubbing])
}

/// Van der Corput's sequence: places that fill 0 .. 1 evenly, whatever their number.
pub(crate) fn halton(mut i: usize, base: usize) -> f64 {
    let (mut sum, mut part) = (0.0, 1.0);
    while i > 0 {
        part /= base as f64;
        sum += part * (i % base) as f64;
        i /= base;
    }
    sum
}
