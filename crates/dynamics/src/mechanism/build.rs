//! Putting a pair together: gears, drive, modes.

use std::sync::Arc;

use geometry::GearPair;
use nalgebra::{DMatrix, SMatrix};

use super::PairMechanism;
use crate::{
    Bearing, COORDINATES, Coordinates, Drive, Extremes, GearVibration, MotionOptions, Nominal, Speed,
    equivalent_mass::damping_per_length, mesh_flanks::MeshFlanks, modal::Modal,
};
use ltca::StaticError;
use reduction::ElasticGear;

impl PairMechanism {
    /// A pair whose driving flanks' gears are `driving`, and, for contact on the coast flanks, `coast`. `means`: mesh
    /// stiffness (N/mm on the base circle) and length of contact lines (mm) that a damping ratio refers to.
    ///
    /// # Errors
    /// [`StaticError`].
    pub fn new(
        pair: GearPair,
        driving: impl Into<Arc<[ElasticGear; 2]>>,
        coast: Option<Arc<[ElasticGear; 2]>>,
        options: MotionOptions,
        means: [f64; 2],
    ) -> Result<Self, StaticError> {
        let cycles = options.start_cycles;
        let flanks = MeshFlanks::new(&pair, driving.into(), coast, &options.statics, cycles)?;
        Ok(Self::of(pair, flanks, options, means))
    }

    /// The pair at its start with another drive; gears and tables are shared.
    ///
    /// # Errors
    /// [`StaticError`].
    pub fn with_drive(&self, drive: Drive) -> Result<Self, StaticError> {
        let options = MotionOptions { drive, ..self.options.clone() };
        let flanks = self.flanks.copy_at_start(&self.pair)?;
        let mut other = Self::of(self.pair.clone(), flanks, options, self.means);
        if let Some(modal) = self.modal.clone() {
            other.add_modes(modal);
        }
        Ok(other)
    }

    /// The pair with normal modes of both gears as coordinates of their own: their share of the compliance of teeth and
    /// bodies gets inertia, the rest stays quasi-static.
    ///
    /// The coordinates are p = q + L D d, amplitudes with what rigid motion shares of them: so mass is constant and
    /// without coupling, and a gear that moves as a rigid body for a moment keeps its p. Neither they nor their
    /// velocities change with the window.
    ///
    /// # Errors
    /// [`contact::ContactError::Reduction`] for modes of another gear; [`StaticError::OutOfRange`] where a damping
    /// ratio is no number >= 0, and where the bodies' inertia is less than what the modes share of it: given for other
    /// gears than were meshed.
    pub fn with_modes(mut self, gears: [GearVibration; 2]) -> Result<Self, StaticError> {
        if let Some(value) = gears.iter().map(|g| g.damping_ratio).find(|z| !z.is_finite() || *z < 0.0) {
            return Err(StaticError::OutOfRange { name: "modal damping ratio", value, expected: "a number >= 0" });
        }
        let modes = gears.each_ref().map(|g| Arc::clone(&g.modes));
        self.flanks.keep_modes(&modes)?;
        self.add_modes(Modal::new(gears));
        if nalgebra::Cholesky::new(self.mass.clone()).is_none() {
            let least = self.mass.diagonal().min();
            let expected = "more than the normal modes share of it: are mass and inertia those of the mesh?";
            return Err(StaticError::OutOfRange { name: "inertia of a gear's body", value: least, expected });
        }
        Ok(self)
    }

    fn add_modes(&mut self, modal: Modal) {
        let (n, m) = (self.coordinates.count(), modal.count());
        let mut rigid = self.coordinates.mass(&self.options.bodies);
        self.coordinates.add_matrix(&modal.shared_inertia(), -1.0, &mut rigid);
        self.mass = DMatrix::identity(n + m, n + m);
        self.mass.view_mut((0, 0), (n, n)).copy_from(&rigid);
        self.modal = Some(modal);
        self.flanks.forget_last();
        // What the modes bend is not in the forces of the flanks.
        self.roots = None;
    }

    fn of(pair: GearPair, flanks: MeshFlanks, options: MotionOptions, means: [f64; 2]) -> Self {
        let mut free = options.free;
        let driver = 1 - options.statics.driven();
        let (speed, by_torque) = match &options.drive {
            Drive::Speed(speed) | Drive::Balanced(speed) => (*speed, false),
            Drive::Torque { start, .. } => (Speed::Constant(*start), true),
        };
        free[driver][COORDINATES - 1] = by_torque;
        let mut coordinates = Coordinates::new(&pair, &options.statics, free);
        if matches!(options.drive, Drive::Balanced(_)) {
            coordinates = coordinates.sharing_the_lag(&pair, &options.statics, &options.bodies);
        }
        let mass = coordinates.mass(&options.bodies);
        let nominal = Nominal { speed, start: options.start_cycles };
        let both = |part: fn(&Bearing) -> nalgebra::Matrix6<f64>| {
            let mut all = SMatrix::<f64, 12, 12>::zeros();
            for (g, b) in options.bearings.iter().enumerate() {
                all.fixed_view_mut::<6, 6>(6 * g, 6 * g).copy_from(&part(b));
            }
            all
        };
        let bearing = [both(|b| b.stiffness), both(|b| b.damping)];
        let damping = damping_per_length(&pair, &options, means);
        let roots = options.statics.root_stress.then(|| flanks.driving.root_fillets(&pair));
        Self {
            pair,
            options,
            coordinates,
            mass,
            nominal,
            flanks,
            bearing,
            damping,
            means,
            modal: None,
            extremes: Extremes::default(),
            throughput: 0.0,
            roots,
        }
    }
}
