//! One factor, many answers: each judged by dense algebra.

use crate::common::{nodes_where, on_threads, shaken};
use faer::{Mat, MatRef, linalg::solvers::Solve};
use fem::{
    BoundaryLastFactor, DofMap, ElementOptions, FemError, IndefiniteFactor, Material, SymmetricMatrix,
    assemble_stiffness,
};
use mesh::{ElementKind, Mesh};

/// A clamped block and the rows of some of its nodes, in no particular order.
fn clamped(kind: ElementKind, cells: [usize; 3]) -> (Mesh, DofMap, SymmetricMatrix) {
    let mesh = Mesh::block(kind, cells, shaken(0.15));
    let fixed = nodes_where(&mesh, |x| x[0] < 0.3);
    let dofs = DofMap::new(mesh.nodes.len(), &fixed);
    let k = assemble_stiffness(&mesh, &Material::STEEL, &dofs, &ElementOptions::default()).unwrap();
    (mesh, dofs, k)
}

fn top_rows(mesh: &Mesh, dofs: &DofMap, height: f64) -> Vec<usize> {
    let nodes = nodes_where(mesh, |x| x[2] > height);
    let rows = nodes.iter().rev().flat_map(|&n| [2, 0, 1].map(|a| dofs.dof(n, a)));
    rows.flatten().collect()
}

fn difference(a: MatRef<'_, f64>, b: MatRef<'_, f64>) -> f64 {
    assert_eq!((a.nrows(), a.ncols()), (b.nrows(), b.ncols()));
    let scale = b.norm_max();
    (a - b).norm_max() / scale
}

fn wavy(rows: usize, columns: usize) -> Mat<f64> {
    Mat::from_fn(rows, columns, |i, j| (1.0 + 0.37 * i as f64 + 1.3 * j as f64 * (i as f64).sqrt()).sin())
}

/// (K^, Phi) by dense algebra.
fn dense_condensation(k: &SymmetricMatrix, boundary: &[usize]) -> (Mat<f64>, Mat<f64>, Vec<usize>) {
    let dense = k.to_dense();
    let interior: Vec<usize> = (0..k.n()).filter(|i| !boundary.contains(i)).collect();
    let part = |r: &[usize], c: &[usize]| Mat::from_fn(r.len(), c.len(), |i, j| dense[(r[i], c[j])]);
    let phi = -part(&interior, &interior).partial_piv_lu().solve(part(&interior, boundary));
    let condensed = part(boundary, boundary) + part(boundary, &interior) * &phi;
    (condensed, phi, interior)
}

#[test]
fn condensed_stiffness_compliance_and_modes_agree_with_dense_algebra() {
    for kind in [ElementKind::Hex8, ElementKind::Tet10] {
        let (mesh, dofs, k) = clamped(kind, [4, 3, 3]);
        let boundary = top_rows(&mesh, &dofs, 2.7);
        assert!(boundary.len() > 20);
        let (condensed, phi, interior) = dense_condensation(&k, &boundary);
        let factor = BoundaryLastFactor::new(&k, &boundary).unwrap();
        assert_eq!(factor.boundary(), boundary);
        assert!(difference(factor.condensed_stiffness().as_ref(), condensed.as_ref()) < 1e-10);
        let inverse = condensed.partial_piv_lu().solve(Mat::<f64>::identity(boundary.len(), boundary.len()));
        assert!(difference(factor.compliance().as_ref(), inverse.as_ref()) < 1e-10);

        let unit = Mat::<f64>::identity(boundary.len(), boundary.len());
        let modes = factor.expand(unit.as_ref()).unwrap();
        for (j, &row) in boundary.iter().enumerate() {
            assert_eq!(modes[(row, j)], 1.0);
        }
        let found = Mat::from_fn(interior.len(), boundary.len(), |i, j| modes[(interior[i], j)]);
        assert!(difference(found.as_ref(), phi.as_ref()) < 1e-10);
    }
}

