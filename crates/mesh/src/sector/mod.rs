//! From a sector of one tooth to the whole gear.
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

/// Some copies of a periodic sector.
#[derive(Debug, Clone)]
pub struct Copies {
    /// The copies as one mesh.
    pub gear: MeshedGear,
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
    /// Node of the sector, never one that lies on its second cut alone: that one is a node of the next copy's first
    /// cut.
    pub node: u32,
}

impl MeshedGear {
    /// The whole gear where this is a periodic sector of one tooth, by [`MeshedGear::replicate`]; else itself.
    ///
    /// A sector of one tooth has both cuts and at most one flank of either side. Sectors of several teeth
    /// are used with free cuts.
    ///
    /// # Errors
    /// Those of [`MeshedGear::replicate`].
    pub fn whole(self) -> Result<Self, MeshError> {
        if self.is_periodic_sector() { self.replicate() } else { Ok(self) }
    }

    /// Whether the mesh has both cuts and at most one flank of either side.
    pub fn is_periodic_sector(&self) -> bool {
        let one = |side| self.flanks.keys().filter(|k| k.1 == side).count() <= 1;
        self.cuts.is_some() && one(Side::Left) && one(Side::Right)
    }

    /// z copies of a periodic sector, copy k turned by k 2 pi / z about z, the other way where teeth are numbered clockwise, nodes of adjoining cuts merged.
    ///
    /// Nodes and elements: those of copy 0 (the sector less the nodes of its first cut) in their order, then those of
    /// copy 1, ...; tags 1, 2, ... Tooth t of the sector is tooth t + k of copy k. Surface groups: the bore, the flanks
    /// under the names `flank_left_<k>` and `flank_right_<k>`, and all others of the sector but the cuts.
    ///
    /// # Errors
    /// [`MeshError::NoCuts`]; [`MeshError::CutsApart`] when a node of one cut, turned, is farther than 1e-9 of the
    /// largest radius from every node of the other; [`MeshError::CutFaces`] when nodes meet but faces do not;
    /// [`MeshError::CutInPart`] when the cuts' groups lack faces; [`MeshError::TooLarge`] past 20 million nodes.
    pub fn replicate(&self) -> Result<Self, MeshError> {
        Ok(self.copies(0, self.teeth)?.gear)
    }

    /// `count` copies of a periodic sector from copy `first` (modulo z) on, as [`MeshedGear::replicate`] makes all of
    /// them.
    ///
    /// Fewer than z copies have the first cut of their first copy and the second of their last one; nodes of the first
    /// one follow after those of all copies, and tags are those of the sector, so that a node is named by its tooth and
    /// by the tag it has in the sector's file.
    ///
    /// # Errors
    /// Those of [`MeshedGear::replicate`].
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
