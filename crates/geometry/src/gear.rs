//! One gear: derived quantities, flanks and transverse section. Theory (1), (2), (3), (27).

use std::{f64::consts::PI, sync::Arc};

use serde::Serialize;

use crate::error::InternalInterference;
use crate::modification::{Depth, DepthField, FlankSize, GearModifications, ModifiedFlank};
use crate::{Flank, GearData, GeometryError, Shaper, Side, TransverseProfile};

/// One gear with all quantities that ISO 21771 derives from its data. Number of teeth, diameters and pitch angle of an
/// internal gear are negative, so the formulas of the standard hold for both kinds.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Gear {
    data: GearData,
    profile: TransverseProfile,
    modifications: GearModifications,
    /// Depths of left and right flanks.
    #[serde(skip)]
    fields: [FlankFields; 2],
}

/// Depths of the flanks on one side of all teeth.
#[derive(Debug, Clone, Default, PartialEq)]
struct FlankFields {
    /// Different ones; none where flanks are nominal.
    fields: Vec<Arc<DepthField>>,
    /// Which of them each tooth has; empty where all have the first.
    of_tooth: Vec<usize>,
}

impl FlankFields {
    /// Depth field of a tooth, counted from 0 to z - 1.
    fn of(&self, tooth: usize) -> Option<&Arc<DepthField>> {
        self.fields.get(self.of_tooth.get(tooth).copied().unwrap_or(0))
    }
}

impl Gear {
    /// Makes a gear without modifications from its data.
    ///
    /// # Errors
    /// [`GeometryError`] when a value is out of range, the teeth are pointed, or the fillet or the bore does not fit.
    pub fn new(data: GearData) -> Result<Self, GeometryError> {
        let positive = [
            ("normal module [mm]", data.normal_module),
            ("face width [mm]", data.face_width),
            ("bore diameter [mm]", data.sign() * data.bore_diameter),
            ("addendum coefficient", data.addendum_coefficient),
            ("dedendum coefficient", data.dedendum_coefficient),
        ];
        for (name, value) in positive {
            check(name, value, value > 0.0, "above 0")?;
        }
        check("teeth", f64::from(data.teeth), (5..=100_000).contains(&data.teeth), "5 to 100000")?;
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
        let gear = Self { data, profile, modifications: GearModifications::default(), fields: Default::default() };
        gear.check_cutting()?;
        if 0.5 * gear.data.bore_diameter >= gear.root_radius() {
            return Err(GeometryError::Bore {
                bore_diameter_mm: gear.data.bore_diameter,
                root_diameter_mm: 2.0 * gear.root_radius(),
            });
        }
        Ok(gear)
    }

    /// This gear with other micro-geometry. All quantities derived from the data (diameters, contact ratios, thickness)
    /// stay nominal.
    ///
    /// # Errors
    /// [`GeometryError`] when an amount is not usable as micro-geometry, a relief starts off the flank, a grid does not
    /// cover it, or there is not one pitch error per tooth.
    pub fn with_modifications(self, modifications: GearModifications) -> Result<Self, GeometryError> {
        let given = modifications.pitch_errors.len();
        if given != 0 && given != self.data.teeth as usize {
            return Err(GeometryError::PitchErrors { given, teeth: self.data.teeth });
        }
        for &value in &modifications.pitch_errors {
            check("pitch error [mm]", value, value.abs() <= 1.0, "-1 mm to 1 mm")?;
        }
        let size = |side: Side| FlankSize {
            roll: [self.profile.roll_form(), self.profile.roll_tip()],
            half_width: 0.5 * self.data.face_width,
            base_radius: self.base_radius(),
            normal_module: self.data.normal_module,
            roll_by_height: side.sign() * self.twist(),
        };
        let mut fields = [FlankFields::default(), FlankFields::default()];
        for (fields, side) in fields.iter_mut().zip([Side::Left, Side::Right]) {
            let on_side = modifications.on(side);
            if on_side.is_none() {
                continue;
            }
            let of_grid = |grid| DepthField::new(on_side, grid, size(side)).map(Arc::new);
            match &on_side.topography {
                None => fields.fields = vec![of_grid(None)?],
                Some(t) => {
                    fields.of_tooth = t.of_teeth(self.data.teeth)?;
                    fields.fields = t.grids().iter().map(|grid| of_grid(Some(grid))).collect::<Result<_, _>>()?;
                }
            }
        }
        Ok(Self { modifications, fields, ..self })
    }

