//! Contact near a tip edge, at it, and past it.
//!
//! Near its tip a tooth is a wedge. With x the distance from the edge along the flank, in half-widths a of the Hertzian
//! band that the same load would make far from the edge, the band lies where the gap (x - D)^2 a^2 / (2 R), x > 0, is
//! closed: D > 1 on the flank, -1 < D < 1 cut off by the edge, D < 0 with the edge off the line of action (the flanks
//! recede from each other by the angle -D a / R there). A force on the flank of a wedge dents it by
//!
//! ```text
//! u(x; s) = K q [-ln|x - s| - eta/2 ln(x s) + G(ln(x/s))] + const,   K = 2 (1 - nu^2) / (pi E)
//! G(y) = 2 int_0^inf [L(w) - coth(pi w) / (2 w)] (cos(w y) - 1) dw
//! L(w) = [(cosh(O w) - cos O) / (sinh(O w) + w sin O) + (cosh(O w) + cos O) / (sinh(O w) - w sin O)] / (4 w)
//! ```
//! O: the wedge's angle (Mellin transform of the elastic wedge). Solving this contact for wedge angles of 95 to 150
//! degrees and mates of any stiffness shows that approach depends on D and on the one number e = eta K / (K + K') alone
//! (K' of the mate), and that it parts into what the missing half of the band costs and what the wedge's softness
//! costs:
//!
//! ```text
//! approach = (K + K') q [ln(2/a) + 1/2 + P(D) - e ln(a l(D, e))],   a l: distance of the load from the edge
//! ```
//! P is exact ([`cut_off`]), l a fit to the solved contact ([`reach`]); together within 0.02 of the bracket for e <
//! 0.4, 0.05 for e < 1.3, -10 < D (`crates/contact/tests/contact_laws/local_approach.rs`).
//!
//! An edge rounded by an arc of radius r, tangent to flank and tip land, softens the tooth exactly as the sharp corner
//! would from which the arc was cut (resolved by finite elements: 0.5 %), but the flank ends at the tangent point, and
//! beyond it the gap opens with the arc's curvature as well.

use std::f64::consts::PI;

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

/// A value and its derivative by D.
type Dual = (f64, f64);

/// P(D) of a half-space whose flank ends at x = 0: 0 for D >= 1, measured from the least gap.
///
/// ```text
/// c = 2 / (sqrt(D^2 + 3) - D),   e = c/2 - D
/// P = -ln(c/2) - 1/2 - c^2/8 + c e + max(D, 0)^2
/// ```
/// Band 0 < x < c, pressure proportional to sqrt((c - x)/x) (x + e): the smooth flank of one body on a sharp edge of
/// the other, both with the kernel of a half-plane. P ~ ln|D| + 1 + ln 2 - 1/2 for D << 0, where the flanks meet at a
/// constant angle.
fn cut_off(d: f64) -> Dual {
    if d >= 1.0 {
        return (0.0, 0.0);
    }
    let root = (d * d + 3.0).sqrt();
    let c = 2.0 / (root - d);
    let dc = c / root;
    let (e, de) = (0.5 * c - d, 0.5 * dc - 1.0);
    let past = d.max(0.0);
    let value = -(0.5 * c).ln() - 0.5 - c * c / 8.0 + c * e + past * past;
    (value, -dc / c - 0.25 * c * dc + dc * e + c * de + 2.0 * past)
}

/// [`cut_off`] by an arc of relative curvature `m` (1 / r to 1 / R) instead of a sharp end.
///
/// ```text
/// exp(-2 P_m) = exp(-2 P) + (1 - exp(-2 P)) / (1 + m)
/// ```
/// Exact on the flank (D > 1) and on the arc (D << 0, a Hertzian band of radius 1 / (1/R + 1/r)); 0.06 off in between.
fn cut_off_by_arc(d: f64, m: f64) -> Dual {
    let (sharp, slope) = cut_off(d);
    let open = (-2.0 * sharp).exp();
    let both = open + (1.0 - open) / (1.0 + m);
    let part = open * m / (1.0 + m) / both;
    (-0.5 * both.ln(), slope * part)
}

/// l(D, e), half-widths: how far from the edge the load acts on average (geometric mean). Tends to D on the flank.
///
/// ```text
/// l = z/2 + sqrt(b^2 + z^2/4),   z = D - d0 / (1 + (max(D, 0) / 2.29)^2)
/// d0 = 0.462 - 0.057 e,   b = 0.566 + 0.181 e - 0.028 e^2
/// ```
fn reach(d: f64, e: f64) -> Dual {
    // The fit covers wedges down to 95 degrees; past that it is held.
    let e = e.clamp(0.0, 1.5);
    let (d0, b) = (0.462 - 0.057 * e, 0.566 + 0.181 * e - 0.028 * e * e);
    let on = d.max(0.0) / 2.29;
    let fading = 1.0 + on * on;
    let (z, dz) = (d - d0 / fading, 1.0 + d0 * 2.0 * on / 2.29 / (fading * fading));
    let root = (b * b + 0.25 * z * z).sqrt();
    let value = if z > 0.0 { 0.5 * z + root } else { b * b / (root - 0.5 * z) };
    (value, 0.5 * dz * value / root)
}

/// Tip edge of one body, and where the band lies to it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Edge {
    /// Distance d of the contact from the sharp corner along the flank, mm; negative when the flanks would meet past
    /// it.
    pub distance: f64,
    /// Angle between flank and tip land, rad.
    pub angle: f64,
    /// Radius r of the arc that rounds the edge, mm; 0: sharp.
    pub arc: f64,
    /// Relative radius of curvature R of the two flanks, mm.
    pub radius: f64,
}

