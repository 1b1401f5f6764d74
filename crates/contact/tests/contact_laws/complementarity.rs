//! The complementarity solver on dense problems of its own: its conditions hold whatever the compliance.

use contact::{
    ContactError, Vec3, complementarity,
    complementarity::{Balance, Equality, Law, LinearContact, Problem},
    nodal::{ContactRow, Support},
};
use faer::{Mat, Side, linalg::solvers::Solve};
use proptest::prelude::*;

/// Bodies known by a dense compliance between the rows.
struct Dense(Mat<f64>);

impl LinearContact for Dense {
    fn solve(&mut self, active: &[usize], p: &Problem) -> Result<Equality, ContactError> {
        let n = active.len();
        let c = |a: usize, b: usize| self.0[(active[a], active[b])];
        let s = Mat::from_fn(n, n, |a, b| c(a, b) + if a == b { p.compliance[active[a]] } else { 0.0 });
        let rhs = Mat::from_fn(n, 2, |a, k| if k == 0 { -p.gaps[active[a]] } else { p.levers[active[a]] });
        let x = s.llt(Side::Lower).map_err(|_| ContactError::NotPositiveDefinite { points: n })?.solve(&rhs);
        let dot = |k: usize| (0..n).map(|a| p.torque_levers[active[a]] * x[(a, k)]).sum::<f64>();
        let rotation = (dot(0) - p.moment) / dot(1);
        let forces: Vec<f64> = (0..n).map(|a| x[(a, 0)] - rotation * x[(a, 1)]).collect();
        let openings = (0..p.gaps.len()).map(|i| (0..n).map(|a| self.0[(i, active[a])] * forces[a]).sum()).collect();
        Ok(Equality { forces, rotation, openings, stiffness: dot(1) })
    }

    fn self_compliance(&mut self) -> Result<f64, ContactError> {
        Ok((0..self.0.nrows()).map(|i| self.0[(i, i)]).sum::<f64>() / self.0.nrows() as f64)
    }

    fn displacements(&self, _: &[f64]) -> [Vec<f64>; 2] {
        [Vec::new(), Vec::new()]
    }
}

fn row(gap: f64, lever: f64) -> ContactRow {
    let support = Support { nodes: [0; 9], weights: [0.0; 9], count: 0, direction: Vec3::x(), load: Vec3::x() };
    ContactRow {
        patches: (0, 0),
        point: 0,
        gap,
        area: 0.04,
        position: Vec3::zeros(),
        normal: Vec3::x(),
        coordinates: [0.0; 2],
        levers: [lever; 2],
        torque_levers: [lever; 2],
        traction: Vec3::x(),
        supports: [support; 2],
    }
}

/// C = B B' + bending: of rank + 1, entries about 1e-5 mm/N. Bending alike at all rows: as on a tooth, no set of
/// pressing forces leaves it undeflected.
fn compliance(n: usize, rank: usize, seed: &[f64]) -> Mat<f64> {
    let b = Mat::from_fn(n, rank, |i, j| {
        1e-3 * seed[(i * 7919 + j * 104_729) % seed.len()] + if i % rank == j { 3e-3 } else { 0.0 }
    });
    let local = &b * b.transpose();
    Mat::from_fn(n, n, |i, j| local[(i, j)] + 1e-5)
}

fn check(c: &Mat<f64>, gaps: &[f64], moment: f64, law: Law) -> Result<(), TestCaseError> {
    let n = gaps.len();
    let levers: Vec<f64> = (0..n).map(|i| -42.0 - 0.01 * i as f64).collect();
    let rows: Vec<ContactRow> = gaps.iter().zip(&levers).map(|(&g, &l)| row(g, l)).collect();
    let mut bodies = Dense(c.clone());
    let s = complementarity::solve(&mut bodies, &rows, 0, Balance::Moment(moment), law, &vec![0.0; n])
        .map_err(|e| TestCaseError::fail(e.to_string()))?;
    let carried: f64 = s.forces.iter().zip(&levers).map(|(f, l)| f * l).sum();
    prop_assert!((carried / moment - 1.0).abs() < 1e-9, "moment {carried}, not {moment}");
    let approach = levers.iter().fold(0.0f64, |m, l| m.max((l * s.rotation).abs()));
    for i in 0..n {
        let opening: f64 = (0..n).map(|j| c[(i, j)] * s.forces[j]).sum();
        let soft = if let Law::Penalty(k) = law { s.forces[i] / (k * 0.04) } else { 0.0 };
        let gap = gaps[i] + levers[i] * s.rotation + opening + soft;
        prop_assert!(s.forces[i] >= 0.0, "row {i} pulls with {}", s.forces[i]);
        prop_assert!(gap > -1e-9 * approach, "row {i} is penetrated by {gap}");
        prop_assert!(s.forces[i] == 0.0 || gap.abs() < 1e-9 * approach, "row {i}: force {} at gap {gap}", s.forces[i]);
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, ..ProptestConfig::default() })]
    /// Random gaps, equal gaps, more rows than freedoms: the conditions hold to round-off.
    #[test]
    fn conditions_hold(
        n in 1..60usize, share in 0.2..1.0f64, seed in prop::collection::vec(-1.0..1.0f64, 211),
        spread in prop_oneof![Just(0.0), Just(1e-9), 1e-5..1e-3f64], load in 0..6i32, penalty in prop::option::of(3.0..9.0f64),
    ) {
        let rank = ((n as f64 * share).ceil() as usize).max(1);
        let gaps: Vec<f64> = (0..n).map(|i| spread * seed[(i * 31) % seed.len()].abs()).collect();
        let law = penalty.map_or(Law::Exact, |p| Law::Penalty(10f64.powf(p)));
        check(&compliance(n, rank, &seed), &gaps, -10f64.powi(load), law)?;
    }
}

/// Two rows alike, half the load each way: by hand.
#[test]
fn two_points_share_by_their_compliance() {
    let c = Mat::from_fn(2, 2, |i, j| if i == j { [1e-5, 3e-5][i] } else { 0.0 });
    let rows = [row(0.0, -1.0), row(0.0, -1.0)];
    let s = complementarity::solve(&mut Dense(c), &rows, 0, Balance::Moment(-4.0), Law::Exact, &[0.0; 2]).unwrap();
    assert!((s.forces[0] - 3.0).abs() < 1e-9 && (s.forces[1] - 1.0).abs() < 1e-9, "{:?}", s.forces);
    assert!((s.rotation - 3e-5).abs() < 1e-14, "{}", s.rotation);
}

/// Without a lever nothing can carry a moment: an error, not a number.
#[test]
fn no_lever_is_an_error() {
    let c = Mat::from_fn(1, 1, |_, _| 1e-5);
    let refused = complementarity::solve(&mut Dense(c), &[row(0.0, 1.0)], 0, Balance::Moment(-4.0), Law::Exact, &[0.0])
        .unwrap_err();
    assert!(matches!(refused, ContactError::CannotCarryTorque { .. }), "{refused}");
}
