//! Nominal tooth root stress after ISO 6336-3, method B: a bar that is as thick as the tooth at its 30 degree tangents,
//! 60 degree tangents of an internal gear.
//! Theory (23a), (23b).

use std::f64::consts::{FRAC_PI_2, FRAC_PI_3, FRAC_PI_4, FRAC_PI_6, PI};

use geometry::{Gear, ShapedRoot};
use serde::Serialize;

use crate::LumpedError;

const METHOD: &str = "ISO 6336-3 method B";
/// Rim thickness over tooth height from which on the rim does not matter, and down to which the standard goes.
const SOLID_RIM: f64 = 1.2;
const THINNEST_RIM: f64 = 0.5;
/// Rim thickness of an internal gear over the normal module from which on the rim does not matter, and down to which the
/// standard goes.
const SOLID_RING: f64 = 3.5;
const THINNEST_RING: f64 = 1.75;
/// Largest helix angle that lowers Y_beta any further, degrees.
const LARGEST_HELIX_DEG: f64 = 30.0;

/// Contact ratios and tolerance class of the pair that a tooth belongs to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct IsoRootPair {
    /// Transverse contact ratio eps_alpha.
    pub eps_alpha: f64,
    /// Overlap ratio eps_beta.
    pub eps_beta: f64,
    /// ISO tolerance class 4 or better: only then pairs share the load so evenly that Y_DT falls below 1.
    pub fine: bool,
}

/// The root of one gear's tooth after ISO 6336-3, method B: section of the virtual spur gear and factors.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct IsoRoot {
    /// z_n, teeth of the virtual spur gear; negative of an internal gear.
    pub virtual_teeth: f64,
    /// s_Fn, chord between the 30 (internal: 60) degree tangents, mm.
    pub root_chord: f64,
    /// h_Fe, lever of the load at the outer point of single pair contact, mm.
    pub lever: f64,
    /// rho_F, radius of the fillet at that tangent, mm.
    pub fillet_radius: f64,
    /// alpha_Fen, angle of the load against the chord, rad.
    pub load_angle: f64,
    /// s_R / h_t, thickness of the rim between bore and root circle over tooth height.
    pub rim_ratio: f64,
    /// f_eps, share of the load along the lines of contact; a factor of `y_form`.
    pub f_eps: f64,
    /// Y_F, form factor, with f_eps.
    pub y_form: f64,
    /// Y_S, stress correction factor.
    pub y_stress: f64,
    /// Y_beta, helix factor.
    pub y_helix: f64,
    /// Y_B, rim thickness factor.
    pub y_rim: f64,
    /// Y_DT, deep tooth factor.
    pub y_deep_tooth: f64,
}

