//! `ale-gear mesh`: look at, check or make meshes.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use clap::Subcommand;
use mesh::Mesh;

use crate::error::CommandError;

/// Subcommands of `ale-gear mesh`.
#[derive(Debug, Subcommand)]
pub(super) enum MeshCommand {
    /// What a mesh file holds: elements, nodes, extent, groups
    Info {
        /// Gmsh file, format 2.2 or 4.1, text or binary
        file: PathBuf,
    },
}

impl MeshCommand {
    /// Does what was asked; the text is for stdout.
    pub(super) fn execute(self) -> Result<String, CommandError> {
        match self {
            Self::Info { file } => Ok(info(&file, &read(&file)?)),
        }
    }
}

fn read(file: &Path) -> Result<Mesh, CommandError> {
    Mesh::read(file).map_err(|e| CommandError::input(&e, e.hint()))
}

/// A short table of what is in a mesh.
fn info(file: &Path, mesh: &Mesh) -> String {
    let mut t = format!("{}\n", file.display());
    let mut line = |label: &str, value: String| {
        // Writing to a String cannot fail.
        let _ = writeln!(t, "  {label:<12} {value}");
    };
    line("nodes", mesh.nodes.len().to_string());
    line("DOF", (3 * mesh.nodes.len()).to_string());
    line("elements", crate::meshes::kinds(&mesh.blocks).join(", "));
    for (axis, name) in ["x", "y", "z"].into_iter().enumerate() {
        let (low, high) = mesh
            .nodes
            .iter()
            .map(|p| p[axis])
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), v| (lo.min(v), hi.max(v)));
        line(name, format!("{low:.6} .. {high:.6} mm"));
    }
    line("volumes", mesh.volumes.join(", "));
    line("surfaces", format!("{} groups", mesh.surfaces.len()));
    for group in &mesh.surfaces {
        let _ = writeln!(t, "    {:<24} {:>8} faces", group.name, group.faces.len());
    }
    t
}
