//! Contact lines that end at an end face of the gear.

use pulp::Simd;

use crate::lanes::{Four, LANES};

/// A free end face of a gear, relative to the contact line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EndFace {
    /// Distance along the contact line, mm.
    pub distance: f64,
    /// Angle between the end face and the line's normal plane, rad. Positive if the face meets the flank at an acute
    /// angle (PI/2 - lean), negative if the angle is obtuse. On a helical tooth its magnitude is the base helix angle;
    /// it is acute at one end and obtuse at the other.
    pub lean: f64,
}

impl EndFace {
    /// An end face that is infinitely far away.
    pub const FAR: Self = Self { distance: f64::INFINITY, lean: 0.0 };
}

/// Poisson's ratios and leans (deg) of [`WEIGHTS`].
const POISSON: [f64; 5] = [0.0, 0.2, 0.3, 0.4, 0.45];
const LEAN_STEP_DEG: f64 = 10.0;
const LEANS: usize = 9;
/// Weights of the two terms of [`FourFaces`], leans from -40 to 40 deg.
///
/// Fitted to a bonded layer with a free end, resolved in 3-D under the same line load everywhere (`cargo run --release
/// -p contact --example end_faces`); within 5 % of the softening at distances over a quarter of the half-width, 0.03
/// where it is small. Known in closed form are nu = 0 with an upright face (0: plane strain satisfies it) and the
/// growth with the logarithm.
#[rustfmt::skip]
const WEIGHTS: [[[f64; 2]; LEANS]; POISSON.len()] = [
    [[-0.779, 0.407], [-0.721, 0.373], [-0.598, 0.300], [-0.372, 0.176], [0.000, 0.000], [0.537, -0.171], [1.308, -0.239], [2.410, 0.079], [3.616, 1.956]],
    [[-0.777, 0.393], [-0.696, 0.346], [-0.547, 0.268], [-0.298, 0.154], [0.093, 0.012], [0.651, -0.094], [1.445, -0.043], [2.536, 0.543], [3.570, 3.089]],
    [[-0.871, 0.495], [-0.787, 0.456], [-0.637, 0.392], [-0.390, 0.304], [0.004, 0.197], [0.553, 0.156], [1.322, 0.326], [2.333, 1.153], [3.099, 4.277]],
    [[-1.111, 0.755], [-1.035, 0.738], [-0.895, 0.708], [-0.654, 0.658], [-0.276, 0.614], [0.233, 0.683], [0.932, 1.035], [1.792, 2.207], [2.162, 6.102]],
    [[-1.327, 0.987], [-1.261, 0.991], [-1.134, 0.986], [-0.890, 0.956], [-0.542, 0.968], [-0.068, 1.113], [0.580, 1.581], [1.353, 2.954], [1.542, 7.252]],
];
/// Decay of the two terms, one over depths.
const DECAY: [f64; 2] = [4.0 * UNIT_DECAY, 3.0 * UNIT_DECAY];
const UNIT_DECAY: f64 = 0.4;
/// Below this the logarithm's series is exact to round-off.
const SERIES: f64 = 0.01;
/// Distance over depth past which no face is felt.
const FAR: f64 = 20.0;
/// Distance over depth past which E goes with the square of the half-width: the fourth power is a hundred millionth of
/// it.
const STRAIGHT: f64 = 1.0;
/// Part of the half-width within which the band is too wide to feel the face any more.
const BLUNT: f64 = 0.28;

/// [`EndFace`]s of four rows before bodies of known depths: all that does not depend on the load.
///
/// ```text
/// E = B_1 ln coth(1.6 s/t) + B_2 ln coth(1.2 s/t),   s^2 = distance^2 + (0.28 a)^2
/// ```
/// Near the face it grows with ln(t/s), as any load does that nears an edge; a depth away it is gone. An acute end
/// softens much, an obtuse one stiffens a little; Poisson's ratio softens all (the face is free to bulge).
#[derive(Debug, Clone)]
pub(super) struct FourFaces {
    /// Distance over depth.
    distance: [f64; LANES],
    /// 0.28 over depth, 1/mm.
    blunt: [f64; LANES],
    weights: [[f64; LANES]; 2],
}

