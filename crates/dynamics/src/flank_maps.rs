//! Maps of the contact of flanks in motion, and the states about which they are made. Theory (72), (75), pitch errors:
//! (74a).

use contact::FlankProjection;
use contact_map::{
    ContactMap, ContactSample, LoadedSlice, MapError, MapPlan, MapWatch, OffsetError, OffsetMap, PairOffsets,
    PhaseContact,
};
use geometry::GearPair;
use ltca::StaticError;

use crate::{COORDINATES, Displacement, MeshFlanks, elastic_displacement::ElasticDisplacement, mesh_side::MeshSide};

/// Range and accuracy required of the maps of a mesh's flanks.
#[derive(Debug, Clone, PartialEq)]
pub struct MapRequest {
    /// Displacements of the gears in static equilibrium, in the mesh's own axes, one entry per position. The maps are
    /// made about their mean.
    pub stands: Vec<Displacement>,
    /// The same with the load on the coast flanks, for the map of these flanks; if empty, that map is made about
    /// `stands` as well.
    pub coast_stands: Vec<Displacement>,
    /// Whether the gears can tilt relative to each other; between held shafts a map needs no tilt.
    pub tilts: bool,
    /// Sum of the normal forces in these equilibria, N.
    pub mean_force: f64,
    /// Largest force divided by the mean force.
    pub overload: f64,
    /// Target for the root mean square error of the approach, divided by the mean approach.
    pub tolerance: f64,
    /// Largest permitted root mean square error of the approach, divided by the mean approach. It applies to a map
    /// whose refinement would cost too much.
    pub worst: f64,
}

/// Loads at rest up to which gears tilt in a map of flanks that strike: tilts of larger ones would leave all loads as they
/// mostly occur to few places of the map.
const TILTING_LOADS: f64 = 4.0;

/// Reasons for which the flanks of a mesh have no maps.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum MapFailure {
    /// The contact depends on a quantity that a map does not contain.
    #[error("maps of the contact do not depend on {what}")]
    Unmapped {
        /// The quantity and the reason.
        what: &'static str,
    },
    /// No map is accurate enough.
    #[error("no map of the contact: {0}")]
    Map(Box<MapError<StaticError>>),
    /// Error of the contact itself.
    #[error(transparent)]
    Contact(#[from] StaticError),
}

impl MapRequest {
    /// Displacements at rest with the load on the driving (0) or on the coast flanks (1).
    fn stands_of(&self, side: usize) -> &[Displacement] {
        if side == 0 || self.coast_stands.is_empty() { &self.stands } else { &self.coast_stands }
    }

    /// Mean displacements at rest.
    fn about(&self, side: usize) -> Displacement {
        let stands = self.stands_of(side);
        stands.iter().sum::<Displacement>() / stands.len() as f64
    }

    /// Tilts of the gears at rest, and as much on either side as half a deflection over the face width makes. Of flanks that
    /// strike behind their backlash: those from no load to the largest force or [`TILTING_LOADS`] of the load, and half as
    /// much on either side.
    fn tilt_range(&self, side: usize, projection: &FlankProjection, width: f64) -> [f64; 2] {
        let stands = self.stands_of(side);
        let all = || stands.iter().map(|d| projection.tilt.dot(d));
        let deflection = stands.iter().map(|d| projection.approach.dot(d).abs()).fold(0.0, f64::max);
        let [low, high] = [all().fold(f64::MAX, f64::min), all().fold(f64::MIN, f64::max)];
        let apart = 0.5 * deflection / width;
        if self.coast_stands.is_empty() {
            let margin = apart.max(2.0 * (high - low));
            return [low - margin, high + margin];
        }
        let loads = self.overload.min(TILTING_LOADS);
        let [low, high] = [loads * low.min(0.0), loads * high.max(0.0)];
        let margin = (loads * apart).max(0.5 * (high - low));
        [low - margin, high + margin]
    }
}

