//! Two elastic bodies given by the compliance of their boundary nodes. Theory (18).

use faer::{Mat, MatRef, Side, linalg::solvers::Solve};

use crate::{
    ContactError,
    complementarity::{Equality, LinearContact, Problem},
    nodal::{ContactRow, Support},
};

/// Compliance of both bodies between the contact rows.
///
/// ```text
/// o_i = sum_j C_ij F_j,   C = sum over both bodies of A C_b A' + X
/// ```
/// X (mm/N) is an optional correction between rows: for slices it removes a part of the bodies' own compliance.
///
/// C_b (mm/N) is the body's boundary compliance (3 n x 3 n, node by node x, y, z), A are the supports of the rows. A
/// column C_b A'_j is computed when its row first becomes active, and is kept.
#[derive(Debug)]
pub struct Condensed<'a> {
    rows: &'a [ContactRow],
    compliance: [MatRef<'a, f64>; 2],
    columns: Vec<[Option<Vec<f64>>; 2]>,
    correction: Option<Mat<f64>>,
}

impl<'a> Condensed<'a> {
    /// Takes the bodies' boundary compliances and the contact rows.
    pub fn new(rows: &'a [ContactRow], compliance: [MatRef<'a, f64>; 2]) -> Self {
        Self { rows, compliance, columns: vec![[None, None]; rows.len()], correction: None }
    }

    /// Adds a symmetric correction X between rows, mm/N.
    #[must_use]
    pub fn corrected(self, correction: Option<Mat<f64>>) -> Self {
        Self { correction, ..self }
    }

    /// C_ij, mm/N.
    fn entry(&mut self, i: usize, j: usize) -> f64 {
        let bodies: f64 = (0..2)
            .map(|b| {
                self.prepare(j, b);
                self.columns[j][b].as_deref().map_or(0.0, |c| opening(&self.rows[i].supports[b], c))
            })
            .sum();
        bodies + self.correction.as_ref().map_or(0.0, |x| x[(i, j)])
    }

    /// C between all rows, column by column, mm/N.
    pub fn matrix(&mut self, out: &mut Vec<f64>) {
        let n = self.rows.len();
        out.clear();
        for j in 0..n {
            for i in 0..n {
                let entry = self.entry(i, j);
                out.push(entry);
            }
        }
    }

    fn prepare(&mut self, row: usize, body: usize) {
        if self.columns[row][body].is_none() {
            let mut column = vec![0.0; self.compliance[body].nrows()];
            load_columns(&self.rows[row].supports[body], |dof, f| {
                let source = self.compliance[body].col(dof);
                for (c, s) in column.iter_mut().zip(source.iter()) {
                    *c += f * s;
                }
            });
            self.columns[row][body] = Some(column);
        }
    }
}

/// Opening of a row by boundary displacements `u` (three per node), mm.
pub fn opening(support: &Support, u: &[f64]) -> f64 {
    let d = support.direction;
    (0..support.count)
        .map(|k| {
            let at = 3 * support.nodes[k] as usize;
            support.weights[k] * (d.x * u[at] + d.y * u[at + 1] + d.z * u[at + 2])
        })
        .sum()
}

/// Calls `add(boundary dof, force)` for a unit force at the row.
pub(crate) fn load_columns(support: &Support, mut add: impl FnMut(usize, f64)) {
    for k in 0..support.count {
        let at = 3 * support.nodes[k] as usize;
        for axis in 0..3 {
            let f = support.weights[k] * support.load[axis];
            if f != 0.0 {
                add(at + axis, f);
            }
        }
    }
}

/// Forces (N) on the `count` boundary coordinates of body `b` by forces on rows.
pub(crate) fn boundary_forces(rows: &[ContactRow], forces: &[f64], b: usize, count: usize) -> Vec<f64> {
    let mut load = vec![0.0; count];
    for (row, &f) in rows.iter().zip(forces) {
        if f != 0.0 {
            load_columns(&row.supports[b], |dof, w| load[dof] += f * w);
        }
    }
    load
}

impl LinearContact for Condensed<'_> {
    fn solve(&mut self, active: &[usize], problem: &Problem) -> Result<Equality, ContactError> {
        let n = active.len();
        for &j in active {
            self.prepare(j, 0);
            self.prepare(j, 1);
        }
        let friction = active.iter().any(|&i| self.rows[i].has_friction());
        let mut s = Mat::<f64>::zeros(n, n);
        for (b, &j) in active.iter().enumerate() {
            let [Some(first), Some(second)] = &self.columns[j] else { unreachable!("prepared above") };
            // Without friction the matrix is symmetric, and the lower half is enough.
            for (a, &i) in active.iter().enumerate().skip(if friction { 0 } else { b }) {
                let supports = &self.rows[i].supports;
                s[(a, b)] = opening(&supports[0], first)
                    + opening(&supports[1], second)
                    + self.correction.as_ref().map_or(0.0, |x| x[(i, j)]);
            }
            s[(b, b)] += problem.compliance[j];
        }
        let rhs = Mat::from_fn(n, 2, |a, k| if k == 0 { -problem.gaps[active[a]] } else { problem.levers[active[a]] });
        let x = if friction {
            s.partial_piv_lu().solve(&rhs)
        } else {
            s.llt(Side::Lower).map_err(|_| ContactError::NotPositiveDefinite { points: n })?.solve(&rhs)
        };
        let (mut carried, mut stiffness) = (0.0, 0.0);
        for (a, &i) in active.iter().enumerate() {
            carried += problem.torque_levers[i] * x[(a, 0)];
            stiffness += problem.torque_levers[i] * x[(a, 1)];
        }
        let rotation = if problem.held { 0.0 } else { (carried - problem.moment) / stiffness };
        let forces: Vec<f64> = (0..n).map(|a| x[(a, 0)] - rotation * x[(a, 1)]).collect();
        let mut all = vec![0.0; self.rows.len()];
        active.iter().zip(&forces).for_each(|(&i, &f)| all[i] = f);
        let [u1, u2] = self.displacements(&all);
        let mut openings: Vec<f64> =
            self.rows.iter().map(|r| opening(&r.supports[0], &u1) + opening(&r.supports[1], &u2)).collect();
        if let Some(x) = &self.correction {
            for &j in active {
                openings.iter_mut().zip(x.col(j).iter()).for_each(|(o, c)| *o += c * all[j]);
            }
        }
        Ok(Equality { forces, rotation, openings, stiffness })
    }

    fn self_compliance(&mut self) -> Result<f64, ContactError> {
        let step = (self.rows.len() / 16).max(1);
        let sampled: Vec<usize> = (0..self.rows.len()).step_by(step).collect();
        Ok(sampled.iter().map(|&i| self.entry(i, i)).sum::<f64>() / sampled.len() as f64)
    }

    fn displacements(&self, forces: &[f64]) -> [Vec<f64>; 2] {
        [0, 1].map(|b| {
            let load = boundary_forces(self.rows, forces, b, self.compliance[b].nrows());
            let mut u = vec![0.0; load.len()];
            for (dof, &f) in load.iter().enumerate() {
                if f != 0.0 {
                    for (u, c) in u.iter_mut().zip(self.compliance[b].col(dof).iter()) {
                        *u += f * c;
                    }
                }
            }
            u
        })
    }
}
