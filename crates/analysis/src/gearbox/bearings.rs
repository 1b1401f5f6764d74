//! Bearings of a gearbox file in the form that the solver needs, and the results of those with rolling elements.

use crate::remark;
use gearbox::{
    Bearing, GearboxError, GearboxPosition, Train,
    rolling_bearing::{
        AxialSeat, AxialSetting, BallGeometry, BoundaryDimensions, Catalogue, ElementLoad, Filling, LifeModification,
        RollerGeometry, RollerProfile, RollingBearing, RollingBearingError, RollingElements, RollingFriction,
        RollingState, Row,
    },
};
use nalgebra::{Matrix6, Vector5};
use scene::gearbox::{AxialPlay, Gearbox, GearboxBearing, GearboxRolling, RollingKind, RollingSize, ThrustSeat};

/// Tilts that catalogues let deep groove balls and rollers have at most, 10 and 4 minutes, rad.
const BALLS_TILT: f64 = 2.9e-3;
const ROLLERS_TILT: f64 = 1.2e-3;

/// Equivalent load over the dynamic rating up to which formulas of lives hold (ISO 281).
const HALF: f64 = 0.5;

/// Speed times pitch diameter above which centrifugal forces of rolling elements count (rule of thumb), mm/min.
const FAST: f64 = 5e5;

/// Results of a rolling bearing over all positions.
#[derive(Debug, Clone, PartialEq)]
pub struct RollingLoad {
    /// Rolling elements, as given or estimated.
    pub elements: RollingElements,
    /// Number of rolling elements of all rows.
    pub count: usize,
    /// Whether they are estimated, from catalogue values or from boundary dimensions.
    pub is_estimated: bool,
    /// Static and dynamic rating C_0 and C, N; C if it is given or can be estimated from a designation.
    pub ratings: (f64, Option<f64>),
    /// Whether the dynamic rating is estimated.
    pub is_rating_estimated: bool,
    /// S_0 of ISO 76 at the largest pressure; `None` without load.
    pub static_safety: Option<f64>,
    /// Mean of its tangents: x, y, z and the rotations about x and y, N/mm, N, N mm.
    pub stiffness: [[f64; 5]; 5],
    /// Largest force of a rolling element, N.
    pub element_force: f64,
    /// Largest Hertz pressure, MPa.
    pub pressure: f64,
    /// Smallest and largest number of loaded rolling elements.
    pub loaded: [usize; 2],
    /// Rolling elements with the means of their forces over all positions.
    pub zone: Vec<ElementLoad>,
    /// Speed of its shaft, 1/min, if it is rated.
    pub speed_rpm: Option<f64>,
    /// Its life, if its dynamic rating and a speed are known and it is loaded.
    pub life: Option<BearingLife>,
    /// Life under the load spectrum, h, as in [`BearingLife::rated_hours`]; `None` if it has no life, or an infinite
    /// one.
    pub spectrum_life_h: Option<f64>,
    /// Power loss, W, if speed and viscosity are known.
    pub loss_w: Option<f64>,
}

/// Life of a rolling bearing at 90 % reliability.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BearingLife {
    /// L_10r, millions of rotations of the shaft.
    pub million_turns: f64,
    /// P_ref: radial load that gives the same life, N.
    pub equivalent_load: f64,
    /// P_ref divided by C.
    pub over_rating: f64,
    /// Life, h.
    pub hours: f64,
    /// Whether lubrication and contamination are to be included.
    pub asks_modified: bool,
    /// Modification of the life (a_ISO), if ISO 281 covers the bearing.
    pub modification: Option<LifeModification>,
}

impl BearingLife {
    /// The modified life if lubrication and contamination are to be included, otherwise the basic life, h; `None` if
    /// ISO 281 gives no modified life.
    pub fn rated_hours(&self) -> Option<f64> {
        if self.asks_modified { self.modified_hours() } else { Some(self.hours) }
    }

    /// The modified life, h.
    pub fn modified_hours(&self) -> Option<f64> {
        self.modification.map(|own| own.factor * self.hours)
    }
}

/// How the shaft of a bearing turns, and in which oil.
#[derive(Debug, Clone, Copy)]
pub(super) struct BearingTurns {
    /// Speed, 1/min, above 0.
    pub speed_rpm: f64,
    /// Kinematic viscosity, mm^2/s.
    pub viscosity: Option<f64>,
    /// e_C.
    pub contamination_factor: Option<f64>,
}

