//! Integration points and weights on the reference elements.
//!
//! | kind    | stiffness   | reduced | mass                           |
//! |---------|-------------|---------|--------------------------------|
//! | hex8    | Gauss 2^3   | -       | Gauss 3^3                      |
//! | hex20   | Gauss 3^3   | 2^3     | Gauss 4^3                      |
//! | hex27   | Gauss 3^3   | -       | Gauss 4^3                      |
//! | tet4    | 1 point     | -       | 4 points, exact for quadratics |
//! | tet10   | 4 points    | -       | 15 points, exact to degree 5   |
//! | wedge6  | 3 x Gauss 2 | -       | 7 x Gauss 3                    |
//! | wedge15 | 3 x Gauss 3 | -       | 7 x Gauss 4                    |
//!
//! Mass rules are exact for straight-sided elements. Source: Stroud, Approximate Calculation of
//! Multiple Integrals, 1971, rules T2:2-1, T2:5-1, T3:2-1, T3:5-1.

use std::sync::LazyLock;

use super::{
    ElementKind::{self, Hex8, Hex20, Hex27, Tet4, Tet10, Wedge6, Wedge15},
    FaceKind::{self, Quad4, Quad8, Quad9, Tri3, Tri6},
    gauss::line,
};

/// An integration point of a volume element.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct QuadraturePoint {
    /// Reference coordinates.
    pub xi: [f64; 3],
    /// Weight; the weights add up to the volume of the reference element.
    pub weight: f64,
}

/// An integration point of a face.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FaceQuadraturePoint {
    /// Reference coordinates.
    pub xi: [f64; 2],
    /// Weight; the weights add up to the area of the reference face.
    pub weight: f64,
}

/// The integral that a rule is made for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum QuadratureRule {
    /// Stiffness with full integration: the only zero modes are the rigid-body modes.
    Stiffness,
    /// Stiffness with reduced integration where that gives a known good element (hex20 with 2^3 points, the C3D20R of
    /// other programs); full integration for every other kind.
    Reduced,
    /// Consistent mass matrix.
    Mass,
}

impl ElementKind {
    /// Points and weights for an integral over this element.
    pub fn quadrature(self, rule: QuadratureRule) -> &'static [QuadraturePoint] {
        use QuadratureRule::{Mass, Reduced, Stiffness};
        match (self, rule) {
            (Hex20, Reduced) | (Hex8, Stiffness | Reduced) => &GAUSS_2,
            (Hex20, Stiffness) | (Hex27, Stiffness | Reduced) | (Hex8, Mass) => &GAUSS_3,
            (Hex20 | Hex27, Mass) => &GAUSS_4,
            (Tet4, Stiffness | Reduced) => &TET_1,
            (Tet4, Mass) | (Tet10, Stiffness | Reduced) => &TET_4,
            (Tet10, Mass) => &TET_15,
            (Wedge6, Stiffness | Reduced) => &WEDGE_3_2,
            (Wedge6, Mass) => &WEDGE_7_3,
            (Wedge15, Stiffness | Reduced) => &WEDGE_3_3,
            (Wedge15, Mass) => &WEDGE_7_4,
        }
    }
}

impl FaceKind {
    /// Points and weights for an integral of products of two shape functions over this face.
    pub fn quadrature(self) -> &'static [FaceQuadraturePoint] {
        match self {
            Tri3 => &TRI_3,
            Tri6 => &TRI_7,
            Quad4 => &QUAD_2,
            Quad8 | Quad9 => &QUAD_3,
        }
    }
}

