//! Ends of the loaded parts of a line of slices, between its stations. Theory (21b).

use crate::bracketing::bracket_zero_within;

/// State of a station of a contact line in the solved contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LineStation {
    /// Gap under load without the local approach, mm: the overlap of the flanks (negative) if the station is in
    /// contact, otherwise the remaining gap.
    pub gap: f64,
    /// Part of this gap that is not the gap of the undeformed flanks, mm: the bulk deflection, which is smooth along
    /// the line.
    pub opened: f64,
}

/// Ends are found to this share of the distance between stations.
const RESOLUTION: f64 = 1e-9;
/// Stations that the deflection is interpolated from.
const BASE: usize = 3;
/// How many stations away they may lie.
const AROUND: usize = 4;

/// Intervals [from, to] of height z, mm, over which a tooth pair is in contact, ascending.
///
/// ```text
/// w(z) = g(z) + o(z) < 0
/// ```
/// g is the gap of the undeformed flanks at the loaded pose, exact at every z (`gap(i, z)`, where station `i` is the
/// nearest to z; infinite where the flanks do not face each other). o is [`LineStation::opened`], a parabola through
/// the three nearest stations. At the stations w equals the solution, so the ends belong to the line whose load the
/// slices carry, and they move smoothly while the stations stay fixed. A line that has not yet reached a station is
/// found at an end face, or between three stations that are about to touch. If no station near an end face was
/// evaluated, as under very small load, `unsolved(i, z)` gives o there.
///
/// `stations` (mm) are evenly spaced, ascending, and start half a step inside the ends `face` of the common face.
/// `solved` has `None` for stations that are too far apart to have been evaluated.
pub fn loaded_intervals(
    stations: &[f64],
    solved: &[Option<LineStation>],
    face: [f64; 2],
    gap: impl FnMut(usize, f64) -> f64,
    unsolved: impl FnMut(usize, f64) -> f64,
) -> Vec<[f64; 2]> {
    let step = (face[1] - face[0]) / stations.len().max(1) as f64;
    Line { stations, solved, step, gap, unsolved }.intervals(face)
}

struct Line<'a, G, U> {
    stations: &'a [f64],
    solved: &'a [Option<LineStation>],
    step: f64,
    gap: G,
    unsolved: U,
}

