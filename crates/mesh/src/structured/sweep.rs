//! Makes the mesh from the section: numbers, positions, elements, groups.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use geometry::Gear;

use super::{
    Extent, StructuredOptions,
    quality::offsets,
    section::{Lattice, Section},
};
use crate::{ElementBlock, ElementKind, Face, Mesh, SurfaceGroup};

/// Which lattice of the section.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Block {
    Tooth,
    Rim,
}

/// Turns the section from tooth to tooth and twists it along the face.
pub(super) fn sweep(gear: &Gear, options: &StructuredOptions, section: &Section) -> Mesh {
    let numbers = Numbering::new(gear, options, section);
    let kind = options.kind();
    let mut groups: BTreeMap<String, Vec<Face>> = BTreeMap::new();
    let mut connectivity = Vec::new();
    let mut nodes = vec![0; kind.node_count()];
    for tooth in 0..numbers.teeth {
        let sides = ["left", "right"].map(|side| format!("flank_{side}_{}", numbers.first_tooth + tooth as i64));
        for block in [Block::Tooth, Block::Rim] {
            let lattice = numbers.lattice(block);
            let (columns, rows) = (lattice.columns / numbers.order, lattice.rows / numbers.order);
            let layers = options.elements_face as usize;
            for cell in cells(columns, rows, layers) {
                numbers.element(kind, tooth, block, cell, &mut nodes);
                connectivity.extend_from_slice(&nodes);
                let [column, row, layer] = cell;
                let last = [columns - 1, rows - 1, layers - 1];
                let mut boundary = |axis: usize, end: f64, name: &str| {
                    let faces = match groups.get_mut(name) {
                        Some(faces) => faces,
                        None => groups.entry(name.to_owned()).or_default(),
                    };
                    faces.extend(face_at(kind, &nodes, axis, end));
                };
                if layer == 0 {
                    boundary(2, -1.0, "side_back");
                }
                if layer == last[2] {
                    boundary(2, 1.0, "side_front");
                }
                match block {
                    Block::Tooth if row < options.elements_profile as usize => {
                        if column == 0 {
                            boundary(0, -1.0, &sides[1]);
                        }
                        if column == last[0] {
                            boundary(0, 1.0, &sides[0]);
                        }
                    }
                    Block::Tooth => {}
                    Block::Rim => {
                        if row == last[1] {
                            boundary(1, 1.0, "bore");
                        }
                        if numbers.open && tooth == 0 && column == 0 {
                            boundary(0, -1.0, "cut_0");
                        }
                        if numbers.open && tooth == numbers.teeth - 1 && column == last[0] {
                            boundary(0, 1.0, "cut_1");
                        }
                    }
                }
            }
        }
    }
    let nodes = numbers.positions(gear, options);
    let elements = connectivity.len() / kind.node_count();
    Mesh {
        node_tags: (1..=nodes.len() as u64).collect(),
        nodes,
        blocks: vec![ElementBlock { kind, connectivity, tags: (1..=elements as u64).collect() }],
        surfaces: groups.into_iter().map(|(name, faces)| SurfaceGroup { name, faces }).collect(),
        volumes: vec!["gear".to_owned()],
    }
}

/// All [column, row, layer] of a block.
fn cells(columns: usize, rows: usize, layers: usize) -> impl Iterator<Item = [usize; 3]> {
    (0..layers)
        .flat_map(move |layer| (0..rows).flat_map(move |row| (0..columns).map(move |column| [column, row, layer])))
}

/// The element's face where reference coordinate `axis` is `end`.
fn face_at(kind: ElementKind, nodes: &[u32], axis: usize, end: f64) -> Option<Face> {
    let reference = kind.reference_nodes();
    let (face, local) = kind.faces().iter().find(|(_, local)| local.iter().all(|&i| reference[i][axis] == end))?;
    Some(Face::new(*face, &local.iter().map(|&i| nodes[i]).collect::<Vec<_>>()))
}

/// Node numbers: tooth by tooth, in it layer by layer, in it row by row; the first cut of an open gear last.
///
/// Serendipity elements have no node in the middle of a face or of the element: a lattice point carries one
/// only if at most one of its three indices is odd.
struct Numbering<'a> {
    section: &'a Section,
    order: usize,
    layers: usize,
    teeth: usize,
    first_tooth: i64,
    open: bool,
    /// Number within even and odd layers of each own lattice point of a tooth; `u32::MAX` where there is no node.
    slots: [Vec<u32>; 2],
    /// Nodes in an even and in an odd layer of a tooth.
    per_layer: [usize; 2],
    /// Nodes in an even and in an odd layer along a cut.
    per_cut_layer: [usize; 2],
}

