//! The numbers of a pair that drawings and standards ask for. Terms and formulas of ISO 21771-1.

use std::f64::consts::PI;

use serde::Serialize;

use crate::{Gear, GearPair, involute, profile::roll_angle};

/// Everything that a geometry sheet says of a pair; units are in the names.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[allow(missing_docs)] // the names say what they are, `docs/outputs.md` how they are formed
pub struct GeometrySheet {
    pub normal_module_mm: f64,
    pub normal_pressure_angle_deg: f64,
    pub helix_angle_deg: f64,
    pub transverse_module_mm: f64,
    pub transverse_pressure_angle_deg: f64,
    pub base_helix_angle_deg: f64,
    pub reference_centre_distance_mm: f64,
    pub centre_distance_mm: f64,
    pub working_pressure_angle_deg: f64,
    pub sum_of_profile_shifts: f64,
    pub transverse_base_pitch_mm: f64,
    pub normal_base_pitch_mm: f64,
    pub path_of_contact_mm: f64,
    pub approach_path_mm: f64,
    pub recess_path_mm: f64,
    /// Of the common face.
    pub common_face_width_mm: f64,
    /// Height of the wheel's mid-face over the pinion's.
    pub mid_face_offset_mm: f64,
    pub eps_alpha: f64,
    pub eps_beta: f64,
    pub eps_gamma: f64,
    pub circumferential_backlash_mm: f64,
    pub normal_backlash_mm: f64,
    /// Linear formula of ISO 21771.
    pub radial_backlash_mm: f64,
    /// [`GearPair::even_loss_factor`].
    pub tooth_loss_factor: f64,
    pub pinion: GearSheet,
    pub wheel: GearSheet,
    /// A, B, C, D, E along the path of contact, from the start of contact of a driving pinion; B and D where between one
    /// and two pairs of teeth mesh.
    pub points: Vec<PathPoint>,
}

/// What it says of one gear.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[allow(missing_docs)]
pub struct GearSheet {
    pub teeth: u32,
    pub face_width_mm: f64,
    pub profile_shift: f64,
    pub reference_diameter_mm: f64,
    pub base_diameter_mm: f64,
    pub working_pitch_diameter_mm: f64,
    pub tip_diameter_mm: f64,
    pub root_diameter_mm: f64,
    pub root_form_diameter_mm: f64,
    pub start_of_active_profile_diameter_mm: f64,
    pub end_of_active_profile_diameter_mm: f64,
    /// Lowest and highest point of single tooth contact.
    pub single_contact_diameters_mm: Option<[f64; 2]>,
    pub roll_angle_form_deg: f64,
    pub roll_angle_start_of_active_profile_deg: f64,
    pub roll_angle_pitch_deg: f64,
    pub roll_angle_end_of_active_profile_deg: f64,
    pub normal_tooth_thickness_mm: f64,
    pub tooth_thickness_allowance_mm: f64,
    pub normal_tip_thickness_mm: f64,
    pub span: Option<Span>,
    pub balls: Option<Balls>,
}

/// Base tangent length over some teeth.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[allow(missing_docs)]
pub struct Span {
    pub teeth: u32,
    /// Of teeth as thick as the scene has them, and without their allowance.
    pub length_mm: f64,
    pub nominal_length_mm: f64,
    /// Diameter at which the jaws touch.
    pub contact_diameter_mm: f64,
    /// Face width that a helical gear wants for it.
    pub least_face_width_mm: f64,
}

/// Dimension over two balls.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[allow(missing_docs)]
pub struct Balls {
    pub ball_diameter_mm: f64,
    /// Of teeth as thick as the scene has them, and without their allowance.
    pub dimension_mm: f64,
    pub nominal_dimension_mm: f64,
}

