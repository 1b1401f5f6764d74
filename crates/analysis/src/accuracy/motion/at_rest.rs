//! Properties of the static pair that determine its motion: exciting harmonics, resonance, lowest elastic frequencies.

use std::f64::consts::TAU;

use dynamics::{ElasticChange, MeshDamping, MeshResonance, RigidBody, equivalent_mass};
use reduction::ElasticGear;
use scene::{DriveBy, Driver, Quantity, Scene};
use study::{cycle_statistics, mesh_harmonics, root_mean_square};

use crate::{
    AnalysisError, GearCache, StaticResult, error::failed_modes, lumped::static_scene, meshes, motion::motion_options,
    options, reduced, statics::CycleAnalysis,
};

/// A static pair with the properties that determine its motion.
#[derive(Debug, Clone, PartialEq)]
pub struct PairAtRest {
    /// Mesh frequency at the scene's speed, Hz.
    pub mesh_hz: f64,
    /// Resonance of the inertias on the mean stiffness of the teeth, and its damping ratio.
    pub resonance: MeshResonance,
    /// Lowest frequency of pinion and wheel with bore held and flanks free, Hz.
    pub elastic_hz: [f64; 2],
    /// Amplitudes of mesh harmonics 1, 2, ... of the quasi-static transmission error, um.
    pub amplitudes_um: Vec<f64>,
    /// Root mean square about the mean, and peak to peak, of the quasi-static transmission error, um.
    pub ste_um: [f64; 2],
    /// Masses and inertias of pinion and wheel.
    pub bodies: [RigidBody; 2],
}

impl PairAtRest {
    /// Pair at rest of a scene in motion, from its meshes at rest.
    ///
    /// # Errors
    /// [`AnalysisError`] where a gear has no mass or no frequency.
    pub(super) fn new(scene: &Scene, at_rest: &StaticResult) -> Result<Self, AnalysisError> {
        let pair = &at_rest.pair;
        let meshes = meshes::pair_meshes(scene, pair)?;
        let options = motion_options(scene, pair, &meshes, options(scene, pair))?;
        let positions = &at_rest.history.positions;
        let mean = |f: fn(&ltca::StaticPosition) -> f64| positions.iter().map(f).sum::<f64>() / positions.len() as f64;
        let [stiffness, length] = [mean(|p| p.tangent_stiffness), mean(|p| p.contact_line_length)];
        let base = [pair.pinion.base_radius(), pair.wheel.base_radius()];
        let driver = usize::from(scene.operation.driver == Driver::Wheel);
        let held = scene.drive.as_ref().is_some_and(|d| d.by == DriveBy::Speed);
        let inertia = [0, 1].map(|i| options.bodies[i].polar_inertia / (base[i] * base[i]));
        let mass = equivalent_mass(inertia, held.then_some(driver));
        let damping = match options.damping {
            MeshDamping::Ratio(ratio) => ratio,
            MeshDamping::PerLength(c) => {
                c * length * pair.base_helix_angle().cos().powi(2) / (2.0 * (stiffness * mass).sqrt())
            }
        };
        let ste: Vec<f64> = positions.iter().map(|p| 1e3 * p.transmission_error).collect();
        let harmonics = mesh_harmonics(&ste, 1, ste.len() / 2)?;
        let gears = at_rest.model.as_ref().map(|m| m.gears());
        let lowest = |i: usize| {
            let gear: Option<&ElasticGear> = gears.map(|g| &g[i]);
            let found = gear.and_then(reduced).map(|reducer| reducer.lowest_elastic_hz()).transpose();
            let failed = |source| failed_modes(scene, i, source);
            found.map(|hz| hz.unwrap_or(f64::INFINITY)).map_err(failed)
        };
        Ok(Self {
            mesh_hz: scene.operation.speed_rpm / 60.0 * f64::from(scene.driver_teeth()),
            resonance: MeshResonance { hz: (stiffness / mass).sqrt() / TAU, damping },
            elastic_hz: [lowest(0)?, lowest(1)?],
            amplitudes_um: harmonics.iter().map(|h| h.amplitude).collect(),
            ste_um: [root_mean_square(&ste), cycle_statistics(&ste, 1)?.peak_to_peak],
            bodies: options.bodies,
        })
    }

    /// The static pair of a scene in motion, solved under its load without friction.
    ///
    /// # Errors
    /// [`AnalysisError`].
    pub fn solve(scene: &Scene, cache: &dyn GearCache) -> Result<Self, AnalysisError> {
        let still = static_scene(scene);
        let analysis = CycleAnalysis::new(&still).with_slices_of_scene().with_cache(cache);
        Self::new(scene, &analysis.solve()?)
    }

    /// Mesh frequency divided by the resonance.
    pub fn speed_ratio(&self) -> f64 {
        self.mesh_hz / self.resonance.hz
    }

    /// Mesh frequency divided by the lower of the lowest elastic frequencies.
    pub fn elastic_ratio(&self) -> f64 {
        self.mesh_hz / self.elastic_hz[0].min(self.elastic_hz[1])
    }

    /// Largest relative change of the motion by the inertia of elastic deformation: theory (63).
    pub fn elastic_share(&self) -> f64 {
        ElasticChange::of(&self.amplitudes_um, [self.mesh_hz; 2], self.elastic_hz, self.resonance).share
    }

    /// A number of the motion as the harmonics alone foresee it, um.
    pub(super) fn foreseen_um(&self, quantity: Quantity) -> f64 {
        let gain = |k: usize| self.response(k + 1, 1.0);
        let all: f64 = self.amplitudes_um.iter().sum();
        let swung: f64 = self.amplitudes_um.iter().enumerate().map(|(k, a)| a * gain(k)).sum();
        let still = self.ste_um[usize::from(quantity == Quantity::PeakToPeakDte)];
        if all > 0.0 { still * swung / all } else { still }
    }

    /// |1 / (1 - rho^2 + 2 i zeta rho)| of a mesh harmonic, 1 the mesh frequency, when the resonance is so many times
    /// as high as it is.
    pub(super) fn response(&self, harmonic: usize, resonance: f64) -> f64 {
        let rho = harmonic as f64 * self.speed_ratio() / resonance;
        1.0 / (1.0 - rho * rho).hypot(2.0 * self.resonance.damping * rho).max(f64::MIN_POSITIVE)
    }
}
