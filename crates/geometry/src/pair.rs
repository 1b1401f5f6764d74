//! Two gears at a working centre distance. Theory (4), (5), (6), (6a), (6b).

use std::f64::consts::PI;
use std::mem::discriminant;

use serde::Serialize;

use crate::error::Undercut;
use crate::internal_mesh::InternalMesh;
use crate::roots::bisect;
use crate::{Gear, GearData, GeometryError, Sense, Side};

/// Depth over the module from which on a tip in a fillet is more than rounded data.
const INTERFERENCE_MODULES: f64 = 1e-3;
/// Profile shifts that are tried against undercut, in steps of a tenth.
const MOST_TENTHS: i32 = 20;

/// A running pair: the pinion is at the origin, the wheel at (a, 0, o), where o is the offset of its mid-face. a is
/// negative if the wheel is a ring, because its axis then lies on the other side of the contact.
///
/// ```text
/// cos a_wt = (r_b1 + r_b2) / a
/// z in [max(-b_1/2, o - b_2/2), min(b_1/2, o + b_2/2)]      common face, heights from the pinion's mid-face
/// ```
/// Flanks touch only over the common face. An offset moves the end faces of the wheel, not its teeth: the wheel is the
/// one without offset, extended and cut to other end faces. The origin of its own frame is at its own mid-face.
///
/// The path of contact is measured by xi (mm) along the transverse line of action from the pinion's tangent point T1:
/// xi = r_b1 u1, and a sin(a_wt) - xi = r_b2 u2. Both sides of the second equation are negative for a ring.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct GearPair {
    /// Gear 1.
    pub pinion: Gear,
    /// Gear 2.
    pub wheel: Gear,
    centre_distance: f64,
    /// Height of the wheel's mid-face over the pinion's, mm.
    mid_face_offset: f64,
}

impl GearPair {
    /// A pair with both mid-faces at the same height. `centre_distance` is in mm; `None`: the distance at which the
    /// only backlash is that from thinning (`inv a_wt = inv a_t + 2 (x1 + x2) tan a_n / (z1 + z2)`).
    ///
    /// # Errors
    /// [`GeometryError`] when the gears cannot mesh, jam, or do not reach each other.
    pub fn new(pinion: Gear, wheel: Gear, centre_distance: Option<f64>) -> Result<Self, GeometryError> {
        let (a, b) = (pinion.data(), wheel.data());
        if a.is_internal() {
            return Err(GeometryError::InternalPinion);
        }
        let hand = if b.is_internal() {
            ("helix angle of the same hand [rad]", a.helix_angle, b.helix_angle)
        } else {
            ("helix angle of opposite hand [rad]", a.helix_angle, -b.helix_angle)
        };
        let alike = [
            ("normal module [mm]", a.normal_module, b.normal_module),
            ("normal pressure angle [rad]", a.normal_pressure_angle, b.normal_pressure_angle),
            hand,
        ];
        for (name, p, w) in alike {
            if (p - w).abs() > 1e-12 * (1.0 + p.abs()) {
                return Err(GeometryError::Mismatch { name, pinion: p, wheel: w });
            }
        }
        if b.is_internal() && a.teeth >= b.teeth {
            let (name, expected) = ("teeth of the pinion", "fewer than the ring has");
            return Err(GeometryError::OutOfRange { name, value: f64::from(a.teeth), expected });
        }
        let centre_distance = centre_distance.unwrap_or_else(|| nominal_centre_distance(&pinion, &wheel));
        let pair = Self { pinion, wheel, centre_distance, mid_face_offset: 0.0 };
        pair.check().map_err(|error| pair.with_cure(error))?;
        Ok(pair)
    }

