//! Response of the solution to a change of its conditions.

use contact::{ContactSet, TableWork};
use faer::{Mat, linalg::solvers::PartialPivLu, prelude::Solve};

use super::{Conditions, PositionRates, Rates, Sensitivity};
use crate::{Equilibrium, WindowedPair};

/// Response of both gears: compliance of the rows, effect of the rotation, levers.
pub(super) struct Directions<'a> {
    at: &'a Conditions,
    turned: &'a Rates,
    /// dR/dF of all rows, mm/N.
    compliance: Mat<f64>,
    torque_levers: Vec<f64>,
    /// System of the rows in contact.
    pressing: Pressing,
}

/// Rows that press, the factor of their compliance, and forces that a turn of the driven gear takes away, below and above.
struct Pressing {
    rows: Vec<usize>,
    factor: PartialPivLu<f64>,
    turned: [Vec<f64>; 2],
}

/// Rates of forces (N, a row each) and of the rotation (rad).
struct Answer {
    forces: Vec<f64>,
    rotation: f64,
}

impl Pressing {
    fn new(presses: &[bool], compliance: &Mat<f64>, turned: &Rates) -> Self {
        let rows: Vec<usize> = (0..presses.len()).filter(|&i| presses[i]).collect();
        let m = rows.len();
        let factor = Mat::from_fn(m, m, |i, j| compliance[(rows[i], rows[j])]).partial_piv_lu();
        let mut own = Self { rows, factor, turned: Default::default() };
        own.turned = [0, 1].map(|side| own.solve(|row| turned.distances[row][side]));
        own
    }

    /// Forces that open the rows by so much.
    fn solve(&self, opening: impl Fn(usize) -> f64) -> Vec<f64> {
        let mut found = Mat::from_fn(self.rows.len(), 1, |i, _| opening(self.rows[i]));
        self.factor.solve_in_place(&mut found);
        found.col(0).iter().copied().collect()
    }
}

impl<'a> Directions<'a> {
    pub fn new(windowed: &WindowedPair, at: &'a Conditions, turned: &'a Rates, work: &mut [TableWork]) -> Self {
        let set: &ContactSet = windowed.set;
        let driven = windowed.options.driven();
        let torque_levers = at.slices.rows.iter().map(|row| row.torque_levers[driven]).collect();
        let compliance = at.slices.compliance(set, &at.forces, work);
        let pressing = Pressing::new(&at.presses, &compliance, turned);
        Self { at, turned, compliance, torque_levers, pressing }
    }

    /// Answer of the rows that press, the other forces held at 0.
    ///
    /// ```text
    /// A dF + R_theta dtheta + R_p = 0,   l . dF + M_theta dtheta + M_p = 0
    /// dtheta = (M_p - l . A^-1 R_p) / (l . A^-1 R_theta - M_theta)
    /// ```
    fn answer(&self, pressing: &Pressing, by_rotation: usize, rates: &Rates, side: usize) -> Option<Answer> {
        let own = pressing.solve(|row| rates.distances[row][side]);
        let turned = &pressing.turned[by_rotation];
        let torque =
            |of: &[f64]| pressing.rows.iter().zip(of).map(|(&row, f)| self.torque_levers[row] * f).sum::<f64>();
        let rotation = (rates.moment[side] - torque(&own)) / (torque(turned) - self.turned.moment[by_rotation]);
        let mut forces = vec![0.0; self.at.forces.len()];
        for (&row, (turned, own)) in pressing.rows.iter().zip(turned.iter().zip(&own)) {
            forces[row] = -(turned * rotation + own);
        }
        rotation.is_finite().then_some(Answer { forces, rotation })
    }

    /// Turn of the driven gear (rad) by the gap (mm) of each row that presses; 0 of the others.
    ///
    /// ```text
    /// dtheta/dg = -A^-T l / (l . A^-1 R_theta - M_theta)
    /// ```
    /// (77) with R_p = dg, the mean of both directions.
    pub fn turns_by_gap(&self) -> Vec<f64> {
        let Pressing { rows, factor, turned } = &self.pressing;
        let mut carried = Mat::from_fn(rows.len(), 1, |i, _| self.torque_levers[rows[i]]);
        factor.solve_transpose_in_place(&mut carried);
        let resists = |side: usize| {
            let torque: f64 = rows.iter().zip(&turned[side]).map(|(&row, f)| self.torque_levers[row] * f).sum();
            torque - self.turned.moment[side]
        };
        let per_gap = 0.5 * (1.0 / resists(0) + 1.0 / resists(1));
        let mut all = vec![0.0; self.at.forces.len()];
        rows.iter().zip(carried.col(0).iter()).for_each(|(&row, y)| all[row] = -per_gap * y);
        all
    }

