//! Scuffing: is the contact warmer than the oil bears? Flash temperature (ISO/TS 6336-20) and integral temperature (ISO/TS 6336-21).

use std::f64::consts::PI;

use serde::Serialize;

use crate::{
    Lubrication, PairGeometry, RatingError, RatingInput, Rolling, StandardRating,
    error::positive,
    flash::{reduced_modulus, test_torque},
};

/// What scuffing depends on beside pitting and bending.
#[derive(Debug, Clone, PartialEq)]
pub struct ScuffingInput<'a> {
    /// The pair under its load.
    pub pair: &'a RatingInput<'a>,
    /// Its rating, which has the load factors.
    pub standard: &'a StandardRating,
    /// Oil and roughness.
    pub lubrication: Lubrication,
    /// Young's moduli of pinion and wheel, MPa.
    pub young: [f64; 2],
    /// Poisson's ratios of pinion and wheel.
    pub poisson: [f64; 2],
    /// Gear that drives: 0 pinion, 1 wheel.
    pub driver: usize,
    /// X_W, structural factor of the flanks.
    pub structural_factor: f64,
}

described::described! {
    /// Flash temperature after ISO/TS 6336-20.
    #[derive(Debug, Clone, Copy, PartialEq, Serialize)]
    pub struct FlashRating {
        /// mu_m where the load is that of X_Gamma = 1/eps_alpha
        pub mean_friction_coefficient: f64,
        /// X_L, with the viscosity at the oil temperature
        pub lubricant_factor: f64,
        /// theta_flm, mean flash temperature over the path of contact
        pub mean_flash_temperature_k: f64,
        /// theta_M, bulk temperature
        pub bulk_temperature_c: f64,
        /// theta_B,max, highest contact temperature behind the start of approach
        pub contact_temperature_c: f64,
        /// Gamma of that temperature: 0 at the pitch point, below 0 towards the tip of the wheel
        pub contact_temperature_at: f64,
        /// X_J there
        pub approach_factor: f64,
        /// X_Gamma there
        pub load_sharing_factor: f64,
        /// theta_S, scuffing temperature of the oil
        pub scuffing_temperature_c: f64,
        /// S_B = (theta_S - theta_oil)/(theta_B,max - theta_oil)
        pub safety: f64,
        /// contact temperature at the very start of approach, where X_J is largest
        pub start_temperature_c: f64,
        /// S_B of that temperature
        pub start_safety: f64,
    }
}

described::described! {
    /// Integral temperature after ISO/TS 6336-21.
    #[derive(Debug, Clone, Copy, PartialEq, Serialize)]
    pub struct IntegralRating {
        /// mu_mC
        pub mean_friction_coefficient: f64,
        /// X_eps
        pub contact_ratio_factor: f64,
        /// X_BE
        pub geometry_factor: f64,
        /// X_Q
        pub approach_factor: f64,
        /// X_Ca
        pub tip_relief_factor: f64,
        /// theta_flaint, mean flash temperature
        pub mean_flash_temperature_k: f64,
        /// theta_M, bulk temperature
        pub bulk_temperature_c: f64,
        /// theta_int
        pub integral_temperature_c: f64,
        /// theta_intS, scuffing integral temperature of the oil
        pub scuffing_temperature_c: f64,
        /// S_intS = theta_intS/theta_int
        pub safety: f64,
    }
}

described::described! {
    /// Scuffing of a pair; units are in the names.
    #[derive(Debug, Clone, Copy, PartialEq, Serialize)]
    pub struct ScuffingRating {
        /// w_Bt = F_t/b K_A K_V K_Hbeta K_Halpha
        pub line_load_n_per_mm: f64,
        /// K_Bgamma, helical load factor
        pub helical_load_factor: f64,
        /// X_M, thermo-elastic factor of equal gears, K N^-0.75 s^0.5 m^-0.5 mm
        pub thermo_elastic_factor: f64,
        /// X_alphabeta, angle factor
        pub angle_factor: f64,
        /// C_eff = K_A F_t/(b c_gamma_alpha), optimal tip relief
        pub optimal_tip_relief_um: f64,
        /// C_a, tip relief that counts, C_eff at the most
        pub tip_relief_um: f64,
        /// eta_oil, dynamic viscosity at the oil temperature
        pub oil_viscosity_mpa_s: f64,
        /// flash temperature
        pub flash: FlashRating,
        /// integral temperature
        pub integral: IntegralRating,
    }
}

