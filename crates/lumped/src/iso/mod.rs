//! What ISO 6336 says of a pair without any mesh: stiffness of teeth and mesh (part 1, method B), nominal contact
//! stress (part 2) and tooth root stress (part 3); and what it leaves out of narrow helical gears, the bending of their
//! bodies. Theory (23).
//!
//! Stiffness is stated per mm of face width, in N/(mm um), as the standard does.

mod body;
mod flank;
mod root;

use std::cmp::Ordering;

use serde::Serialize;

pub use body::body_compliance;
pub use flank::IsoFlank;
pub use root::{IsoRoot, IsoRootPair, rim_ratio};

use crate::LumpedError;

const METHOD: &str = "ISO 6336-1 method B";
/// Theoretical to measured single stiffness of solid disc gears.
const C_M: f64 = 0.8;
/// Coefficients of the series for the flexibility q', (mm um)/N.
const SERIES: [f64; 9] = [0.04723, 0.15551, 0.25791, -0.00635, -0.11654, -0.00193, -0.24188, 0.00529, 0.00182];
/// Young's modulus of the steel that the series was fitted to, MPa.
const YOUNG_STEEL: f64 = 2.06e5;
/// Line load below which single stiffness falls with its fourth root, N/mm.
const LIGHT_LOAD: f64 = 100.0;

/// What the standard needs to know of a pair of solid disc gears, in either order: its gear 1 is the one with fewer
/// teeth, whichever the pair names first.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct IsoPair {
    /// Numbers of teeth, without sign.
    pub teeth: [u32; 2],
    /// Whether the second gear is an internal one, with profile shifts after ISO 21771.
    pub internal: bool,
    /// Profile shift coefficients.
    pub profile_shift: [f64; 2],
    /// Helix angle at the reference cylinder, rad; its sign does not matter.
    pub helix_angle: f64,
    /// Normal pressure angle, rad.
    pub normal_pressure_angle: f64,
    /// Dedendum coefficients of the basic racks, h_fP / m_n.
    pub dedendum_coefficient: [f64; 2],
    /// Young's moduli, MPa.
    pub young: [f64; 2],
    /// Transverse contact ratio.
    pub eps_alpha: f64,
    /// F_t K_A / b: line load on the reference circle, N/mm.
    pub line_load: f64,
}

/// Stiffness of a pair of solid disc gears, N/(mm um).
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct IsoStiffness {
    /// c'_th, theoretical single stiffness in the normal section.
    pub c_theoretical: f64,
    /// c', maximum single stiffness of a tooth pair.
    pub c_single: f64,
    /// c_gamma_alpha, mean mesh stiffness, used for transmission error and inner dynamics.
    pub c_mesh: f64,
    /// c_gamma_beta, mean mesh stiffness used for load distribution over the face.
    pub c_mesh_beta: f64,
}

