//! Names of the physical groups of a gear mesh: the default ones or the user's.

use geometry::Side;
use serde::{Deserialize, Serialize};

use crate::MeshError;

/// Names of the physical groups that are the parts of the gear.
///
/// `{k}` in the names of flanks stands for the tooth number: any integer, taken modulo the number of teeth.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct GroupNames {
    /// The bore, which moves with the shaft.
    pub bore: String,
    /// Left flanks, the counter-clockwise side of each tooth seen from +z.
    pub flank_left: String,
    /// Right flanks, the clockwise side.
    pub flank_right: String,
    /// Periodic face of a sector at its clockwise end.
    pub cut_0: String,
    /// Periodic face of a sector at its counter-clockwise end.
    pub cut_1: String,
}

impl Default for GroupNames {
    fn default() -> Self {
        Self {
            bore: "bore".into(),
            flank_left: "flank_left_{k}".into(),
            flank_right: "flank_right_{k}".into(),
            cut_0: "cut_0".into(),
            cut_1: "cut_1".into(),
        }
    }
}

impl GroupNames {
    /// The name pattern of the flanks on one side.
    pub fn flank(&self, side: Side) -> &str {
        match side {
            Side::Left => &self.flank_left,
            Side::Right => &self.flank_right,
        }
    }

    /// The group name of one flank.
    pub fn flank_of(&self, side: Side, tooth: i64) -> String {
        self.flank(side).replace("{k}", &tooth.to_string())
    }

    /// Which flank a group is, if one: side and the tooth number as written.
    pub(crate) fn parse(&self, name: &str) -> Option<(Side, i64)> {
        [Side::Left, Side::Right].into_iter().find_map(|side| {
            let (before, after) = self.flank(side).split_once("{k}")?;
            let number = name.strip_prefix(before)?.strip_suffix(after)?;
            Some((side, number.parse().ok()?))
        })
    }

    /// Both patterns must have a place for the tooth number.
    pub(crate) fn check(&self) -> Result<(), MeshError> {
        match [&self.flank_left, &self.flank_right].into_iter().find(|p| !p.contains("{k}")) {
            Some(pattern) => Err(MeshError::NoToothNumber { pattern: pattern.clone() }),
            None => Ok(()),
        }
    }
}
