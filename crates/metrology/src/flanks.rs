//! From traces to flanks: topographies by tooth, and pitch errors.

use std::collections::BTreeMap;

use geometry::modification::{ProfileAxis, Topography, TopographyGrid};
use geometry::{Gear, Side};
use serde::Serialize;

use crate::MetrologyError;
use crate::measured_gear::{GearHeader, MeasuredGear, Trace, TraceKind};

/// Lines of a grid along the profile and along the face at the most; traces with more values are taken at so many places.
const LINES: [usize; 2] = [481, 121];
/// By how much data of file and gear may differ, parts.
const SAME: f64 = 1e-3;
/// By how much profile shifts may differ.
const SAME_SHIFT: f64 = 0.1;

/// Flanks of a measured gear.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MeasuredFlanks {
    /// Depths of the left and of the right flanks, by tooth; `None` where nothing was measured on that side.
    pub topographies: [Option<Topography>; 2],
    /// Index deviation of each tooth, mm of arc on the reference circle, counter-clockwise positive; empty where none was
    /// measured. With both sides their mean: by what teeth differ in thickness is left out.
    pub pitch_errors: Vec<f64>,
    /// Largest part of a tooth's index deviation that is left out so, mm.
    pub left_out_mm: f64,
    /// Teeth of either side that were measured; all others are copies of the nearest.
    pub measured_teeth: [Vec<u32>; 2],
    /// How many of them have one profile alone, which stands for the whole face.
    pub same_along_face: [usize; 2],
    /// How far the flanks go on beyond the traces, mm: along the profile below and above, along the face below and above.
    pub extrapolated_mm: [f64; 4],
}

/// Whether a header tells of this gear.
pub(crate) fn same_gear(header: &GearHeader, gear: &Gear) -> Result<(), MetrologyError> {
    let data = gear.data();
    let all = [
        ("teeth", f64::from(header.teeth), f64::from(data.teeth)),
        ("normal module [mm]", header.normal_module, data.normal_module),
        ("helix angle [deg]", header.helix_angle.to_degrees(), data.helix_angle.to_degrees()),
        ("pressure angle [deg]", header.pressure_angle.to_degrees(), data.normal_pressure_angle.to_degrees()),
    ];
    let width = header.face_width.map(|b| ("face width [mm]", b, data.face_width));
    let shift = header.profile_shift.map(|x| ("profile shift coefficient", x, data.profile_shift));
    // A shift that thins the teeth for their backlash is often counted in.
    let shift = shift.filter(|(_, x, own)| (x - own).abs() > SAME_SHIFT);
    let all = all.into_iter().chain(width).chain(shift);
    match all.into_iter().find(|(_, measured, own)| (measured - own).abs() > SAME * own.abs().max(1.0)) {
        Some((name, measured, own)) => Err(MetrologyError::OtherGear { name, measured, own }),
        None => Ok(()),
    }
}

