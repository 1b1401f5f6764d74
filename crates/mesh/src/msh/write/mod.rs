//! Writes a mesh in any version and encoding of Gmsh's format.

mod out;
mod v2;
mod v4;

use std::path::Path;

use crate::{Mesh, MeshError};
use out::Out;

/// Versions and encodings of `.msh`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum MshFormat {
    /// Version 4.1, text.
    Ascii41,
    /// Version 4.1, binary: small, fast and exact.
    #[default]
    Binary41,
    /// Version 2.2, text: the one that most other programs read.
    Ascii22,
    /// Version 2.2, binary.
    Binary22,
}

impl MshFormat {
    /// All versions and encodings.
    pub const ALL: [Self; 4] = [Self::Ascii41, Self::Binary41, Self::Ascii22, Self::Binary22];

    fn is_binary(self) -> bool {
        matches!(self, Self::Binary41 | Self::Binary22)
    }
}

impl Mesh {
    /// Writes the mesh into a file that Gmsh and other programs can open. If this fails, an existing file stays
    /// unchanged.
    ///
    /// Coordinates are exact in every encoding. All volume elements go into every physical volume of [`Mesh::volumes`];
    /// format 2.2 therefore has them once per volume, as Gmsh writes them.
    ///
    /// # Errors
    /// [`MeshError::Write`] if the file cannot be written, [`MeshError::Inconsistent`] if the lists of the mesh
    /// contradict each other, [`MeshError::TagTooLarge`] if a tag does not fit into format 2.2.
    pub fn write(&self, path: impl AsRef<Path>, format: MshFormat) -> Result<(), MeshError> {
        let path = path.as_ref();
        let bytes = self.to_msh(format)?;
        files::write_file(path, &bytes).map_err(|source| MeshError::Write { path: path.to_owned(), source })
    }

    /// The content of a mesh file, see [`Mesh::write`].
    ///
    /// # Errors
    /// Those of [`Mesh::write`], except for file errors.
    pub fn to_msh(&self, format: MshFormat) -> Result<Vec<u8>, MeshError> {
        self.check_lists()?;
        let mut out = Out { bytes: Vec::new(), binary: format.is_binary() };
        match format {
            MshFormat::Ascii41 | MshFormat::Binary41 => self.write_41(&mut out),
            MshFormat::Ascii22 | MshFormat::Binary22 => self.write_22(&mut out)?,
        }
        Ok(out.bytes)
    }

    /// Whether lists have the lengths and numbers that belong to each other.
    fn check_lists(&self) -> Result<(), MeshError> {
        let wrong = |what: String| Err(MeshError::Inconsistent { what });
        if self.nodes.len() != self.node_tags.len() {
            return wrong(format!("{} nodes, {} node tags", self.nodes.len(), self.node_tags.len()));
        }
        for block in &self.blocks {
            if block.connectivity.len() != block.tags.len() * block.kind.node_count() {
                return wrong(format!(
                    "{} nodes in {} elements of kind {:?}",
                    block.connectivity.len(),
                    block.tags.len(),
                    block.kind
                ));
            }
        }
        let of_elements = self.blocks.iter().flat_map(|b| &b.connectivity);
        let of_faces = self.surfaces.iter().flat_map(|s| &s.faces).flat_map(|f| f.nodes());
        match of_elements.chain(of_faces).find(|&&n| n as usize >= self.nodes.len()) {
            Some(n) => wrong(format!("node number {n} where there are {} nodes", self.nodes.len())),
            None => Ok(()),
        }
    }

    /// First tag for faces, past those of the elements.
    fn first_face_tag(&self) -> u64 {
        self.blocks.iter().flat_map(|b| &b.tags).max().map_or(1, |m| m.saturating_add(1))
    }

    fn tag(&self, node: u32) -> u64 {
        self.node_tags[node as usize]
    }

    fn write_names(&self, out: &mut Out) {
        let count = self.surfaces.len() + self.volumes.len();
        if count == 0 {
            return;
        }
        out.line(&format!("$PhysicalNames\n{count}"));
        for (i, surface) in self.surfaces.iter().enumerate() {
            out.line(&format!("2 {} \"{}\"", i + 1, surface.name));
        }
        for (i, volume) in self.volumes.iter().enumerate() {
            out.line(&format!("3 {} \"{volume}\"", i + 1));
        }
        out.line("$EndPhysicalNames");
    }
}

/// Smallest and largest tag; 0 and 0 of none.
fn extremes<'a>(tags: impl IntoIterator<Item = &'a u64>) -> (u64, u64) {
    tags.into_iter()
        .fold(None, |range, &t| match range {
            None => Some((t, t)),
            Some((low, high)) => Some((t.min(low), t.max(high))),
        })
        .unwrap_or((0, 0))
}