    /// This pair with the wheel's mid-face `offset` (mm) above the pinion's, along +z.
    ///
    /// # Errors
    /// [`GeometryError::FacesApart`] if the faces do not overlap, [`GeometryError::ContactRatio`] if they overlap too
    /// little, [`GeometryError::OutOfRange`] for an offset that is not a finite number.
    pub fn with_mid_face_offset(self, offset: f64) -> Result<Self, GeometryError> {
        if !offset.is_finite() {
            let (name, expected) = ("offset of the mid-faces [mm]", "a finite number");
            return Err(GeometryError::OutOfRange { name, value: offset, expected });
        }
        let pair = Self { mid_face_offset: offset, ..self };
        let [from, to] = pair.common_face();
        if to <= from {
            let [pinion_mm, wheel_mm] = pair.faces();
            return Err(GeometryError::FacesApart { pinion_mm, wheel_mm });
        }
        pair.check_contact_ratio()?;
        Ok(pair)
    }

    fn check(&self) -> Result<(), GeometryError> {
        self.check_fit()?;
        self.check_contact_ratio()
    }

    /// All that is needed but enough contact.
    fn check_fit(&self) -> Result<(), GeometryError> {
        let a = self.pinion.data();
        let least = self.pinion.base_radius() + self.wheel.base_radius();
        let sign = self.wheel.sign();
        if !self.centre_distance.is_finite() || sign * self.centre_distance <= sign * least {
            return Err(GeometryError::CentreDistance { centre_distance_mm: self.centre_distance, least_mm: least });
        }
        // Published pairs without thinning have shifts and distances rounded to four digits: a few 1e-5 m_n of jam.
        if self.backlash() < -1e-4 * a.normal_module {
            return Err(GeometryError::Jammed {
                backlash_mm: self.backlash(),
                nominal_mm: nominal_centre_distance(&self.pinion, &self.wheel),
                ring_shift: self.ring_shift_of_other_sign(),
            });
        }
        for (gear, tip, mate) in [("pinion", &self.pinion, &self.wheel), ("wheel", &self.wheel, &self.pinion)] {
            let clearance = self.centre_distance - tip.tip_radius() - mate.root_radius();
            if clearance < 0.0 {
                return Err(GeometryError::TipClearance { gear, clearance_mm: clearance });
            }
        }
        let names = ["pinion", "wheel"];
        if let Some(margin) = self.trochoid_margin().filter(|margin| *margin < 0.0) {
            return Err(GeometryError::Trochoid { margin, pinion_tip_mm: None });
        }
        for (i, gear) in [&self.pinion, &self.wheel].into_iter().enumerate() {
            let depth_mm = self.interference(i);
            if i == 0 && self.is_internal() && depth_mm > INTERFERENCE_MODULES * a.normal_module {
                return Err(self.involute_interference(depth_mm));
            }
            if depth_mm > INTERFERENCE_MODULES * a.normal_module {
                let form_diameter_mm = 2.0 * gear.form_radius();
                return Err(GeometryError::Interference {
                    tip: names[1 - i],
                    root: names[i],
                    depth_mm,
                    form_diameter_mm,
                });
            }
        }
        if self.path_length() <= 0.0 {
            return Err(GeometryError::NoContact { overlap_mm: self.path_length() });
        }
        Ok(())
    }

    /// The pair with all teeth in their nominal positions.
    #[must_use]
    pub fn without_pitch_errors(&self) -> Self {
        let (pinion, wheel) = (self.pinion.without_pitch_errors(), self.wheel.without_pitch_errors());
        Self { pinion, wheel, ..self.clone() }
    }

    /// Distance by which pitch errors bring the flanks of each gear closer on one side, mm along the normal. One value
    /// per tooth in the order in which the teeth come into mesh; an empty list for a gear without errors.
    ///
    /// ```text
    /// e(m) = e_1[m mod z_1] + e_2[-m mod z_2],   e_g[i] = -h(tooth -s i)
    /// ```
    /// m counts the pairs of teeth as they come into mesh, 0 being the pair of tooth 0 of both gears; h is
    /// [`Gear::pitch_depth`]; s = +1 if the pinion rotates counter-clockwise, -1 if clockwise.
    pub fn pitch_approaches(&self, side: Side, sense: Sense) -> [Vec<f64>; 2] {
        [&self.pinion, &self.wheel].map(|gear| {
            let teeth = i64::from(if gear.modifications().has_pitch_errors() { gear.teeth() } else { 0 });
            (0..teeth).map(|i| -gear.pitch_depth(side, -sense.sign() * i)).collect()
        })
    }

