//! The shaper cutter of an internal gear and the fillet cut by its tip.

use std::f64::consts::{FRAC_PI_2, PI};

use serde::Serialize;

use crate::internal_mesh::InternalMesh;
use crate::roots::{bisect, inverse_involute};
use crate::{GearData, GeometryError, Shaper, involute};

/// A cutter at the depth at which it finishes its ring; magnitudes, mm and rad.
///
/// ```text
/// inv a_w0 = inv a_t + 2 tan a_n (x_2 + x_0)/(z_2 + z_0),   |a_0| = m_t |z_2 + z_0| cos a_t / (2 cos a_w0)
/// r_a0 = |d_f2|/2 - |a_0|,   r_M = r_a0 - rho,   l_F0 = sqrt(r_M^2 - r_b0^2) + rho
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub(crate) struct Cutter {
    /// z_0 and |z_2|.
    teeth: [f64; 2],
    /// r_b0 and |r_b2|.
    base: [f64; 2],
    /// |a_0|.
    distance: f64,
    /// a_w0.
    pressure_angle: f64,
    /// r_a0.
    tip_radius: f64,
    /// Half tooth angle of the cutter at its base circle.
    base_half_angle: f64,
    /// rho, radius of the rounding.
    rounding: f64,
    normal_module: f64,
}

impl Cutter {
    /// The cutter of a ring.
    ///
    /// # Errors
    /// [`GeometryError::OutOfRange`] if it has too many or too few teeth, or too large a profile shift.
    pub fn new(data: &GearData, shaper: Shaper) -> Result<Self, GeometryError> {
        let (m, alpha, beta) = (data.normal_module, data.normal_pressure_angle, data.helix_angle);
        let [own, ring] = [shaper.teeth, data.teeth].map(f64::from);
        let refused = |name, value, expected| Err(GeometryError::OutOfRange { name, value, expected });
        if shaper.teeth < 5 || shaper.teeth >= data.teeth {
            return refused("teeth of the shaper", own, "5 or more, fewer than the ring has");
        }
        if !shaper.profile_shift.is_finite() || shaper.profile_shift.abs() > 3.0 {
            return refused("profile shift of the shaper", shaper.profile_shift, "-3 to 3");
        }
        let alpha_t = (alpha.tan() / beta.cos()).atan();
        let sum = data.profile_shift + shaper.profile_shift;
        let working = involute(alpha_t) + 2.0 * alpha.tan() * sum / (own - ring);
        let Some(pressure_angle) = inverse_involute(working) else {
            return refused("profile shifts of ring and shaper together", sum, "small enough that they mesh");
        };
        let module = m / beta.cos();
        let base = [own, ring].map(|z| 0.5 * module * z * alpha_t.cos());
        let distance = (base[1] - base[0]) / pressure_angle.cos();
        let root_radius = 0.5 * module * ring + m * (data.dedendum_coefficient - data.profile_shift);
        let thickness = 0.5 * PI * m + 2.0 * shaper.profile_shift * m * alpha.tan() + data.thickness_allowance;
        let cutter = Self {
            teeth: [own, ring],
            base,
            distance,
            pressure_angle,
            tip_radius: root_radius - distance,
            base_half_angle: thickness / (m * own) + involute(alpha_t),
            rounding: data.root_radius_coefficient * m,
            normal_module: m,
        };
        if cutter.tip_radius <= base[0] {
            let expected = "large enough that the shaper's tip is outside its base circle";
            return refused("dedendum with this shaper", data.dedendum_coefficient, expected);
        }
        Ok(cutter)
    }

    /// Number of teeth.
    pub fn teeth(&self) -> u32 {
        self.teeth[0] as u32
    }

    /// Tip diameter, mm.
    pub fn tip_diameter(&self) -> f64 {
        2.0 * self.tip_radius
    }

    /// Centre distance at full depth, mm.
    pub fn distance(&self) -> f64 {
        self.distance
    }

    /// Working transverse pressure angle at full depth, rad.
    pub fn pressure_angle(&self) -> f64 {
        self.pressure_angle
    }

