//! Contact pattern: the envelope of moving contact lines on a flank.

use serde::{Deserialize, Serialize};

use crate::StudyError;

/// The contact of a tooth at one axial station and one position of the mesh.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Touch {
    /// Height on the flank, mm.
    pub z: f64,
    /// Progress of the tooth through the mesh, in mesh cycles, from any origin.
    pub engagement: f64,
    /// Roll angle of the contact, rad.
    pub roll: f64,
    /// Largest pressure across the band, MPa.
    pub pressure: f64,
    /// Line load, N/mm.
    pub line_load: f64,
}

/// Largest pressure and line load on every part of a flank, on a grid of roll angle by axial station.
///
/// The contact at a station moves along the profile while the tooth passes through the mesh. It is known at the solved
/// positions. Between them roll angle, pressure and line load are interpolated linearly:
///
/// ```text
/// p(u_i, z_j) = max of p over the path of station j within |u - u_i| <= h / 2     h: step of the grid
/// ```
///
/// So the largest value of the grid is the largest of all contacts, and parts that no path approaches within half a
/// step are 0. The band extends farther by its half-width; a path ends at the last solved position with load.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Written")]
pub struct FlankPattern {
    rolls: Vec<f64>,
    stations: Vec<f64>,
    /// Station by station, ascending in roll angle.
    max_pressure: Vec<f64>,
    max_line_load: Vec<f64>,
}

/// A pattern as it stands in a file, nothing checked yet.
#[derive(Deserialize)]
struct Written {
    rolls: Vec<f64>,
    stations: Vec<f64>,
    max_pressure: Vec<f64>,
    max_line_load: Vec<f64>,
}

impl TryFrom<Written> for FlankPattern {
    type Error = &'static str;

    fn try_from(Written { rolls, stations, max_pressure, max_line_load }: Written) -> Result<Self, Self::Error> {
        let cells = rolls.len().saturating_mul(stations.len());
        if rolls.len() < 2 || stations.is_empty() || max_pressure.len() != cells || max_line_load.len() != cells {
            return Err("a flank pattern of another size than its grid");
        }
        Ok(Self { rolls, stations, max_pressure, max_line_load })
    }
}

impl FlankPattern {
    /// A flank without contact yet: `steps` equal steps of roll angle over `range` (rad), stations at heights
    /// `stations` (mm).
    ///
    /// # Errors
    /// [`StudyError::NoGrid`] without a step or a station, or for an invalid range.
    pub fn new(range: [f64; 2], steps: usize, stations: Vec<f64>) -> Result<Self, StudyError> {
        let [low, high] = range;
        let grid = low.is_finite() && high.is_finite() && low < high && stations.iter().all(|z| z.is_finite());
        if !grid || steps == 0 || stations.is_empty() {
            return Err(StudyError::NoGrid { low, high, steps, stations: stations.len() });
        }
        let step = (high - low) / steps as f64;
        let mut rolls: Vec<f64> = (0..steps).map(|i| low + step * i as f64).collect();
        rolls.push(high);
        let zeros = vec![0.0; rolls.len() * stations.len()];
        Ok(Self { rolls, stations, max_pressure: zeros.clone(), max_line_load: zeros })
    }

    /// Adds the contacts of one mesh cycle, in any order. All teeth count as one tooth: the contact of pair k at phase
    /// s is at engagement k + s. Contacts of one station are joined to a path if their engagements differ by at most
    /// `reach` cycles, which should be slightly more than the distance of two positions.
    ///
    /// A contact belongs to the nearest station and, beyond the end of the grid, to its last strip.
    ///
    /// # Errors
    /// [`StudyError::NotFinite`] if a value of a contact is not a finite number; then nothing is added.
    pub fn press(&mut self, touches: &[Touch], reach: f64) -> Result<(), StudyError> {
        for (index, t) in touches.iter().enumerate() {
            let numbers = [t.z, t.engagement, t.roll, t.pressure, t.line_load];
            if let Some(&value) = numbers.iter().find(|v| !v.is_finite()) {
                return Err(StudyError::NotFinite { index, value });
            }
        }
        let mut of_station = vec![Vec::new(); self.stations.len()];
        for touch in touches {
            of_station[self.nearest_station(touch.z)].push(*touch);
        }
        for (station, mut path) in of_station.into_iter().enumerate() {
            path.sort_by(|a, b| a.engagement.total_cmp(&b.engagement));
            path.iter().for_each(|t| self.sweep(station, t, t));
            for two in path.windows(2).filter(|two| two[1].engagement - two[0].engagement <= reach) {
                self.sweep(station, &two[0], &two[1]);
            }
        }
        Ok(())
    }

    /// Roll angles of the grid, rad, ascending.
    pub fn rolls(&self) -> &[f64] {
        &self.rolls
    }

    /// Heights of the stations, mm.
    pub fn stations(&self) -> &[f64] {
        &self.stations
    }

    /// Largest pressure, MPa, station by station, and ascending in roll angle within a station.
    pub fn max_pressure(&self) -> &[f64] {
        &self.max_pressure
    }

    /// Largest line load, N/mm, in the same order.
    pub fn max_line_load(&self) -> &[f64] {
        &self.max_line_load
    }

