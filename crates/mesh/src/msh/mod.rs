//! Reads and writes Gmsh's mesh files (`.msh`), formats 2.2 and 4.1, text and binary.

mod build;
mod cursor;
mod error;
mod other;
mod parse;
mod raw;
mod unique;
mod v2;
mod v4;
mod write;

pub use error::{FilePosition, MshError, MshProblem};
pub use other::OtherFormat;
pub use write::MshFormat;

use std::path::Path;

use files::{most, read_regular_file};

use crate::{Mesh, MeshError};

impl Mesh {
    /// Reads a Gmsh mesh file of format 2.2 or 4.1, text or binary.
    ///
    /// The mesh gets the volume elements that lie in a physical volume (all of them if there is no physical volume),
    /// each once, the nodes that they use, and the physical surfaces by name. A group without a name is named by its
    /// tag in digits. Nodes and elements are sorted by their tags.
    ///
    /// # Errors
    /// [`MeshError::Read`] if the file cannot be opened or is not a regular file; [`MeshError::Msh`] with section and
    /// line or byte if it cannot be parsed.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, MeshError> {
        let path = path.as_ref();
        let bytes =
            read_regular_file(path, most::MESH).map_err(|source| MeshError::Read { path: path.to_owned(), source })?;
        Self::parse(&bytes, path)
    }

    /// Parses the content of a mesh file, see [`Mesh::read`]; `path` is only used in messages.
    ///
    /// # Errors
    /// [`MeshError::Msh`] with section and line or byte.
    pub fn parse(bytes: &[u8], path: impl AsRef<Path>) -> Result<Self, MeshError> {
        if let Some(kind) = OtherFormat::of(bytes) {
            let problem = MshProblem::Other { kind };
            let (section, place) = ("start of file".to_owned(), FilePosition::Line(1));
            return Err(MshError { path: path.as_ref().to_owned(), section, place, problem }.into());
        }
        let (raw, mut cursor) = parse::parse(bytes, path.as_ref())?;
        Ok(build::build(&raw, &mut cursor)?)
    }
}
