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
        let Some([first, second]) = &self.cuts else { return Err(MeshError::NoCuts) };
        let copies = self.teeth.max(1);
        let partner = partners(&self.mesh, first, second, copies)?;
        let numbers = Numbers::new(&partner, copies)?;
        let nodes = numbers.positions(&self.mesh);
        let mesh = Mesh {
            node_tags: (1..=nodes.len() as u64).collect(),
            nodes,
            blocks: numbers.blocks(&self.mesh),
            surfaces: Vec::new(),
            volumes: self.mesh.volumes.clone(),
        };

        let mut flanks = BTreeMap::new();
        for (&(tooth, side), faces) in &self.flanks {
            for copy in 0..copies {
                flanks.insert(((tooth + copy) % copies, side), numbers.faces(copy, faces));
            }
        }
        let bore = SurfaceGroup { name: self.bore.name.clone(), faces: numbers.all_faces(&self.bore.faces) };
        let mut surfaces = vec![bore.clone()];
        surfaces.extend(flanks.iter().map(|(&(tooth, side), faces)| SurfaceGroup {
            name: format!("flank_{}_{tooth}", side.name()),
            faces: faces.clone(),
        }));
        let others = self.other_groups([first, second]);
        surfaces.extend(others.into_iter().map(|g| SurfaceGroup { faces: numbers.all_faces(&g.faces), ..g }));
        surfaces.sort_by(|a, b| a.name.cmp(&b.name));
        // Somebody's other group may have a flank's name: the flank, which came first, keeps it.
        surfaces.dedup_by(|a, b| a.name == b.name);
        Ok(Self::from_parts(Mesh { surfaces, ..mesh }, copies, bore, flanks, None))
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

/// Node numbers of the whole gear.
struct Numbers {
    copies: u32,
    /// Nodes of the sector that a copy adds, in their order.
    own: Vec<u32>,
    /// Nodes on the axis, which all copies share; they come last.
    shared: Vec<u32>,
    /// Where in a copy each node of the sector lies.
    slots: Vec<Slot>,
}

/// Where a node of the sector is in the gear.
#[derive(Clone, Copy)]
enum Slot {
    /// n-th of the copy's own nodes.
    Own(u32),
    /// n-th of the own nodes of the copy before.
    Before(u32),
    /// n-th of the nodes on the axis.
    Shared(u32),
}

impl Numbers {
    fn new(partner: &[u32], copies: u32) -> Result<Self, MeshError> {
        let (mut own, mut shared) = (Vec::new(), Vec::new());
        let mut places = vec![None; partner.len()];
        for (node, &there) in (0_u32..).zip(partner) {
            if there == NO_PARTNER {
                places[node as usize] = Some(Slot::Own(own.len() as u32));
                own.push(node);
            } else if there == node {
                places[node as usize] = Some(Slot::Shared(shared.len() as u32));
                shared.push(node);
            }
        }
        let nodes = own.len() as u64 * u64::from(copies) + shared.len() as u64;
        if nodes > MOST_NODES {
            return Err(MeshError::TooLarge { nodes, most: MOST_NODES });
        }
        let slot = |node: usize| match places[node] {
            Some(slot) => Ok(slot),
            None => match places[partner[node] as usize] {
                Some(Slot::Own(slot)) => Ok(Slot::Before(slot)),
                // The partner lies on the first cut as well.
                _ => Err(MeshError::CutsCross),
            },
        };
        let slots = (0..partner.len()).map(slot).collect::<Result<_, _>>()?;
        Ok(Self { copies, own, shared, slots })
    }

    /// Number in the gear of a sector's node in one copy.
    fn node(&self, copy: u32, node: u32) -> u32 {
        let own = self.own.len() as u32;
        match self.slots[node as usize] {
            Slot::Own(slot) => copy * own + slot,
            Slot::Before(slot) => (copy + self.copies - 1) % self.copies * own + slot,
            Slot::Shared(slot) => self.copies * own + slot,
        }
    }

    /// Positions in the order of the numbers, mm.
    fn positions(&self, sector: &Mesh) -> Vec<[f64; 3]> {
        let mut nodes = Vec::with_capacity(self.own.len() * self.copies as usize + self.shared.len());
        for copy in 0..self.copies {
            // From the sector each time, not from copy to copy: errors do not add up.
            let turn = Turn::new(TAU * f64::from(copy) / f64::from(self.copies));
            nodes.extend(self.own.iter().map(|&n| turn.of(sector.nodes[n as usize])));
        }
        nodes.extend(self.shared.iter().map(|&n| sector.nodes[n as usize]));
        nodes
    }

    /// Elements of all copies.
    fn blocks(&self, sector: &Mesh) -> Vec<ElementBlock> {
        let mut last = 0;
        let copies = |block: &ElementBlock| {
            let connectivity: Vec<u32> = (0..self.copies)
                .flat_map(|copy| block.connectivity.iter().map(move |&node| self.node(copy, node)))
                .collect();
            let first = last + 1;
            last += block.len() as u64 * u64::from(self.copies);
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
        (0..self.copies).flat_map(|copy| self.faces(copy, faces)).collect()
    }
}
