//! Local laws of the rows of a contact under many loads.

use std::f64::consts::PI;

use pulp::{Scalar256b, Simd, WithSimd};

use super::{
    LocalContact, LocalState,
    four_laws::{Constants, FourLaws},
};
use crate::lanes::{self, Four, LANES};

/// A [`LocalContact`] prepared for many loads at one position.
#[derive(Debug, Clone)]
pub struct LocalLaw(Box<FourLaws>);

impl LocalLaw {
    pub(super) fn new(local: &LocalContact) -> Self {
        let mut four = Box::new(FourLaws::default());
        four.put(0, local, 1.0, &mut Default::default());
        four.complete(Scalar256b);
        Self(four)
    }

    /// State under a line load q (N/mm): see [`LocalContact::under`].
    pub fn under(&self, load: f64) -> LocalState {
        self.0.under(Scalar256b, Four::splat(Scalar256b, load)).of(0)
    }

    /// Energy per length of contact line under a line load `load` q (N/mm), minus half of load times approach, N mm/mm.
    /// It is <= 0 on a flank, because the slope falls as the load grows.
    ///
    /// ```text
    /// q delta / 2 - int_0^q delta dq' = -q^2 int_0^1 x [B(a sqrt x) - B(a)] dx,   delta = q B(a)
    /// B = -(K_1 + K_2) ln a + R(a):   the logarithm leaves (K_1 + K_2) / 8, R by quadrature,
    ///     or -R' / 12 (R' = dR / d ln a) where it goes with a^2, far from any edge
    /// ```
    /// So the strain energy is the integral of exactly this law, and forces are its derivatives: next to edges to 1e-7
    /// of the energy, elsewhere to round-off.
    pub fn curved_energy(&self, load: f64) -> f64 {
        self.0.curved_energy(Scalar256b, Four::splat(Scalar256b, load)).array()[0]
    }

    /// Load of a band of half-width a (mm), N/mm.
    pub(crate) fn load_of(&self, half_width: f64) -> f64 {
        0.25 * PI * self.0.modulus[0] * half_width * half_width / self.0.radius[0]
    }
}

/// The local laws of a list of slices under forces.
#[derive(Debug, Clone, Default)]
pub(crate) struct LocalLaws {
    fours: Vec<FourLaws>,
    count: usize,
    known: [Constants; 2],
    arch: pulp::Arch,
}

impl LocalLaws {
    /// Allocates memory for `rows` rows.
    pub fn with_capacity(rows: usize) -> Self {
        Self { fours: Vec::with_capacity(rows.div_ceil(LANES)), ..Self::default() }
    }

    /// Replaces the laws by those of slices with given lengths (mm).
    pub fn take<'a>(&mut self, slices: impl ExactSizeIterator<Item = (&'a LocalContact, f64)>) {
        self.count = slices.len();
        self.fours.resize_with(self.count.div_ceil(LANES), FourLaws::default);
        for (i, (local, length)) in slices.enumerate() {
            self.fours[i / LANES].put(i % LANES, local, length, &mut self.known);
        }
        lanes::run(self.arch, Complete(&mut self.fours));
    }

    /// Memory used, bytes.
    pub fn bytes(&self) -> usize {
        self.fours.len() * size_of::<FourLaws>()
    }

    /// State of a row under a force (N).
    pub fn state(&self, row: usize, force: f64) -> LocalState {
        let (four, lane) = (&self.fours[row / LANES], row % LANES);
        four.under(Scalar256b, Four::splat(Scalar256b, force / four.length[lane])).of(lane)
    }

    /// States of all rows under forces (N), and their stored energy minus half of force times approach, N mm; 0 without
    /// a force.
    pub fn states(&self, forces: &[f64]) -> Vec<(LocalState, f64)> {
        let mut states = vec![Default::default(); self.count];
        lanes::run(self.arch, States { fours: &self.fours, forces, states: &mut states });
        states
    }

    /// Sum over the rows of the stored energies minus half of force times approach, N mm.
    pub fn curved_energy(&self, forces: &[f64]) -> f64 {
        lanes::run(self.arch, CurvedEnergy { fours: &self.fours, forces })
    }

    /// Approach (mm) of a row under a force (N), and its slope (mm/N).
    pub fn under(&self, row: usize, force: f64) -> (f64, f64) {
        let state = self.state(row, force);
        (state.approach, state.slope / self.fours[row / LANES].length[row % LANES])
    }

    /// Approach and slope of all rows under forces (N).
    pub fn linearise(&self, forces: &[f64], approach: &mut [f64], slopes: &mut [f64]) {
        lanes::run(self.arch, Linearise { fours: &self.fours, forces, of: [approach, slopes] });
    }
}

