//! Maps of the contact of flanks in motion, and what they are made about. Theory (72), (75), pitch errors: (74a).

use contact::FlankProjection;
use contact_map::{
    ContactMap, ContactSample, LoadedSlice, MapError, MapPlan, MapWatch, OffsetError, OffsetMap, PairOffsets,
    PhaseContact,
};
use geometry::GearPair;
use ltca::StaticError;

use crate::{COORDINATES, Displacement, MeshFlanks, elastic_displacement::ElasticDisplacement, mesh_side::MeshSide};

/// What maps of the flanks of a mesh must hold, and how well.
#[derive(Debug, Clone, PartialEq)]
pub struct MapRequest {
    /// Displacements of the gears in the mesh's own axes at rest, one entry a position: the maps are made about their mean.
    pub stands: Vec<Displacement>,
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

/// Why the flanks of a mesh have no maps.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum MapFailure {
    /// A map does not hold what the contact depends on.
    #[error("no map of the contact holds {what}")]
    Unmapped {
        /// What, and why.
        what: &'static str,
    },
    /// None is good enough.
    #[error("no map of the contact: {0}")]
    Map(Box<MapError<StaticError>>),
    /// The contact itself.
    #[error(transparent)]
    Contact(#[from] StaticError),
}

impl MapRequest {
    /// Mean displacements at rest.
    fn about(&self) -> Displacement {
        self.stands.iter().sum::<Displacement>() / self.stands.len() as f64
    }

    /// Tilts of the gears at rest, and as much on either side as half a deflection over the face width makes.
    fn tilt_range(&self, projection: &FlankProjection, width: f64) -> [f64; 2] {
        let all = || self.stands.iter().map(|d| projection.tilt.dot(d));
        let deflection = self.stands.iter().map(|d| projection.approach.dot(d).abs()).fold(0.0, f64::max);
        let [low, high] = [all().fold(f64::MAX, f64::min), all().fold(f64::MIN, f64::max)];
        let margin = (0.5 * deflection / width).max(2.0 * (high - low));
        [low - margin, high + margin]
    }
}

impl MeshFlanks {
    /// Maps of the driving flanks and, where these may touch, of the coast flanks, about where the gears stand; of teeth at
    /// their nominal places. `watch` hears how far each is.
    ///
    /// # Errors
    /// [`MapFailure`]: friction, normal modes, flanks by tooth, no load; where no map is good enough.
    pub fn maps(
        &self,
        pair: &GearPair,
        request: &MapRequest,
        watch: MapWatch<'_>,
    ) -> Result<Vec<ContactMap>, MapFailure> {
        self.check_mapped(pair, request)?;
        let (alike, about) = (pair.without_pitch_errors(), request.about());
        let one = |side: &MeshSide| {
            let projection = FlankProjection::new(&alike, side.flank_side());
            let plan = MapPlan {
                mean_force: request.mean_force,
                largest_force: request.overload * request.mean_force,
                tilt: request.tilts.then(|| request.tilt_range(&projection, alike.face_width())),
                width: alike.face_width(),
                tolerance: request.tolerance,
                worst: request.worst,
            };
            let side = side.with_flanks_of(&alike)?;
            let at = |phase: f64| SidePhase::new(&side, &alike, phase, (&projection, &about));
            ContactMap::build(&plan, watch, at).map_err(|e| MapFailure::Map(Box::new(e)))
        };
        self.sides().map(one).collect()
    }

    /// What displacements do to the flanks of each side, and what pitch errors offset their pairs of teeth by.
    pub fn mapped_sides(&self, pair: &GearPair) -> impl Iterator<Item = (FlankProjection, PairOffsets)> {
        let of = |side: &MeshSide| {
            (FlankProjection::new(pair, side.flank_side()), PairOffsets::new(side.pitch_approaches(pair)))
        };
        self.sides().map(of)
    }

    /// Error of the approach of the driving flanks by pitch errors as offsets of a map, beside the contact of the teeth with
    /// these errors; `None` without any.
    ///
    /// # Errors
    /// [`MapFailure::Map`] where the contact cannot be solved.
    pub fn offset_error(
        &self,
        pair: &GearPair,
        map: &OffsetMap,
        request: &MapRequest,
    ) -> Result<Option<OffsetError>, MapFailure> {
        let (projection, about) = (FlankProjection::new(pair, self.driving.flank_side()), request.about());
        let at = |cycles: f64| SidePhase::new(&self.driving, pair, cycles, (&projection, &about));
        map.error(request.mean_force, at).map_err(|e| MapFailure::Map(Box::new(e)))
    }

    /// Refuses flanks that no map holds.
    ///
    /// # Errors
    /// [`MapFailure::Unmapped`].
    pub fn check_mapped(&self, pair: &GearPair, request: &MapRequest) -> Result<(), MapFailure> {
        let what = if self.driving.contact().modes().is_some() {
            "normal modes of the gears: the contact then depends on their amplitudes"
        } else if self.driving.friction_coefficient() > 0.0 {
            "friction: it turns round with the sliding"
        } else if [&pair.pinion, &pair.wheel].iter().any(|g| g.has_own_flanks()) {
            "flanks by tooth: the contact then comes back after whole turns, not after a mesh cycle"
        } else if request.stands.is_empty() || !(request.mean_force > 0.0 && request.mean_force.is_finite()) {
            "a mesh without load: nothing says what forces occur"
        } else {
            return Ok(());
        };
        Err(MapFailure::Unmapped { what })
    }
}

/// One side of the teeth at one phase, as a map asks for it.
struct SidePhase<'a> {
    pair: &'a GearPair,
    side: MeshSide,
    cycles: f64,
    projection: &'a FlankProjection,
    /// Displacements that the map is made about.
    about: &'a Displacement,
}

impl<'a> SidePhase<'a> {
    fn new(
        side: &MeshSide,
        pair: &'a GearPair,
        cycles: f64,
        (projection, about): (&'a FlankProjection, &'a Displacement),
    ) -> Result<Self, StaticError> {
        Ok(Self { pair, side: side.copy_at(pair, cycles)?, cycles, projection, about })
    }

    fn displaced(&self, approach: f64, tilt: f64) -> Displacement {
        let Self { projection, about, .. } = self;
        let rest = [approach - projection.approach.dot(about), tilt - projection.tilt.dot(about)];
        *about + projection.displacement(rest[0], rest[1])
    }
}

impl PhaseContact for SidePhase<'_> {
    type Error = StaticError;

    fn overlap(&mut self, approach: f64, tilt: f64) -> f64 {
        let poses = self.side.poses(self.pair, self.cycles, &self.displaced(approach, tilt));
        self.side.undeformed_overlap(&poses)
    }

    fn sample(&mut self, approach: f64, tilt: f64) -> Result<ContactSample, StaticError> {
        let at = ElasticDisplacement::rigid(self.displaced(approach, tilt));
        self.side.forget();
        let force = self.side.evaluate(self.pair, self.cycles, &at, true)?;
        let turn = 2 * COORDINATES - 1;
        let per_turn = self.projection.approach[turn];
        let slices = self.side.pressed().map(|(position, force, length, pair)| LoadedSlice {
            force,
            length,
            lever: self.projection.lever(&position),
            pair,
        });
        Ok(ContactSample {
            force: -force.normal[turn] / per_turn,
            stiffness: force.stiffness[(turn, turn)] / (per_turn * per_turn),
            slices: slices.collect(),
        })
    }
}
