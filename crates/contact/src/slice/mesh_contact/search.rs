//! Where the flanks are nearest, and which of these places are rows of the contact.

use crate::{FlankPair, Pose, SliceHint};

use super::{Found, MeshContact, NEAR, cell::Cell};

impl MeshContact {
    /// Deepest overlap of the flanks with the gears' frames at `poses`, mm; negative where they are apart. Undeformed but for the kept modes, and with these it is
    /// the last evaluation that is lost.
    pub fn overlap(&mut self, poses: &[Pose; 2]) -> f64 {
        if self.modal.is_some() {
            self.leave();
            self.prepare(poses, None);
            return self.gaps.iter().fold(f64::MIN, |m, g| m.max(-g));
        }
        self.find_places_from_ends(poses);
        self.deepest()
    }

    /// Deepest overlap at the places found, mm.
    fn deepest(&self) -> f64 {
        self.places.iter().fold(f64::MIN, |m, (_, p)| m.max(-p.gap()))
    }

    /// Gap up to which a row at the places found may close, mm: the deepest overlap; modes may close a gap by up to `by_modes`, mm,
    /// and open the one that would be the deepest overlap.
    pub(super) fn reach(&self, by_modes: f64) -> f64 {
        let deepest = self.deepest();
        if self.modal.is_some() { deepest.abs() + 2.0 * (by_modes + NEAR) } else { deepest }
    }

    /// Where the flanks are nearest, from station to station: a contact line is straight along the roll angle, or nearly so. Nothing that was found before counts.
    pub(super) fn find_places_from_ends(&mut self, poses: &[Pose; 2]) {
        let Self { set, pairs, places, .. } = self;
        places.clear();
        let Some(of_window) = set.slices() else { return };
        let patches = [&set.patches()[0][..], &set.patches()[1][..]];
        let stations = of_window.stations();
        for (p, &numbers) in pairs.iter().enumerate() {
            let pair = FlankPair::new(of_window.flanks(patches, numbers), poses);
            let [mut before, mut hint] = [SliceHint::default(); 2];
            for (i, &z) in stations.iter().enumerate() {
                let mut next = hint.beyond(&before);
                if let Some(place) = pair.place(z, &mut next) {
                    places.push((p * stations.len() + i, place));
                }
                (before, hint) = (hint, next);
            }
        }
    }

    /// Where the flanks are nearest, station by station, from where they were nearest before.
    fn find_places(&mut self, poses: &[Pose; 2]) {
        let Self { set, pairs, hints, places, stood, .. } = self;
        places.clear();
        let Some(of_window) = set.slices() else { return };
        let patches = [&set.patches()[0][..], &set.patches()[1][..]];
        let stations = of_window.stations();
        let turned = stood.replace(poses[0]).map_or(0.0, |before| turn(&before, &poses[0]));
        for (p, &numbers) in pairs.iter().enumerate() {
            let pair = FlankPair::new(of_window.flanks(patches, numbers), poses);
            let side = set.side(numbers.0).sign();
            for (i, &z) in stations.iter().enumerate() {
                let key = p * stations.len() + i;
                hints[key].turn(side, turned);
                if let Some(place) = pair.place(z, &mut hints[key]) {
                    places.push((key, place));
                }
            }
        }
    }

    /// Rows and their compliance with the gears' frames at `poses`: gaps up to `reach` (mm), or as far as the flanks overlap.
    ///
    /// When nothing turns, no row is approached by more than the deepest overlap: loads on other teeth close a gap by some per cent of it at most, so rows that gape by
    /// more stay open.
    pub fn prepare(&mut self, poses: &[Pose; 2], reach: Option<f64>) {
        self.find_places(poses);
        let by_modes = self.modal.as_ref().map_or(0.0, |modal| modal.largest());
        let reach = reach.unwrap_or_else(|| self.reach(by_modes));
        self.found.cell = None;
        self.rows_within(poses, reach, None);
    }

    /// Rows of the places found that are no farther apart than `reach`, mm, and their compliance; those of a cell take nothing over from before.
    pub(super) fn rows_within(&mut self, poses: &[Pose; 2], reach: f64, cell: Option<&Cell>) {
        let Self { set, pairs, hints, places, found, friction, .. } = self;
        let Found { at, keys, rows, slices, .. } = found;
        *at = Some(*poses);
        keys.clear();
        rows.clear();
        slices.clear();
        let Some(of_window) = set.slices() else { return };
        let patches = [&set.patches()[0][..], &set.patches()[1][..]];
        let stations = of_window.stations();
        let tabulated = of_window.bulk().is_some();
        let pair_at = |pair| FlankPair::new(of_window.flanks(patches, pair), poses);
        for of_pair in places.chunk_by(|a, b| a.0 / stations.len() == b.0 / stations.len()) {
            let numbers = pairs[of_pair[0].0 / stations.len()];
            let pair = pair_at(numbers);
            for (key, place) in of_pair.iter().filter(|(_, place)| place.gap() <= reach) {
                let point = key % stations.len();
                let made = pair.slice(place, numbers, point, of_window.length());
                let Some((mut row, slice)) = made.filter(|(row, s)| row.gap <= reach && of_window.may_touch(s)) else {
                    continue;
                };
                // Tables do not ask which nodes a row rests on.
                let mut anew = SliceHint::default();
                let hint = if cell.is_some() { &mut anew } else { &mut hints[*key] };
                if !tabulated && !pair.support(&mut row, &slice, hint) {
                    continue;
                }
                keys.push(*key);
                rows.push(friction.map_or(row, |f| f.on(poses, row)));
                slices.push(slice);
            }
        }
        found.laws.clear();
        found.laws.extend(found.slices.iter().map(|s| s.local.law()));
        found.settle();
        let by_modes = match cell {
            Some(cell) => cell.reach(),
            None => self.modal.as_ref().map_or(0.0, |modal| modal.largest() + NEAR),
        };
        self.compliance(by_modes);
        self.bend();
    }
}

/// How far a body has turned about its own axis, rad.
fn turn(before: &Pose, now: &Pose) -> f64 {
    let q = (before.rotation.inverse() * now.rotation).into_inner();
    2.0 * q.k.atan2(q.w)
}
