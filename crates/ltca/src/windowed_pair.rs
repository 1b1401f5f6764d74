//! A pair of gears in a window: the input of a station's solution and of its results.

use ale::ToothWindow;
use geometry::GearPair;

use crate::StaticOptions;
use contact::ContactSet;
use reduction::ElasticGear;

/// A pair of elastic gears with its current window.
#[derive(Debug, Clone, Copy)]
pub struct WindowedPair<'a> {
    /// The gear pair.
    pub pair: &'a GearPair,
    /// Elastic gears of the pair.
    pub gears: &'a [ElasticGear; 2],
    /// Flanks and matrices of the window.
    pub set: &'a ContactSet,
    /// The window.
    pub window: &'a ToothWindow,
    /// Options of the analysis.
    pub options: &'a StaticOptions,
}
