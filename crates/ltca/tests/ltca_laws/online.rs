//! The contact of given poses, and the tables behind it: what was gained in speed must not have been lost in truth.
#![allow(clippy::print_stdout, reason = "the figures are what the tests are for")]

use ale::Station;
use contact::{Bulk, Misalignment, Offset, Pose, slice::MeshContact};
use geometry::{
    FlankModification, GearModifications,
    modification::{ProfilePlace, Relief, ReliefShape},
};
use ltca::{StaticModel, StaticOptions};
use nalgebra::{Translation3, UnitQuaternion, Vector3};
use reduction::ElasticGear;
use testing::{Case, default_data, generated, modified, quadratic};

fn gears(case: &Case, options: &StaticOptions) -> StaticModel {
    StaticModel::new(case.pair.clone(), case.reduced_gears(options), options.clone()).unwrap()
}

fn small() -> Case {
    generated(20.0, [3, 2, 2, 6, 1])
}

/// Linear and quadratic elements, friction, reliefs, tilted axes: the tables change transmission error by less than a
/// ten thousandth.
#[test]
fn tables_change_nothing_that_matters() {
    let hex20 = quadratic(default_data(20.0), None, 150e3, [4, 2, 2, 8, 1], mesh::Extent::Sector(5));
    let relieved = {
        let mut case = small();
        let start = ProfilePlace::Roll(0.45);
        let relief = Relief { amount: 0.02, start, shape: ReliefShape::Linear };
        let flank = FlankModification { tip_relief: Some(relief), lead_crowning: 0.01, ..FlankModification::default() };
        case.pair = modified(&case.pair, [GearModifications::both(flank.clone()), GearModifications::both(flank)]);
        case
    };
    let tilt = |case: &Case| {
        let tilted = Misalignment { in_plane_of_action: 0.02, ..Misalignment::default() };
        [Offset::default(), tilted.wheel_offset(&case.pair, geometry::Side::Left)]
    };
    let shifted = [Offset::default(), Offset { z: 1.7, ..Offset::default() }];
    let plain = |case: &Case| case.slice_options();
    let cases: [(&str, &Case, StaticOptions); 6] = [
        ("hex8", &small(), plain(&small())),
        ("hex20", &hex20, plain(&hex20)),
        ("friction", &small(), plain(&small()).with_contact(|c| c.friction = 0.08)),
        ("relief and crowning", &relieved, plain(&relieved)),
        ("tilted", &small(), plain(&small()).with_contact(|c| c.offsets = tilt(&small()))),
        ("shifted", &small(), plain(&small()).with_contact(|c| c.offsets = shifted)),
    ];
    for (name, case, options) in cases {
        let mut model = gears(case, &options.clone().with_contact(|c| c.bulk = Bulk::Exact));
        let exact = model.run(12, 1, |_, _, _| ()).unwrap().positions;
        let mut model = StaticModel::new(case.pair.clone(), model.into_gears(), options).unwrap();
        let tables = model.run(12, 1, |_, _, _| ()).unwrap().positions;
        let stated = tables[0].certificate.bulk_compliance_error;
        let off = |a: f64, b: f64| (a / b - 1.0).abs();
        let worst =
            tables.iter().zip(&exact).map(|(a, b)| off(a.transmission_error, b.transmission_error)).fold(0.0, f64::max);
        println!("{name}: compliance off by at most {stated:.1e}, transmission error by {worst:.1e}");
        assert!(stated > 0.0 && stated < 1e-3, "{name}: stated error {stated:e}");
        assert!(exact.iter().all(|p| p.certificate.bulk_compliance_error == 0.0), "{name}: exact is exact");
        assert!(worst < 1e-4, "{name}: transmission error off by {worst:e}");
    }
}

fn solved(options: impl Fn(&Case) -> StaticOptions) -> (StaticModel, MeshContact) {
    let case = small();
    let mut model = gears(&case, &options(&case));
    model.solve(Station { cycle: 0, phase: 0.3 }).unwrap();
    let mesh = MeshContact::new(model.pair(), model.contact_set().clone(), &model.options().contact).unwrap();
    (model, mesh)
}