/// Flanks of a gear from its traces.
///
/// ```text
/// f(L, z) = sum_i phi_i(z) p_i(L) + sum_j psi_j(L) l_j(z) - sum_ij phi_i(z) psi_j(L) f_ij,   f_ij = (p_i(L_j) + l_j(z_i))/2
/// ```
/// p_i: profiles at heights z_i; l_j: helices at roll lengths L_j; phi, psi: straight between them and beyond (Gordon's blend,
/// of one profile and one helix Coons's p + l - corner). Each trace has a zero of its own: the one in the middle keeps it, the
/// others are shifted to meet those that cross them. Places without a value are bridged by a straight line. Beyond the ends of
/// the traces the grid ends, and the flank goes on along its tangent ([`MeasuredFlanks::extrapolated_mm`]).
///
/// # Errors
/// [`MetrologyError::OtherGear`], [`MetrologyError::Unusable`] where no trace has a range, [`MetrologyError::Geometry`].
pub fn flanks(measured: &MeasuredGear, gear: &Gear) -> Result<MeasuredFlanks, MetrologyError> {
    let header = &measured.header;
    same_gear(header, gear)?;
    let radii = [gear.root_radius(), gear.tip_radius()];
    let is_beside = |trace: &Trace| match trace.kind {
        TraceKind::Profile(z) => z.abs() > 0.5 * gear.face_width() * (1.0 + SAME),
        TraceKind::Helix(d) => 0.5 * d < radii[0] || 0.5 * d > radii[1],
    };
    if measured.traces.iter().any(is_beside) {
        return Err(MetrologyError::Unusable {
            what: "a profile stands beyond the face of the gear (heights count from its middle), or a helix beyond its teeth",
        });
    }
    let mut extrapolated_mm = [0.0f64; 4];
    let mut topographies = [None, None];
    let mut measured_teeth = [Vec::new(), Vec::new()];
    let mut same_along_face = [0; 2];
    for (slot, side) in [Side::Left, Side::Right].into_iter().enumerate() {
        let mut teeth: BTreeMap<u32, Vec<&Trace>> = BTreeMap::new();
        for trace in measured.traces.iter().filter(|t| t.side == side) {
            teeth.entry(trace.tooth).or_default().push(trace);
        }
        let blends: BTreeMap<u32, Blend> =
            teeth.into_iter().filter_map(|(tooth, traces)| Some((tooth, Blend::new(header, &traces)?))).collect();
        let (lines, beyond) = common_lines(blends.values(), gear);
        if !blends.is_empty() {
            extrapolated_mm.iter_mut().zip(beyond).for_each(|(all, own)| *all = all.max(own));
        }
        same_along_face[slot] =
            blends.values().filter(|blend| blend.helices.is_empty() && blend.profiles.len() < 2).count();
        let mut grids = BTreeMap::new();
        for (tooth, blend) in blends {
            grids.insert(tooth, blend.grid(&lines, gear)?);
        }
        measured_teeth[slot] = grids.keys().copied().collect();
        topographies[slot] = (!grids.is_empty()).then(|| grids.into());
    }
    if topographies.iter().all(Option::is_none) && measured.pitch.is_empty() {
        return Err(MetrologyError::Unusable { what: header.no_range() });
    }
    let sides = measured.pitch.len().max(1) as f64;
    let mut pitch_errors = vec![0.0; if measured.pitch.is_empty() { 0 } else { header.teeth as usize }];
    for pitch in &measured.pitch {
        pitch_errors.iter_mut().zip(&pitch.index_um).for_each(|(all, own)| *all += 1e-3 * own / sides);
    }
    let off =
        measured.pitch.iter().flat_map(|p| p.index_um.iter().zip(&pitch_errors)).map(|(own, e)| (1e-3 * own - e).abs());
    let left_out_mm = off.fold(0.0, f64::max);
    Ok(MeasuredFlanks { topographies, pitch_errors, left_out_mm, measured_teeth, same_along_face, extrapolated_mm })
}

/// A trace as a function: places ascending, values in mm, and where across it stands.
#[derive(Debug, Clone)]
struct Line {
    across: f64,
    points: Vec<[f64; 2]>,
}

impl Line {
    /// Straight between its points; its end values beyond.
    fn at(&self, x: f64) -> f64 {
        let after = self.points.partition_point(|p| p[0] <= x);
        let last = self.points.len() - 1;
        if after == 0 {
            return self.points[0][1];
        }
        if after > last {
            return self.points[last][1];
        }
        let ([x0, y0], [x1, y1]) = (self.points[after - 1], self.points[after]);
        y0 + (y1 - y0) * (x - x0) / (x1 - x0)
    }

    fn shift(&mut self, by: f64) {
        self.points.iter_mut().for_each(|p| p[1] += by);
    }

    fn ends(&self) -> [f64; 2] {
        [self.points[0][0], self.points[self.points.len() - 1][0]]
    }
}

/// Profiles over roll length and helices over height of one flank.
struct Blend {
    profiles: Vec<Line>,
    helices: Vec<Line>,
}

impl Blend {
    /// `None` where no trace serves.
    fn new(header: &GearHeader, traces: &[&Trace]) -> Option<Self> {
        let line = |trace: &&Trace| {
            let points = trace.points(header).filter(|p| p.len() >= 2)?;
            let across = match trace.kind {
                TraceKind::Profile(z) => z,
                TraceKind::Helix(d) => header.roll_length(d),
            };
            let points = points.into_iter().map(|[x, um]| [x, 1e-3 * um]).collect();
            across.is_finite().then_some(Line { across, points })
        };
        let of = |is_profile: bool| {
            let own = traces.iter().filter(|t| matches!(t.kind, TraceKind::Profile(_)) == is_profile);
            // The last of those at one place counts, as it was measured last: the first of equals is kept.
            let mut lines: Vec<Line> = own.rev().filter_map(line).collect();
            lines.sort_by(|a, b| a.across.total_cmp(&b.across));
            lines.dedup_by(|a, b| a.across == b.across);
            lines
        };
        let (mut profiles, mut helices) = (of(true), of(false));
        if profiles.is_empty() && helices.is_empty() {
            return None;
        }
        if !profiles.is_empty() && !helices.is_empty() {
            let [p, h] = [profiles.len() / 2, helices.len() / 2];
            // Zero where the two in the middle cross.
            let (z, x) = (profiles[p].across, helices[h].across);
            let meet = profiles[p].at(x) - helices[h].at(z);
            helices[h].shift(meet);
            for profile in &mut profiles {
                let off = helices[h].at(profile.across) - profile.at(x);
                profile.shift(off);
            }
            let middle = profiles[p].clone();
            for helix in &mut helices {
                let off = middle.at(helix.across) - helix.at(z);
                helix.shift(off);
            }
        }
        Some(Self { profiles, helices })
    }