/// A point of the path of contact.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[allow(missing_docs)]
pub struct PathPoint {
    pub name: char,
    /// From the point where the path touches the pinion's base circle.
    pub path_coordinate_mm: f64,
    pub from_start_mm: f64,
    /// Radii of curvature in the transverse section.
    pub pinion_curvature_radius_mm: f64,
    pub wheel_curvature_radius_mm: f64,
    pub pinion_diameter_mm: f64,
    pub wheel_diameter_mm: f64,
    /// Sliding over rolling speed, of the flank named.
    pub pinion_specific_sliding: f64,
    pub wheel_specific_sliding: f64,
    /// For one revolution of the pinion a minute: times its speed in 1/min, these are speeds in mm/s.
    pub sliding_speed_mm_s_per_rpm: f64,
    pub pinion_rolling_speed_mm_s_per_rpm: f64,
    pub wheel_rolling_speed_mm_s_per_rpm: f64,
}

/// Balls and pins that are to be had, mm (DIN 3977).
const BALLS: [f64; 46] = [
    0.5, 0.55, 0.6, 0.7, 0.8, 0.9, 1.0, 1.1, 1.25, 1.4, 1.5, 1.75, 2.0, 2.25, 2.5, 2.75, 3.0, 3.25, 3.5, 3.75, 4.0,
    4.25, 4.5, 5.0, 5.25, 5.5, 6.0, 6.5, 7.0, 7.5, 8.0, 9.0, 10.0, 10.5, 11.0, 12.0, 14.0, 15.0, 16.0, 18.0, 20.0,
    22.0, 25.0, 28.0, 30.0, 35.0,
];

impl GearPair {
    /// The geometry sheet.
    pub fn sheet(&self) -> GeometrySheet {
        let (pinion, wheel) = (&self.pinion, &self.wheel);
        let data = pinion.data();
        let a_wt = self.working_pressure_angle();
        let [start, end] = self.path_of_contact();
        let pitch_point = pinion.base_radius() * a_wt.tan();
        let pitch = self.transverse_base_pitch();
        let beta_b = self.base_helix_angle();
        let backlash = self.backlash();
        let one_pair = (1.0..2.0).contains(&self.transverse_contact_ratio());
        let inner = one_pair.then_some([end - pitch, start + pitch]);
        let named = [
            ('A', Some(start)),
            ('B', inner.map(|i| i[0])),
            ('C', Some(pitch_point)),
            ('D', inner.map(|i| i[1])),
            ('E', Some(end)),
        ];
        let points = named.into_iter().filter_map(|(name, xi)| Some(self.path_point(name, xi?, start))).collect();
        let length = self.tangent_length();
        let [of_pinion, of_wheel] = [[start, end], [length - end, length - start]];
        let seen_by_wheel = inner.map(|[low, high]| [length - high, length - low]);
        GeometrySheet {
            normal_module_mm: data.normal_module,
            normal_pressure_angle_deg: data.normal_pressure_angle.to_degrees(),
            helix_angle_deg: data.helix_angle.to_degrees(),
            transverse_module_mm: pinion.transverse_module(),
            transverse_pressure_angle_deg: pinion.transverse_pressure_angle().to_degrees(),
            base_helix_angle_deg: beta_b.to_degrees(),
            reference_centre_distance_mm: pinion.reference_radius() + wheel.reference_radius(),
            centre_distance_mm: self.centre_distance(),
            working_pressure_angle_deg: a_wt.to_degrees(),
            sum_of_profile_shifts: data.profile_shift + wheel.data().profile_shift,
            transverse_base_pitch_mm: pitch,
            normal_base_pitch_mm: pitch * beta_b.cos(),
            path_of_contact_mm: end - start,
            approach_path_mm: pitch_point - start,
            recess_path_mm: end - pitch_point,
            common_face_width_mm: self.face_width(),
            mid_face_offset_mm: self.mid_face_offset(),
            eps_alpha: self.transverse_contact_ratio(),
            eps_beta: self.overlap_ratio(),
            eps_gamma: self.total_contact_ratio(),
            circumferential_backlash_mm: backlash / a_wt.cos(),
            normal_backlash_mm: backlash * beta_b.cos(),
            radial_backlash_mm: backlash / (2.0 * a_wt.sin()),
            tooth_loss_factor: self.even_loss_factor(),
            pinion: gear_sheet(pinion, a_wt, of_pinion, inner),
            wheel: gear_sheet(wheel, a_wt, of_wheel, seen_by_wheel),
            points,
        }
    }

