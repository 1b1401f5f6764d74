//! Words about a mesh file: names of its groups, and what is said of one that cannot be read.

use mesh::{GroupNames, MeshError};

use crate::error::CommandError;

/// The mesh's own names of the parts of the gear, as `[pinion.groups]` of a scene has them.
#[derive(Debug, clap::Args)]
#[command(next_help_heading = "Names of the mesh's own groups")]
pub(super) struct GroupArgs {
    /// The bore [default: bore]
    #[arg(long, value_name = "NAME")]
    bore: Option<String>,
    /// Counter-clockwise side of the teeth, {k} for the tooth number [default: flank_left_{k}]
    #[arg(long, value_name = "NAME_{k}")]
    flank_left: Option<String>,
    /// Clockwise side [default: flank_right_{k}]
    #[arg(long, value_name = "NAME_{k}")]
    flank_right: Option<String>,
    /// Clockwise cut face of a sector [default: cut_0]
    #[arg(long, value_name = "NAME")]
    cut_0: Option<String>,
    /// Counter-clockwise cut face [default: cut_1]
    #[arg(long, value_name = "NAME")]
    cut_1: Option<String>,
}

impl GroupArgs {
    /// Whether a name is given.
    pub(super) fn any(&self) -> bool {
        [&self.bore, &self.flank_left, &self.flank_right, &self.cut_0, &self.cut_1].iter().any(|n| n.is_some())
    }

    /// The names that the mesh has for the parts.
    pub(super) fn names(self) -> Result<GroupNames, CommandError> {
        let ours = GroupNames::default();
        for (flag, name) in [("--flank-left", &self.flank_left), ("--flank-right", &self.flank_right)] {
            if let Some(name) = name.as_ref().filter(|n| !n.contains("{k}")) {
                return Err(CommandError::input(
                    format_args!("`{flag}` is {name}, which has no place for the tooth number"),
                    Some(format!("write {{k}} where the number stands, as in {flag} 'Left_{{k}}'")),
                ));
            }
        }
        Ok(GroupNames {
            bore: self.bore.unwrap_or(ours.bore),
            flank_left: self.flank_left.unwrap_or(ours.flank_left),
            flank_right: self.flank_right.unwrap_or(ours.flank_right),
            cut_0: self.cut_0.unwrap_or(ours.cut_0),
            cut_1: self.cut_1.unwrap_or(ours.cut_1),
        })
    }
}

/// A complaint about a file on the command line.
pub(super) fn complaint(e: MeshError) -> CommandError {
    let hint = match e {
        MeshError::Read { .. } => Some("is the path right, as seen from here?".to_owned()),
        _ => e.hint(),
    };
    CommandError::input(&e, hint)
}
