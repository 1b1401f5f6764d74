//! Friction, heat and film of the solved contact: what its own pressures and line loads do to oil and flanks, place by place. ISO/TS 6336-20 and -22 with the load of method A.

use serde::Serialize;

use crate::{
    Lubrication, RatingError, Rolling, RollingPlace, ScuffingInput,
    film::{Film, bulk_temperature, test_specific_film},
    flash::flash_temperature,
    scuffing::{BLOK, friction, helical_load_factor, mates_factor, tip_relief_factor},
};

/// A place of the solved contact at a position of the mesh.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PressedPlace {
    /// Transverse radii of curvature of both flanks, mm.
    pub radii: [f64; 2],
    /// Normal force, N.
    pub force: f64,
    /// Line load, N/mm.
    pub line_load: f64,
    /// Pressure of Hertz, MPa.
    pub pressure: f64,
    /// Whether a tip edge presses, which has no curvature that is known.
    pub is_edge: bool,
}

described::described! {
    /// What sliding flanks lose with the friction of their oil.
    #[derive(Debug, Clone, Copy, PartialEq, Serialize)]
    pub struct MeshLoss {
        /// mean coefficient of friction: loss over the work of the normal forces along the sliding
        pub mean_friction_coefficient: f64,
        /// P_VZ, mean power that the mesh loses under the nominal load
        pub mesh_loss_w: f64,
        /// 1 less that loss over the power of the driver: sliding of the teeth alone, without bearings, churning and seals
        pub efficiency: f64,
    }
}

described::described! {
    /// Contact temperature of the solved contact.
    #[derive(Debug, Clone, Copy, PartialEq, Serialize)]
    pub struct LocalScuffing {
        /// mean flash temperature of all loaded places
        pub mean_flash_temperature_k: f64,
        /// bulk temperature with that mean
        pub bulk_temperature_c: f64,
        /// highest contact temperature
        pub contact_temperature_c: f64,
        /// diameter of the pinion at that place
        pub pinion_diameter_mm: f64,
        /// S_B = (theta_S - theta_oil)/(contact temperature - theta_oil)
        pub safety: f64,
    }
}

described::described! {
    /// Micropitting of the solved contact after ISO/TS 6336-22, method A.
    #[derive(Debug, Clone, Copy, PartialEq, Serialize)]
    pub struct MicropittingRating {
        /// theta_M, bulk temperature from the loss of the mesh
        pub bulk_temperature_c: f64,
        /// mu_m
        pub mean_friction_coefficient: f64,
        /// least film thickness h
        pub film_thickness_um: f64,
        /// lambda_GF,min = h/R_a, least specific film thickness
        pub specific_film_thickness: f64,
        /// diameter of the pinion at that place
        pub pinion_diameter_mm: f64,
        /// lambda_GFT of the test gears; missing where `permissible_specific_film_thickness` is stated
        #[serde(skip_serializing_if = "Option::is_none")]
        pub test_specific_film_thickness: Option<f64>,
        /// lambda_GFP, permissible specific film thickness
        pub permissible_specific_film_thickness: f64,
        /// S_lambda = lambda_GF,min/lambda_GFP
        pub safety: f64,
    }
}

/// The solved contact of a pair with its oil.
#[derive(Debug, Clone)]
pub struct SolvedContact {
    lubrication: Lubrication,
    rolling: Rolling,
    /// Places with their kinematics, all positions together.
    places: Vec<(PressedPlace, RollingPlace)>,
    /// Number of positions.
    positions: f64,
    /// Power of the driver, W.
    power_w: f64,
}

impl SolvedContact {
    /// Contact of a mesh cycle: `places` of all positions, which are so many and equally far from each other. `power_w` mean power of the driver, W. Places where a flank has no curvature are left out.
    pub fn new(
        lubrication: Lubrication,
        rolling: Rolling,
        places: impl IntoIterator<Item = PressedPlace>,
        positions: usize,
        power_w: f64,
    ) -> Self {
        let places = places.into_iter().filter_map(|p| Some((p, rolling.at(p.radii)?))).collect();
        Self { lubrication, rolling, places, positions: positions.max(1) as f64, power_w }
    }

    /// Loss of the mesh under the solved load; `None` where nothing slides or no power flows.
    ///
    /// ```text
    /// P_VZ = mean over the positions of sum mu F v_g,   mu = 0.045 (w/(v_Sigma rho_n))^0.2 X_L eta^-0.05 2.2 (R_a/rho_n)^0.25
    /// ```
    /// The friction of the standard with the line load w, the speeds and the radius of each place. Source: ISO/TS 6336-22, mean coefficient of friction.
    pub fn loss(&self) -> Option<MeshLoss> {
        let sum = |mu: &dyn Fn(&PressedPlace, &RollingPlace) -> f64| -> f64 {
            self.places.iter().map(|(p, at)| mu(p, at) * p.force * at.sliding_speed()).sum::<f64>() / self.positions
        };
        let slides = sum(&|_, _| 1.0);
        let lost = sum(&|p, at| friction(&self.lubrication, p.line_load, at.rolling_speed(), at.relative_radius));
        (slides > 0.0 && self.power_w > 0.0).then(|| MeshLoss {
            mean_friction_coefficient: lost / slides,
            mesh_loss_w: lost,
            efficiency: 1.0 - lost / self.power_w,
        })
    }