    /// Micro-geometry of the gear.
    pub fn modifications(&self) -> &GearModifications {
        &self.modifications
    }

    /// Whether flanks on `side` differ from the nominal flank.
    pub fn is_modified(&self, side: Side) -> bool {
        !self.fields_on(side).fields.is_empty() || self.modifications.has_pitch_errors()
    }

    /// Whether teeth differ from each other, by pitch errors or by measured flanks.
    pub fn has_own_teeth(&self) -> bool {
        self.modifications.has_pitch_errors() || self.has_own_flanks()
    }

    /// Whether individual teeth have flank forms of their own.
    pub fn has_own_flanks(&self) -> bool {
        self.fields.iter().any(|f| f.fields.len() > 1)
    }

    /// The gear with all teeth in their nominal positions.
    #[must_use]
    pub fn without_pitch_errors(&self) -> Self {
        let mut own = self.clone();
        own.modifications.pitch_errors.clear();
        own
    }

    fn fields_on(&self, side: Side) -> &FlankFields {
        match side {
            Side::Left => &self.fields[0],
            Side::Right => &self.fields[1],
        }
    }

    fn field(&self, side: Side, tooth: i64) -> Option<&Arc<DepthField>> {
        self.fields_on(side).of(tooth.rem_euclid(i64::from(self.data.teeth)) as usize)
    }

    /// Depth by which the pitch error of `tooth` (any integer) moves its flank on `side` back, mm.
    ///
    /// ```text
    /// h = -s e cos(a_t) cos(b_b)     s = +1 left, -1 right; e arc on the reference circle, positive in the direction in which teeth are numbered
    /// ```
    pub fn pitch_depth(&self, side: Side, tooth: i64) -> f64 {
        let index = tooth.rem_euclid(i64::from(self.data.teeth)) as usize;
        match self.modifications.pitch_errors.get(index) {
            None => 0.0,
            Some(e) => -side.sign() * e * self.transverse_pressure_angle().cos() * self.base_helix_angle().cos(),
        }
    }

    /// Depth at roll angle `u` and height `z` (mm) of `tooth` (any integer), pitch error included.
    pub fn depth(&self, side: Side, tooth: i64, u: f64, z: f64) -> Depth {
        let mut depth = self.field(side, tooth).map_or_else(Depth::default, |f| f.at(u, z));
        depth.value += self.pitch_depth(side, tooth);
        depth
    }

    /// The flank of `tooth` (any integer) as manufactured.
    pub fn modified_flank(&self, side: Side, tooth: i64) -> ModifiedFlank {
        self.modified_flank_at(side, tooth, tooth)
    }

    /// The flank of `tooth` in the position of tooth `place`, for a frame that is rotated against the gear by whole
    /// pitches.
    pub fn modified_flank_at(&self, side: Side, place: i64, tooth: i64) -> ModifiedFlank {
        ModifiedFlank::new(self.flank_of(side, place), self.field(side, tooth).cloned(), self.pitch_depth(side, tooth))
    }

    /// Data from which the gear was made.
    pub fn data(&self) -> &GearData {
        &self.data
    }

    /// Number of teeth, positive for an internal gear as well.
    pub fn teeth(&self) -> u32 {
        self.data.teeth
    }

    /// Number of teeth z, negative for an internal gear.
    pub fn signed_teeth(&self) -> f64 {
        self.data.signed_teeth()
    }

    /// Whether the gear is internal (its teeth point inwards).
    pub fn is_internal(&self) -> bool {
        self.data.is_internal()
    }

