//! How contact forces follow the motion of the bodies.

use faer::{MatMut, MatRef, Par, linalg::triangular_solve};

use super::DenseSolver;

/// Coordinates of two rigid bodies.
pub(super) const RIGID: usize = 12;

impl DenseSolver {
    /// How forces and moments on two rigid bodies follow their motion, active rows alone.
    ///
    /// ```text
    /// T = -J_t' (S + diag delta')^-1 J
    /// ```
    /// `row(i)`: J, how the twelve coordinates open gap i, and J_t, what a unit normal force does along them (equal without friction).
    pub fn tangent(&mut self, row: impl Fn(usize) -> [[f64; RIGID]; 2]) -> [[f64; RIGID]; RIGID] {
        let m = self.active.len();
        let mut tangent = [[0.0; RIGID]; RIGID];
        if m == 0 {
            return tangent;
        }
        if !self.symmetric {
            return self.tangent_of_loads(row);
        }
        self.openings_of(&row);
        let factor = MatRef::from_column_major_slice(&self.factor, m, m);
        let x = MatMut::from_column_major_slice_mut(&mut self.x, m, RIGID);
        triangular_solve::solve_lower_triangular_in_place(factor, x, Par::Seq);
        for (row, p) in tangent.iter_mut().zip(self.x.chunks(m)) {
            for (entry, q) in row.iter_mut().zip(self.x.chunks(m)) {
                *entry = -p.iter().zip(q).map(|(p, q)| p * q).sum::<f64>();
            }
        }
        tangent
    }

    /// The same where J_t is not J: with friction, or where a damper changes the force of some rows.
    pub fn tangent_of_loads(&mut self, row: impl Fn(usize) -> [[f64; RIGID]; 2]) -> [[f64; RIGID]; RIGID] {
        let m = self.active.len();
        let mut tangent = [[0.0; RIGID]; RIGID];
        if m == 0 {
            return tangent;
        }
        self.openings_of(&row);
        self.back_substitute(m, RIGID);
        for (a, &i) in self.active.iter().enumerate() {
            let [_, traction] = row(i);
            for (p, of_force) in tangent.iter_mut().zip(&traction) {
                p.iter_mut().enumerate().for_each(|(c, t)| *t -= of_force * self.x[c * m + a]);
            }
        }
        tangent
    }

    /// J of the active rows, column by column.
    fn openings_of(&mut self, row: &impl Fn(usize) -> [[f64; RIGID]; 2]) {
        let m = self.active.len();
        self.x.clear();
        self.x.resize(RIGID * m, 0.0);
        for (a, &i) in self.active.iter().enumerate() {
            let [opening, _] = row(i);
            opening.iter().enumerate().for_each(|(c, v)| self.x[c * m + a] = *v);
        }
    }
}
