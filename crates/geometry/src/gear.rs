//! One gear: derived quantities, flanks and section.

use std::f64::consts::PI;

use serde::Serialize;

use crate::{Flank, GearData, GeometryError, Side, TransverseProfile};

/// One external gear with everything ISO 21771 derives from its data.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Gear {
    data: GearData,
    profile: TransverseProfile,
}

impl Gear {
    /// A gear from its data.
    ///
    /// # Errors
    /// [`GeometryError`] when a value has no meaning, the teeth are pointed, the fillet or the bore does not fit.
    pub fn new(data: GearData) -> Result<Self, GeometryError> {
        let positive = [
            ("normal module [mm]", data.normal_module),
            ("face width [mm]", data.face_width),
            ("bore diameter [mm]", data.bore_diameter),
            ("addendum coefficient", data.addendum_coefficient),
            ("dedendum coefficient", data.dedendum_coefficient),
        ];
        for (name, value) in positive {
            check(name, value, value > 0.0, "above 0")?;
        }
        check("teeth", f64::from(data.teeth), (5..=10_000).contains(&data.teeth), "5 to 10000")?;
        let (alpha, beta) = (data.normal_pressure_angle, data.helix_angle);
        check("normal pressure angle [rad]", alpha, alpha > 0.05 && alpha < 0.8, "0.05 to 0.8 (3 to 45 deg)")?;
        check("helix angle [rad]", beta, beta.abs() < 1.05, "between -1.05 and 1.05 (60 deg)")?;
        check("profile shift", data.profile_shift, data.profile_shift.abs() <= 3.0, "-3 to 3")?;
        let thin = data.thickness_allowance;
        check("thickness allowance [mm]", thin, thin.abs() < data.normal_module, "smaller than the module")?;
        let rho = data.root_radius_coefficient;
        check(
            "root radius coefficient",
            rho,
            rho > 0.0 && rho < data.dedendum_coefficient,
            "above 0, below the dedendum coefficient",
        )?;
        let profile = TransverseProfile::new(&data)?;
        let gear = Self { data, profile };
        if 0.5 * gear.data.bore_diameter >= gear.root_radius() {
            return Err(GeometryError::Bore {
                bore_diameter_mm: gear.data.bore_diameter,
                root_diameter_mm: 2.0 * gear.root_radius(),
            });
        }
        Ok(gear)
    }

    /// What the gear was made from.
    pub fn data(&self) -> &GearData {
        &self.data
    }

    /// Number of teeth z.
    pub fn teeth(&self) -> u32 {
        self.data.teeth
    }

    /// Face width b, mm.
    pub fn face_width(&self) -> f64 {
        self.data.face_width
    }

    /// Transverse module m_n / cos beta, mm.
    pub fn transverse_module(&self) -> f64 {
        self.data.normal_module / self.data.helix_angle.cos()
    }

    /// Transverse pressure angle: tan a_t = tan a_n / cos b.
    pub fn transverse_pressure_angle(&self) -> f64 {
        (self.data.normal_pressure_angle.tan() / self.data.helix_angle.cos()).atan()
    }

    /// Base helix angle, signed as beta: sin b_b = sin b cos a_n.
    pub fn base_helix_angle(&self) -> f64 {
        (self.data.helix_angle.sin() * self.data.normal_pressure_angle.cos()).asin()
    }

    /// Reference radius, mm.
    pub fn reference_radius(&self) -> f64 {
        0.5 * self.transverse_module() * f64::from(self.data.teeth)
    }

    /// Base radius r_b, mm.
    pub fn base_radius(&self) -> f64 {
        self.reference_radius() * self.transverse_pressure_angle().cos()
    }

    /// Tip radius, mm.
    pub fn tip_radius(&self) -> f64 {
        self.profile.radius(self.profile.roll_tip())
    }

    /// Root form radius, where the involute starts, mm.
    pub fn form_radius(&self) -> f64 {
        self.profile.radius(self.profile.roll_form())
    }

    /// Root radius, mm.
    pub fn root_radius(&self) -> f64 {
        self.reference_radius() + self.data.normal_module * (self.data.profile_shift - self.data.dedendum_coefficient)
    }

    /// Transverse base pitch p_bt, mm.
    pub fn transverse_base_pitch(&self) -> f64 {
        2.0 * PI * self.base_radius() / f64::from(self.data.teeth)
    }

    /// Angular pitch 2 pi / z, rad.
    pub fn pitch_angle(&self) -> f64 {
        2.0 * PI / f64::from(self.data.teeth)
    }

    /// Twist of the teeth along the axis, tan(beta)/r, rad/mm; positive for a right hand.
    pub fn twist(&self) -> f64 {
        self.data.helix_angle.tan() / self.reference_radius()
    }

    /// The transverse section of a tooth.
    pub fn profile(&self) -> &TransverseProfile {
        &self.profile
    }

    /// Flank of tooth 0 on the given side, from the root form circle to the tip circle.
    pub fn flank(&self, side: Side) -> Flank {
        self.flank_of(side, 0)
    }

    /// Flank of tooth `tooth` (any integer; tooth z is tooth 0 again).
    pub fn flank_of(&self, side: Side, tooth: i64) -> Flank {
        let tooth = tooth.rem_euclid(i64::from(self.data.teeth));
        Flank {
            side,
            base_radius: self.base_radius(),
            base_half_angle: self.profile.base_half_angle(),
            twist: self.twist(),
            base_helix_angle: self.base_helix_angle(),
            centre_angle: tooth as f64 * self.pitch_angle(),
            roll_form: self.profile.roll_form(),
            roll_tip: self.profile.roll_tip(),
            half_width: 0.5 * self.data.face_width,
        }
    }
}

fn check(name: &'static str, value: f64, fine: bool, expected: &'static str) -> Result<(), GeometryError> {
    if fine && value.is_finite() { Ok(()) } else { Err(GeometryError::OutOfRange { name, value, expected }) }
}
