//! The half tooth as an elastic layer with ends: its layer constant at every position on the flank.

use std::f64::consts::{FRAC_PI_2, PI};

use geometry::Gear;

use crate::{
    ReductionError,
    plane_strain::{PlaneBody, Vec2},
};

/// Layer constant c of a half tooth under a line load, along the profile.
///
/// If everything except the half between the loaded flank and the tooth's centre surface is clamped, a Hertzian line
/// load q of half-width a indents the flank by
///
/// ```text
/// delta = K q [ln(2 t / a) + 1/2 + c(u) + eta ln(t / d)],   K = 2 (1 - nu^2) / (pi E)
/// t = (r sin(psi) + o) cos(b_b),   d = r_b (u_a^2 - u^2) / 2
/// ```
/// This holds while a is small compared with t and d. The last term is that of the wedge at the tip (eta of its angle,
/// `contact::local::wedge_softening`). It is separated because it has no limit at the edge, while c is smooth up to the
/// edge. A bonded layer of constant depth without ends has one constant everywhere (`contact::local::layer_constant`).
/// The constant of a tooth differs from it by 0.1 to 0.8, most at the root.
///
/// c is computed by plane strain on the section normal to the contact line (some hundred quadratic elements, a few
/// milliseconds). The half-plane's response to a point force is subtracted, so that the elements need to resolve only a
/// smooth field and c does not depend on them (0.01).
#[derive(Debug, Clone, PartialEq)]
pub struct LayerProfile {
    /// Arc lengths from the tip edge, mm, ascending from 0.
    arcs: Vec<f64>,
    constants: Vec<f64>,
    slopes: Vec<f64>,
    roll_tip: f64,
    base_radius: f64,
    tip_angle: f64,
    tip_gradient: f64,
}

/// First element at the tip edge, normal modules.
const FIRST: f64 = 0.004;
/// Growth from one element to the next away from the edge.
const GROWTH: f64 = 1.5;
/// Largest element along the flank, relative to its length.
const LARGEST: f64 = 0.09;
/// Elements along the fillet.
const FILLET: usize = 6;
/// Largest element through the depth, relative to it.
const LARGEST_DEEP: f64 = 0.22;
/// Where on the fillet the foot is clamped: its very end runs along the root circle, 0.02 rack tip radii above it.
const FOOT: f64 = 0.15;
/// Half elements next to the edge that are too near to it for their size.
const SKIPPED: usize = 4;

impl LayerProfile {
    /// The layer constant of a gear's flank, clamped `overshoot` (mm) beyond the tooth's centre surface.
    ///
    /// # Errors
    /// [`ReductionError::Fem`].
    ///
    /// # Example
    /// A layer without ends has -0.527. In the middle of a real flank c is 0.1 softer; near the root, next to the
    /// clamped region, it is stiffer.
    /// ```
    /// let gear = geometry::Gear::new(geometry::GearData::default())?;
    /// let profile = reduction::LayerProfile::new(&gear, 0.3, 0.0)?;
    /// let (tip, foot) = (gear.profile().roll_tip(), gear.profile().roll_form());
    /// assert!(profile.constant(foot) < profile.constant(0.5 * (tip + foot)));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn new(gear: &Gear, poisson: f64, overshoot: f64) -> Result<Self, ReductionError> {
        let section = Section::new(gear, overshoot.max(0.0));
        let body = section.body(poisson)?;
        let tip_angle = section.tip_angle(gear);
        let eta = softening(tip_angle);
        let flank = SKIPPED..section.flank.len();
        let stations: Vec<(usize, Vec2)> =
            flank.clone().map(|i| (section.node(i, 0), section.inward(gear, section.flank[i].roll))).collect();
        let dents = body.regular_dents(&stations)?;
        let (mut arcs, mut constants) = (vec![0.0], vec![0.0]);
        for (i, dent) in flank.zip(dents) {
            let Station { arc, depth, .. } = section.flank[i];
            arcs.push(arc);
            constants.push(dent - depth.ln() - eta * (depth / arc).ln());
        }
        // c is smooth at the edge: a straight line through the nearest stations ends there.
        let part = arcs[1] / (arcs[2] - arcs[1]);
        constants[0] = constants[1] - part * (constants[2] - constants[1]);
        let slopes = slopes(&arcs, &constants);
        let [edge, next] = [&section.flank[0], &section.flank[1]];
        let tip_gradient = slopes[0] + (1.0 + eta) * (next.depth / edge.depth).ln() / next.arc;
        let roll_tip = gear.profile().roll_tip();
        Ok(Self { arcs, constants, slopes, roll_tip, base_radius: gear.base_radius(), tip_angle, tip_gradient })
    }

    /// c at a roll angle, with continuous slope. Beyond either end of the flank it is the value at that end.
    pub fn constant(&self, roll: f64) -> f64 {
        let last = self.arcs.len() - 1;
        let arc = (0.5 * self.base_radius * (self.roll_tip * self.roll_tip - roll * roll)).clamp(0.0, self.arcs[last]);
        let i = self.arcs.partition_point(|&s| s <= arc).clamp(1, last) - 1;
        let h = self.arcs[i + 1] - self.arcs[i];
        let t = (arc - self.arcs[i]) / h;
        let (a, b) = (self.constants[i], self.constants[i + 1]);
        let (da, db) = (h * self.slopes[i], h * self.slopes[i + 1]);
        a + t * (da + t * (3.0 * (b - a) - 2.0 * da - db + t * (2.0 * (a - b) + da + db)))
    }

    /// Lists of the profile (arcs, constants, slopes) and its single values, for a file.
    pub(crate) fn parts(&self) -> ([&[f64]; 3], [f64; 4]) {
        let values = [self.roll_tip, self.base_radius, self.tip_angle, self.tip_gradient];
        ([&self.arcs, &self.constants, &self.slopes], values)
    }

    /// From its parts; `None` when they are none of a profile.
    pub(crate) fn from_parts([arcs, constants, slopes]: [Vec<f64>; 3], values: [f64; 4]) -> Option<Self> {
        let same = arcs.len() >= 2 && constants.len() == arcs.len() && slopes.len() == arcs.len();
        let [roll_tip, base_radius, tip_angle, tip_gradient] = values;
        same.then_some(Self { arcs, constants, slopes, roll_tip, base_radius, tip_angle, tip_gradient })
    }

    /// d/dx [c + (1 + eta) ln t] at the tip edge, 1/mm, where x is the distance from the edge.
    pub fn tip_gradient(&self) -> f64 {
        self.tip_gradient
    }

    /// Angle between flank and tip land in the section normal to the contact line, rad.
    pub fn tip_angle(&self) -> f64 {
        self.tip_angle
    }
}

