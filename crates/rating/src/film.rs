//! Micropitting: is the oil film thick enough? Film thickness of a place and what a test says that is enough. ISO/TS 6336-22.

use crate::{
    Lubricant, LubricantBase, Lubrication, LubricationMethod, RatingError, RollingPlace, flash::flash_temperature,
    scuffing,
};

const CLAUSE: &str = "ISO/TS 6336-22";
/// Constant of the flash temperature in ISO/TS 6336-22: 2/sqrt(pi).
const BLOK: f64 = std::f64::consts::FRAC_2_SQRT_PI;

/// What the film of every place of a pair depends on.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Film {
    /// Oil and roughness.
    pub lubrication: Lubrication,
    /// E_r, MPa.
    pub reduced_modulus: f64,
    /// B_M of both gears, N/(mm s^0.5 K).
    pub contact: [f64; 2],
    /// mu_m.
    pub friction: f64,
    /// theta_M, C.
    pub bulk_temperature_c: f64,
}

impl Film {
    /// h, film thickness of a place under a pressure of Hertz, um.
    ///
    /// ```text
    /// h = 1600 rho_n G_M^0.6 U^0.7 W^-0.13 S_GF^0.22
    /// G_M = 1e6 alpha_M E_r,   U = eta_M v_Sigma/(2000 E_r rho_n),   W = 2 pi p^2/E_r^2,   S_GF = alpha_B eta_B/(alpha_M eta_M)
    /// ```
    /// M: at the bulk temperature, B: at the contact temperature theta_M + theta_fl. `pressure` p, MPa. 0 where one of both is so
    /// high (above some 510 C) that the formula leaves no pressure-viscosity coefficient: such an oil makes no film. Source: ISO/TS 6336-22, film thickness (Dowson and Higginson, with the correction for heat).
    pub fn thickness_um(&self, place: &RollingPlace, pressure: f64) -> f64 {
        let oil = &self.lubrication.lubricant;
        let flash = flash_temperature(place, pressure, self.friction, self.contact, self.reduced_modulus, BLOK);
        let viscosity = |c: f64| 1e-3 * oil.dynamic_viscosity(c);
        let (bulk, hot) = (self.bulk_temperature_c, self.bulk_temperature_c + flash);
        let [alpha_bulk, alpha_hot] = [bulk, hot].map(|c| pressure_viscosity(oil, c));
        if !(alpha_bulk > 0.0 && alpha_hot > 0.0) {
            return 0.0;
        }
        let material = 1e6 * alpha_bulk * self.reduced_modulus;
        let speed = viscosity(bulk) * place.rolling_speed() / (2000.0 * self.reduced_modulus * place.relative_radius);
        let load = std::f64::consts::TAU * (pressure / self.reduced_modulus).powi(2);
        let heat = alpha_hot * viscosity(hot) / (alpha_bulk * viscosity(bulk));
        1600.0 * place.relative_radius * material.powf(0.6) * speed.powf(0.7) * load.powf(-0.13) * heat.powf(0.22)
    }

    /// lambda, film thickness over roughness R_a.
    pub fn specific(&self, place: &RollingPlace, pressure: f64) -> f64 {
        self.thickness_um(place, pressure) / self.lubrication.roughness_um()
    }
}

/// alpha, pressure-viscosity coefficient at a temperature in C, m^2/N.
///
/// ```text
/// alpha = alpha_38 [1 + 516 (1/(theta + 273) - 1/311)]
/// alpha_38 = 2.657e-8 eta_38^0.1348 (mineral), 1.466e-8 eta_38^0.0507 (polyalphaolefin), 1.392e-8 eta_38^0.1572 (polyglycol)
/// ```
/// eta_38 dynamic viscosity at 38 C, N s/m^2. Source: ISO/TS 6336-22, pressure-viscosity coefficient.
fn pressure_viscosity(oil: &Lubricant, temperature_c: f64) -> f64 {
    let eta = 1e-3 * oil.dynamic_viscosity(38.0);
    let at_38 = match oil.base {
        LubricantBase::Mineral => 2.657e-8 * eta.powf(0.1348),
        LubricantBase::Polyalphaolefin => 1.466e-8 * eta.powf(0.0507),
        LubricantBase::Polyglycol => 1.392e-8 * eta.powf(0.1572),
    };
    at_38 * (1.0 + 516.0 * (1.0 / (temperature_c + 273.0) - 1.0 / 311.0))
}

/// theta_M, bulk temperature of ISO/TS 6336-22, C.
///
/// ```text
/// theta_M = theta_oil + 7400 (P_VZ/(a b))^0.72 X_S/(1.2 X_Ca)
/// ```
/// `loss_kw` P_VZ = P mu_m H_v, what the mesh loses, kW; `area` a b, mm^2. Source: ISO/TS 6336-22, bulk temperature.
pub(crate) fn bulk_temperature(lubrication: &Lubrication, loss_kw: f64, area: f64, tip_relief_factor: f64) -> f64 {
    let warms = 7400.0 * (loss_kw / area).powf(0.72);
    lubrication.oil_temperature_c + warms * lubrication.method.factor() / (1.2 * tip_relief_factor)
}

