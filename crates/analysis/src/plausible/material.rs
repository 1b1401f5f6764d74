//! Materials of gears and shafts.

/// Softer than this is rubber, or a number of GPa, MPa.
pub(super) const SOFT: f64 = 1000.0;
/// Heavier than this is no plastic, kg/m^3.
pub(super) const HEAVY: f64 = 2500.0;
/// Densities of solids that gears are made of, kg/m^3: from wood to tungsten.
pub(super) const DENSITIES: [f64; 2] = [300.0, 20_000.0];
