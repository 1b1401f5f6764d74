//! A factor in pieces has the answers of one factor.

use crate::common::{nodes_where, on_threads, shaken};
use faer::{Mat, MatMut, MatRef};
use fem::{
    BoundaryLastFactor, DofMap, ElementOptions, FemError, Material, PartedFactor, SymmetricMatrix, assemble_stiffness,
};
use mesh::{ElementKind, Mesh};

/// A long block that is clamped at one end: by themselves most of its pieces may move freely. With the rows of some nodes,
/// in no particular order.
fn beam(kind: ElementKind, cells: [usize; 3], clamped: bool) -> (SymmetricMatrix, Vec<usize>) {
    let mesh = Mesh::block(kind, cells, shaken(0.15));
    let fixed = if clamped { nodes_where(&mesh, |x| x[0] < 0.3) } else { Vec::new() };
    let dofs = DofMap::new(mesh.nodes.len(), &fixed);
    let k = assemble_stiffness(&mesh, &Material::STEEL, &dofs, &ElementOptions::default()).unwrap();
    let nodes = nodes_where(&mesh, |x| x[0] > 2.7 && x[0] < 5.3 && x[2] > cells[2] as f64 - 0.3);
    let rows = nodes.iter().rev().flat_map(|&n| [2, 0, 1].map(|a| dofs.dof(n, a)));
    (k, rows.flatten().collect())
}

/// Largest entry of a - b against the largest of b; of nothing, or of zeros, none.
fn difference(a: MatRef<'_, f64>, b: MatRef<'_, f64>) -> f64 {
    assert_eq!((a.nrows(), a.ncols()), (b.nrows(), b.ncols()));
    let apart = (a - b).norm_max();
    if apart == 0.0 { 0.0 } else { apart / b.norm_max() }
}

/// What x leaves of forces b, as the part of the stiffness that would have to be another one:
/// |b - K x| / (|K| |x| + |b|) by largest entries and row sums, the largest of all columns.
fn backward_error(k: &SymmetricMatrix, x: &Mat<f64>, b: &Mat<f64>) -> f64 {
    let mut sums = vec![0.0; k.n()];
    for (row, column, value) in k.entries() {
        sums[row] += value.abs();
        if row != column {
            sums[column] += value.abs();
        }
    }
    let largest = sums.into_iter().fold(0.0, f64::max);
    let left = b - k.multiply(x.as_ref()).unwrap();
    let of = |m: &Mat<f64>, column: usize| m.col(column).norm_max();
    (0..b.ncols()).map(|j| of(&left, j) / (largest * of(x, j) + of(b, j))).fold(0.0, f64::max)
}

fn wavy(rows: usize, columns: usize) -> Mat<f64> {
    Mat::from_fn(rows, columns, |i, j| (1.0 + 0.37 * i as f64 + 1.3 * j as f64 * (i as f64).sqrt()).sin())
}

/// Some rows all over the body, those of the boundary among them.
fn wanted(n: usize, boundary: &[usize]) -> Vec<usize> {
    (0..n).step_by(97).chain(boundary.iter().copied().step_by(3)).rev().collect()
}

/// A few forces at either end, and two on the boundary.
fn few(n: usize, boundary: &[usize]) -> Vec<Vec<(usize, f64)>> {
    let ends = [vec![(1, 1.0), (n - 2, -2.0)], vec![(n - 3, 0.5)], vec![(n / 2, 3.0), (5, 1.0)]];
    ends.into_iter().chain(boundary.iter().take(2).map(|&row| vec![(row, 1.0)])).collect()
}

/// Everything that a factor can be asked for, in pieces or in one.
macro_rules! answers {
    ($factor:expr) => {{
        let factor = $factor;
        let (n, boundary) = (factor.n(), factor.boundary());
        let (wanted, given) = (wanted(n, boundary), wavy(boundary.len(), 70));
        let mut x = wavy(n, 130);
        factor.solve(x.as_mut()).unwrap();
        [
            factor.compliance(),
            factor.expand(given.as_ref()).unwrap(),
            factor.condense(wavy(n, 70).as_ref()).unwrap(),
            x,
            factor.solve_rows(wavy(n, 3).as_ref(), &wanted).unwrap(),
            factor.expand_rows(given.as_ref(), &wanted).unwrap(),
            factor.solve_few(&few(n, boundary), &wanted).unwrap(),
        ]
    }};
}

/// The beam makes 10^4 of each unit of round-off in the matrix: 3e-12 is what both are from the exact answers.
#[test]
fn pieces_have_the_answers_of_the_whole() {
    for (kind, cells) in [(ElementKind::Hex8, [40, 4, 3]), (ElementKind::Hex20, [12, 3, 3])] {
        let (k, boundary) = beam(kind, cells, true);
        assert!(boundary.len() > 20);
        for boundary in [&boundary[..], &[]] {
            let whole = answers!(BoundaryLastFactor::new(&k, boundary).unwrap());
            for times in [0, 1, 2, 3] {
                let parted = PartedFactor::halved(k.clone(), boundary, times, &|| true).unwrap();
                assert_eq!((parted.n(), parted.boundary()), (k.n(), boundary));
                for (i, (own, whole)) in answers!(&parted).iter().zip(&whole).enumerate() {
                    let apart = difference(own.as_ref(), whole.as_ref());
                    assert!(apart < 1e-11, "{kind:?}, halved {times} times, answer {i}: {apart:e}");
                }
            }
        }
    }
}

