//! Lives and damage: laws, and the example of ISO 6336-6.

use rating::StressLife;

/// Annex C of ISO 6336-6:2019: bin, cycles in 30 years, sigma_H S_H (MPa), N_i, U_i; bins without cycles left out. Data of the open repository gfsReboucas/Drivetrain, `data/table_C2.csv`.
const BINS: &str = include_str!("iso_6336_6_annex_c.csv");

fn bins() -> Vec<[f64; 5]> {
    let row = |line: &str| -> [f64; 5] {
        let numbers: Vec<f64> = line.split(',').map(|x| x.parse().unwrap()).collect();
        numbers.try_into().unwrap()
    };
    BINS.lines().skip(1).map(row).collect()
}

/// The curve of the example: 1.6 at 1e5 cycles, 1 at 5e7, 0.85 at 1e10; sigma_HG at 5e7 from bin 42, whose stress 1467 MPa is borne for 45.7e6 cycles.
fn curve() -> StressLife {
    let reference = 1467.0 * (45.7e6_f64 / 5e7).powf(1.6_f64.ln() / 500f64.ln());
    StressLife::new(vec![[1e5, 1.6 * reference], [5e7, reference], [1e10, 0.85 * reference]]).unwrap()
}

/// Bin by bin the number of cycles is the printed one, as closely as a stress that is printed in whole MPa allows; damage to three digits where the printed numbers are taken; the sum is 0.999.
#[test]
fn example_of_iso_6336_6() {
    let (curve, bins) = (curve(), bins());
    assert_eq!(bins.len(), 42);
    for &[bin, cycles, stress, bears, damage] in &bins {
        let found = curve.cycles_at(stress);
        let slope = if stress < 1457.0 { 32.7 } else { 13.23 };
        // Half of a MPa of this bin and of the one that the curve is drawn through, and half of the last digit of N_i.
        let most = slope * 0.5 / stress + 13.23 * 0.5 / 1467.0 + 0.006;
        assert!((found / bears - 1.0).abs() < most, "bin {bin}: {found:.4e}, printed is {bears:.3e}");
        assert!((cycles / bears / damage - 1.0).abs() < 0.01, "bin {bin}");
    }
    let sum: f64 = bins.iter().map(|&[_, cycles, _, bears, _]| cycles / bears).sum();
    assert!((sum - 0.99945).abs() < 1.5e-3, "{sum}");
    let own: f64 = bins.iter().map(|&[_, cycles, stress, ..]| curve.damage(cycles, stress)).sum();
    assert!((own - 0.99945).abs() < 0.01, "{own}");
}

/// Stress and cycles are each other's inverse on the lines, and beyond their ends the lines go on.
#[test]
fn stress_and_cycles_are_inverse() {
    let curve = curve();
    for cycles in [1e5, 3e5, 1e7, 5e7, 2e8, 9e9] {
        let back = curve.cycles_at(curve.stress_at(cycles));
        assert!((back / cycles - 1.0).abs() < 1e-9, "{cycles:e}: {back:e}");
    }
    assert_eq!(curve.stress_at(10.0), curve.stress_at(1e5));
    assert_eq!(curve.stress_at(1e12), curve.stress_at(1e10));
    assert!(curve.cycles_at(1.1 * curve.stress_at(1e5)) < 1e5);
    assert!(curve.cycles_at(0.9 * curve.stress_at(1e10)) > 1e10);
    assert_eq!(curve.cycles_at(0.0), f64::INFINITY);
}

/// Below a level line nothing is damaged; a line that rises, or goes back, is none.
#[test]
fn endurance_has_no_damage() {
    let level = StressLife::new(vec![[1e5, 1600.0], [5e7, 1000.0], [1e10, 1000.0]]).unwrap();
    assert_eq!(level.cycles_at(999.0), f64::INFINITY);
    assert_eq!(level.damage(1e12, 999.0), 0.0);
    assert!(level.cycles_at(1001.0).is_finite());
    assert!(StressLife::new(vec![[1e5, 1.0], [1e6, 2.0]]).is_none());
    assert!(StressLife::new(vec![[1e6, 2.0], [1e5, 1.0]]).is_none());
    assert!(StressLife::new(vec![[1e6, 2.0]]).is_none());
    assert!(StressLife::new(vec![[0.0, 2.0], [1.0, f64::NAN]]).is_none());
}
