//! From a sector of one tooth to the whole gear.
//!
//! ```text
//!         cut_1          copy k is the sector turned by k 2 pi / z about z. Node i of cut_0 in copy k
//!        /               *is* the node of cut_1 in copy k - 1 on which it falls, so all positions of the
//!   ----<  tooth 0       gear are turned positions of one sector less its cut_0: cyclic to round-off.
//!        \
//!         cut_0
//! ```

use std::collections::{BTreeMap, HashSet};
use std::f64::consts::TAU;

use geometry::Side;

use crate::check::tag;
use crate::periodic::{Places, Turn};
use crate::{ElementBlock, Face, FaceTable, GearMesh, Mesh, MeshError, SurfaceGroup};

/// Largest mesh made, in nodes; nothing here could be solved on it.
const MOST_NODES: u64 = 20_000_000;

/// `cut_1` has no such node: the cut's node is its own.
const NO_PARTNER: u32 = u32::MAX;

/// Some copies of a periodic sector.
#[derive(Debug, Clone)]
pub struct Copies {
    /// The copies as one mesh.
    pub gear: GearMesh,
    /// Where each of its nodes comes from.
    pub origins: Vec<Origin>,
    /// Which node of the sector's first cut falls on which one of the second when it is turned by one pitch, ascending.
    pub cuts: Vec<[u32; 2]>,
    /// Whether the sector has nodes on the axis, which belong to all copies.
    pub on_axis: bool,
}

/// A node of some copies of a sector.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Origin {
    /// Copy, 0 .. z-1.
    pub copy: u32,
    /// Node of the sector, never one that lies on its second cut alone: that one is a node of the next copy's first cut.
    pub node: u32,
}

impl GearMesh {
    /// The whole gear where this is a periodic sector of one tooth, by [`GearMesh::replicate`]; else itself.
    ///
    /// A sector of one tooth has both cuts and at most one flank of either side. Sectors of several teeth
    /// are used with free cuts.
    ///
    /// # Errors
    /// Those of [`GearMesh::replicate`].
    pub fn whole(self) -> Result<Self, MeshError> {
        if self.is_periodic_sector() { self.replicate() } else { Ok(self) }
    }

    /// Whether the mesh has both cuts and at most one flank of either side.
    pub fn is_periodic_sector(&self) -> bool {
        let one = |side| self.flanks.keys().filter(|k| k.1 == side).count() <= 1;
        self.cuts.is_some() && one(Side::Left) && one(Side::Right)
    }

    /// z copies of a periodic sector, copy k turned by k 2 pi / z about z, nodes of adjoining cuts merged.
    ///
    /// Nodes and elements: those of copy 0 (the sector less the nodes of its first cut) in their order, then those of copy
    /// 1, ...; tags 1, 2, ... Tooth t of the sector is tooth t + k of copy k. Surface groups: the bore, the flanks
    /// under the names `flank_left_<k>` and `flank_right_<k>`, and all others of the sector but the cuts.
    ///
    /// # Errors
    /// [`MeshError::NoCuts`]; [`MeshError::CutsApart`] when a node of one cut, turned, is farther than 1e-9 of the largest
    /// radius from every node of the other; [`MeshError::CutFaces`] when nodes meet but faces do not;
    /// [`MeshError::CutInPart`] when the cuts' groups lack faces; [`MeshError::TooLarge`] past 20 million nodes.
    pub fn replicate(&self) -> Result<Self, MeshError> {
        Ok(self.copies(0, self.teeth)?.gear)
    }

