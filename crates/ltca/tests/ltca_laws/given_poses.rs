//! Contact of gears held at given poses: points and slices, reduced gears and whole ones, through one way in.
#![allow(clippy::print_stdout, reason = "the figures are what the tests are for")]

use ale::Station;
use contact::{MeshForce, Pose, WindowContact, complementarity::Law, slice::MeshContact};
use ltca::{StaticModel, StaticOptions};
use testing::{Case, generated};

use super::online::{flat, moved};

/// Ways to make contact, each with its model.
fn kinds() -> Vec<(&'static str, StaticModel)> {
    let case = generated(20.0, [3, 2, 2, 4, 1]);
    let points = |change: fn(&mut contact::ContactOptions)| case.options().with_contact(change);
    let reduced = |options: StaticOptions| case.reduced(options);
    vec![
        ("points, exact", reduced(points(|_| ()))),
        ("points, penalty", reduced(points(|c| c.law = Law::Penalty(1e6)))),
        ("points, penalty, friction", reduced(points(|c| (c.law, c.friction) = (Law::Penalty(1e6), 0.06)))),
        ("slices, reduced", reduced(Case::slice_options(&case))),
        ("points, penalty, whole gears", case.full(points(|c| c.law = Law::Penalty(1e6)))),
        ("slices, whole gears", case.full(Case::slice_options(&case))),
    ]
}

fn evaluated(model: &StaticModel, poses: &[Pose; 2]) -> MeshForce {
    let options = &model.options().contact;
    let mut window = WindowContact::new(model.pair(), model.contact_set().clone(), options).unwrap();
    window.evaluate(model.pair(), model.gears(), options, poses).unwrap()
}

/// Where the static analysis stands, contact balances the torque; forces on both gears are equal and opposite; and the
/// tangent is the derivative of the moment by the turn that carries it.
#[test]
fn contact_balances_the_torque_of_the_pose() {
    for (name, mut model) in kinds() {
        model.solve(Station { cycle: 0, phase: 0.3 }).unwrap();
        let poses = model.last().unwrap().poses;
        let force = evaluated(&model, &poses);
        let torque = force.wrench[1].moment[2].abs();
        let total: f64 = force.pair_forces.iter().sum();
        let unbalanced =
            (0..3).map(|k| (force.wrench[0].force[k] + force.wrench[1].force[k]).abs()).fold(0.0, f64::max);
        let h = 1e-6 / model.pair().wheel.base_radius();
        let moment = |by: f64| flat(&evaluated(&model, &moved(&poses, 11, by)).wrench)[11];
        let slope = (moment(h) - moment(-h)) / (2.0 * h);
        let off = (force.tangent[11][11] / slope - 1.0).abs();
        println!("{name}: torque off by {:.1e}, tangent by {off:.1e}", torque / 150e3 - 1.0);
        assert!((torque / 150e3 - 1.0).abs() < 1e-9, "{name}: {torque} N mm about the wheel's axis");
        assert!(unbalanced < 1e-9 * total, "{name}: {unbalanced} N remain of {total} N");
        assert!(off < 1e-3, "{name}: tangent {:e}, difference {slope:e} N mm/rad", force.tangent[11][11]);
    }
}

/// Reduction is exact: the same forces and the same tangent as with all degrees of freedom, at the same poses.
#[test]
fn reduced_gears_press_as_whole_ones() {
    let case = generated(20.0, [3, 2, 2, 4, 1]);
    for options in [case.options().with_contact(|c| c.law = Law::Penalty(1e6)), case.slice_options()] {
        let exact = options.with_contact(|c| c.bulk = contact::Bulk::Exact);
        let [mut reduced, full] = [case.reduced(exact.clone()), case.full(exact)];
        reduced.solve(Station { cycle: 0, phase: 0.3 }).unwrap();
        let poses = reduced.last().unwrap().poses;
        let [a, b] = [evaluated(&reduced, &poses), evaluated(&full, &poses)];
        let largest = flat(&b.wrench).iter().fold(0.0f64, |m, x| m.max(x.abs()));
        let apart = flat(&a.wrench).iter().zip(flat(&b.wrench)).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        let stiffest = b.tangent.as_flattened().iter().fold(0.0f64, |m, x| m.max(x.abs()));
        let pairs = a.tangent.as_flattened().iter().zip(b.tangent.as_flattened());
        let of_tangent = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        println!("forces apart by {:.1e}, tangents by {:.1e}", apart / largest, of_tangent / stiffest);
        assert!(apart < 1e-11 * largest && of_tangent < 1e-9 * stiffest, "{a:?}, whole: {b:?}");
    }
}

/// Gears that are apart press with nothing, whatever touches.
#[test]
fn apart_nothing_presses_at_all() {
    for (name, mut model) in kinds() {
        model.solve(Station { cycle: 0, phase: 0.3 }).unwrap();
        let nothing = evaluated(&model, &moved(&model.last().unwrap().poses, 11, -1e-3));
        assert_eq!((flat(&nothing.wrench), nothing.tangent), ([0.0; 12], [[0.0; 12]; 12]), "{name}");
        assert!(nothing.pair_forces.iter().all(|f| *f == 0.0), "{name}");
    }
}

/// Slices look for what is near alone, and follow small motions on the rows of before, with the same forces as from the
/// beginning; and where teeth overlap or move by more, that is said or all is looked for anew.
#[test]
fn narrow_searches_and_small_motions_change_no_force() {
    let case = generated(20.0, [3, 2, 2, 4, 1]);
    let mut model = case.reduced(case.slice_options());
    model.solve(Station { cycle: 0, phase: 0.3 }).unwrap();
    let poses = model.last().unwrap().poses;
    let own = || MeshContact::new(model.pair(), model.contact_set().clone(), &model.options().contact).unwrap();
    let near = |found: &MeshForce, poses: &[Pose; 2], at: &str| {
        let anew = evaluated(&model, poses);
        let largest = flat(&anew.wrench).iter().fold(0.0f64, |m, x| m.max(x.abs()));
        let apart = flat(&found.wrench).iter().zip(flat(&anew.wrench)).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(apart < 1e-9 * largest, "{at}: forces are {:.1e} apart", apart / largest);
    };
    let mut contact = own();
    contact.evaluate(&poses).unwrap();
    let overlap = contact.deepest_overlap();
    assert!(overlap > 0.0);
    for reach in [0.1 * overlap, 1.25 * overlap, 5.0 * overlap] {
        near(contact.evaluate_within(&poses, reach).unwrap(), &poses, &format!("reach {reach} of {overlap} mm"));
    }
    let (mut within, mut at) = (1.5 * overlap, poses);
    contact.evaluate_within(&poses, within).unwrap();
    for axis in [11, 0, 7, 10, 5, 11, 2, 3] {
        // A hundredth of the approach, at the flanks of either gear.
        let size = 0.01 * overlap / if axis % 6 < 3 { 1.0 } else { model.pair().wheel.tip_radius() };
        at = moved(&at, axis, size);
        let found =
            contact.evaluate_moved(&at, &mut within).unwrap_or_else(|| panic!("axis {axis} is no small motion"));
        near(found, &at, &format!("axis {axis}"));
    }
    assert!(within < 1.45 * overlap, "eight motions have left {within} of {} mm", 1.5 * overlap);
    let mut far = f64::INFINITY;
    assert!(contact.evaluate_moved(&moved(&at, 11, 1e-2), &mut far).is_none(), "no small motion");
}
