//! Writer of format 4.1.

use super::{Out, extremes};
use crate::{FaceKind, Mesh};

impl Mesh {
    pub(super) fn write_41(&self, out: &mut Out) {
        out.header("4.1");
        self.write_names(out);
        self.write_entities(out);
        self.write_nodes(out);
        self.write_elements(out);
    }

    /// One block: every node lies on the volume.
    fn write_nodes(&self, out: &mut Out) {
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
    }

    /// A block a group and kind of face, then the elements.
    fn write_elements(&self, out: &mut Out) {
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
}
