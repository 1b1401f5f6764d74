//! A single pair before its motion: the data of its mechanism, and reference values of its motion. Theory (45), (47).

use std::sync::Arc;

use dynamics::{
    COORDINATES, Drive, GearVibration, MapRequest, MeshFlanks, MeshResonance, MotionOptions as PairOptions, Torque,
    damping_per_length, equivalent_mass, equivalent_mass_of, masses_on_base_circles,
};
use geometry::{Gear, GearPair};
use integrate::Mechanism;
use nalgebra::DVector;
use reduction::ElasticGear;

use super::{GearboxMechanism, MappedMesh, MovingExactMesh, MovingMesh};
use crate::{GearboxError, Meshing, Vector12};

/// Names of the coordinates along and about the axes of each gear.
const NAMES: [[&str; COORDINATES]; 2] = [
    ["pinion x", "pinion y", "pinion z", "pinion tilt x", "pinion tilt y", "pinion turn"],
    ["wheel x", "wheel y", "wheel z", "wheel tilt x", "wheel tilt y", "wheel turn"],
];

/// Phases of a mesh cycle at which the pair stands under its load.
const STANDS: usize = 8;

/// A single pair: two rigid gears with their bearings, drive and load, and the flanks between them.
#[derive(Debug, Clone)]
pub struct PairModel {
    pair: GearPair,
    options: PairOptions,
    means: [f64; 2],
    mesh: PairMesh,
}

/// How its contact is found.
#[derive(Debug, Clone)]
enum PairMesh {
    Solved(Arc<MovingExactMesh>),
    Mapped(MappedMesh),
}

impl PairModel {
    /// A pair from gears for the driving flanks (`driving`) and, for contact on the coast flanks, `coast`. `means` are
    /// the mesh stiffness (N/mm on the base circle) and the length of contact lines (mm) to which a damping ratio
    /// refers.
    ///
    /// # Errors
    /// [`GearboxError::Contact`] if the contact cannot be set up.
    pub fn new(
        pair: GearPair,
        driving: impl Into<Arc<[ElasticGear; 2]>>,
        coast: Option<Arc<[ElasticGear; 2]>>,
        options: PairOptions,
        means: [f64; 2],
    ) -> Result<Self, GearboxError> {
        let mesh = MovingExactMesh::new(pair.clone(), driving.into(), coast, &options.statics, 0.0)?;
        let mesh = PairMesh::Solved(Arc::new(mesh.with_driving_flanks_alone()));
        Ok(Self { pair, options, means, mesh })
    }

    /// The pair with normal modes of both gears as additional coordinates: their share of the compliance of teeth and
    /// bodies gets inertia, the rest stays quasi-static.
    ///
    /// # Errors
    /// The errors of [`MovingExactMesh::with_modes`]; [`GearboxError::LessThanModes`] for bodies of gears other than
    /// those meshed.
    pub fn with_modes(self, gears: [GearVibration; 2]) -> Result<Self, GearboxError> {
        let PairMesh::Solved(home) = &self.mesh else {
            return Err(GearboxError::Unmapped { what: "normal modes of gears" });
        };
        let mesh = PairMesh::Solved(Arc::new(home.copy_at_start(0.0)?.with_modes(gears)?));
        let own = Self { mesh, ..self };
        own.machine()?;
        Ok(own)
    }

    /// The pair with maps of its flanks.
    #[must_use]
    pub fn on_map(&self, mesh: MappedMesh) -> Self {
        let coasts = self.flanks().is_some_and(MeshFlanks::has_coast_flanks);
        let mesh = PairMesh::Mapped(if coasts { mesh } else { mesh.with_driving_flanks_alone() });
        Self { mesh, ..self.clone() }
    }

    /// The pair with another drive.
    #[must_use]
    pub fn with_drive(&self, drive: Drive) -> Self {
        Self { options: PairOptions { drive, ..self.options.clone() }, ..self.clone() }
    }

    /// The pair with its driver at another constant speed, rad/s.
    #[must_use]
    pub fn at_speed(&self, speed: f64) -> Self {
        self.with_drive(self.options.drive.clone().at_speed(speed))
    }

    /// Access to the options; gears and flanks do not change.
    pub fn options_mut(&mut self) -> &mut PairOptions {
        &mut self.options
    }

