//! A mesh with known parts of the gear.

use std::collections::BTreeMap;

use geometry::Side;

use crate::{BoreCoupling, Face, FaceTable, GroupNames, Mesh, MeshError, SurfaceGroup};

/// A mesh whose bore, flanks and cuts are known. Every face is a boundary face with its normal outwards.
#[derive(Debug, Clone, PartialEq)]
pub struct MeshedGear {
    pub(crate) mesh: Mesh,
    pub(crate) teeth: u32,
    pub(crate) bore: SurfaceGroup,
    bore_nodes: Vec<u32>,
    pub(crate) coupling: BoreCoupling,
    pub(crate) flanks: BTreeMap<(u32, Side), Vec<Face>>,
    pub(crate) cuts: Option<[SurfaceGroup; 2]>,
    /// Whether teeth are numbered clockwise, as those of a ring are.
    pub(crate) clockwise: bool,
}

impl MeshedGear {
    /// Finds the parts of a gear with `teeth` teeth by the names of the physical groups.
    ///
    /// The bore and at least one flank must be named, and either both cuts or none.
    ///
    /// # Errors
    /// [`MeshError::MissingGroup`]; [`MeshError::NotOnBoundary`] if a face of a group does not bound the body;
    /// [`MeshError::SameTooth`] if two groups name the same flank.
    pub fn from_groups(mesh: Mesh, names: &GroupNames, teeth: u32) -> Result<Self, MeshError> {
        names.check()?;
        let table = FaceTable::new(&mesh);
        let bore = Self::find_group(&mesh, &names.bore, &table)?;
        let mut flanks = BTreeMap::new();
        let mut named: BTreeMap<(u32, Side), &str> = BTreeMap::new();
        for group in &mesh.surfaces {
            let Some((side, number)) = names.parse(&group.name) else {
                continue;
            };
            let tooth = number.rem_euclid(i64::from(teeth.max(1))) as u32;
            if let Some(first) = named.insert((tooth, side), &group.name) {
                let (first, second) = (first.to_owned(), group.name.clone());
                return Err(MeshError::SameTooth { first, second, tooth, teeth });
            }
            flanks.insert((tooth, side), outward(group, &mesh, &table)?.faces);
        }
        if flanks.is_empty() {
            return Err(missing(&mesh, &names.flank_left.replace("{k}", "<k>")));
        }
        let cuts = Self::find_cuts(&mesh, names, &table)?;
        Ok(Self::from_parts(mesh, teeth, bore, flanks, cuts))
    }

    /// The group of that name, normals outwards.
    pub(crate) fn find_group(mesh: &Mesh, name: &str, table: &FaceTable) -> Result<SurfaceGroup, MeshError> {
        outward(mesh.surface(name).ok_or_else(|| missing(mesh, name))?, mesh, table)
    }

    /// Both cuts, or none where the mesh has none.
    pub(crate) fn find_cuts(
        mesh: &Mesh,
        names: &GroupNames,
        table: &FaceTable,
    ) -> Result<Option<[SurfaceGroup; 2]>, MeshError> {
        if mesh.surface(&names.cut_0).is_none() && mesh.surface(&names.cut_1).is_none() {
            return Ok(None);
        }
        Ok(Some([Self::find_group(mesh, &names.cut_0, table)?, Self::find_group(mesh, &names.cut_1, table)?]))
    }

    /// From parts whose faces are known to be boundary faces with their normals outwards.
    pub(crate) fn from_parts(
        mesh: Mesh,
        teeth: u32,
        bore: SurfaceGroup,
        flanks: BTreeMap<(u32, Side), Vec<Face>>,
        cuts: Option<[SurfaceGroup; 2]>,
    ) -> Self {
        let bore_nodes = bore.nodes();
        Self { mesh, teeth, bore, bore_nodes, coupling: BoreCoupling::Kinematic, flanks, cuts, clockwise: false }
    }

