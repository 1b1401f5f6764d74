//! Making maps of a pair's contact.

use std::sync::Arc;

use contact_map::{ContactMap, MapError, MapPlan, MapWatch, OffsetError, OffsetMap, PairOffsets};
use nalgebra::{DMatrix, DVector, SMatrix};

use super::{MapExcess, MappedPair, MappedSide, Projection, SplineCache, sampler::SidePhase};
use crate::{COORDINATES, Displacement, Drive, PairMechanism, PairMotionError, Speed, start::quasi_static_balance};
use ltca::StaticError;

/// What maps of a pair must hold, and how well.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MapRequest {
    /// Largest force over that of the load at the start.
    pub overload: f64,
    /// Root mean square of the approach's error over the mean approach that is aimed at.
    pub tolerance: f64,
    /// Largest root mean square of the approach's error over the mean approach of a map that is taken: of one that some
    /// hundred mesh cycles at rest cannot refine.
    pub worst: f64,
    /// Approximate lag of the driven gear under the load, mm.
    pub lag: f64,
}

/// Phases of a mesh cycle at which the pair stands under its load.
const STANDS: usize = 8;

impl MappedPair {
    /// Maps the contact of a pair about where it stands under its load; `watch` hears how far each map is.
    ///
    /// # Errors
    /// [`PairMotionError::Unmapped`] where a map cannot hold what the contact depends on: normal modes of the gears,
    /// friction, flanks by tooth, root stress; [`PairMotionError::Map`] where none is good enough; those of the start.
    pub fn new(mut system: PairMechanism, request: &MapRequest, watch: MapWatch<'_>) -> Result<Self, PairMotionError> {
        refuse(&system)?;
        // Teeth at their nominal places: pitch errors are offsets of their pairs.
        let pair = system.pair().without_pitch_errors();
        let Stands { force, all: stands, about } = Stands::of(&mut system, request.lag)?;
        let mut maps = Vec::new();
        for side in system.sides() {
            let projection = Projection::new(&pair, side.flank_side());
            let tilts = has_tilt(&system, &projection);
            let alike = side.with_flanks_of(&pair).map_err(|source| PairMotionError::contact(0.0, source))?;
            let plan = MapPlan {
                mean_force: force,
                largest_force: request.overload * force,
                tilt: tilts.then(|| tilt_range(&stands, &projection, &pair)),
                width: pair.face_width(),
                tolerance: request.tolerance,
                worst: request.worst,
            };
            let at = |phase: f64| {
                let side = alike.copy_at(&pair, phase)?;
                Ok(SidePhase { pair: &pair, side, cycles: phase, projection: &projection, about: &about })
            };
            let made = ContactMap::build(&plan, watch, at)
                .map_err(|e: MapError<StaticError>| PairMotionError::Map { source: Box::new(e) })?;
            maps.push((projection, Arc::new(made)));
        }
        Ok(Self::of(system, maps))
    }

    /// Error of the approach of the driving flanks by pitch errors as offsets, beside the contact of the teeth with these
    /// errors; `None` without any. `lag`: about that of the driven gear under the load, mm.
    ///
    /// # Errors
    /// [`PairMotionError::Map`] where the contact cannot be solved; those of the start.
    pub fn pitch_error(&mut self, lag: f64) -> Result<Option<OffsetError>, PairMotionError> {
        let Some(own) = self.sides.first().filter(|own| own.map.offsets().is_some()) else { return Ok(None) };
        let Stands { force, about, .. } = Stands::of(&mut self.system, lag)?;
        let Some(side) = self.system.sides().next() else { return Ok(None) };
        let pair = self.system.pair();
        let at = |cycles: f64| {
            let side = side.copy_at(pair, cycles)?;
            Ok(SidePhase { pair, side, cycles, projection: &own.projection, about: &about })
        };
        own.map.error(force, at).map_err(|e: MapError<StaticError>| PairMotionError::Map { source: Box::new(e) })
    }

    /// Whether a pair has as many sides, and tilts where these have, as some maps.
    pub fn can_stand_on(system: &PairMechanism, maps: &[ContactMap]) -> bool {
        let sides = system.sides().map(|side| Projection::new(system.pair(), side.flank_side()));
        let tilts: Vec<bool> = sides.map(|projection| has_tilt(system, &projection)).collect();
        tilts.len() == maps.len() && tilts.iter().zip(maps).all(|(tilts, map)| *tilts == map.tilts().is_some())
    }