/// Forces of four rows or fewer.
#[inline(always)]
fn padded(forces: &[f64]) -> [f64; LANES] {
    std::array::from_fn(|i| forces.get(i).copied().unwrap_or(0.0))
}

struct Complete<'a>(&'a mut [FourLaws]);

impl WithSimd for Complete<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        for four in self.0 {
            four.complete(simd);
        }
    }
}

/// Approach (mm) and slope (mm/N) under forces.
struct Linearise<'a> {
    fours: &'a [FourLaws],
    forces: &'a [f64],
    of: [&'a mut [f64]; 2],
}

impl WithSimd for Linearise<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let [approach, slopes] = self.of.map(|list| list.chunks_mut(LANES));
        for ((four, forces), (approach, slopes)) in
            self.fours.iter().zip(self.forces.chunks(LANES)).zip(approach.zip(slopes))
        {
            let length = Four::new(simd, &four.length);
            let state = four.under(simd, Four::new(simd, &padded(forces)) / length);
            let count = approach.len();
            approach.copy_from_slice(&state.approach.array()[..count]);
            slopes.copy_from_slice(&(state.slope / length).array()[..count]);
        }
    }
}

struct States<'a> {
    fours: &'a [FourLaws],
    forces: &'a [f64],
    states: &'a mut [(LocalState, f64)],
}

impl WithSimd for States<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let of_rows = self.forces.chunks(LANES).zip(self.states.chunks_mut(LANES));
        for (four, (forces, states)) in self.fours.iter().zip(of_rows) {
            let length = Four::new(simd, &four.length);
            let load = Four::new(simd, &padded(forces)) / length;
            let local = four.under(simd, load).all();
            let energy = (length * four.curved_energy(simd, load)).array();
            let pressed = states.iter_mut().zip(forces).enumerate().filter(|(_, (_, force))| **force > 0.0);
            for (i, (state, _)) in pressed {
                *state = (local[i], energy[i]);
            }
        }
    }
}

struct CurvedEnergy<'a> {
    fours: &'a [FourLaws],
    forces: &'a [f64],
}

impl WithSimd for CurvedEnergy<'_> {
    type Output = f64;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> f64 {
        let mut sum = Four::splat(simd, 0.0);
        for (four, forces) in self.fours.iter().zip(self.forces.chunks(LANES)) {
            let length = Four::new(simd, &four.length);
            sum = sum + length * four.curved_energy(simd, Four::new(simd, &padded(forces)) / length);
        }
        sum.sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::local::{EndFace, LocalBody, layer_constant};

    /// Rows side by side, edges and faces near and far among them, have the bits of each by itself.
    #[test]
    fn rows_side_by_side_are_those_by_themselves() {
        let contact = |i: usize| {
            let distance = 0.4 * i as f64 - 0.8;
            let body = |tip_distance: f64, arc: f64| LocalBody {
                young: 2.06e5,
                poisson: 0.3,
                layer: layer_constant(0.3),
                depth: 1.5 + 0.1 * i as f64,
                tip_distance,
                tip_angle: 2.0,
                tip_gradient: 1.5,
                edge_radius: arc,
                ends: [
                    EndFace { distance: 0.3 + 0.9 * i as f64, lean: 0.3 },
                    EndFace { distance: 20.0 - 0.9 * i as f64, lean: -0.3 },
                ],
            };
            let arc = if i.is_multiple_of(3) { 0.1 } else { 0.0 };
            LocalContact {
                bodies: [body(distance.max(0.0), arc), body(4.0, 0.0)],
                radius: 5.0,
                off_line: (-distance).max(0.0),
                deviation: None,
            }
        };
        let length = 0.7;
        let contacts: Vec<LocalContact> = (0..11).map(contact).collect();
        let forces: Vec<f64> = (0..11).map(|i| 40.0 * f64::from(i)).collect();
        let mut laws = LocalLaws::default();
        laws.take(contacts.iter().map(|contact| (contact, length)));
        let states = laws.states(&forces);
        let [mut approach, mut slopes] = [vec![0.0; 11], vec![0.0; 11]];
        laws.linearise(&forces, &mut approach, &mut slopes);
        for (i, contact) in contacts.iter().enumerate().skip(1) {
            let (law, load) = (contact.law(), forces[i] / length);
            assert_eq!(states[i], (law.under(load), length * law.curved_energy(load)), "row {i}");
            assert_eq!((approach[i], slopes[i]), laws.under(i, forces[i]), "row {i}");
        }
        assert_eq!(states[0], Default::default());
        let all: f64 = states.iter().map(|(_, energy)| energy).sum();
        assert!((laws.curved_energy(&forces) / all - 1.0).abs() < 1e-14);
    }
}