    /// The mechanism of the pair at the position where its run begins; gears and tables are shared.
    ///
    /// # Errors
    /// [`GearboxError`].
    pub fn machine(&self) -> Result<GearboxMechanism, GearboxError> {
        let damping = damping_per_length(&self.pair, &self.options, self.means);
        GearboxMechanism::of_pair(&self.pair, &self.options, |_, _, _: &Meshing| {
            Ok(match &self.mesh {
                PairMesh::Solved(home) => Box::new(home.copy_at_start(damping)?) as Box<dyn MovingMesh>,
                PairMesh::Mapped(mesh) => Box::new(mesh.clone().with_damping(damping)),
            })
        })
    }

    /// The gear pair.
    pub fn pair(&self) -> &GearPair {
        &self.pair
    }

    /// Bodies, bearings and drives.
    pub fn options(&self) -> &PairOptions {
        &self.options
    }

    /// Stiffness (N/mm) and length of contact lines (mm) to which damping refers.
    pub fn means(&self) -> [f64; 2] {
        self.means
    }

    /// The flanks of its teeth; `None` for a pair with maps.
    pub fn flanks(&self) -> Option<&MeshFlanks> {
        match &self.mesh {
            PairMesh::Solved(home) => Some(home.flanks()),
            PairMesh::Mapped(_) => None,
        }
    }

    /// The maps of a pair with maps.
    pub fn map(&self) -> Option<&MappedMesh> {
        match &self.mesh {
            PairMesh::Solved(_) => None,
            PairMesh::Mapped(mesh) => Some(mesh),
        }
    }

    /// Frequencies of the kept modes with the bores held, Hz, those of gear 1 first; empty without modes.
    pub fn mode_frequencies_hz(&self) -> Vec<f64> {
        let modes = match &self.mesh {
            PairMesh::Solved(home) => home.kept_modes(),
            PairMesh::Mapped(_) => None,
        };
        let squares = modes.into_iter().flatten().flat_map(|own| own.modes.squares());
        squares.map(|s| s.sqrt() / std::f64::consts::TAU).collect()
    }

    /// Frequency at which the two gears vibrate against each other on their teeth, Hz: sqrt(k_m / m_e) / 2 pi with the
    /// mean tangent stiffness.
    pub fn mesh_resonance_hz(&self) -> f64 {
        (self.means[0] / self.equivalent_mass()).sqrt() / std::f64::consts::TAU
    }

    /// Frequencies as in [`Self::mesh_resonance_hz`] with both gears free, and with the driver's angle prescribed, Hz.
    /// The drive determines which inertia counts.
    pub fn mesh_resonances_hz(&self) -> [f64; 2] {
        let inertia = self.base_circle_masses();
        let driver = 1 - self.options.statics.driven();
        [None, Some(driver)].map(|held| (self.means[0] / equivalent_mass(inertia, held)).sqrt() / std::f64::consts::TAU)
    }

    /// The mesh resonance with the damping ratio of the mesh: c / 2 sqrt(k_m m_e), with c for the mean length of
    /// contact lines.
    pub fn mesh_resonance(&self) -> MeshResonance {
        let cos = self.pair.base_helix_angle().cos();
        let per_length = damping_per_length(&self.pair, &self.options, self.means);
        let damping = per_length * self.means[1] * cos * cos / (2.0 * (self.means[0] * self.equivalent_mass()).sqrt());
        MeshResonance { hz: self.mesh_resonance_hz(), damping }
    }

    /// Inertias of pinion and wheel on their base circles, J / r_b^2, t.
    pub fn base_circle_masses(&self) -> [f64; 2] {
        masses_on_base_circles(&self.pair, &self.options.bodies)
    }

    /// Inertia that vibrates on the mesh, t: that of both gears, or of the driven gear alone if the driver's angle is
    /// prescribed.
    pub fn equivalent_mass(&self) -> f64 {
        equivalent_mass_of(&self.pair, &self.options)
    }

    /// Whether the coast flanks may touch.
    pub fn has_coast_flanks(&self) -> bool {
        match &self.mesh {
            PairMesh::Solved(home) => home.flanks().has_coast_flanks(),
            PairMesh::Mapped(mesh) => mesh.maps().count() > 1,
        }
    }

    /// Turn of the driver in a mesh cycle, rad.
    fn pitch(&self) -> f64 {
        [&self.pair.pinion, &self.pair.wheel][1 - self.options.statics.driven()].pitch_angle().abs()
    }

    /// Mesh cycles from the start to a time (s) in the nominal motion.
    pub fn cycles_until(&self, t: f64) -> f64 {
        self.options.drive.nominal().angle(t) / self.pitch()
    }

    /// Time (s) at which a number of mesh cycles have passed in the nominal motion; `None` if the motion stops before.
    pub fn time_of_cycles(&self, cycles: f64) -> Option<f64> {
        self.options.drive.nominal().time_at(cycles * self.pitch())
    }

