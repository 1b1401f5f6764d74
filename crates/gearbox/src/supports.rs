//! Bearings in series with the housing, which hold the shafts at their bearing seats. Theory (79), (79c).

use nalgebra::{Cholesky, DMatrix, DVector};

use crate::{GearboxError, Structure};

/// Stiffness of bearings and housing, as seen from the shafts. Each bearing has six coordinates: the displacement of
/// its shaft, relative to that of the shaft that contains its seat, if any. The seats of rolling bearings in a housing
/// stay coordinates of their own: six more each, in the order of the bearings.
#[derive(Debug, Clone, PartialEq)]
pub struct Supports {
    /// Stiffness for displacements of the shafts at the bearings, and of open seats.
    pub stiffness: DMatrix<f64>,
    /// Damping for velocities of the shafts at the bearings, and of open seats.
    pub damping: DMatrix<f64>,
    /// Force on the shafts at the bearings with nothing displaced.
    pub(crate) preload: DVector<f64>,
    /// Bearings whose seats are open.
    open: Vec<usize>,
    /// Bearings alone, block by block.
    bearings: DMatrix<f64>,
    /// R of the seats: u_seat = R u_shaft + u_0.
    seats: DMatrix<f64>,
    /// u_0: where preloads press the seats to with the shafts in their places.
    pressed: DVector<f64>,
    /// Preloads themselves.
    stated: DVector<f64>,
    housing: Option<DMatrix<f64>>,
}

impl Supports {
    /// Supports by the bearings and the housing of a structure that has been checked.
    ///
    /// ```text
    /// (K_b + K_h) u_seat = K_b u_shaft - g,   u_seat = R u_shaft + u_0,   S = K_b (1 - R),   C = (1 - R)' C_b (1 - R)
    /// ```
    /// g: preloads; (1 - R)' g acts on the shafts where they are in their places.
    /// Seats have no mass. A coordinate that neither bearing nor housing holds stays where it is.
    pub(crate) fn new(structure: &Structure) -> Result<Self, GearboxError> {
        let n = 6 * structure.bearings.len();
        let [mut bearings, mut dampers] = [0; 2].map(|_| DMatrix::zeros(n, n));
        for (i, bearing) in structure.bearings.iter().enumerate() {
            bearings.fixed_view_mut::<6, 6>(6 * i, 6 * i).copy_from(&bearing.stiffness);
            dampers.fixed_view_mut::<6, 6>(6 * i, 6 * i).copy_from(&bearing.damping);
        }
        // Files have digits: half the sum with the transpose is symmetric to the last one.
        bearings = 0.5 * (&bearings + bearings.transpose());
        dampers = 0.5 * (&dampers + dampers.transpose());
        let housing = structure.housing.as_ref().map(|k| 0.5 * (k + k.transpose()));
        let in_housing = |i: usize| structure.bearings[i].outer.is_none();
        let is_open = |i: &usize| housing.is_some() && in_housing(*i) && structure.bearings[*i].law.is_some();
        let open: Vec<usize> = (0..structure.bearings.len()).filter(is_open).collect();
        let all = n + 6 * open.len();
        let at_rest: Vec<_> = structure.bearings.iter().map(crate::Bearing::force_at_rest).collect();
        let stated = DVector::from_fn(n, |i, _| at_rest[i / 6][i % 6]);
        let (mut seats, mut given) = (DMatrix::zeros(n, all), DVector::zeros(n));
        for (at, &i) in open.iter().enumerate() {
            (0..6).for_each(|k| seats[(6 * i + k, n + 6 * at + k)] = 1.0);
        }
        if let Some(housing) = &housing {
            let sum = &bearings + housing;
            let gives = |i: &usize| in_housing(i / 6) && !open.contains(&(i / 6)) && sum[(*i, *i)] > 0.0;
            let held: Vec<usize> = (0..n).filter(gives).collect();
            let scale: Vec<f64> = held.iter().map(|&i| sum[(i, i)].sqrt().recip()).collect();
            let own = DMatrix::from_fn(held.len(), held.len(), |i, j| sum[(held[i], held[j])] * scale[i] * scale[j]);
            let right = DMatrix::from_fn(held.len(), all, |i, j| {
                let from_seat = |at: usize| -housing[(held[i], 6 * open[at / 6] + at % 6)];
                scale[i] * if j < n { bearings[(held[i], j)] } else { from_seat(j - n) }
            });
            let free = || fem::FemError::NotPositiveDefinite { dof: 0, pivot_ratio: 0.0 };
            let factor = Cholesky::new(own).ok_or_else(free)?;
            let follow = factor.solve(&right);
            let by_preload = factor.solve(&DVector::from_fn(held.len(), |i, _| -scale[i] * stated[held[i]]));
            held.iter().enumerate().for_each(|(i, &row)| given[row] = scale[i] * by_preload[i]);
            for (i, &row) in held.iter().enumerate() {
                (0..all).for_each(|j| seats[(row, j)] = scale[i] * follow[(i, j)]);
            }
        }
        let relative = DMatrix::from_fn(n, all, |i, j| f64::from(u8::from(i == j))) - &seats;
        let pressed = &bearings * &relative;
        let mut series = DMatrix::zeros(all, all);
        series.rows_mut(0, n).copy_from(&pressed);
        if let Some(housing) = &housing {
            let carried = housing * &seats - &pressed;
            for (at, &i) in open.iter().enumerate() {
                series.rows_mut(n + 6 * at, 6).copy_from(&carried.rows(6 * i, 6));
            }
        }
        let stiffness = 0.5 * (&series + series.transpose());
        let damping = relative.transpose() * dampers * &relative;
        let preload = relative.tr_mul(&stated);
        Ok(Self { stiffness, damping, preload, open, bearings, seats, pressed: given, stated, housing })
    }