    /// The pair on maps that were made for it before.
    ///
    /// # Errors
    /// [`PairMotionError::Unmapped`] as [`MappedPair::new`], and for maps that [`MappedPair::can_stand_on`] refuses.
    pub fn on(system: PairMechanism, maps: Vec<ContactMap>) -> Result<Self, PairMotionError> {
        refuse(&system)?;
        if !Self::can_stand_on(&system, &maps) {
            return Err(PairMotionError::Unmapped { what: "a pair that these maps were not made for" });
        }
        let sides: Vec<Projection> =
            system.sides().map(|side| Projection::new(system.pair(), side.flank_side())).collect();
        Ok(Self::of(system, sides.into_iter().zip(maps.into_iter().map(Arc::new)).collect()))
    }

    /// The pair at its start on its maps, with another speed or torque of the driver.
    ///
    /// # Errors
    /// [`PairMotionError::Unmapped`] for a drive that frees other coordinates; those of the contact.
    pub fn with_drive(&self, drive: Drive) -> Result<Self, PairMotionError> {
        if std::mem::discriminant(&drive) != std::mem::discriminant(&self.system.options().drive) {
            return Err(PairMotionError::Unmapped { what: "a driver that is driven in another way" });
        }
        let system = self.system.with_drive(drive).map_err(|source| PairMotionError::contact(0.0, source))?;
        Ok(Self::of(system, self.sides.iter().map(|side| (side.projection, side.map.shared())).collect()))
    }

    /// The pair at its start on its maps, under the mean of its load.
    ///
    /// # Errors
    /// Those of the contact.
    pub fn under_mean_load(&self) -> Result<Self, PairMotionError> {
        let mut pair = self.again()?;
        pair.system.hold_mean_load();
        Ok(pair)
    }

    /// The mechanism whose speed, load and mesh damping may be changed: maps know none of them.
    pub fn system_mut(&mut self) -> &mut PairMechanism {
        &mut self.system
    }

    /// The pair at its start on its maps.
    ///
    /// # Errors
    /// Those of the contact.
    pub fn again(&self) -> Result<Self, PairMotionError> {
        self.with_drive(self.system.options().drive.clone())
    }

    fn of(system: PairMechanism, maps: Vec<(Projection, Arc<ContactMap>)>) -> Self {
        let (n, map) = (system.count(), system.coordinates().map().clone());
        let loading = map.transpose() * drive_balance(&system);
        let [bearing, damping] = system.bearings();
        let on_coordinates = |m: &SMatrix<f64, 12, 12>| &loading * m * &map;
        let offsets = system.sides().map(|side| PairOffsets::new(side.pitch_approaches(system.pair())));
        let sides: Vec<MappedSide> = maps
            .into_iter()
            .zip(offsets)
            .map(|((projection, made), offsets)| MappedSide {
                map: OffsetMap::new(made, offsets),
                approach: map.tr_mul(&projection.approach),
                tilt: map.tr_mul(&projection.tilt),
                damped: [&projection.approach, &projection.tilt].map(|f| &loading * f),
                answered: [&projection.approach, &projection.tilt].map(|f| &loading * f - map.tr_mul(f)),
                projection,
            })
            .collect();
        let statics = &system.options().statics;
        let driver = 1 - statics.driven();
        let phase_of_driver = system.coordinates().driver_turn().map(|i| (i, system.cycles_per_turn(driver)));
        Self {
            mass: integrate::Mechanism::mass(&system).clone(),
            bearing: unless_zero(map.transpose() * bearing * &map),
            taken: map.transpose() * damping * &map,
            damping: unless_zero(on_coordinates(&damping)),
            gyroscopic: unless_zero(on_coordinates(&system.gyroscopic_at_unit_speed())),
            loading: DMatrix::from_fn(n, 12, |i, j| loading[(i, j)]),
            kept: vec![SplineCache::default(); sides.len()],
            sides,
            phase_of_driver,
            excess: MapExcess::default(),
            system,
        }
    }
}