    /// Whether the wheel is a ring.
    pub fn is_internal(&self) -> bool {
        self.wheel.is_internal()
    }

    /// Profile shift coefficient of the ring with the opposite sign, if teeth of full thickness then fit the centre
    /// distance ten times better than with the given sign, which is off by more than m_n/20. Some conventions use z_2 >
    /// 0 and have the opposite sign of ISO 21771. `None` for other rings and for external pairs.
    pub fn ring_shift_of_other_sign(&self) -> Option<f64> {
        let [x1, x2] = [&self.pinion, &self.wheel].map(|gear| gear.data().profile_shift);
        let off = |x2: f64| (self.centre_distance - distance_of_shifts(&self.pinion, &self.wheel, x1 + x2)).abs();
        let [own, other] = [off(x2), off(-x2)];
        (self.is_internal() && own > 0.05 * self.pinion.data().normal_module && other < 0.1 * own).then_some(-x2)
    }

    fn internal_mesh(&self) -> Option<InternalMesh> {
        let gears = [&self.pinion, &self.wheel];
        self.is_internal().then(|| InternalMesh {
            teeth: gears.map(|gear| f64::from(gear.teeth())),
            base: gears.map(|gear| gear.base_radius().abs()),
            tip: gears.map(|gear| gear.tip_radius().abs()),
            distance: self.centre_distance.abs(),
            pressure_angle: self.working_pressure_angle(),
        })
    }

    /// Angle of the ring (rad) by which the tip corners clear each other after they have left contact, for flanks
    /// without backlash. Below zero they collide, and [`GearPair::new`] returns an error. Infinite where the tip
    /// circles do not cross; `None` for external pairs.
    pub fn trochoid_margin(&self) -> Option<f64> {
        self.internal_mesh().map(|mesh| mesh.trochoid_margin())
    }

    /// Angle of the pinion (rad) by which it clears the ring's tip corners during radial assembly. Below zero it can be
    /// assembled only axially. `None` for external pairs.
    pub fn trimming_margin(&self) -> Option<f64> {
        self.internal_mesh().map(|mesh| mesh.trimming_margin())
    }

    /// What is wrong, with the tip diameter that cures an interference.
    fn with_cure(&self, error: GeometryError) -> GeometryError {
        match error {
            GeometryError::Trochoid { margin, .. } => {
                let tip = self.tip_without_trochoid();
                GeometryError::Trochoid { margin, pinion_tip_mm: tip.and_then(|tip| self.cured_by_tip(&error, 0, tip)) }
            }
            GeometryError::Involute { tip_diameter_mm, path_mm, form_mm, depth_mm, .. } => {
                let least = -2.0 * self.wheel.base_radius().hypot(self.tangent_length() - form_mm);
                let ring_tip_mm = self.cured_by_tip(&error, 1, (1e3 * least).floor() / 1e3);
                GeometryError::Involute { tip_diameter_mm, path_mm, form_mm, depth_mm, ring_tip_mm }
            }
            other => other,
        }
    }

    /// A tip diameter (mm) of the pinion (0) or the wheel (1), if this pair is then without such an error.
    fn cured_by_tip(&self, error: &GeometryError, gear: usize, tip_diameter: f64) -> Option<f64> {
        let mut pair = self.clone();
        let own = if gear == 0 { &mut pair.pinion } else { &mut pair.wheel };
        *own = Gear::new(GearData { tip_diameter: Some(tip_diameter), ..own.data().clone() }).ok()?;
        let same = pair.check().is_err_and(|other| discriminant(&other) == discriminant(error));
        (!same).then_some(tip_diameter)
    }

    /// Largest tip diameter of the pinion (mm, three digits) at which its corners pass those of the ring.
    fn tip_without_trochoid(&self) -> Option<f64> {
        let mesh = self.internal_mesh()?;
        let margin = |tip: f64| InternalMesh { tip: [tip, mesh.tip[1]], ..mesh }.trochoid_margin();
        let least = mesh.tip[1] - mesh.distance;
        let radius = bisect(least.max(self.pinion.form_radius()), mesh.tip[0], margin);
        Some((2e3 * radius).floor() / 1e3 - 1e-3)
    }

