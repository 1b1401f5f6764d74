//! Local compliance of a line contact: what the mesh of a gear is too coarse to know. Theory (19c).

mod deviation;
mod edge;
mod end_face;
mod layer;

use std::f64::consts::PI;

use crate::line::hertz;
pub use deviation::BandMean;
pub(crate) use deviation::SAMPLES;
use edge::Edge;
pub use edge::wedge_softening;
pub use end_face::EndFace;
pub use layer::layer_constant;

/// One of the two flanks where they touch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LocalBody {
    /// Young's modulus, MPa.
    pub young: f64,
    /// Poisson's ratio.
    pub poisson: f64,
    /// Constant c of the layer at this place, without what the tip edge adds: from `reduction::LayerProfile`;
    /// [`layer_constant`] for a layer without ends (`tip_angle` PI).
    pub layer: f64,
    /// Depth t of the layer, mm: from the flank to the centre surface of its tooth.
    pub depth: f64,
    /// Distance d from the contact to the tip edge along the profile, mm, the sharp corner even where it is rounded; 0
    /// when the edge itself touches.
    pub tip_distance: f64,
    /// Angle between flank and tip land, inside the material, rad; PI where there is no edge.
    pub tip_angle: f64,
    /// d/dx [c + (1 + eta) ln t] at the tip, x the distance from the edge, 1/mm: the band of an edge contact lies a
    /// little inside the edge.
    pub tip_gradient: f64,
    /// Radius of the arc that rounds the tip edge, tangent to flank and tip land, mm; 0: sharp.
    pub edge_radius: f64,
    /// The two end faces of the gear.
    pub ends: [EndFace; 2],
}

/// Line contact of two flanks at one axial station.
#[derive(Debug, Clone, PartialEq)]
pub struct LocalContact {
    /// Bodies of both flanks.
    pub bodies: [LocalBody; 2],
    /// Relative radius of curvature in the normal plane, mm.
    pub radius: f64,
    /// How far past the tip edge the smooth flanks would touch, mm of arc of the edge's own flank continued; 0 on the
    /// line of action. The edge is that of the body with the smaller `tip_distance`.
    ///
    /// It is radius times the angle (rad) at which the flanks recede from each other at the edge.
    pub off_line: f64,
    /// What the band sees of flanks that deviate from their smooth surfaces, `None` where they do not; m(0) is part of the gap, not of the approach.
    pub deviation: Option<Box<BandMean>>,
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

impl LocalContact {
    /// State under a line load q (N/mm), per unit length of contact line.
    ///
    /// ```text
    /// delta = sum over both flanks of K_b q [ln(2 t / a) + 1/2 + c + E + eta ln(t / l) + g (l - d)] + (K_1 + K_2) q P
    ///         + m(a) - m(0)
    /// K_b = 2 (1 - nu^2) / (pi E)
    /// ```
    /// a: half-width after Hertz; c: [`LocalBody::layer`]; E: softening by the end faces; eta: [`wedge_softening`]; l:
    /// distance between load and tip edge, d where the band is narrow; g: [`LocalBody::tip_gradient`]; P: what is lost
    /// where the edge cuts the band off; m: [`BandMean`]. All continuous with their slopes, from the middle of the flank to an edge far
    /// off the line of action. Without load, all is 0 and the slope is that of a load small enough not to matter.
    pub fn under(&self, load: f64) -> LocalState {
        self.law().under(load)
    }

    /// All of it that does not depend on the load.
    pub fn law(&self) -> LocalLaw {
        let modulus = hertz::effective_modulus(self.bodies.map(|b| (b.young, b.poisson)));
        let edges = self.edges();
        let bodies = [0, 1].map(|i| {
            let (body, edge) = (&self.bodies[i], edges[i]);
            BodyLaw {
                softness: body.softness(),
                depth_term: (2.0 * body.depth).ln() + 0.5 + body.layer,
                ln_depth: body.depth.ln(),
                eta: edge.softening(),
                edge,
                tip_gradient: body.tip_gradient,
                tip_distance: body.tip_distance,
                ends: body.ends.map(|face| end_face::Softening::new(&face, body.poisson, body.depth)),
                face_distance: body.ends[0].distance.min(body.ends[1].distance),
            }
        });
        LocalLaw { modulus, radius: self.radius, bodies, deviation: self.deviation.clone() }
    }