impl<'a> Numbering<'a> {
    fn new(gear: &Gear, options: &StructuredOptions, section: &'a Section) -> Self {
        let order = options.order as usize;
        let (teeth, open) = match options.extent {
            Extent::Whole => (gear.teeth() as usize, false),
            Extent::Periodic => (1, true),
            Extent::Sector(k) => (k as usize, true),
        };
        let first_tooth = if open { -((teeth as i64 - 1) / 2) } else { 0 };
        let (tooth, rim) = (&section.tooth, &section.rim);
        let own = own_points(tooth, rim);
        let odd = |k: usize| order == 2 && k % 2 == 1;
        let mut slots = [vec![], vec![]];
        let mut per_layer = [0; 2];
        for parity in 0..order {
            for &(_, u, v) in &own {
                let odds = usize::from(odd(u)) + usize::from(odd(v)) + parity;
                slots[parity].push(if odds <= 1 { per_layer[parity] as u32 } else { u32::MAX });
                per_layer[parity] += usize::from(odds <= 1);
            }
        }
        let per_cut_layer = [rim.rows + 1, if order == 2 { rim.rows / 2 + 1 } else { 0 }];
        let layers = options.elements_face as usize * order;
        Self {
            section,
            order,
            layers,
            teeth,
            first_tooth,
            open,
            slots,
            per_layer,
            per_cut_layer: if open { per_cut_layer } else { [0; 2] },
        }
    }

    fn lattice(&self, block: Block) -> &'a Lattice {
        match block {
            Block::Tooth => &self.section.tooth,
            Block::Rim => &self.section.rim,
        }
    }

    /// Nodes below layer `layer`, `per` in even and odd layers.
    fn below(&self, layer: usize, per: [usize; 2]) -> usize {
        if self.order == 1 { layer * per[0] } else { layer.div_ceil(2) * per[0] + layer / 2 * per[1] }
    }

    fn per_tooth(&self) -> usize {
        self.below(self.layers + 1, self.per_layer)
    }

    fn count(&self) -> usize {
        self.teeth * self.per_tooth() + self.below(self.layers + 1, self.per_cut_layer)
    }

    /// Number of the node at a lattice point that carries one.
    fn node(&self, mut tooth: usize, mut block: Block, mut u: usize, mut v: usize, layer: usize) -> u32 {
        let (teeth, rim) = (&self.section.tooth, &self.section.rim);
        if block == Block::Tooth && v == teeth.rows {
            (block, u, v) = (Block::Rim, u + self.section.shoulder, 0);
        }
        let parity = if self.order == 2 { layer % 2 } else { 0 };
        if block == Block::Rim && u == 0 {
            if self.open && tooth == 0 {
                // in odd layers a cut has nodes at the element corners only
                let along = if parity == 1 { v / 2 } else { v };
                return (self.teeth * self.per_tooth() + self.below(layer, self.per_cut_layer) + along) as u32;
            }
            tooth = (tooth + self.teeth - 1) % self.teeth;
            u = rim.columns;
        }
        let point = match block {
            Block::Tooth => v * (teeth.columns + 1) + u,
            Block::Rim => teeth.rows * (teeth.columns + 1) + v * rim.columns + u - 1,
        };
        let slot = self.slots[parity][point] as usize;
        (tooth * self.per_tooth() + self.below(layer, self.per_layer) + slot) as u32
    }

    fn element(&self, kind: ElementKind, tooth: usize, block: Block, cell: [usize; 3], nodes: &mut [u32]) {
        for (node, xi) in nodes.iter_mut().zip(kind.reference_nodes()) {
            let [u, v, w] = offsets(xi, self.order);
            let at = |k: usize, step: usize| cell[k] * self.order + step;
            *node = self.node(tooth, block, at(0, u), at(1, v), at(2, w));
        }
    }

    /// Positions in the order of the numbers, mm.
    fn positions(&self, gear: &Gear, options: &StructuredOptions) -> Vec<[f64; 3]> {
        let height = |layer: usize| (layer as f64 / self.layers as f64 - 0.5) * gear.face_width();
        // The section of a ring's tooth is on the side of -x.
        let section = if gear.is_internal() { PI } else { 0.0 };
        let turned = |[x, y]: [f64; 2], tooth: i64, layer: usize| {
            let z = height(layer);
            let (sin, cos) = (section + tooth as f64 * gear.pitch_angle() + gear.twist() * z).sin_cos();
            [x * cos - y * sin, x * sin + y * cos, z]
        };
        let own = own_points(&self.section.tooth, &self.section.rim);
        let mut positions = Vec::with_capacity(self.count());
        for tooth in self.first_tooth..self.first_tooth + self.teeth as i64 {
            for layer in 0..=self.layers {
                let slots = &self.slots[layer % options.order as usize];
                for (&(block, u, v), &slot) in own.iter().zip(slots) {
                    if slot != u32::MAX {
                        positions.push(turned(self.lattice(block).at(u, v), tooth, layer));
                    }
                }
            }
        }
        if self.open {
            let rim = &self.section.rim;
            for layer in 0..=self.layers {
                let step = if self.order == 2 && layer % 2 == 1 { 2 } else { 1 };
                for v in (0..=rim.rows).step_by(step) {
                    // the far cut of the tooth before: bit for bit what a longer sector has there
                    positions.push(turned(rim.at(rim.columns, v), self.first_tooth - 1, layer));
                }
            }
        }
        positions
    }
}

/// Lattice points that belong to a tooth: all but its neck row in the tooth block and the first cut.
fn own_points(tooth: &Lattice, rim: &Lattice) -> Vec<(Block, usize, usize)> {
    let upper = (0..tooth.rows).flat_map(|v| (0..=tooth.columns).map(move |u| (Block::Tooth, u, v)));
    let lower = (0..=rim.rows).flat_map(|v| (1..=rim.columns).map(move |u| (Block::Rim, u, v)));
    upper.chain(lower).collect()
}
