//! Numbers of the sector's nodes in its copies.

use std::collections::BTreeMap;

use super::cuts::NO_PARTNER;
use crate::periodic::Turn;
use crate::{ElementBlock, Face, Mesh, MeshError};

/// Largest mesh made, in nodes; nothing here could be solved on it.
const MOST_NODES: u64 = 20_000_000;

/// Node numbers of some copies of a sector.
pub(super) struct Numbers {
    teeth: u32,
    pub(super) first: u32,
    pub(super) count: u32,
    /// Nodes of the sector that a copy adds, in their order.
    own: Vec<u32>,
    /// Nodes of the first cut, which the first copy of an open chain adds.
    start: Vec<u32>,
    /// Nodes on the axis, which all copies share; they come last.
    pub(super) shared: Vec<u32>,
    /// Where in a copy each node of the sector lies.
    slots: Vec<Slot>,
    /// The first cut's node that falls on a node of the second one.
    on_first: BTreeMap<u32, u32>,
}

/// Where a node of the sector is in the gear.
#[derive(Clone, Copy)]
enum Slot {
    /// n-th of the copy's own nodes.
    Own(u32),
    /// n-th of the own nodes of the copy before; m-th of the first cut.
    Before(u32, u32),
    /// n-th of the nodes on the axis.
    Shared(u32),
}

/// Where a node of the copies is: turned by `turns` pitches from node `own`, and as the first cut's node `node` of
/// `copy`.
pub(super) struct Placed {
    pub(super) turns: u32,
    pub(super) own: u32,
    pub(super) copy: u32,
    pub(super) node: u32,
}

impl Numbers {
    pub(super) fn new(partner: &[u32], teeth: u32, first: u32, count: u32) -> Result<Self, MeshError> {
        let (mut own, mut start, mut shared) = (Vec::new(), Vec::new(), Vec::new());
        let mut places = vec![None; partner.len()];
        let mut on_first = BTreeMap::new();
        for (node, &there) in (0_u32..).zip(partner) {
            if there == NO_PARTNER {
                places[node as usize] = Some(Slot::Own(own.len() as u32));
                own.push(node);
            } else if there == node {
                places[node as usize] = Some(Slot::Shared(shared.len() as u32));
                shared.push(node);
            } else {
                on_first.insert(there, node);
            }
        }
        let mut slot = |node: usize| match places[node] {
            Some(slot) => Ok(slot),
            None => match places[partner[node] as usize] {
                Some(Slot::Own(slot)) => {
                    start.push(node as u32);
                    Ok(Slot::Before(slot, start.len() as u32 - 1))
                }
                // The partner lies on the first cut as well.
                _ => Err(MeshError::CutsCross),
            },
        };
        let slots = (0..partner.len()).map(&mut slot).collect::<Result<_, _>>()?;
        if count == teeth {
            start.clear();
        }
        let nodes = own.len() as u64 * u64::from(count) + (start.len() + shared.len()) as u64;
        if nodes > MOST_NODES {
            return Err(MeshError::TooLarge { nodes, most: MOST_NODES });
        }
        Ok(Self { teeth, first, count, own, start, shared, slots, on_first })
    }

    /// Whether the last copy joins the first.
    pub(super) fn is_closed(&self) -> bool {
        self.count == self.teeth
    }

    /// Number in the gear of a sector's node in one copy, counted from the first.
    pub(super) fn node(&self, copy: u32, node: u32) -> u32 {
        let own = self.own.len() as u32;
        match self.slots[node as usize] {
            Slot::Own(slot) => copy * own + slot,
            Slot::Before(_, place) if copy == 0 && !self.is_closed() => self.count * own + place,
            Slot::Before(slot, _) => (copy + self.count - 1) % self.count * own + slot,
            Slot::Shared(slot) => self.count * own + self.start.len() as u32 + slot,
        }
    }

    /// Where the nodes are, in the order of the numbers.
    pub(super) fn origins(&self) -> Vec<Placed> {
        let turns = |copy: u32| (self.first + copy) % self.teeth;
        let mut placed = Vec::with_capacity(self.own.len() * self.count as usize + self.start.len());
        for copy in 0..self.count {
            placed.extend(self.own.iter().map(|&own| match self.on_first.get(&own) {
                Some(&node) => Placed { turns: turns(copy), own, copy: turns(copy + 1), node },
                None => Placed { turns: turns(copy), own, copy: turns(copy), node: own },
            }));
        }
        let rest = self.start.iter().chain(&self.shared);
        placed.extend(rest.map(|&own| Placed { turns: turns(0), own, copy: turns(0), node: own }));
        placed
    }

    /// Positions in the order of the numbers, mm; `angle`: by which so many pitches turn, rad.
    pub(super) fn positions(&self, sector: &Mesh, angle: impl Fn(u32) -> f64) -> Vec<[f64; 3]> {
        // From the sector each time, not from copy to copy: errors do not add up.
        let turns: Vec<Turn> = (0..self.teeth).map(|k| Turn::new(angle(k))).collect();
        self.origins().iter().map(|p| turns[p.turns as usize].of(sector.nodes[p.own as usize])).collect()
    }

    /// Elements of all copies.
    pub(super) fn blocks(&self, sector: &Mesh) -> Vec<ElementBlock> {
        let mut last = 0;
        let copies = |block: &ElementBlock| {
            let connectivity: Vec<u32> = (0..self.count)
                .flat_map(|copy| block.connectivity.iter().map(move |&node| self.node(copy, node)))
                .collect();
            let first = last + 1;
            last += block.len() as u64 * u64::from(self.count);
            ElementBlock { kind: block.kind, connectivity, tags: (first..=last).collect() }
        };
        sector.blocks.iter().map(copies).collect()
    }

    /// Faces of one copy.
    pub(super) fn faces(&self, copy: u32, faces: &[Face]) -> Vec<Face> {
        faces.iter().map(|face| face.renumbered(|node| self.node(copy, node))).collect()
    }

    /// Faces of all copies.
    pub(super) fn all_faces(&self, faces: &[Face]) -> Vec<Face> {
        (0..self.count).flat_map(|copy| self.faces(copy, faces)).collect()
    }
}
