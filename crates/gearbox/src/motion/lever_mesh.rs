//! A mesh that depends on its gears only through a few levers and acts only along these, so that a time step is cheap.

/// Largest number of levers: an approach and a tilt on either side of the teeth.
pub const LEVERS: usize = 4;

/// Forces of a mesh along its levers s, in the order of its levers; unused entries are zero.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct LeverForces {
    /// Elastic forces -dV/ds.
    pub elastic: [f64; LEVERS],
    /// Forces of the dampers.
    pub damping: [f64; LEVERS],
    /// Stiffness d2V/ds2.
    pub stiffness: [[f64; LEVERS]; LEVERS],
    /// -d damping/d rates, the damping coefficients.
    pub rate_slope: [[f64; LEVERS]; LEVERS],
    /// -d damping/ds of each lever alone, where dampers are limited by the force of the flanks.
    pub slope: [f64; LEVERS],
    /// dV/dc with the levers held, N mm per cycle, if requested.
    pub energy_rate: f64,
    /// Power dissipated by the dampers, mW.
    pub dissipated: f64,
}

/// A mesh without friction that depends on its gears only through its levers.
pub trait LeverMesh {
    /// Moves to a position in the mesh cycles with the levers displaced by `places`; energy, overlaps and reach then
    /// refer to this position.
    fn stand(&mut self, cycles: f64, places: &[f64; LEVERS]);

    /// Writes the forces at this position into `out`, with the levers moving at `rates`. Only entries of its own levers
    /// are written; the others are 0 initially.
    fn answer(&mut self, rates: &[f64; LEVERS], energy_rate: bool, out: &mut LeverForces);
}