/// eta of `contact::local::wedge_softening`, which depends on this crate.
fn softening(omega: f64) -> f64 {
    let (sin2, cos2) = ((0.5 * omega).sin().powi(2), (0.5 * omega).cos().powi(2));
    (PI * (sin2 / (omega + omega.sin()) + cos2 / (omega - omega.sin())) - 1.0).max(0.0)
}

/// Slopes at the nodes of a curve: of the parabola through each node and its neighbours.
fn slopes(x: &[f64], y: &[f64]) -> Vec<f64> {
    let last = x.len() - 1;
    let chord = |i: usize| (y[i + 1] - y[i]) / (x[i + 1] - x[i]);
    let inner = |i: usize| {
        let (before, after) = (x[i] - x[i - 1], x[i + 1] - x[i]);
        (after * chord(i - 1) + before * chord(i)) / (before + after)
    };
    (0..=last)
        .map(|i| match i {
            0 => 2.0 * chord(0) - inner(1),
            i if i == last => 2.0 * chord(last - 1) - inner(last - 1),
            i => inner(i),
        })
        .collect()
}

/// A place of the flank.
struct Station {
    roll: f64,
    /// From the tip edge, mm.
    arc: f64,
    /// t, mm.
    depth: f64,
}

/// The half tooth's section as a lattice: rows at constant radius from tip to foot, columns from the flank to the
/// clamped surface.
///
/// In the section normal to the contact line the profile keeps its length and all lengths across the tooth shrink by
/// cos(b_b).
struct Section {
    /// Radius (mm) and half tooth angle (rad) of every row, half elements.
    rows: Vec<[f64; 2]>,
    /// 0 on the flank, 1 on the clamped surface, half elements.
    columns: Vec<f64>,
    /// The rows that are on the flank.
    flank: Vec<Station>,
    overshoot: f64,
    cos_base_helix: f64,
}