    /// ```text
    /// zeta_1 = 1 - (z_1 / z_2) rho_2 / rho_1,   v_g = (omega_1 + omega_2) |xi - xi_C|
    /// ```
    fn path_point(&self, name: char, xi: f64, start: f64) -> PathPoint {
        let other = self.tangent_length() - xi;
        let diameter = |gear: &Gear, xi: f64| 2.0 * gear.base_radius().hypot(xi);
        let ratio = f64::from(self.pinion.teeth()) / f64::from(self.wheel.teeth());
        let turn = 2.0 * PI / 60.0;
        let (first, second) = (turn * xi, turn * ratio * other);
        PathPoint {
            name,
            path_coordinate_mm: xi,
            from_start_mm: xi - start,
            pinion_curvature_radius_mm: xi,
            wheel_curvature_radius_mm: other,
            pinion_diameter_mm: diameter(&self.pinion, xi),
            wheel_diameter_mm: diameter(&self.wheel, other),
            pinion_specific_sliding: 1.0 - second / first,
            wheel_specific_sliding: 1.0 - first / second,
            sliding_speed_mm_s_per_rpm: (first - second).abs(),
            pinion_rolling_speed_mm_s_per_rpm: first,
            wheel_rolling_speed_mm_s_per_rpm: second,
        }
    }
}

fn gear_sheet(gear: &Gear, a_wt: f64, [low, high]: [f64; 2], single: Option<[f64; 2]>) -> GearSheet {
    let (data, profile, base) = (gear.data(), gear.profile(), gear.base_radius());
    let diameter = |xi: f64| 2.0 * base.hypot(xi);
    let roll = |xi: f64| (xi / base).to_degrees();
    let thickness = |radius: f64| {
        let u = roll_angle(radius, base).unwrap_or(0.0);
        // The helix angle grows with the radius.
        let helix = (data.helix_angle.tan() * radius / gear.reference_radius()).atan();
        2.0 * radius * profile.half_angle(u) * helix.cos()
    };
    GearSheet {
        teeth: gear.teeth(),
        face_width_mm: data.face_width,
        profile_shift: data.profile_shift,
        reference_diameter_mm: 2.0 * gear.reference_radius(),
        base_diameter_mm: 2.0 * base,
        working_pitch_diameter_mm: 2.0 * base / a_wt.cos(),
        tip_diameter_mm: 2.0 * gear.tip_radius(),
        root_diameter_mm: 2.0 * gear.root_radius(),
        root_form_diameter_mm: 2.0 * gear.form_radius(),
        start_of_active_profile_diameter_mm: diameter(low),
        end_of_active_profile_diameter_mm: diameter(high),
        single_contact_diameters_mm: single.map(|ends| ends.map(diameter)),
        roll_angle_form_deg: profile.roll_form().to_degrees(),
        roll_angle_start_of_active_profile_deg: roll(low),
        roll_angle_pitch_deg: a_wt.tan().to_degrees(),
        roll_angle_end_of_active_profile_deg: roll(high),
        normal_tooth_thickness_mm: thickness(gear.reference_radius()),
        tooth_thickness_allowance_mm: data.thickness_allowance,
        normal_tip_thickness_mm: thickness(gear.tip_radius()),
        span: span(gear),
        balls: balls(gear),
    }
}

/// Radius at which gauges had best touch: reference radius plus profile shift.
fn gauge_radius(gear: &Gear) -> f64 {
    gear.reference_radius() + gear.data().profile_shift * gear.data().normal_module
}