/// With the boundary held where it is, the interior carries the forces on it, and forces on the boundary have no
/// effect.
#[test]
fn a_held_boundary_leaves_the_interior_its_forces() {
    let (mesh, dofs, k) = clamped(ElementKind::Hex8, [5, 4, 4]);
    let boundary = top_rows(&mesh, &dofs, 3.7);
    let factor = BoundaryLastFactor::new(&k, &boundary).unwrap();
    let (force, held) = (wavy(k.n(), 70), wavy(boundary.len(), 70));
    let u = factor.solve_held(force.as_ref(), held.as_ref()).unwrap();
    let found = k.multiply(u.as_ref()).unwrap();
    for j in 0..force.ncols() {
        for (b, &row) in boundary.iter().enumerate() {
            assert_eq!(u[(row, j)], held[(b, j)], "row {row}");
        }
        for row in (0..k.n()).filter(|row| !boundary.contains(row)) {
            let off = (found[(row, j)] - force[(row, j)]).abs();
            assert!(off < 1e-10 * found.norm_max(), "row {row}, column {j}: {off:e} N");
        }
    }
    assert!(matches!(factor.solve_held(force.as_ref(), wavy(3, 70).as_ref()), Err(FemError::Shape { .. })));
}

/// A factor that is made of its parts again has the same bits; parts that do not fit together make none.
#[test]
fn a_factor_comes_back_from_its_parts() {
    let (mesh, dofs, k) = clamped(ElementKind::Hex20, [5, 4, 4]);
    let boundary = top_rows(&mesh, &dofs, 3.7);
    let factor = BoundaryLastFactor::new(&k, &boundary).unwrap();
    let kept = factor.to_kept().unwrap();
    assert_eq!(kept.values.len(), factor.nonzeros());
    let again = BoundaryLastFactor::from_kept(&kept).unwrap();
    assert_eq!((again.n(), again.boundary(), again.to_kept()), (factor.n(), factor.boundary(), Some(kept.clone())));
    let (force, held) = (wavy(k.n(), 3), wavy(boundary.len(), 3));
    let solve = |f: &BoundaryLastFactor| f.solve_held(force.as_ref(), held.as_ref()).unwrap();
    assert!(solve(&factor) == solve(&again) && factor.boundary_factor() == again.boundary_factor());
    let mut wrong = [kept.clone(), kept.clone(), kept.clone(), kept.clone(), kept.clone(), kept];
    wrong[0].values.pop();
    wrong[1].order[1] = wrong[1].order[0];
    wrong[2].widths[0] += 1;
    wrong[3].rows[0].reverse();
    wrong[4].interior = u32::MAX;
    wrong[5].rows.pop();
    assert!(wrong.iter().all(|kept| BoundaryLastFactor::from_kept(kept).is_none()));
}

/// Dense kernels against the plain products, over more than one block of columns.
#[test]
fn dense_kernels_agree_with_plain_products() {
    use fem::dense;
    let (z, b) = (wavy(130, 110), wavy(110, 200));
    let gram = dense::gram(z.as_ref());
    assert!(difference(gram.as_ref(), (z.transpose() * &z).as_ref()) < 1e-14);
    let positive = &gram + Mat::<f64>::identity(110, 110);
    let l = dense::cholesky(positive.as_ref()).unwrap();
    assert!(difference(dense::times_transpose(l.as_ref()).as_ref(), positive.as_ref()) < 1e-13);
    let mut x = b.clone();
    dense::solve_lower(l.as_ref(), x.as_mut());
    dense::solve_lower_transposed(l.as_ref(), x.as_mut());
    assert!(difference(dense::product(positive.as_ref(), x.as_ref()).as_ref(), b.as_ref()) < 1e-11);
    let inverse = dense::inverse_of_product(l.as_ref());
    assert!(difference((&inverse * &b).as_ref(), x.as_ref()) < 1e-10);
    assert!(matches!(dense::cholesky((-positive).as_ref()), Err(FemError::NotPositiveDefinite { .. })));
}