impl Default for FourFaces {
    fn default() -> Self {
        Self { distance: [FAR; LANES], blunt: [BLUNT; LANES], weights: [[0.0; LANES]; 2] }
    }
}

impl FourFaces {
    /// Sets a face at a distance (mm) for one row. `weights` are those of its lean; `t` is the depth of the body, mm.
    #[inline(always)]
    pub fn put(&mut self, lane: usize, distance: f64, weights: [f64; 2], t: f64) {
        let distance = distance.max(0.0) / t;
        let is_felt = distance <= FAR;
        self.distance[lane] = if is_felt { distance } else { FAR };
        self.blunt[lane] = BLUNT / t;
        self.weights.iter_mut().zip(weights).for_each(|(all, own)| all[lane] = if is_felt { own } else { 0.0 });
    }

    /// Whether any face is so near that its contribution is not linear in the square of the half-width.
    pub fn is_near(&self) -> bool {
        self.distance.iter().any(|distance| *distance <= STRAIGHT)
    }

    /// Contribution of the far faces, and its growth with the square of the half-width (1/mm^2).
    #[inline(always)]
    pub fn far<S: Simd>(&self, simd: S) -> [Four<S>; 2] {
        let of = |x: f64| Four::splat(simd, x);
        let (distance, blunt) = (Four::new(simd, &self.distance), Four::new(simd, &self.blunt));
        let (value, slope) = self.beside(simd, distance);
        let growth = of(0.5) * slope * blunt * blunt / distance;
        let (straight, zero) = (of(STRAIGHT), of(0.0));
        [straight.below(distance, value, zero), straight.below(distance, growth, zero)]
    }

    /// Contribution of the near faces to the bracket of the body for half-widths `a` (mm), and its derivative by ln a.
    #[inline(always)]
    pub fn near<S: Simd>(&self, simd: S, a: Four<S>) -> (Four<S>, Four<S>) {
        let of = |x: f64| Four::splat(simd, x);
        let distance = Four::new(simd, &self.distance);
        let blunt = Four::new(simd, &self.blunt) * a;
        let s = (distance * distance + blunt * blunt).sqrt();
        // A band many depths wide comes up only while a solution is sought; beyond its range the exponential is no number.
        let (value, slope) = self.beside(simd, s.min(of(FAR)));
        let (straight, zero) = (of(STRAIGHT), of(0.0));
        (straight.below(distance, zero, value), straight.below(distance, zero, slope * blunt * blunt / s))
    }

    /// E at `s` > 0 depths, and its derivative by that.
    #[inline(always)]
    fn beside<S: Simd>(&self, simd: S, s: Four<S>) -> (Four<S>, Four<S>) {
        let of = |x: f64| Four::splat(simd, x);
        let one = of(1.0);
        // DECAY is 4 and 3 times this: one exponential serves both.
        let [y, less] = (of(-2.0 * UNIT_DECAY) * s).exp();
        let cube = y * y * y;
        let decays = [(cube * y, -less * (one + y) * (one + y * y)), (cube, -less * (one + y + y * y))];
        let (mut value, mut slope) = (of(0.0), of(0.0));
        for i in 0..decays.len() {
            let (weight, (e, rest)) = (Four::new(simd, &self.weights[i]), decays[i]);
            // ln coth x = ln((1 + e) / (1 - e)) with e = exp(-2 x), and 1 / sinh(2 x) = 2 e / (1 - e^2).
            let logarithm = e.below(of(SERIES), of(2.0) * odd_series(e), ((one + e) / rest).ln());
            value = value + weight * logarithm;
            slope = slope - weight * of(4.0 * DECAY[i]) * e / ((one + e) * rest);
        }
        (value, slope)
    }
}

/// artanh e for a small e.
#[inline(always)]
fn odd_series<S: Simd>(e: Four<S>) -> Four<S> {
    let square = e * e;
    e * square.polynomial([1.0 / 7.0, 1.0 / 5.0, 1.0 / 3.0, 1.0])
}