/// Parting a body costs no digits. Pieces that were held by springs, as stiff as the row sums of what is cut, and not by
/// the body about them were 2e-15 off.
#[test]
fn pieces_leave_no_more_of_the_forces_than_the_whole() {
    for (kind, cells) in [(ElementKind::Hex8, [40, 4, 3]), (ElementKind::Hex20, [12, 3, 3])] {
        let (k, boundary) = beam(kind, cells, true);
        let forces = wavy(k.n(), 10);
        let off = |solve: &dyn Fn(MatMut<'_, f64>) -> Result<(), FemError>| {
            let mut x = forces.clone();
            solve(x.as_mut()).unwrap();
            backward_error(&k, &x, &forces)
        };
        for boundary in [&boundary[..], &[]] {
            let whole = BoundaryLastFactor::new(&k, boundary).unwrap();
            let of_whole = off(&|x| whole.solve(x));
            assert!(of_whole < 4.0 * f64::EPSILON, "{kind:?}: {of_whole:e}");
            for times in [1, 2, 3, 4] {
                let parted = PartedFactor::halved(k.clone(), boundary, times, &|| true).unwrap();
                let of_pieces = off(&|x| parted.solve(x));
                assert!(of_pieces < 4.0 * f64::EPSILON, "{kind:?}, halved {times} times: {of_pieces:e}");
            }
        }
    }
}

/// No bit depends on the number of threads, nor on what was asked before: pieces go and are made again.
#[test]
fn pieces_have_the_same_bits_for_any_threads_and_any_history() {
    let (k, boundary) = beam(ElementKind::Hex8, [40, 4, 3], true);
    let factor = || PartedFactor::halved(k.clone(), &boundary, 3, &|| true).unwrap();
    let (n, forces) = (k.n(), few(k.n(), &boundary));
    let whole = |factor: &PartedFactor| {
        let mut x = wavy(n, 130);
        factor.solve(x.as_mut()).unwrap();
        x
    };
    let near = |factor: &PartedFactor, from: usize| {
        let rows: Vec<usize> = (from..from + n / 10).collect();
        factor.solve_few(&forces, &rows).unwrap()
    };
    let starts: Vec<usize> = (0..9).map(|i| i * n / 10).collect();
    let first = starts.iter().map(|&from| near(&factor(), from)).collect::<Vec<_>>();
    let forth = on_threads(1, || {
        let factor = factor();
        let parts: Vec<_> = starts.iter().map(|&from| near(&factor, from)).collect();
        (parts, whole(&factor))
    });
    let back = on_threads(4, || {
        let factor = factor();
        let all = whole(&factor);
        let mut parts: Vec<_> = starts.iter().rev().map(|&from| near(&factor, from)).collect();
        parts.reverse();
        (parts, all)
    });
    assert!(first == forth.0 && forth == back);
}

/// A body that can move is refused, and the loose row is named, be it in a piece or between two.
#[test]
fn a_loose_body_is_refused_in_pieces() {
    let (k, boundary) = beam(ElementKind::Hex8, [40, 4, 3], false);
    for boundary in [&boundary[..], &[]] {
        let found = PartedFactor::halved(k.clone(), boundary, 2, &|| true).map(|_| ());
        assert!(matches!(found, Err(FemError::NotPositiveDefinite { .. })), "{found:?}");
    }
    let n = 400;
    for loose in (0..n).step_by(7) {
        let diagonal = (0..n).map(|i| (i, i, if i == loose { -1.0 } else { 4.0 }));
        let k = SymmetricMatrix::from_triplets(n, &diagonal.chain((1..n).map(|i| (i, i - 1, 0.1))).collect::<Vec<_>>());
        match PartedFactor::halved(k.unwrap(), &[3, 200], 2, &|| true) {
            Err(FemError::NotPositiveDefinite { dof, .. }) => assert_eq!(dof, loose),
            other => panic!("{other:?}"),
        }
    }
}

#[test]
fn rows_that_do_not_exist_and_loss_of_interest_are_told() {
    let (k, boundary) = beam(ElementKind::Hex8, [12, 3, 3], true);
    let n = k.n();
    let factor = PartedFactor::halved(k.clone(), &boundary, 1, &|| true).unwrap();
    assert!(matches!(factor.solve_few(&[vec![(n, 1.0)]], &[0]), Err(FemError::BadDof { .. })));
    assert!(matches!(factor.solve_few(&[vec![(0, 1.0)]], &[n]), Err(FemError::BadDof { .. })));
    assert!(matches!(factor.expand_rows(wavy(boundary.len(), 1).as_ref(), &[n]), Err(FemError::BadDof { .. })));
    assert!(matches!(factor.solve_rows(wavy(n + 1, 1).as_ref(), &[0]), Err(FemError::Shape { .. })));
    assert!(matches!(factor.expand(wavy(1, 1).as_ref()), Err(FemError::Shape { .. })));
    assert!(matches!(PartedFactor::halved(k, &boundary, 1, &|| false).map(|_| ()), Err(FemError::Unwanted)));
}