    /// The ring's tip enters the pinion's teeth by `depth_mm`.
    fn involute_interference(&self, depth_mm: f64) -> GeometryError {
        let (length, ring) = (self.tangent_length(), &self.wheel);
        GeometryError::Involute {
            tip_diameter_mm: 2.0 * ring.tip_radius(),
            path_mm: length - ring.base_radius() * ring.profile().roll_tip(),
            form_mm: self.pinion.base_radius() * self.pinion.profile().roll_form(),
            depth_mm,
            ring_tip_mm: None,
        }
    }

    fn check_contact_ratio(&self) -> Result<(), GeometryError> {
        let contact_ratio = self.total_contact_ratio();
        if contact_ratio >= 1.0 {
            return Ok(());
        }
        Err(GeometryError::ContactRatio { contact_ratio, undercut: self.undercut() })
    }

    /// The gear that the rack undercuts most, and the profile shifts with which the pair has contact enough.
    fn undercut(&self) -> Option<Undercut> {
        let gears = [&self.pinion, &self.wheel];
        let lacks = gears.map(|gear| gear.undercut_limit() - gear.data().profile_shift);
        let own = usize::from(lacks[1] > lacks[0]);
        if lacks[own] <= 0.0 {
            return None;
        }
        let nominal = nominal_centre_distance(&self.pinion, &self.wheel);
        let is_nominal = (self.centre_distance - nominal).abs() <= 1e-9 * nominal;
        let before = gears.map(|gear| gear.data().profile_shift);
        let tried = |step: i32, is_nominal: bool| {
            let shift = (10.0 * before[own]).floor() / 10.0 + f64::from(step) / 10.0;
            // At a given centre distance the mating gear has the rest of the shift.
            let mate = if is_nominal { before[1 - own] } else { before[1 - own] + before[own] - shift };
            let shifts = if own == 0 { [shift, mate] } else { [mate, shift] };
            let [pinion, wheel] = [0, 1].map(|i| {
                let data = GearData { profile_shift: shifts[i], ..gears[i].data().clone() };
                Gear::new(data).ok()
            });
            let (pinion, wheel) = (pinion?, wheel?);
            let centre_distance =
                if is_nominal { nominal_centre_distance(&pinion, &wheel) } else { self.centre_distance };
            let pair = Self { pinion, wheel, centre_distance, mid_face_offset: self.mid_face_offset };
            let runs = pair.check_fit().is_ok() && pair.total_contact_ratio() >= 1.0;
            let rounded = |x: f64| (1e4 * x).round() / 1e4;
            runs.then_some(shifts.map(rounded))
        };
        let at = |is_nominal: bool| (1..=MOST_TENTHS).find_map(|step| tried(step, is_nominal));
        let kept = at(is_nominal);
        let moved = if is_nominal { None } else { at(true) };
        let moves_axes = kept.is_none() && moved.is_some();
        Some(Undercut { gear: ["pinion", "wheel"][own], cure: kept.or(moved), moves_axes })
    }

    /// Working centre distance a, mm; negative if the wheel is a ring.
    pub fn centre_distance(&self) -> f64 {
        self.centre_distance
    }

    /// Working transverse pressure angle a_wt, rad.
    pub fn working_pressure_angle(&self) -> f64 {
        ((self.pinion.base_radius() + self.wheel.base_radius()) / self.centre_distance).acos()
    }

    /// Working pitch radii r_w1, r_w2, mm; negative for a ring.
    pub fn working_radii(&self) -> [f64; 2] {
        let cos = self.working_pressure_angle().cos();
        [self.pinion.base_radius() / cos, self.wheel.base_radius() / cos]
    }

    /// Base helix angle of the pinion, rad, signed.
    pub fn base_helix_angle(&self) -> f64 {
        self.pinion.base_helix_angle()
    }

    /// Height of the wheel's mid-face above the pinion's, along +z, mm.
    pub fn mid_face_offset(&self) -> f64 {
        self.mid_face_offset
    }

