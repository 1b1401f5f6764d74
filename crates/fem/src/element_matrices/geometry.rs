//! From reference to physical coordinates: tables of shape functions, Jacobians, gradients.

use mesh::{
    ElementKind,
    element::{QuadraturePoint, QuadratureRule},
};

use crate::FemError;

/// Shape functions and their reference gradients at a list of points.
pub(crate) struct Table {
    pub points: Vec<TablePoint>,
}

/// One point of a [`Table`].
pub(crate) struct TablePoint {
    pub xi: [f64; 3],
    pub weight: f64,
    pub n: Vec<f64>,
    pub dn: Vec<[f64; 3]>,
}

impl Table {
    pub(crate) fn new(kind: ElementKind, rule: QuadratureRule) -> Self {
        Self::at(kind, kind.quadrature(rule))
    }

    pub(crate) fn at(kind: ElementKind, points: &[QuadraturePoint]) -> Self {
        let points = points.iter().map(|q| {
            let (mut n, mut dn) = (vec![0.0; kind.node_count()], vec![[0.0; 3]; kind.node_count()]);
            kind.shape(q.xi, &mut n);
            kind.shape_gradient(q.xi, &mut dn);
            TablePoint { xi: q.xi, weight: q.weight, n, dn }
        });
        Self { points: points.collect() }
    }
}

/// Inverse of the Jacobian dx/dxi, and its determinant (mm^3); `inverse[k][a]` = dxi_k / dx_a.
///
/// # Errors
/// [`FemError::Inverted`] when the determinant is not above zero.
pub(crate) fn checked_jacobian(
    kind: ElementKind,
    tag: u64,
    coordinates: &[[f64; 3]],
    dn: &[[f64; 3]],
) -> Result<([[f64; 3]; 3], f64), FemError> {
    let mut j = [[0.0; 3]; 3]; // j[a][k] = dx_a / dxi_k
    for (x, d) in coordinates.iter().zip(dn) {
        for a in 0..3 {
            for k in 0..3 {
                j[a][k] += x[a] * d[k];
            }
        }
    }
    let cofactor = |a: usize, k: usize| {
        let (b, c, l, m) = ((a + 1) % 3, (a + 2) % 3, (k + 1) % 3, (k + 2) % 3);
        j[b][l] * j[c][m] - j[b][m] * j[c][l]
    };
    let det = (0..3).map(|k| j[0][k] * cofactor(0, k)).sum::<f64>();
    // NaN coordinates must fail too
    if !(det > 0.0 && det.is_finite()) {
        return Err(FemError::Inverted { kind: kind.name(), tag, det_j_mm3: det });
    }
    let mut inverse = [[0.0; 3]; 3];
    for (k, row) in inverse.iter_mut().enumerate() {
        for (a, entry) in row.iter_mut().enumerate() {
            *entry = cofactor(a, k) / det;
        }
    }
    Ok((inverse, det))
}

/// Gradients in true coordinates (1/mm) from reference gradients: g = J^-T dN/dxi.
pub(crate) fn gradients(inverse: &[[f64; 3]; 3], dn: &[[f64; 3]], g: &mut [[f64; 3]]) {
    for (g, d) in g.iter_mut().zip(dn) {
        *g = [0, 1, 2].map(|a| d[0] * inverse[0][a] + d[1] * inverse[1][a] + d[2] * inverse[2][a]);
    }
}
