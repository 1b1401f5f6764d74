//! Laws of rolling bearings in motion, as differences from the springs with which a mechanism is made. Theory (101a).

use nalgebra::{Cholesky, DMatrix, DVector};

use crate::{
    GearboxError, Structure, Supports,
    compliant_support::CompliantBearing,
    equilibrium::{Left, Norms, equilibrium},
    rolling_bearing::RollingReply,
};

/// Share of the rough stiffness of the seats that is added where the tangents of shafts are taken: a seat that nothing
/// holds then does nothing.
const SHIFT: f64 = 1e-12;

/// Bearings and housing whose rolling bearings follow their laws, and the springs in their place.
///
/// ```text
/// V(u) = min over w of  y' S y/2 - p . y + sum of V_i(u_i - w_i),   y = (u, w)
/// ```
/// u: displacements of the shafts at the bearings; w: displacements of the seats of rolling bearings in a housing; S, p:
/// springs, housing and preloads ([`Supports`]). Seats have no mass: w is where forces on them balance, at every instant.
pub(super) struct RollingSupports {
    supports: Supports,
    bearings: Vec<CompliantBearing>,
    /// Coordinates of y that are seats and that something holds.
    seats: Vec<usize>,
    /// Stiffness of those before anything is known of the load.
    rough: DMatrix<f64>,
    /// Energy that bearings and housing store with nothing displaced.
    stored: f64,
    /// Displacements of the shafts at the bearings by the coordinates z.
    to_bearings: DMatrix<f64>,
}

/// Bearings and housing at displacements of the shafts.
pub(super) struct Pressed {
    /// y.
    at: DVector<f64>,
    /// Energy V, N mm.
    pub energy: f64,
    /// Force on the shafts at the bearings, N, N mm.
    force: DVector<f64>,
    /// d2V/dy2.
    stiffness: DMatrix<f64>,
    replies: Vec<RollingReply>,
}

/// What laws do beside the springs in their place, on the coordinates z.
pub(super) struct BesideSprings {
    /// Energy, N mm.
    pub energy: f64,
    /// -dV/dz.
    pub force: DVector<f64>,
    /// d2V/dz2, where it is asked for.
    pub stiffness: Option<DMatrix<f64>>,
}

impl RollingSupports {
    /// Supports of a structure with bearing laws, whose shafts `held` do not move; `force` (N) is the typical load of a
    /// bearing.
    pub fn new(
        structure: &Structure,
        held: &[bool],
        force: f64,
        to_bearings: DMatrix<f64>,
    ) -> Result<Self, GearboxError> {
        structure.check()?;
        let supports = Supports::new(structure)?;
        let bearings = CompliantBearing::at_supports(structure, &supports, held);
        let all = supports.stiffness.nrows();
        let mut rough = supports.stiffness.clone();
        for own in &bearings {
            let law = structure.bearings[own.bearing].law.as_ref();
            let stiffness = law.map_or_else(nalgebra::Matrix6::zeros, |law| law.rough_stiffness(force));
            own.add_stiffness(&stiffness, &mut rough);
        }
        let seats: Vec<usize> = (to_bearings.nrows()..all).filter(|&i| rough[(i, i)] > 0.0).collect();
        let rough = block(&rough, &seats, &seats);
        let stored =
            supports.pressed_energy() + structure.bearings.iter().map(crate::Bearing::energy_at_rest).sum::<f64>();
        Ok(Self { supports, bearings, seats, rough, stored, to_bearings })
    }

    /// Difference of the laws from `springs`, which have the energy `stored` without displacement, at a position z of
    /// the motion.
    ///
    /// ```text
    /// V(u) - (u' S_0 u/2 - p_0 . u + V_0),   u = A z
    /// ```
    /// # Errors
    /// [`GearboxError::NoEquilibrium`] of the seats.
    pub fn beside(
        &self,
        (springs, stored): (&Supports, f64),
        z: &DVector<f64>,
        tangent: bool,
    ) -> Result<BesideSprings, GearboxError> {
        let pressed = self.at(springs, z)?;
        let n = self.to_bearings.nrows();
        let u = pressed.at.rows(0, n);
        let by_springs = &springs.stiffness * u;
        let energy = pressed.energy - 0.5 * u.dot(&by_springs) + springs.preload.dot(&u) - stored;
        let force = self.to_bearings.tr_mul(&(pressed.force.rows(0, n) + by_springs - &springs.preload));
        let of = |own: DMatrix<f64>| self.to_bearings.tr_mul(&((own - &springs.stiffness) * &self.to_bearings));
        let stiffness = if tangent { Some(of(self.tangent(&pressed)?)) } else { None };
        Ok(BesideSprings { energy, force, stiffness })
    }