static GAUSS_2: LazyLock<Vec<QuadraturePoint>> = LazyLock::new(|| cube(&line(2)));
static GAUSS_3: LazyLock<Vec<QuadraturePoint>> = LazyLock::new(|| cube(&line(3)));
static GAUSS_4: LazyLock<Vec<QuadraturePoint>> = LazyLock::new(|| cube(&line(4)));
static TET_1: [QuadraturePoint; 1] = [QuadraturePoint { xi: [0.25; 3], weight: 1.0 / 6.0 }];
static TET_4: LazyLock<Vec<QuadraturePoint>> = LazyLock::new(|| {
    let mut points = Vec::new();
    corner_orbit(&mut points, (5.0 - 5f64.sqrt()) / 20.0, 0.25);
    points
});
static TET_15: LazyLock<Vec<QuadraturePoint>> = LazyLock::new(|| {
    let root = 15f64.sqrt();
    let mut points = vec![QuadraturePoint { xi: [0.25; 3], weight: 16.0 / 135.0 / 6.0 }];
    corner_orbit(&mut points, (7.0 - root) / 34.0, (2665.0 + 14.0 * root) / 37800.0);
    corner_orbit(&mut points, (7.0 + root) / 34.0, (2665.0 - 14.0 * root) / 37800.0);
    edge_orbit(&mut points, (5.0 - root) / 20.0, 10.0 / 189.0);
    points
});
static WEDGE_3_2: LazyLock<Vec<QuadraturePoint>> = LazyLock::new(|| prism(&TRI_3, &line(2)));
static WEDGE_3_3: LazyLock<Vec<QuadraturePoint>> = LazyLock::new(|| prism(&TRI_3, &line(3)));
static WEDGE_7_3: LazyLock<Vec<QuadraturePoint>> = LazyLock::new(|| prism(&TRI_7, &line(3)));
static WEDGE_7_4: LazyLock<Vec<QuadraturePoint>> = LazyLock::new(|| prism(&TRI_7, &line(4)));
static TRI_3: LazyLock<Vec<FaceQuadraturePoint>> = LazyLock::new(|| {
    let mut points = Vec::new();
    triangle_orbit(&mut points, 1.0 / 6.0, 1.0 / 3.0);
    points
});
static TRI_7: LazyLock<Vec<FaceQuadraturePoint>> = LazyLock::new(|| {
    let root = 15f64.sqrt();
    let mut points = vec![FaceQuadraturePoint { xi: [1.0 / 3.0; 2], weight: 9.0 / 80.0 }];
    triangle_orbit(&mut points, (6.0 + root) / 21.0, (155.0 + root) / 1200.0);
    triangle_orbit(&mut points, (6.0 - root) / 21.0, (155.0 - root) / 1200.0);
    points
});
static QUAD_2: LazyLock<Vec<FaceQuadraturePoint>> = LazyLock::new(|| square(&line(2)));
static QUAD_3: LazyLock<Vec<FaceQuadraturePoint>> = LazyLock::new(|| square(&line(3)));

fn cube(line: &[(f64, f64)]) -> Vec<QuadraturePoint> {
    let mut points = Vec::with_capacity(line.len().pow(3));
    for &(z, wz) in line {
        for &(y, wy) in line {
            for &(x, wx) in line {
                points.push(QuadraturePoint { xi: [x, y, z], weight: wx * wy * wz });
            }
        }
    }
    points
}

fn square(line: &[(f64, f64)]) -> Vec<FaceQuadraturePoint> {
    let mut points = Vec::with_capacity(line.len().pow(2));
    for &(y, wy) in line {
        for &(x, wx) in line {
            points.push(FaceQuadraturePoint { xi: [x, y], weight: wx * wy });
        }
    }
    points
}

fn prism(triangle: &[FaceQuadraturePoint], line: &[(f64, f64)]) -> Vec<QuadraturePoint> {
    let mut points = Vec::with_capacity(triangle.len() * line.len());
    for &(z, wz) in line {
        for t in triangle {
            points.push(QuadraturePoint { xi: [t.xi[0], t.xi[1], z], weight: t.weight * wz });
        }
    }
    points
}

/// Three points with barycentric coordinates (1-2a, a, a) in turn; `share`: of the area, each.
fn triangle_orbit(points: &mut Vec<FaceQuadraturePoint>, a: f64, share: f64) {
    let far = 1.0 - 2.0 * a;
    for xi in [[a, a], [far, a], [a, far]] {
        points.push(FaceQuadraturePoint { xi, weight: 0.5 * share });
    }
}

/// Four points with barycentric coordinates (1-3a, a, a, a) in turn; `share`: of the volume, each.
fn corner_orbit(points: &mut Vec<QuadraturePoint>, a: f64, share: f64) {
    let far = 1.0 - 3.0 * a;
    for xi in [[a, a, a], [far, a, a], [a, far, a], [a, a, far]] {
        points.push(QuadraturePoint { xi, weight: share / 6.0 });
    }
}

