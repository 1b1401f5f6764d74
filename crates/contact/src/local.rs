//! Local compliance of a line contact: what the mesh of a gear is too coarse to know.

use std::f64::consts::PI;

use crate::hertz;

/// One of the two flanks where they touch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LocalBody {
    /// Young's modulus, MPa.
    pub young: f64,
    /// Poisson's ratio.
    pub poisson: f64,
    /// Constant c_L of the bonded layer, from [`layer_constant`].
    pub layer: f64,
    /// Depth t of the layer, mm: from the flank to the centre surface of its tooth.
    pub depth: f64,
    /// Distance d from the contact to the tip edge along the profile, mm; 0 when the edge itself touches.
    pub tip_distance: f64,
    /// Angle between flank and tip land, inside the material, rad; PI where there is no edge.
    pub tip_angle: f64,
    /// Distance to the nearer end face, mm.
    pub end_distance: f64,
}

/// Line contact of two flanks at one axial station.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LocalContact {
    /// Both flanks.
    pub bodies: [LocalBody; 2],
    /// Relative radius of curvature in the normal plane, mm.
    pub radius: f64,
    /// How far the contact lies off the line of action, mm, measured along it; 0 on it.
    pub off_line: f64,
}

/// A line contact under load.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct LocalState {
    /// Approach of the two flanks, mm.
    pub approach: f64,
    /// d approach / d line load, mm^2/N.
    pub slope: f64,
    /// Half-width of the band, mm.
    pub half_width: f64,
    /// Largest pressure, MPa.
    pub pressure: f64,
}

/// Reach of the softening by a tip edge relative to the depth of the layer there.
const EDGE_REACH: f64 = 0.15;

impl LocalContact {
    /// State under a line load q (N/mm), per unit length of contact line.
    ///
    /// ```text
    /// delta = sum over both flanks of K q e [ln(2 t / a) + 1/2 + c_L + s],   K = 2 (1 - nu^2) / (pi E)
    /// e = 1 + nu^2 / (1 - nu^2) exp(-d_end / t)
    /// ```
    /// a half-width after Hertz, e softening by a free end face, s by a tip edge. Without load, all is 0 and the
    /// slope is that of a load small enough not to matter.
    pub fn under(&self, load: f64) -> LocalState {
        let modulus = hertz::effective_modulus(self.bodies.map(|b| (b.young, b.poisson)));
        // The compliance of a vanishing load is infinite, if only as a logarithm.
        let least = 1e-9 * modulus * self.radius;
        let q = load.max(least);
        let half_width = hertz::half_width(q, self.radius, modulus);
        let (mut approach, mut slope) = (0.0, 0.0);
        for body in &self.bodies {
            let (bracket, growth) = body.bracket(half_width, self.off_line);
            let k = 2.0 * (1.0 - body.poisson * body.poisson) / (PI * body.young) * body.end_factor();
            approach += k * q * bracket;
            // a grows with the square root of q.
            slope += k * (bracket + 0.5 * growth);
        }
        if load < least {
            return LocalState { approach: approach * (load / least).max(0.0), slope, ..LocalState::default() };
        }
        LocalState { approach, slope, half_width, pressure: hertz::line_pressure(q, self.radius, modulus) }
    }
}

impl LocalBody {
    /// The bracket and its derivative by ln a.
    fn bracket(&self, a: f64, off_line: f64) -> (f64, f64) {
        let inner = (2.0 * self.depth / a).ln() + 0.5 + self.layer;
        let reach = EDGE_REACH * self.depth;
        let nearest = 0.09 * a;
        let d = self.tip_distance.max(nearest);
        let softening = wedge_softening(self.tip_angle);
        if d >= reach || softening <= 0.0 {
            return (inner, -1.0);
        }
        let growth = if self.tip_distance > nearest { 0.0 } else { -softening };
        let s = softening * (reach / d).ln();
        if self.tip_distance < 1e-9 && off_line > 0.0 {
            let e = 2.0 * (off_line / a).ln() + 2.4;
            if e > s {
                return (inner + e, -3.0);
            }
        }
        (inner + s, -1.0 + growth)
    }

    fn end_factor(&self) -> f64 {
        let nu2 = self.poisson * self.poisson;
        1.0 + nu2 / (1.0 - nu2) * (-self.end_distance / self.depth).exp()
    }
}

/// How much faster than a half-space's the compliance of a wedge of angle omega grows with the logarithm of distance.
///
/// ```text
/// eta = pi [sin^2(omega/2) / (omega + sin omega) + cos^2(omega/2) / (omega - sin omega)] - 1
/// ```
/// From the energy of the radial stress field of a force at the tip of a wedge, normal to one face; 0 for omega = PI.
pub fn wedge_softening(omega: f64) -> f64 {
    let (sin2, cos2) = ((0.5 * omega).sin().powi(2), (0.5 * omega).cos().powi(2));
    PI * (sin2 / (omega + omega.sin()) + cos2 / (omega - omega.sin())) - 1.0
}

/// Constant c_L of an elastic layer bonded to a rigid base, plane strain.
///
/// ```text
/// c_L = int_0^inf [k(w) - 1 + exp(-w)] / w dw
/// k(w) = [x (1 - e^2) - 4 w e] / [x (1 + e^2) + (4 w^2 + x^2 + 1) e],   e = exp(-2 w),  x = 3 - 4 nu
/// ```
/// Far from its edges a layer of depth t sinks under a Hertzian line load q by K q [ln(2 t / a) + 1/2 + c_L].
pub fn layer_constant(poisson: f64) -> f64 {
    let x = 3.0 - 4.0 * poisson;
    let integrand = |w: f64| {
        let e = (-2.0 * w).exp();
        let k = (x * (1.0 - e * e) - 4.0 * w * e) / (x * (1.0 + e * e) + (4.0 * w * w + x * x + 1.0) * e);
        (k - 1.0 + (-w).exp()) / w
    };
    // The integrand is smooth and falls as exp(-w): Simpson to round-off. At w = 0 it is the limit of its neighbours.
    let (n, end) = (4000, 40.0);
    let h = end / f64::from(n);
    let at = |i: u32| integrand(if i == 0 { 1e-6 } else { f64::from(i) * h });
    let inner: f64 = (1..n).map(|i| if i % 2 == 1 { 4.0 * at(i) } else { 2.0 * at(i) }).sum();
    h / 3.0 * (at(0) + inner + at(n))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Bonded layer, nu 0.3: -0.5266, given with the finite-element reference of the default pair.
    #[test]
    fn layer_of_steel() {
        assert!((layer_constant(0.3) + 0.5266).abs() < 1e-4, "{}", layer_constant(0.3));
    }

    /// A straight angle is no edge.
    #[test]
    fn half_space_has_no_edge() {
        assert!(wedge_softening(PI).abs() < 1e-15);
        assert!((wedge_softening(118.65f64.to_radians()) - 0.473).abs() < 1e-3);
    }
}
