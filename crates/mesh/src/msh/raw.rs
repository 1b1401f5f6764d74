//! Content of a `.msh` file before it becomes a model; the same for every version and encoding.

use std::collections::BTreeMap;

use super::cursor::Cursor;
use super::error::{MshError, MshProblem};
use crate::{ElementKind, FaceKind};

/// Content of a file in its own order.
#[derive(Debug, Default)]
pub(super) struct Raw {
    /// Names of physical groups by (dimension, tag).
    pub names: BTreeMap<(i64, i64), String>,
    /// Physical tags of each entity by (dimension, tag); `None` without such a section.
    pub entities: Option<BTreeMap<(i64, i64), Vec<i64>>>,
    /// The nodes; `None` before their section.
    pub nodes: Option<RawNodes>,
    /// Runs of elements of one type.
    pub blocks: Vec<RawBlock>,
    /// Whether the elements' section was seen.
    pub has_elements: bool,
}

/// Nodes in file order.
#[derive(Debug, Default)]
pub(super) struct RawNodes {
    pub tags: Vec<u64>,
    pub positions: Vec<[f64; 3]>,
    /// Where in the file each node is defined.
    pub places: Vec<usize>,
}

/// Elements of one type and of one entity or group.
#[derive(Debug)]
pub(super) struct RawBlock {
    pub shape: Shape,
    pub owner: Owner,
    pub tags: Vec<u64>,
    /// Node tags, `shape.node_count()` an element.
    pub nodes: Vec<u64>,
    /// Where in the file each element is defined.
    pub places: Vec<usize>,
}

/// Where the physical groups of a block are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Owner {
    /// At the entity of that dimension and tag (format 4.1).
    Entity(i64, i64),
    /// Here (format 2.2); 0: in no group.
    Group(i64),
}

/// What becomes of elements of one type.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Shape {
    Volume(ElementKind),
    Face(FaceKind),
    /// Points and lines, of so many nodes: read and forgotten.
    Lower(usize),
}

impl Shape {
    /// The element shape of Gmsh's element type `code`.
    pub fn of_type(code: i64, cursor: &Cursor) -> Result<Self, MshError> {
        let small = i32::try_from(code).unwrap_or(-1);
        if let Some(kind) = ElementKind::from_gmsh_type(small) {
            return Ok(Self::Volume(kind));
        }
        if let Some(kind) = FaceKind::from_gmsh_type(small) {
            return Ok(Self::Face(kind));
        }
        let lower = match code {
            15 => 1,
            1 => 2,
            8 => 3,
            26 => 4,
            27 => 5,
            28 => 6,
            _ => {
                let name = type_name(code);
                return Err(cursor.error(MshProblem::ElementType { code, name }));
            }
        };
        Ok(Self::Lower(lower))
    }

    pub fn node_count(self) -> usize {
        match self {
            Self::Volume(kind) => kind.node_count(),
            Self::Face(kind) => kind.node_count(),
            Self::Lower(count) => count,
        }
    }
}

fn type_name(code: i64) -> &'static str {
    match code {
        7 => "5-node pyramid",
        13 => "18-node wedge",
        14 => "14-node pyramid",
        19 => "13-node pyramid",
        20..=25 => "triangle of order 3 or more",
        29..=31 => "tetrahedron of order 3 or more",
        36..=38 => "quadrangle of order 3 or more",
        92..=93 => "hexahedron of order 3 or more",
        _ => "unknown",
    }
}

impl RawNodes {
    pub fn with_capacity(count: usize) -> Self {
        Self {
            tags: Vec::with_capacity(count),
            positions: Vec::with_capacity(count),
            places: Vec::with_capacity(count),
        }
    }

    pub fn push(&mut self, tag: u64, position: [f64; 3], place: usize, cursor: &Cursor) -> Result<(), MshError> {
        if let Some(&value) = position.iter().find(|x| !x.is_finite()) {
            return Err(cursor.error_at(place, MshProblem::NotFinite { node: tag, value }));
        }
        self.tags.push(tag);
        self.positions.push(position);
        self.places.push(place);
        Ok(())
    }
}

impl RawBlock {
    pub fn with_capacity(shape: Shape, owner: Owner, count: usize) -> Self {
        Self {
            shape,
            owner,
            tags: Vec::with_capacity(count),
            nodes: Vec::with_capacity(count * shape.node_count()),
            places: Vec::with_capacity(count),
        }
    }
}
