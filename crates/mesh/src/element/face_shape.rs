//! Shape functions of boundary faces and their gradients in the face's two reference coordinates.

use super::{
    FaceKind::{self, Quad4, Quad8, Quad9, Tri3, Tri6},
    shape::{TRIANGULAR_SLOPES, lagrange},
};

impl FaceKind {
    /// Writes the values of the shape functions at `xi` into the first `node_count()` entries of `n`.
    ///
    /// # Panics
    /// When `n` is shorter than `node_count()`.
    pub fn shape(self, xi: [f64; 2], n: &mut [f64]) {
        for (i, value) in n[..self.node_count()].iter_mut().enumerate() {
            *value = self.value_and_slope(xi, i).0;
        }
    }

    /// Writes the gradients dN/d(xi) of the shape functions at `xi` into the first `node_count()` entries of `dn`.
    ///
    /// # Panics
    /// When `dn` is shorter than `node_count()`.
    pub fn shape_gradient(self, xi: [f64; 2], dn: &mut [[f64; 2]]) {
        for (i, slope) in dn[..self.node_count()].iter_mut().enumerate() {
            *slope = self.value_and_slope(xi, i).1;
        }
    }

    /// Value and gradient of shape function `i`.
    fn value_and_slope(self, xi: [f64; 2], i: usize) -> (f64, [f64; 2]) {
        match self {
            Tri3 | Tri6 => self.triangle(xi, i),
            Quad4 | Quad8 | Quad9 => self.quadrilateral(xi, self.reference_nodes()[i]),
        }
    }

    /// Triangle: L; quadratic: corner L(2L-1), edge 4 L_a L_b.
    fn triangle(self, [x, y]: [f64; 2], i: usize) -> (f64, [f64; 2]) {
        let l = [1.0 - x - y, x, y];
        if i >= 3 {
            let (a, b) = (i - 3, (i - 2) % 3);
            let (da, db) = (TRIANGULAR_SLOPES[a], TRIANGULAR_SLOPES[b]);
            return (4.0 * l[a] * l[b], [0, 1].map(|k| 4.0 * (l[a] * db[k] + l[b] * da[k])));
        }
        if self == Tri3 {
            return (l[i], TRIANGULAR_SLOPES[i]);
        }
        (l[i] * (2.0 * l[i] - 1.0), TRIANGULAR_SLOPES[i].map(|d| (4.0 * l[i] - 1.0) * d))
    }

    /// Quadrilateral, as the brick of the same family (see the volume elements).
    fn quadrilateral(self, xi: [f64; 2], node: [f64; 2]) -> (f64, [f64; 2]) {
        let factor = |k: usize| -> (f64, f64) {
            let (x, c) = (xi[k], node[k]);
            match self {
                Quad9 => lagrange(x, c),
                _ if c == 0.0 => (1.0 - x * x, -2.0 * x),
                _ => (0.5 * (1.0 + c * x), 0.5 * c),
            }
        };
        let [(fx, dx), (fy, dy)] = [factor(0), factor(1)];
        let (value, slope) = (fx * fy, [dx * fy, fx * dy]);
        if self == Quad8 && node.iter().all(|&c| c != 0.0) {
            let reach = xi[0] * node[0] + xi[1] * node[1] - 1.0;
            return (value * reach, [0, 1].map(|k| slope[k] * reach + value * node[k]));
        }
        (value, slope)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_shape_function_is_one_at_its_node_and_zero_at_the_others() {
        for kind in FaceKind::ALL {
            let mut n = [0.0; 9];
            for (i, &node) in kind.reference_nodes().iter().enumerate() {
                kind.shape(node, &mut n);
                for (j, &value) in n[..kind.node_count()].iter().enumerate() {
                    let wanted = f64::from(u8::from(i == j));
                    assert!((value - wanted).abs() < 1e-15, "{}: N_{j} at node {i} is {value}", kind.name());
                }
            }
        }
    }

    #[test]
    fn gradient_is_the_derivative_and_values_sum_to_one() {
        let h = 1e-5;
        for kind in FaceKind::ALL {
            let count = kind.node_count();
            let (mut up, mut down, mut dn) = ([0.0; 9], [0.0; 9], [[0.0; 2]; 9]);
            for xi in [[0.2, 0.3], [-0.8, 0.5], [0.0, 1.0]] {
                kind.shape_gradient(xi, &mut dn);
                for k in 0..2 {
                    let (mut a, mut b) = (xi, xi);
                    a[k] += h;
                    b[k] -= h;
                    kind.shape(a, &mut up);
                    kind.shape(b, &mut down);
                    assert!((up[..count].iter().sum::<f64>() - 1.0).abs() < 1e-14);
                    for i in 0..count {
                        let difference = (up[i] - down[i]) / (2.0 * h);
                        assert!((difference - dn[i][k]).abs() < 1e-9, "{} dN_{i}/d{k}", kind.name());
                    }
                }
            }
        }
    }

    #[test]
    fn counts_and_numbers_lead_back_to_the_kind() {
        for kind in FaceKind::ALL {
            assert_eq!(FaceKind::from_gmsh_type(kind.gmsh_type()), Some(kind));
            assert_eq!(kind.reference_nodes().len(), kind.node_count());
        }
    }
}
