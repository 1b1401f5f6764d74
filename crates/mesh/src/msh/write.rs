//! Writes a mesh in any flavour of Gmsh's format.

use std::io::Write as _;
use std::path::Path;

use crate::{FaceKind, Mesh, MeshError};

/// Flavours of `.msh`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum MshFormat {
    /// Version 4.1, text.
    Ascii41,
    /// Version 4.1, binary: small, fast and exact.
    #[default]
    Binary41,
    /// Version 2.2, text: what the most other programs read.
    Ascii22,
    /// Version 2.2, binary.
    Binary22,
}

impl MshFormat {
    /// All flavours.
    pub const ALL: [Self; 4] = [Self::Ascii41, Self::Binary41, Self::Ascii22, Self::Binary22];

    fn is_binary(self) -> bool {
        matches!(self, Self::Binary41 | Self::Binary22)
    }
}

impl Mesh {
    /// Writes the mesh into a file that Gmsh and other programs open.
    ///
    /// Coordinates are exact in every flavour. All volume elements go into every physical volume
    /// of [`Mesh::volumes`]; in format 2.2 that writes them once a volume, as Gmsh does.
    ///
    /// # Errors
    /// [`MeshError::Write`] when the file cannot be written, [`MeshError::Inconsistent`] when the
    /// lists of the mesh do not fit together, [`MeshError::TagTooLarge`] when a tag does not fit into format 2.2.
    pub fn write(&self, path: impl AsRef<Path>, format: MshFormat) -> Result<(), MeshError> {
        let path = path.as_ref();
        let bytes = self.to_msh(format)?;
        std::fs::write(path, bytes).map_err(|source| MeshError::Write { path: path.to_owned(), source })
    }

    /// The content of a mesh file, see [`Mesh::write`].
    ///
    /// # Errors
    /// As [`Mesh::write`], but for the file.
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

    fn write_41(&self, out: &mut Out) {
        out.header("4.1");
        self.write_names(out);
        self.write_entities(out);

        // One block: every node lies on the volume.
        out.line("$Nodes");
        let (least, largest) = extremes(&self.node_tags);
        out.sizes(&[1, self.nodes.len() as u64, least, largest]);
        out.new_line();
        out.ints(&[3, 1, 0]);
        out.sizes(&[self.nodes.len() as u64]);
        out.new_line();
        for &tag in &self.node_tags {
            out.sizes(&[tag]);
            out.new_line();
        }
        for position in &self.nodes {
            out.reals(position);
        }
        out.end("$EndNodes");

        let face_blocks: Vec<(usize, FaceKind)> = self
            .surfaces
            .iter()
            .enumerate()
            .flat_map(|(s, surface)| {
                let mut kinds: Vec<FaceKind> = surface.faces.iter().map(|f| f.kind).collect();
                kinds.sort_unstable();
                kinds.dedup();
                kinds.into_iter().map(move |kind| (s, kind))
            })
            .collect();
        let faces: usize = self.surfaces.iter().map(|s| s.faces.len()).sum();
        let first = self.first_face_tag();
        let (least, largest) = extremes(self.blocks.iter().flat_map(|b| &b.tags));
        let largest = if faces == 0 { largest } else { first.saturating_add(faces as u64 - 1) };
        out.line("$Elements");
        let blocks = face_blocks.len() + self.blocks.len();
        out.sizes(&[blocks as u64, (faces + self.element_count()) as u64, least, largest]);
        out.new_line();
        let mut tag = first;
        for (s, kind) in face_blocks {
            let of_kind = || self.surfaces[s].faces.iter().filter(|f| f.kind == kind);
            out.ints(&[2, s as i32 + 1, kind.gmsh_type()]);
            out.sizes(&[of_kind().count() as u64]);
            out.new_line();
            for face in of_kind() {
                out.sizes(&[tag]);
                face.nodes().iter().for_each(|&n| out.sizes(&[self.tag(n)]));
                out.new_line();
                tag = tag.saturating_add(1);
            }
        }
        for block in &self.blocks {
            out.ints(&[3, 1, block.kind.gmsh_type()]);
            out.sizes(&[block.len() as u64]);
            out.new_line();
            for (element, &tag) in block.elements().zip(&block.tags) {
                out.sizes(&[tag]);
                element.iter().for_each(|&n| out.sizes(&[self.tag(n)]));
                out.new_line();
            }
        }
        out.end("$EndElements");
    }

    /// One volume, and one surface a group.
    fn write_entities(&self, out: &mut Out) {
        out.line("$Entities");
        out.sizes(&[0, 0, self.surfaces.len() as u64, 1]);
        out.new_line();
        for (i, surface) in self.surfaces.iter().enumerate() {
            let tag = i as i32 + 1;
            out.ints(&[tag]);
            self.write_box(out, surface.faces.iter().flat_map(|f| f.nodes().iter().copied()));
            out.sizes(&[1]);
            out.ints(&[tag]);
            out.sizes(&[0]);
            out.new_line();
        }
        out.ints(&[1]);
        self.write_box(out, 0..self.nodes.len() as u32);
        out.sizes(&[self.volumes.len() as u64]);
        (0..self.volumes.len() as i32).for_each(|i| out.ints(&[i + 1]));
        out.sizes(&[0]);
        out.new_line();
        out.end("$EndEntities");
    }

