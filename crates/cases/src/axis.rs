//! What is varied.

use serde::{Deserialize, Serialize};

use crate::Distribution;

/// The values of one or several keys.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Axis {
    /// Each of these, in this order.
    Each(Vec<f64>),
    /// Drawn, once a sample.
    Drawn(Distribution),
}

impl Axis {
    /// So many values from one to another, evenly spaced, or their logarithms; both ends are among them.
    ///
    /// ```
    /// use cases::Axis;
    /// assert_eq!(Axis::grid([0.0, 10.0], 3, false), Axis::Each(vec![0.0, 5.0, 10.0]));
    /// assert_eq!(Axis::grid([1.0, 100.0], 3, true), Axis::Each(vec![1.0, 10.0, 100.0]));
    /// ```
    pub fn grid([from, to]: [f64; 2], count: u32, logarithmic: bool) -> Self {
        let last = count.saturating_sub(1).max(1);
        let at = |i: u32| match i {
            0 => from,
            // The ends as they are written.
            _ if i == last => to,
            _ if logarithmic => from * (to / from).powf(f64::from(i) / f64::from(last)),
            _ => from + (to - from) * f64::from(i) / f64::from(last),
        };
        Self::Each((0..count).map(at).collect())
    }
}
