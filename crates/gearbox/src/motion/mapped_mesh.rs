//! A map of the exact contact as a mesh of the gearbox in motion. Theory (72), (95).

use std::sync::Arc;

use contact::FlankProjection;
use contact_map::{
    ContactMap, ContactSample, LoadedSlice, MapContact, MapPlan, MapWatch, OffsetError, OffsetMap, PairOffsets,
    PhaseContact, SplineCache, Wanted,
};
use geometry::GearPair;
use ltca::StaticOptions;
use nalgebra::SMatrix;
use reduction::ElasticGear;

use super::{MeshLosses, MovingMesh};
use crate::{
    ExactMesh, GearboxError, MeshElement, MeshForces, Vector12, exact_mesh::PressedSlice, mesh_element::finite_cycles,
};

/// What a map of a mesh must hold, and how well.
#[derive(Debug, Clone, PartialEq)]
pub struct MapRequest {
    /// Displacements of the gears in the mesh's own axes at rest, one entry a position: the map is made about their mean.
    pub stands: Vec<Vector12>,
    /// Whether the gears can tilt against each other: between held shafts a map needs no tilt.
    pub tilts: bool,
    /// Sum of the normal forces there, N.
    pub mean_force: f64,
    /// Largest force over that.
    pub overload: f64,
    /// Root mean square of the approach's error over the mean approach that is aimed at.
    pub tolerance: f64,
    /// Largest root mean square of the approach's error over the mean approach of a map that is taken: of one that
    /// would cost too much to refine.
    pub worst: f64,
}

impl MapRequest {
    /// Mean displacements at rest.
    fn about(&self) -> Vector12 {
        self.stands.iter().sum::<Vector12>() / self.stands.len() as f64
    }
}

/// The driving flanks of a mesh by a table of their exact contact: forces, moments and energy over phase, approach and
/// tilt in the plane of action. Pitch errors are offsets of the pairs of teeth ([`OffsetMap`]).
#[derive(Debug, Clone)]
pub struct MappedMesh {
    map: OffsetMap,
    projection: FlankProjection,
    kept: SplineCache,
    /// N s/mm a mm of contact line.
    damping_per_length: f64,
    /// Backlash along the normal, mm.
    backlash: f64,
    cycles: f64,
    approach: f64,
    tilt: f64,
    contact: MapContact,
}

