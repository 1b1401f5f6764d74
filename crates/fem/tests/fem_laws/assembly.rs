//! Assembly: what the whole inherits from its parts.

use crate::common::{largest, on_threads, shaken};
use fem::{
    DofMap, ElementOptions, FemError, Material, SymmetricMatrix, assemble, assemble_mass, assemble_stiffness,
    mass_properties,
};
use mesh::{ElementBlock, ElementKind, Mesh};

const STEEL: Material = Material::STEEL;

fn bits(matrix: &SymmetricMatrix) -> Vec<(usize, usize, u64)> {
    matrix.entries().map(|(r, c, v)| (r, c, v.to_bits())).collect()
}

#[test]
fn one_thread_or_two_the_same_bits() {
    for kind in ElementKind::ALL {
        let mesh = Mesh::block(kind, [7, 6, 5], shaken(0.15));
        let dofs = DofMap::new(mesh.nodes.len(), &[0, 3, 5]);
        let run = || assemble(&mesh, &STEEL, &dofs, &ElementOptions::default()).unwrap();
        let (one, two, many) = (on_threads(1, run), on_threads(2, run), on_threads(5, run));
        for other in [two, many] {
            assert!(bits(&one.stiffness) == bits(&other.stiffness), "{}: K differs", kind.name());
            assert!(bits(&one.mass) == bits(&other.mass), "{}: M differs", kind.name());
        }
        let properties = || mass_properties(&mesh, &STEEL).unwrap();
        assert_eq!(on_threads(1, properties), on_threads(2, properties));
    }
}

/// Rigid motions cost no force: three translations and three small rotations.
#[test]
fn a_rigid_move_costs_no_force() {
    for kind in ElementKind::ALL {
        let mesh = Mesh::block(kind, [3, 2, 2], shaken(0.15));
        let dofs = DofMap::new(mesh.nodes.len(), &[]);
        let k = assemble_stiffness(&mesh, &STEEL, &dofs, &ElementOptions::default()).unwrap();
        let stiffest = largest(k.diagonal());
        for mode in 0..6 {
            let u: Vec<f64> = mesh
                .nodes
                .iter()
                .flat_map(|x| match mode {
                    0 => [1.0, 0.0, 0.0],
                    1 => [0.0, 1.0, 0.0],
                    2 => [0.0, 0.0, 1.0],
                    3 => [0.0, -x[2], x[1]],
                    4 => [x[2], 0.0, -x[0]],
                    _ => [-x[1], x[0], 0.0],
                })
                .collect();
            let force = largest(k.multiply_vector(&u).unwrap());
            assert!(force < 1e-12 * stiffest, "{} mode {mode}: {force:e} N", kind.name());
        }
    }
}

/// Fixing nodes picks rows and columns of the free body's matrix, nothing else.
#[test]
fn fixing_nodes_drops_their_rows_and_columns() {
    let mesh = Mesh::block(ElementKind::Tet10, [2, 2, 1], shaken(0.1));
    let fixed = [1, 4, 9, 4];
    let (all, some) = (DofMap::new(mesh.nodes.len(), &[]), DofMap::new(mesh.nodes.len(), &fixed));
    let whole = assemble(&mesh, &STEEL, &all, &ElementOptions::default()).unwrap();
    let part = assemble(&mesh, &STEEL, &some, &ElementOptions::default()).unwrap();
    for (whole, part) in [(whole.stiffness, part.stiffness), (whole.mass, part.mass)] {
        let (whole, part) = (whole.to_dense(), part.to_dense());
        for i in 0..some.free_count() {
            for j in 0..some.free_count() {
                let dof = |k: usize| {
                    let (node, axis) = some.node_and_axis(k).unwrap();
                    all.dof(node, axis).unwrap()
                };
                assert_eq!(part[(i, j)], whole[(dof(i), dof(j))]);
            }
        }
    }
}

