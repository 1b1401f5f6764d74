//! Local laws of four rows at once.

use std::f64::consts::{LN_2, PI};

use pulp::Simd;

use super::{
    BandMean, LocalBody, LocalContact, LocalState,
    edge::{FourEdges, wedge_softening},
    end_face::{self, FourFaces},
};
use crate::lanes::{Four, LANES};

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
/// Logarithm of half-width over depth, either way of 0, within which a layer that is compressed evenly takes over from
/// one that is deep beside the band.
const TAKES_OVER: f64 = 0.5;
/// Slope of the approach, at least, over K_1 + K_2: a tenth of what it is under the heaviest loads that steel stands.
/// Loads beyond come up only while a solution is sought, and must not make the contact pull.
const LEAST_SLOPE: f64 = 0.05;
/// A load so small that it does not matter, over E* R: the compliance of a vanishing one is infinite, if only as a
/// logarithm.
const LEAST_LOAD: f64 = 1e-15;

const ONES: [f64; LANES] = [1.0; LANES];

/// What rows of the same two flanks have in common of one body.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Constants {
    /// Young's modulus, Poisson's ratio, angle of the edge and leans of the end faces.
    key: [f64; 5],
    /// (1 - nu^2) / E, 1/MPa.
    softness: f64,
    eta: f64,
    weights: [[f64; 2]; 2],
}

impl Constants {
    fn of(&mut self, body: &LocalBody) -> &Self {
        let [first, second] = body.ends.map(|end| end.lean);
        let key = [body.young, body.poisson, body.tip_angle, first, second];
        if self.key != key {
            *self = Self {
                key,
                softness: (1.0 - body.poisson * body.poisson) / body.young,
                eta: if body.tip_angle < PI { wedge_softening(body.tip_angle).max(0.0) } else { 0.0 },
                weights: [first, second].map(|lean| end_face::weights(body.poisson, lean)),
            };
        }
        self
    }
}

/// Laws of four rows under loads per length.
#[derive(Debug, Clone)]
pub(super) struct FourLaws {
    /// Length of contact line that a row stands for, mm.
    pub length: [f64; LANES],
    /// E*, MPa.
    pub modulus: [f64; LANES],
    /// R, mm.
    pub radius: [f64; LANES],
    bodies: [FourBodies; 2],
    deviation: [Option<Box<BandMean>>; LANES],
    /// 1 where edges and faces are many half-widths away under any load that steel stands, else 0.
    far: [f64; LANES],
}

/// One body's part of four laws.
#[derive(Debug, Clone)]
struct FourBodies {
    /// K, mm^2/N.
    softness: [f64; LANES],
    depth: [f64; LANES],
    ln_depth: [f64; LANES],
    /// c.
    layer: [f64; LANES],
    eta: [f64; LANES],
    edges: FourEdges,
    tip_gradient: [f64; LANES],
    tip_distance: [f64; LANES],
    ends: [FourFaces; 2],
    /// What far end faces add, and how that grows with the square of the half-width.
    ended: [[f64; LANES]; 2],
}

impl Default for FourLaws {
    fn default() -> Self {
        Self {
            length: ONES,
            modulus: ONES,
            radius: ONES,
            bodies: Default::default(),
            deviation: Default::default(),
            far: ONES,
        }
    }
}

impl Default for FourBodies {
    fn default() -> Self {
        let nothing = [0.0; LANES];
        Self {
            softness: ONES,
            depth: ONES,
            ln_depth: nothing,
            layer: nothing,
            eta: nothing,
            edges: FourEdges::default(),
            tip_gradient: nothing,
            tip_distance: nothing,
            ends: Default::default(),
            ended: [nothing; 2],
        }
    }
}

/// [`LocalState`] of four rows.
pub(super) struct FourStates<S: Simd> {
    pub approach: Four<S>,
    pub slope: Four<S>,
    half_width: Four<S>,
    pressure: Four<S>,
}