impl BearingTurns {
    /// Rotation speed of a bearing at a speed of the input, 1/min; `None` if it does not rotate, or carries nothing
    /// because its shaft is held.
    pub fn of((file, train): (&Gearbox, &Train), bearing: usize, input_speed_rpm: f64) -> Option<Self> {
        let GearboxBearing { shaft, in_shaft, .. } = file.bearings[bearing];
        // Its rings turn against each other.
        let seat = in_shaft.map_or(0.0, |seat| train.ratios_in_space()[seat]);
        let speed_rpm = input_speed_rpm * (train.ratios_in_space()[shaft] - seat).abs();
        let asked = file.rating.as_ref().filter(|_| speed_rpm > 0.0 && !file.shafts[shaft].held)?;
        Some(Self { speed_rpm, viscosity: asked.viscosity, contamination_factor: asked.contamination_factor })
    }
}

/// How far a bearing leaves the range of the formulas of lives, under one load or the worst of several.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct LifeLimits {
    /// Largest P_ref over C.
    pub over_rating: f64,
    /// Whether some load has no modified life, though that is asked for.
    pub lacks_film: bool,
    /// Largest speed, 1/min.
    pub speed_rpm: f64,
}

impl LifeLimits {
    /// Limits of a bearing under one load.
    pub fn of(load: &RollingLoad) -> Self {
        Self {
            over_rating: load.life.map_or(0.0, |life| life.over_rating),
            lacks_film: load.life.is_some_and(|life| life.asks_modified && life.modification.is_none()),
            speed_rpm: load.speed_rpm.unwrap_or(0.0),
        }
    }

    /// The worse of two limits in each respect.
    pub fn worse(self, other: Self) -> Self {
        Self {
            over_rating: self.over_rating.max(other.over_rating),
            lacks_film: self.lacks_film || other.lacks_film,
            speed_rpm: self.speed_rpm.max(other.speed_rpm),
        }
    }
}

/// Life at the mean of 1/L over some states (Miner), at the speed of the shaft; `None` without rating or load.
fn life(
    own: &GearboxRolling,
    law: &RollingBearing,
    states: &[(&RollingState, &[f64])],
    turns: &BearingTurns,
) -> Option<BearingLife> {
    let rating = dynamic_rating(own, law.elements())?;
    let damage = |&(s, laminae): &(&RollingState, &[f64])| match laminae {
        [] => law.damage(&Vector5::from_fn(|k, _| s.displacement[k]), rating),
        laminae => law.damage_of(laminae, rating),
    };
    let used = states.iter().map(damage).sum::<f64>() / states.len().max(1) as f64;
    if used.is_nan() || used <= 0.0 {
        return None;
    }
    let exponent = if has_balls(own.kind) { 3.0 } else { 10.0 / 3.0 };
    let equivalent_load = rating * used.powf(1.0 / exponent);
    let speed_rpm = turns.speed_rpm;
    let modification = turns.viscosity.zip(turns.contamination_factor).and_then(|(viscosity, dirt)| {
        LifeModification::new(law.elements(), own.rows.len(), (speed_rpm, viscosity), (dirt, equivalent_load))
    });
    Some(BearingLife {
        million_turns: 1.0 / used,
        equivalent_load,
        over_rating: equivalent_load / rating,
        hours: 1e6 / used / (60.0 * speed_rpm),
        asks_modified: turns.viscosity.is_some() && turns.contamination_factor.is_some(),
        modification,
    })
}

/// All bearings.
pub(super) fn bearings(file: &Gearbox) -> Result<Vec<Bearing>, GearboxError> {
    file.bearings.iter().map(bearing).collect()
}

fn bearing(own: &GearboxBearing) -> Result<Bearing, GearboxError> {
    let stiffness = Matrix6::from_fn(|i, j| own.stiffness[i][j]);
    let linear = Bearing {
        outer: own.in_shaft,
        bore_of: own.in_bore_of,
        offset: own.seat_offset.into(),
        damping: Matrix6::from_fn(|i, j| if i == j && i < 3 { own.damping[i] } else { 0.0 }),
        ..Bearing::linear(&own.name, own.shaft, own.position, stiffness)
    };
    let Some(rolling) = &own.rolling else { return Ok(linear) };
    let law = law(rolling).map_err(|source| GearboxError::Bearing { bearing: own.name.clone(), source })?;
    Ok(Bearing { law: Some(law.into()), ..linear })
}

