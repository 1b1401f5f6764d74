//! How a stepped shaft yields: flexibility influence coefficients in bending, series rule in torsion and along the
//! axis. Theory (51).

use fem::beam::{BeamPiece, BeamTheory};
use nalgebra::DMatrix;

/// Kind of a flexibility coefficient.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Influence {
    /// Displacement across the shaft, or a force along it, at this position (mm).
    Shift(f64),
    /// Turn of the section, or a couple that turns it, at this position (mm); positive where displacements grow with z.
    Turn(f64),
}

impl Influence {
    fn position(self) -> f64 {
        let (Self::Shift(p) | Self::Turn(p)) = self;
        p
    }

    /// Bending moment m (EI u'' = m) at `z` and its slope, for a unit load on a shaft pinned at both `pins`; `before`
    /// says whether z is taken to lie before the load.
    fn moment(self, z: f64, before: bool, [a, b]: [f64; 2]) -> (f64, f64) {
        let l = b - a;
        match (self, before) {
            (Self::Shift(p), true) => (-(b - p) * (z - a) / l, -(b - p) / l),
            (Self::Shift(p), false) => (-(p - a) * (b - z) / l, (p - a) / l),
            (Self::Turn(_), true) => ((z - a) / l, 1.0 / l),
            (Self::Turn(_), false) => (-(b - z) / l, 1.0 / l),
        }
    }
}

/// Flexibility of a stepped shaft that is pinned at two places: displacement or turn i by a unit force or couple j.
///
/// ```text
/// a_ij = integral of [m_i m_j / (E I) + v_i v_j / (kappa G A)] dz,   m moment by the unit load, v = dm/dz its shear force
/// ```
/// Unit-load theorem (Mohr, Maxwell), exact for any steps; v only with [`BeamTheory::Timoshenko`]. Units mm/N, 1/N,
/// 1/(N mm).
///
/// For a solid disc at a and b = l - a between two shafts without shear and with E I alike it is
/// ```text
/// a_rr = a^2 b^2 / (3 E I l),   a_rp = a b (b - a) / (3 E I l),   a_pp = (a^3 + b^3) / (3 E I l^2)
/// ```
/// and with E I_3 before and E I_4 behind the disc
/// ```text
/// a_rr = a^2 b^2 (a / E I_3 + b / E I_4) / (3 l^2),  a_rp = a b (b^2 / E I_4 - a^2 / E I_3) / (3 l^2),  a_pp = (a^3 / E I_3 + b^3 / E I_4) / (3 l^2)
/// ```
/// The seed prints these in another arrangement, with a misprint in the middle one: 2 a^2 E I_3 l must read 2 a E I_3
/// l.
///
/// `pins` and all places must lie between the ends of the `pieces`, and the places between the pins: a load beyond them
/// is left out.
pub fn bending_influence(
    pieces: &[BeamPiece],
    pins: [f64; 2],
    places: &[Influence],
    theory: BeamTheory,
) -> DMatrix<f64> {
    let mut a = DMatrix::zeros(places.len(), places.len());
    let mut start = 0.0;
    for piece in pieces {
        let end = start + piece.length;
        let section = &piece.section;
        let bending = section.bending_stiffness();
        let shear = match theory {
            BeamTheory::Timoshenko => section.shear_stiffness().recip(),
            BeamTheory::Euler => 0.0,
        };
        let inside = |z: &f64| *z > start && *z < end;
        let mut cuts: Vec<f64> = [start, end].map(|z: f64| z.clamp(pins[0], pins[1])).to_vec();
        cuts.extend(places.iter().map(|p| p.position()).chain(pins).filter(inside));
        cuts.retain(|z| (pins[0]..=pins[1]).contains(z));
        cuts.sort_by(f64::total_cmp);
        for cut in cuts.windows(2).filter(|c| c[1] > c[0]) {
            let (h, middle) = (cut[1] - cut[0], 0.5 * (cut[0] + cut[1]));
            let of = |p: &Influence| {
                let before = middle < p.position();
                let ((low, v), (high, _)) = (p.moment(cut[0], before, pins), p.moment(cut[1], before, pins));
                (low, high, v)
            };
            let all: Vec<(f64, f64, f64)> = places.iter().map(of).collect();
            for (i, x) in all.iter().enumerate() {
                for (j, y) in all.iter().enumerate() {
                    // Product of two straight lines, exactly.
                    let moments = h / 6.0 * (2.0 * x.0 * y.0 + x.0 * y.1 + x.1 * y.0 + 2.0 * x.1 * y.1);
                    a[(i, j)] += moments / bending + h * x.2 * y.2 * shear;
                }
            }
        }
        start = end;
    }
    a
}

/// Torsional stiffness of one shaft that twists as segments in a row do, N mm^2.
///
/// ```text
/// l / (G I_p) = sum of l_n / (G I_p)_n,   l = sum of l_n
/// ```
/// `segments`: lengths (mm) and torsional stiffnesses (N mm^2). 0 without segments. The stiffness between the ends is G
/// I_p / l.
///
/// ```
/// // One half twice as stiff as the other: 2 / (1/1 + 1/2).
/// assert!((lumped::shaft18::equivalent_torsional_stiffness(&[(1.0, 1.0), (1.0, 2.0)]) - 4.0 / 3.0).abs() < 1e-15);
/// ```
pub fn equivalent_torsional_stiffness(segments: &[(f64, f64)]) -> f64 {
    let length: f64 = segments.iter().map(|s| s.0).sum();
    if length == 0.0 { 0.0 } else { length / segments.iter().map(|(l, stiffness)| l / stiffness).sum::<f64>() }
}
