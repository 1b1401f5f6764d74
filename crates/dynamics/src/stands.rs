//! Where a pair stands under its mean load: what maps of its contact are made about.

use contact::FlankProjection;
use nalgebra::DVector;

use crate::{Displacement, MapFailure, MapRequest, PairMechanism, PairMotionError, Speed, start::quasi_static_balance};

/// Phases of a mesh cycle at which the pair stands under its load.
const STANDS: usize = 8;

impl PairMechanism {
    /// What maps of its flanks must hold: about where the pair stands under the mean of its load, forces up to `overload`
    /// times its, to an error of `tolerance`, or of `worst` at the most. `lag`: about that of the driven gear, mm.
    ///
    /// # Errors
    /// [`PairMotionError::Unmapped`] without load; those of the start.
    pub fn map_request(
        &mut self,
        lag: f64,
        overload: f64,
        [tolerance, worst]: [f64; 2],
    ) -> Result<MapRequest, PairMotionError> {
        // A load that swings would not let the pair stand: the map is made about its mean.
        let swinging = self.hold_mean_load();
        let load = self.load_on_lag(0.0).abs();
        if load <= 0.0 {
            let what = "a pair without load: nothing says what forces occur";
            return Err(MapFailure::Unmapped { what }.into());
        }
        // A map knows no speed: gears that stand still are looked at as they turn slowly.
        let speed = self.nominal().speed;
        if self.time_of_cycles(1.0).is_none() {
            self.set_speed(Speed::Constant(1.0));
        }
        let stands = self.stands(lag)?;
        self.set_speed(speed);
        self.set_load(swinging);
        let tilts = self.sides().any(|side| {
            let projection = FlankProjection::new(self.pair(), side.flank_side());
            self.coordinates().map().tr_mul(&projection.tilt).amax() > 1e-12
        });
        // Force along the normal of a force on the base circle.
        let mean_force = load / self.pair().base_helix_angle().cos();
        Ok(MapRequest { stands, tilts, mean_force, overload, tolerance, worst })
    }

    /// Displacements of the pair at rest under its load, at phases of a mesh cycle.
    fn stands(&mut self, lag: f64) -> Result<Vec<Displacement>, PairMotionError> {
        let scale = self.coordinates().scales(self.motion_size(lag), self.pair().pinion.base_radius());
        let mut q: Option<DVector<f64>> = None;
        let mut all = Vec::new();
        for i in 0..STANDS {
            let Some(time) = self.time_of_cycles(i as f64 / STANDS as f64) else {
                return Err(integrate::MotionError::StandsStill { cycle: 0 }.into());
            };
            let there = quasi_static_balance(self, time, lag, q.take(), &scale)?;
            all.push(self.coordinates().displacement(&there));
            q = Some(there);
        }
        integrate::Mechanism::forget(self);
        Ok(all)
    }
}
