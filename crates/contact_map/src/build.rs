//! Makes a map from samples, which are refined until the map agrees with the contact between them. Theory (73).

use std::{
    collections::BTreeMap,
    sync::atomic::{AtomicUsize, Ordering},
};

use rayon::prelude::*;

use crate::{
    ContactMap, MapError, MapPlan, PhaseContact,
    certificate::MapCertificate,
    column::{Node, column},
    damping_table::DampingTable,
    errors::{checks, errors},
    friction_table::FrictionTable,
    load_axis::LoadAxis,
    pair_shares::PairShares,
    spline::Axis,
};

/// Progress of a map: contacts solved so far, and the approximate number needed before the map is next compared with
/// the contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct MapWork {
    /// Number of contacts solved.
    pub contacts: usize,
    /// Approximate number of contacts for the map in its present size; it grows if a check finds the map too coarse.
    pub of_contacts: usize,
}

/// Receives the progress of a map; any thread may call it.
pub type MapWatch<'a> = &'a (dyn Fn(MapWork) + Sync);

/// Phases of a mesh cycle, forces and tilts (in intervals) of the first map, and most of them.
const PHASES: [usize; 2] = [32, 1024];
const LOADS: [usize; 2] = [12, 96];
const TILTS: [usize; 2] = [6, 12];
const SHARES: usize = 16;
/// Contacts that a map may take for what lies between the error aimed at and the worst: some hundred mesh cycles at rest.
const FEW_CONTACTS: usize = 10_000;
/// Contacts that it may take at all.
const MOST_CONTACTS: usize = 200_000;

/// All nodes of a map, by phase as a fraction of [`PHASES`]'s largest.
type Columns = BTreeMap<usize, Vec<Vec<Node>>>;

impl ContactMap {
    /// Makes a map of the contact that `at` gives at a phase of the mesh cycle (0 .. 1); `watch` receives its progress.
    ///
    /// The number of phases, forces or tilts is doubled, whichever causes the largest error, until the check at random
    /// positions is within the tolerance, or until a finer map would cost too much.
    ///
    /// # Errors
    /// [`MapError`] if no map is accurate enough.
    pub fn build<C, E>(
        plan: &MapPlan,
        watch: MapWatch<'_>,
        at: impl Fn(f64) -> Result<C, E> + Sync,
    ) -> Result<Self, MapError<E>>
    where
        C: PhaseContact<Error = E>,
        E: Send,
    {
        check_plan(plan)?;
        let mut size =
            MapSize { phases: PHASES[0], loads: LOADS[0], tilts: if plan.tilt.is_some() { TILTS[0] } else { 0 } };
        let (mut columns, mut contacts) = (Columns::new(), 0);
        loop {
            contacts += sample(&mut columns, plan, (&at, size), (watch, contacts))?;
            let mut map = assemble(plan, &columns, size);
            let [all, along @ ..] = errors(&map, plan, &at, &mut contacts)?;
            let deflection = deflection(&map, plan);
            map.certificate = MapCertificate {
                contacts,
                checks: checks(plan),
                rms_error_mm: all.approach[0],
                largest_error_mm: all.approach[1],
                deflection_mm: deflection,
                friction: map.friction.is_some().then_some(all.friction),
                ..map.certificate
            };
            let along = along.map(|own| own.relative(deflection));
            let error = all.relative(deflection);
            if error <= plan.tolerance {
                return Ok(map);
            }
            let good = error <= plan.worst;
            let most = if good { FEW_CONTACTS } else { MOST_CONTACTS };
            let Some(finer) = size.finer(along).filter(|finer| finer.contacts() <= most) else {
                let coarse = MapError::Coarse { phases: size.phases, loads: size.loads, error, allowed: plan.worst };
                return if good { Ok(map) } else { Err(coarse) };
            };
            if (finer.loads, finer.tilts) != (size.loads, size.tilts) {
                columns.clear();
            }
            size = finer;
        }
    }
}

