//! Laws of the local compliance of a line contact.

use std::f64::consts::PI;

use contact::local::{EndFace, LocalBody, LocalContact, layer_constant, wedge_softening};

const RADIUS: f64 = 5.0;

/// Two steel teeth, the first one touching `distance` mm from its tip edge (negative: the edge presses past the line of
/// action).
fn contact(distance: f64, edge_radius: f64) -> LocalContact {
    let steel = |tip_distance: f64, depth: f64| {
        let omega = 118f64.to_radians();
        LocalBody {
            young: 2.06e5,
            poisson: 0.3,
            // As a tooth's: the layer's constant less what the edge adds half a depth away.
            layer: layer_constant(0.3) - 0.3 * wedge_softening(omega),
            depth,
            tip_distance,
            tip_angle: omega,
            tip_gradient: 2.0,
            edge_radius,
            ends: [EndFace { distance: 0.7, lean: 0.3 }, EndFace { distance: 19.0, lean: -0.3 }],
        }
    };
    LocalContact {
        bodies: [steel(distance.max(0.0), 1.2 + 0.5 * distance.max(0.0)), steel(4.0, 2.2)],
        radius: RADIUS,
        off_line: (-distance).max(0.0),
        deviation: None,
    }
}

/// Far from tips and ends the approach is what the layer's kernel K [c - ln(r/t)] makes of Hertz's pressure over the
/// band, by quadrature: to a millionth.
#[test]
fn approach_is_the_layers_kernel_under_hertzian_pressure() {
    let (young, poisson) = (2.06e5, 0.3);
    let depths = [1.7, 2.2];
    let body = |depth: f64| LocalBody {
        young,
        poisson,
        layer: layer_constant(poisson),
        depth,
        tip_distance: f64::INFINITY,
        tip_angle: PI,
        tip_gradient: 0.0,
        edge_radius: 0.0,
        ends: [EndFace::FAR; 2],
    };
    let contact = LocalContact { bodies: depths.map(body), radius: RADIUS, off_line: 0.0, deviation: None };
    let softness = 2.0 * (1.0 - poisson * poisson) / (PI * young);
    for load in [1.0, 30.0, 400.0] {
        // Hertz, two alike bodies: a^2 = 4 q R / (pi E*), 1/E* = 2 (1 - nu^2) / E; p = 2 q / (pi a) sqrt(1 - s^2/a^2).
        let half_width = (8.0 * load * RADIUS * (1.0 - poisson * poisson) / (PI * young)).sqrt();
        // s = a sin(theta), theta = pi/2 x^5: smooth where the logarithm is not.
        let n = 4000;
        let mean_log: f64 = (0..n)
            .map(|i| (f64::from(i) + 0.5) / f64::from(n))
            .map(|x| {
                let (sin, cos) = (0.5 * PI * x.powi(5)).sin_cos();
                4.0 / PI * cos * cos * (half_width * sin).ln() * 2.5 * PI * x.powi(4) / f64::from(n)
            })
            .sum();
        let wanted: f64 = depths.iter().map(|t| softness * load * (layer_constant(poisson) + t.ln() - mean_log)).sum();
        let found = contact.under(load);
        assert!((found.half_width / half_width - 1.0).abs() < 1e-12, "F' = {load} N/mm: {} mm wide", found.half_width);
        assert!((found.approach / wanted - 1.0).abs() < 1e-6, "F' = {load} N/mm: {} mm, not {wanted}", found.approach);
    }
}

/// A band far narrower than its distance d from the tip edge sees a wedge whose load acts at d: K q [ln(2 t / a) +
/// 1/2 + c + eta ln(t / d)], with a sharp edge and with a rounded one, which ends the flank nearer and leaves the
/// corner where it was.
#[test]
fn well_within_the_flank_the_load_acts_where_the_band_is() {
    let load = 1e-3;
    let softness = 2.0 * (1.0 - 0.3 * 0.3) / (PI * 2.06e5);
    for edge_radius in [0.0, 0.1] {
        for distance in [0.3, 1.0, 3.0] {
            let mut c = contact(distance, edge_radius);
            c.bodies.iter_mut().for_each(|b| b.ends = [EndFace::FAR; 2]);
            let found = c.under(load);
            let of_body = |b: &LocalBody| {
                let wedge = wedge_softening(b.tip_angle) * (b.depth / b.tip_distance).ln();
                softness * load * ((2.0 * b.depth / found.half_width).ln() + 0.5 + b.layer + wedge)
            };
            let wanted: f64 = c.bodies.iter().map(of_body).sum();
            // What is left goes with the square of the band over the distance, and with its product with the gradient
            // at the tip.
            assert!(
                (found.approach / wanted - 1.0).abs() < 2e-5,
                "{distance} mm from an edge of {edge_radius} mm: {:e} mm, not {wanted:e}",
                found.approach
            );
        }
    }
}

/// The slope is the derivative over five decades of load, on the flank, at the edge and past it.
#[test]
fn slope_is_derivative_of_approach() {
    for edge_radius in [0.0, 0.1] {
        for distance in [-0.5, -0.05, 0.0, 0.05, 0.3, 3.0] {
            let c = contact(distance, edge_radius);
            for load in [0.05, 1.0, 10.0, 100.0, 1000.0] {
                let h = 1e-5 * load;
                let wanted = (c.under(load + h).approach - c.under(load - h).approach) / (2.0 * h);
                let slope = c.under(load).slope;
                assert!(slope > 0.0);
                assert!(
                    (slope - wanted).abs() <= 1e-6 * slope,
                    "F' = {load} N/mm, {distance} mm from the edge: {slope:e}, not {wanted:e}"
                );
            }
        }
    }
}