/// Where the static analysis stands, the contact of given poses presses with the same forces, and they balance the
/// torque.
#[test]
fn forces_are_those_of_the_static_pose() {
    for friction in [0.0, 0.06] {
        let (model, mut mesh) = solved(|case| case.slice_options().with_contact(|c| c.friction = friction));
        let e = model.last().unwrap();
        let force = mesh.evaluate(&e.poses).unwrap().clone();
        let torque = force.wrench[1].moment[2].abs();
        assert!((torque / 150e3 - 1.0).abs() < 1e-8, "friction {friction}: {torque} N mm about the wheel's axis");
        assert!((0..3).all(|k| (force.wrench[0].force[k] + force.wrench[1].force[k]).abs() < 1e-9), "{force:?}");
        let total: f64 = e.solution.forces.iter().sum();
        for (row, f) in e.rows.iter().zip(&e.solution.forces).filter(|(_, f)| **f > 0.0) {
            let same = mesh.rows().iter().position(|r| (r.patches, r.point) == (row.patches, row.point));
            let found = same.map_or(0.0, |i| mesh.solver().forces()[i]);
            assert!((found - f).abs() < 1e-8 * total, "friction {friction}: slice {} {f} N, {found}", row.point);
        }
        assert!(force.residual < 1e-11, "residual {:e}", force.residual);
    }
}

/// A pose with gear `body` moved along one of its six coordinates.
pub(super) fn moved(poses: &[Pose; 2], coordinate: usize, by: f64) -> [Pose; 2] {
    let mut poses = *poses;
    let (pose, axis) = (&mut poses[coordinate / 6], coordinate % 3);
    let mut step = Vector3::zeros();
    step[axis] = by;
    if coordinate % 6 < 3 {
        pose.append_translation_mut(&Translation3::from(step));
    } else {
        pose.append_rotation_wrt_center_mut(&UnitQuaternion::from_scaled_axis(step));
    }
    poses
}

pub(super) fn flat(wrench: &[contact::Wrench; 2]) -> [f64; 12] {
    let mut f = [0.0; 12];
    for (k, v) in wrench.iter().flat_map(|w| w.force.into_iter().chain(w.moment)).enumerate() {
        f[k] = v;
    }
    f
}

/// The tangent is the derivative of the forces: central differences along all twelve coordinates, forces and moments
/// scaled by the base radius. What it leaves out (contact wandering over the flanks, directions that turn) is a
/// thousandth.
#[test]
fn tangent_is_derivative_of_forces() {
    for friction in [0.0, 0.06] {
        let (model, mut mesh) = solved(|case| case.slice_options().with_contact(|c| c.friction = friction));
        let poses = model.last().unwrap().poses;
        let tangent = mesh.evaluate(&poses).unwrap().tangent;
        let radius = model.pair().pinion.base_radius();
        let scale = |k: usize| if k % 6 < 3 { 1.0 } else { radius };
        let largest = (0..12)
            .flat_map(|i| (0..12).map(move |j| (i, j)))
            .map(|(i, j)| (tangent[i][j] / scale(i) / scale(j)).abs())
            .fold(0.0, f64::max);
        let mut worst = 0.0f64;
        for j in 0..12 {
            let h = 1e-6 / scale(j);
            let f = |mesh: &mut MeshContact, by: f64| flat(&mesh.evaluate(&moved(&poses, j, by)).unwrap().wrench);
            let (up, down) = (f(&mut mesh, h), f(&mut mesh, -h));
            for (i, row) in tangent.iter().enumerate() {
                let difference = (up[i] - down[i]) / (2.0 * h);
                worst = worst.max((row[j] - difference).abs() / scale(i) / scale(j) / largest);
            }
        }
        println!("friction {friction}: tangent off by {worst:.1e} of its largest entry");
        assert!(worst < 3e-3, "friction {friction}: {worst:e}");
        let skew = (0..12)
            .flat_map(|i| (0..i).map(move |j| (i, j)))
            .map(|(i, j)| (tangent[i][j] - tangent[j][i]).abs() / scale(i) / scale(j) / largest)
            .fold(0.0, f64::max);
        if friction == 0.0 {
            assert!(skew < 1e-12, "not symmetric by {skew:e}");
        } else {
            assert!(skew > 1e-4, "friction makes it unsymmetric, not only by {skew:e}");
        }
        // Moving both gears together costs no force.
        for axis in 0..3 {
            let off = (0..12).map(|i| (tangent[i][axis] + tangent[i][axis + 6]).abs() / scale(i) / largest);
            assert!(off.fold(0.0, f64::max) < 1e-10, "rigid move along axis {axis}");
        }
    }
}