#[test]
fn expanded_displacements_leave_the_interior_without_load() {
    let (mesh, dofs, k) = clamped(ElementKind::Hex20, [5, 4, 4]);
    let boundary = top_rows(&mesh, &dofs, 3.7);
    let factor = BoundaryLastFactor::new(&k, &boundary).unwrap();
    let given = wavy(boundary.len(), 70); // more than one block of columns
    let u = factor.expand(given.as_ref()).unwrap();
    let force = k.multiply(u.as_ref()).unwrap();
    let scale = force.norm_max();
    for j in 0..given.ncols() {
        for i in (0..k.n()).filter(|i| !boundary.contains(i)) {
            assert!(force[(i, j)].abs() < 1e-10 * scale, "{:e} N of {scale:e} N", force[(i, j)]);
        }
    }
    // and the boundary feels the condensed stiffness
    let wanted = factor.condensed_stiffness() * &given;
    let found = Mat::from_fn(boundary.len(), given.ncols(), |i, j| force[(boundary[i], j)]);
    assert!(difference(found.as_ref(), wanted.as_ref()) < 1e-10);
}

#[test]
fn condensing_forces_is_the_adjoint_of_expanding_displacements() {
    let (mesh, dofs, k) = clamped(ElementKind::Wedge15, [4, 3, 2]);
    let boundary = top_rows(&mesh, &dofs, 1.7);
    let factor = BoundaryLastFactor::new(&k, &boundary).unwrap();
    let (u, f) = (wavy(boundary.len(), 3), wavy(k.n(), 3));
    let work = factor.expand(u.as_ref()).unwrap().transpose() * &f;
    let same = u.transpose() * factor.condense(f.as_ref()).unwrap();
    assert!(difference(same.as_ref(), work.as_ref()) < 1e-11);
    // a load on everything moves the boundary as the condensed load does
    let mut x = f.clone();
    factor.solve(x.as_mut()).unwrap();
    let moved = factor.compliance() * factor.condense(f.as_ref()).unwrap();
    let found = Mat::from_fn(boundary.len(), 3, |i, j| x[(boundary[i], j)]);
    assert!(difference(found.as_ref(), moved.as_ref()) < 1e-10);
}

#[test]
fn solve_inverts_the_matrix_with_and_without_a_boundary() {
    let (mesh, dofs, k) = clamped(ElementKind::Hex8, [6, 5, 4]);
    let rows = top_rows(&mesh, &dofs, 3.7);
    let everything: Vec<usize> = (0..k.n()).rev().collect();
    for boundary in [&[][..], &rows, &everything] {
        let factor = BoundaryLastFactor::new(&k, boundary).unwrap();
        let b = wavy(k.n(), 65);
        let mut x = b.clone();
        factor.solve(x.as_mut()).unwrap();
        let back = k.multiply(x.as_ref()).unwrap();
        assert!(difference(back.as_ref(), b.as_ref()) < 1e-11);
        assert_eq!(factor.condensed_stiffness().nrows(), boundary.len());
    }
}

/// A permutation applied the wrong way round is legal and gives catastrophic fill; this guards its direction.
#[test]
fn nested_dissection_saves_fill() {
    let (_, _, k) = clamped(ElementKind::Hex8, [14, 14, 14]);
    let n = k.n();
    // natural order: everything is boundary, in its own order; its fill is that of a band
    let natural = {
        let mut first = vec![usize::MAX; n]; // leftmost entry of each row
        for (row, column, _) in k.entries() {
            first[row] = first[row].min(column);
        }
        (0..n).map(|row| row - first[row] + 1).sum::<usize>()
    };
    let dissected = BoundaryLastFactor::new(&k, &[]).unwrap();
    let ratio = dissected.nonzeros() as f64 / natural as f64;
    assert!(ratio < 0.6, "{} of {natural} entries", dissected.nonzeros());
    assert!(dissected.flops() > 0.0);
}

