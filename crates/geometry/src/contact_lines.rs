//! Contact lines in the plane of action. Theory (10).

use crate::{GearPair, Side};

/// Contact line of one tooth pair, unloaded.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactLine {
    /// Pinion tooth number, not wrapped to 0..z.
    pub tooth: i64,
    /// Axial range [z_0, z_1], measured from the pinion's mid-face, mm.
    pub z: [f64; 2],
    /// Length along the line, mm.
    pub length: f64,
}

/// Path of contact by face width.
#[derive(Debug, Clone, Copy)]
struct PlaneOfAction {
    /// xi_A and xi_E, mm.
    path: [f64; 2],
    /// Heights of the ends of the common face, mm.
    face: [f64; 2],
    /// s tan b_b, and cos b_b.
    slope: f64,
    cos: f64,
}

impl PlaneOfAction {
    fn of(pair: &GearPair, side: Side) -> Self {
        let helix = pair.base_helix_angle();
        let (slope, cos) = (side.sign() * helix.tan(), helix.cos());
        Self { path: pair.path_of_contact(), face: pair.common_face(), slope, cos }
    }

    /// The line that has the path coordinate `middle` (mm) at the pinion's mid-face, if any of it is in contact.
    fn contact_line(&self, middle: f64, tooth: i64) -> Option<ContactLine> {
        let Self { path: [start, end], face: [low, high], slope, cos } = *self;
        let (z0, z1) = if slope == 0.0 {
            if middle < start || middle > end {
                return None;
            }
            (low, high)
        } else {
            let (a, b) = ((start - middle) / slope, (end - middle) / slope);
            (a.min(b).max(low), a.max(b).min(high))
        };
        (z1 > z0).then(|| ContactLine { tooth, z: [z0, z1], length: (z1 - z0) / cos })
    }
}

impl GearPair {
    /// Contact line of pinion tooth `tooth` at pinion angle `pinion_angle` (rad), if it is in contact.
    ///
    /// In the plane of action (path of contact by face width) the line is straight and inclined by b_b. It is clipped
    /// by the rectangle xi_A <= xi(z) <= xi_E, z within the common face.
    pub fn contact_line(&self, side: Side, pinion_angle: f64, tooth: i64) -> Option<ContactLine> {
        PlaneOfAction::of(self, side).contact_line(self.path_coordinate(side, pinion_angle, tooth, 0.0), tooth)
    }

    /// Sliding of the flanks on each other per radian of the pinion's rotation, averaged over a contact line, mm.
    ///
    /// ```text
    /// v_g / omega_1 = (1 + z_1 / z_2) |xi - xi_C|
    /// ```
    /// xi varies linearly along the line; the line may cross the pitch point.
    pub fn mean_sliding(&self, side: Side, pinion_angle: f64, line: &ContactLine) -> f64 {
        let pitch_point = self.pinion.base_radius() * self.working_pressure_angle().tan();
        let along = self.path_coordinates(side, pinion_angle);
        let [a, b] = line.z.map(|z| along(line.tooth, z) - pitch_point);
        let ratio = self.pinion.signed_teeth() / self.wheel.signed_teeth();
        let sum = a.abs() + b.abs();
        let mean = if a * b >= 0.0 { 0.5 * sum } else { 0.5 * (a * a + b * b) / sum };
        (1.0 + ratio) * mean
    }

    /// All contact lines at pinion angle `pinion_angle` (rad), ascending by tooth.
    pub fn contact_lines(&self, side: Side, pinion_angle: f64) -> Vec<ContactLine> {
        let plane = PlaneOfAction::of(self, side);
        let pitch = self.transverse_base_pitch();
        let [start, end] = plane.path;
        let along = self.path_coordinates(side, pinion_angle);
        let at_zero = along(0, self.common_middle()[0]);
        let reach = 0.5 * self.face_width() * plane.slope.abs();
        // xi(tooth) = at_zero + s tooth p_bt: every tooth whose line can reach the rectangle.
        let (low, high) = ((start - reach - at_zero) / pitch, (end + reach - at_zero) / pitch);
        let (low, high) = if side == Side::Left { (low, high) } else { (-high, -low) };
        (low.floor() as i64..=high.ceil() as i64).filter_map(|k| plane.contact_line(along(k, 0.0), k)).collect()
    }

    /// Total length of the contact lines, mm.
    pub fn contact_line_length(&self, side: Side, pinion_angle: f64) -> f64 {
        self.contact_lines(side, pinion_angle).iter().map(|line| line.length).sum()
    }

    /// Mean of the total contact-line length over a mesh cycle, eps_alpha b / cos(b_b), mm.
    pub fn mean_contact_line_length(&self) -> f64 {
        self.transverse_contact_ratio() * self.face_width() / self.base_helix_angle().cos()
    }
}