    /// Sets the direction in which teeth are numbered, seen from +z: `clockwise` for a ring, otherwise
    /// counter-clockwise, which is the default.
    #[must_use]
    pub fn numbered(self, clockwise: bool) -> Self {
        Self { clockwise, ..self }
    }

    /// +1 if teeth are numbered counter-clockwise, -1 if clockwise.
    pub fn numbering_sign(&self) -> f64 {
        if self.clockwise { -1.0 } else { 1.0 }
    }

    /// Angle about z from a tooth to the tooth `pitches` numbers higher, rad.
    pub fn pitches_on(&self, pitches: u32) -> f64 {
        self.numbering_sign() * (std::f64::consts::TAU * f64::from(pitches) / f64::from(self.teeth))
    }

    /// The mesh.
    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// Number of teeth z of the whole gear, even if the mesh is a sector.
    pub fn tooth_count(&self) -> u32 {
        self.teeth
    }

    /// Faces of the bore that are held.
    pub fn bore(&self) -> &SurfaceGroup {
        &self.bore
    }

    /// Nodes of the held faces, ascending; [`MeshedGear::held_nodes`] are those that do not move.
    pub fn bore_nodes(&self) -> &[u32] {
        &self.bore_nodes
    }

    /// Faces of one flank; `tooth` is taken modulo z. `None` if the mesh does not have this flank.
    pub fn flank(&self, tooth: u32, side: Side) -> Option<&[Face]> {
        self.flanks.get(&(tooth % self.teeth.max(1), side)).map(Vec::as_slice)
    }

    /// Teeth that have a known flank, ascending, 0..z.
    pub fn teeth(&self) -> Vec<u32> {
        let mut teeth: Vec<u32> = self.flanks.keys().map(|k| k.0).collect();
        teeth.dedup();
        teeth
    }

    /// Whether the mesh has both flanks of every tooth and no cuts.
    pub fn is_whole_gear(&self) -> bool {
        self.cuts.is_none() && self.flanks.len() as u64 == 2 * u64::from(self.teeth)
    }

    /// The periodic faces of a sector: first the one towards the preceding tooth, then the one towards the next tooth.
    pub fn cuts(&self) -> Option<[&SurfaceGroup; 2]> {
        self.cuts.as_ref().map(|[first, second]| [first, second])
    }
}

/// No group of that name: say which there are.
fn missing(mesh: &Mesh, wanted: &str) -> MeshError {
    MeshError::MissingGroup { wanted: wanted.to_owned(), found: mesh.surfaces.iter().map(|s| s.name.clone()).collect() }
}

/// The faces of a group as the elements have them, normals outwards.
///
/// Files give faces in either orientation, and some writers start at another corner.
fn outward(group: &SurfaceGroup, mesh: &Mesh, table: &FaceTable) -> Result<SurfaceGroup, MeshError> {
    let mut faces = Vec::with_capacity(group.faces.len());
    for face in &group.faces {
        let mut owners = table.owners(face.corner_key());
        let what = match (owners.next(), owners.next()) {
            (Some(owner), None) => {
                let own = owner.face(mesh);
                if own.kind == face.kind && same_nodes(own.nodes(), face.nodes()) {
                    faces.push(own);
                    continue;
                }
                "is of another kind than the face of its element"
            }
            (None, _) => "is no face of a volume element",
            _ => "lies inside the body, between two elements",
        };
        let tag = |&n: &u32| mesh.node_tags.get(n as usize).copied().unwrap_or(u64::from(n));
        let nodes = face.corners().iter().map(tag).collect();
        return Err(MeshError::NotOnBoundary { group: group.name.clone(), nodes, what });
    }
    Ok(SurfaceGroup { name: group.name.clone(), faces })
}

/// Whether two faces have the same nodes in any order.
fn same_nodes(a: &[u32], b: &[u32]) -> bool {
    let sorted = |nodes: &[u32]| {
        let mut all = [u32::MAX; 9];
        all[..nodes.len()].copy_from_slice(nodes);
        all.sort_unstable();
        all
    };
    sorted(a) == sorted(b)
}