#[test]
fn one_thread_or_two_the_same_bits() {
    let (mesh, dofs, k) = clamped(ElementKind::Hex8, [9, 8, 8]);
    let boundary = top_rows(&mesh, &dofs, 7.6);
    let run = || {
        let factor = BoundaryLastFactor::new(&k, &boundary).unwrap();
        let u = factor.expand(wavy(boundary.len(), 200).as_ref()).unwrap();
        let mut x = wavy(k.n(), 130);
        factor.solve(x.as_mut()).unwrap();
        let f = factor.condense(x.as_ref()).unwrap();
        [factor.condensed_stiffness(), factor.compliance(), u, x, f]
    };
    let (one, two, many) = (on_threads(1, run), on_threads(2, run), on_threads(4, run));
    assert!(one == two && one == many);
    let (left, right) = rayon::join(run, run); // pinion and wheel side by side
    assert!(left == right && left == one);
}

#[test]
fn a_body_that_can_move_is_refused() {
    let mesh = Mesh::block(ElementKind::Hex8, [4, 4, 4], shaken(0.1));
    let run = |fixed: &[u32], boundary: &[usize]| {
        let dofs = DofMap::new(mesh.nodes.len(), fixed);
        let k = assemble_stiffness(&mesh, &Material::STEEL, &dofs, &ElementOptions::default()).unwrap();
        BoundaryLastFactor::new(&k, boundary).map(|_| ())
    };
    // free, and free to turn about one point or one axis
    for fixed in [&[][..], &[0], &[0, 1]] {
        match run(fixed, &[]) {
            Err(error @ FemError::NotPositiveDefinite { .. }) => {
                assert!(error.hint().unwrap().contains("bore"));
            }
            other => panic!("{fixed:?}: {other:?}"),
        }
    }
    let clamped = nodes_where(&mesh, |x| x[0] < 0.3);
    assert_eq!(run(&clamped, &[]), Ok(()));
    assert!(matches!(run(&clamped, &[3, 3]), Err(FemError::BadDof { dof: 3, .. })));
    assert!(matches!(run(&clamped, &[9999]), Err(FemError::BadDof { dof: 9999, .. })));
}

/// The message names the degree of freedom that breaks down, in the matrix's own numbering.
#[test]
fn the_loose_degree_of_freedom_is_named() {
    for n in [3, 40, 300] {
        for loose in [0, 1, n / 2, n - 1] {
            // a chain of springs to ground; one entry has lost its ground and its sign
            let triplets: Vec<_> = (0..n)
                .map(|i| (i, i, if i == loose { -1.0 } else { 4.0 }))
                .chain((1..n).map(|i| (i, i - 1, 0.1)))
                .collect();
            let k = SymmetricMatrix::from_triplets(n, &triplets).unwrap();
            let backwards: Vec<usize> = (0..n).rev().collect();
            for boundary in [&[][..], &backwards] {
                match BoundaryLastFactor::new(&k, boundary) {
                    Err(FemError::NotPositiveDefinite { dof, .. }) => assert_eq!(dof, loose),
                    other => panic!("{other:?}"),
                }
            }
        }
    }
}

#[test]
fn wrong_sizes_are_refused() {
    let (_, _, k) = clamped(ElementKind::Hex8, [2, 2, 2]);
    let factor = BoundaryLastFactor::new(&k, &[0, 1]).unwrap();
    let wrong = Mat::<f64>::zeros(k.n() + 1, 1);
    assert!(matches!(factor.expand(wrong.as_ref()), Err(FemError::Shape { expected: 2, .. })));
    assert!(matches!(factor.condense(wrong.as_ref()), Err(FemError::Shape { .. })));
    assert!(matches!(factor.solve(wrong.clone().as_mut()), Err(FemError::Shape { .. })));
}

