//! Shape functions of volume elements and their gradients in reference coordinates.
//!
//! ```text
//! hex8     N = 1/8 (1+xx_i)(1+yy_i)(1+zz_i)
//! hex20    corner: 1/8 (1+xx_i)(1+yy_i)(1+zz_i)(xx_i+yy_i+zz_i-2);  edge along x: 1/4 (1-x^2)(1+yy_i)(1+zz_i)
//! hex27    products of quadratic Lagrange polynomials
//! tet      L_i;  quadratic: corner L(2L-1), edge 4 L_a L_b
//! wedge6   1/2 L_i (1+zz_i)
//! wedge15  corner: 1/2 L [(2L-1)(1+zz_i) - (1-z^2)];  triangle's edge: 2 L_a L_b (1+zz_i);  upright edge: L (1-z^2)
//! ```
//! x, y, z are reference coordinates; x_i, y_i, z_i those of the node; L are barycentric coordinates.

use super::ElementKind::{self, Hex8, Hex20, Hex27, Tet4, Tet10, Wedge6, Wedge15};

impl ElementKind {
    /// Writes the values of the shape functions at `xi` into the first `node_count()` entries of `n`.
    ///
    /// # Panics
    /// When `n` is shorter than `node_count()`.
    pub fn shape(self, xi: [f64; 3], n: &mut [f64]) {
        let n = &mut n[..self.node_count()];
        match self {
            Hex8 | Hex20 | Hex27 => {
                for (value, &node) in n.iter_mut().zip(self.reference_nodes()) {
                    *value = self.brick(xi, node).0;
                }
            }
            Tet4 | Tet10 => {
                let l = tetrahedral(xi);
                n[..4].copy_from_slice(&l);
                if self == Tet10 {
                    for (value, &[a, b]) in n[4..].iter_mut().zip(self.edges()) {
                        *value = 4.0 * l[a] * l[b];
                    }
                    n[..4].iter_mut().for_each(|v| *v *= 2.0 * *v - 1.0);
                }
            }
            Wedge6 | Wedge15 => {
                for (i, value) in n.iter_mut().enumerate() {
                    *value = self.wedge(xi, i).0;
                }
            }
        }
    }

    /// Writes the gradients dN/d(xi) of the shape functions at `xi` into the first `node_count()` entries of `dn`.
    ///
    /// # Panics
    /// When `dn` is shorter than `node_count()`.
    pub fn shape_gradient(self, xi: [f64; 3], dn: &mut [[f64; 3]]) {
        let dn = &mut dn[..self.node_count()];
        match self {
            Hex8 | Hex20 | Hex27 => {
                for (slope, &node) in dn.iter_mut().zip(self.reference_nodes()) {
                    *slope = self.brick(xi, node).1;
                }
            }
            Tet4 => dn.copy_from_slice(&TETRAHEDRAL_SLOPES),
            Tet10 => {
                let l = tetrahedral(xi);
                for (i, slope) in dn[..4].iter_mut().enumerate() {
                    *slope = TETRAHEDRAL_SLOPES[i].map(|d| (4.0 * l[i] - 1.0) * d);
                }
                for (slope, &[a, b]) in dn[4..].iter_mut().zip(self.edges()) {
                    let (da, db) = (TETRAHEDRAL_SLOPES[a], TETRAHEDRAL_SLOPES[b]);
                    *slope = [0, 1, 2].map(|k| 4.0 * (l[a] * db[k] + l[b] * da[k]));
                }
            }
            Wedge6 | Wedge15 => {
                for (i, slope) in dn.iter_mut().enumerate() {
                    *slope = self.wedge(xi, i).1;
                }
            }
        }
    }

    /// Value and gradient of a brick's shape function for the node at reference position `node`.
    fn brick(self, xi: [f64; 3], node: [f64; 3]) -> (f64, [f64; 3]) {
        // one (value, slope) a direction; most kinds are plain products of them
        let factor = |k: usize| -> (f64, f64) {
            let (x, c) = (xi[k], node[k]);
            match self {
                Hex27 => lagrange(x, c),
                _ if c == 0.0 => (1.0 - x * x, -2.0 * x),
                _ => (0.5 * (1.0 + c * x), 0.5 * c),
            }
        };
        let [(fx, dx), (fy, dy), (fz, dz)] = [factor(0), factor(1), factor(2)];
        let value = fx * fy * fz;
        let slope = [dx * fy * fz, fx * dy * fz, fx * fy * dz];
        if self == Hex20 && node.iter().all(|&c| c != 0.0) {
            let reach: f64 = (0..3).map(|k| xi[k] * node[k]).sum::<f64>() - 2.0;
            return (value * reach, [0, 1, 2].map(|k| slope[k] * reach + value * node[k]));
        }
        (value, slope)
    }