impl ScuffingRating {
    /// The smallest of the three safeties.
    pub fn least_safety(&self) -> f64 {
        self.flash.safety.min(self.flash.start_safety).min(self.integral.safety)
    }
}

const FLASH: &str = "ISO/TS 6336-20";
const INTEGRAL: &str = "ISO/TS 6336-21";
/// Places on the path of contact.
const STEPS: u32 = 100;
/// Constant of the flash temperature in ISO/TS 6336-20.
pub(crate) const BLOK: f64 = 1.11;

/// K_Bgamma, helical load factor: 1 up to eps_gamma = 2, `1 + 0.2 sqrt[(eps_gamma - 2)(5 - eps_gamma)]` up to 3.5, else 1.3. Source: ISO/TS 6336-21.
pub(crate) fn helical_load_factor(eps_gamma: f64) -> f64 {
    match eps_gamma {
        e if e <= 2.0 => 1.0,
        e if e < 3.5 => 1.0 + 0.2 * ((e - 2.0) * (5.0 - e)).sqrt(),
        _ => 1.3,
    }
}

/// X_Ca, tip relief factor: `1 + [0.06 + 0.18 C_a/C_eff] e + [0.02 + 0.69 C_a/C_eff] e^2`, e the larger one of eps_1 and eps_2. Source: ISO/TS 6336-21.
pub(crate) fn tip_relief_factor(relief_share: f64, eps: [f64; 2]) -> f64 {
    let e = eps[0].max(eps[1]);
    1.0 + (0.06 + 0.18 * relief_share) * e + (0.02 + 0.69 * relief_share) * e * e
}

/// mu of ISO/TS 6336-21 and -22: `0.045 (w/(v_Sigma rho_n))^0.2 X_L eta^-0.05 X_R`, `X_R = 2.2 (R_a/rho_n)^0.25`.
///
/// `line_load` w, N/mm; `rolling_speed` v_Sigma, m/s; `radius` rho_n, mm.
pub(crate) fn friction(lubrication: &Lubrication, line_load: f64, rolling_speed: f64, radius: f64) -> f64 {
    let rough = 2.2 * (lubrication.roughness_um() / radius).powf(0.25);
    0.045 * (line_load / (rolling_speed * radius)).powf(0.2) * lubrication.lubricant_factor() * rough
}

/// X_mp = (1 + n_p)/2 of n_p mates of a gear.
pub(crate) fn mates_factor(pair: &RatingInput<'_>) -> f64 {
    0.5 * (1.0 + pair.gears[0].meshes_per_turn.max(pair.gears[1].meshes_per_turn))
}

impl<'a> ScuffingInput<'a> {
    /// Both B_M, N/(mm s^0.5 K).
    ///
    /// # Errors
    /// [`RatingError::MaterialLacks`].
    pub fn thermal_contact(&self) -> Result<[f64; 2], RatingError> {
        let of = |i: usize| self.pair.gears[i].material.thermal_contact_coefficient(self.pair.gears[i].density);
        Ok([of(0)?, of(1)?])
    }

    /// C_eff and the share of it that the tip relief has, 1 at the most.
    pub(crate) fn tip_relief(&self) -> (f64, f64) {
        let geometry = &self.pair.geometry;
        let load = self.standard.tangential_force_n * self.standard.application_factor / geometry.face_width;
        let optimal = load / self.pair.stiffness.mesh;
        (optimal, (self.pair.tip_relief() / optimal).min(1.0))
    }

    /// eps_1 and eps_2, contact ratios of the addenda of pinion and wheel.
    pub(crate) fn addendum_contact_ratios(&self) -> [f64; 2] {
        Path::new(&self.pair.geometry).map_or([0.0; 2], |path| path.eps)
    }

    /// E_r, MPa.
    pub(crate) fn reduced_modulus(&self) -> f64 {
        reduced_modulus(self.young, self.poisson)
    }

    /// w_Bt, N/mm.
    pub(crate) fn line_load(&self) -> f64 {
        let r = self.standard;
        let factors = r.application_factor * r.dynamic_factor * r.face_load_factor * r.transverse_load_factor;
        factors * r.tangential_force_n / self.pair.geometry.face_width
    }