impl FourLaws {
    /// Sets the contact of one row. [`FourLaws::complete`] must be called after all rows are set.
    pub fn put(&mut self, lane: usize, local: &LocalContact, length: f64, known: &mut [Constants; 2]) {
        // Told once, so that no place is checked.
        let lane = lane % LANES;
        let constants = [0, 1].map(|b| *known[b].of(&local.bodies[b]));
        let both = constants[0].softness + constants[1].softness;
        let edges = local.edges();
        self.length[lane] = length;
        self.modulus[lane] = 1.0 / both;
        self.radius[lane] = local.radius;
        self.deviation[lane].clone_from(&local.deviation);
        let mut far = true;
        for ((own, body), (constants, edge)) in
            self.bodies.iter_mut().zip(&local.bodies).zip(constants.iter().zip(&edges))
        {
            let has_edge = constants.eta > 0.0;
            own.softness[lane] = constants.softness * (2.0 / PI);
            own.depth[lane] = body.depth;
            own.layer[lane] = body.layer;
            own.eta[lane] = constants.eta;
            own.edges.put(lane, has_edge.then_some(edge), constants.eta * constants.softness / both);
            own.tip_gradient[lane] = if has_edge { body.tip_gradient } else { 0.0 };
            own.tip_distance[lane] = if has_edge { body.tip_distance } else { 0.0 };
            for ((face, end), weights) in own.ends.iter_mut().zip(&body.ends).zip(constants.weights) {
                face.put(lane, end.distance, weights, body.depth);
                far &= end.distance > FAR_FACE * local.radius;
            }
            far &= !has_edge || edge.flank_left() > FAR_EDGE * local.radius;
        }
        self.far[lane] = f64::from(u8::from(far));
    }

    /// Computes the derived quantities once all rows are set.
    #[inline(always)]
    pub fn complete<S: Simd>(&mut self, simd: S) {
        for body in &mut self.bodies {
            body.ln_depth = Four::new(simd, &body.depth).ln().array();
            let ([value, growth], [other, other_growth]) = (body.ends[0].far(simd), body.ends[1].far(simd));
            body.ended = [(value + other).array(), (growth + other_growth).array()];
        }
    }

    /// State under line loads q (N/mm): see [`LocalContact::under`].
    #[inline(always)]
    pub fn under<S: Simd>(&self, simd: S, load: Four<S>) -> FourStates<S> {
        let of = |x: f64| Four::splat(simd, x);
        let (least, softness) = (self.least(simd), self.softness(simd));
        let q = load.max(least);
        let [half_width, pressure] = self.hertz(simd, q);
        let (bracket, growth) = self.bracket(simd, half_width);
        // a grows with the square root of q.
        let (mut approach, mut slope) = (q * bracket, bracket + of(0.5) * growth);
        if self.deviation.iter().any(Option::is_some) {
            // a^2 grows with q.
            let width = half_width.array();
            let of_row = |i: usize| self.deviation[i].as_ref().map_or((0.0, 0.0), |d| d.change(d.share(width[i])));
            let changes: [(f64, f64); LANES] = std::array::from_fn(of_row);
            approach = approach + Four::new(simd, &changes.map(|c| c.0));
            slope = slope + Four::new(simd, &changes.map(|c| c.1)) / q;
        }
        slope = slope.max(of(LEAST_SLOPE) * softness);
        let zero = of(0.0);
        FourStates {
            approach: load.below(least, approach * (load / least).max(zero), approach),
            slope,
            half_width: load.below(least, zero, half_width),
            pressure: load.below(least, zero, pressure),
        }
    }

    /// Energy in excess of half of load times approach: see `LocalLaw::curved_energy`.
    #[inline(always)]
    pub fn curved_energy<S: Simd>(&self, simd: S, load: Four<S>) -> Four<S> {
        let of = |x: f64| Four::splat(simd, x);
        let (least, both) = (self.least(simd), self.softness(simd));
        let q = load.max(least);
        let [a, _] = self.hertz(simd, q);
        let (value, growth) = self.bracket(simd, a);
        let mut of_rest = (growth + both) * of(-1.0 / 12.0);
        let far = Four::new(simd, &self.far);
        if far.any_below(of(1.0)) {
            let mut sum = of(0.0);
            for (x, w) in JACOBI {
                let added = self.bracket(simd, a * of(x.sqrt())).0 - value + of(0.5 * x.ln()) * both;
                sum = sum + of(w) * added;
            }
            of_rest = far.below(of(1.0), sum, of_rest);
        }
        let mut curved = -(q * q) * (both * of(0.125) + of_rest);
        if self.deviation.iter().any(Option::is_some) {
            let (width, load) = (a.array(), q.array());
            let of_row = |i: usize| {
                let deviation = self.deviation[i].as_deref();
                let change = |d: &BandMean| d.mean_change(d.share(width[i])) - 0.5 * d.change(d.share(width[i])).0;
                deviation.map_or(0.0, |d| load[i] * change(d))
            };
            curved = curved + Four::new(simd, &std::array::from_fn(of_row));
        }
        least.below(load, curved, of(0.0))
    }