impl Section {
    fn new(gear: &Gear, overshoot: f64) -> Self {
        let profile = gear.profile();
        let (tip, form, base) = (profile.roll_tip(), profile.roll_form(), gear.base_radius());
        let cos_base_helix = gear.base_helix_angle().cos();
        let length = 0.5 * base * (tip * tip - form * form);
        let first = FIRST * gear.data().normal_module;
        let flank: Vec<Station> = graded(first / length, LARGEST)
            .into_iter()
            .map(|part| {
                let arc = part * length;
                let square = tip * tip - 2.0 * arc / base;
                let bound = if form < tip { square.max(form * form) } else { square.min(form * form) };
                let roll = if part >= 1.0 { form } else { bound.sqrt() };
                let across = profile.radius(roll) * profile.half_angle(roll).sin() + overshoot;
                Station { roll, arc, depth: across * cos_base_helix }
            })
            .collect();
        let mut rows: Vec<[f64; 2]> =
            flank.iter().map(|s| [profile.radius(s.roll), profile.half_angle(s.roll)]).collect();
        let foot = |i: usize| {
            let (r, angle) = profile.fillet(1.0 - (1.0 - FOOT) * i as f64 / (2 * FILLET) as f64);
            [r, angle]
        };
        rows.extend((1..=2 * FILLET).map(foot));
        let columns = graded(first / flank[0].depth.max(first), LARGEST_DEEP);
        Self { rows, columns, flank, overshoot, cos_base_helix }
    }

    /// Number of a lattice point that carries a node: rows with all columns and rows with every other one take turns.
    fn node(&self, row: usize, column: usize) -> usize {
        let whole = self.columns.len();
        let pair = whole + whole.div_ceil(2);
        row / 2 * pair + if row.is_multiple_of(2) { column } else { whole + column / 2 }
    }

    fn point(&self, row: usize, column: usize) -> Vec2 {
        let [r, outer] = self.rows[row];
        let inner = -(self.overshoot / r).clamp(-1.0, 1.0).asin();
        let angle = outer + (inner - outer) * self.columns[column];
        [r * angle.cos(), r * angle.sin() * self.cos_base_helix]
    }

    fn body(&self, poisson: f64) -> Result<PlaneBody, ReductionError> {
        let (last_row, last_column) = (self.rows.len() - 1, self.columns.len() - 1);
        let (mut points, mut clamped) = (Vec::new(), Vec::new());
        for row in 0..=last_row {
            for column in (0..=last_column).step_by(1 + row % 2) {
                points.push(self.point(row, column));
                clamped.push(row == last_row || column == last_column);
            }
        }
        // Rows run towards the axis (-x), columns away from the flank (-y): columns first is counter-clockwise.
        let mut elements = Vec::new();
        for row in (0..last_row).step_by(2) {
            for column in (0..last_column).step_by(2) {
                let offsets = [[0, 0], [2, 0], [2, 2], [0, 2], [1, 0], [2, 1], [1, 2], [0, 1]];
                elements.push(offsets.map(|[down, across]| self.node(row + down, column + across)));
            }
        }
        // Material on the left: down the flank, and along the tip land towards the flank.
        let side = (0..last_row).step_by(2).map(|i| [0, 1, 2].map(|k| self.node(i + k, 0)));
        let top = (0..last_column).step_by(2).map(|j| [2, 1, 0].map(|k| self.node(0, j + k)));
        let free_edges = side.chain(top).collect();
        Ok(PlaneBody::new(points, &elements, &clamped, free_edges, poisson)?)
    }

    /// Direction of the profile towards the tip; of length 1 up to the shrinking.
    ///
    /// The profile leaves the radial direction by the pressure angle, towards the centre line: tan = u.
    fn tangent(&self, gear: &Gear, roll: f64) -> Vec2 {
        let angle = gear.profile().half_angle(roll) - roll.atan();
        [angle.cos(), angle.sin() * self.cos_base_helix]
    }

    fn inward(&self, gear: &Gear, roll: f64) -> Vec2 {
        let [x, y] = self.tangent(gear, roll);
        let length = x.hypot(y);
        [y / length, -x / length]
    }

    fn tip_angle(&self, gear: &Gear) -> f64 {
        let roll = gear.profile().roll_tip();
        let half = gear.profile().half_angle(roll);
        let [x, y] = self.tangent(gear, roll);
        // Into the material: down the flank, and along the land towards the centre line.
        let land = [half.sin(), -half.cos() * self.cos_base_helix];
        let cos = -(x * land[0] + y * land[1]) / (x.hypot(y) * land[0].hypot(land[1]));
        cos.clamp(-1.0, 1.0).acos().max(FRAC_PI_2 - 0.5)
    }
}

/// 0..=1 in elements that grow from `first` by [`GROWTH`] up to `largest`, with their middles.
fn graded(first: f64, largest: f64) -> Vec<f64> {
    let (mut ends, mut step) = (vec![0.0], first.min(largest));
    let mut last = 0.0;
    while last < 1.0 {
        last += step;
        ends.push(last);
        step = (step * GROWTH).min(largest);
    }
    ends.iter_mut().for_each(|x| *x /= last);
    let middles = ends.windows(2).flat_map(|w| [w[0], 0.5 * (w[0] + w[1])]);
    middles.chain([1.0]).collect()
}
