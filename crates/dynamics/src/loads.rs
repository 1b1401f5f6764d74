//! From a solved contact to the quantities of a station. Theory (34).

use contact::{ContactRow, Pose, Slice, Vec3, covered, hertz};
use geometry::Side;

use crate::{
    Certificate, Equilibrium, PairResult, Site, SliceResult, StaticPosition, Wrench, friction,
    line::{contact_line, line_pressure},
    parts::Parts,
};

/// Forces and moments on both gears, about their own centres, common axes.
pub(crate) fn wrenches(poses: &[Pose; 2], rows: &[ContactRow], forces: &[f64]) -> [Wrench; 2] {
    let centres = poses.map(|p| p.translation.vector);
    [0, 1].map(|i| {
        let sign = if i == 0 { 1.0 } else { -1.0 };
        let (mut force, mut moment) = (Vec3::zeros(), Vec3::zeros());
        for (row, &f) in rows.iter().zip(forces).filter(|(_, f)| **f != 0.0) {
            let f = sign * f * row.traction;
            force += f;
            moment += (row.position - centres[i]).cross(&f);
        }
        Wrench { force: force.into(), moment: moment.into() }
    })
}

/// Difference between the nodal forces on the two gears, relative to the larger: action = reaction as the meshes see it.
fn action_reaction(e: &Equilibrium) -> f64 {
    let total = |body: usize| {
        let mut sum = Vec3::zeros();
        for (row, &f) in e.rows.iter().zip(&e.solution.forces) {
            let s = &row.supports[body];
            let weight: f64 = s.weights[..s.count].iter().sum();
            sum += f * weight * (e.poses[body].rotation * s.load);
        }
        sum
    };
    let (a, b) = (total(0), total(1));
    (a + b).amax() / a.amax().max(b.amax()).max(f64::MIN_POSITIVE)
}

/// Everything the results hold of a station.
pub(crate) fn position(parts: &Parts, e: &Equilibrium, tooth_changes: u64) -> StaticPosition {
    let Parts { pair, window, options, .. } = *parts;
    let side = options.side();
    let driven = options.driven();
    let base_radius = [pair.pinion.base_radius(), pair.wheel.base_radius()][driven];
    let wrench = wrenches(&e.poses, &e.rows, &e.solution.forces);
    // Torque is about the gear's own axis, which may be tilted.
    let torque = Vec3::from(wrench[driven].moment).dot(&(e.poses[driven].rotation * Vec3::z()));
    let mut pairs: Vec<PairResult> = (0..window.count()).map(|k| pair_result(parts, e, k)).collect();
    // Ascending in the sense of rotation, so that a mirrored pair has the mirrored pair's table.
    pairs.sort_by_key(|p| p.pair);
    let total: f64 = pairs.iter().map(|p| p.normal_force).sum();
    let edge = pairs.first().map_or(0.0, |p| p.normal_force).max(pairs.last().map_or(0.0, |p| p.normal_force));
    let moment = -side.sign() * options.torque;
    let elastic: f64 = e.solution.forces.iter().zip(&e.solution.openings).map(|(f, o)| 0.5 * f * o).sum();
    let local: f64 = e.slices.iter().zip(&e.solution.forces).map(|(s, &f)| local_energy(s, f)).sum();
    let penalty: f64 = match options.law {
        contact::Law::Exact => 0.0,
        contact::Law::Penalty(k) => {
            e.rows.iter().zip(&e.solution.forces).map(|(r, f)| 0.5 * f * f / (k * r.area)).sum()
        }
    };
    let friction_work =
        e.rows.iter().zip(&e.solution.forces).map(|(row, f)| f * friction::work(pair, options, &e.poses, row)).sum();
    let theta1 = e.station.pinion_angle(pair, options);
    StaticPosition {
        pinion_angle: (e.station.cycle as f64 + e.station.phase - 0.5) * pair.pinion.pitch_angle(),
        mesh_phase: e.station.phase,
        transmission_error: e.transmission_error,
        kinematic_transmission_error: e.kinematic_transmission_error,
        secant_stiffness: if options.torque == 0.0 {
            f64::NAN
        } else {
            options.torque / base_radius / e.elastic_error()
        },
        tangent_stiffness: e.solution.stiffness / (base_radius * base_radius),
        contact_line_length: pairs.iter().map(|p| p.contact_line_length).sum(),
        geometric_line_length: pair.contact_line_length(side, theta1),
        max_pressure: pairs.iter().map(|p| p.max_pressure).fold(0.0, f64::max),
        wrench,
        root_stress: Default::default(),
        friction_work,
        strain_energy: elastic + local + penalty,
        tooth_changes,
        certificate: Certificate {
            torque_residual: if moment == 0.0 { 0.0 } else { (torque / moment - 1.0).abs() },
            complementarity_residual: e.solution.residual,
            action_reaction_residual: action_reaction(e),
            iterations: e.iterations,
            bulk_compliance_error: bulk_error(parts),
            window_edge_load: if total > 0.0 { edge / total } else { 0.0 },
        },
        pairs,
    }
}

