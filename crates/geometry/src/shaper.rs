//! The shaper cutter of an internal gear and the fillet cut by its tip.

use std::f64::consts::{FRAC_PI_2, PI};

use serde::Serialize;

use crate::internal_mesh::InternalMesh;
use crate::roots::{bisect, inverse_involute};
use crate::{GearData, GeometryError, Shaper, involute};

/// Root of a ring's tooth in its normal section, on the virtual spur gear, where its fillet has a certain tangent.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ShapedRoot {
    /// Chord between the points of both fillets, mm.
    pub chord: f64,
    /// Distance of the chord from the axis of the virtual gear, mm; negative, as radii of rings.
    pub height: f64,
    /// Radius of curvature of the fillet there, mm.
    pub fillet_radius: f64,
}

impl ShapedRoot {
    /// The root of a ring where the tangent makes `angle` (rad) with the tooth's centre line, or at the end of the fillet if it is steeper
    /// there. `None` of a gear that no shaper cuts, and where the virtual cutter does not mesh.
    ///
    /// The virtual gears of ring and cutter roll on each other as the real ones do; both have z/(cos^2 beta_b cos beta) teeth. Source: ISO
    /// 6336-3, clause on the tooth form factor of gears made by shapers (virtual gears), evaluated on the exact envelope.
    pub fn at_tangent(data: &GearData, angle: f64) -> Option<Self> {
        let cutter = Cutter::in_normal_section(data, data.shaper?).ok()?;
        let (_, end) = cutter.end_of_fillet().ok()?;
        let half_pitch = -PI / cutter.teeth[1];
        let slope = |theta: f64| cutter.tangent(theta) - half_pitch - angle;
        let theta = if slope(end) >= 0.0 { end } else { bisect(0.0, end, slope) };
        let (radius, space) = cutter.generated(theta);
        let (sin, cos) = (half_pitch - space).sin_cos();
        Some(Self { chord: 2.0 * radius * sin, height: radius * cos, fillet_radius: cutter.fillet_radius(theta) })
    }
}

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
        Self::rolling_on([own, ring], m / beta.cos(), alpha_t, (data, shaper))
    }

    /// The cutter and the ring in the normal section: their virtual spur gears have z / (cos^2 beta_b cos beta) teeth. The rounding keeps its
    /// radius, but is no larger than the tip, which is narrower there.
    ///
    /// # Errors
    /// [`GeometryError::OutOfRange`] if they do not mesh.
    pub fn in_normal_section(data: &GearData, shaper: Shaper) -> Result<Self, GeometryError> {
        let sin_base = data.helix_angle.sin() * data.normal_pressure_angle.cos();
        let shrunk = (1.0 - sin_base * sin_base) * data.helix_angle.cos();
        let teeth = [shaper.teeth, data.teeth].map(|z| f64::from(z) / shrunk);
        let cutter = Self::rolling_on(teeth, data.normal_module, data.normal_pressure_angle, (data, shaper))?;
        let rounding = cutter.rounding.min(cutter.largest_rounding() * cutter.normal_module);
        Ok(Self { rounding, ..cutter })
    }

    /// A cutter and a ring of so many teeth; `module` (mm) and pressure angle `alpha_t` (rad) are those of the section in which they roll on each
    /// other.
    fn rolling_on(
        [own, ring]: [f64; 2],
        module: f64,
        alpha_t: f64,
        (data, shaper): (&GearData, Shaper),
    ) -> Result<Self, GeometryError> {
        let (m, alpha) = (data.normal_module, data.normal_pressure_angle);
        let refused = |name, value, expected| Err(GeometryError::OutOfRange { name, value, expected });
        let sum = data.profile_shift + shaper.profile_shift;
        let working = involute(alpha_t) + 2.0 * alpha.tan() * sum / (own - ring);
        let Some(pressure_angle) = inverse_involute(working) else {
            return refused("profile shifts of ring and shaper together", sum, "small enough that they mesh");
        };
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

    /// Radius of curvature (mm) of the fillet at `theta`: of the path of the rounding's centre by the equation of Euler and Savary, and the rounding.
    ///
    /// ```text
    /// rho_F = rho + q^2/(j - q),   j = D cos(normal - pitch point),   1/D = 1/r_w0 - 1/r_w2
    /// ```
    /// q is the distance from the centre of the rounding to the pitch point along the normal, below zero where the centre is outside of the
    /// cutter's pitch circle.
    pub fn fillet_radius(&self, theta: f64) -> f64 {
        let (normal, turned, _) = self.rolling(theta);
        let [own, ring] = self.base.map(|r| r / self.pressure_angle.cos());
        let inflection = own * ring / (ring - own) * (normal - turned).cos();
        let reach = self.reach(theta);
        self.rounding + reach * reach / (inflection - reach)
    }

    /// Distance (mm) from the centre of the rounding to the cutter's pitch circle along the rounding's normal at `theta`.
    fn reach(&self, theta: f64) -> f64 {
        let (radius, ..) = self.centre(self.rounding);
        let pitch_radius = self.base[0] / self.pressure_angle.cos();
        // Of the two points of the circle on this line the one that is further on.
        let along = radius * theta.cos();
        (along * along - radius * radius + pitch_radius * pitch_radius).max(0.0).sqrt() - along
    }

    /// Direction of the rounding's normal at `theta`, and direction of the point of the cutter's pitch circle that it passes through, rad from the tooth's centre line, with the point of the rounding, mm.
    fn rolling(&self, theta: f64) -> (f64, f64, [f64; 2]) {
        let (radius, angle, _) = self.centre(self.rounding);
        let ([sin, cos], normal) = ([angle.sin(), angle.cos()], angle + theta);
        let (across, up) = normal.sin_cos();
        let at = |t: f64| [radius * cos + t * up, radius * sin + t * across];
        let [x, y] = at(self.reach(theta));
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