    /// Value and gradient of shape function `i` of a wedge.
    fn wedge(self, [x, y, z]: [f64; 3], i: usize) -> (f64, [f64; 3]) {
        let l = [1.0 - x - y, x, y];
        if i < 6 {
            let (k, c) = (i % 3, if i < 3 { -1.0 } else { 1.0 });
            let (lk, d) = (l[k], TRIANGULAR_SLOPES[k]);
            let h = 1.0 + c * z;
            if self == Wedge6 {
                return (0.5 * lk * h, [0.5 * d[0] * h, 0.5 * d[1] * h, 0.5 * lk * c]);
            }
            let bubble = 1.0 - z * z;
            let by_l = 0.5 * ((4.0 * lk - 1.0) * h - bubble);
            let value = 0.5 * lk * ((2.0 * lk - 1.0) * h - bubble);
            return (value, [by_l * d[0], by_l * d[1], 0.5 * lk * ((2.0 * lk - 1.0) * c + 2.0 * z)]);
        }
        let [a, b] = self.edges()[i - 6];
        if b == a + 3 {
            let (la, d, bubble) = (l[a], TRIANGULAR_SLOPES[a], 1.0 - z * z);
            return (la * bubble, [d[0] * bubble, d[1] * bubble, -2.0 * la * z]);
        }
        let c = if a < 3 { -1.0 } else { 1.0 };
        let (a, b, h) = (a % 3, b % 3, 1.0 + c * z);
        let (da, db) = (TRIANGULAR_SLOPES[a], TRIANGULAR_SLOPES[b]);
        let across = |k: usize| 2.0 * (l[a] * db[k] + l[b] * da[k]) * h;
        (2.0 * l[a] * l[b] * h, [across(0), across(1), 2.0 * l[a] * l[b] * c])
    }
}

/// Quadratic Lagrange polynomial that is 1 at `c` and 0 at the other two of -1, 0, 1; with slope.
pub(super) fn lagrange(x: f64, c: f64) -> (f64, f64) {
    if c == 0.0 { (1.0 - x * x, -2.0 * x) } else { (0.5 * x * (x + c), x + 0.5 * c) }
}

/// Gradients of the barycentric coordinates of a triangle.
pub(super) const TRIANGULAR_SLOPES: [[f64; 2]; 3] = [[-1.0, -1.0], [1.0, 0.0], [0.0, 1.0]];

