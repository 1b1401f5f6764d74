//! Contact near a tip edge, at it, and beyond it.
//!
//! Near its tip a tooth is a wedge. Let x be the distance from the edge along the flank, in half-widths a of the
//! Hertzian band that the same load would make far from the edge. The band lies where the gap (x - D)^2 a^2 / (2 R) is
//! closed, for positive x: D > 1 on the flank; -1 < D < 1 cut off by the edge; D < 0 with the edge off the line of action
//! (there the flanks diverge by the angle -D a / R). A force on the flank of a wedge indents it by
//!
//! ```text
//! u(x; s) = K q [-ln|x - s| - eta/2 ln(x s) + G(ln(x/s))] + const,   K = 2 (1 - nu^2) / (pi E)
//! G(y) = 2 int_0^inf [L(w) - coth(pi w) / (2 w)] (cos(w y) - 1) dw
//! L(w) = [(cosh(O w) - cos O) / (sinh(O w) + w sin O) + (cosh(O w) + cos O) / (sinh(O w) - w sin O)] / (4 w)
//! ```
//! O is the wedge's angle (Mellin transform of the elastic wedge). This contact was solved for wedge angles of 95 to
//! 150 degrees and mates of any stiffness. The approach depends only on D and on the number e = eta K / (K + K') (K' of
//! the mate). It splits into the effect of the missing part of the band and the effect of the wedge's softness:
//!
//! ```text
//! approach = (K + K') q [ln(2/a) + 1/2 + P(D) - e ln(a l(D, e))],   a l: distance of the load from the edge
//! ```
//! P is exact ([`cut_off`]); l is a fit to the solved contact ([`reach`]). Together they are within 0.02 of the bracket
//! for e < 0.4, within 0.05 for e < 1.3, -10 < D (`crates/contact/tests/contact_laws/local_approach.rs`).
//!
//! An edge may be rounded by an arc of radius r, tangent to flank and tip land. It softens the tooth exactly as the
//! sharp corner from which the arc was cut (resolved by finite elements: 0.5 %). But the flank ends at the tangent
//! point, and beyond it the curvature of the arc opens the gap further.

use std::f64::consts::PI;

use pulp::Simd;

use crate::lanes::{Four, LANES};

/// Wedge of angle omega compared with a half-space: how much faster its compliance grows with the logarithm of
/// distance.
///
/// ```text
/// eta = pi [sin^2(omega/2) / (omega + sin omega) + cos^2(omega/2) / (omega - sin omega)] - 1
/// ```
/// Derived from the energy of the radial stress field of a force at the tip of a wedge, normal to one face; 0 for omega
/// = PI.
pub fn wedge_softening(omega: f64) -> f64 {
    let (sin2, cos2) = ((0.5 * omega).sin().powi(2), (0.5 * omega).cos().powi(2));
    PI * (sin2 / (omega + omega.sin()) + cos2 / (omega - omega.sin())) - 1.0
}

/// A value and its derivative by D.
type Dual<T> = (T, T);

/// P(D) of a half-space whose flank ends at x = 0: 0 for D >= 1, measured from the least gap.
///
/// ```text
/// c = 2 / (sqrt(D^2 + 3) - D),   e = c/2 - D
/// P = -ln(c/2) - 1/2 - c^2/8 + c e + max(D, 0)^2
/// ```
/// Band 0 < x < c, pressure proportional to sqrt((c - x)/x) (x + e): the smooth flank of one body on a sharp edge of
/// the other, both with the kernel of a half-plane. P ~ ln|D| + 1 + ln 2 - 1/2 for D << 0, where the flanks meet at a
/// constant angle.
#[inline(always)]
fn cut_off<S: Simd>(simd: S, d: Four<S>) -> Dual<Four<S>> {
    let of = |x: f64| Four::splat(simd, x);
    let (zero, half) = (of(0.0), of(0.5));
    // Further in it is 0.
    let within = d.min(of(1.0));
    let root = (within * within + of(3.0)).sqrt();
    let c = of(2.0) / (root - within);
    let dc = c / root;
    let (e, de) = (half * c - within, half * dc - of(1.0));
    let past = within.max(zero);
    let value = c * e - (half * c).ln() - half - c * c / of(8.0) + past * past;
    let slope = dc * e + c * de - dc / c - of(0.25) * c * dc + of(2.0) * past;
    (d.below(of(1.0), value, zero), d.below(of(1.0), slope, zero))
}

