//! Stress on a free surface, computed only from the displacement of that surface.
//!
//! On a surface without traction the stress is plane in the tangent plane, and the three strains in that plane follow
//! from the surface's own displacement. No derivative into the body is needed, which is the least accurate part on a
//! coarse mesh.
//!
//! ```text
//! grad_s u = sum_j u_j (x) g_j,   g_j = dN_j/dxi a^1 + dN_j/deta a^2        a^1, a^2 dual to the tangents a_1, a_2
//! eps = sym(P grad_s u P),        P = I - n n'                              3 x 3, in the tangent plane
//! sigma = 2 mu eps + E nu / (1 - nu^2) tr(eps) P                            plane stress, MPa
//! ```
//! The stress is evaluated where the strains of the face are most accurate (quadrilaterals of order 2: 2 x 2 Gauss
//! points, triangles of order 2: three, faces of order 1: the centre), in frames that follow the face. Patch recovery
//! then gives the values at the nodes.

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
pub(super) type Frame = [[f64; 3]; 3];

/// Stress 11, 22, 12 in a tangent frame for a unit move along each axis: `[axis][component]`.
pub(super) type Plane = [[f64; 3]; 3];

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

    /// Where strains of the face are most accurate, reference coordinates.
    pub(super) fn points(&self) -> &'static [[f64; 2]] {
        self.points
    }

    /// The point at `xi` of a face, mm.
    pub(super) fn position(&self, xi: [f64; 2], x: &[[f64; 3]]) -> [f64; 3] {
        let mut shape = [0.0; 9];
        self.kind.shape(xi, &mut shape);
        [0, 1, 2].map(|k| x.iter().zip(&shape).map(|(x, n)| n * x[k]).sum())
    }

    /// Frame at `xi`, the tangents in it (|a_1|, a_2 t_1, a_2 t_2, mm) and the shape functions' derivatives. `None` for
    /// a face that is folded to a line.
    pub(super) fn tangents(&self, xi: [f64; 2], x: &[[f64; 3]]) -> Option<(Frame, [f64; 3], [[f64; 2]; 9])> {
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
        // a_1 = |a_1| t1, a_2 = (a_2.t1) t1 + (a_2.t2) t2
        Some(([t1, t2, n], [length, dot(a[1], t1), dot(a[1], t2)], dn))
    }

    /// Frame at `xi`, and for each node and axis the stress 11, 22, 12 in that frame for a unit move:
    /// `[node][axis][component]`.
    pub(super) fn at(&self, xi: [f64; 2], x: &[[f64; 3]]) -> Option<(Frame, Vec<Plane>)> {
        let ([t1, t2, n], [length, shear, height], dn) = self.tangents(xi, x)?;
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
}

/// `frame` after the smallest turn that takes its normal to `normal`, or to the opposite if that is nearer.
pub(super) fn turned(frame: &Frame, normal: [f64; 3]) -> Frame {
    let [t, _, n] = *frame;
    let m = if dot(n, normal) < 0.0 { normal.map(|c| -c) } else { normal };
    let share = dot(t, m) / (1.0 + dot(n, m));
    let first = [0, 1, 2].map(|k| t[k] - share * (n[k] + m[k]));
    [first, cross(m, first), m]
}

/// Stress 11, 22, 12 in a frame, by axis of the move, as a 6 x 3 block: rows xx, yy, zz, xy, yz, zx.
pub(super) fn in_space([t, s, _]: &Frame, plane: &Plane) -> [f64; 18] {
    let mut block = [0.0; 18];
    for (k, (a, b)) in [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0)].into_iter().enumerate() {
        let shares = [t[a] * t[b], s[a] * s[b], t[a] * s[b] + s[a] * t[b]];
        for axis in 0..3 {
            block[3 * k + axis] = dot(shares, plane[axis]);
        }
    }
    block
}

pub(super) fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