/// Stiffness of the pair.
///
/// ```text
/// q'    = C1 + C2/zn1 + C3/zn2 + C4 x1 + C5 x1/zn1 + C6 x2 + C7 x2/zn2 + C8 x1^2 + C9 x2^2,   c'_th = 1/q'
/// zn    = z / (cos^2 beta_b cos beta)
/// c'    = c'_th C_M C_R C_B cos beta E/E_st [(F_t K_A/b) / 100]^(1/4 if below 100 N/mm)
/// C_B   = [1 + 0.5 (1.2 - h_fP/m_n)] [1 - 0.02 (20 - alpha_n)],   C_M = 0.8,  C_R = 1 (solid disc)
/// c_ga  = c' (0.75 eps_alpha + 0.25),   c_gb = 0.85 c_ga
/// ```
///
/// For an internal gear z_n2 is infinite there.
///
/// Index 1 is the gear with fewer teeth (ISO 6336-1, "pinion"). For equal numbers of teeth and different profile shifts
/// the standard names neither: q' is then the mean of both orders, so that names change nothing.
///
/// For different racks C_B is the mean of both; for different materials E = 2 E1 E2 / (E1 + E2).
/// Source: ISO 6336-1:2019, clause 9.3. Below eps_alpha = 1.2 of a spur pair the standard asks to lower
/// c' by up to 10 %; that is left to the user, as it gives no figure.
///
/// # Errors
/// [`LumpedError::OutOfRange`] outside of |beta| <= 45 deg and -0.5 <= x1 + x2 <= 2 (the standard's own limits), or
/// where an input is not positive or not a number.
///
/// # Example
/// ISO/TR 6336-30, example 1:
/// ```
/// # use lumped::iso::{IsoPair, stiffness};
/// let pair = IsoPair {
///     teeth: [17, 103], internal: false, profile_shift: [0.145, 0.0], helix_angle: 15.8_f64.to_radians(),
///     normal_pressure_angle: 20_f64.to_radians(), dedendum_coefficient: [1.4, 1.4], young: [2.06e5; 2],
///     eps_alpha: 1.54909, line_load: 1273.5,
/// };
/// assert!((stiffness(&pair)?.c_mesh - 17.46485).abs() < 1e-4);
/// # Ok::<(), lumped::LumpedError>(())
/// ```
pub fn stiffness(pair: &IsoPair) -> Result<IsoStiffness, LumpedError> {
    check(pair)?;
    let beta = pair.helix_angle.abs();
    let sin_beta_b = beta.sin() * pair.normal_pressure_angle.cos();
    let virtual_teeth = |z: u32| f64::from(z) / ((1.0 - sin_beta_b * sin_beta_b) * beta.cos());
    let of = |i: usize| if pair.internal && i == 1 { f64::INFINITY } else { virtual_teeth(pair.teeth[i]) };
    let gears = [0, 1].map(|i| (of(i), pair.profile_shift[i]));
    let flexibility = match pair.teeth[0].cmp(&pair.teeth[1]) {
        Ordering::Less => flexibility(gears),
        Ordering::Greater => flexibility([gears[1], gears[0]]),
        Ordering::Equal => 0.5 * (flexibility(gears) + flexibility([gears[1], gears[0]])),
    };
    if flexibility <= 0.0 {
        let sum = pair.profile_shift[0] + pair.profile_shift[1];
        return Err(out_of_range("x1 + x2", sum, "profile shifts that leave the tooth some flexibility"));
    }
    let c_theoretical = 1.0 / flexibility;

    let rack = pair.dedendum_coefficient.map(|h_f| 1.0 + 0.5 * (1.2 - h_f));
    let c_b = 0.5 * (rack[0] + rack[1]) * (1.0 - 0.02 * (20.0 - pair.normal_pressure_angle.to_degrees()));
    let [e1, e2] = pair.young;
    let material = 2.0 * e1 * e2 / (e1 + e2) / YOUNG_STEEL;
    let light = if pair.line_load < LIGHT_LOAD { (pair.line_load / LIGHT_LOAD).powf(0.25) } else { 1.0 };
    let c_single = c_theoretical * C_M * c_b * beta.cos() * material * light;
    let c_mesh = c_single * (0.75 * pair.eps_alpha + 0.25);
    Ok(IsoStiffness { c_theoretical, c_single, c_mesh, c_mesh_beta: 0.85 * c_mesh })
}

/// q', (mm um)/N, of gear 1 and gear 2, each by the teeth of its virtual spur gear and its profile shift.
fn flexibility([(zn1, x1), (zn2, x2)]: [(f64, f64); 2]) -> f64 {
    let terms = [1.0, 1.0 / zn1, 1.0 / zn2, x1, x1 / zn1, x2, x2 / zn2, x1 * x1, x2 * x2];
    SERIES.iter().zip(terms).map(|(c, t)| c * t).sum()
}

/// Mean static transmission error, um: `F_bt / (b c_gamma_alpha)`.
///
/// `base_force` F_bt on the transverse line of action, N; `face_width` b, mm.
pub fn mean_transmission_error_um(stiffness: &IsoStiffness, base_force: f64, face_width: f64) -> f64 {
    base_force / (face_width * stiffness.c_mesh)
}

fn check(pair: &IsoPair) -> Result<(), LumpedError> {
    let beta_deg = pair.helix_angle.to_degrees();
    let sum = pair.profile_shift[0] + pair.profile_shift[1];
    let alpha_deg = pair.normal_pressure_angle.to_degrees();
    let inside = |low: f64, value: f64, high: f64| (low..=high).contains(&value);
    let rules = [
        ("number of teeth", f64::from(pair.teeth[0].min(pair.teeth[1])), 5.0, f64::INFINITY, "5 or more"),
        ("helix angle in degrees", beta_deg, -45.0, 45.0, "-45 .. 45"),
        ("normal pressure angle in degrees", alpha_deg, 10.0, 30.0, "10 .. 30"),
        ("sum of the profile shifts", sum, -0.5, 2.0, "-0.5 .. 2"),
        ("transverse contact ratio", pair.eps_alpha, 1e-9, 10.0, "positive"),
        ("line load in N/mm", pair.line_load, f64::MIN_POSITIVE, f64::INFINITY, "positive"),
        ("Young's modulus in MPa", pair.young[0].min(pair.young[1]), f64::MIN_POSITIVE, f64::INFINITY, "positive"),
        ("largest dedendum coefficient", max(pair.dedendum_coefficient), 0.5, 2.5, "0.5 .. 2.5"),
        ("smallest dedendum coefficient", -max(pair.dedendum_coefficient.map(|h| -h)), 0.5, 2.5, "0.5 .. 2.5"),
    ];
    for (quantity, value, low, high, allowed) in rules {
        if !inside(low, value, high) {
            return Err(out_of_range(quantity, value, allowed));
        }
    }
    Ok(())
}

fn max([a, b]: [f64; 2]) -> f64 {
    a.max(b)
}

fn out_of_range(quantity: &'static str, value: f64, allowed: &'static str) -> LumpedError {
    LumpedError::OutOfRange { quantity, value, method: METHOD, allowed }
}
