//! Changes of slices under constant forces by small changes of flanks and poses, for several changes at once. Theory
//! (77a).

use geometry::modification::DepthRate;

use super::{
    SameSlices, Slice, SliceHint,
    flank_pair::FlankPair,
    mesh_contact::places,
    smooth_slice::{BESIDE, Motion, RowMotion, RowRate, SmoothSlice},
};
use crate::{
    BulkTable, ContactSet, Friction, Pose, Vec3,
    compliance::{PointRate, RateWork, Reading, parts},
    flank::FlankPatch,
    local::LocalLaws,
    nodal::{ContactRow, levers},
};

/// Derivatives of the depths of both gears' flanks, patch by patch; `None` where nothing changes.
#[derive(Debug, Default)]
pub struct FlankRates([Vec<Option<DepthRate>>; 2]);

impl FlankRates {
    /// Derivatives from three sets of flanks: with less of a parameter, as they are, and with more. `steps` are the two
    /// differences of the parameter, both above 0.
    pub fn between(sets: [&ContactSet; 3], steps: [f64; 2]) -> Self {
        let of_patch = |b: usize, i: usize| {
            let flanks = sets.map(|set| set.patches()[b].get(i).and_then(|patch| patch.surface().modified_flank()));
            let [Some(less), Some(here), Some(more)] = flanks else { return None };
            DepthRate::between([less, here, more], steps)
        };
        Self([0, 1].map(|b| (0..sets[1].patches()[b].len()).map(|i| of_patch(b, i)).collect()))
    }

    fn of(&self, patches: (usize, usize)) -> [Option<&DepthRate>; 2] {
        let number = [patches.0, patches.1];
        [0, 1].map(|b| self.0[b].get(number[b]).and_then(Option::as_ref))
    }
}

/// A small change of a pair in both directions.
#[derive(Debug, Clone, Copy)]
pub struct FlankChange<'a> {
    /// Flanks with less and with more of the parameter.
    pub sets: [&'a ContactSet; 2],
    /// Poses of both gears' frames with less and with more of the parameter.
    pub poses: [[Pose; 2]; 2],
    /// Friction with less and with more of the parameter.
    pub friction: [Option<Friction>; 2],
    /// Steps down and up, both above 0.
    pub steps: [f64; 2],
    /// Derivatives of the flanks' depths.
    pub depths: &'a FlankRates,
}

/// Derivatives, in both directions, of the slices' state under constant forces, per unit of the change.
#[derive(Debug, Clone)]
pub struct ChangeRates {
    /// Derivative of the distances R of [`SameSlices::compliance`], mm, row by row.
    pub distances: Vec<[f64; 2]>,
    /// Derivative of the moment of the forces about a gear's axis, N mm.
    pub moment: [f64; 2],
    /// Derivative of the largest pressures of several rows, MPa.
    pub pressures: [[f64; 2]; 2],
}

/// Slices of a solved contact with constant forces.
#[derive(Debug, Clone, Copy)]
pub struct HeldForces<'a> {
    /// Flanks and matrices.
    pub set: &'a ContactSet,
    /// Poses of the gears' frames.
    pub poses: &'a [Pose; 2],
    /// Friction, if any.
    pub friction: Option<&'a Friction>,
    /// The slices of the contact.
    pub slices: &'a SameSlices,
    /// Forces of the slices, N.
    pub forces: &'a [f64],
    /// Gear about whose axis moments are computed.
    pub body: usize,
    /// Rows whose pressures are wanted.
    pub pressed: [Option<usize>; 2],
}

/// Rates of all rows by a change: where any of them has other ones either way, both ways.
type RowRates = Vec<Vec<RowRate>>;

