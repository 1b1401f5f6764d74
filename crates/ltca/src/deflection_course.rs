//! Extrapolates the deflection from the last stations to the next one.

use ale::Station;

/// Stations that a parabola goes through.
const STATIONS: usize = 3;
/// Largest change from station to station that is believed, over the rotation.
const FARTHEST: f64 = 0.2;

/// Rotation of the driven gear caused by the load at the last stations, from which the next solution starts.
#[derive(Debug, Clone, Default)]
pub struct DeflectionCourse {
    /// Stations and rotations (rad), the newest first.
    last: Vec<(Station, f64)>,
}

impl DeflectionCourse {
    /// Expected rotation at a station, rad: the polynomial through the known stations, or the last value if the
    /// polynomial is far from it; 0 if there are none.
    pub fn at(&self, station: Station) -> f64 {
        let Some((_, last)) = self.last.first() else { return 0.0 };
        let expected = self.extrapolated(station);
        if (expected - last).abs() <= FARTHEST * last.abs() { expected } else { *last }
    }

    fn extrapolated(&self, station: Station) -> f64 {
        let place = |other: Station| (other.cycle - station.cycle) as f64 + (other.phase - station.phase);
        let weight = |i: usize| {
            let others = self.last.iter().enumerate().filter(|(j, _)| *j != i);
            let x = place(self.last[i].0);
            others.map(|(_, (other, _))| place(*other) / (place(*other) - x)).product::<f64>()
        };
        self.last.iter().enumerate().map(|(i, (_, rotation))| weight(i) * rotation).sum()
    }

    /// Adds the rotation at a further station; it replaces a known value at that station.
    #[must_use]
    pub fn and(mut self, station: Station, rotation: f64) -> Self {
        self.last.retain(|(known, _)| *known != station);
        self.last.insert(0, (station, rotation));
        self.last.truncate(STATIONS);
        self
    }
}
