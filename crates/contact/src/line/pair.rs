//! The contact line of a pair: where it touches, its pressure, and whether a pair outside the window would touch.

use ale::{Station, ToothWindow};
use geometry::{GearPair, ModifiedFlank};

use crate::{
    ContactOptions, ContactSet, FlankPair, Pose,
    flank::{ContactPoint, FlankPatch},
    line::{LineStation, contact_intervals, covered, hertz, loaded_intervals},
    nodal::{ContactRow, LinePoints, contact_row, least_gap},
    opening,
    slice::SliceHint,
};

/// Axial stations at which the least gap of a pair is looked at.
const LINE_SAMPLES: usize = 97;
/// A station is in contact when its flanks are nearer than this share of the approach: between points that touch, the
/// interpolated deflection of the faces leaves gaps up to about a tenth of it open. Beyond the ends of the path the gap
/// rises by as much within a few hundredths of a millimetre.
const TOUCHING: f64 = 0.15;
/// Width of the axial bins for the line load behind the Hertzian pressure, in face elements: points press one by one,
/// and only over more than an element do their forces add up to a line load.
const BIN_ELEMENTS: f64 = 1.5;

/// Largest Hertzian pressure along the contact line of a pair, MPa, from the line load in axial bins.
///
/// The forces of single points are not unique if there are more points than nodes, but their sums on the nodes are
/// unique. Each node's force is distributed over one element of face width around it, and bins of `BIN_ELEMENTS`
/// elements take their share.
pub fn line_pressure(
    pair: &GearPair,
    patch: &FlankPatch,
    loaded: &[(&ContactRow, f64)],
    line: &[[f64; 2]],
    modulus: f64,
) -> f64 {
    let along = 1.0 / pair.base_helix_angle().cos();
    let [low, high] = pair.common_face();
    let element = patch.mean_face_size()[1];
    let bins = (pair.face_width() / (BIN_ELEMENTS * element)).floor().clamp(1.0, 64.0) as usize;
    let width = pair.face_width() / bins as f64;
    let mut load = vec![0.0; bins];
    let mut path = vec![0.0; bins];
    for (row, f) in loaded {
        let support = &row.supports[0];
        for (&node, w) in support.nodes[..support.count].iter().zip(support.weights) {
            let Some([_, z]) = patch.node_coordinates(node) else { continue };
            // A node beyond the common face holds up the last faces that reach into it.
            let z = z.clamp(low, high);
            let (from, to) = ((z - 0.5 * element).max(low), (z + 0.5 * element).min(high));
            for b in 0..bins {
                let bin = [low + b as f64 * width, low + (b + 1) as f64 * width];
                let share = f * w * covered(&[bin], [from, to]) / (to - from);
                load[b] += share;
                path[b] += share * row.coordinates[0] * pair.pinion.base_radius();
            }
        }
    }
    (0..bins)
        .map(|b| {
            let bin = [low + b as f64 * width, low + (b + 1) as f64 * width];
            // A bin that the line leaves carries its load on part of its length.
            let length = along * covered(line, bin).max(0.5 * width);
            let radius = if load[b] > 0.0 { relative_radius(pair, path[b] / load[b]) } else { return 0.0 };
            hertz::line_pressure(load[b] / length, radius, modulus)
        })
        .fold(0.0, f64::max)
}

/// rho_n = rho_1 rho_2 / ((rho_1 + rho_2) cos b_b), rho_2 of a ring negative, at path coordinate xi = rho_1, mm.
fn relative_radius(pair: &GearPair, xi: f64) -> f64 {
    let length = pair.tangent_length();
    let rho = if pair.is_internal() { xi.max(-1e-3 * length) } else { xi.clamp(1e-3 * length, 0.999 * length) };
    rho * (length - rho) / (length * pair.base_helix_angle().cos())
}