    /// Load stage of the scuffing test at which the oil failed.
    fn load_stage(&self) -> Result<f64, RatingError> {
        let oil = &self.lubrication.lubricant;
        oil.scuffing_load_stage.ok_or_else(|| RatingError::LubricantLacks {
            lubricant: oil.name.clone(),
            key: "scuffing_load_stage",
            clause: "the scuffing temperature of ISO/TS 6336-20 and -21",
        })
    }

    /// theta_S of the flash temperature, C: `80 + (0.85 + 1.4 X_W) X_L S_FZG^2`.
    ///
    /// # Errors
    /// [`RatingError::LubricantLacks`].
    pub(crate) fn scuffing_temperature(&self) -> Result<f64, RatingError> {
        let stage = self.load_stage()?;
        let factor = self.lubrication.lubricant_factor();
        Ok(80.0 + (0.85 + 1.4 * self.structural_factor) * factor * stage * stage)
    }
}

/// Rates a pair for scuffing.
///
/// # Errors
/// [`RatingError`] where material or lubricant lack a number, or one has no meaning for a formula.
pub fn scuffing_rating(input: &ScuffingInput<'_>) -> Result<ScuffingRating, RatingError> {
    let lubrication = input.lubrication.checked()?;
    positive("the structural factor X_W", input.structural_factor, FLASH)?;
    let path = Path::new(&input.pair.geometry)?;
    let (optimal, share) = input.tip_relief();
    let contact = input.thermal_contact()?;
    let w = positive("the line load w_Bt in N/mm", input.line_load(), FLASH)?;
    let thermo_elastic = input.reduced_modulus().powf(0.25) * 1000f64.sqrt() / (0.5 * (contact[0] + contact[1]));
    Ok(ScuffingRating {
        line_load_n_per_mm: w,
        helical_load_factor: helical_load_factor(input.pair.geometry.eps_gamma()),
        thermo_elastic_factor: thermo_elastic,
        angle_factor: path.angle_factor(),
        optimal_tip_relief_um: optimal,
        tip_relief_um: share * optimal,
        oil_viscosity_mpa_s: lubrication.viscosity_mpa_s(),
        flash: flash(input, &path, contact)?,
        integral: integral(input, &path, thermo_elastic)?,
    })
}

/// The path of contact in the parameter Gamma = tan(alpha_y1)/tan(alpha_wt) - 1 of the standards.
pub(crate) struct Path<'a> {
    geometry: &'a PairGeometry,
    /// Gamma of A and E, the ends at the tips of wheel and pinion.
    pub ends: [f64; 2],
    /// Gamma of B and D, between which a single pair carries.
    pub single: [f64; 2],
    /// eps_1 and eps_2, contact ratios of the addenda of pinion and wheel.
    pub eps: [f64; 2],
}

impl<'a> Path<'a> {
    /// The path of a pair whose flanks are curved all along it.
    pub fn new(geometry: &'a PairGeometry) -> Result<Self, RatingError> {
        let line = geometry.centre_distance * geometry.working_pressure_angle.sin();
        let [start, end] = geometry.path_of_contact;
        positive("the radius of curvature of the pinion at the start of the path of contact in mm", start, FLASH)?;
        let of_wheel = geometry.sign() * (line - end);
        positive("the radius of curvature of the wheel at the end of the path of contact in mm", of_wheel, FLASH)?;
        positive("the length of the path of contact in mm", end - start, FLASH)?;
        let ends = geometry.path_of_contact.map(|radius| radius / geometry.pitch_radii()[0] - 1.0);
        let pitch = 2.0 * PI / (f64::from(geometry.teeth[0]) * geometry.working_pressure_angle.tan());
        let eps = [ends[1] / pitch, -ends[0] / pitch];
        Ok(Self { geometry, ends, single: [ends[1] - pitch, ends[0] + pitch], eps })
    }