impl<G: FnMut(usize, f64) -> f64, U: FnMut(usize, f64) -> f64> Line<'_, G, U> {
    fn intervals(&mut self, face: [f64; 2]) -> Vec<[f64; 2]> {
        let count = self.stations.len();
        let mut all = Vec::new();
        let mut from = None;
        for i in 0..count {
            match (from, self.presses(i)) {
                (None, true) => from = Some(if i == 0 { self.end(0, face[0]) } else { self.between(i, i - 1) }),
                (Some(start), false) => {
                    all.push([start, self.between(i - 1, i)]);
                    from = None;
                }
                _ => {}
            }
            if !self.presses(i) {
                all.extend(self.unreached(i, face));
            }
        }
        if let Some(start) = from {
            all.push([start, self.end(count - 1, face[1])]);
        }
        all
    }

    fn presses(&self, i: usize) -> bool {
        self.solved[i].is_some_and(|s| s.gap < 0.0)
    }

    /// End of the line between a station that presses and one beside it that does not.
    fn between(&mut self, inside: usize, outside: usize) -> f64 {
        let there = self.solved[outside].map(|s| s.gap);
        self.zero(inside, [self.stations[inside], self.stations[outside]], there)
    }

    /// End of the line between the outermost station, which presses, and the end face.
    fn end(&mut self, i: usize, face: f64) -> f64 {
        self.zero(i, [self.stations[i], face], None)
    }

    /// A part of the line that no station carries, beside station `i`, which is open: at an end face, or where the gap
    /// dips between stations.
    fn unreached(&mut self, i: usize, [low, high]: [f64; 2]) -> Option<[f64; 2]> {
        let z = self.stations[i];
        let count = self.stations.len();
        let face = [(0, low), (count - 1, high)].into_iter().find(|(end, _)| *end == i).map(|(_, face)| face);
        if let Some(face) = face {
            // Load opens flanks there: where the undeformed ones are apart there is no line, and nothing is recovered.
            if self.solved[i].is_none() && (self.gap)(i, face) >= 0.0 {
                return None;
            }
            let there = self.under_load(i, face);
            if there >= 0.0 {
                return None;
            }
            // Under a light load the end station may be too far apart to have been looked at, beyond the end of the path.
            let here = self.solved[i].map_or_else(|| self.under_load(i, z), |s| s.gap);
            let end = if here < 0.0 { z } else { self.zero_of(i, [face, z], [there, here]) };
            return Some(if face < z { [face, end] } else { [end, face] });
        }
        let here = self.solved[i]?.gap;
        let [before, after] = [self.solved[i - 1]?.gap, self.solved[i + 1]?.gap];
        if before < here || after <= here {
            return None;
        }
        // Vertex of the parabola through the three.
        let bend = before - 2.0 * here + after;
        let way = 0.5 * (before - after) / bend;
        if here - 0.25 * (before - after) * way >= 0.0 || !way.is_finite() {
            return None;
        }
        let dip = z + way * self.step;
        let lowest = self.under_load(i, dip);
        let open = |side: f64| if (side - z) * (dip - z) > 0.0 { side } else { z };
        let [low, high] = [open(z - self.step), open(z + self.step)];
        let gap_at = |at: f64| {
            if at == z {
                here
            } else if at < z {
                before
            } else {
                after
            }
        };
        (lowest < 0.0).then(|| [low, high].map(|to| self.zero_of(i, [dip, to], [lowest, gap_at(to)])))
    }

    /// Gap under load at any height, without the local approach, mm: of flanks that do not face each other as wide as the
    /// stations are apart.
    fn under_load(&mut self, near: usize, z: f64) -> f64 {
        let gap = (self.gap)(near, z);
        if gap.is_finite() { gap + self.opened(near, z) } else { self.step }
    }

    /// Deflection at height z by the parabola through the known stations next to it.
    fn opened(&mut self, near: usize, z: f64) -> f64 {
        let mut known = [(0.0, 0.0); BASE];
        let mut count = 0;
        // Outward from z, the nearer side first.
        let upward = z >= self.stations[near];
        for k in 0..=2 * AROUND {
            let (far, first) = (k.div_ceil(2), k % 2 == 1);
            let i = if first == upward { near.checked_add(far) } else { near.checked_sub(far) };
            let Some((i, s)) = i.and_then(|i| Some((i, (*self.solved.get(i)?)?))) else { continue };
            known[count] = (self.stations[i], s.opened);
            count += 1;
            if count == BASE {
                break;
            }
        }
        if count == 0 {
            return (self.unsolved)(near, z);
        }
        let known = &known[..count];
        let weight = |i: usize| {
            let others = known.iter().enumerate().filter(|(j, _)| *j != i);
            others.map(|(_, (x, _))| (z - x) / (known[i].0 - x)).product::<f64>()
        };
        known.iter().enumerate().map(|(i, (_, opened))| weight(i) * opened).sum()
    }

    /// Place between `inside`, a station that presses, and `outside` at which the line ends; `outside` where
    /// that presses too. `there`: gap at `outside`, if it is known.
    fn zero(&mut self, station: usize, [inside, outside]: [f64; 2], there: Option<f64>) -> f64 {
        let here = self.solved[station].map_or(0.0, |s| s.gap);
        let there = there.unwrap_or_else(|| self.under_load(station, outside));
        if there < 0.0 { outside } else { self.zero_of(station, [inside, outside], [here, there]) }
    }

    fn zero_of(&mut self, near: usize, ends: [f64; 2], gaps: [f64; 2]) -> f64 {
        let width = RESOLUTION * self.step;
        let [a, b] = bracket_zero_within(|z| self.under_load(near, z), ends, gaps, width);
        0.5 * (a + b)
    }
}