impl MappedMesh {
    /// Maps the contact of gears as [`ExactMesh`] has them, about where they stand; `watch` hears how far the map is.
    ///
    /// # Errors
    /// [`GearboxError::Unmapped`] for teeth that are not alike and for friction, [`GearboxError::Map`] where no map is
    /// good enough.
    pub fn new(
        pair: &GearPair,
        gears: &Arc<[ElasticGear; 2]>,
        options: &StaticOptions,
        (request, watch): (&MapRequest, MapWatch<'_>),
    ) -> Result<Self, GearboxError> {
        refuse(pair, options, request)?;
        let projection = FlankProjection::new(pair, options.side());
        let about = request.about();
        let alike = pair.without_pitch_errors();
        let plan = MapPlan {
            mean_force: request.mean_force,
            largest_force: request.overload * request.mean_force,
            tilt: request.tilts.then(|| tilt_range(&request.stands, &projection, pair)),
            width: pair.face_width(),
            tolerance: request.tolerance,
            worst: request.worst,
        };
        let at = |phase: f64| MappedPhase::new((&alike, gears, options), phase, (&projection, &about));
        let map = ContactMap::build(&plan, watch, at).map_err(|e| GearboxError::Map(Box::new(e)))?;
        Self::on(pair, options, request, map)
    }

    /// The mesh on a map that [`MappedMesh::new`] made of the same gears, options and request.
    ///
    /// # Errors
    /// [`GearboxError::Unmapped`] as [`MappedMesh::new`], and for a map with tilts where none are asked for, or without.
    pub fn on(
        pair: &GearPair,
        options: &StaticOptions,
        request: &MapRequest,
        map: ContactMap,
    ) -> Result<Self, GearboxError> {
        refuse(pair, options, request)?;
        if map.tilts().is_some() != request.tilts {
            return Err(GearboxError::Unmapped { what: "a mesh that this map was not made for" });
        }
        let offsets = PairOffsets::new(pair.pitch_approaches(options.side(), options.contact.sense));
        Ok(Self {
            map: OffsetMap::new(Arc::new(map), offsets),
            projection: FlankProjection::new(pair, options.side()),
            kept: SplineCache::default(),
            damping_per_length: 0.0,
            backlash: pair.backlash() * pair.base_helix_angle().cos(),
            cycles: 0.0,
            approach: 0.0,
            tilt: 0.0,
            contact: MapContact::default(),
        })
    }

    /// Mesh with dampers on the contact lines, N s/mm a mm, each limited to the force there.
    #[must_use]
    pub fn with_damping(self, per_length: f64) -> Self {
        Self { damping_per_length: per_length, ..self }
    }

    /// Approach (mm) and tilt (rad) of displacements, or their rates; no tilt where the map has none.
    fn along(&self, displacements: &Vector12) -> [f64; 2] {
        let [approach, tilt] = [&self.projection.approach, &self.projection.tilt].map(|a| a.dot(displacements));
        [approach, if self.map().tilts().is_some() { tilt } else { 0.0 }]
    }

    /// The map of teeth at their nominal places.
    pub fn map(&self) -> &ContactMap {
        self.map.map()
    }

    /// Error of the approach by pitch errors as offsets, beside the contact of the same gears, options and request with
    /// these errors; `None` without any.
    ///
    /// # Errors
    /// [`GearboxError::Map`] where the contact cannot be solved.
    pub fn pitch_error(
        &self,
        pair: &GearPair,
        gears: &Arc<[ElasticGear; 2]>,
        options: &StaticOptions,
        request: &MapRequest,
    ) -> Result<Option<OffsetError>, GearboxError> {
        let about = request.about();
        let at = |cycles: f64| MappedPhase::new((pair, gears, options), cycles, (&self.projection, &about));
        self.map.error(request.mean_force, at).map_err(|e| GearboxError::Map(Box::new(e)))
    }
}

/// Refuses meshes that no map holds.
fn refuse(pair: &GearPair, options: &StaticOptions, request: &MapRequest) -> Result<(), GearboxError> {
    let what = if options.contact.friction > 0.0 {
        "friction"
    } else if [&pair.pinion, &pair.wheel].iter().any(|g| g.has_own_flanks()) {
        "flanks by tooth: the contact comes back after whole turns, not after a mesh cycle"
    } else if request.stands.is_empty() || !(request.mean_force > 0.0 && request.mean_force.is_finite()) {
        "a mesh without load: nothing says what forces occur"
    } else {
        return Ok(());
    };
    Err(GearboxError::Unmapped { what })
}

/// Tilts of the gears at rest, and as much on either side as half a deflection over the face width makes.
fn tilt_range(stands: &[Vector12], projection: &FlankProjection, pair: &GearPair) -> [f64; 2] {
    let all = || stands.iter().map(|d| projection.tilt.dot(d));
    let deflection = stands.iter().map(|d| projection.approach.dot(d).abs()).fold(0.0, f64::max);
    let [low, high] = [all().fold(f64::MAX, f64::min), all().fold(f64::MIN, f64::max)];
    let margin = (0.5 * deflection / pair.face_width()).max(2.0 * (high - low));
    [low - margin, high + margin]
}

impl MeshElement for MappedMesh {
    fn go_to(&mut self, cycles: f64) -> Result<(), GearboxError> {
        self.cycles = finite_cycles(cycles)?;
        Ok(())
    }

    fn evaluate(&mut self, displacements: &Vector12) -> Result<MeshForces, GearboxError> {
        [self.approach, self.tilt] = self.along(displacements);
        let Self { map, projection, kept, .. } = self;
        let along = [&projection.approach, &projection.tilt];
        let wanted = Wanted { energy: true, phase_rate: true };
        self.contact = map.contact(kept.at(map, self.cycles, [self.approach, self.tilt]), self.approach, wanted);
        let contact = &self.contact;
        let mut tangent = SMatrix::zeros();
        for (i, a) in along.into_iter().enumerate() {
            for (j, b) in along.into_iter().enumerate() {
                tangent -= contact.stiffness[i][j] * a * b.transpose();
            }
        }
        let force = contact.moment * projection.tilt - contact.force * projection.approach;
        Ok(MeshForces { force, tangent, normal_force: contact.force })
    }

