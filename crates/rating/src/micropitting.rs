//! Micropitting by the load sharing of the standard: the film at seven contact points. ISO/TS 6336-22, method B.

use std::f64::consts::{PI, TAU};

use serde::Serialize;

use crate::{
    RatingError, Rolling, ScuffingInput,
    error::positive,
    film::{Film, bulk_temperature},
    permissible_film,
    scuffing::{Path, friction, helical_load_factor, tip_relief_factor},
};

const CLAUSE: &str = "ISO/TS 6336-22, method B";

described::described! {
    /// Micropitting after ISO/TS 6336-22, method B: the thinnest film of the contact points A, AB, B, C, D, DE and E.
    #[derive(Debug, Clone, Copy, PartialEq, Serialize)]
    pub struct StandardMicropitting {
        /// H_v, tooth loss factor
        pub tooth_loss_factor: f64,
        /// theta_M, bulk temperature from P mu_m H_v
        pub bulk_temperature_c: f64,
        /// contact point with the thinnest film: A, AB, B, C, D, DE or E
        pub point: &'static str,
        /// diameter of the pinion there
        pub pinion_diameter_mm: f64,
        /// p_dyn,Y there, pressure of Hertz under w_Bt
        pub pressure_mpa: f64,
        /// h, film thickness there
        pub film_thickness_um: f64,
        /// lambda_GF,min = h/R_a
        pub specific_film_thickness: f64,
        /// S_lambda = lambda_GF,min/lambda_GFP
        pub safety: f64,
    }
}

/// Rates a pair for micropitting by the load sharing of unmodified profiles; `None` for transverse contact ratios of 2 and above, whose H_v has no closed form here.
///
/// ```text
/// p_dyn,Y = sqrt[w_Bt X_Y E_r/(2 pi rho_n,Y cos(alpha_t) cos(beta_b))],   w_Bt = F_t/b K_A K_V K_Hbeta K_Halpha,   X_Y of ISO/TS 6336-20
/// H_v     = pi (1/z_1 + 1/z_2)/cos(beta_b) (1 - eps_1 - eps_2 + eps_1^2 + eps_2^2)      (1/z_1 - 1/|z_2| with a ring)
/// ```
/// `material_factor` W_W and `permissible` lambda_GFP as of [`permissible_film`]. Source: ISO/TS 6336-22, method B; H_v: ISO/TR 14179-2 (Ohlendorf).
///
/// # Errors
/// [`RatingError`] where material or lubricant lack a number, or one has no meaning for a formula.
pub fn standard_micropitting(
    input: &ScuffingInput<'_>,
    material_factor: f64,
    permissible: Option<f64>,
) -> Result<Option<StandardMicropitting>, RatingError> {
    let (geometry, lubrication) = (&input.pair.geometry, input.lubrication.checked()?);
    let (permissible, _) = permissible_film(&lubrication.lubricant, material_factor, permissible)?;
    let path = Path::new(geometry)?;
    if path.eps[0] + path.eps[1] >= 2.0 {
        return Ok(None);
    }
    let rolling = Rolling::new(geometry, input.pair.pinion_speed_rpm);
    let Some(pitch) = rolling.pitch() else { return Ok(None) };
    let load = positive("the line load w_Bt in N/mm", input.line_load(), CLAUSE)?;
    let inclined = geometry.transverse_pressure_angle.cos();
    let raised = load / inclined * helical_load_factor(geometry.eps_gamma());
    let mu = friction(lubrication, raised, pitch.rolling_speed(), pitch.relative_radius);
    let [one, two] = path.eps;
    let teeth = 1.0 / f64::from(geometry.teeth[0]) * (1.0 + geometry.sign() / geometry.ratio().abs());
    let loss_factor = PI * teeth / geometry.base_helix_angle.cos() * (1.0 - one - two + one * one + two * two);
    let speed = PI / 60_000.0 * geometry.reference_diameter[0] * input.pair.pinion_speed_rpm;
    let power_kw = 1e-3 * input.standard.tangential_force_n * input.standard.application_factor * speed;
    let area = geometry.centre_distance.abs() * geometry.face_width;
    let relief = tip_relief_factor(input.tip_relief().1, path.eps);
    let film = Film {
        lubrication: lubrication.clone(),
        reduced_modulus: input.reduced_modulus(),
        contact: input.thermal_contact()?,
        friction: mu,
        bulk_temperature_c: bulk_temperature(lubrication, power_kw * mu * loss_factor, area, relief),
    };
    let ([a, e], [b, d]) = (path.ends, path.single);
    let points = [("A", a), ("AB", 0.5 * (a + b)), ("B", b), ("C", 0.0), ("D", d), ("DE", 0.5 * (d + e)), ("E", e)];
    let along = inclined * geometry.base_helix_angle.cos();
    let of_point = |(point, gamma): (&'static str, f64)| {
        let radii = path.radii(gamma);
        let place = rolling.at(radii.map(f64::abs))?;
        let carried = load * path.load_share(gamma) * film.reduced_modulus;
        let pressure = (carried / (TAU * place.relative_radius * along)).sqrt();
        let thickness = film.thickness_um(&place, pressure);
        Some((point, 2.0 * radii[0], pressure, thickness))
    };
    let thinnest = points.into_iter().filter_map(of_point).min_by(|p, q| p.3.total_cmp(&q.3));
    Ok(thinnest.map(|(point, twice_radius, pressure, thickness)| {
        let specific = thickness / lubrication.roughness_um();
        StandardMicropitting {
            tooth_loss_factor: loss_factor,
            bulk_temperature_c: film.bulk_temperature_c,
            point,
            pinion_diameter_mm: geometry.base_diameter[0].hypot(twice_radius),
            pressure_mpa: pressure,
            film_thickness_um: thickness,
            specific_film_thickness: specific,
            safety: specific / permissible,
        }
    }))
}
