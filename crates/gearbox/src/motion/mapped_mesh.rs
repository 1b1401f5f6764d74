//! Maps of the exact contact as a mesh in motion. Theory (72), (95).

use std::sync::Arc;

use contact_map::{
    ContactMap, MapContact, MapDamping, MapFriction, MapWatch, OffsetError, OffsetMap, PairOffsets, SplineCache, Wanted,
};
use dynamics::{FlankInstant, MapRequest, MeshFlanks};
use geometry::GearPair;
use nalgebra::SMatrix;

use super::{
    MeshLosses, MovingMesh,
    lever_mesh::{LEVERS, LeverForces, LeverMesh},
};
use crate::{GearboxError, MeshElement, MeshForces, Vector12, mesh_element::finite_cycles};

/// The flanks of a mesh as tables of their exact contact: forces, moments and energy over phase, approach and tilt in
/// the plane of action, for each side. Pitch errors are offsets of the pairs of teeth ([`OffsetMap`]).
#[derive(Debug, Clone)]
pub struct MappedMesh {
    sides: Vec<MappedSide>,
    /// N s/mm a mm of contact line.
    damping_per_length: f64,
    /// Gap of the driving flanks (mm along the normal) beyond which others would touch that are not there.
    room: Option<f64>,
    /// Angles of gear 1 and gear 2 a mesh cycle, rad about +z.
    per_cycle: [f64; 2],
    cycles: f64,
}

/// The flanks on one side.
#[derive(Debug, Clone)]
struct MappedSide {
    map: OffsetMap,
    /// What displacements bring the flanks nearer by, and tilt them by where the map has tilts.
    levers: Vec<Vector12>,
    /// What the parts of friction do to both gears; none of flanks without friction.
    rubs: Vec<Vector12>,
    kept: SplineCache,
    /// Approach (mm) and tilt (rad), 0 without one.
    at: [f64; 2],
    contact: MapContact,
    friction: MapFriction,
}

impl MappedSide {
    /// Approach and tilt, or their rates.
    fn along(&self, displacements: &Vector12) -> [f64; 2] {
        [0, 1].map(|i| self.levers.get(i).map_or(0.0, |lever| lever.dot(displacements)))
    }

    /// Approach and tilt among what moves the levers of all sides, which begins at those of this one.
    #[inline]
    fn own(&self, places: &[f64]) -> [f64; 2] {
        match (places, self.levers.len()) {
            ([approach, tilt, ..], 2) => [*approach, *tilt],
            ([approach, ..], _) => [*approach, 0.0],
            _ => [0.0; 2],
        }
    }

    #[inline]
    fn stand(&mut self, cycles: f64, at: [f64; 2]) {
        self.at = at;
        self.kept.at(&self.map, cycles, at);
    }

    /// The contact where it stands.
    #[inline]
    fn find(&mut self, phase_rate: bool) {
        let wanted = Wanted { energy: false, phase_rate };
        self.contact = self.map.contact(self.kept.last(), self.at[0], wanted);
    }

    /// Friction where the contact was found, as forces on both gears.
    fn friction(&self) -> Vector12 {
        self.rubs.iter().zip(self.friction.force).map(|(lever, force)| force * lever).sum()
    }

    /// How friction follows the displacements.
    fn friction_slope(&self) -> SMatrix<f64, 12, 12> {
        let mut all = SMatrix::zeros();
        for (rubs, slopes) in self.rubs.iter().zip(self.friction.slopes) {
            for (lever, slope) in self.levers.iter().zip(slopes) {
                all += slope * rubs * lever.transpose();
            }
        }
        all
    }

    #[inline]
    fn damping(&self, rates: [f64; 2], per_length: f64) -> MapDamping {
        self.map.map().damping(self.kept.last(), &self.contact, rates, per_length)
    }

    /// Forces along the levers.
    fn forces(&self) -> [f64; 2] {
        [-self.contact.force, self.contact.moment]
    }

    fn overlap(&self) -> f64 {
        self.map.overlap(self.kept.last(), self.at[0])
    }

    /// Force over the largest of the map, and distance of the tilt from the middle of the map's over half their range: the
    /// larger one.
    fn reach(&self) -> f64 {
        let map = self.map.map();
        let force = self.map.force(self.kept.last(), self.at[0]);
        // Without contact a tilt does nothing.
        let tilt = map
            .tilts()
            .filter(|_| force > 0.0)
            .map_or(0.0, |[low, high]| (self.at[1] - 0.5 * (low + high)).abs() / (0.5 * (high - low)));
        (force / map.largest_force()).max(tilt)
    }
}