fn bulk_error(parts: &Parts) -> f64 {
    let tables = parts.set.slices().and_then(|s| s.bulk());
    tables.map_or(0.0, |both| both.iter().map(contact::BulkTable::error).fold(0.0, f64::max))
}

fn pair_result(parts: &Parts, e: &Equilibrium, k: usize) -> PairResult {
    let Parts { pair, gears, set, window, options } = *parts;
    let running = window.first() + k as i64;
    let [pinion_tooth, wheel_tooth] = window.teeth_of(running);
    let mine = |row: &ContactRow| set.pair_of(row.patches.0) == k;
    let loaded: Vec<(&ContactRow, f64)> =
        e.rows.iter().zip(e.solution.forces.iter().copied()).filter(|(row, f)| *f > 0.0 && mine(row)).collect();
    let line = contact_line(parts, e, k);
    let along = 1.0 / pair.base_helix_angle().cos();
    let half = 0.5 * pair.face_width();
    let modulus =
        hertz::effective_modulus([0, 1].map(|i| (gears[i].material().young_mpa(), gears[i].material().poisson())));
    let slices: Vec<SliceResult> = e
        .slices
        .iter()
        .zip(e.rows.iter().zip(&e.solution.forces))
        .filter(|(_, (row, f))| **f > 0.0 && mine(row))
        .map(|(s, (row, &f))| slice_result(s, set.side(row.patches.0), f))
        .collect();
    let pressed = slices.iter().map(|s| s.pressure).fold(0.0, f64::max);
    let max_pressure = if set.slices().is_some() {
        pressed
    } else {
        set.patch_of(0, k, options.side()).map_or(0.0, |p| {
            let patch = &set.patches()[0][p];
            line_pressure(pair, patch, &loaded, &line, modulus)
        })
    };
    PairResult {
        pair: options.sense.sign() * running,
        pinion_tooth,
        wheel_tooth,
        // 0.0 first: the sum of nothing is -0.0 otherwise.
        normal_force: loaded.iter().fold(0.0, |sum, (_, f)| sum + f),
        max_pressure,
        contact_line_length: along * covered(&line, [-half, half]),
        points_in_contact: loaded.len(),
        slices,
    }
}

/// A loaded slice as the results have it.
pub(crate) fn slice_result(slice: &Slice, side: Side, force: f64) -> SliceResult {
    let line_load = force / slice.length;
    let state = slice.local.under(line_load);
    SliceResult {
        z: slice.z,
        wheel_z: slice.at[1][1],
        side,
        roll: [slice.at[0][0], slice.at[1][0]],
        line_load,
        half_width: state.half_width,
        pressure: state.pressure,
        off_line: slice.local.off_line,
        site: site(slice, state.half_width),
    }
}

/// What part of the flanks a slice presses with: a tip edge that is off the line of action or within the band, an end face that the slice ends at, or neither.
fn site(slice: &Slice, half_width: f64) -> Site {
    let [pinion, wheel] = slice.local.bodies.map(|b| b.tip_distance);
    // The edge that presses is that of the body whose tip is nearer.
    let tip = if pinion <= wheel { Site::PinionTipEdge } else { Site::WheelTipEdge };
    let nearest_face =
        slice.local.bodies.iter().flat_map(|b| b.ends).map(|end| end.distance).fold(f64::INFINITY, f64::min);
    if slice.local.off_line > 0.0 || pinion.min(wheel) <= half_width {
        tip
    } else if nearest_face <= 0.5 * slice.length * (1.0 + 1e-9) {
        Site::EndFace
    } else {
        Site::Flank
    }
}

/// What the local approach stores beyond half of force times approach, N mm.
pub(crate) fn local_energy(slice: &Slice, force: f64) -> f64 {
    slice.length * slice.local.law().curved_energy(force / slice.length)
}
