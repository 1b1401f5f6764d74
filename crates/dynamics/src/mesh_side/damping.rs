//! Damping between the flanks of one side.

use nalgebra::SMatrix;

use super::{MeshSide, Placed};
use crate::{COORDINATES, Displacement};

/// A slice that carries force.
struct DampedSlice {
    /// Normal force, N.
    force: f64,
    /// Damping, N s/mm.
    damping: f64,
    /// dg/dd: its moments are those that do the work of tilts and turns.
    j: Displacement,
    /// dg/dt by the rigid bodies, mm/s.
    opening: f64,
}

impl DampedSlice {
    /// Force against the approach (N, positive where flanks part), its slope, and its power.
    fn resisted(&self) -> [f64; 3] {
        let Self { force, damping, opening, .. } = *self;
        let damped = limited(damping * opening, force);
        [damped, if damped == damping * opening { damping } else { 0.0 }, damped * opening]
    }
}

impl MeshSide {
    /// Slices that carry force, with the gears at `placed` moving at `rate`.
    fn damped_slices<'a>(
        &'a self,
        placed: &'a Placed,
        rate: &'a Displacement,
        per_length: f64,
    ) -> impl Iterator<Item = DampedSlice> + 'a {
        let rows = self.contact.rows().iter().zip(self.contact.slices()).zip(self.contact.solver().forces());
        rows.filter(|(_, f)| **f > 0.0).map(move |((row, slice), &force)| {
            let mut j = Displacement::zeros();
            for (g, sign) in [1.0, -1.0].into_iter().enumerate() {
                let moment = (row.position - placed.poses[g].translation.vector).cross(&row.normal);
                for i in 0..3 {
                    j[COORDINATES * g + i] = sign * row.normal[i];
                    j[COORDINATES * g + 3 + i] = sign * moment[i];
                }
            }
            let j = placed.generalised(j);
            DampedSlice { force, damping: per_length * slice.length, j, opening: j.dot(rate) }
        })
    }

    /// Damping of the loaded slices: force on the coordinates and dissipated power; -df/d(velocity) is added to
    /// `matrix`.
    ///
    /// ```text
    /// F_d = -c h dg/dt,  |F_d| <= F
    /// ```
    /// Damping of separating flanks reduces their force at most to zero, so no flank pulls. Damping of approaching
    /// flanks is at most their contact force, so the force does not jump where contact begins.
    ///
    /// dg/dt is the approach of the rigid bodies, even if modes are kept: the damper acts in parallel with the whole
    /// compliance of the mesh. So the meaning of its ratio does not change with the number of modes. Modes have dampers
    /// of their own.
    pub fn damping(
        &self,
        placed: &Placed,
        rate: &Displacement,
        per_length: f64,
        mut matrix: Option<&mut SMatrix<f64, 12, 12>>,
    ) -> (Displacement, f64) {
        let (mut total, mut taken) = (Displacement::zeros(), 0.0);
        for slice in self.damped_slices(placed, rate, per_length) {
            let [force, slope, power] = slice.resisted();
            total -= force * slice.j;
            taken += power;
            if let Some(matrix) = &mut matrix {
                **matrix += slope * slice.j * slice.j.transpose();
            }
        }
        (total, taken)
    }

    /// -df/dd of the damping of slices that is limited by their own force, which depends on the displacements: N/mm, N,
    /// N mm. `None` if none is limited. To be called after an evaluation with its tangent.
    pub fn held_damping(
        &mut self,
        placed: &Placed,
        rate: &Displacement,
        per_length: f64,
    ) -> Option<SMatrix<f64, 12, 12>> {
        let mut shares = vec![0.0; self.contact.rows().len()];
        let pressed = (0..shares.len()).filter(|&i| self.contact.solver().forces()[i] > 0.0);
        let pressed: Vec<usize> = pressed.collect();
        for (i, slice) in pressed.into_iter().zip(self.damped_slices(placed, rate, per_length)) {
            let asked = slice.damping * slice.opening;
            if asked.abs() > slice.force {
                shares[i] = asked.signum();
            }
        }
        if shares.iter().all(|s| *s == 0.0) {
            return None;
        }
        let tangent = self.contact.tangent_of_shares(|i| shares[i]);
        Some(placed.generalised_slope(SMatrix::from_fn(|i, j| tangent[i][j])))
    }

    /// Sum and smallest value of the normal forces of the slices with their damping, N. The smallest one shows whether
    /// any flank pulls. Zeros without contact.
    pub fn normal_forces(&self, placed: &Placed, rate: &Displacement, per_length: f64) -> [f64; 2] {
        let (mut sum, mut least) = (0.0, f64::INFINITY);
        for slice in self.damped_slices(placed, rate, per_length) {
            let total = slice.force - slice.resisted()[0];
            sum += total;
            least = least.min(total);
        }
        [sum, if least.is_finite() { least } else { 0.0 }]
    }
}

/// Damping of a slice that carries `force`, between -force and force.
fn limited(damping: f64, force: f64) -> f64 {
    damping.clamp(-force, force)
}