impl MeshFlanks {
    /// Maps of the driving flanks and, if these may touch, of the coast flanks, near the positions of the gears, for
    /// teeth in nominal positions. `watch` receives the progress of each map.
    ///
    /// # Errors
    /// [`MapFailure`]: normal modes, flanks that differ by tooth, no load, or no map that is accurate enough.
    pub fn maps(
        &self,
        pair: &GearPair,
        request: &MapRequest,
        watch: MapWatch<'_>,
    ) -> Result<Vec<ContactMap>, MapFailure> {
        self.check_mapped(pair, request)?;
        let alike = pair.without_pitch_errors();
        let one = |(i, side): (usize, &MeshSide)| {
            let about = request.about(i);
            let projection = FlankProjection::new(&alike, side.flank_side());
            let plan = MapPlan {
                mean_force: request.mean_force,
                largest_force: request.overload * request.mean_force,
                tilt: request.tilts.then(|| request.tilt_range(i, &projection, alike.face_width())),
                width: alike.face_width(),
                half_path: (side.friction_coefficient() != 0.0).then(|| half_path(&alike)),
                tolerance: request.tolerance,
                worst: request.worst,
            };
            let side = side.with_flanks_of(&alike)?;
            let at = |phase: f64| SidePhase::new(&side, &alike, phase, (&projection, &about));
            ContactMap::build(&plan, watch, at).map_err(|e| MapFailure::Map(Box::new(e)))
        };
        self.sides().enumerate().map(one).collect()
    }

    /// Effect of displacements on the flanks of each side, and the offsets of tooth pairs by pitch errors.
    pub fn mapped_sides(&self, pair: &GearPair) -> impl Iterator<Item = (FlankProjection, PairOffsets)> {
        let of = |side: &MeshSide| {
            (FlankProjection::new(pair, side.flank_side()), PairOffsets::new(side.pitch_approaches(pair)))
        };
        self.sides().map(of)
    }

    /// Error of the driving flanks' approach if pitch errors are treated as offsets of a map, compared with the contact
    /// of the teeth with these errors; `None` without pitch errors.
    ///
    /// # Errors
    /// [`MapFailure::Map`] if the contact cannot be solved.
    pub fn offset_error(
        &self,
        pair: &GearPair,
        map: &OffsetMap,
        request: &MapRequest,
    ) -> Result<Option<OffsetError>, MapFailure> {
        let (projection, about) = (FlankProjection::new(pair, self.driving.flank_side()), request.about(0));
        let at = |cycles: f64| SidePhase::new(&self.driving, pair, cycles, (&projection, &about));
        map.error(request.mean_force, at).map_err(|e| MapFailure::Map(Box::new(e)))
    }

    /// Returns an error for flanks that no map can describe.
    ///
    /// # Errors
    /// [`MapFailure::Unmapped`] for such flanks.
    pub fn check_mapped(&self, pair: &GearPair, request: &MapRequest) -> Result<(), MapFailure> {
        let what = if self.driving.contact().modes().is_some() {
            "normal modes of the gears: the contact then depends on their amplitudes"
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

/// Half of the path of contact, mm.
fn half_path(pair: &GearPair) -> f64 {
    let [begin, end] = pair.path_of_contact();
    0.5 * (end - begin).abs()
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
        let rubs = self.side.friction_coefficient() != 0.0;
        let slices = self.side.pressed().map(|(position, force, friction, length, pair)| LoadedSlice {
            force,
            length,
            lever: self.projection.lever(&position),
            pair,
            friction: if rubs { self.projection.rubbing(&position, &friction) } else { [0.0; 3] },
        });
        let stiffness = if rubs {
            self.projection.normal_stiffness(&force.stiffness.column(turn).into_owned())
        } else {
            force.stiffness[(turn, turn)] / (per_turn * per_turn)
        };
        Ok(ContactSample { force: -force.normal[turn] / per_turn, stiffness, slices: slices.collect() })
    }
}