/// A box of 2 x 3 x 4 mm: mass, centre and inertia in closed form; M does the same on rigid motions.
#[test]
fn mass_centre_and_inertia_of_a_box() {
    let (size, cells) = ([2.0, 3.0, 4.0], [2, 3, 2]);
    for kind in ElementKind::ALL {
        let mesh = Mesh::block(kind, cells, |c| [0, 1, 2].map(|a| 100.0 + c[a] * size[a] / cells[a] as f64));
        let found = mass_properties(&mesh, &STEEL).unwrap();
        let mass = STEEL.density_t_per_mm3() * 24.0;
        assert!((found.mass_t - mass).abs() < 1e-12 * mass, "{}", kind.name());
        for a in 0..3 {
            assert!((found.centre_mm[a] - 100.0 - size[a] / 2.0).abs() < 1e-11);
            let (b, c) = ((a + 1) % 3, (a + 2) % 3);
            let inertia = mass / 12.0 * (size[b].powi(2) + size[c].powi(2));
            assert!((found.inertia_tmm2[a][a] - inertia).abs() < 1e-11 * inertia, "{}", kind.name());
            assert!(found.inertia_tmm2[a][b].abs() < 1e-11 * inertia);
        }
        let dofs = DofMap::new(mesh.nodes.len(), &[]);
        let m = assemble_mass(&mesh, &STEEL, &dofs).unwrap();
        // twice the kinetic energy of a unit spin about z through the origin
        let spin: Vec<f64> = mesh.nodes.iter().flat_map(|x| [-x[1], x[0], 0.0]).collect();
        let momentum = m.multiply_vector(&spin).unwrap();
        let energy: f64 = spin.iter().zip(&momentum).map(|(v, p)| v * p).sum();
        let about_origin = found.inertia_about_tmm2([0.0; 3])[2][2];
        assert!((energy - about_origin).abs() < 1e-11 * about_origin, "{}: {energy:e}", kind.name());
    }
}

/// Blocks of different kinds meet on shared nodes.
#[test]
fn kinds_can_be_mixed() {
    let mut mesh = Mesh::block(ElementKind::Hex8, [2, 1, 1], |c| c);
    let block = &mut mesh.blocks[0];
    let second: Vec<u32> = block.connectivity.split_off(8);
    block.tags.pop();
    let pick = |list: [usize; 6]| list.map(|i| second[i]);
    let connectivity = [pick([0, 1, 2, 4, 5, 6]), pick([0, 2, 3, 4, 6, 7])].concat();
    mesh.blocks.push(ElementBlock { kind: ElementKind::Wedge6, connectivity, tags: vec![2, 3] });
    let found = mass_properties(&mesh, &STEEL).unwrap();
    assert!((found.volume_mm3 - 2.0).abs() < 1e-14);
    let dofs = DofMap::new(mesh.nodes.len(), &[]);
    let m = assemble_mass(&mesh, &STEEL, &dofs).unwrap();
    let ones = vec![1.0; dofs.free_count()];
    let total: f64 = m.multiply_vector(&ones).unwrap().iter().sum();
    assert!((total - 3.0 * found.mass_t).abs() < 1e-14 * total);
}

#[test]
fn damaged_meshes_are_refused() {
    let good = Mesh::block(ElementKind::Hex8, [1, 1, 1], |c| c);
    let dofs = DofMap::new(8, &[]);
    let run = |mesh: &mesh::Mesh, dofs: &DofMap| {
        assemble_stiffness(mesh, &STEEL, dofs, &ElementOptions::default()).map(|_| ())
    };
    let mut mesh = good.clone();
    mesh.blocks[0].connectivity[3] = 8;
    assert_eq!(run(&mesh, &dofs), Err(FemError::NodeOutOfRange { tag: 1, node: 8, node_count: 8 }));
    let mut mesh = good.clone();
    mesh.blocks[0].connectivity.pop();
    assert!(matches!(run(&mesh, &dofs), Err(FemError::RaggedBlock { .. })));
    let mut mesh = good.clone();
    mesh.nodes[2][1] = f64::NAN;
    assert!(matches!(run(&mesh, &dofs), Err(FemError::Inverted { tag: 1, .. })));
    assert!(matches!(run(&good, &DofMap::new(7, &[])), Err(FemError::Shape { .. })));
}

/// Nothing in, nothing out, and no panic on the way.
#[test]
fn an_empty_mesh_gives_empty_matrices() {
    let dofs = DofMap::new(0, &[]);
    let system = assemble(&mesh::Mesh::default(), &STEEL, &dofs, &ElementOptions::default()).unwrap();
    assert_eq!((system.stiffness.n(), system.mass.n()), (0, 0));
    let factor = fem::BoundaryLastFactor::new(&system.stiffness, &[]).unwrap();
    assert_eq!((factor.n(), factor.nonzeros()), (0, 0));
    assert_eq!(fem::IndefiniteFactor::new(&system.stiffness, &[]).unwrap().n(), 0);
    assert_eq!(mass_properties(&mesh::Mesh::default(), &STEEL).unwrap().mass_t, 0.0);
}
