//! A mesh that sees its gears by few levers, and answers along these: so that a step costs as little as its numbers.

/// Most levers: an approach and a tilt on either side of the teeth.
pub const LEVERS: usize = 4;

/// What a mesh does along its levers s, in the order in which it tells them; beyond them zeros.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct LeverForces {
    /// -dV/ds.
    pub elastic: [f64; LEVERS],
    /// Dampers.
    pub damping: [f64; LEVERS],
    /// d2V/ds2.
    pub stiffness: [[f64; LEVERS]; LEVERS],
    /// -d damping/d rates.
    pub rate_slope: [[f64; LEVERS]; LEVERS],
    /// -d damping/ds of each lever by itself, where dampers are held at the force of the flanks.
    pub slope: [f64; LEVERS],
    /// dV/dc with the levers held, N mm a cycle, where it was asked for.
    pub energy_rate: f64,
    /// Power that dampers take, mW.
    pub dissipated: f64,
}

/// A mesh without friction whose gears do no more to it than move its levers.
pub trait LeverMesh {
    /// Takes a place in the mesh cycles with the levers moved by `places`: energy, overlaps and reach are of there.
    fn stand(&mut self, cycles: f64, places: &[f64; LEVERS]);

    /// Puts the forces there into `out`, with the levers moving at `rates`: all that its levers have to do with. What it
    /// leaves alone is 0 from the beginning.
    fn answer(&mut self, rates: &[f64; LEVERS], energy_rate: bool, out: &mut LeverForces);
}
