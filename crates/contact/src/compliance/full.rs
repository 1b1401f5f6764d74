//! Contact between two gears with all their degrees of freedom.

use crate::{
    ContactError,
    complementarity::{Equality, LinearContact, Problem},
    nodal::{ContactRow, Support},
};
use faer::Mat;
use fem::{IndefiniteFactor, SymmetricMatrix};

use reduction::FullGear;

/// Contact of whole gears; the tangent of the system with contact is assembled, ordered and factored at every call, as
/// a general finite-element code does in each Newton step.
///
/// ```text
/// [ K   -A'   0 ] [ u      ]   [ 0  ]
/// [-A   -D   -l ] [ F      ] = [ g0 ]
/// [ 0   -l'   0 ] [ dtheta ]   [ -M ]
/// ```
/// Bodies that stand still have neither the last row nor the last column. K stiffness of both gears, A openings of the
/// active rows, D their own compliance and correction, l their levers.
#[derive(Debug)]
pub(crate) struct FullContact<'a> {
    rows: &'a [ContactRow],
    gears: [&'a FullGear; 2],
    displacements: [Vec<f64>; 2],
    correction: Option<Mat<f64>>,
}

impl<'a> FullContact<'a> {
    /// Contact of `rows` between two whole gears; `correction` is added to the compliance between rows, mm/N.
    pub fn new(rows: &'a [ContactRow], gears: [&'a FullGear; 2], correction: Option<Mat<f64>>) -> Self {
        Self { rows, gears, displacements: gears.map(|g| vec![0.0; g.dofs.free_count()]), correction }
    }

    /// The saddle-point matrix and the dofs to be ordered last.
    fn tangent(&self, active: &[usize], problem: &Problem) -> Result<(SymmetricMatrix, Vec<usize>), ContactError> {
        let [n1, n2] = self.gears.map(|g| g.dofs.free_count());
        let (n, na) = (n1 + n2, active.len());
        let mut entries: Vec<(usize, usize, f64)> = self.gears[0].stiffness.entries().collect();
        entries.extend(self.gears[1].stiffness.entries().map(|(i, j, v)| (n1 + i, n1 + j, v)));
        for (k, &i) in active.iter().enumerate() {
            for (b, offset) in [0, n1].into_iter().enumerate() {
                each_dof(&self.rows[i].supports[b], |dof, w| entries.push((n + k, offset + dof, -w)));
            }
            entries.push((n + k, n + k, -problem.compliance[i]));
            if let Some(x) = &self.correction {
                entries.extend(active[..=k].iter().enumerate().map(|(l, &j)| (n + k, n + l, -x[(i, j)])));
            }
            if !problem.held {
                entries.push((n + na, n + k, -problem.levers[i]));
            }
        }
        if problem.held {
            let matrix = SymmetricMatrix::from_triplets(n + na, &entries)?;
            return Ok((matrix, (n..n + na).collect()));
        }
        // An entry of its own, so that the pattern has the diagonal.
        entries.push((n + na, n + na, 0.0));
        let matrix = SymmetricMatrix::from_triplets(n + na + 1, &entries)?;
        Ok((matrix, (n..=n + na).collect()))
    }
}

fn each_dof(support: &Support, mut add: impl FnMut(usize, f64)) {
    for k in 0..support.count {
        for axis in 0..3 {
            add(3 * support.nodes[k] as usize + axis, support.weights[k] * support.direction[axis]);
        }
    }
}

impl LinearContact for FullContact<'_> {
    fn solve(&mut self, active: &[usize], problem: &Problem) -> Result<Equality, ContactError> {
        let (matrix, last) = self.tangent(active, problem)?;
        let factor = IndefiniteFactor::new(&matrix, &last)?;
        let [n1, n2] = self.gears.map(|g| g.dofs.free_count());
        let (n, na) = (n1 + n2, active.len());
        let free = usize::from(!problem.held);
        let mut x = Mat::<f64>::zeros(n + na + free, 1 + free);
        for (k, &i) in active.iter().enumerate() {
            x[(n + k, 0)] = problem.gaps[i];
        }
        if !problem.held {
            x[(n + na, 0)] = -problem.moment;
            x[(n + na, 1)] = 1.0;
        }
        factor.solve(x.as_mut())?;
        self.displacements = [(0, n1), (n1, n2)].map(|(at, len)| (at..at + len).map(|i| x[(i, 0)]).collect());
        let openings = self
            .rows
            .iter()
            .enumerate()
            .map(|(i, row)| {
                let corrected = |c: &Mat<f64>| active.iter().enumerate().map(|(k, &j)| c[(i, j)] * x[(n + k, 0)]).sum();
                let mut sum = self.correction.as_ref().map_or(0.0, corrected);
                for (support, u) in row.supports.iter().zip(&self.displacements) {
                    each_dof(support, |dof, w| sum += w * u[dof]);
                }
                sum
            })
            .collect();
        let (rotation, stiffness) = if problem.held { (0.0, 0.0) } else { (x[(n + na, 0)], 1.0 / x[(n + na, 1)]) };
        Ok(Equality { forces: (0..na).map(|k| x[(n + k, 0)]).collect(), rotation, openings, stiffness })
    }

    fn self_compliance(&mut self) -> Result<f64, ContactError> {
        // One row alone, without torque: u = K^-1 A' on a unit load.
        let (matrix, last) = self.tangent(
            &[],
            &Problem {
                gaps: vec![],
                levers: vec![],
                torque_levers: vec![],
                compliance: vec![],
                moment: 0.0,
                held: false,
            },
        )?;
        let n = matrix.n() - 1;
        drop(last);
        let stiffness =
            SymmetricMatrix::from_triplets(n, &matrix.entries().filter(|&(i, _, _)| i < n).collect::<Vec<_>>())?;
        let factor = IndefiniteFactor::new(&stiffness, &[])?;
        let row = &self.rows[self.rows.len() / 2];
        let n1 = self.gears[0].dofs.free_count();
        let mut x = Mat::<f64>::zeros(n, 1);
        each_dof(&row.supports[0], |dof, w| x[(dof, 0)] += w);
        each_dof(&row.supports[1], |dof, w| x[(n1 + dof, 0)] += w);
        let load = x.clone();
        factor.solve(x.as_mut())?;
        Ok((0..n).map(|i| load[(i, 0)] * x[(i, 0)]).sum())
    }

    fn displacements(&self, _forces: &[f64]) -> [Vec<f64>; 2] {
        self.displacements.clone()
    }
}