/// Stiffness with constraints that tie the motions of node pairs, one free coordinate and a slack.
fn saddle_point(k: &SymmetricMatrix, ties: usize) -> (SymmetricMatrix, Vec<usize>) {
    let n = k.n();
    let mut triplets: Vec<_> = k.entries().collect();
    for t in 0..ties {
        triplets.push((n + t, 7 * t % n, 1.0));
        triplets.push((n + t, (7 * t + n / 2) % n, -0.8));
        triplets.push((n + t, n + ties, 0.3 + t as f64)); // mirrored: the free coordinate comes later
        triplets.push((n + t, n + t, if t % 2 == 0 { 0.0 } else { -1e-6 }));
    }
    triplets.push((n + ties, n + ties, 0.0));
    let size = n + ties + 1;
    (SymmetricMatrix::from_triplets(size, &triplets).unwrap(), (n..size).collect())
}

#[test]
fn a_saddle_point_is_solved_as_dense_algebra_does() {
    let (_, _, k) = clamped(ElementKind::Hex8, [4, 4, 3]);
    let (a, last) = saddle_point(&k, 12);
    let factor = IndefiniteFactor::new(&a, &last).unwrap();
    let b = wavy(a.n(), 67);
    let mut x = b.clone();
    factor.solve(x.as_mut()).unwrap();
    let wanted = a.to_dense().partial_piv_lu().solve(&b);
    assert!(difference(x.as_ref(), wanted.as_ref()) < 1e-10);
    let back = a.multiply(x.as_ref()).unwrap();
    assert!(difference(back.as_ref(), b.as_ref()) < 1e-9);
}

#[test]
fn a_constraint_given_twice_is_refused() {
    let a = SymmetricMatrix::from_triplets(
        4,
        &[(0, 0, 2.0), (1, 1, 2.0), (2, 0, 1.0), (2, 1, 1.0), (3, 0, 1.0), (3, 1, 1.0)],
    )
    .unwrap();
    assert!(matches!(IndefiniteFactor::new(&a, &[2, 3]), Err(FemError::Singular { .. })));
}

/// Passing over branches of the factor changes nothing where the answer is asked for, and not a bit of it.
#[test]
fn answers_near_some_freedoms_are_those_of_the_whole() {
    let (mesh, dofs, k) = clamped(ElementKind::Hex8, [14, 5, 4]);
    let boundary = top_rows(&mesh, &dofs, 3.7);
    let factor = BoundaryLastFactor::new(&k, &boundary).unwrap();
    let wanted: Vec<usize> =
        nodes_where(&mesh, |x| x[0] > 12.7 && x[2] < 0.3).iter().filter_map(|&n| dofs.dof(n, 1)).collect();
    assert!(wanted.len() > 5);
    let given = wavy(boundary.len(), 70);
    let (all, near) = (factor.expand(given.as_ref()).unwrap(), factor.expand_rows(given.as_ref(), &wanted).unwrap());
    // A load in one place: most supernodes meet zeros only.
    let mut force = Mat::<f64>::zeros(k.n(), 3);
    (0..3).for_each(|j| force[(7 * j + 1, j)] = 1.0);
    let solved_near = factor.solve_rows(force.as_ref(), &wanted).unwrap();
    let few: Vec<Vec<(usize, f64)>> = (0..3).map(|j| vec![(7 * j + 1, 1.0)]).collect();
    let solved_few = factor.solve_few(&few, &wanted).unwrap();
    factor.solve(force.as_mut()).unwrap();
    assert_eq!((near.nrows(), solved_near.nrows()), (wanted.len(), wanted.len()));
    for (i, &dof) in wanted.iter().enumerate() {
        assert!((0..70).all(|j| all[(dof, j)] == near[(i, j)]), "row {dof} of the expansion");
        assert!((0..3).all(|j| force[(dof, j)] == solved_near[(i, j)]), "row {dof} of the solution");
        assert!((0..3).all(|j| force[(dof, j)] == solved_few[(i, j)]), "row {dof} of the solution for few forces");
    }
    assert!(matches!(factor.expand_rows(given.as_ref(), &[k.n()]), Err(FemError::BadDof { .. })));
    assert!(matches!(factor.solve_rows(given.as_ref(), &wanted), Err(FemError::Shape { .. })));
    assert!(matches!(factor.solve_few(&[vec![(k.n(), 1.0)]], &wanted), Err(FemError::BadDof { .. })));
}
