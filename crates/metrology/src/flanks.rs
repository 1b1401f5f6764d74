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
    let mut extrapolated_mm = [0.0f64; 4];
    let mut topographies = [None, None];
    let mut measured_teeth = [Vec::new(), Vec::new()];
    for (slot, side) in [Side::Left, Side::Right].into_iter().enumerate() {
        let mut teeth: BTreeMap<u32, Vec<&Trace>> = BTreeMap::new();
        for trace in measured.traces.iter().filter(|t| t.side == side) {
            teeth.entry(trace.tooth).or_default().push(trace);
        }
        let mut grids = BTreeMap::new();
        for (tooth, traces) in teeth {
            let blend = Blend::new(header, &traces);
            if let Some((grid, beyond)) = blend.map(|b| b.grid(gear)).transpose()? {
                extrapolated_mm.iter_mut().zip(beyond).for_each(|(all, own)| *all = all.max(own));
                grids.insert(tooth, grid);
            }
        }
        measured_teeth[slot] = grids.keys().copied().collect();
        topographies[slot] = (!grids.is_empty()).then(|| grids.into());
    }
    if topographies.iter().all(Option::is_none) && measured.pitch.is_empty() {
        return Err(MetrologyError::Unusable { what: "no trace has a measuring range and two values" });
    }
    let sides = measured.pitch.len().max(1) as f64;
    let mut pitch_errors = vec![0.0; if measured.pitch.is_empty() { 0 } else { header.teeth as usize }];
    for pitch in &measured.pitch {
        pitch_errors.iter_mut().zip(&pitch.index_um).for_each(|(all, own)| *all += 1e-3 * own / sides);
    }
    let off =
        measured.pitch.iter().flat_map(|p| p.index_um.iter().zip(&pitch_errors)).map(|(own, e)| (1e-3 * own - e).abs());
    let left_out_mm = off.fold(0.0, f64::max);
    Ok(MeasuredFlanks { topographies, pitch_errors, left_out_mm, measured_teeth, extrapolated_mm })
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

    /// The grid of its depths, and how far the flank goes beyond it.
    fn grid(&self, gear: &Gear) -> Result<(TopographyGrid, [f64; 4]), MetrologyError> {
        let base = gear.base_radius();
        let flank = [gear.profile().roll_form(), gear.profile().roll_tip()].map(|u| base * u);
        let half = 0.5 * gear.face_width();
        let common = |lines: &[Line], own: [f64; 2]| match lines {
            [] => own,
            lines => lines.iter().map(Line::ends).fold(lines[0].ends(), |a, b| [a[0].max(b[0]), a[1].min(b[1])]),
        };
        let ends = [common(&self.profiles, flank), common(&self.helices, [-half, half])];
        let beyond = [ends[0][0] - flank[0], flank[1] - ends[0][1], ends[1][0] + half, half - ends[1][1]];
        let count =
            |lines: &[Line], most: usize| lines.iter().map(|l| l.points.len()).max().unwrap_or(2).clamp(2, most);
        let even = |[from, to]: [f64; 2], n: usize| -> Vec<f64> {
            (0..n).map(|i| from + (to - from) * i as f64 / (n - 1) as f64).collect()
        };
        let x = even(ends[0], count(&self.profiles, LINES[0]));
        // Profiles at several heights alone ask for lines between them.
        let z = even(ends[1], count(&self.helices, LINES[1]).max(self.profiles.len().min(LINES[1])));
        let depths = x.iter().flat_map(|&x| z.iter().map(move |&z| (x, z))).map(|(x, z)| -self.at(x, z)).collect();
        let rolls = ProfileAxis::Roll(x.iter().map(|x| x / base).collect());
        Ok((TopographyGrid::new(rolls, z, depths)?, beyond.map(|b| b.max(0.0))))
    }
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
