//! Load ratings of a rolling bearing: C of ISO 281, and the static safety against C_0 of ISO 76. Theory (100b), (100c).

use super::{BallGeometry, RollerGeometry, RollingElements};

/// b_m of today's steel: balls, rollers.
const STEEL: [f64; 2] = [1.3, 1.1];
/// Ball diameter up to which C goes with its power 1.8, mm; above with 1.4.
const LARGE: f64 = 25.4;
const LARGE_FACTOR: f64 = 3.647;
/// Pressure of the static rating, MPa: balls, rollers.
const DENTS: [f64; 2] = [4200.0, 4000.0];

impl BallGeometry {
    /// C, N.
    ///
    /// ```text
    /// C = b_m f_c (i cos(alpha))^0.7 Z^(2/3) D_w^1.8,   3.647 D_w^1.4 above D_w = 25.4 mm
    /// f_c = 39.9 gamma^0.3 (1 - gamma)^1.39/(1 + gamma)^(1/3) (2 f_i/(2 f_i - 1))^0.41 (1 + x^(10/3))^(-3/10)
    /// x = 1.04 ((1 - gamma)/(1 + gamma))^1.72 (f_i (2 f_e - 1)/(f_e (2 f_i - 1)))^0.41
    /// ```
    /// f_i, f_e: groove radii over D_w. Source: ISO 281, whose table of f_c this formula of ISO/TR 1281-1 meets to 4 %.
    fn dynamic_rating(&self, rows: usize) -> f64 {
        let ([inner, outer], gamma) = (self.conformity, self.gamma());
        let narrow = 2.0 * inner / (2.0 * inner - 1.0);
        let grooves = inner * (2.0 * outer - 1.0) / (outer * (2.0 * inner - 1.0));
        let x = 1.04 * ((1.0 - gamma) / (1.0 + gamma)).powf(1.72) * grooves.powf(0.41);
        let shape = gamma.powf(0.3) * (1.0 - gamma).powf(1.39) / (1.0 + gamma).cbrt();
        let f_c = 39.9 * shape * narrow.powf(0.41) * (1.0 + x.powf(10.0 / 3.0)).powf(-0.3);
        let size =
            if self.diameter <= LARGE { self.diameter.powf(1.8) } else { LARGE_FACTOR * self.diameter.powf(1.4) };
        let several = (rows as f64 * self.contact_angle.cos()).powf(0.7) * (self.elements as f64).powf(2.0 / 3.0);
        STEEL[0] * f_c * several * size
    }
}

impl RollerGeometry {
    /// C, N.
    ///
    /// ```text
    /// C = b_m f_c (i L cos(alpha))^(7/9) Z^(3/4) D_w^(29/27)
    /// f_c = 207.9 0.83 gamma^(2/9) (1 - gamma)^(29/27)/(1 + gamma)^(1/4) (1 + x^(9/2))^(-2/9)
    /// x = 1.04 ((1 - gamma)/(1 + gamma))^(143/108)
    /// ```
    /// Source: ISO 281; f_c as in ISO/TR 1281-1.
    fn dynamic_rating(&self, rows: usize) -> f64 {
        let gamma = self.gamma();
        let x = 1.04 * ((1.0 - gamma) / (1.0 + gamma)).powf(143.0 / 108.0);
        let shape = gamma.powf(2.0 / 9.0) * (1.0 - gamma).powf(29.0 / 27.0) / (1.0 + gamma).powf(0.25);
        let f_c = 207.9 * 0.83 * shape * (1.0 + x.powf(4.5)).powf(-2.0 / 9.0);
        let several = (rows as f64 * self.length * self.contact_angle.cos()).powf(7.0 / 9.0);
        STEEL[1] * f_c * several * (self.elements as f64).powf(0.75) * self.diameter.powf(29.0 / 27.0)
    }
}

impl RollingElements {
    /// C of a bearing with a number of rows: its basic dynamic radial load rating after ISO 281, N.
    pub fn dynamic_rating(&self, rows: usize) -> f64 {
        match self {
            Self::Balls(own) => own.dynamic_rating(rows),
            Self::Rollers(own) => own.dynamic_rating(rows),
        }
    }

    /// Pressure of the static rating, MPa: it leaves a permanent indentation of a ten-thousandth of the element's
    /// diameter (ISO 76).
    pub fn dent_pressure(&self) -> f64 {
        DENTS[usize::from(matches!(self, Self::Rollers(_)))]
    }

    /// S_0 = C_0/P_0 at the largest pressure of a rolling element (MPa); `None` without load.
    ///
    /// ```text
    /// S_0 = (4200 MPa/p)^3 balls,   (4000 MPa/p)^2 rollers
    /// ```
    /// P_0 is the load with that pressure, as ISO 76 defines it. The force of an element grows with p^3 for point
    /// contact and with p^2 for line contact. So tilts, thrust, clearance and preload are included.
    pub fn static_safety(&self, pressure: f64) -> Option<f64> {
        let power = if matches!(self, Self::Balls(_)) { 3 } else { 2 };
        (pressure > 0.0).then(|| (self.dent_pressure() / pressure).powi(power))
    }
}