    /// What rounding the edge adds to the gap between the sharp flanks, mm: the arc lies behind the corner that it
    /// replaces. 0 without an edge radius and away from the edge.
    pub fn edge_opening(&self) -> f64 {
        self.edges().iter().map(Edge::opening).sum()
    }

    fn edges(&self) -> [Edge; 2] {
        let [first, second] = self.bodies.map(|b| b.tip_distance);
        let past = if first <= second { [self.off_line, 0.0] } else { [0.0, self.off_line] };
        [0, 1].map(|i| {
            let body = &self.bodies[i];
            Edge {
                distance: body.tip_distance - past[i],
                angle: body.tip_angle,
                arc: body.edge_radius.max(0.0),
                radius: self.radius,
            }
        })
    }
}

/// A [`LocalContact`] ready to be loaded: for many loads at one place.
#[derive(Debug, Clone)]
pub struct LocalLaw {
    modulus: f64,
    radius: f64,
    bodies: [BodyLaw; 2],
    deviation: Option<Box<BandMean>>,
}

/// Distances from edges and end faces, in radii of curvature (the half-width is 2 p / E* of it, a fortieth), from which
/// on what they add goes with the square of the half-width.
const FAR_EDGE: f64 = 0.5;
const FAR_FACE: f64 = 0.2;
/// Points and weights on 0 .. 1 that integrate x times any cubic, and four orders more, exactly (Gauss and Jacobi;
/// Abramowitz and Stegun, table 25.8).
const JACOBI: [(f64, f64); 4] = [
    (0.139_759_864_343_780_55, 0.031_180_970_950_008_08),
    (0.416_409_567_631_083_2, 0.129_847_547_608_232_44),
    (0.723_156_986_361_876_2, 0.203_464_568_010_271_36),
    (0.942_895_803_885_482_3, 0.135_506_913_431_488_1),
];

/// One body's part of it.
#[derive(Debug, Clone, Copy)]
struct BodyLaw {
    /// K, mm^2/N.
    softness: f64,
    /// ln(2 t) + 1/2 + c.
    depth_term: f64,
    ln_depth: f64,
    eta: f64,
    edge: Edge,
    tip_gradient: f64,
    tip_distance: f64,
    ends: [end_face::Softening; 2],
    /// Distance of the nearer end face, mm.
    face_distance: f64,
}

impl LocalLaw {
    /// State under a line load q (N/mm): see [`LocalContact::under`].
    pub fn under(&self, load: f64) -> LocalState {
        let least = self.least();
        let q = load.max(least);
        let half_width = hertz::half_width(q, self.radius, self.modulus);
        let (bracket, growth) = self.bracket(half_width);
        // a grows with the square root of q.
        let (mut approach, mut slope) = (q * bracket, bracket + 0.5 * growth);
        if let Some(deviation) = &self.deviation {
            // a^2 grows with q.
            let (change, by_load) = deviation.change(deviation.share(half_width));
            (approach, slope) = (approach + change, slope + by_load / q);
        }
        let slope = slope.max(LEAST_SLOPE * (self.bodies[0].softness + self.bodies[1].softness));
        if load < least {
            return LocalState { approach: approach * (load / least).max(0.0), slope, ..LocalState::default() };
        }
        LocalState { approach, slope, half_width, pressure: hertz::line_pressure(q, self.radius, self.modulus) }
    }

    /// Energy of a line load `load` q (N/mm) per length of contact line beyond half of load times approach, N mm/mm, <=
    /// 0 on a flank: its slope falls as the load grows.
    ///
    /// ```text
    /// q delta / 2 - int_0^q delta dq' = -q^2 int_0^1 x [B(a sqrt x) - B(a)] dx,   delta = q B(a)
    /// B = -(K_1 + K_2) ln a + R(a):   the logarithm leaves (K_1 + K_2) / 8, R by quadrature,
    ///     or -R' / 12 (R' = dR / d ln a) where it goes with a^2, far from any edge
    /// ```
    /// So strain energy is the integral of the very law, and forces are its derivatives: to 1e-7 of it next to edges,
    /// else to round-off.
    pub fn curved_energy(&self, load: f64) -> f64 {
        let least = self.least();
        if load <= least {
            return 0.0;
        }
        let a = hertz::half_width(load, self.radius, self.modulus);
        let both = self.bodies[0].softness + self.bodies[1].softness;
        let (value, growth) = self.bracket(a);
        let of_rest = if self.is_far() {
            -(growth + both) / 12.0
        } else {
            let added = |x: f64| self.bracket(a * x.sqrt()).0 - value + 0.5 * both * x.ln();
            JACOBI.iter().map(|(x, w)| w * added(*x)).sum()
        };
        let curved = -load * load * (both / 8.0 + of_rest);
        let Some(deviation) = &self.deviation else { return curved };
        let t = deviation.share(a);
        curved + load * (deviation.mean_change(t) - 0.5 * deviation.change(t).0)
    }