/// Axial intervals over which a pair of patches is in contact, from the deformed gap at the points where the undeformed
/// flanks at the loaded pose are nearest. `displacements` are those of both gears' boundary coordinates, mm; `approach`
/// is that of the flanks under load, mm; `face` is the common face, mm.
pub fn nodal_contact_line(
    set: &ContactSet,
    options: &ContactOptions,
    poses: &[Pose; 2],
    displacements: &[Vec<f64>; 2],
    (first, second): (usize, usize),
    (face, approach): ([f64; 2], f64),
) -> Vec<[f64; 2]> {
    let [patch, other] = [&set.patches()[0][first], &set.patches()[1][second]];
    let [low, high] = patch.range();
    let line = LinePoints::new();
    let Some(scene) = set.scene(options, &line) else { return Vec::new() };
    let gap = |z: f64| -> Option<f64> {
        let coordinates = least_gap(patch, other, poses, z)?;
        let at = patch.face_at(coordinates)?;
        let point = ContactPoint { at, coordinates, position: patch.surface().point(coordinates), area: 0.0 };
        let row = contact_row(&scene, poses, (first, second), usize::MAX, &point)?;
        let [u1, u2] = displacements;
        Some(row.gap + opening(&row.supports[0], u1) + opening(&row.supports[1], u2))
    };
    let inset = 1e-6 * (high[1] - low[1]);
    let range = [(low[1] + inset).max(face[0]), (high[1] - inset).min(face[1])];
    contact_intervals(|z| gap(z).unwrap_or(f64::INFINITY), range, LINE_SAMPLES, TOUCHING * approach)
}

/// Axial intervals over which a pair of patches is in contact, from slices. `opened` is the part of a row's gap under
/// load that is not that of the undeformed flanks ([`LineStation`]), together with the row's roll angle on body 1.
/// `displacements` are those of both gears' boundary coordinates, mm; they are requested where no row is near.
pub fn slice_line(
    set: &ContactSet,
    poses: &[Pose; 2],
    pair: (usize, usize),
    rows: impl Iterator<Item = (usize, LineStation, f64)>,
    face: [f64; 2],
    displacements: impl FnOnce() -> [Vec<f64>; 2],
) -> Vec<[f64; 2]> {
    let Some(slices) = set.slices() else { return Vec::new() };
    let flanks = FlankPair::new(slices.flanks([&set.patches()[0], &set.patches()[1]], pair), poses);
    let stations = slices.stations();
    // A station too far from contact to be a row is not known.
    let mut solved = vec![None; stations.len()];
    let mut hints = vec![SliceHint::default(); stations.len()];
    for (point, station, roll) in rows {
        (solved[point], hints[point]) = (Some(station), SliceHint::near(roll));
    }
    let gap = |near: usize, z: f64| {
        let found = flanks.nearest_point(z, &mut hints[near]);
        let touches = found.filter(|f| slices.has_corner_contact() || !flanks.is_off_line(f));
        touches.map_or(f64::INFINITY, |f| flanks.gap(&f))
    };
    let mut asked = Some(displacements);
    let mut known = [Vec::new(), Vec::new()];
    let unsolved = |_: usize, z: f64| {
        if let Some(displacements) = asked.take() {
            known = displacements();
        }
        let mut hint = SliceHint::default();
        let row = flanks.nearest_point(z, &mut hint).and_then(|near| {
            let (mut row, slice) = flanks.slice(&near, pair, 0, 0.0)?;
            flanks.support(&mut row, &slice, &mut hint).then_some(row)
        });
        let of = |row: ContactRow| {
            (0..2).filter(|i| !known[*i].is_empty()).map(|i| opening(&row.supports[i], &known[i])).sum()
        };
        row.map_or(0.0, of)
    };
    loaded_intervals(stations, &solved, face, gap, unsolved)
}

