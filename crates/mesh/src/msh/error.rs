//! Errors in a `.msh` file, with their position.

use std::fmt;
use std::path::PathBuf;

use super::OtherFormat;

/// A position in a mesh file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FilePosition {
    /// Line of a text file, counted from 1.
    Line(usize),
    /// Offset in a binary file, bytes from its start.
    Byte(usize),
}

impl fmt::Display for FilePosition {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Line(line) => write!(f, "line {line}"),
            Self::Byte(byte) => write!(f, "byte {byte}"),
        }
    }
}

/// A `.msh` file that cannot be read: path, section, position and cause.
#[derive(Debug, thiserror::Error)]
#[error("{}: {section}, {place}: {problem}", path.display())]
pub struct MshError {
    /// Path of the file, as given by the caller.
    pub path: PathBuf,
    /// The section being read, such as `$Nodes`.
    pub section: String,
    /// Line (text) or byte (binary) at which reading stopped.
    pub place: FilePosition,
    /// What is wrong at this position.
    pub problem: MshProblem,
}

impl MshError {
    /// What the user can do next.
    pub fn hint(&self) -> Option<String> {
        match &self.problem {
            MshProblem::Other { kind } => Some(kind.way_to_a_mesh(&self.path)),
            MshProblem::Syntax { .. } if self.section == "start of file" => {
                Some("give a mesh that Gmsh has written: `.msh`, format 2.2 or 4.1".into())
            }
            other => other.hint(),
        }
    }
}

/// What is wrong with a `.msh` file.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MshProblem {
    /// The file has another format.
    #[error("is {}, and no Gmsh mesh", kind.name())]
    Other {
        /// The format.
        kind: OtherFormat,
    },
    /// The format requires `expected`, but something else was found.
    #[error("expected {expected}, found {found}")]
    Syntax {
        /// What the format requires.
        expected: String,
        /// What was found.
        found: String,
    },
    /// A count that is too large for the rest of the file.
    #[error("{declared} {what} declared, but the rest of the file has room for {room} at most")]
    TooMany {
        /// What is counted.
        what: &'static str,
        /// Count given in the file.
        declared: u64,
        /// Largest count that fits.
        room: u64,
    },
    /// A total that differs from the sum over its blocks.
    #[error("{declared} {what} declared, {found} found")]
    WrongTotal {
        /// What is counted.
        what: &'static str,
        /// Count given in the file.
        declared: u64,
        /// Number of items found.
        found: u64,
    },
    /// A version of the format other than 2.x and 4.1.
    #[error("format version {found} is not supported, only 2.2 and 4.1 are")]
    Version {
        /// Version named in the file.
        found: String,
    },
    /// Binary data with the other byte order.
    #[error("the file was written on a big-endian machine")]
    BigEndian,
    /// An element type that this program does not support.
    #[error("element type {code} ({name}) is not supported")]
    ElementType {
        /// Gmsh's number of the type.
        code: i64,
        /// Name of the type, as far as known.
        name: &'static str,
    },
    /// A coordinate that is NaN or infinite.
    #[error("coordinate of node {node} is {value}")]
    NotFinite {
        /// Tag of the node.
        node: u64,
        /// The value found.
        value: f64,
    },
    /// Two nodes with the same tag.
    #[error("node {tag} is defined twice")]
    RepeatedNode {
        /// The tag.
        tag: u64,
    },
    /// A node that `$Nodes` does not define.
    #[error("element {element} uses node {node}, which $Nodes does not define")]
    UnknownNode {
        /// Tag of the element.
        element: u64,
        /// Tag of the node.
        node: u64,
    },
    /// An entity that `$Entities` does not define.
    #[error("elements lie on entity {tag} of dimension {dimension}, which $Entities does not define")]
    UnknownEntity {
        /// Dimension of the entity, 0..3.
        dimension: i64,
        /// Tag of the entity.
        tag: i64,
    },
    /// A required section that is missing.
    #[error("the file has no {name} section")]
    NoSection {
        /// Name of the section.
        name: &'static str,
    },
    /// A section that occurs twice.
    #[error("a second {name} section")]
    RepeatedSection {
        /// Name of the section.
        name: String,
    },
    /// A file without volume elements.
    #[error("the file has no volume elements, only {elements} of lower dimension")]
    NoVolumes {
        /// Number of face elements found.
        elements: usize,
    },
    /// A surface group that lies partly on a body that is not in the mesh.
    #[error("face {face} of group `{group}` uses node {node}, which no volume element of the model uses")]
    FaceOffBody {
        /// Name of the group.
        group: String,
        /// Tag of the face.
        face: u64,
        /// Tag of the node.
        node: u64,
    },
}

impl MshProblem {
    /// What the user can do next.
    pub fn hint(&self) -> Option<String> {
        let hint = match self {
            // Told with the file's name by the error.
            Self::Other { .. } => "mesh or convert it with Gmsh, and give the `.msh` file",
            Self::Syntax { .. } => "the file is damaged or cut short; write it again from the mesher",
            Self::TooMany { .. } | Self::WrongTotal { .. } => {
                "the file is cut short or its header is damaged; write it again from the mesher"
            }
            Self::Version { .. } => "in Gmsh set Mesh.MshFileVersion to 4.1 or 2.2 and save again",
            Self::BigEndian => "save the mesh as ASCII on the machine that made it",
            Self::ElementType { code: 7 | 14 | 19, .. } => {
                "pyramids appear where hexahedra meet tetrahedra: mesh with one of them alone"
            }
            Self::ElementType { code: 13, .. } => "in Gmsh set Mesh.SecondOrderIncomplete = 1 to get 15-node wedges",
            Self::ElementType { .. } => "use hexahedra, tetrahedra or wedges of order 1 or 2",
            Self::NotFinite { .. } => "the mesher failed there; look at the node in Gmsh",
            Self::RepeatedNode { .. } => "two meshes were joined without renumbering; let Gmsh merge them",
            Self::UnknownNode { .. } => "the file is incomplete; write it again from the mesher",
            Self::UnknownEntity { .. } => "$Entities and $Elements come from different models",
            Self::NoSection { .. } => "is this a Gmsh mesh file, and is it complete?",
            Self::RepeatedSection { .. } => "two files were joined; let Gmsh merge them",
            Self::NoVolumes { .. } => "generate the mesh in three dimensions and put the body into a physical volume",
            Self::FaceOffBody { .. } => {
                "put the body that bears this face into a physical volume, or take the face out of the group"
            }
        };
        Some(hint.to_owned())
    }
}