    /// Bearings and housing at a position z of the motion.
    ///
    /// # Errors
    /// [`GearboxError::NoEquilibrium`] of the seats.
    pub fn at(&self, springs: &Supports, z: &DVector<f64>) -> Result<Pressed, GearboxError> {
        let u = &self.to_bearings * z;
        let mut y = u.clone().resize_vertically(self.supports.stiffness.nrows(), 0.0);
        // From where springs would have the seats: what is found depends on the place alone.
        let [relative, _] = springs.standing(&u);
        for own in &self.bearings {
            own.set_housing(&mut y, |k| u[6 * own.bearing + k] - relative[6 * own.bearing + k]);
        }
        if !self.seats.is_empty() {
            y = self.seated(y)?;
        }
        Ok(self.pressed(y))
    }

    /// y with its seats in equilibrium.
    fn seated(&self, mut y: DVector<f64>) -> Result<DVector<f64>, GearboxError> {
        let norms = Norms::new(self.rough.clone())?;
        let own = |y: &DVector<f64>| DVector::from_iterator(self.seats.len(), self.seats.iter().map(|&i| y[i]));
        let load = own(&(&self.supports.stiffness * &y - &self.supports.preload));
        let found = equilibrium(&norms, &load, own(&y), |w| {
            self.seats.iter().zip(w.iter()).for_each(|(&i, x)| y[i] = *x);
            let Pressed { force, stiffness, .. } = self.pressed(y.clone());
            Ok(Left { residual: -own(&force), tangent: block(&stiffness, &self.seats, &self.seats) })
        })?;
        self.seats.iter().zip(found.displacements.iter()).for_each(|(&i, x)| y[i] = *x);
        Ok(y)
    }

    /// Energy, forces and tangent of all of y.
    fn pressed(&self, y: DVector<f64>) -> Pressed {
        let by_springs = &self.supports.stiffness * &y;
        let preload = &self.supports.preload;
        let mut energy = 0.5 * y.dot(&by_springs) - preload.dot(&y) + self.stored;
        let mut force = preload - by_springs;
        let mut stiffness = -&self.supports.stiffness;
        let reply = |own: &CompliantBearing| {
            let reply = own.reply(&y);
            own.add(&reply, &y, &mut force, &mut stiffness);
            reply
        };
        let replies: Vec<_> = self.bearings.iter().map(reply).collect();
        energy += replies.iter().map(|r| r.energy).sum::<f64>();
        Pressed { at: y, energy, force, stiffness: -stiffness, replies }
    }

    /// d2V/du2: what shafts meet whose seats follow.
    ///
    /// ```text
    /// K = H_uu - H_uw H_ww^-1 H_wu,   H = d2V/dy2
    /// ```
    fn tangent(&self, pressed: &Pressed) -> Result<DMatrix<f64>, GearboxError> {
        let n = self.to_bearings.nrows();
        let (h, seats) = (&pressed.stiffness, &self.seats);
        let shafts: Vec<usize> = (0..n).collect();
        let mut own = block(h, &shafts, &shafts);
        if !seats.is_empty() {
            let held = block(h, seats, seats) + SHIFT * &self.rough;
            let free = || fem::FemError::NotPositiveDefinite { dof: 0, pivot_ratio: 0.0 };
            let scale = DVector::from_fn(seats.len(), |i, _| self.rough[(i, i)].sqrt().recip());
            let scaled = |i: usize, j: usize| scale[i] * scale[j] * held[(i, j)];
            let factor = Cholesky::new(DMatrix::from_fn(seats.len(), seats.len(), scaled)).ok_or_else(free)?;
            let mut follow = block(h, seats, &shafts);
            follow.row_iter_mut().zip(&scale).for_each(|(mut row, s)| row *= *s);
            own -= follow.tr_mul(&factor.solve(&follow));
        }
        Ok(own)
    }

    /// Displacements of the shafts relative to their seats, and elastic forces on the shafts, six entries per bearing.
    pub fn standing(&self, pressed: &Pressed) -> [DVector<f64>; 2] {
        let [relative, mut forces] = self.supports.standing(&pressed.at);
        for (own, reply) in self.bearings.iter().zip(&pressed.replies) {
            let mut rows = forces.fixed_rows_mut::<6>(6 * own.bearing);
            rows += reply.force6();
        }
        [relative, forces]
    }
}

fn block(matrix: &DMatrix<f64>, rows: &[usize], columns: &[usize]) -> DMatrix<f64> {
    DMatrix::from_fn(rows.len(), columns.len(), |i, j| matrix[(rows[i], columns[j])])
}