    fn nearest_station(&self, z: f64) -> usize {
        let distance = |i: &usize| (self.stations[*i] - z).abs();
        (0..self.stations.len()).min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or(0)
    }

    /// Strip of the grid that holds a roll angle.
    fn strip(&self, roll: f64) -> usize {
        let last = self.rolls.len() - 1;
        let step = (self.rolls[last] - self.rolls[0]) / last as f64;
        // A float cast saturates, so what lies below the grid falls into strip 0.
        (((roll - self.rolls[0]) / step).round() as usize).min(last)
    }

    /// Contact wanders from `a` to `b`.
    fn sweep(&mut self, station: usize, a: &Touch, b: &Touch) {
        let (low, high) = if a.roll <= b.roll { (a, b) } else { (b, a) };
        let (first, last) = (self.strip(low.roll), self.strip(high.roll));
        let half = 0.5 * (self.rolls[1] - self.rolls[0]);
        let width = high.roll - low.roll;
        for strip in first..=last {
            // Share of the way from low to high at which this strip is entered and left.
            let share = |roll: f64| if width > 0.0 { ((roll - low.roll) / width).clamp(0.0, 1.0) } else { 1.0 };
            let from = if strip == first { 0.0 } else { share(self.rolls[strip] - half) };
            let to = if strip == last { 1.0 } else { share(self.rolls[strip] + half) };
            // Linear between the touches: the largest value is at one end.
            let most = |of: fn(&Touch) -> f64| {
                let at = |s: f64| (1.0 - s) * of(low) + s * of(high);
                at(from).max(at(to))
            };
            let cell = station * self.rolls.len() + strip;
            self.max_pressure[cell] = self.max_pressure[cell].max(most(|t| t.pressure));
            self.max_line_load[cell] = self.max_line_load[cell].max(most(|t| t.line_load));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{FlankPattern, Touch};

    fn touch(engagement: f64, roll: f64, pressure: f64) -> Touch {
        Touch { z: 0.0, engagement, roll, pressure, line_load: 2.0 * pressure }
    }

    /// A path sampled coarsely leaves no hole: every strip between two touches gets the line through them, at its
    /// higher end.
    #[test]
    fn between_positions_the_path_is_a_line() {
        let mut pattern = FlankPattern::new([0.0, 1.0], 10, vec![0.0]).unwrap();
        pattern.press(&[touch(0.5, 0.8, 500.0), touch(0.0, 0.2, 200.0)], 0.6).unwrap();
        let want = [0.0, 0.0, 225.0, 275.0, 325.0, 375.0, 425.0, 475.0, 500.0, 0.0, 0.0];
        for (strip, (&got, want)) in pattern.max_pressure().iter().zip(want).enumerate() {
            assert!((got - want).abs() < 1e-9, "strip {strip}: {got} MPa, not {want} MPa");
            assert!((pattern.max_line_load()[strip] - 2.0 * want).abs() < 1e-9, "strip {strip}");
        }
    }

    /// Contact that ceases and returns leaves what lies between untouched, and a single position marks its own strip
    /// alone.
    #[test]
    fn a_gap_in_the_engagement_stays_empty() {
        let mut pattern = FlankPattern::new([0.0, 1.0], 10, vec![0.0]).unwrap();
        pattern.press(&[touch(0.0, 0.2, 200.0), touch(0.5, 0.8, 500.0)], 0.4).unwrap();
        let touched: Vec<usize> = (0..11).filter(|&i| pattern.max_pressure()[i] > 0.0).collect();
        assert_eq!(touched, [2, 8]);
    }

    /// Contact that stays at an edge, turns back or lies a rounding error beyond the grid keeps its largest pressure.
    #[test]
    fn the_largest_pressure_survives() {
        let mut pattern = FlankPattern::new([0.0, 1.0], 10, vec![-1.0, 1.0]).unwrap();
        let path = [touch(0.0, 0.31, 400.0), touch(0.1, 0.27, 900.0), touch(0.2, 0.6, 100.0)];
        let edge = [touch(0.0, 1.0, 10.0), touch(0.1, 1.0 + 1e-15, 1500.0)].map(|t| Touch { z: 2.0, ..t });
        pattern.press(&path.map(|t| Touch { z: -0.9, ..t }), 0.15).unwrap();
        pattern.press(&edge, 0.15).unwrap();
        let (near, far) = pattern.max_pressure().split_at(11);
        assert_eq!(near.iter().copied().fold(0.0, f64::max), 900.0);
        assert_eq!((far[10], far[9]), (1500.0, 0.0));
    }

    /// Nothing that is no number gets in, and no grid is no panic.
    #[test]
    fn nonsense_is_refused() {
        let mut pattern = FlankPattern::new([0.0, 1.0], 1, vec![0.0]).unwrap();
        assert!(pattern.press(&[touch(0.0, f64::NAN, 1.0)], 1.0).is_err());
        for (range, steps, stations) in [
            ([1.0, 1.0], 3, vec![0.0]),
            ([0.0, f64::NAN], 3, vec![0.0]),
            ([0.0, 1.0], 0, vec![0.0]),
            ([0.0, 1.0], 1, vec![]),
        ] {
            let error = FlankPattern::new(range, steps, stations).unwrap_err();
            assert!(error.hint().is_some(), "{error}");
        }
    }
}
