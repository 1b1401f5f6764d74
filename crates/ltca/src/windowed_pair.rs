//! What a station's solve and its results look at.

use ale::ToothWindow;
use geometry::GearPair;

use crate::StaticOptions;
use contact::ContactSet;
use reduction::ElasticGear;

/// A pair with the window it stands in.
#[derive(Debug, Clone, Copy)]
pub struct WindowedPair<'a> {
    /// The pair.
    pub pair: &'a GearPair,
    /// Its elastic gears.
    pub gears: &'a [ElasticGear; 2],
    /// Flanks and matrices of the window.
    pub set: &'a ContactSet,
    /// Which teeth are kept.
    pub window: &'a ToothWindow,
    /// What is asked.
    pub options: &'a StaticOptions,
}
