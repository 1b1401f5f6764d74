//! The springs under an elastic bore, as a part of a stiffness. Theory (13d).

use fem::{DofMap, ElementOptions, Material, SymmetricMatrix};
use mesh::{Face, FaceTable, Foundation, Mesh, MeshedGear};

use crate::ReductionError;

/// Faces of a mesh that stand on springs.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ElasticBore {
    foundation: Foundation,
    faces: Vec<Face>,
}

impl ElasticBore {
    /// The held faces of a gear; `None` where its bore does not stand on springs.
    pub(crate) fn of(gear: &MeshedGear) -> Option<Self> {
        let foundation = gear.bore_coupling().foundation()?;
        Some(Self { foundation, faces: gear.bore().faces.clone() })
    }

    /// The faces.
    pub(crate) fn faces(&self) -> &[Face] {
        &self.faces
    }

    /// The faces that belong to elements of `part`, a part of the mesh with `number` for each node's number.
    pub(crate) fn in_part(self, part: &Mesh, number: impl Fn(u32) -> Option<u32>) -> Self {
        Self { foundation: self.foundation, faces: faces_in_part(&self.faces, part, number) }
    }

    /// Stiffness of the elements of a mesh (N/mm), and of the springs under its bore.
    pub(crate) fn stiffness(
        own: Option<&Self>,
        mesh: &Mesh,
        (material, elements): (&Material, &ElementOptions),
        dofs: &DofMap,
    ) -> Result<SymmetricMatrix, ReductionError> {
        let mut stiffness = fem::assemble_stiffness(mesh, material, dofs, elements)?;
        let springs = match own {
            Some(bore) => bore.foundation.springs(mesh, &bore.faces).map_err(ReductionError::bore)?,
            None => Vec::new(),
        };
        for spring in springs {
            let nodes = spring.face.nodes();
            for (i, j) in (0..nodes.len()).flat_map(|i| (0..=i).map(move |j| (i, j))) {
                let share = spring.shape[i] * spring.shape[j];
                // A block on the diagonal has its mirror image in itself.
                for (a, b) in (0..3).flat_map(|a| (0..3).map(move |b| (a, b))).filter(|(a, b)| i > j || a >= b) {
                    if let (Some(row), Some(column)) = (dofs.dof(nodes[i], a), dofs.dof(nodes[j], b)) {
                        stiffness.add(row, column, share * spring.stiffness[(a, b)])?;
                    }
                }
            }
        }
        Ok(stiffness)
    }
}

/// The faces that belong to elements of `part`, a part of the mesh with `number` for each node's number.
pub(crate) fn faces_in_part(faces: &[Face], part: &Mesh, number: impl Fn(u32) -> Option<u32>) -> Vec<Face> {
    let table = FaceTable::new(part);
    let own = |face: &Face| {
        let nodes: Vec<u32> = face.nodes().iter().map(|&n| number(n)).collect::<Option<_>>()?;
        let face = Face::new(face.kind, &nodes);
        (table.owners(face.corner_key()).len() > 0).then_some(face)
    };
    faces.iter().filter_map(own).collect()
}