/// What is stored is what the load does: the derivative of the energy is the load times that of the approach, to
/// round-off on the flank; to a ten-thousandth within a band of the edge, where the band's kinks meet its quadrature.
#[test]
fn stored_energy_is_the_work_of_the_load() {
    for edge_radius in [0.0, 0.1] {
        for (distance, allowed) in [(-0.5, 1e-3), (-0.05, 1e-3), (0.0, 1e-3), (0.05, 1e-3), (0.3, 3e-4), (3.0, 1e-6)] {
            let law = contact(distance, edge_radius).law();
            let stored = |q: f64| 0.5 * q * law.under(q).approach + law.curved_energy(q);
            for load in [1.0, 10.0, 100.0, 1000.0] {
                let h = 1e-4 * load;
                let grown = (stored(load + h) - stored(load - h)) / (2.0 * h);
                let done = load * law.under(load).slope;
                assert!(
                    (grown / done - 1.0).abs() < allowed,
                    "F' = {load} N/mm, {distance} mm from the edge: stored {grown:e}, done {done:e}, off by {:e}",
                    grown / done - 1.0
                );
            }
        }
    }
}

/// Nothing jumps as the contact runs over the edge: approach, and its rate along the flank less the geometric d^2/(2 R)
/// that the least gap takes over past the edge.
#[test]
fn smooth_over_the_edge() {
    for edge_radius in [0.0, 0.05, 0.3] {
        for load in [1.0, 50.0, 300.0] {
            let at = |d: f64| contact(d, edge_radius).under(load).approach;
            let (mut last, mut rate_before) = (at(-0.6), None::<f64>);
            let h = 2e-4;
            for i in 1..=6000 {
                let d = -0.6 + h * f64::from(i);
                let now = at(d);
                let rate = (now - last) / h;
                if let Some(before) = rate_before {
                    // 1/R is the change of rate that the change of reference at d = 0 brings; the rest is curvature.
                    let jump = (rate - before).abs();
                    assert!(
                        jump < 1e-3 + 2.0 * h / RADIUS,
                        "r {edge_radius}, F' {load}, d {d}: rate jumps by {jump:e} from {before:e}"
                    );
                }
                (last, rate_before) = (now, Some(rate));
            }
        }
    }
}

/// An edge radius of nothing is a sharp edge.
#[test]
fn small_radius_is_sharp() {
    for distance in [-0.2, -0.02, 0.0, 0.04, 0.2] {
        let [sharp, rounded] = [0.0, 1e-7].map(|r| contact(distance, r).under(100.0).approach);
        assert!((sharp / rounded - 1.0).abs() < 2e-3, "{distance}: {sharp:e}, {rounded:e}");
    }
}

/// Only the ratio of lengths counts: geometry times s and F' times s give the approach times s.
#[test]
fn scales_as_elasticity_does() {
    for distance in [-0.1, 0.05, 2.0] {
        let (small, s) = (contact(distance, 0.1), 8.0);
        let mut large = small.clone();
        large.radius *= s;
        large.off_line *= s;
        for b in &mut large.bodies {
            b.depth *= s;
            b.tip_distance *= s;
            b.tip_gradient /= s;
            b.edge_radius *= s;
            b.ends.iter_mut().for_each(|e| e.distance *= s);
        }
        let (a, b) = (small.under(80.0).approach, large.under(80.0 * s).approach / s);
        assert!((a / b - 1.0).abs() < 1e-12, "{distance}: {a:e}, {b:e}");
    }
}

/// A rounded edge lies behind the sharp corner: the gap is wider near it, the same away from it.
#[test]
fn rounding_opens_the_gap() {
    assert_eq!(contact(1.0, 0.1).edge_opening(), 0.0);
    assert_eq!(contact(0.0, 0.0).edge_opening(), 0.0);
    assert!(
        contact(0.0, 0.1).edge_opening() > 1e-4 && contact(-0.1, 0.1).edge_opening() > contact(0.0, 0.1).edge_opening()
    );
}

/// However heavy the load and thin the layer, more approach takes more load, and the slope is that of the approach up to
/// loads that steel stands: pointed tips come to bands as wide as they are deep.
#[test]
fn no_load_makes_a_thin_layer_pull() {
    for depth in [0.05, 0.2, 1.0] {
        let mut thin = contact(0.1, 0.0);
        thin.bodies[0].depth = depth;
        let law = thin.law();
        let mut before = 0.0;
        for step in 0..60 {
            let load = 1.0 * 1.25f64.powi(step);
            let state = law.under(load);
            assert!(state.slope > 0.0, "depth {depth}, {load} N/mm: slope {}", state.slope);
            assert!(state.approach > before, "depth {depth}, {load} N/mm: approach {} after {before}", state.approach);
            before = state.approach;
            let h = 1e-5 * load;
            let difference = (law.under(load + h).approach - law.under(load - h).approach) / (2.0 * h);
            if state.pressure < 3000.0 {
                let off = (state.slope / difference - 1.0).abs();
                assert!(off < 1e-6, "depth {depth}, {load} N/mm: slope {} and difference {difference}", state.slope);
            }
        }
    }
}