impl HeldForces<'_> {
    /// Derivatives by several changes; `None` if a slice is not on the changed flanks.
    ///
    /// ```text
    /// R_i = g_i + (C f)_i + delta_i(f_i)
    /// dR = dg + dC f + d delta,   all by what place, directions and curvature of each slice do
    /// ```
    /// Between smooth flanks these derivatives follow from the geometry in closed form. Slices on edges and kinks are
    /// searched again on both sides.
    pub fn rates(&self, changes: &[FlankChange<'_>]) -> Option<Vec<ChangeRates>> {
        let slice_set = self.set.slices()?;
        let patches = [&self.set.patches()[0][..], &self.set.patches()[1][..]];
        let SameSlices { rows, slices } = self.slices;
        let (mut smooth, mut beside, mut forces) = (Vec::new(), Vec::new(), Vec::new());
        let mut from = 0;
        for of_pair in rows.chunk_by(|a, b| a.patches == b.patches) {
            let pair = FlankPair::new(slice_set.flanks(patches, of_pair[0].patches), self.poses);
            for (i, row) in (from..).zip(of_pair) {
                let found = SmoothSlice::new(&pair, self.poses, row, &slices[i]);
                if let Some(found) = &found {
                    let all = found.beside(&pair, &slices[i].local);
                    beside.extend(all.map(|local| (local, slices[i].length)));
                    forces.extend([self.forces[i]; BESIDE]);
                }
                smooth.push(found);
            }
            from += of_pair.len();
        }
        let mut laws = LocalLaws::default();
        laws.take(beside.iter().map(|(local, length)| (local, *length)));
        let [mut approaches, mut slopes] = [vec![0.0; forces.len()], vec![0.0; forces.len()]];
        laws.linearise(&forces, &mut approaches, &mut slopes);
        let known = Known { smooth, approaches: approaches.as_chunks().0, pressures: self.pressures() };
        let all = changes.iter().map(|change| self.row_rates(change, &known)).collect::<Option<Vec<_>>>()?;
        let columns: Vec<(&Vec<RowRate>, f64)> = all
            .iter()
            .zip(changes)
            .flat_map(|(rates, change)| rates.iter().map(move |rows| (rows, change.steps[0].min(change.steps[1]))))
            .collect();
        let mut opened = self.compliance_rates(&columns)?.into_iter();
        Some(all.iter().map(|rates| self.change_rates(rates, &mut opened)).collect())
    }

    /// Largest pressures of the rows that are followed, MPa; 0 of the others.
    fn pressures(&self) -> Vec<f64> {
        let mut all = vec![0.0; self.forces.len()];
        for row in self.pressed.into_iter().flatten() {
            all[row] = self.slices.pressure(row, self.forces[row]);
        }
        all
    }

    fn row_rates(&self, change: &FlankChange<'_>, known: &Known<'_>) -> Option<RowRates> {
        let rows = &self.slices.rows;
        let motions = motions(change);
        let mut both: [Vec<RowRate>; 2] = [0, 1].map(|_| Vec::with_capacity(rows.len()));
        let mut is_one_sided = false;
        let mut approaches = known.approaches.iter();
        for (i, row) in rows.iter().enumerate() {
            let of_smooth = known.smooth[i].as_ref().and_then(|smooth| {
                let beside = approaches.next()?;
                // Forces below 0 are none of the law's.
                let beside = if self.forces[i] > 0.0 { beside } else { &[0.0; BESIDE] };
                let depths = change.depths.of(row.patches);
                let (rate, motion) = smooth.rate(&motions, depths, beside, known.pressures[i])?;
                Some(self.with_friction(change, &motions, (smooth, row), rate, &motion))
            });
            let [below, above] = match of_smooth {
                Some(rate) => [rate; 2],
                None => {
                    is_one_sided = true;
                    self.differences(change, i)?
                }
            };
            both[0].push(below);
            both[1].push(above);
        }
        let [below, above] = both;
        Some(if is_one_sided { vec![below, above] } else { vec![below] })
    }

    /// The rates of a row of which friction turns the load.
    fn with_friction(
        &self,
        change: &FlankChange<'_>,
        motions: &[Motion; 2],
        (smooth, row): (&SmoothSlice, &ContactRow),
        rate: RowRate,
        motion: &RowMotion,
    ) -> RowRate {
        if self.friction.is_none() && change.friction.iter().all(Option::is_none) {
            return rate;
        }
        let [down, up] = change.steps;
        let at = |side: usize| {
            let by = [-down, up][side];
            let (position, normal) = (row.position + by * motion.position, row.normal + by * motion.normal);
            let normal = normal.normalize();
            let poses = &change.poses[side];
            let torque_levers = levers(poses, &position, &normal);
            let moved = ContactRow { position, normal, traction: normal, torque_levers, ..*row };
            change.friction[side].as_ref().map_or(moved, |friction| friction.on(poses, moved))
        };
        let [less, more] = [at(0), at(1)];
        let traction = (more.traction - less.traction) / (down + up);
        let lever = |b: usize| (more.torque_levers[b] - less.torque_levers[b]) / (down + up);
        let loads = [0, 1].map(|b| smooth.parts_rate(b, motions, motion, [&row.traction, &traction]));
        RowRate { loads, levers: [lever(0), lever(1)], ..rate }
    }

    /// Rates of a row below and above, by searches.
    fn differences(&self, change: &FlankChange<'_>, i: usize) -> Option<[RowRate; 2]> {
        let (row, slice) = (&self.slices.rows[i], &self.slices.slices[i]);
        let state = |set: &ContactSet, row: &ContactRow, slice: &Slice| {
            let law = slice.local.under(self.forces[i].max(0.0) / slice.length);
            let own = |b: usize| &set.patches()[b][[row.patches.0, row.patches.1][b]];
            let along = |b: usize, direction: &Vec3| parts(own(b), slice.at[b], direction);
            RowRate {
                gap: row.gap,
                at: slice.at,
                openings: [0, 1].map(|b| along(b, &row.supports[b].direction)),
                loads: [0, 1].map(|b| along(b, &row.supports[b].load)),
                levers: row.torque_levers,
                approach: if self.forces[i] > 0.0 { law.approach } else { 0.0 },
                pressure: law.pressure,
            }
        };
        let beside = |side: usize| {
            let (set, poses) = (change.sets[side], &change.poses[side]);
            let slice_set = set.slices()?;
            let patches = [&set.patches()[0][..], &set.patches()[1][..]];
            let pair = FlankPair::new(slice_set.flanks(patches, row.patches), poses);
            let point = pair.nearest_point(slice.z, &mut SliceHint::near(slice.at[0][0]))?;
            let (row, slice) = pair.slice(&point, row.patches, row.point, slice_set.length())?;
            let row = change.friction[side].as_ref().map_or(row, |friction| friction.on(poses, row));
            slice_set.may_touch(&slice).then(|| state(set, &row, &slice))
        };
        let (less, here, more) = (beside(0)?, state(self.set, row, slice), beside(1)?);
        Some([less.to(&here, change.steps[0]), here.to(&more, change.steps[1])])
    }

    /// Rates of C f, column by column; with a step that each column serves for.
    fn compliance_rates(&self, columns: &[(&Vec<RowRate>, f64)]) -> Option<Vec<Vec<f64>>> {
        let slice_set = self.set.slices()?;
        let SameSlices { rows, slices } = self.slices;
        let Some(tables) = slice_set.bulk() else {
            return columns.iter().map(|(rates, step)| self.exact_rates(rates, *step)).collect();
        };
        let mut out = vec![vec![0.0; rows.len()]; columns.len()];
        let mut work = RateWork::default();
        let symmetric = rows.iter().all(|row| row.traction == row.normal)
            && columns.iter().all(|(rates, _)| rates.iter().all(|rate| rate.loads == rate.openings));
        let (mut openings, mut loads) = (Vec::new(), Vec::new());
        for (b, table) in tables.iter().enumerate() {
            places(self.set, (b, table), (rows, slices), &mut openings, false);
            let of_points = |points: &[crate::TablePoint], of: fn(&RowRate) -> &[[f64; 3]; 2]| {
                let of_column = |(rates, _): &(&Vec<RowRate>, f64)| -> Option<Vec<PointRate>> {
                    let of_row = |i: usize| {
                        let patch = [rows[i].patches.0, rows[i].patches.1][b];
                        let place = (patch, slices[i].at[b], &points[i]);
                        BulkTable::rate(table, place, rates[i].at[b], of(&rates[i])[b])
                    };
                    (0..rows.len()).map(of_row).collect()
                };
                columns.iter().map(of_column).collect::<Option<Vec<_>>>()
            };
            let opening_rates = of_points(&openings, |rate| &rate.openings)?;
            let held = (&openings[..], self.forces);
            if symmetric {
                table.add_rates(held, held, &opening_rates, Reading::Both, &mut work, &mut out);
                continue;
            }
            places(self.set, (b, table), (rows, slices), &mut loads, true);
            let load_rates = of_points(&loads, |rate| &rate.loads)?;
            let loaded = (&loads[..], self.forces);
            table.add_rates(loaded, held, &opening_rates, Reading::Field, &mut work, &mut out);
            table.add_rates(held, loaded, &load_rates, Reading::Loads, &mut work, &mut out);
        }
        Some(out)
    }

    /// Rates of C f from the matrices themselves: differences between rows a step to either side.
    fn exact_rates(&self, rates: &[RowRate], step: f64) -> Option<Vec<f64>> {
        let SameSlices { rows, slices } = self.slices;
        let n = rows.len();
        let opened = |by: f64| {
            let moved = |((row, slice), rate): ((&ContactRow, &Slice), &RowRate)| {
                let mut row = *row;
                for (b, support) in row.supports.iter_mut().enumerate() {
                    let patch: &FlankPatch = &self.set.patches()[b][[row.patches.0, row.patches.1][b]];
                    let at = [0, 1].map(|k| slice.at[b][k] + by * rate.at[b][k]);
                    let [normal, along] = patch.surface().nominal_frame(at);
                    let frame = [normal, along, normal.cross(&along)];
                    let turned = |direction: &Vec3, rate: &[f64; 3]| -> Vec3 {
                        let parts = parts(patch, slice.at[b], direction);
                        (0..3).map(|k| frame[k] * (parts[k] + by * rate[k])).sum()
                    };
                    (support.direction, support.load) =
                        (turned(&support.direction, &rate.openings[b]), turned(&support.load, &rate.loads[b]));
                    support.rest_on(patch, patch.nearest_face_from(at, None)?);
                }
                Some(row)
            };
            let rows = rows.iter().zip(slices).zip(rates).map(moved).collect::<Option<Vec<_>>>()?;
            let mut matrix = vec![0.0; n * n];
            self.set.exact_compliance(&rows, &mut matrix);
            let mut sum = vec![0.0; n];
            for (column, f) in matrix.chunks(n.max(1)).zip(self.forces) {
                sum.iter_mut().zip(column).for_each(|(s, c)| *s += c * f);
            }
            Some(sum)
        };
        let (less, more) = (opened(-step)?, opened(step)?);
        Some(less.iter().zip(&more).map(|(a, b)| (b - a) / (2.0 * step)).collect())
    }

    /// The rates of a change, with the next columns of those of C f.
    fn change_rates(&self, rates: &RowRates, opened: &mut impl Iterator<Item = Vec<f64>>) -> ChangeRates {
        let sides: Vec<Side> = rates.iter().zip(opened).collect();
        let both = |of: &dyn Fn(&Side) -> f64| {
            let below = sides.first().map_or(0.0, of);
            [below, sides.get(1).map_or(below, of)]
        };
        let distance = |i: usize| both(&|(rates, opened)| rates[i].gap + rates[i].approach + opened[i]);
        let moment = |rates: &[RowRate]| rates.iter().zip(self.forces).map(|(r, f)| r.levers[self.body] * f).sum();
        ChangeRates {
            distances: (0..self.forces.len()).map(distance).collect(),
            moment: both(&|(rates, _)| moment(rates)),
            pressures: self.pressed.map(|row| row.map_or([0.0; 2], |i| both(&|(rates, _)| rates[i].pressure))),
        }
    }
}