fn law(own: &GearboxRolling) -> Result<RollingBearing, RollingBearingError> {
    let rows: Vec<Row> =
        own.rows.iter().map(|[position, thrust]| Row { position: *position, thrust: *thrust }).collect();
    let axial = match own.axial {
        AxialPlay::Clearance(way) => AxialSetting::Clearance(way),
        AxialPlay::Preload(force) => AxialSetting::Preload(force),
    };
    let seat = match own.seat {
        ThrustSeat::Held => AxialSeat::Held,
        ThrustSeat::Floating => AxialSeat::Floating,
        ThrustSeat::Shoulder(way) => AxialSeat::Shoulder(way),
    };
    Ok(RollingBearing::new(elements(own)?, &rows, own.radial_clearance, axial)?.in_seat(seat))
}

fn elements(own: &GearboxRolling) -> Result<RollingElements, RollingBearingError> {
    let GearboxRolling { contact_angle, conformity, .. } = *own;
    let profile = if own.straight_rollers { RollerProfile::Straight } else { RollerProfile::Logarithmic };
    let has_balls = has_balls(own.kind);
    let filling = if own.kind == RollingKind::DeepGrooveBall { Filling::Eccentric } else { Filling::Around };
    Ok(match own.size {
        RollingSize::Elements { elements, diameter, pitch_diameter, .. } if has_balls => {
            let elements = elements as usize;
            RollingElements::Balls(BallGeometry { elements, diameter, pitch_diameter, contact_angle, conformity })
        }
        RollingSize::Elements { elements, diameter, length, pitch_diameter } => {
            let elements = elements as usize;
            let own = RollerGeometry { elements, diameter, length, pitch_diameter, contact_angle, profile };
            RollingElements::Rollers(own)
        }
        RollingSize::Catalogue { bore, outer_diameter, static_rating } => {
            let catalogue = Catalogue { bore, outer_diameter, static_rating, rows: own.rows.len() };
            if has_balls {
                RollingElements::Balls(catalogue.balls(filling, contact_angle, conformity)?)
            } else {
                RollingElements::Rollers(catalogue.rollers(contact_angle, profile)?)
            }
        }
        RollingSize::Dimensions { bore, outer_diameter, width } => {
            let dimensions = BoundaryDimensions { bore, outer_diameter, width };
            if has_balls {
                RollingElements::Balls(dimensions.balls(filling, contact_angle, conformity)?)
            } else {
                RollingElements::Rollers(dimensions.rollers(contact_angle, profile)?)
            }
        }
    })
}

/// C as it is stated, or estimated of a bearing with a designation, N.
fn dynamic_rating(own: &GearboxRolling, elements: &RollingElements) -> Option<f64> {
    own.dynamic_rating.or_else(|| own.designation.as_ref().map(|_| elements.dynamic_rating(own.rows.len())))
}

fn has_balls(kind: RollingKind) -> bool {
    matches!(kind, RollingKind::DeepGrooveBall | RollingKind::AngularContactBall)
}

/// What is read off a rolling bearing; `None` for others. `turns`: what its life and its loss are told for.
pub(super) fn rolling_load(
    own: &GearboxBearing,
    bearing: &Bearing,
    positions: &[GearboxPosition],
    (i, turns): (usize, Option<BearingTurns>),
) -> Option<RollingLoad> {
    let (rolling, law) = (own.rolling.as_ref()?, bearing.law.as_ref()?);
    let state = |p| -> Option<(&RollingState, &[f64])> {
        let p: &GearboxPosition = p;
        Some((p.rolling.get(i)?.as_ref()?, p.laminae.get(i)?))
    };
    let on_elements: Vec<(&RollingState, &[f64])> = positions.iter().filter_map(state).collect();
    let states: Vec<&RollingState> = on_elements.iter().map(|own| own.0).collect();
    let share = 1.0 / states.len().max(1) as f64;
    let mean = share * states.iter().map(|s| s.stiffness).sum::<Matrix6<f64>>();
    let most = |of: &dyn Fn(&RollingState) -> f64| states.iter().map(|s| of(s)).fold(0.0, f64::max);
    let loaded = || states.iter().map(|s| s.loaded);
    let pressure = most(&|s| s.pressure);
    let elements = law.elements();
    Some(RollingLoad {
        ratings: (elements.static_rating(rolling.rows.len()), dynamic_rating(rolling, elements)),
        is_rating_estimated: rolling.dynamic_rating.is_none() && rolling.designation.is_some(),
        static_safety: elements.static_safety(pressure),
        elements: *law.elements(),
        count: law.count(),
        is_estimated: !matches!(rolling.size, RollingSize::Elements { .. }),
        stiffness: std::array::from_fn(|k| std::array::from_fn(|m| mean[(k, m)])),
        element_force: most(&|s| s.element_force),
        pressure,
        loaded: [loaded().min().unwrap_or(0), loaded().max().unwrap_or(0)],
        zone: mean_zone(law, &on_elements),
        speed_rpm: turns.map(|turns| turns.speed_rpm),
        spectrum_life_h: None,
        life: turns.as_ref().and_then(|turns| life(rolling, law, &on_elements, turns)),
        loss_w: turns.and_then(|turns| {
            let (speed, viscosity) = (turns.speed_rpm, turns.viscosity?);
            let lost = |s: &&RollingState| {
                let forces = [s.force[0].hypot(s.force[1]), s.force[2].abs()];
                RollingFriction::new(law.elements(), rolling.rows.len(), forces, (speed, viscosity)).power_w(speed)
            };
            Some(share * states.iter().map(lost).sum::<f64>())
        }),
    })
}