/// The gears of the micropitting test FZG C-GF/8.3/90: steel, spur, without profile modification.
mod test_gears {
    /// Centre distance, mm.
    pub const CENTRE_DISTANCE: f64 = 91.5;
    /// Face width, mm.
    pub const FACE_WIDTH: f64 = 14.0;
    /// Numbers of teeth.
    pub const TEETH: [f64; 2] = [16.0, 24.0];
    /// Normal module, mm.
    pub const MODULE: f64 = 4.5;
    /// Tip diameters, mm.
    pub const TIP_DIAMETER: [f64; 2] = [82.46, 118.36];
    /// Speed of the pinion, 1/min.
    pub const SPEED_RPM: f64 = 2250.0;
    /// R_a of both flanks, um.
    pub const ROUGHNESS_RA_UM: f64 = 0.5;
    /// Temperature of the oil that is sprayed, C.
    pub const OIL_TEMPERATURE_C: f64 = 90.0;
    /// E_r, MPa, of steels of 206 GPa.
    pub const REDUCED_MODULUS: f64 = 206_000.0 / 0.91;
    /// B_M of case-hardened steel, N/(mm s^0.5 K).
    pub const CONTACT: f64 = 13.78;
    /// Share of the load on a pair at A.
    pub const SHARE: f64 = 1.0 / 3.0;
    /// Load stages with the torque on the pinion, N m.
    pub const STAGES: [[f64; 2]; 6] =
        [[5.0, 70.0], [6.0, 98.9], [7.0, 132.5], [8.0, 171.6], [9.0, 215.6], [10.0, 265.1]];
}

/// lambda_GFT, specific film thickness at A of the test gears at the load stage at which the oil failed.
///
/// Load factors of the test gears are taken as 1. Source: ISO/TS 6336-22, method B; FVA information sheet 54/7.
///
/// # Errors
/// [`RatingError::LubricantLacks`] without a load stage, [`RatingError::OutOfRange`] for one that the test does not have.
pub fn test_specific_film(oil: &Lubricant) -> Result<f64, RatingError> {
    use test_gears as test;
    let stage = oil.micropitting_load_stage.ok_or_else(|| RatingError::LubricantLacks {
        lubricant: oil.name.clone(),
        key: "micropitting_load_stage",
        clause: "the permissible film thickness of ISO/TS 6336-22, method B,",
    })?;
    let torque = test::STAGES.iter().find(|[own, _]| *own == stage).map(|[_, torque]| *torque);
    let torque = torque.ok_or(RatingError::OutOfRange {
        quantity: "the load stage of the micropitting test",
        value: stage,
        clause: CLAUSE,
        allowed: "5, 6, .. 10",
    })?;
    let alpha = 20f64.to_radians();
    let base = test::TEETH.map(|z| 0.5 * test::MODULE * z * alpha.cos());
    let working = ((base[0] + base[1]) / test::CENTRE_DISTANCE).acos();
    let turning = std::f64::consts::PI / 30.0 * test::SPEED_RPM;
    let turning = [turning, turning * test::TEETH[0] / test::TEETH[1]];
    let line = test::CENTRE_DISTANCE * working.sin();
    let tips = [0, 1].map(|i| ((0.5 * test::TIP_DIAMETER[i]).powi(2) - base[i] * base[i]).sqrt());
    let place = |radius_one: f64| {
        let radii = [radius_one, line - radius_one];
        RollingPlace {
            relative_radius: radii[0] * radii[1] / line,
            speeds: [0, 1].map(|i| 1e-3 * turning[i] * radii[i]),
        }
    };
    let (start, pitch) = (place(line - tips[1]), place(base[0] * working.tan()));
    let lubrication = Lubrication {
        lubricant: oil.clone(),
        oil_temperature_c: test::OIL_TEMPERATURE_C,
        method: LubricationMethod::Spray,
        roughness_ra_um: [test::ROUGHNESS_RA_UM; 2],
    };
    let line_load = 1e3 * torque / base[0] / test::FACE_WIDTH;
    let friction = scuffing::friction(&lubrication, line_load, pitch.rolling_speed(), pitch.relative_radius);
    let pitches =
        [0, 1].map(|i| (tips[i] - base[i] * working.tan()) / (std::f64::consts::PI * test::MODULE * alpha.cos()));
    // H_v after Ohlendorf: ISO/TR 14179-2.
    let loss = std::f64::consts::PI
        * (1.0 / test::TEETH[0] + 1.0 / test::TEETH[1])
        * (1.0 - pitches[0] - pitches[1] + pitches[0].powi(2) + pitches[1].powi(2));
    let power_kw = 1e-3 * torque * turning[0];
    let area = test::CENTRE_DISTANCE * test::FACE_WIDTH;
    let relief = scuffing::tip_relief_factor(0.0, pitches);
    let film = Film {
        bulk_temperature_c: bulk_temperature(&lubrication, power_kw * friction * loss, area, relief),
        lubrication,
        reduced_modulus: test::REDUCED_MODULUS,
        contact: [test::CONTACT; 2],
        friction,
    };
    let load = test::SHARE * line_load;
    let pressure = (load * test::REDUCED_MODULUS / (std::f64::consts::TAU * start.relative_radius)).sqrt();
    Ok(film.specific(&start, pressure))
}