/// B_1 and B_2 of [`FourFaces`] for a ratio of Poisson and a lean (rad): linear between the table's entries, held past
/// its ends.
pub(super) fn weights(poisson: f64, lean: f64) -> [f64; 2] {
    let nu = poisson.clamp(POISSON[0], POISSON[POISSON.len() - 1]);
    let row = POISSON.partition_point(|&p| p <= nu).clamp(1, POISSON.len() - 1) - 1;
    let part = (nu - POISSON[row]) / (POISSON[row + 1] - POISSON[row]);
    let column = (lean.to_degrees() / LEAN_STEP_DEG + 4.0).clamp(0.0, (LEANS - 1) as f64);
    let left = (column as usize).min(LEANS - 2);
    let across = column - left as f64;
    [0, 1].map(|i| {
        let at = |row: usize| (1.0 - across) * WEIGHTS[row][left][i] + across * WEIGHTS[row][left + 1][i];
        (1.0 - part) * at(row) + part * at(row + 1)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn softening(face: &EndFace, poisson: f64, t: f64, a: f64) -> (f64, f64) {
        let mut faces = FourFaces::default();
        (0..LANES).for_each(|lane| faces.put(lane, face.distance, weights(poisson, face.lean), t));
        let (simd, of) = (pulp::Scalar256b, |x: f64| Four::splat(pulp::Scalar256b, x));
        let ([value, growth], (near, by_ln_a)) = (faces.far(simd), faces.near(simd, of(a)));
        let grown = growth * of(a * a);
        ((value + grown + near).array()[0], (of(2.0) * grown + by_ln_a).array()[0])
    }

    /// Plane strain needs no end face when nu = 0; else an upright face softens, an acute one more, an obtuse one less.
    #[test]
    fn acute_is_soft() {
        let at = |lean: f64, nu: f64| softening(&EndFace { distance: 0.5, lean: lean.to_radians() }, nu, 2.0, 0.1).0;
        assert_eq!(at(0.0, 0.0), 0.0);
        assert!(at(20.0, 0.3) > at(0.0, 0.3) && at(0.0, 0.3) > at(-20.0, 0.3) && at(0.0, 0.3) > 0.0);
        assert!(softening(&EndFace::FAR, 0.3, 2.0, 0.1).0 == 0.0);
    }

    /// Between the ratios and leans that were resolved the softening has no jump, and passes through their mean
    /// half-way.
    #[test]
    fn between_resolved_cases_it_is_straight() {
        let at =
            |lean_deg: f64, nu: f64| softening(&EndFace { distance: 0.3, lean: lean_deg.to_radians() }, nu, 2.0, 0.1).0;
        for (lean, [low, high]) in [(0.0, [0.2, 0.3]), (20.0, [0.3, 0.4]), (-10.0, [0.0, 0.2])] {
            let mean = 0.5 * (at(lean, low) + at(lean, high));
            let between = at(lean, 0.5 * (low + high));
            assert!((between - mean).abs() < 1e-12, "lean {lean} deg, nu {low} .. {high}: {between}, not {mean}");
        }
        let mean = 0.5 * (at(10.0, 0.3) + at(20.0, 0.3));
        assert!((at(15.0, 0.3) - mean).abs() < 1e-12, "lean 15 deg: {}, not {mean}", at(15.0, 0.3));
    }

    /// The band is blunt within 0.28 of its half-width: at the very face it feels what a narrow one feels 0.28 a away.
    #[test]
    fn a_band_at_the_face_feels_it_from_a_part_of_its_width() {
        let at = |distance: f64, a: f64| softening(&EndFace { distance, lean: 0.2 }, 0.3, 2.0, a).0;
        for a in [0.05, 0.2] {
            let (at_face, beside) = (at(0.0, a), at(0.28 * a, 1e-9));
            assert!((at_face - beside).abs() < 1e-9, "a {a} mm: {at_face}, not {beside}");
        }
    }

    #[test]
    fn slope_is_the_derivative_by_ln_a() {
        for distance in [0.0, 0.03, 0.3, 3.0] {
            let face = EndFace { distance, lean: 0.33 };
            let at = |a: f64| softening(&face, 0.28, 2.0, a);
            let (a, h) = (0.1f64, 1e-5);
            let wanted = (at(a * f64::exp(h)).0 - at(a * f64::exp(-h)).0) / (2.0 * h);
            assert!((at(a).1 - wanted).abs() < 1e-7, "{distance} mm: {}, not {wanted}", at(a).1);
        }
    }
}
