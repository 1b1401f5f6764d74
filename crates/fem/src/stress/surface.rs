//! Stress on a free surface from the displacement of that surface alone.
//!
//! On a surface without traction the stress is plane in the tangent plane, and the three strains in that plane are those of
//! the surface's own displacement: no derivative into the body is needed, which is where a coarse mesh is worst.
//!
//! ```text
//! grad_s u = sum_j u_j (x) g_j,   g_j = dN_j/dxi a^1 + dN_j/deta a^2        a^1, a^2 dual to the tangents a_1, a_2
//! eps = sym(P grad_s u P),        P = I - n n'                              3 x 3, in the tangent plane
//! sigma = 2 mu eps + E nu / (1 - nu^2) tr(eps) P                            plane stress, MPa
//! ```
//! Evaluated where the strains of the face are most accurate (quadrilaterals of order 2: 2 x 2 Gauss points, triangles of order 2: three,
//! faces of order 1: the centre), in frames that follow the face, and carried to the nodes by the linear field through these points.

use mesh::FaceKind::{self, Quad4, Quad8, Quad9, Tri3, Tri6};

use crate::Material;

/// 1 / sqrt(3).
const GAUSS: f64 = 0.577_350_269_189_625_8;

/// Stress at the nodes of faces of one kind.
pub(super) struct SurfaceStress {
    kind: FaceKind,
    /// mu and E nu / (1 - nu^2), MPa.
    moduli: [f64; 2],
    points: &'static [[f64; 2]],
}

/// Tangent frame at a point of a face: two unit tangents and the normal.
type Frame = [[f64; 3]; 3];

impl SurfaceStress {
    pub(super) fn new(kind: FaceKind, material: &Material) -> Self {
        let (young, nu) = (material.young_mpa(), material.poisson());
        let points: &[[f64; 2]] = match kind {
            Tri3 => &[[1.0 / 3.0, 1.0 / 3.0]],
            Quad4 => &[[0.0, 0.0]],
            Tri6 => &[[1.0 / 6.0, 1.0 / 6.0], [2.0 / 3.0, 1.0 / 6.0], [1.0 / 6.0, 2.0 / 3.0]],
            Quad8 | Quad9 => &[[-GAUSS, -GAUSS], [GAUSS, -GAUSS], [-GAUSS, GAUSS], [GAUSS, GAUSS]],
        };
        Self { kind, moduli: [young / (2.0 * (1.0 + nu)), young * nu / (1.0 - nu * nu)], points }
    }

    /// Blocks `[i][j]` (6 x 3, row-major, MPa/mm): stress at node i for a unit move of node j. `None` for a face that is
    /// folded to a line.
    pub(super) fn blocks(&self, x: &[[f64; 3]]) -> Option<Vec<Vec<[f64; 18]>>> {
        let at_points: Vec<_> = self.points.iter().map(|&xi| self.at(xi, x)).collect::<Option<_>>()?;
        let of_node = |&xi: &[f64; 2]| {
            let (frame, _) = self.at(xi, x)?;
            let block = |j: usize| {
                let mut plane = [[0.0; 3]; 3];
                for (q, (_, own)) in at_points.iter().enumerate() {
                    let w = self.weight(q, xi);
                    (0..3).for_each(|axis| (0..3).for_each(|k| plane[axis][k] += w * own[j][axis][k]));
                }
                in_space(&frame, &plane)
            };
            Some((0..x.len()).map(block).collect())
        };
        self.kind.reference_nodes().iter().map(of_node).collect()
    }

    /// Frame at `xi`, and for each node and axis the stress 11, 22, 12 in that frame for a unit move: `[node][axis][component]`.
    fn at(&self, xi: [f64; 2], x: &[[f64; 3]]) -> Option<(Frame, Vec<[[f64; 3]; 3]>)> {
        let mut dn = [[0.0; 2]; 9];
        self.kind.shape_gradient(xi, &mut dn);
        let mut a = [[0.0; 3]; 2];
        for (x, dn) in x.iter().zip(&dn) {
            (0..2).for_each(|k| (0..3).for_each(|c| a[k][c] += dn[k] * x[c]));
        }
        let normal = cross(a[0], a[1]);
        let area = dot(normal, normal).sqrt();
        // NaN among them.
        if area.is_nan() || area <= 0.0 {
            return None;
        }
        let n = normal.map(|c| c / area);
        let length = dot(a[0], a[0]).sqrt();
        let t1 = a[0].map(|c| c / length);
        let t2 = cross(n, t1);
        // d/d t1 and d/d t2 of the shape functions: a_1 = |a_1| t1, a_2 = (a_2.t1) t1 + (a_2.t2) t2
        let (shear, height) = (dot(a[1], t1), dot(a[1], t2));
        let [mu, lambda] = self.moduli;
        let blocks = dn[..x.len()]
            .iter()
            .map(|dn| {
                let g1 = dn[0] / length;
                let g2 = (dn[1] - shear * g1) / height;
                [0, 1, 2].map(|axis| {
                    let (e11, e22) = (t1[axis] * g1, t2[axis] * g2);
                    let e12 = 0.5 * (t1[axis] * g2 + t2[axis] * g1);
                    let sum = lambda * (e11 + e22);
                    [2.0 * mu * e11 + sum, 2.0 * mu * e22 + sum, 2.0 * mu * e12]
                })
            })
            .collect();
        Some(([t1, t2, n], blocks))
    }

    /// Weight at `xi` of the value at point `q`: linear or bilinear, 1 at q and 0 at the other points.
    fn weight(&self, q: usize, xi: [f64; 2]) -> f64 {
        let at = self.points[q];
        match self.kind {
            Tri3 | Quad4 => 1.0,
            Tri6 => {
                let l = [1.0 - xi[0] - xi[1], xi[0], xi[1]];
                (6.0 * l[q] - 1.0) / 3.0
            }
            Quad8 | Quad9 => (0..2).map(|k| 0.5 * (1.0 + xi[k] / at[k])).product(),
        }
    }
}

/// Stress 11, 22, 12 in a frame, by axis of the move, as a 6 x 3 block: rows xx, yy, zz, xy, yz, zx.
fn in_space([t, s, _]: &Frame, plane: &[[f64; 3]; 3]) -> [f64; 18] {
    let mut block = [0.0; 18];
    for (k, (a, b)) in [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0)].into_iter().enumerate() {
        let shares = [t[a] * t[b], s[a] * s[b], t[a] * s[b] + s[a] * t[b]];
        for axis in 0..3 {
            block[3 * k + axis] = dot(shares, plane[axis]);
        }
    }
    block
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
