//! The quantities of a pair that drawings and standards ask for. Terms and formulas of ISO 21771-1.

use std::f64::consts::PI;

use serde::Serialize;

use crate::{Gear, GearPair, profile::roll_angle, roots::inverse_involute};

described::described! {
    /// All quantities of the geometry sheet of a pair; units are in the names.
    #[derive(Debug, Clone, PartialEq, Serialize)]
    pub struct GeometrySheet {
        /// normal module
        pub normal_module_mm: f64,
        /// normal pressure angle
        pub normal_pressure_angle_deg: f64,
        /// helix angle of the pinion on the reference cylinder, right hand positive
        pub helix_angle_deg: f64,
        /// transverse module
        pub transverse_module_mm: f64,
        /// transverse pressure angle
        pub transverse_pressure_angle_deg: f64,
        /// helix angle of the pinion on the base cylinder
        pub base_helix_angle_deg: f64,
        /// reference centre distance (d_1 + d_2) / 2
        pub reference_centre_distance_mm: f64,
        /// centre distance
        pub centre_distance_mm: f64,
        /// working transverse pressure angle
        pub working_pressure_angle_deg: f64,
        /// sum of the profile shift coefficients x_1 + x_2
        pub sum_of_profile_shifts: f64,
        /// transverse base pitch p_bt
        pub transverse_base_pitch_mm: f64,
        /// normal base pitch p_bn
        pub normal_base_pitch_mm: f64,
        /// length of the path of contact AE
        pub path_of_contact_mm: f64,
        /// approach path AC of a driving pinion
        pub approach_path_mm: f64,
        /// recess path CE of a driving pinion
        pub recess_path_mm: f64,
        /// width over which both gears have flanks
        pub common_face_width_mm: f64,
        /// height of the wheel's mid-face over the pinion's
        pub mid_face_offset_mm: f64,
        /// transverse contact ratio
        pub eps_alpha: f64,
        /// overlap ratio of the common face
        pub eps_beta: f64,
        /// total contact ratio
        pub eps_gamma: f64,
        /// backlash at the working pitch circles
        pub circumferential_backlash_mm: f64,
        /// backlash normal to the flanks
        pub normal_backlash_mm: f64,
        /// centre-distance change that removes the backlash (linear formula, ISO 21771: backlash along the line of action over 2 sin a_wt)
        pub radial_backlash_mm: f64,
        /// H_V of a load that lies evenly on all contact lines, averaged over the mesh cycle: times the coefficient of friction, the share of the power that is lost. For spur pairs with a contact ratio of 1 to 2 it is Ohlendorf's closed form (ISO/TR 14179-2), which does not hold for helical pairs
        pub tooth_loss_factor: f64,
        /// numbers of the pinion
        pub pinion: GearSheet,
        /// numbers of the wheel
        pub wheel: GearSheet,
        /// numbers of the ring; missing for an external pair
        #[serde(skip_serializing_if = "Option::is_none")]
        pub ring: Option<RingSheet>,
        /// points A to E of the path of contact, from the start of contact of a driving pinion; B and D where between one and two pairs mesh
        pub points: Vec<PathPoint>,
    }
}

described::described! {
    /// Additional quantities of a pair whose wheel is a ring: magnitudes as on a drawing, tip interference margins,
    /// tool data.
    #[derive(Debug, Clone, Copy, PartialEq, Serialize)]
    pub struct RingSheet {
        /// magnitude of the centre distance
        pub centre_distance_magnitude_mm: f64,
        /// magnitude of the ring's reference diameter
        pub reference_diameter_magnitude_mm: f64,
        /// magnitude of the ring's base diameter
        pub base_diameter_magnitude_mm: f64,
        /// magnitude of the ring's tip diameter
        pub tip_diameter_magnitude_mm: f64,
        /// magnitude of the ring's root diameter
        pub root_diameter_magnitude_mm: f64,
        /// magnitude of the ring's root form diameter
        pub root_form_diameter_magnitude_mm: f64,
        /// magnitude of the diameter at the ring's start of active profile
        pub start_of_active_profile_diameter_magnitude_mm: f64,
        /// path coordinate from which on the ring's tip asks for involute of the pinion, less that where the pinion has it; below 0 tips interfere
        pub involute_margin_mm: f64,
        /// margin against trochoid interference of the tips; `null` where the tip circles do not cross
        pub trochoid_margin_deg: Option<f64>,
        /// margin against trimming: below 0 the pinion cannot be put in radially
        pub trimming_margin_deg: f64,
        /// teeth of the shaper
        pub shaper_teeth: u32,
        /// profile shift coefficient of the shaper
        pub shaper_profile_shift: f64,
        /// tip diameter of the shaper
        pub shaper_tip_diameter_mm: f64,
        /// tip rounding of the shaper
        pub shaper_tip_rounding_mm: f64,
        /// centre distance of shaper and ring at full depth
        pub shaper_centre_distance_mm: f64,
        /// working pressure angle of shaper and ring at full depth
        pub shaper_working_pressure_angle_deg: f64,
        /// margin against trimming by the shaper: below 0 a radial feed trims the ring's tips
        pub shaper_trimming_margin_deg: f64,
    }
}