/// State of a station whose row has the undeformed gap `gap` (mm) and the total opening `opening`. `opening` includes
/// the local approach `approach` (mm), which the row's force causes; 0 without a force. `other` is any further opening,
/// mm.
pub fn line_station(gap: f64, opening: f64, approach: f64, other: f64) -> LineStation {
    if approach > 0.0 {
        LineStation { gap: -approach, opened: opening + other - approach }
    } else {
        LineStation { gap: (gap + opening).max(0.0), opened: opening + other }
    }
}

/// A window at given poses, to check the pairs next to it.
#[derive(Debug, Clone, Copy)]
pub struct NeighbourPairs<'a> {
    /// The gear pair.
    pub pair: &'a GearPair,
    /// Options with flanks and offsets.
    pub options: &'a ContactOptions,
    /// Flanks of the window.
    pub set: &'a ContactSet,
    /// The pairs in the window.
    pub window: &'a ToothWindow,
    /// Station of the pair in the mesh cycle.
    pub station: Station,
    /// Poses of the frames of both gears' matrices.
    pub poses: &'a [Pose; 2],
}

impl NeighbourPairs<'_> {
    /// Smallest undeformed gap of the two pairs next to the window, mm.
    pub fn least_gap(&self) -> f64 {
        self.window.neighbours().into_iter().map(|running| self.gap(running)).fold(f64::INFINITY, f64::min)
    }

    /// Smallest gap of a pair outside the window, mm, for undeformed smooth flanks at the loaded pose.
    pub fn gap(&self, running: i64) -> f64 {
        outside_gap(self, running)
    }
}

/// Least gap (mm) at the loaded pose of a pair that the window does not hold, undeformed smooth flanks.
fn outside_gap(neighbours: &NeighbourPairs<'_>, running: i64) -> f64 {
    let NeighbourPairs { pair, options, set, window, station, poses } = *neighbours;
    let side = options.side();
    let [f1, f2] = set.first_teeth();
    let last = window.first() + window.count() as i64 - 1;
    // Places count in the matrices' frames, which the poses belong to; pitch errors belong to the gears' own teeth.
    let flank1 = pair.pinion.modified_flank_at(side, i64::from(f1) + running - window.first(), running);
    let flank2 = pair.wheel.modified_flank_at(side, i64::from(f2) + last - running, -running);
    rigid_gap(pair, options, station, running, [&flank1, &flank2], poses)
}

/// Smallest gap (mm) over the common face of the pair with a running number, for undeformed smooth `flanks` of pinion
/// and wheel at `poses`; infinite if they do not face each other.
pub fn rigid_gap(
    pair: &GearPair,
    options: &ContactOptions,
    station: Station,
    running: i64,
    [flank1, flank2]: [&ModifiedFlank; 2],
    poses: &[Pose; 2],
) -> f64 {
    let base_radius = pair.pinion.base_radius();
    let [start, end] = pair.path_of_contact();
    let theta1 = station.pinion_angle(pair, options.side(), options.sense);
    let tooth = running - station.middle_pair(options.sense);
    let (half, [middle, _]) = (0.5 * pair.face_width(), pair.common_middle());
    let [w_low, w_high] = flank2.nominal().roll_range();
    let relative = poses[1].inverse() * poses[0];
    let (turn, shift) = (relative.rotation.to_rotation_matrix(), relative.translation.vector);
    // The path coordinate is linear in the height.
    let [path, beside] = [0.0, 1.0].map(|z| pair.path_coordinate(options.side(), theta1, tooth, z));
    (0..=32)
        .map(|i| {
            let z = middle + half * (f64::from(i) / 16.0 - 1.0);
            let u = (path + (beside - path) * z).clamp(start, end) / base_radius;
            match flank2.locate(&(turn * flank1.point(u, z) + shift)) {
                Some(foot) if foot.roll >= w_low - 1e-6 && foot.roll <= w_high + 1e-6 => foot.distance,
                _ => f64::INFINITY,
            }
        })
        .fold(f64::INFINITY, f64::min)
}