    /// Refuses a place at which the flanks that the map does not have would touch.
    fn check(&mut self) -> Result<(), GearboxError> {
        let gap_mm = -self.map.overlap(self.kept.last(), self.approach);
        if gap_mm <= self.backlash {
            return Ok(());
        }
        Err(GearboxError::BeyondBacklash { gap_mm, backlash_mm: self.backlash })
    }
}

impl MovingMesh for MappedMesh {
    fn period(&self) -> u64 {
        self.map.offsets().map_or(1, PairOffsets::period)
    }

    fn energy(&self) -> f64 {
        self.contact.energy
    }

    fn energy_rate(&self) -> f64 {
        self.contact.phase_rate
    }

    fn losses(&mut self, rates: &Vector12, _cycles: f64) -> MeshLosses {
        let along = [&self.projection.approach, &self.projection.tilt];
        let own = self.along(rates);
        let found = self.map().damping(self.kept.last(), &self.contact, own, self.damping_per_length);
        let mut all = MeshLosses::default();
        for (i, a) in along.into_iter().enumerate() {
            all.force -= found.force[i] * a;
            all.dissipated += found.force[i] * own[i];
            for (j, b) in along.into_iter().enumerate() {
                all.rate_slope += found.rate_slope[i][j] * a * b.transpose();
            }
        }
        all.slope += found.approach_slope * along[0] * along[0].transpose();
        all
    }

    fn overlaps(&mut self) -> Result<[f64; 2], GearboxError> {
        Ok([self.map.overlap(self.kept.last(), self.approach), f64::NEG_INFINITY])
    }

    fn levers(&self) -> Option<Vec<Vector12>> {
        Some(vec![self.projection.approach, self.projection.tilt])
    }

    fn reach(&self) -> f64 {
        let map = self.map();
        let force = self.contact.force / map.largest_force();
        // Without contact a tilt does nothing.
        let tilt = map
            .tilts()
            .filter(|_| force > 0.0)
            .map_or(0.0, |[low, high]| (self.tilt - 0.5 * (low + high)).abs() / (0.5 * (high - low)));
        force.max(tilt)
    }
}

/// The contact of a mesh at one phase, as a map asks for it.
struct MappedPhase<'a> {
    mesh: ExactMesh,
    projection: &'a FlankProjection,
    about: &'a Vector12,
}

impl<'a> MappedPhase<'a> {
    fn new(
        (pair, gears, options): (&GearPair, &Arc<[ElasticGear; 2]>, &StaticOptions),
        cycles: f64,
        (projection, about): (&'a FlankProjection, &'a Vector12),
    ) -> Result<Self, GearboxError> {
        let mut mesh = ExactMesh::new(pair.clone(), Arc::clone(gears), options.clone())?;
        mesh.go_to(cycles)?;
        Ok(Self { mesh, projection, about })
    }

    fn displaced(&self, approach: f64, tilt: f64) -> Vector12 {
        let Self { projection, about, .. } = self;
        let rest = [approach - projection.approach.dot(about), tilt - projection.tilt.dot(about)];
        *about + projection.displacement(rest[0], rest[1])
    }
}

impl PhaseContact for MappedPhase<'_> {
    type Error = GearboxError;

    fn overlap(&mut self, approach: f64, tilt: f64) -> f64 {
        let d = self.displaced(approach, tilt);
        self.mesh.overlap(&d)
    }

    fn sample(&mut self, approach: f64, tilt: f64) -> Result<ContactSample, GearboxError> {
        let d = self.displaced(approach, tilt);
        self.mesh.forget();
        let reply = self.mesh.evaluate(&d)?;
        let per_turn = self.projection.approach[11];
        let slices = self.mesh.pressed().map(|PressedSlice { position, force, length, pair }| LoadedSlice {
            force,
            length,
            lever: self.projection.lever(&position),
            pair,
        });
        Ok(ContactSample {
            force: -reply.force[11] / per_turn,
            stiffness: -reply.tangent[(11, 11)] / (per_turn * per_turn),
            slices: slices.collect(),
        })
    }
}
