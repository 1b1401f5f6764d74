//! Friction of the tooth pairs of a map. Theory (74b).

use serde::{Deserialize, Serialize};

use crate::{column::Node, pair_shares::PairShares};

/// Friction of each pair of teeth, over the force of all.
///
/// ```text
/// T_k = F sum over m of t_k(c - m, tilt, F),   k = 0: force along the sliding, 1: its moment along the path of contact,
///       2: its moment over the face, 3: moment of the normal forces along the tilt
/// ```
/// Friction bends teeth as well, by a matrix that is not symmetric: normal forces then have a moment that no potential
/// gives, and the last one tells it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct FrictionTable {
    pub(crate) columns: [PairShares; 4],
}

impl FrictionTable {
    pub(crate) fn new(columns: &[&Vec<Vec<Node>>], interpolate: impl Fn(Vec<f64>) -> Vec<f64> + Copy) -> Self {
        Self { columns: [0, 1, 2, 3].map(|k| PairShares::new(columns, |node, i| node.rubs[i][k], interpolate)) }
    }
}
