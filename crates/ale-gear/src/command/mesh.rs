//! `ale-gear mesh`: look at, check or make meshes.

use std::path::PathBuf;

use clap::Subcommand;

use crate::error::CommandError;

/// Subcommands of `ale-gear mesh`.
#[derive(Debug, Subcommand)]
pub(super) enum MeshCommand {
    /// What a mesh file holds: elements, nodes, groups, extent
    Info {
        /// Gmsh file, format 2.2 or 4.1, text or binary
        file: PathBuf,
    },
}

impl MeshCommand {
    pub(super) fn execute(self) -> Result<String, CommandError> {
        match self {
            Self::Info { file } => {
                let mesh = ::mesh::Mesh::read(&file).map_err(|e| CommandError::input(&e, e.hint()))?;
                Ok(format!("{} nodes\n", mesh.nodes.len()))
            }
        }
    }
}