/// W_k = (k - 1) p_bn + s_bn with the k whose jaws touch nearest to the gauge circle; `None` where no jaws reach both
/// flanks.
fn span(gear: &Gear) -> Option<Span> {
    let (data, beta_b) = (gear.data(), gear.base_helix_angle());
    let pitch = gear.transverse_base_pitch() * beta_b.cos();
    let base_thickness = 2.0 * gear.base_radius() * gear.profile().base_half_angle() * beta_b.cos();
    let over = |teeth: u32| {
        let length_mm = f64::from(teeth - 1) * pitch + base_thickness;
        // The jaws touch half of it from the point where the common normal touches the base cylinder.
        let radius = gear.base_radius().hypot(0.5 * length_mm * beta_b.cos());
        Span {
            teeth,
            length_mm,
            nominal_length_mm: length_mm + data.thickness_allowance * data.normal_pressure_angle.cos(),
            contact_diameter_mm: 2.0 * radius,
            least_face_width_mm: length_mm * beta_b.sin().abs(),
        }
    };
    let off = |s: &Span| (0.5 * s.contact_diameter_mm - gauge_radius(gear)).abs();
    let reached =
        |s: &Span| s.contact_diameter_mm > 2.0 * gear.form_radius() && s.contact_diameter_mm < 2.0 * gear.tip_radius();
    (1..=gear.teeth().div_ceil(2)).map(over).filter(reached).min_by(|a, b| off(a).total_cmp(&off(b)))
}

/// M_dK with the ball to be had that touches nearest to the gauge circle.
///
/// ```text
/// inv a_Kt = D_M / (2 r_b cos b_b) - eta_b,   eta_b = pi/z - psi_b half a base space
/// M_dK = 2 r_b / cos a_Kt + D_M        (even z; odd: 2 r_b cos(pi / 2z) / cos a_Kt + D_M)
/// ```
fn balls(gear: &Gear) -> Option<Balls> {
    let (data, base, beta_b) = (gear.data(), gear.base_radius(), gear.base_helix_angle());
    let z = f64::from(gear.teeth());
    let half_space = |half_tooth: f64| PI / z - half_tooth;
    let half_tooth = gear.profile().base_half_angle();
    // Half the transverse tooth angle that the allowance takes.
    let allowance = data.thickness_allowance / (2.0 * gear.reference_radius() * data.helix_angle.cos());
    let dimension = |ball: f64, half_tooth: f64| {
        let angle = inverse_involute(ball / (2.0 * base * beta_b.cos()) - half_space(half_tooth))?;
        let across = if gear.teeth().is_multiple_of(2) { 1.0 } else { (PI / (2.0 * z)).cos() };
        Some((2.0 * base / angle.cos() * across + ball, angle))
    };
    let of = |ball: f64| {
        let (dimension_mm, angle) = dimension(ball, half_tooth)?;
        let (nominal_dimension_mm, _) = dimension(ball, half_tooth + allowance)?;
        // Where it touches the flank: half a ball back along the generating line.
        let touched = base.hypot(base * angle.tan() - 0.5 * ball * beta_b.cos());
        let stands_out = dimension_mm > 2.0 * gear.tip_radius();
        let on_flank = touched > gear.form_radius() && touched < gear.tip_radius();
        let off = (touched - gauge_radius(gear)).abs();
        (stands_out && on_flank).then_some((Balls { ball_diameter_mm: ball, dimension_mm, nominal_dimension_mm }, off))
    };
    BALLS.into_iter().filter_map(of).min_by(|a, b| a.1.total_cmp(&b.1)).map(|(balls, _)| balls)
}

/// The angle whose involute is given; `None` for what is none.
fn inverse_involute(value: f64) -> Option<f64> {
    if !(value > 0.0 && value < 10.0) {
        return None;
    }
    // inv a = tan a - a: monotone, and steep only near a right angle.
    let (mut low, mut high) = (0.0, 1.56);
    for _ in 0..80 {
        let middle = 0.5 * (low + high);
        if involute(middle) < value { low = middle } else { high = middle }
    }
    Some(0.5 * (low + high))
}
