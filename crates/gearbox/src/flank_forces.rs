//! Forces of an exact mesh on the nodes of its gears, slice by slice.

use std::collections::BTreeMap;

use contact::wrenches;

use crate::ExactMesh;

/// Forces of a mesh on the nodes of one of its gears, in the frame of its matrices.
#[derive(Debug, Clone, PartialEq)]
pub struct FlankForces {
    /// Angle of that frame from +x, rad: for alike teeth, the first tooth of the matrices counts whichever it is.
    pub angle: f64,
    /// Slices that carry load.
    pub slices: Vec<SliceForces>,
}

/// Forces of a slice on the nodes of one gear.
#[derive(Debug, Clone, PartialEq)]
pub struct SliceForces {
    /// Pair of teeth in the window, counted from 0.
    pub pair: usize,
    /// Normal force, N.
    pub force: f64,
    /// How far both flanks approach each other beside what the matrices of the gears give way under these forces: the local
    /// approach, less what the matrices have of the half teeth, mm. Theory (38).
    pub approach: f64,
    /// Nodes of the mesh and forces on them, N. Their resultant is nearly that of the slice: faces are not quite the flank.
    pub nodes: Vec<(u32, [f64; 3])>,
    /// Force (N) and moment about the middle of the gear (N mm) on the flank itself.
    pub wrench: [f64; 6],
}

impl FlankForces {
    /// Forces of all slices by node, N, ascending.
    pub fn by_node(&self) -> Vec<(u32, [f64; 3])> {
        let mut all: BTreeMap<u32, [f64; 3]> = BTreeMap::new();
        for (node, force) in self.slices.iter().flat_map(|slice| &slice.nodes) {
            let sum = all.entry(*node).or_default();
            (0..3).for_each(|k| sum[k] += force[k]);
        }
        all.into_iter().collect()
    }
}

impl ExactMesh {
    /// Forces of the last evaluation on the nodes of both gears, in a gearbox whose mesh has this direction (rad).
    pub(crate) fn flank_forces(&self, direction: f64) -> Option<[FlankForces; 2]> {
        let (contact, set) = (&self.contact, self.contact.contact_set());
        let forces = contact.solver().forces();
        let rows = set.supported_rows(&self.poses, contact.rows(), contact.slices(), forces);
        let windows = set.windows()?;
        let beside = set.beside_matrices(&rows, forces);
        let mut found = [0, 1].map(|end| {
            let angle = direction + self.frame_angle(end);
            FlankForces { angle, slices: Vec::new() }
        });
        for (i, state) in contact.states(forces).enumerate().filter(|(i, _)| forces[*i] > 0.0) {
            let (pair, force) = (set.pair_of(rows[i].patches.0), forces[i]);
            let approach = state.local.approach + beside[i];
            let whole = wrenches(&self.poses, &rows[i..=i], &forces[i..=i]);
            let on = set.forces_of(&rows[i..=i], &forces[i..=i])?;
            for (end, ((own, window), on)) in found.iter_mut().zip(windows).zip(&on).enumerate() {
                let turned = |v: [f64; 3]| self.poses[end].inverse_transform_vector(&v.into());
                let [f, m] = [turned(whole[end].force), turned(whole[end].moment)];
                let wrench = [f.x, f.y, f.z, m.x, m.y, m.z];
                let of_nodes = on.chunks_exact(3).map(|f| [f[0], f[1], f[2]]);
                let nodes = window.reduced.nodes.iter().copied().zip(of_nodes);
                let nodes = nodes.filter(|(_, f)| f.iter().any(|x| *x != 0.0)).collect();
                own.slices.push(SliceForces { pair, force, approach, nodes, wrench });
            }
        }
        Some(found)
    }
}