/// [`cut_off`] by an arc of relative curvature `m` (1 / r to 1 / R) instead of a sharp end.
///
/// ```text
/// exp(-2 P_m) = exp(-2 P) + (1 - exp(-2 P)) / (1 + m)
/// ```
/// Exact on the flank (D > 1) and on the arc (D << 0, a Hertzian band of radius 1 / (1/R + 1/r)); 0.06 off in between.
///
/// `sharp`: P and its slope; `rest`: 1 / (1 + m).
#[inline(always)]
fn cut_off_by_arc<S: Simd>(simd: S, (sharp, slope): Dual<Four<S>>, rest: Four<S>) -> Dual<Four<S>> {
    let of = |x: f64| Four::splat(simd, x);
    let [open, less] = (of(-2.0) * sharp).exp();
    let both = open - less * rest;
    (of(-0.5) * both.ln(), slope * open * (of(1.0) - rest) / both)
}

/// l(D, e), half-widths: how far from the edge the load acts on average (geometric mean). Tends to D on the flank.
///
/// ```text
/// l = z/2 + sqrt(b^2 + z^2/4),   z = D - d0 / (1 + (max(D, 0) / 2.29)^2)
/// d0 = 0.462 - 0.057 e,   b = 0.566 + 0.181 e - 0.028 e^2
/// ```
/// `fit`: d0 and b^2.
#[inline(always)]
fn reach<S: Simd>(simd: S, d: Four<S>, [d0, b2]: [Four<S>; 2]) -> Dual<Four<S>> {
    let of = |x: f64| Four::splat(simd, x);
    let (zero, half) = (of(0.0), of(0.5));
    let on = d.max(zero) * of(1.0 / 2.29);
    let faded = of(1.0) / (of(1.0) + on * on);
    let (z, dz) = (d - d0 * faded, of(1.0) + d0 * of(2.0 / 2.29) * on * faded * faded);
    let half_z = half * z;
    let root = (b2 + half_z * half_z).sqrt();
    let value = zero.below(z, half_z + root, b2 / (root - half_z));
    (value, half * dz * value / root)
}

