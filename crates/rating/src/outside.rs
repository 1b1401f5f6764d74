//! Where a rating is outside of what its standard covers.

use serde::Serialize;

described::described! {
    /// A value outside of the range that a standard states for a formula; the formula was used all the same.
    #[derive(Debug, Clone, PartialEq, Serialize)]
    pub struct Outside {
        /// number that the standard does not cover, with its unit
        pub quantity: &'static str,
        /// value of that number
        pub value: f64,
        /// range of the standard in words
        pub range: &'static str,
        /// standard and clause that state the range
        pub clause: &'static str,
    }
}

/// Micropitting of a pair whose wheel has so many teeth z_2, below 0 for an internal one: ISO/TS 6336-22 is for external gears; its
/// formulas need curvatures and speeds alone.
pub fn micropitting_scope(wheel_teeth: f64) -> Option<Outside> {
    let scope = "ISO/TS 6336-22, clause 1";
    Outside::unless("z_2 in micropitting", wheel_teeth, [1.0, f64::INFINITY], "external gears, above 0", scope)
}

impl Outside {
    /// Told where `value` is not within `low..=high`.
    pub(crate) fn unless(
        quantity: &'static str,
        value: f64,
        [low, high]: [f64; 2],
        range: &'static str,
        clause: &'static str,
    ) -> Option<Self> {
        (!(low..=high).contains(&value)).then_some(Self { quantity, value, range, clause })
    }
}
