//! Stress inside one element and at its nodes.

use mesh::{
    ElementKind::{self, Hex8, Hex20, Hex27, Tet4, Tet10, Wedge6, Wedge15},
    element::{QuadraturePoint, QuadratureRule},
};

use crate::{
    ElementOptions, FemError, IncompatibleModes, Material,
    element_matrices::{BUBBLES, Condensed, StiffnessKernel, Table, bubble_gradients, checked_jacobian, gradients},
};

/// Stress evaluation for elements of one kind.
pub(super) struct ElementStress {
    kind: ElementKind,
    modes: IncompatibleModes,
    material: Material,
    table: Table,
    centre: Table,
    stiffness: StiffnessKernel,
    /// `to_nodes[i][q]`: weight of point q in the value at node i.
    to_nodes: Vec<Vec<f64>>,
}

/// Gradients at the sampling points of one element, and the incompatible modes.
pub(super) struct Prepared {
    gradients: Vec<Vec<[f64; 3]>>,
    bubbles: Option<(Vec<[[f64; 3]; BUBBLES]>, Condensed)>,
}

impl ElementStress {
    pub(super) fn new(kind: ElementKind, material: &Material, options: &ElementOptions) -> Self {
        let points = sampling_points(kind);
        let to_nodes = kind
            .reference_nodes()
            .iter()
            .map(|&xi| points.iter().map(|q| extrapolation(kind, q.xi, points, xi)).collect())
            .collect();
        let modes = match kind {
            Hex8 => options.incompatible_modes,
            _ => IncompatibleModes::Off,
        };
        let centre = QuadraturePoint { xi: kind.centre(), weight: 1.0 };
        Self {
            kind,
            modes,
            material: *material,
            table: Table::at(kind, points),
            centre: Table::at(kind, &[centre]),
            stiffness: StiffnessKernel::new(kind, material, options),
            to_nodes,
        }
    }

    /// Everything that depends on the element's shape alone.
    pub(super) fn prepare(&self, coordinates: &[[f64; 3]], tag: u64) -> Result<Prepared, FemError> {
        let (inverse_centre, det_centre) = checked_jacobian(self.kind, tag, coordinates, &self.centre.points[0].dn)?;
        let (mut all, mut bubbles) = (Vec::new(), Vec::new());
        for point in &self.table.points {
            let (inverse, det) = checked_jacobian(self.kind, tag, coordinates, &point.dn)?;
            let mut g = vec![[0.0; 3]; coordinates.len()];
            gradients(&inverse, &point.dn, &mut g);
            all.push(g);
            bubbles.push(bubble_gradients(self.modes, point.xi, &inverse_centre, det_centre, det));
        }
        let condensed = if self.modes == IncompatibleModes::Off {
            None
        } else {
            let mut blocks = vec![[0.0; 9]; self.stiffness.buffer_len()];
            self.stiffness.fill(coordinates, tag, &mut blocks)?
        };
        Ok(Prepared { gradients: all, bubbles: condensed.map(|c| (bubbles, c)) })
    }

    /// Stress (MPa) at each node from the nodes' displacements (mm).
    pub(super) fn at_nodes(&self, prepared: &Prepared, u: &[[f64; 3]]) -> Vec<[f64; 6]> {
        let amplitudes = prepared.bubbles.as_ref().map(|(g, c)| (g, c.amplitudes(u)));
        let at_points: Vec<[f64; 6]> = prepared
            .gradients
            .iter()
            .enumerate()
            .map(|(q, g)| {
                let mut h = [[0.0; 3]; 3]; // h[a][b] = du_a / dx_b
                add_gradient(&mut h, u, g);
                if let Some((g, alpha)) = &amplitudes {
                    add_gradient(&mut h, alpha, &g[q]);
                }
                self.material.stress_mpa([
                    h[0][0],
                    h[1][1],
                    h[2][2],
                    h[0][1] + h[1][0],
                    h[1][2] + h[2][1],
                    h[2][0] + h[0][2],
                ])
            })
            .collect();
        self.to_nodes
            .iter()
            .map(|weights| {
                let mut stress = [0.0; 6];
                for (w, s) in weights.iter().zip(&at_points) {
                    (0..6).for_each(|k| stress[k] += w * s[k]);
                }
                stress
            })
            .collect()
    }
}

fn add_gradient(h: &mut [[f64; 3]; 3], u: &[[f64; 3]], g: &[[f64; 3]]) {
    for (u, g) in u.iter().zip(g) {
        for a in 0..3 {
            for b in 0..3 {
                h[a][b] += u[a] * g[b];
            }
        }
    }
}

/// Where an element's stress is most accurate.
fn sampling_points(kind: ElementKind) -> &'static [QuadraturePoint] {
    let family = match kind {
        Hex8 | Hex20 | Hex27 => Hex8,
        Tet4 => Tet4,
        Tet10 => Tet10,
        Wedge6 | Wedge15 => Wedge6,
    };
    family.quadrature(QuadratureRule::Stiffness)
}

/// Weight at `xi` of the value at sampling point `q`: linear (trilinear) and 1 at q, 0 at the other points.
fn extrapolation(kind: ElementKind, q: [f64; 3], points: &[QuadraturePoint], xi: [f64; 3]) -> f64 {
    // along a line with points at +-z: 1 at z, 0 at -z
    let line = |x: f64, z: f64| 0.5 * (1.0 + x / z);
    // barycentric coordinate of the corner next to q, shrunk so that it is 1 at q and 0 at the others
    let corner = |l: &[f64], of_q: &[f64]| {
        let near = (0..l.len()).fold(0, |best, k| if of_q[k] > of_q[best] { k } else { best });
        let far = (1.0 - of_q[near]) / (l.len() as f64 - 1.0);
        (l[near] - far) / (of_q[near] - far)
    };
    match kind {
        Hex8 | Hex20 | Hex27 => (0..3).map(|k| line(xi[k], q[k])).product(),
        Tet4 | Tet10 if points.len() == 1 => 1.0,
        Tet4 | Tet10 => {
            let l = |x: [f64; 3]| [1.0 - x[0] - x[1] - x[2], x[0], x[1], x[2]];
            corner(&l(xi), &l(q))
        }
        Wedge6 | Wedge15 => {
            let l = |x: [f64; 3]| [1.0 - x[0] - x[1], x[0], x[1]];
            corner(&l(xi), &l(q)) * line(xi[2], q[2])
        }
    }
}
