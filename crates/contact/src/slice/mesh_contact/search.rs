//! Search for the points of smallest gap, and selection of those that become rows of the contact problem.

use crate::{FlankPair, Pose, slice::SliceHint};

use super::{MeshContact, PoseContact, pose_bin::PoseBin};

impl MeshContact {
    /// Deepest overlap of the flanks with the gears' frames at `poses`, mm; negative if they are apart. Teeth are
    /// undeformed except for the kept modes. With modes it overwrites the last evaluation.
    pub fn overlap(&mut self, poses: &[Pose; 2]) -> f64 {
        if self.modal.is_some() {
            self.stash();
            self.prepare(poses, None);
            return self.gaps.iter().fold(f64::MIN, |m, g| m.max(-g));
        }
        self.search_from_ends(poses);
        self.deepest()
    }

    /// Deepest overlap at the points found, mm.
    pub(super) fn deepest(&self) -> f64 {
        self.nearest.iter().fold(f64::MIN, |m, (_, p)| m.max(-p.gap()))
    }

    /// Largest gap that a row may have and still close, mm. Without modes it is the deepest overlap. Modes may close a
    /// gap by up to `by_modes` (mm) and open the point of the deepest overlap by as much.
    pub(super) fn reach(&self, by_modes: f64) -> f64 {
        let deepest = self.deepest();
        if self.modal.is_some() { deepest.abs() + 2.0 * (by_modes + self.sizes.linear_range) } else { deepest }
    }

    /// Finds the points of least gap from one end of the face to the other, each from its neighbours: along a contact
    /// line the roll angle is nearly linear in z. Earlier results are not used.
    pub(super) fn search_from_ends(&mut self, poses: &[Pose; 2]) {
        let Self { set, pairs, nearest, .. } = self;
        nearest.clear();
        let Some(slice_set) = set.slices() else { return };
        let patches = [&set.patches()[0][..], &set.patches()[1][..]];
        let stations = slice_set.stations();
        for (p, &numbers) in pairs.iter().enumerate() {
            let pair = FlankPair::new(slice_set.flanks(patches, numbers), poses);
            let [mut before, mut hint] = [SliceHint::default(); 2];
            for (i, &z) in stations.iter().enumerate() {
                let mut next = hint.beyond(&before);
                if let Some(point) = pair.nearest_point(z, &mut next) {
                    nearest.push((p * stations.len() + i, point));
                }
                (before, hint) = (hint, next);
            }
        }
    }

    /// Finds the points of least gap station by station, each from where it was at the last search; those with gaps wider
    /// than `reach` (mm) may be left out.
    pub(super) fn search_from_hints(&mut self, poses: &[Pose; 2], reach: f64) {
        let Self { set, pairs, hints, nearest, last_pose, .. } = self;
        nearest.clear();
        let Some(slice_set) = set.slices() else { return };
        let patches = [&set.patches()[0][..], &set.patches()[1][..]];
        let stations = slice_set.stations();
        let turned = last_pose.replace(poses[0]).map_or(0.0, |before| turn(&before, &poses[0]));
        for (p, &numbers) in pairs.iter().enumerate() {
            let pair = FlankPair::new(slice_set.flanks(patches, numbers), poses);
            let side = set.side(numbers.0).sign();
            for (i, &z) in stations.iter().enumerate() {
                let key = p * stations.len() + i;
                hints[key].turn(side, turned);
                if let Some(point) = pair.nearest_within(z, &mut hints[key], reach) {
                    nearest.push((key, point));
                }
            }
        }
    }

    /// Rows and their compliance with the gears' frames at `poses`. Rows have gaps of at most `reach` (mm); if it is
    /// `None`, of at most the deepest overlap.
    ///
    /// Without a free rotation no row is approached by more than the deepest overlap. Loads on other teeth close a gap
    /// by some per cent of that overlap, so rows with larger gaps stay open.
    pub fn prepare(&mut self, poses: &[Pose; 2], reach: Option<f64>) {
        self.search_from_hints(poses, reach.unwrap_or(f64::INFINITY));
        let by_modes = self.modal.as_ref().map_or(0.0, |modal| modal.largest());
        let reach = reach.unwrap_or_else(|| self.reach(by_modes));
        self.contact.bin = None;
        self.rows_within(poses, reach, None);
    }

    /// Rows at the points found whose gap is at most `reach` (mm), and their compliance. In a pose bin nothing is taken
    /// over from earlier searches.
    pub(super) fn rows_within(&mut self, poses: &[Pose; 2], reach: f64, bin: Option<&PoseBin>) {
        let Self { set, pairs, hints, nearest, contact, friction, .. } = self;
        let PoseContact { at, keys, rows, slices, .. } = contact;
        *at = Some(*poses);
        keys.clear();
        rows.clear();
        slices.clear();
        rows.reserve(nearest.len());
        slices.reserve(nearest.len());
        let Some(slice_set) = set.slices() else { return };
        let patches = [&set.patches()[0][..], &set.patches()[1][..]];
        let stations = slice_set.stations();
        let tabulated = slice_set.bulk().is_some();
        let pair_at = |pair| FlankPair::new(slice_set.flanks(patches, pair), poses);
        for of_pair in nearest.chunk_by(|a, b| a.0 / stations.len() == b.0 / stations.len()) {
            let numbers = pairs[of_pair[0].0 / stations.len()];
            let pair = pair_at(numbers);
            for (key, nearest) in of_pair.iter().filter(|(_, p)| p.gap() <= reach) {
                let point = key % stations.len();
                let candidate = pair.slice(nearest, numbers, point, slice_set.length());
                let Some((mut row, slice)) = candidate.filter(|(row, s)| row.gap <= reach && slice_set.may_touch(s))
                else {
                    continue;
                };
                // Tables of compliance do not use the nodes of a row.
                let mut anew = SliceHint::default();
                let hint = if bin.is_some() { &mut anew } else { &mut hints[*key] };
                if !tabulated && !pair.support(&mut row, &slice, hint) {
                    continue;
                }
                keys.push(*key);
                rows.push(friction.map_or(row, |f| f.on(poses, row)));
                slices.push(slice);
            }
        }
        contact.laws.take(contact.slices.iter().map(|s| (&s.local, s.length)));
        // How motion opens the rows is asked of bins alone.
        contact.update_openings(bin.is_some());
        let by_modes = match bin {
            Some(bin) => bin.reach(&self.sizes),
            None => self.modal.as_ref().map_or(0.0, |modal| modal.largest() + self.sizes.linear_range),
        };
        self.compliance(by_modes);
        self.add_modal_openings();
    }
}

/// How far a body has turned about its own axis, rad.
pub(super) fn turn(before: &Pose, now: &Pose) -> f64 {
    let q = (before.rotation.inverse() * now.rotation).into_inner();
    2.0 * q.k.atan2(q.w)
}