    fn driven(&self) -> &Gear {
        [&self.pair.pinion, &self.pair.wheel][self.options.statics.driven()]
    }

    /// Magnitude of a displacement at the flanks that counts as large, mm: the lag of the driven gear in static
    /// equilibrium (`lag`, mm) or, if larger, the deflection of the mesh under its load.
    ///
    /// ```text
    /// max(|lag|, T / (r_b k_m))
    /// ```
    /// A lag is a position, which misalignment and micro-geometry can move through zero to negative values; a
    /// deflection is a magnitude.
    pub fn motion_size(&self, lag: f64) -> f64 {
        let deflection = self.options.statics.torque.abs() / (self.driven().base_radius().abs() * self.means[0]);
        // Gears without stiffness or load have no deflection.
        if deflection.is_finite() { lag.abs().max(deflection) } else { lag.abs() }
    }

    fn by_torque(&self) -> bool {
        matches!(self.options.drive, Drive::Torque { .. })
    }

    /// Names of the coordinates except modes, in order. Modes come last, followed only by the rotation of a driver that
    /// a torque drives.
    pub fn names(&self) -> Vec<&'static str> {
        let driven = self.options.statics.driven();
        let mut names = Vec::new();
        for (gear, own) in NAMES.iter().enumerate() {
            let moves = own.iter().zip(&self.options.free[gear][..COORDINATES - 1]).filter(|(_, free)| **free);
            names.extend(moves.map(|(name, _)| *name));
            names.extend((gear == driven).then_some("transmission error"));
        }
        names.extend(self.by_torque().then_some(NAMES[1 - driven][COORDINATES - 1]));
        names
    }

    /// Index of the coordinate that is the driven gear's lag, mm.
    pub fn lag(&self) -> usize {
        self.names().iter().position(|name| *name == "transmission error").unwrap_or(0)
    }

    /// Magnitudes of the coordinates that correspond to a displacement of `length` (mm) at the flanks: rotations use
    /// the base radius of the driven gear, a mode the amplitude that moves a flank by this length.
    pub fn scale(&self, length: f64) -> DVector<f64> {
        let lever = self.driven().base_radius().abs();
        let one = |name: &&str| if name.contains("tilt") || name.contains("turn") { length / lever } else { length };
        let sizes = self.flanks().map_or(&[][..], MeshFlanks::mode_sizes);
        let mut all: Vec<f64> = self.names().iter().map(one).collect();
        let modes = all.len() - usize::from(self.by_torque());
        all.splice(modes..modes, sizes.iter().map(|size| length / size));
        DVector::from_vec(all)
    }

    /// Requirements for maps of its flanks: near the equilibrium of the pair under its mean load, for forces up to
    /// `overload` times its force, to an error of `tolerance`, or at most `worst`.
    ///
    /// # Errors
    /// [`GearboxError::Unmapped`] without load; the errors of the start.
    pub fn map_request(&self, overload: f64, [tolerance, worst]: [f64; 2]) -> Result<MapRequest, GearboxError> {
        // A load that swings would not let the pair stand: the map is made about its mean.
        let mean = self.options.mean_load();
        if mean.is_nan() || mean == 0.0 {
            let what = "a pair without load: nothing says what forces occur";
            return Err(GearboxError::Unmapped { what });
        }
        let options = PairOptions { load: Torque::Constant(mean), ..self.options.clone() };
        let mut machine = Self { options, ..self.clone() }.machine()?;
        let mut z: Option<DVector<f64>> = None;
        let mut stands = Vec::new();
        for i in 0..STANDS {
            let there = machine.standing_at(0, (i as f64 / STANDS as f64, 0.0), z.as_ref());
            let there = there.map_err(GearboxError::at(0.0))?;
            stands.push(machine.displacements(0, &there));
            z = Some(there);
        }
        machine.forget();
        let tilts = self.flanks().is_some_and(|flanks| {
            let moved = |tilt: &Vector12| machine.along(0, tilt).amax();
            flanks.mapped_sides(&self.pair).any(|(projection, _)| moved(&projection.tilt) > 1e-12)
        });
        // Force along the normal of a force on the base circle.
        let on_base_circle = mean.abs() / self.driven().base_radius().abs();
        let mean_force = on_base_circle / self.pair.base_helix_angle().cos();
        Ok(MapRequest { stands, coast_stands: Vec::new(), tilts, mean_force, overload, tolerance, worst })
    }
}
