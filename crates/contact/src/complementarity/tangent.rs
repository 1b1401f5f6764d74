//! Tangent: derivative of contact forces by the motion of the bodies.

use faer::{MatMut, Par, linalg::triangular_solve};

use super::{DenseSolver, dense::RIGID};

impl DenseSolver {
    /// Derivative of forces and moments on two rigid bodies by their motion, with the active rows only.
    ///
    /// ```text
    /// T = -J_t' (S + diag delta')^-1 J
    /// ```
    /// `row(i)` gives J, the opening of gap i per unit of each of the twelve coordinates, and J_t, the work of a unit
    /// normal force along them (equal without friction).
    pub fn tangent(&mut self, row: impl Fn(usize) -> [[f64; RIGID]; 2]) -> [[f64; RIGID]; RIGID] {
        let mut flat = [0.0; RIGID * RIGID];
        let fill = |i: usize, opening: &mut [f64], load: &mut [f64]| {
            let [j, j_t] = row(i);
            opening.copy_from_slice(&j);
            load.copy_from_slice(&j_t);
        };
        self.tangent_of(&mut [0.0; 2 * RIGID], fill, &mut flat);
        std::array::from_fn(|p| std::array::from_fn(|q| flat[RIGID * p + q]))
    }

    /// How weighted sums of the normal forces follow the motion of two rigid bodies, -W' (S + diag delta')^-1 J.
    ///
    /// `row(i)`: J and W, what the sums along the twelve coordinates hold of normal force i.
    pub(crate) fn weighted_tangent(&mut self, row: impl Fn(usize) -> [[f64; RIGID]; 2]) -> [[f64; RIGID]; RIGID] {
        let m = self.active.len();
        let mut all = [[0.0; RIGID]; RIGID];
        if m == 0 {
            return all;
        }
        self.x.clear();
        self.x.resize(RIGID * m, 0.0);
        for (a, &i) in self.active.iter().enumerate() {
            row(i)[0].iter().enumerate().for_each(|(c, v)| self.x[c * m + a] = *v);
        }
        self.back_substitute(m, RIGID);
        for (a, &i) in self.active.iter().enumerate() {
            for (sums, weight) in all.iter_mut().zip(row(i)[1]).filter(|(_, weight)| *weight != 0.0) {
                sums.iter_mut().enumerate().for_each(|(c, t)| *t -= weight * self.x[c * m + a]);
            }
        }
        all
    }

    /// [`DenseSolver::tangent`] of any number n of coordinates, row by row into `tangent` (n x n).
    ///
    /// `row(i, J_i, J_t,i)` fills what the coordinates do to gap i and what a unit normal force does along them, n
    /// each; `memory` has room for both, 2n.
    pub(crate) fn tangent_of(
        &mut self,
        memory: &mut [f64],
        row: impl Fn(usize, &mut [f64], &mut [f64]),
        tangent: &mut [f64],
    ) {
        let (m, n) = (self.active.len(), memory.len() / 2);
        tangent.fill(0.0);
        if m == 0 || n == 0 {
            return;
        }
        let (opening, load) = memory.split_at_mut(n);
        self.x.clear();
        self.x.resize(n * m, 0.0);
        for (a, &i) in self.active.iter().enumerate() {
            row(i, opening, load);
            opening.iter().enumerate().for_each(|(c, v)| self.x[c * m + a] = *v);
        }
        if self.symmetric {
            let factor = Self::factored(&self.factor, m);
            let x = MatMut::from_column_major_slice_mut(&mut self.x, m, n);
            triangular_solve::solve_lower_triangular_in_place(factor, x, Par::Seq);
            for (row, p) in tangent.chunks_mut(n).zip(self.x.chunks(m)) {
                for (entry, q) in row.iter_mut().zip(self.x.chunks(m)) {
                    *entry = -p.iter().zip(q).map(|(p, q)| p * q).sum::<f64>();
                }
            }
            return;
        }
        self.back_substitute(m, n);
        for (a, &i) in self.active.iter().enumerate() {
            row(i, opening, load);
            for (p, of_force) in tangent.chunks_mut(n).zip(load.iter()) {
                p.iter_mut().enumerate().for_each(|(c, t)| *t -= of_force * self.x[c * m + a]);
            }
        }
    }
}