/// d0 and b^2 of [`reach`] for e; the fit covers wedges down to 95 degrees, past that it is held.
fn reach_fit(e: f64) -> [f64; 2] {
    let e = e.clamp(0.0, 1.5);
    [0.462 - 0.057 * e, (0.566 + 0.181 * e - 0.028 * e * e).powi(2)]
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
    /// Distance of the arc's tangent point from the corner: r tan((PI - omega) / 2), mm.
    fn tangent_point(&self) -> f64 {
        // Most edges are sharp: no tangent is taken for these.
        if self.arc > 0.0 && self.angle < PI { self.arc * (0.5 * (PI - self.angle)).tan() } else { 0.0 }
    }

    /// Distance from the contact to the end of the flank, mm.
    pub fn flank_left(&self) -> f64 {
        self.distance - self.tangent_point()
    }

    /// Increase of the smallest gap by the rounding, mm: the gap to the rounded edge minus that to the sharp one.
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

/// Edges of four rows as bands see them.
#[derive(Debug, Clone)]
pub(super) struct FourEdges {
    /// Distance of the contact from where the flank ends, mm.
    from: [f64; LANES],
    /// Distance of the corner from where the band begins to move towards it, mm: 0 of a sharp edge.
    start: [f64; LANES],
    /// 1 / (1 + R/r): 0 of a sharp edge.
    rest: [f64; LANES],
    /// d0 and b^2 of [`reach`].
    fit: [[f64; LANES]; 2],
}

impl Default for FourEdges {
    fn default() -> Self {
        Self { from: [1.0; LANES], start: [0.0; LANES], rest: [0.0; LANES], fit: [[1.0; LANES]; 2] }
    }
}

impl FourEdges {
    /// Sets the edge of one row; `e` as in [`reach`]. `None` stands for an edge that no band comes near.
    #[inline(always)]
    pub fn put(&mut self, lane: usize, edge: Option<&Edge>, e: f64) {
        let tangent = edge.map_or(0.0, Edge::tangent_point);
        let from = edge.map_or(f64::MAX.sqrt().sqrt(), |edge| edge.distance - tangent);
        let rest = edge.filter(|edge| edge.arc > 0.0).map_or(0.0, |edge| 1.0 / (1.0 + edge.radius / edge.arc));
        // Past the tangent point the band moves along the arc towards the corner.
        let moved = (-from).max(0.0) * rest;
        self.from[lane] = from;
        self.start[lane] = if tangent > 0.0 { tangent * tangent / (tangent + moved) } else { 0.0 };
        self.rest[lane] = rest;
        self.fit.iter_mut().zip(reach_fit(e)).for_each(|(all, own)| all[lane] = own);
    }

    /// P and its derivative by ln a, for half-widths `a`; `None` if no band is cut off.
    #[inline(always)]
    pub fn cut_off<S: Simd>(&self, simd: S, a: Four<S>) -> Option<Dual<Four<S>>> {
        let from = Four::new(simd, &self.from);
        if !from.any_below(a) {
            return None;
        }
        let (zero, d) = (Four::splat(simd, 0.0), from / a);
        let sharp = cut_off(simd, d);
        let rest = Four::new(simd, &self.rest);
        let (value, slope) = if zero.any_below(rest) {
            let by_arc = cut_off_by_arc(simd, sharp, rest);
            (zero.below(rest, by_arc.0, sharp.0), zero.below(rest, by_arc.1, sharp.1))
        } else {
            sharp
        };
        Some((value, -slope * d))
    }

    /// Distance (mm) between load and corner, and the derivative of its logarithm by ln a.
    #[inline(always)]
    pub fn reach<S: Simd>(&self, simd: S, a: Four<S>) -> Dual<Four<S>> {
        let d = Four::new(simd, &self.from) / a;
        let (l, slope) = reach(simd, d, [Four::new(simd, &self.fit[0]), Four::new(simd, &self.fit[1])]);
        let distance = Four::new(simd, &self.start) + a * l;
        (distance, a * (l - slope * d) / distance)
    }
}

#[cfg(test)]
mod tests {
    use pulp::Scalar256b;

    use super::*;

    fn one((value, slope): Dual<Four<Scalar256b>>) -> Dual<f64> {
        (value.array()[0], slope.array()[0])
    }

    fn cut_off(d: f64) -> Dual<f64> {
        one(super::cut_off(Scalar256b, Four::splat(Scalar256b, d)))
    }

    fn cut_off_by_arc(d: f64, m: f64) -> Dual<f64> {
        let of = |x: f64| Four::splat(Scalar256b, x);
        one(super::cut_off_by_arc(Scalar256b, super::cut_off(Scalar256b, of(d)), of(1.0 / (1.0 + m))))
    }

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
                let mut four = FourEdges::default();
                (0..LANES).for_each(|lane| four.put(lane, Some(&edge), 0.24));
                let cut_off = |a: f64| four.cut_off(Scalar256b, Four::splat(Scalar256b, a)).map_or((0.0, 0.0), one);
                let reach = |a: f64| one(four.reach(Scalar256b, Four::splat(Scalar256b, a)));
                for a in [0.02f64, 0.1, 0.3] {
                    let h = 1e-6;
                    let (up, down) = (a * f64::exp(h), a * f64::exp(-h));
                    let check = |what: &str, slope: f64, wanted: f64| {
                        assert!((slope - wanted).abs() < 1e-6, "{what} {edge:?} a {a}: {slope}, not {wanted}");
                    };
                    check("P", cut_off(a).1, (cut_off(up).0 - cut_off(down).0) / (2.0 * h));
                    check("l", reach(a).1, (reach(up).0.ln() - reach(down).0.ln()) / (2.0 * h));
                }
            }
        }
    }
}
