//! Putting a pair together: gears, drive, modes.

use std::sync::Arc;

use geometry::GearPair;
use nalgebra::DMatrix;

use super::PairMechanism;
use crate::{
    Drive, Extremes, GearVibration, MeshDamping, MotionOptions, PairBodies, mesh_flanks::MeshFlanks, modal::Modal,
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
        Ok(Self::of(PairBodies::new(pair, options), flanks, means))
    }

    /// The pair at its start with another drive; gears and tables are shared.
    ///
    /// # Errors
    /// [`StaticError`].
    pub fn with_drive(&self, drive: Drive) -> Result<Self, StaticError> {
        let options = MotionOptions { drive, ..self.options.clone() };
        let flanks = self.flanks.copy_at_start(&self.pair)?;
        let mut other = Self::of(PairBodies::new(self.pair.clone(), options), flanks, self.means);
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
        let mut rigid = self.bodies.mass_matrix();
        self.coordinates.add_matrix(&modal.shared_inertia(), -1.0, &mut rigid);
        self.mass = DMatrix::identity(n + m, n + m);
        self.mass.view_mut((0, 0), (n, n)).copy_from(&rigid);
        self.modal = Some(modal);
        self.flanks.forget_last();
        // What the modes bend is not in the forces of the flanks.
        self.roots = None;
    }

    fn of(bodies: PairBodies, flanks: MeshFlanks, means: [f64; 2]) -> Self {
        let damping = per_length(&bodies, means);
        let roots = bodies.options.statics.root_stress.then(|| flanks.driving.root_fillets(&bodies.pair));
        Self {
            mass: bodies.mass_matrix(),
            bodies,
            flanks,
            damping,
            means,
            modal: None,
            extremes: Extremes::default(),
            throughput: 0.0,
            roots,
        }
    }
}

/// Mesh damping per length of contact line, N s/mm^2. `means`: mesh stiffness (N/mm on the base circle) and length of
/// contact lines (mm).
pub(super) fn per_length(bodies: &PairBodies, means: [f64; 2]) -> f64 {
    match bodies.options.damping {
        MeshDamping::PerLength(c) => c,
        MeshDamping::Ratio(zeta) => {
            // c of the base circle; a slice moves by cos(b_b) of it, and so does its force.
            let cos = bodies.pair.base_helix_angle().cos();
            2.0 * zeta * (means[0] * bodies.equivalent_mass()).sqrt() / (means[1] * cos * cos)
        }
    }
}