    /// Places of flank on flank.
    fn flanks(&self) -> impl Iterator<Item = &(PressedPlace, RollingPlace)> {
        self.places.iter().filter(|(p, _)| !p.is_edge && p.pressure > 0.0)
    }

    /// Contact temperature of the solved contact; `None` without a loaded place of flank on flank.
    ///
    /// ```text
    /// theta_B = theta_M + theta_fl,   theta_fl by Blok with p sqrt(K_A K_V),   mu = 0.06 [w cos(alpha_t)/(v_t rho_nC)]^0.2 X_L R_a^0.25
    /// theta_M = theta_oil + 0.47 X_S X_mp (mean theta_fl)
    /// ```
    /// Tip edges are left out: their curvature is not known. Source: ISO/TS 6336-20.
    ///
    /// # Errors
    /// [`RatingError`] as [`crate::scuffing_rating`].
    pub fn scuffing(&self, input: &ScuffingInput<'_>) -> Result<Option<(LocalScuffing, ContactField)>, RatingError> {
        let field = ContactField::heat(self, input)?;
        let (mut sum, mut count, mut hottest) = (0.0, 0.0_f64, None::<(f64, f64)>);
        for (p, at) in self.flanks() {
            let flash = field.flash(at, p.pressure);
            sum += flash;
            count += 1.0;
            if hottest.is_none_or(|(most, _)| flash > most) {
                hottest = Some((flash, p.radii[0]));
            }
        }
        let Some((flash, radius)) = hottest else { return Ok(None) };
        let oil = self.lubrication.oil_temperature_c;
        let mean = sum / count;
        let bulk = oil + 0.47 * self.lubrication.method.factor() * mates_factor(input.pair) * mean;
        let field = ContactField { bulk_temperature_c: bulk, ..field };
        let contact = bulk + flash;
        let rating = LocalScuffing {
            mean_flash_temperature_k: mean,
            bulk_temperature_c: bulk,
            contact_temperature_c: contact,
            pinion_diameter_mm: pinion_diameter(input, radius),
            safety: (input.scuffing_temperature()? - oil) / (contact - oil),
        };
        Ok(Some((rating, field)))
    }

    /// Least film of the solved contact and its safety; `None` without a loaded place of flank on flank.
    ///
    /// ```text
    /// S_lambda = lambda_GF,min/lambda_GFP,   lambda_GF = h/R_a with p sqrt(K_A K_V),   lambda_GFP = 1.4 W_W lambda_GFT (method B) unless stated
    /// ```
    /// `material_factor` W_W; `permissible` lambda_GFP where it is stated. Tip edges are left out. Source: ISO/TS 6336-22, method A of the film.
    ///
    /// # Errors
    /// [`RatingError`] where material or lubricant lack a number.
    pub fn micropitting(
        &self,
        input: &ScuffingInput<'_>,
        material_factor: f64,
        permissible: Option<f64>,
    ) -> Result<Option<(MicropittingRating, FilmField)>, RatingError> {
        let (permissible, test) = permissible_film(&self.lubrication.lubricant, material_factor, permissible)?;
        let Some(loss) = self.loss() else { return Ok(None) };
        let geometry = &input.pair.geometry;
        let Some(pitch) = self.rolling.pitch() else { return Ok(None) };
        let load =
            input.line_load() / geometry.transverse_pressure_angle.cos() * helical_load_factor(geometry.eps_gamma());
        let mu = friction(&self.lubrication, load, pitch.rolling_speed(), pitch.relative_radius);
        // The loss of the nominal forces with the friction of the raised ones: mu grows with w^0.2.
        let lost = 1e-3 * loss.mesh_loss_w * load_factor(input).powf(0.2);
        let area = geometry.centre_distance.abs() * geometry.face_width;
        let relief = tip_relief_factor(input.tip_relief().1, input.addendum_contact_ratios());
        let film = Film {
            lubrication: self.lubrication.clone(),
            reduced_modulus: input.reduced_modulus(),
            contact: input.thermal_contact()?,
            friction: mu,
            bulk_temperature_c: bulk_temperature(&self.lubrication, lost, area, relief),
        };
        let field = FilmField { film, rolling: self.rolling, pressure_factor: load_factor(input).sqrt() };
        let thinnest = self.flanks().map(|(p, at)| (field.thickness(at, p.pressure), p.radii[0]));
        let Some((least, radius)) = thinnest.min_by(|a, b| a.0.total_cmp(&b.0)) else { return Ok(None) };
        let specific = least / self.lubrication.roughness_um();
        let rating = MicropittingRating {
            bulk_temperature_c: field.film.bulk_temperature_c,
            mean_friction_coefficient: mu,
            film_thickness_um: least,
            specific_film_thickness: specific,
            pinion_diameter_mm: pinion_diameter(input, radius),
            test_specific_film_thickness: test,
            permissible_specific_film_thickness: permissible,
            safety: specific / permissible,
        };
        Ok(Some((rating, field)))
    }
}