    /// Heights of the end faces of pinion and wheel above the pinion's mid-face, mm.
    pub fn faces(&self) -> [[f64; 2]; 2] {
        let of = |middle: f64, width: f64| [middle - 0.5 * width, middle + 0.5 * width];
        [of(0.0, self.pinion.face_width()), of(self.mid_face_offset, self.wheel.face_width())]
    }

    /// Range of heights, measured from the pinion's mid-face, in which both gears have flanks, mm.
    pub fn common_face(&self) -> [f64; 2] {
        let [[p0, p1], [w0, w1]] = self.faces();
        [p0.max(w0), p1.min(w1)]
    }

    /// Height of the middle of the common face above the mid-face of the pinion and of the wheel, mm; 0 if the common
    /// face contains both mid-faces.
    pub fn common_middle(&self) -> [f64; 2] {
        let [from, to] = self.common_face();
        let middle = 0.5 * (from + to);
        [middle, middle - self.mid_face_offset]
    }

    /// Width of the common face b, mm.
    pub fn face_width(&self) -> f64 {
        let [from, to] = self.common_face();
        to - from
    }

    /// Transverse base pitch, mm.
    pub fn transverse_base_pitch(&self) -> f64 {
        self.pinion.transverse_base_pitch()
    }

    /// Path coordinate of the wheel's tangent point T2, a sin(a_wt), mm. Negative for a ring, whose tangent point lies
    /// before that of the pinion.
    pub fn tangent_length(&self) -> f64 {
        self.centre_distance * self.working_pressure_angle().sin()
    }

    /// Path of contact [xi_A, xi_E], mm from T1. It is bounded by the tips, or by a gear's root form circle where that
    /// is the tighter limit.
    pub fn path_of_contact(&self) -> [f64; 2] {
        let length = self.tangent_length();
        let (p, w) = (self.pinion.profile(), self.wheel.profile());
        let (rb1, rb2) = (self.pinion.base_radius(), self.wheel.base_radius());
        let start = (length - rb2 * w.roll_tip()).max(rb1 * p.roll_form());
        let end = (rb1 * p.roll_tip()).min(length - rb2 * w.roll_form());
        [start, end]
    }

    /// Length of the path of contact g_alpha, mm.
    pub(crate) fn path_length(&self) -> f64 {
        let [start, end] = self.path_of_contact();
        end - start
    }

    /// Transverse contact ratio eps_alpha = g_alpha / p_bt.
    pub fn transverse_contact_ratio(&self) -> f64 {
        self.path_length() / self.transverse_base_pitch()
    }

    /// Overlap ratio eps_beta = b tan(b_b) / p_bt.
    pub fn overlap_ratio(&self) -> f64 {
        self.face_width() * self.base_helix_angle().tan().abs() / self.transverse_base_pitch()
    }

    /// Total contact ratio eps_gamma = eps_alpha + eps_beta.
    pub fn total_contact_ratio(&self) -> f64 {
        self.transverse_contact_ratio() + self.overlap_ratio()
    }

    /// Backlash between the coast flanks along the transverse line of action, mm, while the drive flanks touch.
    pub fn backlash(&self) -> f64 {
        let a_wt = self.working_pressure_angle();
        let inv = crate::involute(a_wt);
        let thickness = |g: &Gear| 2.0 * (g.profile().base_half_angle() - inv) * g.base_radius() / a_wt.cos();
        let pitch = 2.0 * PI * self.working_radii()[0] / f64::from(self.pinion.teeth());
        (pitch - thickness(&self.pinion) - thickness(&self.wheel)) * a_wt.cos()
    }

    /// Path coordinate xi (mm) of pinion tooth `tooth` at height `z` (mm above the pinion's mid-face), when the pinion
    /// is at angle `pinion_angle` [rad, counter-clockwise] and the flanks on `side` are in contact.
    ///
    /// xi = r_b1 [s (theta_1 + 2 pi k / z1 + k_1 z) + sigma_1 + a_wt]
    pub fn path_coordinate(&self, side: Side, pinion_angle: f64, tooth: i64, z: f64) -> f64 {
        self.path_coordinates(side, pinion_angle)(tooth, z)
    }

