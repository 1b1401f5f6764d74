//! Derivatives of a solved position by parameters of the pair. Theory (77).
//!
//! | module | what it does |
//! |---|---|
//! | `variation` | a parameter, as two neighbours of the pair |
//! | `conditions` | what the neighbours change of the conditions of contact, forces held |
//! | `direction` | the solution's answer, in either direction of the parameter |
//! | `gap_rates` | the transmission error by the gap at each place of contact |

mod conditions;
mod direction;
mod gap_rates;
mod variation;

use contact::{ContactSet, Friction, TableWork, slice::FlankRates};

use crate::{Equilibrium, StaticError, StaticModel, WindowedPair};

use conditions::{Conditions, Rates};
use direction::Directions;
pub(crate) use gap_rates::gap_rates;
use variation::Touch;
pub use variation::Variation;

/// Derivatives of a position by one parameter, per unit of it.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct PositionRates {
    /// Derivative of the transmission error, mm.
    pub transmission_error: f64,
    /// Derivative of the transmission error without load, mm; NaN if not requested.
    pub kinematic_transmission_error: f64,
    /// Derivative of the secant stiffness F_bt / (te - kinematic te), N/mm; NaN if the unloaded pair was not requested.
    pub secant_stiffness: f64,
    /// Derivative of the largest contact pressure, MPa.
    pub max_pressure: f64,
    /// Derivative of the largest pressure at an end face or a tip edge, MPa; 0 if none is in contact.
    pub max_edge_pressure: f64,
    /// Derivative of the normal force of each tooth pair of the window, N, in the order of
    /// [`crate::StaticPosition::pairs`].
    pub pair_forces: Vec<f64>,
}

/// Derivatives on both sides of a parameter's value.
#[derive(Debug, Clone, PartialEq)]
pub struct Sensitivity {
    /// Derivatives for decreasing and for increasing parameter; both per unit of increase.
    pub sides: [PositionRates; 2],
    /// Whether both are equal: no slice is about to enter or leave contact, none is in contact on a kink.
    pub is_smooth: bool,
}

impl Sensitivity {
    /// The derivative, or the mean of both if they differ.
    pub fn rates(&self) -> PositionRates {
        let [a, b] = &self.sides;
        let middle = |of: fn(&PositionRates) -> f64| 0.5 * (of(a) + of(b));
        PositionRates {
            transmission_error: middle(|r| r.transmission_error),
            kinematic_transmission_error: middle(|r| r.kinematic_transmission_error),
            secant_stiffness: middle(|r| r.secant_stiffness),
            max_pressure: middle(|r| r.max_pressure),
            max_edge_pressure: middle(|r| r.max_edge_pressure),
            pair_forces: a.pair_forces.iter().zip(&b.pair_forces).map(|(a, b)| 0.5 * (a + b)).collect(),
        }
    }
}

/// Parameters of a model, and its flanks at neighbouring values of these parameters.
#[derive(Debug)]
pub struct Sensitivities {
    variations: Vec<Variation>,
    unloaded: bool,
    sets: Option<VariedSets>,
}

/// Flanks of the window as the model has them, and with each parameter a step down and up.
#[derive(Debug)]
struct VariedSets {
    base: ContactSet,
    varied: Vec<([ContactSet; 2], FlankRates)>,
    /// Memory to read tables.
    work: Vec<TableWork>,
}

impl Sensitivities {
    /// Derivatives by several parameters of a model.
    pub fn new(variations: Vec<Variation>) -> Self {
        Self { variations, unloaded: true, sets: None }
    }

    /// Only the derivatives of the loaded pair. Those of the unloaded pair cost as much as all others together.
    #[must_use]
    pub fn of_loaded_pair(self) -> Self {
        Self { unloaded: false, ..self }
    }

