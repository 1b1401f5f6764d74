//! Kinks of a profile, such as the start of a linear relief. The slope of the gap jumps there, and no method that
//! follows the slope finds the point in few steps.

use super::profile_search::{LeastGapPoint, Place, ProfilePair, RESOLUTION};

/// Turn of the normal at a place that is a kink, rad.
const KINK: f64 = 1e-7;
/// Roll angles nearer than this to a kink may lie at it: poses of one search are that near to each other.
const NEARLY: f64 = 1e-6;
/// How far beside a kink the gap is looked at, rad: it is known to a part of that.
const BESIDE: f64 = 4.0 * RESOLUTION;

/// How the gap goes beside a kink.
enum Beside {
    /// It is least there.
    Least(LeastGapPoint),
    /// It rises before the kink already.
    Rises(Place),
    /// It falls behind it still.
    Falls(Place),
}

impl ProfilePair<'_> {
    /// The kink that a place or its foot is at, if the gap is least there. Where it is beside that, the place on the
    /// nearer side goes into `below` or `above`.
    pub(super) fn least_near_kink(&self, z: f64, at: Place, sides: [&mut Option<Place>; 2]) -> Option<LeastGapPoint> {
        let [own, other] = self.patches.map(|patch| patch.surface().kinks());
        let near = |kink: &f64, roll: f64| (kink - roll).abs() <= NEARLY;
        let beside = if let Some(kink) = own.into_iter().flatten().find(|kink| near(kink, at.roll)) {
            self.beside(z, kink, false)
        } else {
            let kink = other.into_iter().flatten().find(|kink| near(kink, at.foot))?;
            let (u, _) = self.place_of_foot(z, kink, (at.roll, at.foot), self.rolls(0))?;
            self.beside(z, u, true)
        };
        let [below, above] = sides;
        match beside? {
            Beside::Least(point) => return Some(point),
            Beside::Rises(place) => *above = Some(place),
            Beside::Falls(place) => *below = Some(place),
        }
        None
    }

    /// The place of least gap between two, at which the gap falls and rises, if it is at a kink; where it is beside one
    /// the nearer of the two moves there.
    pub(super) fn least_at_kink(&self, z: f64, between: &mut [Place; 2]) -> Option<LeastGapPoint> {
        let [own, other] = self.patches.map(|patch| patch.surface().kinks());
        let own = own.into_iter().flatten().map(|kink| (kink, false));
        for (kink, of_other) in own.chain(other.into_iter().flatten().map(|kink| (kink, true))) {
            let [a, b] = *between;
            let found = if of_other {
                let is_passed = (a.foot - kink) * (b.foot - kink) < 0.0;
                is_passed.then(|| self.place_of_foot(z, kink, (a.roll, a.foot), [a.roll, b.roll])).flatten()
            } else {
                Some((kink, None))
            };
            let Some((u, _)) = found.filter(|(u, _)| u - BESIDE > a.roll && u + BESIDE < b.roll) else { continue };
            match self.beside(z, u, of_other)? {
                Beside::Least(point) => return Some(point),
                Beside::Rises(place) => between[1] = place,
                Beside::Falls(place) => between[0] = place,
            }
        }
        None
    }

    /// How the gap goes beside the place of a kink, the other profile's or the searched one's.
    fn beside(&self, z: f64, u: f64, of_other: bool) -> Option<Beside> {
        let [before, after] = [u - BESIDE, u + BESIDE];
        let below = self.sample([before, z])?;
        if below.slope >= 0.0 {
            return Some(Beside::Rises(Place::of(before, &below)));
        }
        let above = self.sample([after, z])?;
        if above.slope < 0.0 {
            return Some(Beside::Falls(Place::of(after, &above)));
        }
        let turns = of_other && (above.normal - below.normal).norm() > KINK;
        Some(Beside::Least(if turns { LeastGapPoint::OtherKink(u) } else { LeastGapPoint::Inside(u) }))
    }

    /// What a bracket of the slope's zero holds: a kink of the other flank, where its normal turns, or a smooth place.
    pub(super) fn between(&self, z: f64, [a, b]: [f64; 2]) -> Option<LeastGapPoint> {
        let normal = |u: f64| Some(self.patches[1].surface().normal(self.sample([u, z])?.foot));
        let turn = normal(b)? - normal(a)?;
        let middle = 0.5 * (a + b);
        Some(if turn.norm() > KINK { LeastGapPoint::OtherKink(middle) } else { LeastGapPoint::Inside(middle) })
    }
}
