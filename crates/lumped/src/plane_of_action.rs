//! Contact lines in the plane of action, and what load spread evenly along them amounts to.

use geometry::{Driver, GearPair};
use serde::{Deserialize, Serialize};

use crate::{
    LumpedError, MeshFrame,
    error::{finite, not_negative, positive},
};

/// The rectangle in which the flanks of a pair touch, seen from the driver.
///
/// ```text
/// xi_j(z) = xi_M + (c + j) p_bt + sgn tan(b_b) z,   j = ..., -1, 0, 1, ...     clipped to xi_A <= xi <= xi_E, |z| <= b/2
/// ```
/// xi (mm) runs along the transverse line of action from the driver's tangent point to the driven gear's, in which
/// direction contact moves; c are mesh cycles (pair 0 is in the middle xi_M of the path at mid-face at c = 0); flanks
/// slide one way before the pitch point and the other way after it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct PlaneOfAction {
    /// Path of contact [xi_A, xi_E], mm.
    pub path: [f64; 2],
    /// Pitch point xi_C, mm.
    pub pitch_point: f64,
    /// Distance of the tangent points, a sin(a_wt), mm.
    pub tangent_length: f64,
    /// Face width b, mm.
    pub face_width: f64,
    /// sgn b_b of [`MeshFrame::local_helix`], rad.
    pub helix: f64,
    /// Transverse base pitch p_bt, mm.
    pub base_pitch: f64,
    /// How friction's split weighs the lines.
    #[serde(default)]
    pub sharing: LineSharing,
}

/// More lines at once than any gear has.
const MOST_LINES: f64 = 2e4;

/// How load is shared between the lines where friction is concerned.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum LineSharing {
    /// Evenly over the length of all lines, as the mesh stiffness is. Friction before the pitch line and after it
    /// cancels almost wholly where a contact ratio is close to an integer: for seed 003 (eps_alpha 2.00) what is left
    /// is 0.2 % of mu F.
    #[default]
    ByLength,
    /// Evenly between the lines, and evenly within each, however short it is: seed 003's sum over single lines. It
    /// steps whenever a line comes or goes.
    ByLine,
}

/// Means over all contact lines at one phase, for load spread evenly over their length (`split` with
/// [`LineSharing::ByLine`]: over the lines).
///
/// ```text
/// s = sign(xi - xi_C),   w = -(sgn xi sin(b_b) + z cos(b_b)),   v = w - mean(w)
/// ```
/// w (mm) is the place along a line and the lever of the normal force about the direction across the plane of action.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct LineMeans {
    /// L, mm: sum of the lengths.
    pub length: f64,
    /// Longest single line, mm.
    pub longest: f64,
    /// mean(xi), mean(z): centre of the load, mm.
    pub centre: [f64; 2],
    /// mean(v^2), mm^2: the tilt stiffness over the mesh stiffness.
    pub spread: f64,
    /// mean(s), mean(s xi), mean(s z): friction force and its levers (1, mm, mm) over mu F. The first is lambda_1 -
    /// lambda_2 of seed 003 and L_F of seed 004.
    pub split: [f64; 3],
    /// mean(s v), mean(s v xi), mean(s v z) (mm, mm^2, mm^2): the same for a load that grows along the lines.
    pub tilt_split: [f64; 3],
}

impl PlaneOfAction {
    /// Plane of action of a pair; `frame` holds which gear drives and in which sense.
    pub fn of_pair(pair: &GearPair, driver: Driver, frame: &MeshFrame) -> Self {
        let length = pair.tangent_length();
        let [start, end] = pair.path_of_contact();
        let (path, base) = match driver {
            Driver::Pinion => ([start, end], pair.pinion.base_radius()),
            Driver::Wheel => ([length - end, length - start], pair.wheel.base_radius()),
        };
        Self {
            path,
            pitch_point: base * pair.working_pressure_angle().tan(),
            tangent_length: length,
            face_width: pair.face_width(),
            helix: frame.local_helix(),
            base_pitch: pair.transverse_base_pitch(),
            sharing: LineSharing::default(),
        }
    }

    /// Transverse contact ratio eps_alpha.
    pub fn transverse_contact_ratio(&self) -> f64 {
        (self.path[1] - self.path[0]) / self.base_pitch
    }

    /// Overlap ratio eps_beta.
    pub fn overlap_ratio(&self) -> f64 {
        self.face_width * self.helix.tan().abs() / self.base_pitch
    }

    /// Mean of L over a mesh cycle, eps_alpha b / cos(b_b), mm.
    pub fn mean_length(&self) -> f64 {
        self.transverse_contact_ratio() * self.face_width / self.helix.cos()
    }