/// Rolling elements with the means of their forces; none without a state.
fn mean_zone(law: &RollingBearing, states: &[(&RollingState, &[f64])]) -> Vec<ElementLoad> {
    let mut zones = states.iter().map(|(s, laminae)| match laminae {
        [] => law.load_zone(&s.displacement.fixed_rows::<5>(0).into_owned()),
        laminae => law.zone_of(laminae),
    });
    let Some(mut mean) = zones.next() else { return Vec::new() };
    zones.for_each(|zone| mean.iter_mut().zip(zone).for_each(|(sum, own)| sum.force += own.force));
    mean.iter_mut().for_each(|own| own.force /= states.len() as f64);
    mean
}

/// One note on all bearings whose inside or rating is estimated; none without.
pub(super) fn estimates<'a>(all: impl Iterator<Item = (&'a str, &'a RollingLoad)>) -> Option<answer::Remark> {
    let of = |(name, load): (&str, &RollingLoad)| {
        let inside = load.is_estimated.then(|| match &load.elements {
            RollingElements::Balls(b) => {
                format!("{} balls of {:.2} mm on a circle of {:.1} mm", b.elements, b.diameter, b.pitch_diameter)
            }
            RollingElements::Rollers(r) => {
                let size = format!("{:.2} x {:.2} mm", r.diameter, r.length);
                format!("{} rollers of {size} on a circle of {:.1} mm", r.elements, r.pitch_diameter)
            }
        });
        let (static_n, dynamic_n) = load.ratings;
        let rating = dynamic_n.filter(|_| load.is_rating_estimated);
        let rating = rating.map(|dynamic_n| format!("C {:.1} kN, C_0 {:.1} kN", 1e-3 * dynamic_n, 1e-3 * static_n));
        let words: Vec<String> = inside.into_iter().chain(rating).collect();
        (!words.is_empty()).then(|| format!("{name}: {}", words.join(", ")))
    };
    let told: Vec<String> = all.filter_map(of).collect();
    (!told.is_empty()).then(|| remark::bearings_estimated(told.len(), told.join("; ")))
}

/// What the user should hear of a rolling bearing; `worst`: under the worst of all loads of a spectrum as well.
pub(super) fn remarks(
    name: &str,
    is_held: bool,
    (tilt, load): (f64, &RollingLoad),
    worst: LifeLimits,
) -> Vec<answer::Remark> {
    let mut said = Vec::new();
    if is_held {
        said.push(remark::bearing_on_held_shaft(name));
    } else if load.loaded[1] == 0 {
        said.push(remark::bearing_unloaded(name));
    }
    let dent = load.elements.dent_pressure();
    let (most, what) = match load.elements {
        RollingElements::Balls(_) => (BALLS_TILT, "ball"),
        RollingElements::Rollers(_) => (ROLLERS_TILT, "roller"),
    };
    if tilt > most && load.loaded[1] > 0 {
        let (tilt, most) = (1e3 * tilt, 1e3 * most);
        said.push(remark::bearing_tilts(name, tilt, what, most));
    }
    said.extend((worst.over_rating > HALF).then(|| remark::bearing_life_outside(name, worst.over_rating)));
    said.extend(worst.lacks_film.then(|| remark::bearing_film_outside(name)));
    let speed_factor = worst.speed_rpm * load.elements.pitch_diameter();
    said.extend((speed_factor > FAST && !is_held).then(|| remark::bearing_fast(name, speed_factor, FAST)));
    if load.pressure > dent {
        let pressure = load.pressure;
        said.push(remark::bearing_pressure(name, pressure, what, dent));
    }
    said
}