    /// Bounding box of some nodes.
    fn write_box(&self, out: &mut Out, nodes: impl Iterator<Item = u32>) {
        let (mut low, mut high) = ([0.0; 3], [0.0; 3]);
        for (i, node) in nodes.enumerate() {
            let position = self.nodes[node as usize];
            for k in 0..3 {
                low[k] = if i == 0 { position[k] } else { position[k].min(low[k]) };
                high[k] = if i == 0 { position[k] } else { position[k].max(high[k]) };
            }
        }
        low.iter().chain(&high).for_each(|&x| out.real(x));
    }

    fn write_22(&self, out: &mut Out) -> Result<(), MeshError> {
        let copies = self.volumes.len().max(1) as u64;
        let faces: u64 = self.surfaces.iter().map(|s| s.faces.len() as u64).sum();
        let elements = self.element_count() as u64;
        let first = self.first_face_tag();
        let last = first.saturating_add(faces).saturating_add((copies - 1).saturating_mul(elements));
        for largest in [last, extremes(&self.node_tags).1] {
            if i32::try_from(largest).is_err() {
                return Err(MeshError::TagTooLarge { tag: largest });
            }
        }
        out.header("2.2");
        self.write_names(out);
        out.line(&format!("$Nodes\n{}", self.nodes.len()));
        for (position, &tag) in self.nodes.iter().zip(&self.node_tags) {
            out.ints(&[tag as i32]);
            out.reals(position);
        }
        out.end("$EndNodes");
        out.line(&format!("$Elements\n{}", faces + copies * elements));
        let mut tag = first as i32;
        for (i, surface) in self.surfaces.iter().enumerate() {
            let group = i as i32 + 1;
            for run in surface.faces.chunk_by(|a, b| a.kind == b.kind) {
                out.run_22(run[0].kind.gmsh_type(), run.len());
                for face in run {
                    self.element_22(out, tag, face.kind.gmsh_type(), group, face.nodes());
                    tag += 1;
                }
            }
        }
        for copy in 0..copies as i32 {
            // Without a volume the group is 0: none.
            let group = if self.volumes.is_empty() { 0 } else { copy + 1 };
            for block in &self.blocks {
                out.run_22(block.kind.gmsh_type(), block.len());
                for (element, &own) in block.elements().zip(&block.tags) {
                    let number = if copy == 0 { own as i32 } else { tag };
                    tag += i32::from(copy != 0);
                    self.element_22(out, number, block.kind.gmsh_type(), group, element);
                }
            }
        }
        out.end("$EndElements");
        Ok(())
    }

    /// One element of format 2.2 with two tags, group and entity.
    fn element_22(&self, out: &mut Out, tag: i32, code: i32, group: i32, nodes: &[u32]) {
        let entity = group.max(1);
        if out.binary {
            out.ints(&[tag, group, entity]);
        } else {
            out.ints(&[tag, code, 2, group, entity]);
        }
        nodes.iter().for_each(|&n| out.ints(&[self.tag(n) as i32]));
        out.new_line();
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

/// Numbers as text or as bytes.
struct Out {
    bytes: Vec<u8>,
    binary: bool,
}

impl Out {
    fn line(&mut self, text: &str) {
        self.bytes.extend_from_slice(text.as_bytes());
        self.bytes.push(b'\n');
    }

    fn header(&mut self, version: &str) {
        self.line(&format!("$MeshFormat\n{version} {} 8", i32::from(self.binary)));
        if self.binary {
            self.ints(&[1]);
            self.bytes.push(b'\n');
        }
        self.line("$EndMeshFormat");
    }

    /// End mark; binary data has no line end of its own.
    fn end(&mut self, mark: &str) {
        if self.binary {
            self.bytes.push(b'\n');
        }
        self.line(mark);
    }

    /// End of a line of text.
    fn new_line(&mut self) {
        if !self.binary {
            // Numbers end with a blank.
            self.bytes.pop();
            self.bytes.push(b'\n');
        }
    }

    fn text(&mut self, value: impl std::fmt::Display) {
        // Writing into a vector cannot fail.
        let _ = write!(self.bytes, "{value} ");
    }

    fn ints(&mut self, values: &[i32]) {
        for &value in values {
            if self.binary { self.bytes.extend_from_slice(&value.to_le_bytes()) } else { self.text(value) }
        }
    }

    fn sizes(&mut self, values: &[u64]) {
        for &value in values {
            if self.binary { self.bytes.extend_from_slice(&value.to_le_bytes()) } else { self.text(value) }
        }
    }

    /// The shortest digits that give the same number back.
    fn real(&mut self, value: f64) {
        if self.binary {
            self.bytes.extend_from_slice(&value.to_le_bytes());
        } else {
            let _ = write!(self.bytes, "{value:?} ");
        }
    }

    /// A line of numbers.
    fn reals(&mut self, values: &[f64]) {
        values.iter().for_each(|&v| self.real(v));
        self.new_line();
    }

    /// Header of a run of elements of one type, in binary.
    fn run_22(&mut self, code: i32, count: usize) {
        if self.binary && count > 0 {
            self.ints(&[code, count as i32, 2]);
        }
    }
}
