//! Contact of the last rows after a small motion: new positions, gaps and compliance, old factor.
//!
//! A pose in a search for equilibrium differs from the preceding one by at most a thousandth of the approach. The rows
//! then stay the same, and the earlier factor can be used.

use crate::{FlankPair, Pose, complementarity::Balance};

use super::{MeshContact, PoseContact, problem, search::turn};

impl MeshContact {
    /// Moves the rows of the last solution to their positions with the gears' frames at `poses` and solves their
    /// contact. Returns whether this gives a solution with the same rows in contact. If not, call
    /// [`MeshContact::prepare`] and [`MeshContact::solve`].
    pub fn solve_moved(&mut self, poses: &[Pose; 2], balance: Balance, body: usize) -> bool {
        if self.modal.is_some() || !self.has_tables() || !self.move_rows(poses) {
            return false;
        }
        self.compliance(0.0);
        self.take_levers(body);
        let Self { contact, gaps, levers, torque_levers, solver, friction, .. } = self;
        let moved = problem(contact, gaps, [levers, torque_levers], friction.is_none(), balance);
        let solved = solver.solve_moved(&moved, &contact.laws);
        if solved {
            self.keep_forces();
        }
        solved
    }

    fn has_tables(&self) -> bool {
        self.set.slices().is_some_and(|slices| slices.bulk().is_some())
    }

    /// The rows at other poses; false where one of them is no row there.
    fn move_rows(&mut self, poses: &[Pose; 2]) -> bool {
        let Self { set, pairs, hints, last_pose, contact, friction, solver, gaps, .. } = self;
        let PoseContact { at, bin, keys, rows, slices, laws, .. } = contact;
        let Some(slice_set) = set.slices().filter(|_| at.is_some() && solver.forces().len() == rows.len()) else {
            return false;
        };
        (*at, *bin) = (Some(*poses), None);
        let patches = [&set.patches()[0][..], &set.patches()[1][..]];
        let stations = slice_set.stations();
        let turned = last_pose.replace(poses[0]).map_or(0.0, |before| turn(&before, &poses[0]));
        let mut first = 0;
        while first < keys.len() {
            let number = keys[first] / stations.len();
            let numbers = pairs[number];
            let pair = FlankPair::new(slice_set.flanks(patches, numbers), poses);
            let side = set.side(numbers.0).sign();
            let count = keys[first..].iter().take_while(|&key| key / stations.len() == number).count();
            for i in first..first + count {
                let (key, station) = (keys[i], keys[i] % stations.len());
                hints[key].turn(side, turned);
                let nearest = pair.nearest_point(stations[station], &mut hints[key]);
                let found = nearest.and_then(|point| pair.slice(&point, numbers, station, slice_set.length()));
                let Some((row, slice)) = found.filter(|(_, slice)| slice_set.may_touch(slice)) else { return false };
                rows[i] = friction.map_or(row, |f| f.on(poses, row));
                slices[i] = slice;
            }
            first += count;
        }
        laws.take(slices.iter().map(|s| (&s.local, s.length)));
        gaps.clear();
        gaps.extend(rows.iter().map(|r| r.gap));
        true
    }
}