    /// X_Gamma, share of the load without profile modification.
    ///
    /// ```text
    /// spur:           1/3 at A and E, 2/3 at B and D, straight between; 1 from B to D
    /// helical:        that times X_but (eps_beta up to 0.8); X_but/eps_alpha (eps_beta of 1.2 and more); linear between
    /// X_but           1 + 0.3 eps_beta (1.3 at the most) at A and E, falling to 1 within 0.2 sin(beta_b)
    /// ```
    /// Source: ISO/TS 6336-20, load sharing factor and buttressing factor; tolerance class 7 and better.
    pub fn load_share(&self, gamma: f64) -> f64 {
        let ([a, e], [b, d]) = (self.ends, self.single);
        let eps_alpha = self.eps[0] + self.eps[1];
        let eps_beta = self.geometry.eps_beta;
        let spur = match gamma {
            // Two pairs or more at any place.
            _ if eps_alpha >= 2.0 => 1.0 / eps_alpha,
            g if g < b => (1.0 + (g - a) / (b - a)) / 3.0,
            g if g > d => (1.0 + (e - g) / (e - d)) / 3.0,
            _ => 1.0,
        };
        let (reach, top) = (0.2 * self.geometry.base_helix_angle.sin(), 1.0 + 0.3 * eps_beta.min(1.0));
        let inside = (gamma - a).min(e - gamma).max(0.0);
        let buttress = if inside < reach { top - (top - 1.0) * inside / reach } else { 1.0 };
        let wide = ((eps_beta - 0.8) / 0.4).clamp(0.0, 1.0);
        buttress * (wide / eps_alpha + (1.0 - wide) * spur)
    }

    /// Transverse radii of curvature at a place, mm, negative where the flank is hollow.
    pub fn radii(&self, gamma: f64) -> [f64; 2] {
        let [one, two] = self.geometry.pitch_radii();
        [one * (1.0 + gamma), two * (1.0 - gamma / self.geometry.ratio())]
    }

    /// X_alphabeta: `1.22 sin^0.25(alpha_wt) cos^0.25(alpha_n) cos^0.25(beta) / [cos^0.5(alpha_wt) cos^0.5(alpha_t)]`.
    fn angle_factor(&self) -> f64 {
        let g = self.geometry;
        let quarter = g.working_pressure_angle.sin() * g.normal_pressure_angle.cos() * g.helix_angle.cos();
        let half = g.working_pressure_angle.cos() * g.transverse_pressure_angle.cos();
        1.22 * quarter.powf(0.25) / half.sqrt()
    }
}