    /// `count` copies of a periodic sector from copy `first` (modulo z) on, as [`GearMesh::replicate`] makes all of them.
    ///
    /// Fewer than z copies have the first cut of their first copy and the second of their last one; nodes of the first
    /// one follow after those of all copies, and tags are those of the sector, so that a node is named by its tooth and
    /// by the tag it has in the sector's file.
    ///
    /// # Errors
    /// Those of [`GearMesh::replicate`].
    pub fn copies(&self, first: u32, count: u32) -> Result<Copies, MeshError> {
        let Some([from, to]) = &self.cuts else { return Err(MeshError::NoCuts) };
        let teeth = self.teeth.max(1);
        let partner = partners(&self.mesh, from, to, teeth)?;
        let numbers = Numbers::new(&partner, teeth, first % teeth, count.clamp(1, teeth))?;
        let nodes = numbers.positions(&self.mesh);
        let mut mesh = Mesh {
            node_tags: (1..=nodes.len() as u64).collect(),
            nodes,
            blocks: numbers.blocks(&self.mesh),
            surfaces: Vec::new(),
            volumes: self.mesh.volumes.clone(),
        };

        let mut flanks = BTreeMap::new();
        for (&(tooth, side), faces) in &self.flanks {
            for copy in 0..numbers.count {
                flanks.insert(((tooth + numbers.first + copy) % teeth, side), numbers.faces(copy, faces));
            }
        }
        let bore = SurfaceGroup { name: self.bore.name.clone(), faces: numbers.all_faces(&self.bore.faces) };
        let mut surfaces = vec![bore.clone()];
        surfaces.extend(flanks.iter().map(|(&(tooth, side), faces)| SurfaceGroup {
            name: format!("flank_{}_{tooth}", side.name()),
            faces: faces.clone(),
        }));
        let others = self.other_groups([from, to]);
        surfaces.extend(others.into_iter().map(|g| SurfaceGroup { faces: numbers.all_faces(&g.faces), ..g }));
        let mut cuts = None;
        if !numbers.is_closed() {
            mesh.node_tags = numbers.origins().iter().map(|o| tag(&self.mesh, o.own)).collect();
            let end = |copy, cut: &SurfaceGroup| SurfaceGroup {
                name: cut.name.clone(),
                faces: numbers.faces(copy, &cut.faces),
            };
            let ends = [end(0, from), end(numbers.count - 1, to)];
            surfaces.extend(ends.iter().cloned());
            cuts = Some(ends);
        }
        surfaces.sort_by(|a, b| a.name.cmp(&b.name));
        // Somebody's other group may have a flank's name: the flank, which came first, keeps it.
        surfaces.dedup_by(|a, b| a.name == b.name);
        let origins = numbers.origins().iter().map(|o| Origin { copy: o.copy, node: o.node }).collect();
        let on_axis = !numbers.shared.is_empty();
        let gear = Self::from_parts(Mesh { surfaces, ..mesh }, teeth, bore, flanks, cuts);
        let pairs = (0_u32..).zip(&partner).filter(|(_, there)| **there != NO_PARTNER);
        let cuts = pairs.map(|(here, &there)| [here, there]).collect();
        Ok(Copies { gear, origins, cuts, on_axis })
    }

    /// Groups that are neither bore, flank nor cut, without the faces that the cuts share: these come to lie inside.
    fn other_groups(&self, cuts: [&SurfaceGroup; 2]) -> Vec<SurfaceGroup> {
        let keys = |faces: &[Face]| faces.iter().map(Face::corner_key).collect::<HashSet<_>>();
        let inside: HashSet<_> = cuts.iter().flat_map(|c| keys(&c.faces)).collect();
        let known: Vec<_> = self.flanks.values().map(|faces| keys(faces)).collect();
        let is_other = |group: &&SurfaceGroup| group.name != self.bore.name && !known.contains(&keys(&group.faces));
        let others = self.mesh.surfaces.iter().filter(is_other).map(|group| SurfaceGroup {
            name: group.name.clone(),
            faces: group.faces.iter().filter(|f| !inside.contains(&f.corner_key())).copied().collect(),
        });
        others.filter(|group| !group.faces.is_empty()).collect()
    }
}

/// For every node of the mesh the node of `second` that it falls on when turned by 2 pi / z;
/// [`NO_PARTNER`] for nodes off `first`.
fn partners(mesh: &Mesh, first: &SurfaceGroup, second: &SurfaceGroup, teeth: u32) -> Result<Vec<u32>, MeshError> {
    let angle = TAU / f64::from(teeth);
    let turn = Turn::new(angle);
    let (from, to) = (first.nodes(), second.nodes());
    let targets = Places::new(mesh, &to);
    let mut partner = vec![NO_PARTNER; mesh.nodes.len()];
    let apart = |node: u32, places: &Places, turn: Turn, cuts: [&SurfaceGroup; 2], angle: f64| MeshError::CutsApart {
        node: tag(mesh, node),
        cut: cuts[0].name.clone(),
        other: cuts[1].name.clone(),
        angle_deg: angle.to_degrees(),
        distance_mm: places.nearest(&turn.of(mesh.nodes[node as usize])),
        tolerance_mm: places.tolerance,
    };
    for &node in &from {
        let Some(there) = targets.at(&turn.of(mesh.nodes[node as usize])) else {
            return Err(apart(node, &targets, turn, [first, second], angle));
        };
        partner[node as usize] = there;
    }
    let back = Turn::new(-angle);
    let sources = Places::new(mesh, &from);
    for &node in &to {
        if sources.at(&back.of(mesh.nodes[node as usize])).is_none() {
            return Err(apart(node, &sources, back, [second, first], -angle));
        }
    }
    same_faces(mesh, first, second, &partner)?;
    all_of_the_cut(mesh, [first, second], &partner, turn)?;
    Ok(partner)
}