    /// Load of a band of half-width a (mm), N/mm.
    pub(crate) fn load_of(&self, half_width: f64) -> f64 {
        0.25 * PI * self.modulus * half_width * half_width / self.radius
    }

    /// Whether edges and faces are many half-widths away under any load that steel stands.
    fn is_far(&self) -> bool {
        let far = |body: &BodyLaw| {
            let off_edge = body.eta == 0.0 || body.edge.flank_left() > FAR_EDGE * self.radius;
            off_edge && body.face_distance > FAR_FACE * self.radius
        };
        self.bodies.iter().all(far)
    }

    /// A load so small that it does not matter, N/mm: the compliance of a vanishing one is infinite, if only as a
    /// logarithm.
    fn least(&self) -> f64 {
        1e-15 * self.modulus * self.radius
    }

    /// Approach over load (mm^2/N) and its derivative by ln a.
    fn bracket(&self, a: f64) -> (f64, f64) {
        let both = self.bodies[0].softness + self.bodies[1].softness;
        let ln_a = a.ln();
        let (mut value, mut growth) = (0.0, 0.0);
        for body in &self.bodies {
            let (k, eta) = (body.softness, body.eta);
            let (deeper, share) = body.depth_beyond(ln_a);
            value += k * (body.depth_term + deeper - ln_a);
            growth += k * (share - 1.0);
            for face in &body.ends {
                let (soft, dsoft) = face.at(a);
                value += k * soft;
                growth += k * dsoft;
            }
            if eta > 0.0 {
                let (cut, dcut) = body.edge.cut_off(a);
                let (inside, dln_l) = body.edge.reach(a, eta * k / both);
                let moved = body.tip_gradient * (inside - body.tip_distance);
                value += k * (eta * (body.ln_depth + deeper - inside.ln()) + moved) + both * cut;
                growth += k * (dln_l * (body.tip_gradient * inside - eta) + eta * share) + both * dcut;
            }
        }
        (value, growth)
    }
}

/// Logarithm of half-width over depth, either way of 0, within which a layer that is compressed evenly takes over from
/// one that is deep beside the band.
const TAKES_OVER: f64 = 0.5;
/// Slope of the approach, at least, over K_1 + K_2: a tenth of what it is under the heaviest loads that steel stands.
/// Loads beyond come up only while a solution is sought, and must not make the contact pull.
const LEAST_SLOPE: f64 = 0.05;

impl BodyLaw {
    /// By how much the logarithm of the depth grows for a band of half-width a, and the derivative of that by ln a.
    ///
    /// ```text
    /// y = ln(a/t):   0 for y < -w,   (y + w)^2 / (4 w) up to w,   y beyond;   w = 1/2
    /// ```
    /// The logarithmic law is that of a band that is narrow beside the depth; it would have no stiffness left at a = 1.2
    /// t and pull beyond. Under a wide band a thin layer is compressed evenly instead, with dq/d delta about E / 0.37
    /// from a = t on (nu 0.3), which is what the law has at depth a. Pointed tips under heavy load come to that; below a
    /// = 0.6 t nothing changes.
    fn depth_beyond(&self, ln_a: f64) -> (f64, f64) {
        let y = ln_a - self.ln_depth;
        let within = (y + TAKES_OVER).clamp(0.0, 2.0 * TAKES_OVER);
        let past = (y - TAKES_OVER).max(0.0);
        (within * within / (4.0 * TAKES_OVER) + past, within / (2.0 * TAKES_OVER))
    }
}

impl LocalBody {
    /// K of this body, mm^2/N.
    fn softness(&self) -> f64 {
        2.0 * (1.0 - self.poisson * self.poisson) / (PI * self.young)
    }
}
