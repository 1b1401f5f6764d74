//! A parameter of a pair, given by the pairs with slightly smaller and slightly larger values.

use geometry::GearPair;

use crate::{
    Equilibrium, StaticOptions, WindowedPair,
    kinematic::{Nearest, Unloaded},
};

/// A pair with its options: torque, friction, offsets.
#[derive(Debug, Clone)]
pub(crate) struct Neighbour {
    /// The pair.
    pub pair: GearPair,
    /// The options.
    pub options: StaticOptions,
}

/// A parameter on which meshes and matrices do not depend: micro-geometry, misalignment, friction, torque.
#[derive(Debug, Clone)]
pub struct Variation {
    pub(super) sides: [Neighbour; 2],
    /// Steps of the parameter down and up, in its own unit.
    pub(super) steps: [f64; 2],
}

impl Variation {
    /// Takes the pairs with the parameter decreased by `steps[0]` and increased by `steps[1]`. Both steps are above 0,
    /// and equal unless a limit is near. Best are steps that move flanks by a 300 000th of the normal module.
    pub fn new([down, up]: [(GearPair, StaticOptions); 2], steps: [f64; 2]) -> Self {
        let side = |(pair, options)| Neighbour { pair, options };
        Self { sides: [side(down), side(up)], steps }
    }

    /// Derivatives of the transmission error without load, mm per unit, either way; `touch`: where the pair itself touches.
    pub(super) fn kinematic_rates(&self, e: &Equilibrium, touch: Option<&Touch<'_>>) -> Option<[f64; 2]> {
        touch.and_then(|touch| self.rates_at_touch(touch)).or_else(|| self.rates_of_neighbours(e))
    }

    /// Derivatives from the gap at the place of touch, which is one of least gap: its motion changes nothing to first
    /// order.
    fn rates_at_touch(&self, touch: &Touch<'_>) -> Option<[f64; 2]> {
        let Unloaded { station, rotation, .. } = touch.here;
        let gap = |i: usize| {
            let Neighbour { pair, options } = &self.sides[i];
            Unloaded::turned(pair, &options.contact, station, rotation).gap_at(&touch.at)
        };
        let [below, above] = rates([gap(0)?, touch.gap, gap(1)?], self.steps, touch.smallest);
        Some([touch.error_by_gap * below, touch.error_by_gap * above])
    }

    /// Derivatives from where the neighbours touch: nominal flanks do so along lines, of which a neighbour's nearest
    /// place decides, and the end of what two flanks face of each other moves.
    fn rates_of_neighbours(&self, e: &Equilibrium) -> Option<[f64; 2]> {
        let error = |i: usize| {
            let Neighbour { pair, options } = &self.sides[i];
            Some(Unloaded::new(pair, &options.contact, e.station).ok()?.transmission_error())
        };
        let smallest = smallest(&self.sides[0].pair);
        Some(rates([error(0)?, e.kinematic_transmission_error, error(1)?], self.steps, smallest))
    }
}

/// Where the unloaded pair touches: one place of least gap.
pub(super) struct Touch<'a> {
    here: Unloaded<'a>,
    at: Nearest,
    /// Gap there, mm: 0 but for round-off.
    gap: f64,
    /// Derivative of the transmission error by the gap.
    error_by_gap: f64,
    smallest: f64,
}

impl<'a> Touch<'a> {
    /// `None` if the flanks touch along lines, or at the end of the range in which they face each other.
    pub fn new(windowed: &WindowedPair<'a>, e: &Equilibrium) -> Option<Self> {
        let here = Unloaded::turned(windowed.pair, &windowed.options.contact, e.station, e.unloaded_rotation);
        let at = here.polished(e.unloaded_touch.as_ref()?)?;
        let (gap, error_by_gap) = (here.gap_at(&at)?, here.error_by_gap(&at)?);
        Some(Self { here, at, gap, error_by_gap, smallest: smallest(windowed.pair) })
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
pub(super) fn rates([less, here, more]: [f64; 3], steps: [f64; 2], smallest: f64) -> [f64; 2] {
    merged([(here - less) / steps[0], (more - here) / steps[1]], steps, smallest)
}

/// Rates below and above, found with steps down and up: twice their middle where they differ by less than those of a kink.
pub(super) fn merged([below, above]: [f64; 2], [down, up]: [f64; 2], smallest: f64) -> [f64; 2] {
    let largest = below.abs().max(above.abs());
    let none = smallest / down.min(up);
    if (above - below).abs() > KINK * largest && (above - below).abs() > none {
        return [below, above];
    }
    // The parabola's slope in the middle.
    [(up * below + down * above) / (down + up); 2]
}