    /// Bearings whose seats are open.
    pub(crate) fn open(&self) -> &[usize] {
        &self.open
    }

    /// Whether the housing alone holds a coordinate of a seat.
    pub(crate) fn is_housed(&self, bearing: usize, axis: usize) -> bool {
        self.housing.as_ref().is_some_and(|k| k[(6 * bearing + axis, 6 * bearing + axis)] > 0.0)
    }

    /// Displacements of the seats in the housing when the shafts move by `u`, without the effect of preloads, mm, rad.
    pub fn seats(&self, u: &DVector<f64>) -> DVector<f64> {
        &self.seats * u
    }

    /// Displacements of the shafts against their seats, and forces of springs and preloads on the shafts.
    pub(crate) fn standing(&self, u: &DVector<f64>) -> [DVector<f64>; 2] {
        let relative = self.relative(u) - &self.pressed;
        let forces = &self.stated - &self.bearings * &relative;
        [relative, forces]
    }

    /// Energy of seats that preloads press with the shafts in their places, N mm; below 0.
    pub(crate) fn pressed_energy(&self) -> f64 {
        0.5 * self.stated.dot(&self.pressed)
    }

    fn relative(&self, u: &DVector<f64>) -> DVector<f64> {
        u.rows(0, self.seats.nrows()) - self.seats(u)
    }

    /// Forces of the bearings' springs on the shafts when these move by `u`, without preloads and rolling elements: N,
    /// N mm.
    pub fn forces(&self, u: &DVector<f64>) -> DVector<f64> {
        -(&self.bearings * self.relative(u))
    }

    /// Twice the strain energy of each bearing, and of the housing, N mm; without preloads and rolling elements.
    pub fn energies(&self, u: &DVector<f64>) -> (Vec<f64>, Option<f64>) {
        let seats = self.seats(u);
        let relative = self.relative(u);
        let of = |i: usize| {
            let own = relative.rows(6 * i, 6);
            own.dot(&(self.bearings.view((6 * i, 6 * i), (6, 6)) * own))
        };
        let each = (0..relative.len() / 6).map(of).collect();
        (each, self.housing.as_ref().map(|k| seats.dot(&(k * &seats))))
    }
}