    /// Deviation at a roll length and a height, mm.
    fn at(&self, x: f64, z: f64) -> f64 {
        let [across_z, across_x] = [weights(&self.profiles, z), weights(&self.helices, x)];
        let mut sum = 0.0;
        for &(i, phi) in &across_z {
            sum += phi * self.profiles[i].at(x);
        }
        for &(j, psi) in &across_x {
            sum += psi * self.helices[j].at(z);
        }
        for &(i, phi) in &across_z {
            for &(j, psi) in &across_x {
                let (profile, helix) = (&self.profiles[i], &self.helices[j]);
                sum -= phi * psi * 0.5 * (profile.at(helix.across) + helix.at(profile.across));
            }
        }
        sum
    }

    /// Lines along the profile and along the face that its traces ask for.
    fn counts(&self) -> [usize; 2] {
        let count =
            |lines: &[Line], most: usize| lines.iter().map(|l| l.points.len()).max().unwrap_or(2).clamp(2, most);
        // Profiles at several heights alone ask for lines between them.
        let between = self.profiles.len().min(LINES[1]);
        [count(&self.profiles, LINES[0]), count(&self.helices, LINES[1]).max(between)]
    }

    /// The grid of its depths on lines over roll length and height.
    fn grid(&self, [x, z]: &[Vec<f64>; 2], gear: &Gear) -> Result<TopographyGrid, MetrologyError> {
        let base = gear.base_radius();
        let depths = x.iter().flat_map(|&x| z.iter().map(move |&z| (x, z))).map(|(x, z)| -self.at(x, z)).collect();
        let rolls = ProfileAxis::Roll(x.iter().map(|x| x / base).collect());
        Ok(TopographyGrid::new(rolls, z.clone(), depths)?)
    }
}

/// Lines over roll length and height that lie within the traces of all teeth, as many as the finest of them asks for, and how
/// far the flank goes beyond them: along the profile below and above, along the face below and above, mm.
fn common_lines<'a>(blends: impl Iterator<Item = &'a Blend> + Clone, gear: &Gear) -> ([Vec<f64>; 2], [f64; 4]) {
    let base = gear.base_radius();
    let flank = [gear.profile().roll_form(), gear.profile().roll_tip()].map(|u| base * u);
    let half = 0.5 * gear.face_width();
    let common = |of: fn(&Blend) -> &Vec<Line>, own: [f64; 2]| {
        let within = |a: [f64; 2], b: [f64; 2]| [a[0].max(b[0]), a[1].min(b[1])];
        blends.clone().flat_map(of).map(Line::ends).reduce(within).unwrap_or(own)
    };
    let ends = [common(|b| &b.profiles, flank), common(|b| &b.helices, [-half, half])];
    let counts = blends.clone().map(Blend::counts).fold([2; 2], |a, b| [a[0].max(b[0]), a[1].max(b[1])]);
    let even = |[from, to]: [f64; 2], n: usize| -> Vec<f64> {
        (0..n).map(|i| from + (to - from) * i as f64 / (n - 1) as f64).collect()
    };
    let beyond = [ends[0][0] - flank[0], flank[1] - ends[0][1], ends[1][0] + half, half - ends[1][1]];
    ([even(ends[0], counts[0]), even(ends[1], counts[1])], beyond.map(|b| b.max(0.0)))
}

/// Shares of the lines beside a place: straight between them and on beyond the last two.
fn weights(lines: &[Line], at: f64) -> Vec<(usize, f64)> {
    match lines.len() {
        0 => Vec::new(),
        1 => vec![(0, 1.0)],
        n => {
            let after = lines.partition_point(|l| l.across <= at).clamp(1, n - 1);
            let [a, b] = [lines[after - 1].across, lines[after].across];
            let share = (at - a) / (b - a);
            vec![(after - 1, 1.0 - share), (after, share)]
        }
    }
}