    /// Half-width (mm) and largest pressure (MPa) after Hertz.
    #[inline(always)]
    fn hertz<S: Simd>(&self, simd: S, load: Four<S>) -> [Four<S>; 2] {
        let of = |x: f64| Four::splat(simd, x);
        let (modulus, radius) = (Four::new(simd, &self.modulus), Four::new(simd, &self.radius));
        let pressure = (load * modulus / (of(PI) * radius)).sqrt();
        [of(2.0) * load / (of(PI) * pressure), pressure]
    }

    #[inline(always)]
    fn least<S: Simd>(&self, simd: S) -> Four<S> {
        Four::splat(simd, LEAST_LOAD) * Four::new(simd, &self.modulus) * Four::new(simd, &self.radius)
    }

    /// K_1 + K_2.
    #[inline(always)]
    fn softness<S: Simd>(&self, simd: S) -> Four<S> {
        Four::new(simd, &self.bodies[0].softness) + Four::new(simd, &self.bodies[1].softness)
    }

    /// Approach over load (mm^2/N) and its derivative by ln a.
    #[inline(always)]
    fn bracket<S: Simd>(&self, simd: S, a: Four<S>) -> (Four<S>, Four<S>) {
        let of = |x: f64| Four::splat(simd, x);
        let both = self.softness(simd);
        let ln_a = a.ln();
        let (mut value, mut growth) = (of(0.0), of(0.0));
        for body in &self.bodies {
            let all = |list: &[f64; LANES]| Four::new(simd, list);
            let (k, eta, ln_depth) = (all(&body.softness), all(&body.eta), all(&body.ln_depth));
            let (deeper, share) = depth_beyond(simd, ln_a - ln_depth);
            let grown = all(&body.ended[1]) * a * a;
            let mut own = ln_depth + of(LN_2 + 0.5) + all(&body.layer) + deeper - ln_a + all(&body.ended[0]) + grown;
            let mut by_ln_a = share - of(1.0) + of(2.0) * grown;
            for faces in &body.ends {
                if faces.is_near() {
                    let (soft, slope) = faces.near(simd, a);
                    (own, by_ln_a) = (own + soft, by_ln_a + slope);
                }
            }
            let (inside, dln_l) = body.edges.reach(simd, a);
            let gradient = all(&body.tip_gradient);
            own = own + eta * (ln_depth + deeper - inside.ln()) + gradient * (inside - all(&body.tip_distance));
            by_ln_a = by_ln_a + dln_l * (gradient * inside - eta) + eta * share;
            (value, growth) = (value + k * own, growth + k * by_ln_a);
            if let Some((cut, slope)) = body.edges.cut_off(simd, a) {
                (value, growth) = (value + both * cut, growth + both * slope);
            }
        }
        (value, growth)
    }
}

/// By how much the logarithm of the depth grows for bands of a half-width a, and the derivative of that by ln a.
///
/// ```text
/// y = ln(a/t):   0 for y < -w,   (y + w)^2 / (4 w) up to w,   y beyond;   w = 1/2
/// ```
/// The logarithmic law is that of a band that is narrow beside the depth; it would have no stiffness left at a = 1.2
/// t and pull beyond. Under a wide band a thin layer is compressed evenly instead, with dq/d delta about E / 0.37
/// from a = t on (nu 0.3), which is what the law has at depth a. Pointed tips under heavy load come to that; below a
/// = 0.6 t nothing changes.
#[inline(always)]
fn depth_beyond<S: Simd>(simd: S, y: Four<S>) -> (Four<S>, Four<S>) {
    let of = |x: f64| Four::splat(simd, x);
    let (zero, width) = (of(0.0), of(TAKES_OVER));
    let within = (y + width).max(zero).min(of(2.0 * TAKES_OVER));
    let past = (y - width).max(zero);
    (within * within * of(0.25 / TAKES_OVER) + past, within * of(0.5 / TAKES_OVER))
}

impl<S: Simd> FourStates<S> {
    #[inline(always)]
    pub fn all(&self) -> [LocalState; LANES] {
        let (approach, slope) = (self.approach.array(), self.slope.array());
        let (half_width, pressure) = (self.half_width.array(), self.pressure.array());
        std::array::from_fn(|i| LocalState {
            approach: approach[i],
            slope: slope[i],
            half_width: half_width[i],
            pressure: pressure[i],
        })
    }

    #[inline(always)]
    pub fn of(&self, lane: usize) -> LocalState {
        self.all()[lane]
    }
}
