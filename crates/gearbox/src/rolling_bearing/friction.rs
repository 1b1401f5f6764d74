//! Power loss of a rolling bearing. Theory (101d).

use super::RollingElements;

/// Viscosity times speed (mm^2/s 1/min) below which the oil's part is constant.
const SLOW: f64 = 2000.0;

/// Y_0 of ISO 76 at contact angles of 15, 20, ... 45 degrees.
const AXIAL: [f64; 7] = [0.46, 0.42, 0.38, 0.33, 0.29, 0.26, 0.22];

/// Y_0 of one row of angular contact balls at a contact angle (rad), straight lines between the values of ISO 76.
fn axial_factor(angle: f64) -> f64 {
    let place = ((angle.to_degrees() - 15.0) / 5.0).clamp(0.0, 6.0);
    let below = (place as usize).min(5);
    AXIAL[below] + (place - below as f64) * (AXIAL[below + 1] - AXIAL[below])
}

/// Friction moment of a rolling bearing in an oil bath, N mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RollingFriction {
    /// Load-dependent friction moment.
    pub by_load: f64,
    /// Oil-dependent friction moment.
    pub by_oil: f64,
}

impl RollingFriction {
    /// Friction of a bearing with a number of rows under a radial and an axial force (N), at a speed (1/min) with oil
    /// of a kinematic viscosity (mm^2/s).
    ///
    /// ```text
    /// M_0 = 1e-7 f_0 (nu n)^(2/3) d_pw^3,   160e-7 f_0 d_pw^3 below nu n = 2000;   M_1 = f_1 F_b d_pw
    /// deep groove:      f_0 = 2,    f_1 = 0.0006 (F_s/C_0)^0.55,   F_b = max(3 F_a - 0.1 F_r, F_r),   F_s = max(0.6 F_r + 0.5 F_a, F_r)
    /// angular contact:  f_0 = 3.3 i,   f_1 = 0.001 (F_s/C_0)^0.33,   F_b = max(0.9 F_a cot a - 0.1 F_r, F_r),   F_s = max(0.5 F_r + Y_0 F_a, F_r), both factors twice with two rows
    /// cylindrical:      f_0 = 3,    f_1 = 0.0003,   F_b = F_r
    /// tapered:          f_0 = 6,    f_1 = 0.0004,   F_b = max(0.8 F_a cot a, F_r)
    /// ```
    /// Source: A. Palmgren; T. A. Harris, M. N. Kotzalas, Rolling Bearing Analysis, friction of bearings, oil bath.
    /// Seals, and further losses of churning and cages, are not included.
    pub fn new(
        elements: &RollingElements,
        rows: usize,
        [radial, axial]: [f64; 2],
        (speed_rpm, viscosity): (f64, f64),
    ) -> Self {
        let pitch = elements.pitch_diameter();
        let angle = elements.contact_angle();
        let static_share = |x: f64, y: f64| radial.max(x * radial + y * axial) / elements.static_rating(rows);
        // Two rows take thrust either way.
        let both = if rows > 1 { 2.0 } else { 1.0 };
        let rows = rows as f64;
        let (oil, load, force) = match elements {
            RollingElements::Balls(_) if angle == 0.0 => {
                (2.0 * rows, 6e-4 * static_share(0.6, 0.5).powf(0.55), radial.max(3.0 * axial - 0.1 * radial))
            }
            RollingElements::Balls(_) => {
                let force = radial.max(0.9 * axial / angle.tan() - 0.1 * radial);
                (3.3 * rows, 1e-3 * static_share(0.5 * both, both * axial_factor(angle)).powf(0.33), force)
            }
            RollingElements::Rollers(_) if angle == 0.0 => (3.0 * rows, 3e-4, radial),
            RollingElements::Rollers(_) => (6.0 * rows, 4e-4, radial.max(0.8 * axial / angle.tan())),
        };
        let film = viscosity * speed_rpm;
        let by_speed = if film < SLOW { 160e-7 } else { 1e-7 * film.powf(2.0 / 3.0) };
        Self { by_load: load * force * pitch, by_oil: by_speed * oil * pitch.powi(3) }
    }

    /// Power loss at a speed (1/min), W.
    pub fn power_w(&self, speed_rpm: f64) -> f64 {
        1e-3 * (self.by_load + self.by_oil) * speed_rpm * std::f64::consts::TAU / 60.0
    }
}