/// A matrix that does something.
fn unless_zero(matrix: DMatrix<f64>) -> Option<DMatrix<f64>> {
    Some(matrix).filter(|m| m.iter().any(|x| *x != 0.0))
}

/// Whether free coordinates tilt the flanks in the plane of action.
fn has_tilt(system: &PairMechanism, projection: &Projection) -> bool {
    system.coordinates().map().tr_mul(&projection.tilt).amax() > 1e-12
}

/// Refuses motions that no map holds.
fn refuse(system: &PairMechanism) -> Result<(), PairMotionError> {
    let what = if system.has_modes() {
        "normal modes of the gears: the contact then depends on their amplitudes"
    } else if system.options().statics.contact.friction > 0.0 {
        "friction: it turns round with the sliding"
    } else if system.has_own_flanks() {
        "flanks by tooth: the contact then comes back after whole turns, not after a mesh cycle"
    } else {
        return Ok(());
    };
    Err(PairMotionError::Unmapped { what })
}

/// Where a pair stands under its mean load.
struct Stands {
    /// Force along the normal, N.
    force: f64,
    /// Displacements at phases of a mesh cycle, and their mean.
    all: Vec<Displacement>,
    about: Displacement,
}

impl Stands {
    fn of(system: &mut PairMechanism, lag: f64) -> Result<Self, PairMotionError> {
        // A load that swings would not let the pair stand: the map is made about its mean.
        let swinging = system.hold_mean_load();
        let load = system.load_on_lag(0.0).abs();
        if load <= 0.0 {
            return Err(PairMotionError::Unmapped { what: "a pair without load: nothing says what forces occur" });
        }
        // A map knows no speed: gears that stand still are looked at as they turn slowly.
        let speed = system.nominal().speed;
        if system.time_of_cycles(1.0).is_none() {
            system.set_speed(Speed::Constant(1.0));
        }
        let all = stands(system, lag)?;
        system.set_speed(speed);
        system.set_load(swinging);
        let about = all.iter().sum::<Displacement>() / all.len() as f64;
        // Force along the normal of a force on the base circle.
        Ok(Self { force: load / system.pair().base_helix_angle().cos(), all, about })
    }
}

/// Displacements of the pair at rest under its load, at phases of a mesh cycle.
fn stands(system: &mut PairMechanism, lag: f64) -> Result<Vec<Displacement>, PairMotionError> {
    let scale = system.coordinates().scales(system.motion_size(lag), system.pair().pinion.base_radius());
    let mut q: Option<DVector<f64>> = None;
    let mut all = Vec::new();
    for i in 0..STANDS {
        let cycles = i as f64 / STANDS as f64;
        let Some(time) = system.time_of_cycles(cycles) else {
            return Err(integrate::MotionError::StandsStill { cycle: 0 }.into());
        };
        let there = quasi_static_balance(system, time, lag, q.take(), &scale)?;
        all.push(system.coordinates().displacement(&there));
        q = Some(there);
    }
    integrate::Mechanism::forget(system);
    Ok(all)
}

/// Tilts that the pair has at rest, and as much on either side as half a deflection over the face width makes.
fn tilt_range(stands: &[Displacement], projection: &Projection, pair: &geometry::GearPair) -> [f64; 2] {
    let all = || stands.iter().map(|d| projection.tilt.dot(d));
    let deflection = stands.iter().map(|d| projection.approach.dot(d).abs()).fold(0.0, f64::max);
    let [low, high] = [all().fold(f64::MAX, f64::min), all().fold(f64::MIN, f64::max)];
    let margin = (0.5 * deflection / pair.face_width()).max(2.0 * (high - low));
    [low - margin, high + margin]
}

/// P: forces on the twelve coordinates with the torque of a driver that balances them. Theory (45b).
fn drive_balance(system: &PairMechanism) -> SMatrix<f64, 12, 12> {
    let mut all = SMatrix::<f64, 12, 12>::identity();
    if !matches!(system.options().drive, Drive::Balanced(_)) {
        return all;
    }
    let driven = system.options().statics.driven();
    let turn = |g: usize| COORDINATES * (g + 1) - 1;
    for g in 0..2 {
        let mut one = Displacement::zeros();
        one[turn(g)] = 1.0;
        all[(turn(1 - driven), turn(g))] += system.balancing_torque(&one);
    }
    all
}