/// Apart there is neither force nor tangent, and the way there and back ends where it began.
#[test]
fn apart_nothing_presses() {
    let (model, mut mesh) = solved(Case::slice_options);
    let poses = model.last().unwrap().poses;
    let before = mesh.evaluate(&poses).unwrap().clone();
    let apart = moved(&poses, 11, -1e-3);
    let nothing = mesh.evaluate(&apart).unwrap();
    assert_eq!(flat(&nothing.wrench), [0.0; 12]);
    assert_eq!(nothing.tangent, [[0.0; 12]; 12]);
    assert_eq!(mesh.strain_energy(), 0.0);
    let after = mesh.evaluate(&poses).unwrap();
    for (a, b) in flat(&before.wrench).into_iter().zip(flat(&after.wrench)) {
        assert!((a - b).abs() < 1e-7, "{a} N before, {b} after");
    }
}

/// Energy is what the forces do: its derivative by the turn of the wheel is the moment.
#[test]
fn moment_is_the_slope_of_the_energy() {
    let (model, mut mesh) = solved(|case| case.slice_options().with_contact(|c| c.bulk = Bulk::Exact));
    let poses = model.last().unwrap().poses;
    let moment = mesh.evaluate(&poses).unwrap().wrench[1].moment[2];
    let h = 2e-7;
    let mut energy = |by: f64| {
        mesh.evaluate(&moved(&poses, 11, by)).unwrap();
        mesh.strain_energy()
    };
    let slope = (energy(h) - energy(-h)) / (2.0 * h);
    // Contact wanders over flanks of varying compliance: some thousandths.
    assert!((slope / moment.abs() - 1.0).abs() < 5e-3, "energy rises by {slope} N mm/rad against {moment} N mm");
}

/// Stations side by side: the same bits on one core and on two, across tooth changes.
#[test]
fn threads_change_no_bit() {
    let case = small();
    let options = case.slice_options();
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let mut model = gears(&case, &options);
        let mut seen = Vec::new();
        let history = pool.install(|| {
            model
                .run(24, 3, |i, position, at| {
                    let last = at.last().map(|e| e.transmission_error);
                    seen.push((i, last == Some(position.transmission_error)));
                })
                .unwrap()
        });
        assert_eq!(seen, (0..72).map(|i| (i, true)).collect::<Vec<_>>(), "every station is told of, in order");
        history
    };
    let (one, two) = (run(1), run(2));
    assert!(one.positions.last().unwrap().tooth_changes >= 2, "no tooth change was seen");
    for (i, (a, b)) in one.positions.iter().zip(&two.positions).enumerate() {
        assert!(a == b, "station {i}: {a:?} on one thread, {b:?} on two");
    }
    // Tooth by tooth, one station after the other, it is the same to the tolerance of a pose.
    let mut model = gears(&case, &options);
    for (i, wanted) in one.positions.iter().enumerate() {
        let station = Station { cycle: i as i64 / 24, phase: (i % 24) as f64 / 24.0 };
        let alone = model.advance(station, |_| ()).unwrap();
        let off = (alone.transmission_error / wanted.transmission_error - 1.0).abs();
        assert!(off < 1e-8, "station {i}: {off:e}");
        assert_eq!(alone.tooth_changes, wanted.tooth_changes, "station {i}");
    }
    assert!(model.gears().iter().all(|g| matches!(g, ElasticGear::Reduced(r) if r.is_cyclic())));
}
