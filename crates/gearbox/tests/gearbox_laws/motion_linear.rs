//! Heavily loaded flanks that never part are a linear oscillator: resonance and amplitudes are those of its transfer
//! function.
//!
//! ```text
//! m_e x'' + c x' + k_m (x - STE(t)) = 0,   c = 2 zeta sqrt(k_m m_e)
//! X_n / STE_n = 1 / (1 - r^2 + 2 i zeta r),   r = n f_m / f_0
//! ```
//! The force of the mesh about its static balance is F + k(t) (x - STE), so what excites the oscillator is the
//! quasi-static error. Held against the mean stiffness, k(t) must hardly vary: the pair has an overlap ratio of one,
//! and contact lines of constant length.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use dynamics::MeshDamping;
use gearbox::motion::{SteadyBy, SteadyOptions, SweepPlan};
use geometry::GearData;
use integrate::{Scheme, SweepDirection};
use ltca::StaticOptions;
use testing::moving::{MovingPair, order, peak_to_peak, swept};

const ROWS: usize = 48;
const ZETA: f64 = 0.06;
/// Orders of the mesh that are compared.
const ORDERS: usize = 4;

/// Overlap ratio 1: sin beta = pi m_n / b. The load is the double of the default pair's.
fn steady_pair() -> MovingPair {
    let GearData { normal_module, face_width, .. } = GearData::default();
    let beta = (std::f64::consts::PI * normal_module / face_width).asin();
    let case = testing::generated(beta.to_degrees(), [2, 2, 2, 4, 1]);
    let contact = StaticOptions { torque: 300e3, ..case.slice_options() }.with_contact(|c| c.slices = 16);
    MovingPair::new(case, contact, ROWS)
}

/// X_n over STE_n.
fn transfer(ratio: f64) -> f64 {
    (1.0 - ratio * ratio).hypot(2.0 * ZETA * ratio).recip()
}

fn size([re, im]: [f64; 2]) -> f64 {
    re.hypot(im)
}

/// f_0 over the expected one, from three speeds about a peak: STE_n^2 / X_n^2 = 1 - 2 (1 - 2 zeta^2) r^2 / r_0^2 + r^4
/// / r_0^4 is a parabola in r^2 with its least value at r_0^2 (1 - 2 zeta^2).
fn resonance(ratios: [f64; 3], sizes: [f64; 3]) -> f64 {
    let [x, y] = [ratios.map(|r| r * r), sizes.map(|s| s.powi(-2))];
    let [left, right] = [(y[1] - y[0]) / (x[1] - x[0]), (y[2] - y[1]) / (x[2] - x[1])];
    let curvature = (right - left) / (x[2] - x[0]);
    let least = 0.5 * (x[0] + x[1]) - 0.5 * left / curvature;
    (least / (1.0 - 2.0 * ZETA * ZETA)).sqrt()
}

/// The steady answer about resonance and about half of it: every order of the mesh that counts is as large as the
/// transfer function says.
#[test]
fn a_heavily_loaded_pair_is_a_linear_oscillator() {
    let pair = steady_pair();
    let f_0 = pair.resonance_hz();
    let static_orders: Vec<f64> = (0..=ORDERS).map(|n| size(order(&pair.ste, n))).collect();
    println!(
        "f_0 {f_0:.1} Hz; STE {:.3} um, peak to peak {:.3} um, orders {:.1?} nm; k {:.4e} N/mm, peak to peak {:.2} %",
        1e3 * static_orders[0],
        1e3 * peak_to_peak(&pair.ste),
        static_orders[1..].iter().map(|x| 1e6 * x).collect::<Vec<_>>(),
        pair.means[0],
        100.0 * peak_to_peak(&pair.stiffness) / pair.means[0]
    );
    let ratios = [0.475, 0.5, 0.525, 0.95, 1.0, 1.05, 1.3];
    let system = pair.system(f_0, |o| o.damping = MeshDamping::Ratio(ZETA));
    let times = pair.times_showing(&system, Scheme::GeneralisedAlpha { rho: 1.0 }, [ROWS, 40]);
    let plan = SweepPlan {
        speeds: ratios.iter().map(|r| pair.speed(r * f_0)).collect(),
        ways: vec![SweepDirection::Independent],
        times,
        steady: SteadyOptions { by: SteadyBy::Running, tolerance: 1e-4, most: 100, cycles: 1 },
    };
    let points = swept(&system, &plan);
    let found: Vec<Vec<f64>> =
        points.iter().map(|p| (0..=ORDERS).map(|n| size(order(&p.transmission_error, n))).collect()).collect();
    println!("| f_m / f_0 | order | DTE, nm | linear, nm | off, % |\n|---|---|---|---|---|");
    for ((ratio, point), found) in ratios.iter().zip(&points).zip(&found) {
        let linear: Vec<f64> = (0..=ORDERS).map(|n| static_orders[n] * transfer(n as f64 * ratio)).collect();
        let largest = linear[1..].iter().fold(0.0, |m: f64, x| m.max(*x));
        for n in (1..=ORDERS).filter(|&n| linear[n] > 0.25 * largest) {
            let off = found[n] / linear[n] - 1.0;
            println!("| {ratio} | {n} | {:.1} | {:.1} | {:+.2} |", 1e6 * found[n], 1e6 * linear[n], 100.0 * off);
            assert!(off.abs() < 0.02, "f_m / f_0 = {ratio}, order {n}: {} mm, not {}", found[n], linear[n]);
        }
        assert!(point.normal_force.iter().all(|f| *f > 0.0), "f_m / f_0 = {ratio}: contact is lost");
    }
    for (n, at) in [(2, 0), (1, 3)] {
        let three = |x: &dyn Fn(usize) -> f64| [x(at), x(at + 1), x(at + 2)];
        let at_resonance = resonance(three(&|i| n as f64 * ratios[i]), three(&|i| found[i][n]));
        println!("resonance by order {n}: {:.1} Hz, {:+.2} %", f_0 * at_resonance, 100.0 * (at_resonance - 1.0));
        assert!((at_resonance - 1.0).abs() < 0.02, "order {n}: {at_resonance} of {f_0} Hz");
    }
}
