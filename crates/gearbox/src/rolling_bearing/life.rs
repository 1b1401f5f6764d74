//! Life of a rolling bearing. Theory (101b), (101c).
//!
//! The life follows from the force of every rolling element and lamina, not from an equivalent load. So tilts,
//! clearance and preload are included.

use super::{BallGeometry, RollerGeometry, RollingElements, roller::LAMINAE};

/// Exponents of the load in the life of a contact: of the ring that turns against the load, and of the one that stands.
const BALLS: [f64; 2] = [3.0, 10.0 / 3.0];
const ROLLERS: [f64; 2] = [4.0, 9.0 / 2.0];
/// lambda nu: what is left of a roller's rating by an uneven load along it.
const UNEVEN: f64 = 0.83;
/// Largest pitch diameter at which the fatigue limit does not go with the size, mm.
const SMALL: f64 = 100.0;
/// Largest modification of a life.
const MOST: f64 = 50.0;

/// Mean of a power of forces, to the root.
fn equivalent(forces: impl Iterator<Item = f64>, exponent: f64) -> f64 {
    let (mut sum, mut count) = (0.0, 0.0f64);
    for force in forces {
        sum += force.powf(exponent);
        count += 1.0;
    }
    (sum / count.max(1.0)).powf(1.0 / exponent)
}

/// Forces of a ball on inner and outer ring under which a row lasts a million turns, N.
///
/// ```text
/// Q_ci = C/(0.407 Z cos(alpha)^0.7 i^0.7) (1 + x^(10/3))^(3/10),   Q_ce = C/(0.389 ...) (1 + x^(-10/3))^(3/10)
/// x = 1.044 ((1 - gamma)/(1 + gamma))^1.72 (r_i/r_e (2 r_e - D)/(2 r_i - D))^0.41
/// ```
/// Source: ISO/TS 16281, 5.3.
pub(super) struct BallCapacity([f64; 2]);

impl BallCapacity {
    pub fn new(g: &BallGeometry, rows: usize, dynamic_rating: f64) -> Self {
        let [inner, outer] = g.conformity;
        let grooves = inner / outer * (2.0 * outer - 1.0) / (2.0 * inner - 1.0);
        let x = 1.044 * ((1.0 - g.gamma()) / (1.0 + g.gamma())).powf(1.72) * grooves.powf(0.41);
        let share = dynamic_rating / (g.elements as f64 * g.contact_angle.cos().powf(0.7) * (rows as f64).powf(0.7));
        let ring = |factor: f64, x: f64| share / factor * (1.0 + x.powf(10.0 / 3.0)).powf(0.3);
        Self([ring(0.407, x), ring(0.389, 1.0 / x)])
    }

    /// (Q_ei/Q_ci)^(10/3) + (Q_ee/Q_ce)^(10/3).
    pub fn used(&self, forces: impl Iterator<Item = f64>) -> f64 {
        let all: Vec<f64> = forces.collect();
        let of = |i: usize| (equivalent(all.iter().copied(), BALLS[i]) / self.0[i]).powf(10.0 / 3.0);
        of(0) + of(1)
    }
}

/// Forces of a lamina of a roller on inner and outer ring under which it lasts a million turns, N.
///
/// ```text
/// Q_ci = C/(0.83 0.378 Z cos(alpha) i^(7/9)) (1 + x^(9/2))^(2/9),   Q_ce = C/(0.83 0.364 ...) (1 + x^(-9/2))^(2/9)
/// x = 1.038 ((1 - gamma)/(1 + gamma))^(143/108),   q_c = Q_c n^(-7/9)
/// f_k = 1 - 0.01/ln(1.985 |2 k - n - 1|/(2 n - 2))      stress at the ends over that of the lamina
/// ```
/// n: laminae, k from 1. Source: ISO/TS 16281, 6.3.
pub(super) struct LaminaCapacity([f64; 2]);

impl LaminaCapacity {
    pub fn new(g: &RollerGeometry, rows: usize, dynamic_rating: f64) -> Self {
        let x = 1.038 * ((1.0 - g.gamma()) / (1.0 + g.gamma())).powf(143.0 / 108.0);
        let rows = (rows as f64).powf(7.0 / 9.0);
        let share = dynamic_rating / (UNEVEN * g.elements as f64 * g.contact_angle.cos() * rows);
        let lamina = (LAMINAE as f64).powf(-7.0 / 9.0);
        let ring = |factor: f64, x: f64| lamina * share / factor * (1.0 + x.powf(4.5)).powf(2.0 / 9.0);
        Self([ring(0.378, x), ring(0.364, 1.0 / x)])
    }