/// Every face of the one cut, turned, is a face of the other, and the other way round.
fn same_faces(mesh: &Mesh, first: &SurfaceGroup, second: &SurfaceGroup, partner: &[u32]) -> Result<(), MeshError> {
    // All nodes, not corners alone: a quadrilateral of eight nodes does not fit one of four or nine.
    let key = |nodes: &mut [u32; 9]| {
        nodes.sort_unstable();
        *nodes
    };
    let padded = |face: &Face, through: &dyn Fn(u32) -> u32| {
        let mut nodes = [u32::MAX; 9];
        for (slot, &node) in nodes.iter_mut().zip(face.nodes()) {
            *slot = through(node);
        }
        key(&mut nodes)
    };
    let refuse = |face: &Face, cut: &SurfaceGroup, other: &SurfaceGroup| MeshError::CutFaces {
        cut: cut.name.clone(),
        other: other.name.clone(),
        nodes: face.corners().iter().map(|&n| tag(mesh, n)).collect(),
    };
    let here: HashSet<[u32; 9]> = first.faces.iter().map(|f| padded(f, &|n| partner[n as usize])).collect();
    let there: HashSet<[u32; 9]> = second.faces.iter().map(|f| padded(f, &|n| n)).collect();
    if let Some(face) = first.faces.iter().find(|f| !there.contains(&padded(f, &|n| partner[n as usize]))) {
        return Err(refuse(face, first, second));
    }
    match second.faces.iter().find(|f| !here.contains(&padded(f, &|n| n))) {
        Some(face) => Err(refuse(face, second, first)),
        None => Ok(()),
    }
}

/// No node off the cuts falls on another when turned: else the gear would have slits where a cut's group lacks faces.
fn all_of_the_cut(
    mesh: &Mesh,
    [first, second]: [&SurfaceGroup; 2],
    partner: &[u32],
    turn: Turn,
) -> Result<(), MeshError> {
    let table = FaceTable::new(mesh);
    let boundary = SurfaceGroup { name: String::new(), faces: table.boundary().iter().map(|o| o.face(mesh)).collect() };
    let nodes = boundary.nodes();
    let places = Places::new(mesh, &nodes);
    for &node in nodes.iter().filter(|&&n| partner[n as usize] == NO_PARTNER) {
        if let Some(other) = places.at(&turn.of(mesh.nodes[node as usize])).filter(|&other| other != node) {
            let cuts = [first.name.clone(), second.name.clone()];
            return Err(MeshError::CutInPart { node: tag(mesh, node), other: tag(mesh, other), cuts });
        }
    }
    Ok(())
}

/// Node numbers of some copies of a sector.
struct Numbers {
    teeth: u32,
    first: u32,
    count: u32,
    /// Nodes of the sector that a copy adds, in their order.
    own: Vec<u32>,
    /// Nodes of the first cut, which the first copy of an open chain adds.
    start: Vec<u32>,
    /// Nodes on the axis, which all copies share; they come last.
    shared: Vec<u32>,
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

/// Where a node of the copies is: turned by `turns` pitches from node `own`, and as the first cut's node `node` of `copy`.
struct Placed {
    turns: u32,
    own: u32,
    copy: u32,
    node: u32,
}

impl Numbers {
    fn new(partner: &[u32], teeth: u32, first: u32, count: u32) -> Result<Self, MeshError> {
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
    fn is_closed(&self) -> bool {
        self.count == self.teeth
    }

    /// Number in the gear of a sector's node in one copy, counted from the first.
    fn node(&self, copy: u32, node: u32) -> u32 {
        let own = self.own.len() as u32;
        match self.slots[node as usize] {
            Slot::Own(slot) => copy * own + slot,
            Slot::Before(_, place) if copy == 0 && !self.is_closed() => self.count * own + place,
            Slot::Before(slot, _) => (copy + self.count - 1) % self.count * own + slot,
            Slot::Shared(slot) => self.count * own + self.start.len() as u32 + slot,
        }
    }

    /// Where the nodes are, in the order of the numbers.
    fn origins(&self) -> Vec<Placed> {
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

    /// Positions in the order of the numbers, mm.
    fn positions(&self, sector: &Mesh) -> Vec<[f64; 3]> {
        // From the sector each time, not from copy to copy: errors do not add up.
        let angle = |turns: u32| TAU * f64::from(turns) / f64::from(self.teeth);
        let turns: Vec<Turn> = (0..self.teeth).map(|k| Turn::new(angle(k))).collect();
        self.origins().iter().map(|p| turns[p.turns as usize].of(sector.nodes[p.own as usize])).collect()
    }

    /// Elements of all copies.
    fn blocks(&self, sector: &Mesh) -> Vec<ElementBlock> {
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
    fn faces(&self, copy: u32, faces: &[Face]) -> Vec<Face> {
        faces.iter().map(|face| face.renumbered(|node| self.node(copy, node))).collect()
    }

    /// Faces of all copies.
    fn all_faces(&self, faces: &[Face]) -> Vec<Face> {
        (0..self.count).flat_map(|copy| self.faces(copy, faces)).collect()
    }
}