    /// +1 for an external gear, -1 for an internal one.
    pub fn sign(&self) -> f64 {
        self.data.sign()
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
        0.5 * self.transverse_module() * self.signed_teeth()
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

    /// Profile shift coefficient below which the rack's tip cuts away involute (undercut). An internal gear has no such
    /// limit.
    ///
    /// ```text
    /// x_min = h_d* - rho* (1 - sin a_n) - z sin^2(a_t) / (2 cos b)        h_d*, rho* over the normal module
    /// ```
    pub fn undercut_limit(&self) -> f64 {
        let d = &self.data;
        if d.is_internal() {
            return f64::NEG_INFINITY;
        }
        let straight = d.dedendum_coefficient - d.root_radius_coefficient * (1.0 - d.normal_pressure_angle.sin());
        let sin = self.transverse_pressure_angle().sin();
        straight - f64::from(d.teeth) * sin * sin / (2.0 * d.helix_angle.cos())
    }

    /// Root radius, mm.
    pub fn root_radius(&self) -> f64 {
        self.reference_radius() + self.data.normal_module * (self.data.profile_shift - self.data.dedendum_coefficient)
    }

    /// Transverse base pitch p_bt, mm.
    pub fn transverse_base_pitch(&self) -> f64 {
        2.0 * PI * self.base_radius() / self.signed_teeth()
    }

    /// A shaper cutter makes this ring without interference of its own.
    ///
    /// # Errors
    /// [`GeometryError::ShaperInterference`].
    fn check_cutting(&self) -> Result<(), GeometryError> {
        let Some((kind, amount)) = self.cutting_fault() else { return Ok(()) };
        let Some(shaper) = self.data.shaper else { return Ok(()) };
        let runs = |teeth: u32| {
            let data = GearData { shaper: Some(Shaper { teeth, ..shaper }), ..self.data.clone() };
            let profile = TransverseProfile::new(&data).ok()?;
            let tried = Self { data, profile, modifications: GearModifications::default(), fields: Default::default() };
            tried.cutting_fault().is_none().then_some(teeth)
        };
        // The nearest number of teeth that cures it: more against involute interference, fewer against the other.
        let cure = (1..self.data.teeth).find_map(|step| match kind {
            InternalInterference::Involute => runs(shaper.teeth.saturating_add(step)),
            InternalInterference::Trochoid => runs(shaper.teeth.saturating_sub(step)),
        });
        Err(GeometryError::ShaperInterference { kind, amount, teeth: shaper.teeth, cure })
    }

    /// What the cutter of this ring takes away of its tips: the kind, and by how much, mm or rad.
    fn cutting_fault(&self) -> Option<(InternalInterference, f64)> {
        let mesh = self.profile.cutter()?.mesh(self.tip_radius().abs());
        mesh.fault()
    }

    /// Angle from a tooth to the next one, 2 pi / z, rad; negative for an internal gear, whose teeth are numbered
    /// clockwise.
    pub fn pitch_angle(&self) -> f64 {
        2.0 * PI / self.signed_teeth()
    }

    /// Twist of the teeth along the axis, tan(beta)/r, rad/mm; positive for a right-hand helix.
    pub fn twist(&self) -> f64 {
        self.data.helix_angle.tan() / self.reference_radius().abs()
    }

    /// Transverse section of a tooth.
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
            base_helix_angle: self.sign() * self.base_helix_angle(),
            centre_angle: if self.is_internal() { PI } else { 0.0 } + tooth as f64 * self.pitch_angle(),
            roll_form: self.profile.roll_form(),
            roll_tip: self.profile.roll_tip(),
            half_width: 0.5 * self.data.face_width,
        }
    }
}

impl GearData {
    /// This ring, cut by the default shaper: it has a third of the ring's teeth, or as many more as are needed to cut
    /// the ring's tips without interference.
    #[must_use]
    pub fn with_usual_shaper(self, profile_shift: f64) -> Self {
        let of = |teeth: u32| GearData { shaper: Some(Shaper { teeth, profile_shift }), ..self.clone() };
        let least = (self.teeth / 3).max(5);
        let makes = |teeth: &u32| {
            let profile = TransverseProfile::new(&of(*teeth)).ok()?;
            let mesh = profile.cutter()?.mesh(profile.radius(profile.roll_tip()).abs());
            mesh.fault().is_none().then_some(())
        };
        let teeth = (least..self.teeth).find(|teeth| makes(teeth).is_some()).unwrap_or(least);
        of(teeth)
    }
}

fn check(name: &'static str, value: f64, fine: bool, expected: &'static str) -> Result<(), GeometryError> {
    if fine && value.is_finite() { Ok(()) } else { Err(GeometryError::OutOfRange { name, value, expected }) }
}