    /// Mesh of the cutter with a ring of tip radius `ring_tip` (mm).
    pub fn mesh(&self, ring_tip: f64) -> InternalMesh {
        InternalMesh {
            teeth: self.teeth,
            base: self.base,
            tip: [self.tip_radius, ring_tip],
            distance: self.distance,
            pressure_angle: self.pressure_angle,
        }
    }

    /// Radius and angle from the tooth's centre line of the centre of a rounding, and its distance from where the common normal touches the base circle; NaN where it lies within the base circle.
    fn centre(&self, rounding: f64) -> (f64, f64, f64) {
        let (radius, base) = (self.tip_radius - rounding, self.base[0]);
        let along = (radius * radius - base * base).sqrt();
        (radius, self.base_half_angle - (along + rounding) / base + (along / base).atan(), along)
    }

    /// Largest rounding over the normal module; 0 for a pointed tooth.
    pub fn largest_rounding(&self) -> f64 {
        let room = |rounding: f64| self.centre(rounding).1;
        if room(0.0).is_nan() || room(0.0) <= 0.0 {
            return 0.0;
        }
        bisect(0.0, self.tip_radius - self.base[0], room) / self.normal_module
    }

    /// Roll angle of the ring at which its involute ends, and the angle on the rounding that generates this end, rad.
    ///
    /// ```text
    /// u_F2 = (|a_0| sin a_w0 + l_F0) / |r_b2|
    /// ```
    ///
    /// # Errors
    /// [`GeometryError::RootRadius`] if the rounding does not fit.
    pub fn end_of_fillet(&self) -> Result<(f64, f64), GeometryError> {
        let (_, angle, along) = self.centre(self.rounding);
        if angle.is_nan() || angle < 0.0 {
            let coefficient = self.rounding / self.normal_module;
            return Err(GeometryError::RootRadius { coefficient, largest: self.largest_rounding() });
        }
        let roll = (self.distance * self.pressure_angle.sin() + along + self.rounding) / self.base[1];
        Ok((roll, FRAC_PI_2 - (along / self.base[0]).atan()))
    }

    /// Direction of the rounding's normal at `theta`, and direction of the point of the cutter's pitch circle that it passes through, rad from the tooth's centre line, with the point of the rounding, mm.
    fn rolling(&self, theta: f64) -> (f64, f64, [f64; 2]) {
        let (radius, angle, _) = self.centre(self.rounding);
        let ([sin, cos], normal) = ([angle.sin(), angle.cos()], angle + theta);
        let (across, up) = normal.sin_cos();
        let pitch_radius = self.base[0] / self.pressure_angle.cos();
        // The line from the centre of the rounding along its normal meets the pitch circle: the point that is further on.
        let along = radius * theta.cos();
        let reach = (along * along - radius * radius + pitch_radius * pitch_radius).max(0.0).sqrt() - along;
        let at = |t: f64| [radius * cos + t * up, radius * sin + t * across];
        let [x, y] = at(reach);
        (normal, y.atan2(x), at(self.rounding))
    }

    /// Radius (mm) and angle from the middle of the tooth space (rad), both negative, of the fillet point generated by
    /// the point of the rounding at `theta` from its tip. Cutter and ring roll on each other until the normal at this
    /// point passes through the pitch point.
    pub fn generated(&self, theta: f64) -> (f64, f64) {
        let (_, turned, [x, y]) = self.rolling(theta);
        let (sin, cos) = turned.sin_cos();
        let [x, y] = [self.distance + x * cos + y * sin, y * cos - x * sin];
        (-x.hypot(y), -(y.atan2(x) + turned * self.teeth[0] / self.teeth[1]))
    }

    /// Angle (rad) between the fillet's tangent at `theta` and the middle of the tooth space.
    pub fn tangent(&self, theta: f64) -> f64 {
        let (normal, turned, _) = self.rolling(theta);
        FRAC_PI_2 - (normal - turned + turned * self.teeth[0] / self.teeth[1])
    }
}
