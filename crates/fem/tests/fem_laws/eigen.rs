//! Eigenvalues and eigenvectors of matrices that are not symmetric.

use faer::{Mat, c64};
use fem::{FemError, dense::general_eigen};

/// A v = lambda v for every pair, complex ones in conjugate pairs: a turn (two conjugate values), a defective-free block
/// with real values, and couplings between them.
#[test]
fn every_vector_is_stretched_by_its_value() {
    let a = Mat::from_fn(5, 5, |i, j| match (i, j) {
        (0, 1) => -3.0,
        (1, 0) => 3.0,
        (0, 0) | (1, 1) => 0.5,
        _ if i == j => 1.0 + i as f64,
        _ if j > i => 0.3 * (i + j) as f64,
        _ => 0.0,
    });
    let (values, vectors) = general_eigen(a.as_ref()).unwrap();
    let mut complex = 0;
    for (k, value) in values.iter().enumerate() {
        let mut length = 0.0;
        for i in 0..5 {
            let product = (0..5).fold(c64::new(0.0, 0.0), |sum, j| sum + vectors[(j, k)] * a[(i, j)]);
            let off = (product - vectors[(i, k)] * *value).norm();
            assert!(off < 1e-12, "value {k} = {value}: row {i} off by {off:.1e}");
            length += vectors[(i, k)].norm_sqr();
        }
        assert!((length - 1.0).abs() < 1e-12, "{length}");
        complex += usize::from(value.im != 0.0);
    }
    assert_eq!(complex, 2, "{values:?}");
    let turn = values.iter().find(|v| v.im > 0.0).unwrap();
    assert!((turn.re - 0.5).abs() < 1e-12 && (turn.im - 3.0).abs() < 1e-12, "{turn}");
}

#[test]
fn matrices_without_eigenvalues_are_refused() {
    assert!(matches!(general_eigen(Mat::zeros(2, 3).as_ref()), Err(FemError::Shape { expected: 2, found: 3, .. })));
    let nan = Mat::from_fn(2, 2, |i, _| if i == 1 { f64::NAN } else { 0.0 });
    assert!(matches!(general_eigen(nan.as_ref()), Err(FemError::NotFinite { row: 1, column: 0 })));
    assert!(general_eigen(Mat::zeros(0, 0).as_ref()).unwrap().0.is_empty());
}