/// Flash temperatures along the path, from the start of approach to the end of recess.
///
/// ```text
/// theta_fl = mu X_M X_J X_G (X_Gamma w_Bt)^0.75 v^0.5 / a^0.25,   theta_M = theta_oil + 0.47 X_S X_mp theta_flm
/// X_G      = 0.51 X_ab sqrt(u + 1) |sqrt(1 + Gamma) - sqrt(1 - Gamma/u)| / [(1 + Gamma)(u - Gamma)]^0.25
/// mu       = 0.06 [X_Gamma w_Bt/(v_t rho_nC)]^0.2 X_L R_a^0.25,    v_t speed of the working pitch circle
/// X_J      = 1 + (C_eff - C_a)/50 um (|Gamma|/(Gamma_E - Gamma_A))^3 in approach
/// ```
/// Roots of negative numbers of internal pairs are those of their sizes. The mean and the largest value are of a hundred places, each at the end of its step: the start of approach, a single point, is told apart. v_t and X_Gamma in mu, and these places, are those with which the published rating of NREL's third stage has its printed numbers. Source: ISO/TS 6336-20.
fn flash(input: &ScuffingInput<'_>, path: &Path<'_>, contact: [f64; 2]) -> Result<FlashRating, RatingError> {
    let (geometry, lubrication) = (path.geometry, &input.lubrication);
    let speed = PI / 60_000.0 * geometry.reference_diameter[0] * input.pair.pinion_speed_rpm;
    let working_speed = PI / 60_000.0 * geometry.working_diameter()[0] * input.pair.pinion_speed_rpm;
    let radius = geometry.pitch_relative_radius() / geometry.base_helix_angle.cos();
    let (w, u) = (input.line_load(), geometry.ratio());
    let friction = |share: f64| {
        let load = (share * w / (working_speed * radius)).powf(0.2);
        0.06 * load * lubrication.lubricant_factor() * lubrication.roughness_um().powf(0.25)
    };
    let (optimal, relief) = input.tip_relief();
    let length = path.ends[1] - path.ends[0];
    // Towards the pinion's tip is recess where the pinion drives.
    let sense = if input.driver == 0 { 1.0 } else { -1.0 };
    let approach = |gamma: f64| {
        let before = (-sense * gamma).max(0.0) / length;
        1.0 + optimal * (1.0 - relief) / 50.0 * before.powi(3)
    };
    let at = |gamma: f64| {
        let (one, two) = (1.0 + gamma, 1.0 - gamma / u);
        let (root_one, root_two) = (one.sqrt(), two.sqrt());
        let material = input.reduced_modulus().powf(0.25) * 1000f64.sqrt() * (root_one + root_two)
            / (contact[0] * root_one + contact[1] * root_two);
        let shape = 0.51 * path.angle_factor() * (u + 1.0).abs().sqrt() * (root_one - root_two).abs()
            / (one * u.abs() * two).powf(0.25);
        let share = path.load_share(gamma);
        let load = (share * w).powf(0.75) * speed.sqrt() / geometry.centre_distance.abs().powf(0.25);
        friction(share) * material * approach(gamma) * shape * load
    };
    let start = if input.driver == 0 { path.ends[0] } else { path.ends[1] };
    let places = (1..=STEPS).map(|i| start + sense * length * f64::from(i) / f64::from(STEPS));
    let all: Vec<(f64, f64)> = places.map(|gamma| (gamma, at(gamma))).collect();
    let mean = all.iter().map(|(_, t)| t).sum::<f64>() / f64::from(STEPS);
    let (hottest, rise) = all.into_iter().fold((start, 0.0), |best, now| if now.1 > best.1 { now } else { best });
    let oil = lubrication.oil_temperature_c;
    let bulk = oil + 0.47 * lubrication.method.factor() * mates_factor(input.pair) * mean;
    let scuffing = input.scuffing_temperature()?;
    let safety = |contact: f64| (scuffing - oil) / (contact - oil);
    let beginning = bulk + at(start);
    positive("the flash temperature in K", rise, FLASH)?;
    Ok(FlashRating {
        mean_friction_coefficient: friction(1.0 / (path.eps[0] + path.eps[1])),
        lubricant_factor: lubrication.lubricant_factor(),
        mean_flash_temperature_k: mean,
        bulk_temperature_c: bulk,
        contact_temperature_c: bulk + rise,
        contact_temperature_at: hottest,
        approach_factor: approach(hottest),
        load_sharing_factor: path.load_share(hottest),
        scuffing_temperature_c: scuffing,
        safety: safety(bulk + rise),
        start_temperature_c: beginning,
        start_safety: safety(beginning),
    })
}