described::described! {
    /// Sheet of one gear.
    #[derive(Debug, Clone, PartialEq, Serialize)]
    pub struct GearSheet {
        /// number of teeth, negative of an internal gear, as its diameters are
        pub teeth: i64,
        /// face width
        pub face_width_mm: f64,
        /// profile shift coefficient
        pub profile_shift: f64,
        /// reference diameter
        pub reference_diameter_mm: f64,
        /// base diameter
        pub base_diameter_mm: f64,
        /// working pitch diameter
        pub working_pitch_diameter_mm: f64,
        /// tip diameter
        pub tip_diameter_mm: f64,
        /// root diameter
        pub root_diameter_mm: f64,
        /// root form diameter, where the fillet ends
        pub root_form_diameter_mm: f64,
        /// start of active profile
        pub start_of_active_profile_diameter_mm: f64,
        /// end of active profile
        pub end_of_active_profile_diameter_mm: f64,
        /// lowest and highest point of single tooth contact; `null` unless between one and two pairs mesh
        pub single_contact_diameters_mm: Option<[f64; 2]>,
        /// roll angle at the root form diameter
        pub roll_angle_form_deg: f64,
        /// roll angle at the start of active profile
        pub roll_angle_start_of_active_profile_deg: f64,
        /// roll angle at the pitch point
        pub roll_angle_pitch_deg: f64,
        /// roll angle at the end of active profile
        pub roll_angle_end_of_active_profile_deg: f64,
        /// normal tooth thickness at the reference circle
        pub normal_tooth_thickness_mm: f64,
        /// tooth thickness allowance
        pub tooth_thickness_allowance_mm: f64,
        /// normal tooth thickness at the tip circle
        pub normal_tip_thickness_mm: f64,
        /// base tangent length; `null` where no jaws reach both flanks
        pub span: Option<Span>,
        /// dimension over two balls; `null` where no ball touches both flanks and protrudes
        pub balls: Option<Balls>,
    }
}

described::described! {
    /// Base tangent length over some teeth.
    #[derive(Debug, Clone, Copy, PartialEq, Serialize)]
    pub struct Span {
        /// teeth between the jaws, which then touch nearest to d + 2 x m_n
        pub teeth: u32,
        /// base tangent length with the tooth thickness allowance
        pub length_mm: f64,
        /// base tangent length without allowance
        pub nominal_length_mm: f64,
        /// diameter at which the jaws touch
        pub contact_diameter_mm: f64,
        /// face width that a helical gear needs for the measurement
        pub least_face_width_mm: f64,
    }
}

described::described! {
    /// Dimension over two balls.
    #[derive(Debug, Clone, Copy, PartialEq, Serialize)]
    pub struct Balls {
        /// diameter of the balls (DIN 3977)
        pub ball_diameter_mm: f64,
        /// dimension over the balls with the tooth thickness allowance
        pub dimension_mm: f64,
        /// dimension over the balls without allowance
        pub nominal_dimension_mm: f64,
    }
}