/// Intervals of a map.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct MapSize {
    phases: usize,
    loads: usize,
    /// 0: no tilt.
    tilts: usize,
}

impl MapSize {
    /// Contacts that a map takes, about.
    fn contacts(self) -> usize {
        2 * self.phases * self.loads * (self.tilts + 1)
    }

    /// Twice as many where the error is largest and more are allowed; errors along phases, loads and tilts.
    fn finer(self, errors: [f64; 3]) -> Option<Self> {
        let ways = [
            (errors[0], self.phases < PHASES[1], Self { phases: 2 * self.phases, ..self }),
            (errors[1], self.loads < LOADS[1], Self { loads: 2 * self.loads, ..self }),
            (errors[2], (1..TILTS[1]).contains(&self.tilts), Self { tilts: 2 * self.tilts, ..self }),
        ];
        ways.into_iter().filter(|way| way.1).max_by(|a, b| a.0.total_cmp(&b.0)).map(|way| way.2)
    }
}

fn check_plan<E>(plan: &MapPlan) -> Result<(), MapError<E>> {
    let positive = [
        ("mean force [N]", plan.mean_force),
        ("largest force [N]", plan.largest_force),
        ("width of face [mm]", plan.width),
        ("tolerance of the contact map", plan.tolerance),
        ("worst error of the contact map", plan.worst),
        ("half of the path of contact [mm]", plan.half_path.unwrap_or(1.0)),
    ];
    for (name, value) in positive {
        if !(value.is_finite() && value > 0.0) {
            return Err(MapError::OutOfRange { name, value, expected: "a number > 0" });
        }
    }
    match plan.tilt {
        Some([low, high]) if !(low.is_finite() && high.is_finite() && low < high) => {
            Err(MapError::OutOfRange { name: "largest tilt [rad]", value: high, expected: "above the least one" })
        }
        _ => Ok(()),
    }
}

fn tilts(plan: &MapPlan, count: usize) -> Vec<f64> {
    match plan.tilt {
        None => vec![0.0],
        Some([low, high]) => (0..=count).map(|i| low + (high - low) * i as f64 / count as f64).collect(),
    }
}

