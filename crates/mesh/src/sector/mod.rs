//! Makes the whole gear from a sector of one tooth.
//!
//! ```text
//!         cut_1          copy k is the sector turned by k 2 pi / z about z. Node i of cut_0 in copy k
//!        /               *is* the node of cut_1 in copy k - 1 on which it falls, so all positions of the
//!   ----<  tooth 0       gear are turned positions of one sector less its cut_0: cyclic to round-off.
//!        \
//!         cut_0
//! ```

mod cuts;
mod numbers;

use std::collections::{BTreeMap, HashSet};

use geometry::Side;

use crate::check::tag;
use crate::{Face, Mesh, MeshError, MeshedGear, SurfaceGroup};
use cuts::{NO_PARTNER, partners};
use numbers::Numbers;

/// Several copies of a periodic sector.
#[derive(Debug, Clone)]
pub struct Copies {
    /// The copies as one mesh.
    pub gear: MeshedGear,
    /// Origin of each node in the sector.
    pub origins: Vec<Origin>,
    /// Pairs of nodes: a node of the sector's first cut, and the node of the second cut with which it coincides after a
    /// rotation by one pitch. Ascending.
    pub cuts: Vec<[u32; 2]>,
    /// Whether the sector has nodes on the axis, which all copies share.
    pub on_axis: bool,
}

/// Origin of a node of the copies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Origin {
    /// Number of the copy, 0 .. z-1.
    pub copy: u32,
    /// Node of the sector. It never lies only on the second cut: such a node is a node of the first cut of the next
    /// copy.
    pub node: u32,
}

impl MeshedGear {
    /// The whole gear: for a periodic sector of one tooth, the result of [`MeshedGear::replicate`]; otherwise the mesh
    /// itself.
    ///
    /// A sector of one tooth has both cuts and at most one flank on either side. Sectors of several teeth are used with
    /// free cuts.
    ///
    /// # Errors
    /// The errors of [`MeshedGear::replicate`].
    pub fn whole(self) -> Result<Self, MeshError> {
        if self.is_periodic_sector() { self.replicate() } else { Ok(self) }
    }

    /// Whether the mesh has both cuts and at most one flank on either side.
    pub fn is_periodic_sector(&self) -> bool {
        let one = |side| self.flanks.keys().filter(|k| k.1 == side).count() <= 1;
        self.cuts.is_some() && one(Side::Left) && one(Side::Right)
    }

    /// z copies of a periodic sector, nodes of adjoining cuts merged. Copy k is rotated by k 2 pi / z about z, in the
    /// opposite direction if teeth are numbered clockwise.
    ///
    /// Nodes and elements of copy 0 (the sector without the nodes of its first cut) come first, in their order, then
    /// those of copy 1, and so on; tags are 1, 2, ... Tooth t of the sector becomes tooth t + k of copy k. Surface
    /// groups are the bore, the flanks with the names `flank_left_<k>` and `flank_right_<k>`, and all other groups of
    /// the sector except the cuts.
    ///
    /// # Errors
    /// [`MeshError::NoCuts`]; [`MeshError::CutsApart`] if a rotated node of one cut is farther than 1e-9 of the largest
    /// radius from every node of the other; [`MeshError::CutFaces`] if nodes coincide but faces do not;
    /// [`MeshError::CutInPart`] if the groups of the cuts lack faces; [`MeshError::TooLarge`] above 20 million nodes.
    pub fn replicate(&self) -> Result<Self, MeshError> {
        Ok(self.copies(0, self.teeth)?.gear)
    }

    /// `count` copies of a periodic sector, starting at copy `first` (modulo z), made as in [`MeshedGear::replicate`].
    ///
    /// Fewer than z copies keep two cuts: the first cut of their first copy and the second cut of their last one. Nodes
    /// of that first cut come after those of all copies. Tags are those of the sector, so a node is identified by its
    /// tooth and by its tag in the sector's file.
    ///
    /// # Errors
    /// The errors of [`MeshedGear::replicate`].
    pub fn copies(&self, first: u32, count: u32) -> Result<Copies, MeshError> {
        let Some([from, to]) = &self.cuts else { return Err(MeshError::NoCuts) };
        let teeth = self.teeth.max(1);
        let partner = partners(&self.mesh, from, to, self.pitches_on(1))?;
        let numbers = Numbers::new(&partner, teeth, first % teeth, count.clamp(1, teeth))?;
        let nodes = numbers.positions(&self.mesh, |turns| self.pitches_on(turns));
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
        let gear = Self::from_parts(Mesh { surfaces, ..mesh }, teeth, bore, flanks, cuts)
            .coupled(self.coupling)
            .numbered(self.clockwise);
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
