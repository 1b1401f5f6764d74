//! The window of tooth pairs. Theory (14).

use geometry::Sense;

use crate::AleError;

/// Number of teeth that a pair with total contact ratio eps_gamma needs in its window: floor(eps_gamma) + 1, at least
/// 3.
pub fn teeth_needed(total_contact_ratio: f64) -> usize {
    (total_contact_ratio.floor() as usize + 1).max(3)
}

/// Running numbers of the pairs in the window, first .. first + count - 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ToothWindow {
    first: i64,
    count: usize,
    teeth: [u32; 2],
}

impl ToothWindow {
    /// A window of `count` pairs that starts at running number `first`, for gears with `teeth` teeth.
    ///
    /// # Errors
    /// [`AleError::TooWide`] if a gear has fewer teeth than the window.
    pub fn new(first: i64, count: usize, teeth: [u32; 2]) -> Result<Self, AleError> {
        let fewest = teeth[0].min(teeth[1]);
        if count == 0 || count > fewest as usize {
            return Err(AleError::TooWide { window: count, teeth: fewest });
        }
        Ok(Self { first, count, teeth })
    }

    /// First running number of the window whose middle is nearest to the fractional running number `centre`.
    pub fn nominal_first(centre: f64, count: usize) -> i64 {
        (centre - 0.5 * (count as f64 - 1.0)).round() as i64
    }

    /// First running number.
    pub fn first(&self) -> i64 {
        self.first
    }

    /// Number of pairs.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Running numbers, ascending.
    pub fn pairs(&self) -> std::ops::Range<i64> {
        self.first..self.first + self.count as i64
    }

    /// Pinion and wheel tooth of a pair: k mod z1, -k mod z2.
    pub fn teeth_of(&self, pair: i64) -> [u32; 2] {
        [pair.rem_euclid(i64::from(self.teeth[0])) as u32, (-pair).rem_euclid(i64::from(self.teeth[1])) as u32]
    }

    /// First tooth of each gear's window: the lowest, counted counter-clockwise. On the wheel the running numbers
    /// ascend clockwise.
    pub fn first_teeth(&self) -> [u32; 2] {
        let last = self.first + self.count as i64 - 1;
        [self.teeth_of(self.first)[0], self.teeth_of(last)[1]]
    }

    /// Running numbers of the two pairs next to the window.
    pub fn neighbours(&self) -> [i64; 2] {
        [self.first - 1, self.first + self.count as i64]
    }

    /// The pair that leaves at a change in this sense of rotation.
    pub fn outgoing(&self, sense: Sense) -> i64 {
        match sense {
            // Oncoming pairs have lower numbers when the pinion turns counter-clockwise.
            Sense::Ccw => self.first + self.count as i64 - 1,
            Sense::Cw => self.first,
        }
    }

    /// The window one tooth further, for both gears at once. `forces` (N) are the normal forces of the window's pairs,
    /// ascending. The outgoing pair must carry no force: contact force is exactly zero where a gap is open.
    ///
    /// # Errors
    /// [`AleError::LoadedTooth`] if the outgoing pair carries force; no force is ever dropped.
    pub fn change(&self, sense: Sense, forces: &[f64]) -> Result<Self, AleError> {
        if forces.len() != self.count {
            return Err(AleError::WrongCount { given: forces.len(), window: self.count });
        }
        let pair = self.outgoing(sense);
        let force_n = forces[(pair - self.first) as usize];
        if force_n != 0.0 {
            let [pinion_tooth, wheel_tooth] = self.teeth_of(pair);
            return Err(AleError::LoadedTooth { pair, pinion_tooth, wheel_tooth, force_n });
        }
        Ok(Self { first: self.first - sense.sign(), ..*self })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Three full turns in either sense visit every tooth, wrap without a mark and end where they began.
    #[test]
    fn windows_wrap() {
        for sense in [Sense::Ccw, Sense::Cw] {
            let start = ToothWindow::new(-1, 3, [30, 30]).unwrap();
            let mut window = start;
            for _ in 0..90 {
                let before = window;
                window = window.change(sense, &[0.0; 3]).unwrap();
                let kept: Vec<i64> = window.pairs().filter(|k| before.pairs().contains(k)).collect();
                assert_eq!(kept.len(), 2, "two of three pairs stay");
            }
            assert_eq!(window.first(), -1 - 90 * sense.sign());
            assert_eq!(window.first_teeth(), start.first_teeth());
        }
    }

    /// Pinion teeth k, k+1, ... meet wheel teeth -k, -k-1, ...: the wheel's window starts at the last pair's tooth.
    #[test]
    fn teeth_of_a_pair_run_opposite_ways() {
        let window = ToothWindow::new(-1, 3, [17, 29]).unwrap();
        assert_eq!(window.pairs().map(|k| window.teeth_of(k)).collect::<Vec<_>>(), [[16, 1], [0, 0], [1, 28]]);
        assert_eq!(window.first_teeth(), [16, 28]);
    }

    /// A loaded tooth stays, whatever its load.
    #[test]
    fn a_loaded_tooth_is_not_dropped() {
        let window = ToothWindow::new(0, 3, [30, 30]).unwrap();
        assert!(matches!(window.change(Sense::Ccw, &[0.0, 10.0, 1e-6]), Err(AleError::LoadedTooth { pair: 2, .. })));
        assert!(window.change(Sense::Cw, &[0.0, 10.0, 1e-6]).is_ok());
    }

    /// validation.md, window arithmetic.
    #[test]
    fn least_window() {
        let wanted = [(2.633, 3), (2.093, 3), (1.2, 3), (3.1, 4), (4.9, 5), (5.2, 6)];
        for (ratio, teeth) in wanted {
            assert_eq!(teeth_needed(ratio), teeth, "eps_gamma {ratio}");
        }
    }
}