impl MappedMesh {
    /// Maps the contact of flanks near the positions of their gears; `watch` receives the progress of a map.
    ///
    /// # Errors
    /// [`GearboxError::Unmapped`] for teeth that differ from each other, [`GearboxError::Map`] if no map is accurate
    /// enough.
    pub fn new(
        flanks: &MeshFlanks,
        pair: &GearPair,
        request: &MapRequest,
        watch: MapWatch<'_>,
    ) -> Result<Self, GearboxError> {
        Self::on(flanks, pair, request, flanks.maps(pair, request, watch)?)
    }

    /// The mesh on maps that [`MappedMesh::new`] made for the same flanks and request.
    ///
    /// # Errors
    /// [`GearboxError::Unmapped`] as for [`MappedMesh::new`], and for maps of other flanks: with tilts that were not
    /// requested, or without tilts that were.
    pub fn on(
        flanks: &MeshFlanks,
        pair: &GearPair,
        request: &MapRequest,
        maps: Vec<ContactMap>,
    ) -> Result<Self, GearboxError> {
        flanks.check_mapped(pair, request)?;
        let of_sides: Vec<_> = flanks.mapped_sides(pair).collect();
        let rubs = flanks.friction_coefficient() != 0.0;
        let other = |map: &ContactMap| map.tilts().is_some() != request.tilts || map.has_friction() != rubs;
        if of_sides.len() != maps.len() || maps.iter().any(other) {
            return Err(GearboxError::Unmapped { what: "a mesh that these maps were not made for" });
        }
        let one = |((projection, offsets), map): ((contact::FlankProjection, PairOffsets), ContactMap)| MappedSide {
            map: OffsetMap::new(Arc::new(map), offsets),
            levers: std::iter::once(projection.approach).chain(request.tilts.then_some(projection.tilt)).collect(),
            rubs: projection
                .friction
                .into_iter()
                .chain(request.tilts.then_some(projection.tilt))
                .filter(|_| rubs)
                .collect(),
            kept: SplineCache::default(),
            at: [0.0; 2],
            contact: MapContact::default(),
            friction: MapFriction::default(),
        };
        let sides: Vec<_> = of_sides.into_iter().zip(maps).map(one).collect();
        let room = (sides.len() == 1).then(|| pair.backlash() * pair.base_helix_angle().cos());
        Ok(Self { sides, damping_per_length: 0.0, room, per_cycle: flanks.turns_per_cycle(pair), cycles: 0.0 })
    }

    /// Mesh with dampers on the contact lines, N s/mm per mm, each limited by the force at its position.
    #[must_use]
    pub fn with_damping(self, per_length: f64) -> Self {
        Self { damping_per_length: per_length, ..self }
    }

    /// Mesh that has only driving flanks, which may separate by any distance.
    #[must_use]
    pub fn with_driving_flanks_alone(self) -> Self {
        Self { room: None, ..self }
    }

    /// The maps of teeth in nominal positions: those of the driving flanks and, if present, of the coast flanks.
    pub fn maps(&self) -> impl Iterator<Item = &ContactMap> {
        self.sides.iter().map(|side| side.map.map())
    }

    /// Largest error of its maps: root mean square error of the approach divided by the mean approach
    /// ([`MapRequest::tolerance`]).
    pub fn error(&self) -> f64 {
        self.maps()
            .map(|map| map.certificate().error())
            .fold(0.0, |worst: f64, e| if e > worst || e.is_nan() { e } else { worst })
    }

    /// Error of the driving flanks' approach if pitch errors are treated as offsets, compared with the contact of the
    /// same flanks with these errors; `None` without pitch errors.
    ///
    /// # Errors
    /// [`GearboxError::Map`] if the contact cannot be solved.
    pub fn pitch_error(
        &self,
        flanks: &MeshFlanks,
        pair: &GearPair,
        request: &MapRequest,
    ) -> Result<Option<OffsetError>, GearboxError> {
        let of = |side: &MappedSide| flanks.offset_error(pair, &side.map, request);
        Ok(self.sides.first().map_or(Ok(None), of)?)
    }
}

impl MeshElement for MappedMesh {
    fn go_to(&mut self, cycles: f64) -> Result<(), GearboxError> {
        self.cycles = finite_cycles(cycles)?;
        Ok(())
    }

    fn evaluate(&mut self, displacements: &Vector12) -> Result<MeshForces, GearboxError> {
        let mut all = MeshForces { force: Vector12::zeros(), tangent: SMatrix::zeros(), normal_force: 0.0 };
        for side in &mut self.sides {
            side.stand(self.cycles, side.along(displacements));
            side.find(true);
            all.normal_force += side.contact.force;
            for ((a, force), row) in side.levers.iter().zip(side.forces()).zip(&side.contact.stiffness) {
                all.force += force * a;
                for (b, stiffness) in side.levers.iter().zip(row) {
                    all.tangent -= *stiffness * a * b.transpose();
                }
            }
            if side.map.map().has_friction() {
                side.friction = side.map.friction(side.kept.last(), side.at[0], &side.contact);
                all.force += side.friction();
                all.tangent += side.friction_slope();
            }
        }
        Ok(all)
    }