/// Integral temperature.
///
/// ```text
/// theta_int    = theta_M + 1.5 theta_flaint,   theta_M = theta_oil + 0.7 X_S X_mp theta_flaint,   theta_flaint = theta_flaE X_eps
/// theta_flaE   = mu_mC X_M X_BE X_ab (K_Bgamma w_Bt)^0.75 v^0.5 / a^0.25 / (X_Q X_Ca),   X_E = 1 (run in)
/// theta_intS   = 80 + 0.23 T_1T X_L + 1.5 X_W 0.2 T_1T (100/nu_40)^0.02 X_L
/// ```
/// T_1T torque of the test's load stage, N m. Source: ISO/TS 6336-21.
fn integral(input: &ScuffingInput<'_>, path: &Path<'_>, thermo_elastic: f64) -> Result<IntegralRating, RatingError> {
    let (geometry, lubrication) = (path.geometry, &input.lubrication);
    let load = input.line_load() * helical_load_factor(geometry.eps_gamma());
    let speed = PI / 60_000.0 * geometry.reference_diameter[0] * input.pair.pinion_speed_rpm;
    let pitch = Rolling::new(geometry, input.pair.pinion_speed_rpm).pitch();
    let pitch = pitch.ok_or(RatingError::OutOfRange {
        quantity: "the smaller radius of curvature at the pitch point in mm",
        value: 0.0,
        clause: INTEGRAL,
        allowed: "a positive number",
    })?;
    let mu = friction(lubrication, load, pitch.rolling_speed(), pitch.relative_radius);
    let radii = path.radii(path.ends[1]);
    let u = geometry.ratio();
    let shape = 0.51 * (u + 1.0).abs().sqrt() * (radii[0].sqrt() - (radii[1] / u).sqrt())
        / (radii[0] * radii[1].abs()).powf(0.25);
    let (_, relief) = input.tip_relief();
    let relief = tip_relief_factor(relief, path.eps);
    // Approach is at the tip of the driven gear.
    let [recess, approach] = [path.eps[input.driver], path.eps[1 - input.driver]];
    let meeting = match approach / recess {
        q if q <= 1.5 => 1.0,
        q if q < 3.0 => 1.4 - 4.0 / 15.0 * q,
        _ => 0.6,
    };
    let eps = contact_ratio_factor(path.eps);
    let at_tip = mu * thermo_elastic * shape * path.angle_factor() * load.powf(0.75) * speed.sqrt()
        / geometry.centre_distance.abs().powf(0.25)
        / (meeting * relief);
    let mean = positive("the mean flash temperature in K", at_tip * eps, INTEGRAL)?;
    let oil = lubrication.oil_temperature_c;
    let bulk = oil + 0.7 * lubrication.method.factor() * mates_factor(input.pair) * mean;
    let integral = bulk + 1.5 * mean;
    let stage = input.load_stage()?;
    let torque = test_torque(stage).ok_or(RatingError::OutOfRange {
        quantity: "the load stage of the scuffing test",
        value: stage,
        clause: "ISO 14635-1",
        allowed: "1 .. 14",
    })?;
    let warm = (100.0 / lubrication.lubricant.viscosity_40c_mm2_per_s).powf(0.02);
    let base = lubrication.base_factor();
    let scuffing = 80.0 + 0.23 * torque * base + 1.5 * input.structural_factor * 0.2 * torque * warm * base;
    Ok(IntegralRating {
        mean_friction_coefficient: mu,
        contact_ratio_factor: eps,
        geometry_factor: shape,
        approach_factor: meeting,
        tip_relief_factor: relief,
        mean_flash_temperature_k: mean,
        bulk_temperature_c: bulk,
        integral_temperature_c: integral,
        scuffing_temperature_c: scuffing,
        safety: scuffing / integral,
    })
}

/// X_eps, contact ratio factor of addendum contact ratios eps_1, eps_2.
///
/// ```text
/// eps_alpha < 1:         1/(2 eps_alpha eps_1) (eps_1^2 + eps_2^2)
/// both below 1:          1/(2 eps_alpha eps_1) [0.70 (eps_1^2 + eps_2^2) - 0.22 eps_alpha + 0.52 - 0.60 eps_1 eps_2]
/// eps_1 of 1 and more:   1/(2 eps_alpha eps_1) [0.18 eps_1^2 + 0.70 eps_2^2 + 0.82 eps_1 - 0.52 eps_2 - 0.30 eps_1 eps_2]
/// eps_2 of 1 and more:   1/(2 eps_alpha eps_1) [0.70 eps_1^2 + 0.18 eps_2^2 - 0.52 eps_1 + 0.82 eps_2 - 0.30 eps_1 eps_2]
/// eps_alpha of 2, more:  1/(2 eps_alpha eps_1) [0.44 L^2 + 0.59 S^2 + 0.30 L - 0.30 S - 0.15 L S],   L, S the larger and smaller one
/// ```
/// Source: ISO/TS 6336-21, contact ratio factor.
fn contact_ratio_factor([one, two]: [f64; 2]) -> f64 {
    let alpha = one + two;
    let bracket = if alpha < 1.0 {
        one * one + two * two
    } else if alpha >= 2.0 {
        let (large, small) = (one.max(two), one.min(two));
        0.44 * large * large + 0.59 * small * small + 0.30 * large - 0.30 * small - 0.15 * large * small
    } else if one >= 1.0 {
        0.18 * one * one + 0.70 * two * two + 0.82 * one - 0.52 * two - 0.30 * one * two
    } else if two >= 1.0 {
        0.70 * one * one + 0.18 * two * two - 0.52 * one + 0.82 * two - 0.30 * one * two
    } else {
        0.70 * (one * one + two * two) - 0.22 * alpha + 0.52 - 0.60 * one * two
    };
    bracket / (2.0 * alpha * one)
}