    /// All means at `cycles` mesh cycles; zero where nothing touches, or where the data are no plane of action.
    pub fn at(&self, cycles: f64) -> LineMeans {
        let mut means = LineMeans::default();
        let (mut first, mut lines) = ([0.0; 2], 0.0);
        self.each_line(cycles, |middle, [z0, z1]| {
            lines += 1.0;
            let length = (z1 - z0) / self.helix.cos();
            let z = 0.5 * (z0 + z1);
            means.length += length;
            means.longest = means.longest.max(length);
            first[0] += length * (middle + self.helix.tan() * z);
            first[1] += length * z;
        });
        if means.length <= 0.0 {
            return LineMeans::default();
        }
        means.centre = first.map(|x| x / means.length);
        let lever = self.lever(means.centre[0], means.centre[1]);
        let mut sums = [0.0; 7];
        self.each_line(cycles, |middle, line| {
            let mut own = [0.0; 7];
            self.add_line(middle, line, lever, &mut own);
            if self.sharing == LineSharing::ByLine {
                // As if every line were of the mean length.
                let weight = means.length / lines * self.helix.cos() / (line[1] - line[0]);
                own[1..4].iter_mut().for_each(|x| *x *= weight);
            }
            sums.iter_mut().zip(own).for_each(|(sum, x)| *sum += x);
        });
        let share = sums.map(|x| x / means.length);
        means.spread = share[0];
        means.split = [share[1], share[2], share[3]];
        means.tilt_split = [share[4], share[5], share[6]];
        means
    }

    /// w.
    fn lever(&self, xi: f64, z: f64) -> f64 {
        -(xi * self.helix.sin() + z * self.helix.cos())
    }

    /// Calls `line` with xi at mid-face and the axial range of every line there is.
    fn each_line(&self, cycles: f64, mut line: impl FnMut(f64, [f64; 2])) {
        let [start, end] = self.path;
        let (half, slope) = (0.5 * self.face_width, self.helix.tan());
        let zero = 0.5 * (start + end) + cycles.rem_euclid(1.0) * self.base_pitch;
        let reach = half * slope.abs();
        let low = ((start - reach - zero) / self.base_pitch).ceil();
        let high = ((end + reach - zero) / self.base_pitch).floor();
        // Plain data that were never checked may hold anything.
        if !(high - low).is_finite() || high - low > MOST_LINES {
            return;
        }
        for j in low as i64..=high as i64 {
            let middle = zero + j as f64 * self.base_pitch;
            let (z0, z1) = if slope == 0.0 {
                (-half, half)
            } else {
                let (a, b) = ((start - middle) / slope, (end - middle) / slope);
                (a.min(b).max(-half), a.max(b).min(half))
            };
            if z1 > z0 {
                line(middle, [z0, z1]);
            }
        }
    }

    /// Adds the integrals of one line, in two parts where it crosses the pitch line. Simpson's rule is exact: nothing
    /// is above second order.
    fn add_line(&self, middle: f64, [z0, z1]: [f64; 2], lever: f64, sums: &mut [f64; 7]) {
        let slope = self.helix.tan();
        let crossing = if slope == 0.0 { z1 } else { ((self.pitch_point - middle) / slope).clamp(z0, z1) };
        for [a, b] in [[z0, crossing], [crossing, z1]] {
            let part = (b - a) / self.helix.cos();
            if part <= 0.0 {
                continue;
            }
            let sign = (middle + slope * 0.5 * (a + b) - self.pitch_point).signum();
            for (z, weight) in [(a, 1.0 / 6.0), (0.5 * (a + b), 4.0 / 6.0), (b, 1.0 / 6.0)] {
                let xi = middle + slope * z;
                let v = self.lever(xi, z) - lever;
                let all = [v * v, sign, sign * xi, sign * z, sign * v, sign * v * xi, sign * v * z];
                for (sum, f) in sums.iter_mut().zip(all) {
                    *sum += weight * part * f;
                }
            }
        }
    }

    pub(crate) fn check(&self) -> Result<(), LumpedError> {
        positive("face width in mm", self.face_width)?;
        positive("transverse base pitch in mm", self.base_pitch)?;
        positive("length of the path of contact in mm", self.path[1] - self.path[0])?;
        not_negative("start of the path of contact in mm", self.path[0])?;
        positive("distance of the tangent points in mm", self.tangent_length)?;
        finite("pitch point in mm", self.pitch_point)?;
        finite("helix in rad", self.helix)?;
        let ratio = self.transverse_contact_ratio() + self.overlap_ratio();
        if (1.0..0.5 * MOST_LINES).contains(&ratio) {
            return Ok(());
        }
        Err(LumpedError::OutOfRange {
            quantity: "total contact ratio",
            value: ratio,
            method: "a lumped model",
            allowed: "1 to 10000",
        })
    }
}
