//! Computes the quantities of a station from its solved contact. Theory (34).

use contact::{
    SliceResult, Vec3, friction_work,
    line::{covered, hertz, line_pressure},
    nodal::ContactRow,
    slice_result, sliding_distance, wrenches,
};

use crate::{
    Certificate, Equilibrium, PairResult, StaticPosition, WindowedPair, line::contact_line,
    pose_steps::round_off_of_places, sensitivity::gap_rates,
};

/// Difference between the forces on the two gears, relative to the larger: action = reaction. Where rows rest on nodes
/// (points, and gears whose compliance has no table) it is that of the nodal forces, as the meshes see it.
fn action_reaction(e: &Equilibrium) -> f64 {
    let total = |body: usize| {
        let mut sum = Vec3::zeros();
        for (row, &f) in e.rows.iter().zip(&e.solution.forces) {
            let s = &row.supports[body];
            let weight = if row.is_supported() { s.weights[..s.count].iter().sum() } else { 1.0 };
            sum += f * weight * (e.poses[body].rotation * s.load);
        }
        sum
    };
    let (a, b) = (total(0), total(1));
    (a + b).amax() / a.amax().max(b.amax()).max(f64::MIN_POSITIVE)
}

/// Everything the results hold of a station.
pub(crate) fn position(windowed: &WindowedPair, e: &Equilibrium, tooth_changes: u64) -> StaticPosition {
    let WindowedPair { pair, window, options, .. } = *windowed;
    let side = options.side();
    let driven = options.driven();
    let base_radius = [pair.pinion.base_radius(), pair.wheel.base_radius()][driven];
    let wrench = wrenches(&e.poses, &e.rows, &e.solution.forces);
    // Torque is about the gear's own axis, which may be tilted.
    let torque = Vec3::from(wrench[driven].moment).dot(&(e.poses[driven].rotation * Vec3::z()));
    let rates = if options.gap_rates { gap_rates(windowed, e) } else { None };
    let mut pairs: Vec<PairResult> =
        (0..window.count()).map(|k| pair_result(windowed, e, (k, rates.as_deref()))).collect();
    // Ascending in the sense of rotation, so that a mirrored pair has the mirrored pair's table.
    pairs.sort_by_key(|p| p.pair);
    let total: f64 = pairs.iter().map(|p| p.normal_force).sum();
    let edge = pairs.first().map_or(0.0, |p| p.normal_force).max(pairs.last().map_or(0.0, |p| p.normal_force));
    let moment = options.moment(pair);
    let elastic: f64 = e.solution.forces.iter().zip(&e.solution.openings).map(|(f, o)| 0.5 * f * o).sum();
    let local: f64 = e.states.iter().map(|state| state.curved_energy).sum();
    let penalty: f64 = match options.contact.law {
        contact::complementarity::Law::Exact => 0.0,
        contact::complementarity::Law::Penalty(k) => {
            e.rows.iter().zip(&e.solution.forces).map(|(r, f)| 0.5 * f * f / (k * r.area)).sum()
        }
    };
    let tangent_stiffness = e.solution.stiffness / (base_radius * base_radius);
    let over_rows =
        |of: &dyn Fn(&ContactRow) -> f64| e.rows.iter().zip(&e.solution.forces).map(|(r, f)| f * of(r)).sum();
    let theta1 = e.station.pinion_angle(pair, options.side(), options.contact.sense);
    StaticPosition {
        pinion_angle: (e.station.cycle as f64 + e.station.phase - 0.5) * pair.pinion.pitch_angle(),
        mesh_phase: e.station.phase,
        transmission_error: e.transmission_error,
        kinematic_transmission_error: e.kinematic_transmission_error,
        secant_stiffness: if options.torque == 0.0 { f64::NAN } else { options.base_force(pair) / e.elastic_error() },
        tangent_stiffness,
        contact_line_length: pairs.iter().map(|p| p.contact_line_length).sum(),
        geometric_line_length: pair.contact_line_length(side, theta1),
        max_pressure: pairs.iter().map(|p| p.max_pressure).fold(0.0, f64::max),
        wrench,
        root_stress: Default::default(),
        root_fields: Default::default(),
        friction_work: over_rows(&|row| friction_work(pair, &options.contact, &e.poses, row)),
        sliding_work: over_rows(&|row| sliding_distance(pair, &e.poses, row)),
        strain_energy: elastic + local + penalty,
        tooth_changes,
        certificate: Certificate {
            torque_residual: if moment == 0.0 { 0.0 } else { (torque / moment - 1.0).abs() },
            complementarity_residual: e.solution.residual,
            action_reaction_residual: action_reaction(e),
            round_off_share: round_off_share(windowed, tangent_stiffness),
            pose_residual: e.pose_residual,
            iterations: e.iterations,
            bulk_compliance_error: bulk_error(windowed),
            window_edge_load: if total > 0.0 { edge / total } else { 0.0 },
        },
        pairs,
    }
}

