//! Interference of an external gear inside a ring, other than at the roots.

use serde::Serialize;

use crate::error::InternalInterference;
use crate::involute;

/// An external gear, or a shaper cutter, inside a ring: magnitudes, mm and rad.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub(crate) struct InternalMesh {
    /// Numbers of teeth, of the gear and of the ring.
    pub teeth: [f64; 2],
    /// Base radii.
    pub base: [f64; 2],
    /// Tip radii.
    pub tip: [f64; 2],
    /// Distance of the axes.
    pub distance: f64,
    /// Working transverse pressure angle.
    pub pressure_angle: f64,
}

impl InternalMesh {
    fn tip_involutes(&self) -> [f64; 2] {
        [0, 1].map(|i| involute((self.base[i] / self.tip[i]).min(1.0).acos()))
    }

    /// Path coordinate of the inner gear at which the ring's tip touches, mm. Below zero the ring's tip needs involute
    /// below the inner gear's base circle.
    ///
    /// ```text
    /// |d_b2| tan a_a2 / 2 - |a| sin a_wt >= 0        that is z_1/z_2 >= 1 - tan a_a2 / tan a_wt
    /// ```
    pub fn involute_margin(&self) -> f64 {
        (self.tip[1] * self.tip[1] - self.base[1] * self.base[1]).max(0.0).sqrt()
            - self.distance * self.pressure_angle.sin()
    }

    /// Interference that remains however the gears are assembled: its kind and its negative margin, in mm along the
    /// path of contact or in rad of the ring.
    pub fn fault(&self) -> Option<(InternalInterference, f64)> {
        let (involute, trochoid) = (self.involute_margin(), self.trochoid_margin());
        if involute < 0.0 {
            return Some((InternalInterference::Involute, involute));
        }
        (trochoid < 0.0).then_some((InternalInterference::Trochoid, trochoid))
    }

    /// Angle of the ring (rad) by which the tip corners clear each other after they have left contact. Below zero they
    /// collide (trochoid interference). Infinite where the tip circles do not cross.
    ///
    /// ```text
    /// (z_1/z_2) t_1 + inv a_wt - inv a_a2 - t_2 >= 0
    /// t_1 = acos[(r_a2^2 - r_a1^2 - a^2)/(2 a r_a1)] + inv a_a1 - inv a_wt,   t_2 = acos[(a^2 + r_a2^2 - r_a1^2)/(2 a r_a2)]
    /// ```
    pub fn trochoid_margin(&self) -> f64 {
        let ([z1, z2], [r1, r2], a) = (self.teeth, self.tip, self.distance);
        let cosines = [(r2 * r2 - r1 * r1 - a * a) / (2.0 * a * r1), (a * a + r2 * r2 - r1 * r1) / (2.0 * a * r2)];
        if cosines.iter().any(|c| c.abs() > 1.0) {
            return f64::INFINITY;
        }
        let ([inv1, inv2], inv) = (self.tip_involutes(), involute(self.pressure_angle));
        (cosines[0].acos() + inv1 - inv) * z1 / z2 + inv - inv2 - cosines[1].acos()
    }

    /// Angle of the inner gear (rad) by which its tip corners clear those of the ring during radial assembly. Below
    /// zero the gear can be assembled only axially, and a shaper with radial feed trims the ring's tips.
    ///
    /// ```text
    /// T_1 + inv a_a1 - inv a_wt - (z_2/z_1)(T_2 + inv a_a2 - inv a_wt) >= 0
    /// sin^2 T_1 = [1 - (cos a_a1/cos a_a2)^2]/[1 - (z_1/z_2)^2],   sin^2 T_2 = [(cos a_a2/cos a_a1)^2 - 1]/[(z_2/z_1)^2 - 1]
    /// ```
    pub fn trimming_margin(&self) -> f64 {
        let ratio = self.teeth[1] / self.teeth[0];
        let [cos1, cos2] = [0, 1].map(|i| self.base[i] / self.tip[i]);
        let squares = [
            (1.0 - (cos1 / cos2).powi(2)) / (1.0 - (1.0 / ratio).powi(2)),
            ((cos2 / cos1).powi(2) - 1.0) / (ratio * ratio - 1.0),
        ];
        let [t1, t2] = squares.map(|s| s.clamp(0.0, 1.0).sqrt().asin());
        let ([inv1, inv2], inv) = (self.tip_involutes(), involute(self.pressure_angle));
        t1 + inv1 - inv - ratio * (t2 + inv2 - inv)
    }
}