    /// Answer in one direction (side 0: as the parameter falls): rows that are about to touch or to leave press if they
    /// are pressed on, and kinks of the rotation count on the side that it turns to.
    fn in_direction(&self, rates: &Rates, side: usize) -> Option<Answer> {
        let sign = [-1.0, 1.0][side];
        let mut presses: Vec<bool> = self.at.presses.clone();
        let mut by_rotation = side;
        let mut answer = None;
        let mut changed: Option<Pressing> = None;
        for _ in 0..2 + 2 * self.at.undecided.len() {
            let pressing = changed.as_ref().unwrap_or(&self.pressing);
            let found = self.answer(pressing, by_rotation, rates, side)?;
            let rows = &pressing.rows;
            let turns_to = usize::from(found.rotation * sign > 0.0);
            // The row that is most against what it does changes over; one at a time comes to an end.
            let against = |&&i: &&usize| {
                if presses[i] {
                    sign * found.forces[i] < 0.0
                } else {
                    let opens: f64 = rows.iter().map(|&j| self.compliance[(i, j)] * found.forces[j]).sum();
                    let by = self.turned.distances[i][by_rotation] * found.rotation + rates.distances[i][side];
                    sign * (opens + by) < 0.0
                }
            };
            let changes = self.at.undecided.iter().find(against).copied();
            let settled = turns_to == by_rotation && changes.is_none();
            answer = Some(found);
            if settled {
                break;
            }
            by_rotation = turns_to;
            if let Some(i) = changes {
                presses[i] = !presses[i];
                changed = Some(Pressing::new(&presses, &self.compliance, self.turned));
            }
        }
        answer
    }

    /// Derivatives of a position.
    pub fn follow(
        &self,
        windowed: &WindowedPair,
        e: &Equilibrium,
        rates: &Rates,
        kinematic: [f64; 2],
    ) -> Option<Sensitivity> {
        let of_side = |side: usize| self.position(windowed, e, rates, (side, kinematic[side]));
        let kinked = |all: &Rates| all.distances.iter().any(|[a, b]| a != b);
        let is_smooth = self.at.undecided.is_empty() && !kinked(self.turned) && !kinked(rates);
        let below = of_side(0)?;
        let same = is_smooth && kinematic[0].to_bits() == kinematic[1].to_bits() && rates.is_smooth();
        let above = if same && self.turned.is_smooth() { below.clone() } else { of_side(1)? };
        Some(Sensitivity {
            sides: [below, above],
            // None where nothing of the unloaded pair is asked.
            is_smooth: is_smooth && (kinematic[0] == kinematic[1] || kinematic[0].is_nan()),
        })
    }

    fn position(
        &self,
        windowed: &WindowedPair,
        e: &Equilibrium,
        rates: &Rates,
        (side, kinematic): (usize, f64),
    ) -> Option<PositionRates> {
        let WindowedPair { pair, set, window, options, .. } = *windowed;
        let Answer { forces, rotation } = self.in_direction(rates, side)?;
        let base_radius = [pair.pinion.base_radius(), pair.wheel.base_radius()][options.driven()];
        let error = options.side().sign() * base_radius * rotation;
        let stiffness = options.base_force(pair) / e.elastic_error();
        let [max_pressure, max_edge_pressure] = [0, 1].map(|k| {
            let by_force = match self.at.hardest[k] {
                // The pressure of Hertz grows with the root of the force.
                Some(row) if self.at.forces[row] > 0.0 => 0.5 * self.at.pressure[k] / self.at.forces[row] * forces[row],
                _ => 0.0,
            };
            by_force + self.turned.pressure[k][side] * rotation + rates.pressure[k][side]
        });
        let of_pair = |k: usize| {
            let own = |(row, _): &(&contact::nodal::ContactRow, &f64)| set.pair_of(row.patches.0) == k;
            self.at.slices.rows.iter().zip(&forces).filter(own).map(|(_, f)| f).sum::<f64>()
        };
        let mut pair_forces: Vec<(i64, f64)> = (0..window.count())
            .map(|k| (options.contact.sense.sign() * (window.first() + k as i64), of_pair(k)))
            .collect();
        pair_forces.sort_by_key(|(number, _)| *number);
        Some(PositionRates {
            transmission_error: error,
            kinematic_transmission_error: kinematic,
            secant_stiffness: (rates.load - stiffness * (error - kinematic)) / e.elastic_error(),
            max_pressure,
            max_edge_pressure,
            pair_forces: pair_forces.into_iter().map(|(_, rate)| rate).collect(),
        })
    }
}