impl Edge {
    /// eta >= 0.
    pub fn softening(&self) -> f64 {
        if self.angle < PI { wedge_softening(self.angle).max(0.0) } else { 0.0 }
    }

    /// Distance of the arc's tangent point from the corner: r tan((PI - omega) / 2), mm.
    fn tangent_point(&self) -> f64 {
        // Most edges are sharp: no tangent is taken for these.
        if self.arc > 0.0 && self.angle < PI { self.arc * (0.5 * (PI - self.angle)).tan() } else { 0.0 }
    }

    /// Distance of the contact from where the flank ends, mm.
    pub fn flank_left(&self) -> f64 {
        self.distance - self.tangent_point()
    }

    /// P and its derivative by ln a, for a half-width `a`.
    pub fn cut_off(&self, a: f64) -> Dual {
        if self.angle >= PI {
            return (0.0, 0.0);
        }
        let d = (self.distance - self.tangent_point()) / a;
        let (value, slope) = if self.arc > 0.0 { cut_off_by_arc(d, self.radius / self.arc) } else { cut_off(d) };
        (value, -slope * d)
    }

    /// Distance (mm) between load and corner, and the derivative of its logarithm by ln a; `e` as in [`reach`].
    pub fn reach(&self, a: f64, e: f64) -> Dual {
        let tangent = self.tangent_point();
        let from = self.distance - tangent;
        // Past the tangent point the band moves along the arc towards the corner.
        let moved = if self.arc > 0.0 { (-from).max(0.0) / (1.0 + self.radius / self.arc) } else { 0.0 };
        let start = if tangent > 0.0 { tangent * tangent / (tangent + moved) } else { 0.0 };
        let d = from / a;
        let (l, slope) = reach(d, e);
        let distance = start + a * l;
        (distance, a * (l - slope * d) / distance)
    }

    /// What the arc takes away from under the least gap, mm: the gap to the rounded edge less that to the sharp one.
    pub fn opening(&self) -> f64 {
        let from = (self.distance - self.tangent_point()).min(0.0);
        if self.arc <= 0.0 || self.angle >= PI || from == 0.0 {
            return 0.0;
        }
        let past = self.distance.min(0.0);
        let m = self.radius / self.arc;
        ((from * from * m / (1.0 + m) - past * past) / (2.0 * self.radius)).max(0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A straight angle is no edge.
    #[test]
    fn half_space_has_no_edge() {
        assert!(wedge_softening(PI).abs() < 1e-15);
        assert!((wedge_softening(118.65f64.to_radians()) - 0.473).abs() < 1e-3);
    }

    /// Half of a band cut away, by quadrature of its pressure: 0.5493; a band just inside the edge loses nothing, to
    /// first order.
    #[test]
    fn what_a_cut_band_costs() {
        assert!((cut_off(0.0).0 - 0.549_306).abs() < 1e-6, "{}", cut_off(0.0).0);
        let (value, slope) = cut_off(1.0 - 1e-9);
        assert!(value.abs() < 1e-15 && slope.abs() < 1e-8, "{value:e} {slope:e}");
        let far = cut_off(-1e4).0 - (1e4f64.ln() + 0.5 + 2.0f64.ln());
        assert!(far.abs() < 1e-7, "{far}");
    }

    /// Far round the arc the band is Hertz's for the arc's own curvature beside the mate's, 1/R + 1/r: narrower by
    /// sqrt(1 + R/r), so its approach is larger by half a logarithm of that. On the flank the arc costs nothing.
    #[test]
    fn round_the_arc_the_band_is_that_of_its_curvature() {
        for m in [0.5, 4.0, 50.0] {
            let (far, _) = cut_off_by_arc(-1e7, m);
            assert!((far - 0.5 * f64::ln(1.0 + m)).abs() < 1e-9, "R/r {m}: {far}");
            assert_eq!(cut_off_by_arc(2.0, m).0, 0.0);
        }
    }

    /// The arc touches the flank and the tip land: its centre, one radius above the tangent point, is one radius from
    /// the land as well.
    #[test]
    fn the_arc_is_tangent_to_flank_and_land() {
        for degrees in [95.0f64, 118.0, 150.0] {
            let angle = degrees.to_radians();
            let edge = Edge { distance: 1.0, angle, arc: 0.3, radius: 5.0 };
            // Corner at the origin, flank along +x, material above; the land leaves the corner at the edge's angle.
            let centre = [edge.tangent_point(), edge.arc];
            let from_land = (centre[0] * angle.sin() - centre[1] * angle.cos()).abs();
            assert!((from_land - edge.arc).abs() < 1e-12, "{degrees} deg: {from_land} mm from the land");
        }
    }

    /// Derivatives by ln a are derivatives, sharp and rounded; to 1e-6, as at d = a the second one jumps.
    #[test]
    fn slopes_are_slopes() {
        for arc in [0.0, 0.05, 0.3] {
            for distance in [-2.0, -0.3, -0.05, -1e-3, 0.0, 0.02, 0.08, 0.15, 0.5, 3.0] {
                let edge = Edge { distance, angle: 2.0, arc, radius: 5.0 };
                for a in [0.02f64, 0.1, 0.3] {
                    let h = 1e-6;
                    let (up, down) = (a * f64::exp(h), a * f64::exp(-h));
                    let check = |what: &str, slope: f64, wanted: f64| {
                        assert!((slope - wanted).abs() < 1e-6, "{what} {edge:?} a {a}: {slope}, not {wanted}");
                    };
                    check("P", edge.cut_off(a).1, (edge.cut_off(up).0 - edge.cut_off(down).0) / (2.0 * h));
                    let reach = |a: f64| edge.reach(a, 0.24).0.ln();
                    check("l", edge.reach(a, 0.24).1, (reach(up) - reach(down)) / (2.0 * h));
                }
            }
        }
    }
}
