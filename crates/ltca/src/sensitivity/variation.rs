//! A parameter of a pair, as the pair with a little less and with a little more of it.

use geometry::GearPair;

use crate::{Equilibrium, StaticOptions, WindowedPair, kinematic::Unloaded};

/// A pair with its options: torque, friction, offsets.
#[derive(Debug, Clone)]
pub(crate) struct Neighbour {
    /// The pair.
    pub pair: GearPair,
    /// The options.
    pub options: StaticOptions,
}

/// A parameter that changes what neither meshes nor matrices know: micro-geometry, misalignment, friction, torque.
#[derive(Debug, Clone)]
pub struct Variation {
    pub(super) sides: [Neighbour; 2],
    /// Steps of the parameter down and up, in its own unit.
    pub(super) steps: [f64; 2],
}

impl Variation {
    /// The pair with the parameter less by `steps[0]` and more by `steps[1]`, both above 0 and equal but where a limit
    /// is near. Steps that move flanks by a 300 000th of the normal module serve best.
    pub fn new([down, up]: [(GearPair, StaticOptions); 2], steps: [f64; 2]) -> Self {
        let side = |(pair, options)| Neighbour { pair, options };
        Self { sides: [side(down), side(up)], steps }
    }

    /// Derivatives of a quantity either way, per unit, from its three values with less, as it is and with more of the
    /// parameter. Both are the central difference where they differ by no more than a smooth function's would.
    pub(super) fn rates(&self, values: [f64; 3], smallest: f64) -> [f64; 2] {
        rates(values, self.steps, smallest)
    }

    /// Derivatives of the transmission error without load, mm per unit, either way.
    pub(super) fn kinematic_rates(&self, windowed: &WindowedPair, e: &Equilibrium) -> Option<[f64; 2]> {
        self.rates_at_touch(windowed, e).or_else(|| self.rates_of_neighbours(e))
    }

    /// Derivatives from the gap at the place of touch, which is one of least gap: its motion changes nothing to first
    /// order.
    fn rates_at_touch(&self, windowed: &WindowedPair, e: &Equilibrium) -> Option<[f64; 2]> {
        let (station, rotation) = (e.station, e.unloaded_rotation);
        let here = Unloaded::turned(windowed.pair, &windowed.options.contact, station, rotation);
        let touch = here.polished(e.unloaded_touch.as_ref()?)?;
        let gap = |i: usize| {
            let Neighbour { pair, options } = &self.sides[i];
            Unloaded::turned(pair, &options.contact, station, rotation).gap_at(&touch)
        };
        let rates = self.rates([gap(0)?, here.gap_at(&touch)?, gap(1)?], smallest(windowed.pair));
        Some([here.error_by_gap(&touch, rates[0])?, here.error_by_gap(&touch, rates[1])?])
    }

    /// Derivatives from where the neighbours touch: nominal flanks do so along lines, of which a neighbour's nearest
    /// place decides, and the end of what two flanks face of each other moves.
    fn rates_of_neighbours(&self, e: &Equilibrium) -> Option<[f64; 2]> {
        let error = |i: usize| {
            let Neighbour { pair, options } = &self.sides[i];
            Some(Unloaded::new(pair, &options.contact, e.station).ok()?.transmission_error())
        };
        Some(self.rates([error(0)?, e.kinematic_transmission_error, error(1)?], smallest(&self.sides[0].pair)))
    }
}

/// Change of a gap that is no kink's, mm: what curvature makes of a step of a 300 000th of the normal module.
pub(super) fn smallest(pair: &GearPair) -> f64 {
    pair.pinion.data().normal_module / 1.5e9
}

/// Rates that differ by more than this share of them are those of a kink.
const KINK: f64 = 1e-3;

/// Rates of a quantity below and above the middle of three values, for steps down and up; `smallest` change of the
/// quantity that is none.
pub(super) fn rates([less, here, more]: [f64; 3], [down, up]: [f64; 2], smallest: f64) -> [f64; 2] {
    let [below, above] = [(here - less) / down, (more - here) / up];
    let largest = below.abs().max(above.abs());
    let none = smallest / down.min(up);
    if (above - below).abs() > KINK * largest && (above - below).abs() > none {
        return [below, above];
    }
    // The parabola's slope in the middle.
    [(up * below + down * above) / (down + up); 2]
}