/// Gradients of the barycentric coordinates of a tetrahedron.
const TETRAHEDRAL_SLOPES: [[f64; 3]; 4] = [[-1.0, -1.0, -1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// Barycentric coordinates in a tetrahedron.
fn tetrahedral([x, y, z]: [f64; 3]) -> [f64; 4] {
    [1.0 - x - y - z, x, y, z]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Points inside, on the border and outside of every reference element.
    const PROBES: [[f64; 3]; 4] = [[0.2, 0.3, 0.1], [0.0, 0.0, -1.0], [-0.7, 0.4, 0.9], [0.31, 0.17, -0.6]];

    fn middle(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
        [0, 1, 2].map(|k| 0.5 * (a[k] + b[k]))
    }

    #[test]
    fn each_shape_function_is_one_at_its_node_and_zero_at_the_others() {
        for kind in ElementKind::ALL {
            let mut n = vec![0.0; kind.node_count()];
            for (i, &node) in kind.reference_nodes().iter().enumerate() {
                kind.shape(node, &mut n);
                for (j, &value) in n.iter().enumerate() {
                    let wanted = f64::from(u8::from(i == j));
                    assert!((value - wanted).abs() < 1e-15, "{}: N_{j} at node {i} is {value}", kind.name());
                }
            }
        }
    }

    #[test]
    fn shape_functions_sum_to_one_and_reproduce_position() {
        for kind in ElementKind::ALL {
            let (mut n, mut dn) = (vec![0.0; 27], vec![[0.0; 3]; 27]);
            for xi in PROBES {
                kind.shape(xi, &mut n);
                kind.shape_gradient(xi, &mut dn);
                let count = kind.node_count();
                assert!((n[..count].iter().sum::<f64>() - 1.0).abs() < 1e-14);
                for k in 0..3 {
                    let position: f64 = n.iter().zip(kind.reference_nodes()).map(|(v, x)| v * x[k]).sum();
                    assert!((position - xi[k]).abs() < 1e-14, "{} at {xi:?}", kind.name());
                    assert!(dn[..count].iter().map(|d| d[k]).sum::<f64>().abs() < 1e-14);
                }
            }
        }
    }

    #[test]
    fn gradient_is_the_derivative_of_the_shape_functions() {
        let h = 1e-5;
        for kind in ElementKind::ALL {
            let count = kind.node_count();
            let (mut up, mut down, mut dn) = (vec![0.0; count], vec![0.0; count], vec![[0.0; 3]; count]);
            for xi in PROBES {
                kind.shape_gradient(xi, &mut dn);
                for k in 0..3 {
                    let (mut a, mut b) = (xi, xi);
                    a[k] += h;
                    b[k] -= h;
                    kind.shape(a, &mut up);
                    kind.shape(b, &mut down);
                    for i in 0..count {
                        // cubic at most along one direction: the difference errs by h^2
                        let difference = (up[i] - down[i]) / (2.0 * h);
                        assert!((difference - dn[i][k]).abs() < 1e-9, "{} dN_{i}/d{k} at {xi:?}", kind.name());
                    }
                }
            }
        }
    }

    #[test]
    fn faces_close_the_element_and_turn_outwards() {
        for kind in ElementKind::ALL {
            let nodes = kind.reference_nodes();
            let centre = kind.centre();
            let mut total = [0.0; 3];
            for (face, local) in kind.faces() {
                assert_eq!(local.len(), face.node_count());
                let (mut n, mut dn) = (vec![0.0; 9], vec![[0.0; 2]; 9]);
                for q in face.quadrature() {
                    face.shape(q.xi, &mut n);
                    face.shape_gradient(q.xi, &mut dn);
                    let at = |k: usize| local.iter().zip(&n).map(|(&i, v)| v * nodes[i][k]).sum::<f64>();
                    let along =
                        |k: usize, d: usize| local.iter().zip(&dn).map(|(&i, g)| g[d] * nodes[i][k]).sum::<f64>();
                    let (u, v) = ([0, 1, 2].map(|k| along(k, 0)), [0, 1, 2].map(|k| along(k, 1)));
                    let normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
                    let outward: f64 = (0..3).map(|k| (at(k) - centre[k]) * normal[k]).sum();
                    assert!(outward > 0.0, "{}: face {local:?} turns inwards", kind.name());
                    (0..3).for_each(|k| total[k] += q.weight * normal[k]);
                }
                // edge nodes lie between their corners, in turn
                if face.order() == 2 {
                    let corners = face.corner_count();
                    for k in 0..corners {
                        let (a, b, m) = (local[k], local[(k + 1) % corners], local[corners + k]);
                        assert_eq!(nodes[m], middle(nodes[a], nodes[b]), "{}: node {m}", kind.name());
                    }
                }
            }
            assert!(total.iter().all(|t| t.abs() < 1e-14), "{}: a hole, {total:?}", kind.name());
        }
    }

    #[test]
    fn edge_nodes_lie_in_the_middle_of_their_edges() {
        for kind in ElementKind::ALL.into_iter().filter(|k| k.order() == 2) {
            let nodes = kind.reference_nodes();
            for (k, &[a, b]) in kind.edges().iter().enumerate() {
                assert_eq!(nodes[kind.corner_count() + k], middle(nodes[a], nodes[b]));
            }
        }
    }

    #[test]
    fn gmsh_numbers_lead_back_to_the_kind() {
        for kind in ElementKind::ALL {
            assert_eq!(ElementKind::from_gmsh_type(kind.gmsh_type()), Some(kind));
            assert_eq!(kind.reference_nodes().len(), kind.node_count());
        }
        assert_eq!(ElementKind::from_gmsh_type(2), None);
    }
}
