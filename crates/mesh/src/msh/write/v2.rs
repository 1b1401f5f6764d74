//! Writer of format 2.2.

use super::{Out, extremes};
use crate::{Mesh, MeshError};

impl Mesh {
    pub(super) fn write_22(&self, out: &mut Out) -> Result<(), MeshError> {
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