/// lambda_GFP, and lambda_GFT where it follows from that.
///
/// # Errors
/// [`RatingError`] where neither the permissible film nor the test of the oil is known.
pub fn permissible_film(
    lubricant: &crate::Lubricant,
    material_factor: f64,
    permissible: Option<f64>,
) -> Result<(f64, Option<f64>), RatingError> {
    if let Some(stated) = permissible {
        return Ok((stated, None));
    }
    let test = test_specific_film(lubricant)?;
    Ok((1.4 * material_factor * test, Some(test)))
}

/// K_A K_V, by which the solved load grows.
fn load_factor(input: &ScuffingInput<'_>) -> f64 {
    input.standard.application_factor * input.standard.dynamic_factor
}

/// Diameter of the pinion where its flank has a transverse radius of curvature, mm.
fn pinion_diameter(input: &ScuffingInput<'_>, radius: f64) -> f64 {
    input.pair.geometry.base_diameter[0].hypot(2.0 * radius)
}

/// Contact temperature at any place of the flanks.
#[derive(Debug, Clone, PartialEq)]
pub struct ContactField {
    lubrication: Lubrication,
    rolling: Rolling,
    contact: [f64; 2],
    reduced_modulus: f64,
    pressure_factor: f64,
    /// cos(alpha_t) over v_t rho_nC.
    friction_load: f64,
    bulk_temperature_c: f64,
}

impl ContactField {
    /// The field without its bulk temperature.
    fn heat(solved: &SolvedContact, input: &ScuffingInput<'_>) -> Result<Self, RatingError> {
        let geometry = &input.pair.geometry;
        let radius = geometry.pitch_relative_radius() / geometry.base_helix_angle.cos();
        let speed = std::f64::consts::PI / 60_000.0 * geometry.working_diameter()[0] * input.pair.pinion_speed_rpm;
        Ok(Self {
            lubrication: solved.lubrication.clone(),
            rolling: solved.rolling,
            contact: input.thermal_contact()?,
            reduced_modulus: input.reduced_modulus(),
            pressure_factor: load_factor(input).sqrt(),
            friction_load: geometry.transverse_pressure_angle.cos() / (speed * radius),
            bulk_temperature_c: solved.lubrication.oil_temperature_c,
        })
    }

    /// Flash temperature of a place under a solved pressure, K.
    fn flash(&self, at: &RollingPlace, pressure: f64) -> f64 {
        let pressure = self.pressure_factor * pressure;
        let line_load = std::f64::consts::TAU * at.relative_radius * pressure * pressure / self.reduced_modulus;
        let rough = self.lubrication.roughness_um().powf(0.25);
        let mu = 0.06 * (line_load * self.friction_load).powf(0.2) * self.lubrication.lubricant_factor() * rough;
        flash_temperature(at, pressure, mu, self.contact, self.reduced_modulus, BLOK)
    }

    /// Contact temperature where a gear's flank has a transverse radius of curvature (mm) under a solved pressure (MPa), C; NaN where nothing presses.
    pub fn temperature_c(&self, gear: usize, radius: f64, pressure: f64) -> f64 {
        place(&self.rolling, gear, radius, pressure)
            .map_or(f64::NAN, |at| self.bulk_temperature_c + self.flash(&at, pressure))
    }
}

/// Film at any place of the flanks.
#[derive(Debug, Clone, PartialEq)]
pub struct FilmField {
    film: Film,
    rolling: Rolling,
    pressure_factor: f64,
}

impl FilmField {
    fn thickness(&self, at: &RollingPlace, pressure: f64) -> f64 {
        self.film.thickness_um(at, self.pressure_factor * pressure)
    }

    /// lambda_GF where a gear's flank has a transverse radius of curvature (mm) under a solved pressure (MPa); NaN where nothing presses.
    pub fn specific(&self, gear: usize, radius: f64, pressure: f64) -> f64 {
        place(&self.rolling, gear, radius, pressure)
            .map_or(f64::NAN, |at| self.film.specific(&at, self.pressure_factor * pressure))
    }
}

/// The place of a loaded point of a gear's flank.
fn place(rolling: &Rolling, gear: usize, radius: f64, pressure: f64) -> Option<RollingPlace> {
    let at = if gear == 0 { rolling.at_pinion(radius) } else { rolling.at_wheel(radius) };
    at.filter(|_| pressure > 0.0)
}