impl IsoRoot {
    /// Root of a tooth of `gear`.
    ///
    /// ```text
    /// z_n  = z / (cos^2 beta_b cos beta),   eps_an = eps_alpha / cos^2 beta_b
    /// E    = (pi/4) m_n + A_s/2 - h_fP tan a_n - (1 - sin a_n) rho_fP / cos a_n
    /// G    = rho_fP/m_n - h_fP/m_n + x,   H = (2/z_n)(pi/2 - E/m_n) - pi/3,   th = (2G/z_n) tan th - H
    /// s_Fn = m_n [z_n sin(pi/3 - th) + sqrt(3) (G/cos th - rho_fP/m_n)]
    /// rho_F = rho_fP + m_n 2G^2 / [cos th (z_n cos^2 th - 2G)]
    /// d_en/2 = sqrt{[sqrt(d_an^2/4 - d_bn^2/4) - pi m_n cos a_n (eps_an - 1)]^2 + d_bn^2/4}
    /// h_Fe = d_bn / (2 cos a_Fen) - m_n [z_n cos(pi/3 - th) + G/cos th - rho_fP/m_n] / 2
    /// Y_F  = f_eps 6 (h_Fe/m_n) cos a_Fen / [(s_Fn/m_n)^2 cos a_n]
    /// Y_S  = (1.2 + 0.13 L) q_s^(1/(1.21 + 2.3/L)),   L = s_Fn/h_Fe,   q_s = s_Fn/(2 rho_F)
    /// ```
    /// The root of an internal gear is that of the virtual spur gear which a virtual shaper cuts: s_Fn and rho_F at the 60 degree tangent of the
    /// exact fillet, h_Fe from there, with z_n, d_bn and d_en below zero; Y_B = 1.15 ln(8.324 m_n/s_R) for a rim s_R of 1.75 to 3.5 m_n, 1 above.
    /// The standard takes Y_S from external gears.
    ///
    /// The thinning A_s of the teeth is that of the gear here: it widens the rack's tooth and leaves its depth. f_eps,
    /// Y_beta and Y_DT are those of the 2019 edition. Source: ISO 6336-3:2019, clauses 6 to 10.
    ///
    /// # Errors
    /// [`LumpedError::OutOfRange`] where the standard has no value: eps_an not in 1 .. 3, q_s not in 1 .. 8, a rim of
    /// half the tooth height (internal: of 1.75 modules) or less, a tool whose rounding leaves no such tangent.
    pub fn new(gear: &Gear, pair: IsoRootPair) -> Result<Self, LumpedError> {
        let data = gear.data();
        inside("number of teeth", f64::from(data.teeth), 5.0, f64::MAX, "5 or more")?;
        let cos_a = data.normal_pressure_angle.cos();
        let cos2_base = gear.base_helix_angle().cos().powi(2);
        let virtual_teeth = data.signed_teeth() / (cos2_base * data.helix_angle.cos());
        let eps_n = pair.eps_alpha / cos2_base;
        inside("contact ratio of the virtual spur gears", eps_n, 1.0, 3.0, "1 .. 3")?;
        inside("overlap ratio", pair.eps_beta, 0.0, f64::MAX, "0 or above")?;

        let section = RootSection::new(gear, virtual_teeth)?;
        let m = data.normal_module;
        let base = 0.5 * m * virtual_teeth * cos_a;
        let tip = 0.5 * m * virtual_teeth + gear.tip_radius() - gear.reference_radius();
        // The load goes from the tip towards the root: on a ring farther away from the base circle.
        let along = (tip * tip - base * base).max(0.0).sqrt() - gear.sign() * PI * m * cos_a * (eps_n - 1.0);
        let (lever, load_angle) = section.lever(gear, virtual_teeth, (along / base.abs()).atan())?;

        let (s, bending) = (section.chord / m, 6.0 * lever / m * load_angle.cos());
        let f_eps = load_share(eps_n, pair.eps_beta);
        let slender = section.chord / lever;
        let notch = section.chord / (2.0 * section.radius);
        inside("notch parameter s_Fn / (2 rho_F)", notch, 1.0, 8.0, "1 .. 8")?;
        let rim_ratio = rim_ratio(gear);
        Ok(Self {
            virtual_teeth,
            root_chord: section.chord,
            lever,
            fillet_radius: section.radius,
            load_angle,
            rim_ratio,
            f_eps,
            y_form: f_eps * bending / (s * s * cos_a),
            y_stress: (1.2 + 0.13 * slender) * notch.powf(1.0 / (1.21 + 2.3 / slender)),
            y_helix: helix_factor(data.helix_angle, pair.eps_beta),
            y_rim: rim_factor(gear, rim_ratio)?,
            y_deep_tooth: if pair.fine { deep_tooth_factor(eps_n) } else { 1.0 },
        })
    }

    /// Nominal tooth root stress, MPa, without any of the load factors K.
    ///
    /// ```text
    /// sigma_F0 = F_t / (b m_n) Y_F Y_S Y_beta Y_B Y_DT
    /// ```
    /// `tangential_force` F_t = T / r on the reference circle, N; `face_width` b and `module` m_n, mm.
    pub fn nominal_stress(&self, tangential_force: f64, face_width: f64, module: f64) -> f64 {
        tangential_force / (face_width * module)
            * (self.y_form * self.y_stress * self.y_helix * self.y_rim * self.y_deep_tooth)
    }
}

/// The tooth between its 30 (internal: 60) degree tangents.
struct RootSection {
    /// s_Fn, mm.
    chord: f64,
    /// rho_F, mm.
    radius: f64,
    /// Distance of the chord from the axis of the virtual gear, mm.
    height: f64,
}

impl RootSection {
    fn new(gear: &Gear, virtual_teeth: f64) -> Result<Self, LumpedError> {
        let data = gear.data();
        if gear.is_internal() {
            let root = ShapedRoot::at_tangent(data, FRAC_PI_3);
            let lacks = || {
                out_of_range("shaper of an internal gear of so many virtual teeth", virtual_teeth, "one that meshes")
            };
            let ShapedRoot { chord, height, fillet_radius: radius } = root.ok_or_else(lacks)?;
            return Ok(Self { chord, radius, height });
        }
        let (sin_a, cos_a) = data.normal_pressure_angle.sin_cos();
        let (m, z, rho) = (data.normal_module, virtual_teeth, data.root_radius_coefficient);
        let e = FRAC_PI_4 + 0.5 * data.thickness_allowance / m
            - data.dedendum_coefficient * sin_a / cos_a
            - (1.0 - sin_a) * rho / cos_a;
        let g = rho - data.dedendum_coefficient + data.profile_shift;
        let h = 2.0 / z * (FRAC_PI_2 - e) - FRAC_PI_3;
        let theta = tangent_angle(2.0 * g / z, h)?;
        let cos = theta.cos();
        let below = g / cos - rho;
        Ok(Self {
            chord: m * (z * (FRAC_PI_3 - theta).sin() + 3f64.sqrt() * below),
            radius: m * (rho + 2.0 * g * g / (cos * (z * cos * cos - 2.0 * g))),
            height: 0.5 * m * (z * (FRAC_PI_3 - theta).cos() + below),
        })
    }