/// Samples the phases that are not there yet; gives how many contacts that took. `watch` hears of each phase, with the
/// contacts before.
fn sample<C, E>(
    columns: &mut Columns,
    plan: &MapPlan,
    (at, size): (&(impl Fn(f64) -> Result<C, E> + Sync), MapSize),
    (watch, before): (MapWatch<'_>, usize),
) -> Result<usize, MapError<E>>
where
    C: PhaseContact<Error = E>,
    E: Send,
{
    let step = PHASES[1] / size.phases;
    let missing: Vec<usize> = (0..size.phases).map(|i| i * step).filter(|key| !columns.contains_key(key)).collect();
    let axis = LoadAxis::new(size.loads, plan.largest_force);
    let (done, phases) = (AtomicUsize::new(0), AtomicUsize::new(0));
    let heard = |count: usize| {
        let contacts = done.fetch_add(count, Ordering::Relaxed) + count;
        let sampled = phases.fetch_add(1, Ordering::Relaxed) + 1;
        let all = contacts * missing.len() / sampled;
        watch(MapWork { contacts: before + contacts, of_contacts: before + all });
    };
    let sampled: Vec<_> = missing
        .par_iter()
        .map(|&key| {
            let phase = key as f64 / PHASES[1] as f64;
            let mut contact = at(phase).map_err(|source| MapError::Contact { phase, approach_um: 0.0, source })?;
            let mut solved = 0;
            let mut all = Vec::new();
            for tilt in tilts(plan, size.tilts) {
                let (nodes, count) = column(&mut contact, (phase, tilt), (axis, SHARES), plan.width)?;
                all.push(nodes);
                solved += count;
            }
            heard(solved);
            Ok((key, all, solved))
        })
        .collect::<Result<_, MapError<E>>>()?;
    let mut solved = 0;
    for (key, nodes, count) in sampled {
        columns.insert(key, nodes);
        solved += count;
    }
    Ok(solved)
}

/// The map that goes through all nodes.
fn assemble(plan: &MapPlan, columns: &Columns, size: MapSize) -> ContactMap {
    let MapSize { phases, loads, tilts } = size;
    let step = PHASES[1] / phases;
    let tilt_axis = if tilts == 0 { Axis::Single } else { Axis::Open(tilts) };
    let axes = [Axis::Periodic(phases), tilt_axis, Axis::Open(loads)];
    let of = |value: &dyn Fn(&Node) -> f64| {
        let values: Vec<f64> = (0..phases).flat_map(|i| columns[&(i * step)].iter().flatten().map(value)).collect();
        coefficients(values, &axes)
    };
    let lengths: [Vec<f64>; 3] = [0, 1, 2].map(|k| of(&|node: &Node| node.lengths[k]));
    // Where a damper is held to the force hardly depends on the tilt: the middle one serves.
    let shares: Vec<f64> = (0..phases)
        .flat_map(|i| columns[&(i * step)][tilts / 2].iter().flat_map(|node| node.shares.iter().copied()))
        .collect();
    let nodes: Vec<_> = (0..phases).map(|i| &columns[&(i * step)]).collect();
    let of_way = |values: Vec<f64>| coefficients(values, &[axes[1], axes[2]]);
    ContactMap {
        phases,
        loads,
        tilts,
        pairs: PairShares::new(&nodes, |node, i| node.parts[i].1, of_way),
        friction: plan.half_path.map(|_| FrictionTable::new(&nodes, of_way)),
        force: plan.largest_force,
        tilt: plan.tilt.unwrap_or([0.0, 1.0]),
        approach: of(&|node: &Node| node.approach),
        damping: DampingTable {
            lengths,
            share: coefficients(shares, &[axes[0], axes[2], Axis::Open(SHARES)]),
            shares: SHARES,
        },
        certificate: MapCertificate {
            phases,
            loads: loads + 1,
            tilts: tilt_axis.places(),
            contacts: 0,
            checks: 0,
            rms_error_mm: f64::NAN,
            largest_error_mm: f64::NAN,
            deflection_mm: f64::NAN,
            friction: None,
        },
    }
}

/// Coefficients of the tensor product of splines through values, the last axis running fastest.
fn coefficients(mut values: Vec<f64>, axes: &[Axis]) -> Vec<f64> {
    let mut shape: Vec<usize> = axes.iter().map(|a| a.places()).collect();
    for (k, axis) in axes.iter().enumerate() {
        // All axes have as many places as a map is made with, so there is always an interpolation.
        let Some(matrix) = axis.interpolation() else { return Vec::new() };
        let inner: usize = shape[k + 1..].iter().product();
        let outer: usize = shape[..k].iter().product();
        let (n, m) = (shape[k], axis.coefficients());
        let mut next = vec![0.0; outer * m * inner];
        for o in 0..outer {
            for c in 0..m {
                for p in 0..n {
                    let weight = matrix[(c, p)];
                    for i in 0..inner {
                        next[(o * m + c) * inner + i] += weight * values[(o * n + p) * inner + i];
                    }
                }
            }
        }
        values = next;
        shape[k] = m;
    }
    values
}

/// Mean approach from first touch under the mean force, mm.
fn deflection(map: &ContactMap, plan: &MapPlan) -> f64 {
    let tilt = map.tilt.iter().sum::<f64>() * if map.tilts == 0 { 0.0 } else { 0.5 };
    let of = |i: usize| {
        let phase = i as f64 / map.phases as f64;
        map.approach(phase, tilt, plan.mean_force) - map.approach(phase, tilt, 0.0)
    };
    (0..map.phases).map(of).sum::<f64>() / map.phases as f64
}