described::described! {
    /// A point of the path of contact.
    #[derive(Debug, Clone, Copy, PartialEq, Serialize)]
    pub struct PathPoint {
        /// `A`, `B`, `C`, `D` or `E`
        pub name: char,
        /// distance from the point where the path touches the pinion's base circle
        pub path_coordinate_mm: f64,
        /// distance from A
        pub from_start_mm: f64,
        /// radius of curvature of the pinion's flank, transverse section
        pub pinion_curvature_radius_mm: f64,
        /// radius of curvature of the wheel's flank, transverse section
        pub wheel_curvature_radius_mm: f64,
        /// diameter on the pinion
        pub pinion_diameter_mm: f64,
        /// diameter on the wheel
        pub wheel_diameter_mm: f64,
        /// sliding speed over rolling speed of the pinion's flank
        pub pinion_specific_sliding: f64,
        /// sliding speed over rolling speed of the wheel's flank
        pub wheel_specific_sliding: f64,
        /// sliding speed for one revolution of the pinion per minute
        pub sliding_speed_mm_s_per_rpm: f64,
        /// rolling speed of the pinion's flank for one revolution of the pinion per minute
        pub pinion_rolling_speed_mm_s_per_rpm: f64,
        /// rolling speed of the wheel's flank for one revolution of the pinion per minute
        pub wheel_rolling_speed_mm_s_per_rpm: f64,
    }
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
            ring: self.ring_sheet(),
            points,
        }
    }

    /// Quantities that a drawing of a ring needs in addition; `None` for external pairs.
    pub fn ring_sheet(&self) -> Option<RingSheet> {
        let (ring, cutter) = (&self.wheel, self.wheel.profile().cutter()?);
        let degrees = |margin: f64| margin.is_finite().then(|| margin.to_degrees());
        let tangents = self.tangent_length();
        let touched = tangents - ring.base_radius() * ring.profile().roll_tip();
        let [_, end] = self.path_of_contact();
        Some(RingSheet {
            centre_distance_magnitude_mm: self.centre_distance().abs(),
            reference_diameter_magnitude_mm: 2.0 * ring.reference_radius().abs(),
            base_diameter_magnitude_mm: 2.0 * ring.base_radius().abs(),
            tip_diameter_magnitude_mm: 2.0 * ring.tip_radius().abs(),
            root_diameter_magnitude_mm: 2.0 * ring.root_radius().abs(),
            root_form_diameter_magnitude_mm: 2.0 * ring.form_radius().abs(),
            start_of_active_profile_diameter_magnitude_mm: 2.0 * ring.base_radius().hypot(tangents - end),
            involute_margin_mm: touched - self.pinion.base_radius() * self.pinion.profile().roll_form(),
            trochoid_margin_deg: self.trochoid_margin().and_then(degrees),
            trimming_margin_deg: self.trimming_margin()?.to_degrees(),
            shaper_teeth: cutter.teeth(),
            shaper_profile_shift: ring.data().shaper?.profile_shift,
            shaper_tip_diameter_mm: cutter.tip_diameter(),
            shaper_tip_rounding_mm: ring.data().root_radius_coefficient * ring.data().normal_module,
            shaper_centre_distance_mm: cutter.distance(),
            shaper_working_pressure_angle_deg: cutter.pressure_angle().to_degrees(),
            shaper_trimming_margin_deg: cutter.mesh(ring.tip_radius().abs()).trimming_margin().to_degrees(),
        })
    }

    /// ```text
    /// zeta_1 = 1 - (z_1 / z_2) rho_2 / rho_1,   v_g = (omega_1 + omega_2) |xi - xi_C|
    /// ```
    fn path_point(&self, name: char, xi: f64, start: f64) -> PathPoint {
        let other = self.tangent_length() - xi;
        let diameter = |gear: &Gear, xi: f64| gear.sign() * 2.0 * gear.base_radius().hypot(xi);
        let ratio = self.pinion.signed_teeth() / self.wheel.signed_teeth();
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
    let diameter = |xi: f64| gear.sign() * 2.0 * base.hypot(xi);
    let roll = |xi: f64| (xi / base).to_degrees();
    let thickness = |radius: f64| {
        let u = roll_angle(radius, base).unwrap_or(0.0);
        // The helix angle grows with the radius.
        let helix = (data.helix_angle.tan() * radius / gear.reference_radius()).atan();
        2.0 * radius * profile.half_angle(u) * helix.cos()
    };
    GearSheet {
        teeth: gear.signed_teeth() as i64,
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
    if gear.is_internal() {
        return None;
    }
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
/// For a ring r_b and z are negative, and so is M_dK, the dimension between the balls.
fn balls(gear: &Gear) -> Option<Balls> {
    let (data, base, beta_b) = (gear.data(), gear.base_radius(), gear.base_helix_angle());
    let z = gear.signed_teeth();
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
        let touched = gear.sign() * base.hypot(base * angle.tan() - 0.5 * ball * beta_b.cos());
        let stands_out = dimension_mm > 2.0 * gear.tip_radius();
        let on_flank = touched > gear.form_radius() && touched < gear.tip_radius();
        let off = (touched - gauge_radius(gear)).abs();
        (stands_out && on_flank).then_some((Balls { ball_diameter_mm: ball, dimension_mm, nominal_dimension_mm }, off))
    };
    BALLS.into_iter().filter_map(of).min_by(|a, b| a.1.total_cmp(&b.1)).map(|(balls, _)| balls)
}