    /// (q_kei/q_ci)^(9/2) + (q_kee/q_ce)^(9/2) of lamina k, counted from 0. The load stands still, and the inner ring turns
    /// under it (0), or the outer one (1).
    pub fn used(&self, k: usize, forces: impl Iterator<Item = f64>, turning: usize) -> f64 {
        let n = LAMINAE as f64;
        let from_middle = (2.0 * k as f64 + 1.0 - n).abs() / (2.0 * n - 2.0);
        // Minus infinity in the middle: nothing is added there.
        let edge = 1.0 - 0.01 / (1.985 * from_middle).ln();
        let all: Vec<f64> = forces.map(|force| edge * force).collect();
        let of = |i: usize| (equivalent(all.iter().copied(), ROLLERS[i ^ turning]) / self.0[i]).powf(4.5);
        of(0) + of(1)
    }
}

/// Effect of lubrication and contamination on the life of a bearing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LifeModification {
    /// Viscosity ratio kappa = nu/nu_1: viscosity divided by the required viscosity.
    pub viscosity_ratio: f64,
    /// Fatigue load limit C_u: the load below which the raceways do not fatigue under the best conditions, N.
    pub fatigue_limit: f64,
    /// Life modification factor a_ISO, by which the basic life is multiplied, up to 50.
    pub factor: f64,
}

impl LifeModification {
    /// Modification for a bearing with a number of rows, at a speed (1/min, above 0), with oil of a kinematic viscosity
    /// (mm^2/s), a contamination factor e_C, under an equivalent load P (N).
    ///
    /// ```text
    /// nu_1 = 45000 n^(-0.83) d_pw^(-0.5) below 1000/min,   4500 n^(-0.5) d_pw^(-0.5) from there on
    /// C_u = C_0/22 of balls, C_0/8.2 of rollers;   times (100/d_pw)^0.5, (100/d_pw)^0.3 above d_pw = 100 mm
    /// a_ISO = 0.1 (1 - (2.5671 - a kappa^-b)^0.83 (e_C C_u/P)^(1/3))^(-9.3)         balls
    /// a_ISO = 0.1 (1 - (1.5859 - a kappa^-b) (e_C C_u/P)^0.4)^(-9.185)              rollers
    /// ```
    /// a and b depend on the range of kappa, 0.1 .. 4; above 4 it counts as 4. `None` below 0.1, where ISO 281 has no
    /// factor, and for values that are not above 0. Source: ISO 281:2007.
    pub fn new(
        elements: &RollingElements,
        rows: usize,
        (speed_rpm, viscosity): (f64, f64),
        (contamination, equivalent_load): (f64, f64),
    ) -> Option<Self> {
        let pitch = elements.pitch_diameter();
        let power = if speed_rpm < 1000.0 { 45_000.0 * speed_rpm.powf(-0.83) } else { 4_500.0 / speed_rpm.sqrt() };
        let viscosity_ratio = viscosity * pitch.sqrt() / power;
        let kappa = viscosity_ratio.min(4.0);
        let known = kappa >= 0.1 && contamination > 0.0 && equivalent_load > 0.0;
        if !known {
            return None;
        }
        let range = usize::from(kappa >= 0.4) + usize::from(kappa >= 1.0);
        let slope = [0.054_381, 0.190_87, 0.071_739][range];
        let large = (SMALL / pitch).min(1.0);
        let static_rating = elements.static_rating(rows);
        let (fatigue_limit, rest, exponent) = match elements {
            RollingElements::Balls(_) => {
                let limit = static_rating / 22.0 * large.sqrt();
                let by_film = 2.5671 - [2.2649, 1.9987, 1.9987][range] * kappa.powf(-slope);
                let load = (contamination * limit / equivalent_load).cbrt();
                (limit, 1.0 - by_film.max(0.0).powf(0.83) * load, -9.3)
            }
            RollingElements::Rollers(_) => {
                let limit = static_rating / 8.2 * large.powf(0.3);
                let by_film = 1.5859 - [1.3993, 1.2348, 1.2348][range] * kappa.powf(-slope);
                let load = (contamination * limit / equivalent_load).powf(0.4);
                (limit, 1.0 - by_film.max(0.0) * load, -9.185)
            }
        };
        // Beyond that load nothing tires.
        let factor = if rest > 0.0 { (0.1 * rest.powf(exponent)).min(MOST) } else { MOST };
        Some(Self { viscosity_ratio, fatigue_limit, factor })
    }
}
