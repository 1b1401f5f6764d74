//! Slices with a dense compliance: the conditions hold whatever it is, with the bodies held or a moment to balance,
//! from any start.

use contact::complementarity::{Balance, DenseProblem, DenseSolver};
use faer::{Mat, linalg::solvers::Solve};
use proptest::prelude::*;

/// Approach and slope of a line contact: grows slower and slower.
fn local(force: f64) -> (f64, f64) {
    let f = force.max(1e-6);
    let c = 2e-6;
    let (value, slope) = (c * f * (20.0 - f.ln()), c * (19.0 - f.ln()));
    if force <= 0.0 { (0.0, slope) } else { (value, slope) }
}

/// C = B B' + bending, entries about 1e-5 mm/N.
fn compliance(n: usize, seed: &[f64]) -> Mat<f64> {
    let b = Mat::from_fn(n, 4, |i, j| 2e-3 * (seed[(i * 7919 + j * 104_729) % seed.len()] - 0.3));
    let local = &b * b.transpose();
    Mat::from_fn(n, n, |i, j| local[(i, j)] + 1e-6)
}

/// l_A' (S_AA + diag delta'(F_A))^-1 l_A at the forces found, N mm/rad.
fn stiffness(s: &Mat<f64>, solver: &DenseSolver, levers: &[f64]) -> f64 {
    let (active, forces) = (solver.active(), solver.forces());
    let m = active.len();
    let mut tangent = Mat::from_fn(m, m, |a, b| s[(active[a], active[b])]);
    (0..m).for_each(|a| tangent[(a, a)] += local(forces[active[a]]).1);
    let own = Mat::from_fn(m, 1, |a, _| levers[active[a]]);
    (own.transpose() * tangent.partial_piv_lu().solve(&own))[(0, 0)]
}

fn check(s: &Mat<f64>, gaps: &[f64], balance: Balance, start: f64) -> Result<(), TestCaseError> {
    let n = gaps.len();
    let levers: Vec<f64> = (0..n).map(|i| -42.0 - 0.01 * i as f64).collect();
    let problem = DenseProblem {
        compliance: s.as_ref(),
        symmetric: true,
        gaps,
        levers: &levers,
        torque_levers: &levers,
        balance,
    };
    let mut solver = DenseSolver::new(n);
    solver.solve(&problem, |_, f| local(f), |_| start).map_err(|e| TestCaseError::fail(e.to_string()))?;
    let forces = solver.forces();
    if let Balance::Moment(moment) = balance {
        let carried: f64 = forces.iter().zip(&levers).map(|(f, l)| f * l).sum();
        prop_assert!((carried / moment - 1.0).abs() < 1e-9, "moment {carried}, not {moment}");
        let wanted = stiffness(s, &solver, &levers);
        prop_assert!(
            (solver.stiffness() / wanted - 1.0).abs() < 1e-9,
            "stiffness {}, not {wanted}",
            solver.stiffness()
        );
    } else {
        prop_assert_eq!(solver.rotation(), 0.0);
    }
    let scale = gaps.iter().fold(1e-9f64, |m, g| m.max(g.abs())).max(42.0 * solver.rotation().abs());
    for i in 0..n {
        let opening: f64 = (0..n).map(|j| s[(i, j)] * forces[j]).sum::<f64>() + local(forces[i]).0;
        let gap = gaps[i] + levers[i] * solver.rotation() + opening;
        prop_assert!(forces[i] >= 0.0, "row {i} pulls with {}", forces[i]);
        prop_assert!(gap > -1e-9 * scale, "row {i} is penetrated by {gap}");
        prop_assert!(forces[i] == 0.0 || gap.abs() < 1e-9 * scale, "row {i}: force {} at gap {gap}", forces[i]);
    }
    Ok(())
}

proptest! {
    #[test]
    fn conditions_hold(
        gaps in prop::collection::vec(-0.02f64..0.02, 1..70),
        seed in prop::collection::vec(0.0f64..1.0, 97),
        moment in prop::sample::select(vec![-10.0, -1e4, -3e5]),
        start in prop::sample::select(vec![0.0, 1.0, 500.0]),
    ) {
        let s = compliance(gaps.len(), &seed);
        check(&s, &gaps, Balance::Held, start)?;
        check(&s, &gaps, Balance::Moment(moment), start)?;
    }
}

/// Nothing overlaps: nothing presses, and there is no tangent.
#[test]
fn open_gaps_carry_nothing() {
    let s = compliance(5, &[0.1, 0.7, 0.4]);
    let (gaps, levers) = ([1e-3; 5], [-40.0; 5]);
    let problem = DenseProblem {
        compliance: s.as_ref(),
        symmetric: true,
        gaps: &gaps,
        levers: &levers,
        torque_levers: &levers,
        balance: Balance::Held,
    };
    let mut solver = DenseSolver::new(5);
    solver.solve(&problem, |_, f| local(f), |_| 0.0).unwrap();
    assert!(solver.forces().iter().all(|&f| f == 0.0) && solver.active().is_empty());
    assert_eq!(solver.tangent(|_| [[1.0; 12]; 2]), [[0.0; 12]; 12]);
    // The same from forces that are not there any more.
    solver.solve(&problem, |_, f| local(f), |_| 100.0).unwrap();
    assert!(solver.forces().iter().all(|&f| f == 0.0), "{:?}", solver.forces());
}

/// Rows whose own approach is that of Hertz's line contact, a F ln(b/F), and much softer than the body, as those of narrow
/// slices: with the tangent at too large a force they pull where they ought to press lightly. They settle in a few steps all
/// the same, in small problems and in ones that are factored in blocks.
#[test]
fn rows_that_press_lightly_do_not_come_and_go() {
    for n in [40, 300] {
        let bulk = 1e-6;
        let s = Mat::from_fn(n, n, |i, j| bulk * (-0.25 * (i as f64 - j as f64).abs()).exp());
        let (own, size) = (50.0 * bulk, 1e4);
        let local = |_: usize, f: f64| {
            let f = f.max(1e-12);
            (own * f * (size / f).ln(), own * ((size / f).ln() - 1.0))
        };
        // Half of the rows press hard, the others overlap by a thousandth of that and come later.
        let gaps: Vec<f64> = (0..n).map(|i| if i < n / 2 { -1e-2 } else { -1e-5 }).collect();
        let levers = vec![0.0; n];
        let balance = Balance::Held;
        let (compliance, torque_levers) = (s.as_ref(), &levers[..]);
        let problem =
            DenseProblem { compliance, symmetric: true, gaps: &gaps, levers: &levers, torque_levers, balance };
        let mut solver = DenseSolver::new(n);
        solver.solve(&problem, local, |i| if i < n / 2 { 1.0 } else { 0.0 }).unwrap();
        assert!(solver.iterations() <= 12, "{n} rows: {} steps", solver.iterations());
        for i in 0..n {
            let force = solver.forces()[i];
            let opened: f64 = (0..n).map(|j| s[(i, j)] * solver.forces()[j]).sum();
            let gap = gaps[i] + opened + if force > 0.0 { local(i, force).0 } else { 0.0 };
            assert!(force >= 0.0 && gap > -1e-11 && (force == 0.0 || gap < 1e-11), "row {i}: {force} N at {gap} mm");
        }
    }
}
