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