/// What all changes have in common.
struct Known<'a> {
    smooth: Vec<Option<SmoothSlice>>,
    /// Approaches beside the smooth slices in turn, mm.
    approaches: &'a [[f64; BESIDE]],
    /// Pressures of the rows that are followed, MPa.
    pressures: Vec<f64>,
}

/// Rates of the rows towards one side of a change, and the part of their openings by the compliance.
type Side<'a> = (&'a Vec<RowRate>, Vec<f64>);

/// Motions of both bodies per unit of a change.
fn motions(change: &FlankChange<'_>) -> [Motion; 2] {
    let step = change.steps[0] + change.steps[1];
    let [less, more] = &change.poses;
    [0, 1].map(|b| Motion {
        shift: (more[b].translation.vector - less[b].translation.vector) / step,
        turn: (more[b].rotation * less[b].rotation.inverse()).scaled_axis() / step,
    })
}

impl RowRate {
    /// What leads from one to another, over `step`.
    fn to(&self, other: &Self, step: f64) -> Self {
        let by = |of: fn(&Self) -> f64| (of(other) - of(self)) / step;
        let all = |of: fn(&Self) -> &[[f64; 3]; 2]| {
            let (from, to) = (of(self), of(other));
            [0, 1].map(|b| std::array::from_fn(|k| (to[b][k] - from[b][k]) / step))
        };
        Self {
            gap: by(|r| r.gap),
            at: [0, 1].map(|b| [0, 1].map(|k| (other.at[b][k] - self.at[b][k]) / step)),
            openings: all(|r| &r.openings),
            loads: all(|r| &r.loads),
            levers: [by(|r| r.levers[0]), by(|r| r.levers[1])],
            approach: by(|r| r.approach),
            pressure: by(|r| r.pressure),
        }
    }
}