    /// Derivatives of the model's last solution, one entry per parameter.
    ///
    /// The contact conditions are differentiated at the solution (implicit differentiation): forces and rotation follow
    /// by one back-substitution per parameter, without solving the contact again. Partial derivatives at constant
    /// forces follow in closed form from positions, directions and curvatures of the loaded slices, for all parameters
    /// together. The error is about 1e-7 where the solution is smooth.
    ///
    /// # Errors
    /// [`StaticError::NoDerivative`] for contact of points, for gears with all their degrees of freedom, without a
    /// solution, and if a loaded slice is about to leave the flanks.
    pub fn of(&mut self, model: &StaticModel) -> Result<Vec<Sensitivity>, StaticError> {
        let options = model.options();
        let Some(e) = model.last().filter(|_| options.torque > 0.0) else {
            return Err(StaticError::NoDerivative { phase: f64::NAN, what: "of a pair without load" });
        };
        let none = |what| StaticError::NoDerivative { phase: e.station.phase, what };
        let set = model.contact_set();
        if set.slices().is_none() || set.windows().is_none() {
            return Err(none("of points, or of gears with all their degrees of freedom"));
        }
        let mut sets = self.sets.take().filter(|s| s.base.shares_flanks(set));
        if let Some(known) = &mut sets {
            for varied in known.varied.iter_mut().flat_map(|(sets, _)| sets) {
                if !varied.move_to(model.gears(), model.window())? {
                    sets = None;
                    break;
                }
            }
        }
        let sets = match sets {
            Some(sets) => self.sets.insert(sets),
            None => self.sets.insert(VariedSets::new(model, &self.variations)?),
        };
        let windowed = WindowedPair { pair: model.pair(), gears: model.gears(), set, window: model.window(), options };
        position(&windowed, e, (&self.variations, self.unloaded), sets)
            .ok_or_else(|| none("where a loaded slice leaves the flanks"))
    }
}

impl VariedSets {
    fn new(model: &StaticModel, variations: &[Variation]) -> Result<Self, StaticError> {
        let set = model.contact_set();
        let of_one = |variation: &Variation| -> Result<([ContactSet; 2], FlankRates), StaticError> {
            let [down, up] = variation.sides.each_ref().map(|side| {
                set.modified(&side.pair, model.gears(), model.window(), &side.options.contact)?.ok_or(
                    StaticError::NoDerivative {
                        phase: f64::NAN,
                        what: "of gears whose windows have matrices of their own",
                    },
                )
            });
            let sets = [down?, up?];
            let rates = FlankRates::between([&sets[0], set, &sets[1]], variation.steps);
            Ok((sets, rates))
        };
        let varied = variations.iter().map(of_one).collect::<Result<_, _>>()?;
        Ok(Self { base: set.clone(), varied, work: set.table_work(set.candidate_count()) })
    }
}

/// Derivatives of a position by all parameters; `None` where a slice that counts is not on the flanks of a neighbour.
fn position(
    windowed: &WindowedPair,
    e: &Equilibrium,
    (variations, unloaded): (&[Variation], bool),
    sets: &mut VariedSets,
) -> Option<Vec<Sensitivity>> {
    let friction = Friction::new(windowed.pair, &windowed.options.contact);
    let at = Conditions::new(windowed, e);
    let here = windowed.set.same_slices(friction.as_ref(), &e.poses, &at.slices)?;
    let at = Conditions { slices: here, ..at };
    let VariedSets { varied, work, .. } = sets;
    let rates = at.rates(windowed, e, friction.as_ref(), variations, varied)?;
    let (turned, rates) = rates.split_first()?;
    let directions = Directions::new(windowed, &at, turned, work);
    let touch = if unloaded { Touch::new(windowed, e) } else { None };
    let of_one = |(variation, rates): (&Variation, &Rates)| {
        let kinematic = if unloaded { variation.kinematic_rates(e, touch.as_ref())? } else { [f64::NAN; 2] };
        directions.follow(windowed, e, rates, kinematic)
    };
    variations.iter().zip(rates).map(of_one).collect()
}