/// Round-off of places over the approach under the load, with the stiffness (N/mm) at the solution.
fn round_off_share(windowed: &WindowedPair, tangent_stiffness: f64) -> f64 {
    let WindowedPair { pair, options, .. } = *windowed;
    if options.torque == 0.0 {
        return 0.0;
    }
    let approach = options.base_force(pair) / tangent_stiffness;
    round_off_of_places(pair.centre_distance()) / approach
}

fn bulk_error(windowed: &WindowedPair) -> f64 {
    let tables = windowed.set.slices().and_then(|s| s.bulk());
    tables.map_or(0.0, |both| both.iter().map(contact::BulkTable::error).fold(0.0, f64::max))
}

fn pair_result(windowed: &WindowedPair, e: &Equilibrium, (k, rates): (usize, Option<&[f64]>)) -> PairResult {
    let WindowedPair { pair, gears, set, window, options } = *windowed;
    let running = window.first() + k as i64;
    let [pinion_tooth, wheel_tooth] = window.teeth_of(running);
    let mine = |row: &ContactRow| set.pair_of(row.patches.0) == k;
    let loaded: Vec<(&ContactRow, f64)> =
        e.rows.iter().zip(e.solution.forces.iter().copied()).filter(|(row, f)| *f > 0.0 && mine(row)).collect();
    let line = (options.line_lengths || set.slices().is_none()).then(|| contact_line(windowed, e, k));
    let sense = options.contact.sense;
    let turned = e.station.pinion_angle(pair, options.side(), sense);
    let nominal = pair.contact_line(options.side(), turned, running - e.station.middle_pair(sense));
    let along = 1.0 / pair.base_helix_angle().cos();
    let modulus =
        hertz::effective_modulus([0, 1].map(|i| (gears[i].material().young_mpa(), gears[i].material().poisson())));
    let slices: Vec<SliceResult> = e
        .slices
        .iter()
        .zip(&e.states)
        .zip(e.rows.iter().zip(&e.solution.forces))
        .filter(|(_, (row, f))| **f > 0.0 && mine(row))
        .map(|((s, state), (row, &f))| slice_result(s, set.side(row.patches.0), f, &state.local))
        .collect();
    let pressed = slices.iter().map(|s| s.pressure).fold(0.0, f64::max);
    let max_pressure = if set.slices().is_some() {
        pressed
    } else {
        set.patch_of(0, k, options.side()).map_or(0.0, |p| {
            let patch = &set.patches()[0][p];
            line_pressure(pair, patch, &loaded, line.as_deref().unwrap_or_default(), modulus)
        })
    };
    PairResult {
        pair: sense.sign() * running,
        pinion_tooth,
        wheel_tooth,
        // 0.0 first: the sum of nothing is -0.0 otherwise.
        normal_force: loaded.iter().fold(0.0, |sum, (_, f)| sum + f),
        max_pressure,
        contact_line_length: line.map_or(f64::NAN, |line| along * covered(&line, pair.common_face())),
        geometric_line_length: nominal.map_or(0.0, |line| line.length),
        points_in_contact: loaded.len(),
        slices,
        gap_rates: rates.map_or(Vec::new(), |all| {
            let own = e.rows.iter().zip(&e.solution.forces).zip(all);
            own.filter(|((row, f), _)| **f > 0.0 && mine(row)).map(|(_, rate)| *rate).collect()
        }),
    }
}
