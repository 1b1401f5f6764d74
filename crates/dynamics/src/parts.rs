//! What a station's solve and its results look at.

use ale::ToothWindow;
use geometry::GearPair;

use crate::{ContactSet, ElasticGear, StaticOptions};

/// A pair with the window it stands in.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Parts<'a> {
    pub pair: &'a GearPair,
    pub gears: &'a [ElasticGear; 2],
    pub set: &'a ContactSet,
    pub window: &'a ToothWindow,
    pub options: &'a StaticOptions,
}
