//! A window that slides with the rotating pair: when it moves on, and when it has too few teeth. Theory (14).

use geometry::Sense;

use crate::{AleError, Station, ToothWindow};

/// The window of tooth pairs of a rotating pair.
///
/// Contact forces are those of the window's pairs, N, in ascending running number. A pair leaves when another window is
/// nearer to the pair's station and its own force is exactly zero, which means an open gap. Displacements and
/// velocities need no transfer, because elastic coordinates follow from the forces.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SlidingWindow {
    window: ToothWindow,
    sense: Sense,
}

impl SlidingWindow {
    /// The window of `count` pairs nearest to a station, for gears with `teeth` teeth; the pinion rotates in `sense`.
    ///
    /// # Errors
    /// [`AleError::TooWide`] if a gear has fewer teeth than the window.
    pub fn at(station: Station, count: usize, teeth: [u32; 2], sense: Sense) -> Result<Self, AleError> {
        let first = ToothWindow::nominal_first(station.centre(sense), count);
        Ok(Self { window: ToothWindow::new(first, count, teeth)?, sense })
    }

    /// The window at the start of cycle 0. Two windows are equally near there; this is the one for the coming cycle.
    ///
    /// # Errors
    /// [`AleError::TooWide`] if a gear has fewer teeth than the window.
    pub fn at_start(count: usize, teeth: [u32; 2], sense: Sense) -> Result<Self, AleError> {
        let start = Station { cycle: 0, phase: 0.0 };
        let inward = -1e-9 * sense.sign() as f64;
        let first = ToothWindow::nominal_first(start.centre(sense) + inward, count);
        Ok(Self { window: ToothWindow::new(first, count, teeth)?, sense })
    }

    /// The pairs in the window.
    pub fn window(&self) -> &ToothWindow {
        &self.window
    }

    /// This sliding window with other pairs.
    #[must_use]
    pub fn with_window(self, window: ToothWindow) -> Self {
        Self { window, ..self }
    }

    /// Number of teeth by which the window nearest to a station is ahead, in the sense of rotation; negative: behind.
    pub fn teeth_behind(&self, station: Station) -> i64 {
        let due = ToothWindow::nominal_first(station.centre(self.sense), self.window.count());
        (self.window.first() - due) * self.sense.sign()
    }

    /// The window one tooth nearer to a station. `None` if this one is the nearest, or if the outgoing tooth carries
    /// load; then the change is postponed.
    ///
    /// # Errors
    /// [`AleError::WrongCount`] if there is not one force per pair.
    pub fn due_change(&self, station: Station, forces: &[f64]) -> Result<Option<Self>, AleError> {
        let way = match self.teeth_behind(station) {
            0 => return Ok(None),
            ahead if ahead > 0 => self.sense,
            _ => self.sense.opposite(),
        };
        match self.window.change(way, forces) {
            Ok(window) => Ok(Some(Self { window, ..*self })),
            Err(AleError::LoadedTooth { .. }) => Ok(None),
            Err(other) => Err(other),
        }
    }

    /// The window one tooth further in the sense of rotation, even if no change is due.
    ///
    /// # Errors
    /// [`AleError::LoadedTooth`] if the outgoing tooth carries load.
    pub fn change(&self, forces: &[f64]) -> Result<Self, AleError> {
        Ok(Self { window: self.window.change(self.sense, forces)?, ..*self })
    }

    /// Returns an error if the pair has rotated past the whole window since the window last moved. The window follows
    /// tooth by tooth, so nothing is known of the motion in between.
    ///
    /// # Errors
    /// [`AleError::Leapt`] if the pair has rotated too far.
    pub fn check_pace(&self, cycles: f64) -> Result<(), AleError> {
        let (station, window) = (Station::at_cycles(cycles), self.window.count());
        let due = ToothWindow::nominal_first(station.centre(self.sense), window);
        // Running numbers as floats: a turn that is no number is far from any of them.
        let teeth = (due as f64 - self.window.first() as f64).abs();
        if teeth <= window as f64 && cycles.is_finite() {
            return Ok(());
        }
        Err(AleError::Leapt { cycle: station.cycle, phase: station.phase, teeth, window })
    }

