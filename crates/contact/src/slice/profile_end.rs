//! Ends of a profile that come before the point at which the gap's slope would be zero.

use crate::bracketing::bracket_zero;

use super::profile_search::{Found, GapSample, LeastGapPoint, NEAR, ProfilePair, RESOLUTION};

/// Steps to a place whose foot is known before a bracket is closed; three are enough.
const FOOT_STEPS: usize = 8;

impl ProfilePair<'_> {
    /// A place where the slope vanishes, or the end of the other profile before it, where its foot (`sample`) lies
    /// beyond that; `None` where the gap is wider than `reach` (mm) or no flank is faced.
    pub(super) fn within_other(
        &self,
        z: f64,
        found: Found,
        sample: &GapSample,
        reach: f64,
    ) -> Result<Option<Found>, ()> {
        let (u, foot) = (found.0.roll(), sample.foot[0]);
        let [[low, high], [other_low, other_high]] = [self.rolls(0), self.rolls(1)];
        if foot >= other_low && foot <= other_high {
            return Ok(Some(found));
        }
        // At the ends of the other profile the gap is no smaller than here.
        if sample.gap > reach {
            return Ok(None);
        }
        // Foot points go down the other profile as points go up this one; with a ring they go up.
        let (bound, beyond) = if foot > other_high { (other_high, true) } else { (other_low, false) };
        let end = if beyond != self.has_ring() { high } else { low };
        let at_tip = beyond != self.patches[1].is_hollow();
        let at = |u: f64| if at_tip { LeastGapPoint::OtherEnd(u) } else { LeastGapPoint::OwnEnd(u) };
        if let Some((u, sample)) = self.place_of_foot(z, bound, (u, foot), [u.min(end), u.max(end)]) {
            return Ok(Some((at(u), sample)));
        }
        let past = |u: f64| self.sample([u, z]).map(|l| l.foot[0] - bound).ok_or(());
        let (here, there) = (foot - bound, past(end)?);
        if here * there > 0.0 {
            return Ok(None);
        }
        let mut failed = false;
        let [inner, outer] = bracket_zero(
            |u| {
                past(u).unwrap_or_else(|()| {
                    failed = true;
                    0.0
                })
            },
            [u, end],
            [here, there],
        );
        if failed {
            return Err(());
        }
        // Of the bracket, the side from which the other flank is faced: that of `end`.
        let u = if (inner - end).abs() < (outer - end).abs() { inner } else { outer };
        Ok(Some((at(u), None)))
    }

    /// Roll angle between two at which the foot is at `bound`, and what is seen there, by the secant method from a place
    /// with its foot; `None` where that leads to nothing.
    ///
    /// Flanks that nearly touch roll on each other: equal arcs lie between places and their feet.
    ///
    /// ```text
    /// r_b1 (u^2 - u_0^2) = r_b2 (v_0^2 - v^2)
    /// ```
    pub(super) fn place_of_foot(
        &self,
        z: f64,
        bound: f64,
        (mut u, mut foot): (f64, f64),
        [low, high]: [f64; 2],
    ) -> Option<(f64, Option<GapSample>)> {
        let [first, second] = self.patches.map(|patch| patch.surface().nominal_flank());
        let ratio = second?.base_radius / first?.base_radius;
        let mut next = (u * u + ratio * (foot * foot - bound * bound)).max(0.0).sqrt();
        for _ in 0..FOOT_STEPS {
            if !(low..=high).contains(&next) {
                return None;
            }
            let sample = self.sample([next, z])?;
            let step = (bound - sample.foot[0]) * (next - u) / (sample.foot[0] - foot);
            if step.abs() <= RESOLUTION {
                return Some((next, Some(sample)));
            }
            // The error after a step is about the product of the last two.
            if step.abs() <= NEAR && (step * (next - u)).abs() <= RESOLUTION {
                return Some((next + step, None));
            }
            (u, foot) = (next, sample.foot[0]);
            next += step;
        }
        None
    }
}
