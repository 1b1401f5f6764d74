//! A block that is bent or pressed: how elements lock.

use faer::Mat;
use fem::{BoundaryLastFactor, DofMap, ElementOptions, Material, SymmetricMatrix, assemble_stiffness};
use mesh::{ElementKind, Mesh};

use crate::EnvelopeError;

/// What is done to the block.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Test {
    /// A cantilever, 10 x 1 x 1 mm, one element through: bends under a force across its tip.
    Bent,
    /// A cube of 1 mm on a rigid plate, held at its sides: a quarter of its top is pressed.
    Pressed,
}

impl Test {
    fn size(self) -> [f64; 3] {
        match self {
            Self::Bent => [10.0, 1.0, 1.0],
            Self::Pressed => [1.0; 3],
        }
    }

    /// Which coordinates of a node are held.
    fn held(self, x: [f64; 3]) -> [bool; 3] {
        let at = |value: f64, wall: f64| (value - wall).abs() < 1e-9;
        match self {
            Self::Bent => [at(x[0], 0.0); 3],
            Self::Pressed => {
                let plate = at(x[2], 0.0);
                [plate || at(x[0], 0.0) || at(x[0], 1.0), plate || at(x[1], 0.0) || at(x[1], 1.0), plate]
            }
        }
    }

    /// Axis of the load, and whether a node bears a share of it.
    fn loaded(self, x: [f64; 3]) -> (usize, bool) {
        match self {
            Self::Bent => (1, (x[0] - 10.0).abs() < 1e-9),
            Self::Pressed => (2, (x[2] - 1.0).abs() < 1e-9 && x[0] < 0.5 + 1e-9 && x[1] < 0.5 + 1e-9),
        }
    }
}

/// Compliance (mm/N) of a block of `cells` under one newton spread evenly over the loaded nodes: the work that the load
/// does. Locked elements have too little of it.
///
/// # Errors
/// [`EnvelopeError::Piece`] where the block cannot be solved.
pub(crate) fn compliance(
    test: Test,
    kind: ElementKind,
    cells: [usize; 3],
    poisson: f64,
    options: &ElementOptions,
) -> Result<f64, EnvelopeError> {
    let fail = EnvelopeError::of::<fem::FemError>("block");
    let size = test.size();
    let mesh = Mesh::block(kind, cells, |c| [0, 1, 2].map(|a| c[a] * size[a] / cells[a] as f64));
    let material = Material::new(1000.0, poisson, 1e-9).map_err(EnvelopeError::of("block"))?;
    let dofs = DofMap::new(mesh.nodes.len(), &[]);
    let stiffness = assemble_stiffness(&mesh, &material, &dofs, options).map_err(&fail)?;
    let mut number = vec![None; stiffness.n()];
    let (mut count, mut load) = (0, Vec::new());
    for (node, &x) in mesh.nodes.iter().enumerate() {
        let (held, (direction, loaded)) = (test.held(x), test.loaded(x));
        for axis in (0..3).filter(|&a| !held[a]) {
            let Some(dof) = dofs.dof(node as u32, axis) else { continue };
            number[dof] = Some(count);
            count += 1;
            load.push(if loaded && axis == direction { 1.0 } else { 0.0 });
        }
    }
    let kept: Vec<_> = stiffness.entries().filter_map(|(i, j, v)| Some((number[i]?, number[j]?, v))).collect();
    let matrix = SymmetricMatrix::from_triplets(count, &kept).map_err(&fail)?;
    let total: f64 = load.iter().sum();
    let mut x = Mat::from_fn(count, 1, |i, _| load[i] / total);
    BoundaryLastFactor::new(&matrix, &[]).map_err(&fail)?.solve(x.as_mut()).map_err(&fail)?;
    Ok((0..count).map(|i| load[i] / total * x[(i, 0)]).sum())
}