    /// [`Self::path_coordinate`] as a function of tooth and height, with its constants computed once.
    pub fn path_coordinates(&self, side: Side, pinion_angle: f64) -> impl Fn(i64, f64) -> f64 {
        let p = &self.pinion;
        let (pitch, twist, base, sign) = (p.pitch_angle(), p.twist(), p.base_radius(), side.sign());
        let (half, a_wt) = (p.profile().base_half_angle(), self.working_pressure_angle());
        move |tooth, z| base * (sign * (pinion_angle + tooth as f64 * pitch + twist * z) + half + a_wt)
    }

    /// Pinion angle (rad) at which pinion tooth 0, in the middle of the common face, is in the middle of the path of
    /// contact.
    pub fn middle_angle(&self, side: Side) -> f64 {
        let [start, end] = self.path_of_contact();
        let p = &self.pinion;
        let roll = 0.5 * (start + end) / p.base_radius();
        let at_mid_face = side.sign() * (roll - p.profile().base_half_angle() - self.working_pressure_angle());
        at_mid_face - p.twist() * self.common_middle()[0]
    }

    /// Wheel angle (rad) at which wheel tooth 0 (own frame rotated by this angle) touches pinion tooth 0 on flanks
    /// `side`, both unloaded. Pinion tooth k then touches wheel tooth -k.
    ///
    /// ```text
    /// s (theta_2 - k_2 o - pi) r_b2 = a sin(a_wt) - r_b1 (s theta_1 + sigma_1 + a_wt) - r_b2 (sigma_2 + a_wt)
    /// ```
    /// o is the offset of the mid-faces, k_2 the twist of the wheel's teeth. Both angles refer to tooth 0 at its own
    /// mid-face. For a ring the term pi is omitted, because tooth 0 of a ring is on +x like that of any gear.
    pub fn wheel_angle(&self, side: Side, pinion_angle: f64) -> f64 {
        self.wheel_angle_at(side, pinion_angle, [self.centre_distance, 0.0])
    }

    /// [`Self::wheel_angle`] with the wheel's centre at `centre` (mm, from the pinion's) and parallel axes: the same
    /// formula with the actual distance, both angles measured from the line of centres. NaN where the base circles
    /// overlap.
    pub fn wheel_angle_at(&self, side: Side, pinion_angle: f64, centre: [f64; 2]) -> f64 {
        let (rb1, rb2) = (self.pinion.base_radius(), self.wheel.base_radius());
        let (s1, s2) = (self.pinion.profile().base_half_angle(), self.wheel.profile().base_half_angle());
        // The direction of the contact: to the wheel's centre, and away from that of a ring.
        let sign = self.wheel.sign();
        let (distance, turned) = (sign * centre[0].hypot(centre[1]), (sign * centre[1]).atan2(sign * centre[0]));
        let facing = if self.is_internal() { 0.0 } else { PI };
        let (s, a_wt) = (side.sign(), ((rb1 + rb2) / distance).acos());
        let tangents = distance * a_wt.sin();
        let rest = tangents - rb1 * (s * (pinion_angle - turned) + s1 + a_wt) - rb2 * (s2 + a_wt);
        turned + (facing + s * rest / rb2) + self.wheel.twist() * self.mid_face_offset
    }
}

fn nominal_centre_distance(pinion: &Gear, wheel: &Gear) -> f64 {
    distance_of_shifts(pinion, wheel, pinion.data().profile_shift + wheel.data().profile_shift)
}

/// inv a_wt = inv a_t + 2 x tan a_n / (z1 + z2); a = (r_1 + r_2) cos a_t / cos a_wt; x: sum of the profile shifts.
fn distance_of_shifts(pinion: &Gear, wheel: &Gear, shifts: f64) -> f64 {
    let alpha_t = pinion.transverse_pressure_angle();
    let teeth = pinion.signed_teeth() + wheel.signed_teeth();
    let target = crate::involute(alpha_t) + 2.0 * shifts * pinion.data().normal_pressure_angle.tan() / teeth;
    let a_wt = if shifts == 0.0 { alpha_t } else { bisect(0.0, 1.4, |a| target.max(0.0) - crate::involute(a)) };
    (pinion.base_radius() + wheel.base_radius()) / a_wt.cos()
}