/// Six points with barycentric coordinates (a, a, b, b), b = 1/2 - a, in turn.
fn edge_orbit(points: &mut Vec<QuadraturePoint>, a: f64, share: f64) {
    let b = 0.5 - a;
    for xi in [[a, a, b], [a, b, a], [b, a, a], [b, b, a], [b, a, b], [a, b, b]] {
        points.push(QuadraturePoint { xi, weight: share / 6.0 });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn factorial(n: i32) -> f64 {
        (1..=n).map(f64::from).product()
    }

    /// Integral of x^a over [-1, 1].
    fn power(a: i32) -> f64 {
        if a % 2 == 0 { 2.0 / f64::from(a + 1) } else { 0.0 }
    }

    /// Exact integral of x^a y^b z^c over the reference element.
    fn monomial(kind: ElementKind, [a, b, c]: [i32; 3]) -> f64 {
        match kind {
            Hex8 | Hex20 | Hex27 => power(a) * power(b) * power(c),
            Tet4 | Tet10 => factorial(a) * factorial(b) * factorial(c) / factorial(a + b + c + 3),
            Wedge6 | Wedge15 => factorial(a) * factorial(b) / factorial(a + b + 2) * power(c),
        }
    }

    /// Mass rules are exact for every product of two shape functions on a straight-sided element.
    #[test]
    fn mass_rules_integrate_the_products_of_two_shape_functions() {
        for kind in ElementKind::ALL {
            let degree = 2 * kind.order() as i32;
            for a in 0..=degree {
                for b in 0..=degree {
                    for c in 0..=degree {
                        let inside = match kind {
                            Hex8 | Hex20 | Hex27 => true,
                            Tet4 | Tet10 => a + b + c <= degree,
                            Wedge6 | Wedge15 => a + b <= degree,
                        };
                        if !inside {
                            continue;
                        }
                        let sum: f64 = kind
                            .quadrature(QuadratureRule::Mass)
                            .iter()
                            .map(|q| q.weight * q.xi[0].powi(a) * q.xi[1].powi(b) * q.xi[2].powi(c))
                            .sum();
                        let exact = monomial(kind, [a, b, c]);
                        assert!((sum - exact).abs() < 1e-14, "{} x^{a} y^{b} z^{c}: {sum} for {exact}", kind.name());
                    }
                }
            }
        }
    }

    #[test]
    fn weights_sum_to_the_volume_and_points_are_balanced() {
        for kind in ElementKind::ALL {
            for rule in [QuadratureRule::Stiffness, QuadratureRule::Reduced, QuadratureRule::Mass] {
                let points = kind.quadrature(rule);
                let sum: f64 = points.iter().map(|q| q.weight).sum();
                assert!((sum - monomial(kind, [0; 3])).abs() < 1e-14, "{} {rule:?}", kind.name());
                for (k, centre) in kind.centre().into_iter().enumerate() {
                    let mean: f64 = points.iter().map(|q| q.weight * q.xi[k]).sum::<f64>() / sum;
                    assert!((mean - centre).abs() < 1e-14, "{} {rule:?}: lopsided", kind.name());
                }
                assert!(points.iter().all(|q| q.weight > 0.0));
            }
        }
    }

    #[test]
    fn face_rules_integrate_the_products_of_two_shape_functions() {
        for kind in FaceKind::ALL {
            let degree = 2 * kind.order() as i32;
            let triangle = kind.corner_count() == 3;
            for a in 0..=degree {
                for b in 0..=degree {
                    if triangle && a + b > degree {
                        continue;
                    }
                    let sum: f64 = kind.quadrature().iter().map(|q| q.weight * q.xi[0].powi(a) * q.xi[1].powi(b)).sum();
                    let exact =
                        if triangle { factorial(a) * factorial(b) / factorial(a + b + 2) } else { power(a) * power(b) };
                    assert!((sum - exact).abs() < 1e-14, "{} x^{a} y^{b}: {sum}", kind.name());
                }
            }
        }
    }
}