    /// Lever (mm) of a load at pressure angle `alpha_e` of the virtual gear over the chord, and its angle (rad) against
    /// the chord.
    fn lever(&self, gear: &Gear, virtual_teeth: f64, alpha_e: f64) -> Result<(f64, f64), LumpedError> {
        let data = gear.data();
        let (alpha, m) = (data.normal_pressure_angle, data.normal_module);
        let involute = |a: f64| a.tan() - a;
        let thickness = FRAC_PI_2 + 2.0 * data.profile_shift * alpha.tan() - data.thickness_allowance / m;
        let half_angle = thickness / virtual_teeth + involute(alpha) - involute(alpha_e);
        let angle = alpha_e - half_angle;
        let lever = 0.5 * m * virtual_teeth * alpha.cos() / angle.cos() - self.height;
        inside("lever of the load over the root in mm", lever, f64::MIN_POSITIVE, f64::MAX, "above 0")?;
        Ok((lever, angle))
    }
}

/// Root of th = a tan th - h near pi/6, rad.
fn tangent_angle(a: f64, h: f64) -> Result<f64, LumpedError> {
    let mut theta = FRAC_PI_6;
    for _ in 0..100 {
        let tan = theta.tan();
        let step = (theta - a * tan + h) / (1.0 - a * (1.0 + tan * tan));
        // Half of the way to either end at the most: tan has a pole at pi/2.
        let next = (theta - step).clamp(0.5 * theta, 0.5 * (theta + FRAC_PI_2));
        if (next - theta).abs() <= 1e-15 {
            return Ok(next);
        }
        theta = next;
    }
    let residual = (theta - a * theta.tan() + h).abs();
    inside("equation of the 30 degree tangent, what is left of it", residual, 0.0, 1e-12, "0")?;
    Ok(theta)
}

/// f_eps: how much of the load the worst line carries.
fn load_share(eps_n: f64, eps_beta: f64) -> f64 {
    let overlap = eps_beta.min(1.0);
    let alone = match (eps_n < 2.0, eps_beta == 0.0) {
        (true, _) => 1.0 - overlap,
        (false, true) => 0.49,
        (false, false) => 0.5 * (1.0 - overlap),
    };
    (alone + overlap / eps_n).sqrt()
}

/// Y_beta = (1 - eps_beta beta / 120 deg) / cos^3 beta, eps_beta up to 1 and beta up to 30 degrees.
fn helix_factor(helix_angle: f64, eps_beta: f64) -> f64 {
    let beta = helix_angle.abs().min(LARGEST_HELIX_DEG.to_radians());
    (1.0 - eps_beta.min(1.0) * beta.to_degrees() / 120.0) / beta.cos().powi(3)
}

/// s_R / h_t of a gear whose rim reaches from the bore, or the outside of a ring, to the root circle.
pub fn rim_ratio(gear: &Gear) -> f64 {
    (gear.root_radius() - 0.5 * gear.data().bore_diameter) / (gear.tip_radius() - gear.root_radius())
}

/// Y_B by s_R / h_t, of an internal gear by s_R / m_n.
fn rim_factor(gear: &Gear, ratio: f64) -> Result<f64, LumpedError> {
    if gear.is_internal() {
        let modules = ratio * (gear.tip_radius() - gear.root_radius()) / gear.data().normal_module;
        inside("rim thickness of an internal gear over normal module", modules, THINNEST_RING, f64::MAX, "above 1.75")?;
        return Ok(if modules >= SOLID_RING { 1.0 } else { 1.15 * (8.324 / modules).ln() });
    }
    if ratio <= THINNEST_RIM {
        return Err(out_of_range("rim thickness over tooth height", ratio, "above 0.5"));
    }
    Ok(if ratio >= SOLID_RIM { 1.0 } else { 1.6 * (2.242 / ratio).ln() })
}

fn deep_tooth_factor(eps_n: f64) -> f64 {
    match eps_n {
        e if e <= 2.05 => 1.0,
        e if e <= 2.5 => 2.366 - 0.666 * e,
        _ => 0.7,
    }
}

fn inside(quantity: &'static str, value: f64, low: f64, high: f64, allowed: &'static str) -> Result<(), LumpedError> {
    if (low..=high).contains(&value) { Ok(()) } else { Err(out_of_range(quantity, value, allowed)) }
}

fn out_of_range(quantity: &'static str, value: f64, allowed: &'static str) -> LumpedError {
    LumpedError::OutOfRange { quantity, value, method: METHOD, allowed }
}