    /// Refuses a place at which flanks that are not there would touch.
    fn check(&mut self) -> Result<(), GearboxError> {
        let (Some(backlash_mm), Some(driving)) = (self.room, self.sides.first()) else { return Ok(()) };
        let gap_mm = -driving.overlap();
        if gap_mm <= backlash_mm { Ok(()) } else { Err(GearboxError::BeyondBacklash { gap_mm, backlash_mm }) }
    }
}

impl MovingMesh for MappedMesh {
    fn period(&self) -> u64 {
        self.sides.first().and_then(|side| side.map.offsets()).map_or(1, PairOffsets::period)
    }

    fn energy(&self) -> f64 {
        self.sides.iter().map(|side| side.map.energy(side.kept.last(), side.at[0])).sum()
    }

    fn energy_rate(&self) -> f64 {
        self.sides.iter().map(|side| side.contact.phase_rate).sum()
    }

    fn losses(&mut self, rates: &Vector12, cycles: f64) -> MeshLosses {
        let mut all = MeshLosses::default();
        all.friction = self.sides.iter().map(MappedSide::friction).sum();
        all.along_cycles = all.friction[5] * self.per_cycle[0] + all.friction[11] * self.per_cycle[1];
        // Of the whole sliding, that of the nominal turn and that of the deviations.
        all.dissipated = 0.0 - (all.friction.dot(rates) + all.along_cycles * cycles);
        for side in &self.sides {
            let own = side.along(rates);
            let found = side.damping(own, self.damping_per_length);
            for (i, a) in side.levers.iter().enumerate() {
                all.force -= found.force[i] * a;
                all.dissipated += found.force[i] * own[i];
                for (b, slope) in side.levers.iter().zip(found.rate_slope[i]) {
                    all.rate_slope += slope * a * b.transpose();
                }
            }
            all.slope += found.approach_slope * side.levers[0] * side.levers[0].transpose();
        }
        all
    }

    fn by_side(&mut self, rates: &Vector12, _: f64) -> Result<[FlankInstant; 2], GearboxError> {
        let of = |side: &MappedSide| {
            let found = side.damping(side.along(rates), self.damping_per_length);
            let (force, damping, line_length) = (side.contact.force, found.force[0], found.length);
            FlankInstant { force, damping, line_length, ..FlankInstant::default() }
        };
        Ok([0, 1].map(|i| self.sides.get(i).map_or_else(FlankInstant::default, of)))
    }

    fn overlaps(&mut self) -> Result<[f64; 2], GearboxError> {
        Ok([0, 1].map(|i| self.sides.get(i).map_or(f64::NEG_INFINITY, MappedSide::overlap)))
    }

    fn levers(&self) -> Option<Vec<Vector12>> {
        // Friction acts along levers of its own, those along the tilt are there.
        let of = |side: &MappedSide| side.levers.iter().chain(side.rubs.iter().take(3)).copied().collect::<Vec<_>>();
        Some(self.sides.iter().flat_map(of).collect())
    }

    fn by_levers(&mut self) -> Option<&mut dyn LeverMesh> {
        let rubs = self.sides.iter().any(|side| side.map.map().has_friction());
        (!rubs).then_some(self as &mut dyn LeverMesh)
    }

    fn reach(&self) -> f64 {
        self.sides.iter().map(MappedSide::reach).fold(0.0, f64::max)
    }
}

impl LeverMesh for MappedMesh {
    fn stand(&mut self, cycles: f64, places: &[f64; LEVERS]) {
        self.cycles = cycles;
        let mut first = 0;
        for side in &mut self.sides {
            side.stand(cycles, side.own(&places[first..]));
            first += side.levers.len();
        }
    }

    fn answer(&mut self, rates: &[f64; LEVERS], energy_rate: bool, out: &mut LeverForces) {
        (out.energy_rate, out.dissipated) = (0.0, 0.0);
        let mut first = 0;
        for side in &mut self.sides {
            side.find(energy_rate);
            let (own, count) = (side.own(&rates[first..]), side.levers.len());
            let damping = side.damping(own, self.damping_per_length);
            out.energy_rate += side.contact.phase_rate;
            for ((i, elastic), damped) in side.forces().into_iter().enumerate().zip(damping.force).take(count) {
                let at = first + i;
                out.elastic[at] = elastic;
                out.damping[at] = -damped;
                out.dissipated += damped * own[i];
                for j in 0..count {
                    out.stiffness[at][first + j] = side.contact.stiffness[i][j];
                    out.rate_slope[at][first + j] = damping.rate_slope[i][j];
                }
            }
            out.slope[first] = damping.approach_slope;
            first += count;
        }
    }
}