    /// Returns an error if a pair next to the window should carry load: its undeformed flanks overlap at the loaded
    /// pose.
    ///
    /// `gap` gives the smallest gap of a pair by its running number, mm; `allowed` is the overlap (mm) that is
    /// tolerated; `torque` is that on the driven gear, N mm.
    ///
    /// # Errors
    /// [`AleError::Starved`] if such a pair is found.
    pub fn check_neighbours(
        &self,
        station: Station,
        torque: f64,
        allowed: f64,
        gap: impl Fn(i64) -> f64,
    ) -> Result<(), AleError> {
        let overlapping =
            self.window.neighbours().into_iter().map(|pair| (pair, -gap(pair))).find(|(_, o)| *o > allowed);
        match overlapping {
            None => Ok(()),
            Some((pair, overlap)) => Err(AleError::Starved {
                cycle: station.cycle,
                phase: station.phase,
                pair,
                window: self.window.count(),
                overlap_um: 1e3 * overlap,
                torque_nm: 1e-3 * torque,
            }),
        }
    }
}

/// Solves with a window and repeats with wider ones while `wider` returns a width for the error. A starved window is
/// widened by one tooth. The width `None` is the one set by the options.
///
/// # Errors
/// The first error that a wider window does not remove.
pub fn solve_widening<T, E>(
    mut window: Option<usize>,
    mut solve: impl FnMut(Option<usize>) -> Result<T, E>,
    mut wider: impl FnMut(Option<usize>, &E) -> Option<usize>,
) -> Result<T, E> {
    loop {
        match solve(window) {
            Ok(solved) => return Ok(solved),
            Err(error) => match wider(window, &error) {
                Some(teeth) => window = Some(teeth),
                None => return Err(error),
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEETH: [u32; 2] = [17, 29];

    /// In either sense the window follows its pair tooth by tooth, and back again.
    #[test]
    fn the_window_follows_the_pair_both_ways() {
        for sense in [Sense::Ccw, Sense::Cw] {
            let start = SlidingWindow::at_start(3, TEETH, sense).unwrap();
            let mut window = start;
            for (to, changes) in [(5.9, 5), (0.1, 5)] {
                let mut seen = 0;
                while let Some(next) = window.due_change(Station::at_cycles(to), &[0.0; 3]).unwrap() {
                    (window, seen) = (next, seen + 1);
                }
                assert_eq!(window.teeth_behind(Station::at_cycles(to)), 0, "{sense:?} at {to} cycles");
                assert_eq!(seen, changes, "{sense:?} on the way to {to} cycles");
            }
            assert_eq!(window, start, "{sense:?}: there and back");
        }
    }

    /// A change that is due waits for its outgoing tooth, and for no other.
    #[test]
    fn a_change_waits_for_the_outgoing_tooth() {
        let window = SlidingWindow::at_start(3, TEETH, Sense::Ccw).unwrap();
        let station = Station::at_cycles(1.2);
        assert!(window.due_change(station, &[5.0, 5.0, 1e-9]).unwrap().is_none(), "the outgoing tooth carries 1e-9 N");
        assert!(window.due_change(station, &[5.0, 5.0, 0.0]).unwrap().is_some(), "the outgoing tooth is free");
    }

    /// A pair that turns past the whole window is refused, and so is one that turns by no number.
    #[test]
    fn a_leap_is_refused() {
        let window = SlidingWindow::at_start(3, TEETH, Sense::Ccw).unwrap();
        assert!(window.check_pace(2.5).is_ok());
        for cycles in [9.0, -9.0, f64::NAN, f64::INFINITY] {
            assert!(matches!(window.check_pace(cycles), Err(AleError::Leapt { .. })), "{cycles} cycles");
        }
    }

    /// An overlap beside the window names the pair and what was missing; one within the allowance does not.
    #[test]
    fn a_starved_window_names_the_pair() {
        let window = SlidingWindow::at_start(3, TEETH, Sense::Ccw).unwrap();
        let [_, behind] = window.window().neighbours();
        let gap = |pair: i64| if pair == behind { -2e-3 } else { 1.0 };
        let station = Station::at_cycles(0.0);
        assert!(window.check_neighbours(station, 1e3, 3e-3, gap).is_ok());
        match window.check_neighbours(station, 1e3, 1e-3, gap) {
            Err(AleError::Starved { pair, window: 3, overlap_um, .. }) => {
                assert_eq!(pair, behind);
                assert!((overlap_um - 2.0).abs() < 1e-12, "{overlap_um} um");
            }
            other => panic!("{other:?}"),
        }
    }

    /// Widening stops at the first width that does, or at the first error that it cannot cure.
    #[test]
    fn a_window_is_widened_until_it_does() {
        let wider = |now: Option<usize>, starved: &bool| starved.then(|| now.unwrap_or(3) + 1);
        let solved = solve_widening(None, |w| if w == Some(5) { Ok(5) } else { Err(true) }, wider);
        assert_eq!(solved, Ok(5));
        let failed = solve_widening(None, |w| if w == Some(5) { Err(false) } else { Err::<(), _>(true) }, wider);
        assert_eq!(failed, Err(false));
    }
}
