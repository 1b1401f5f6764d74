//! Plane strain on a lattice of eight-node quadrilaterals, Young's modulus 1.

use std::f64::consts::PI;

use faer::Mat;
use fem::{BoundaryLastFactor, FemError, SymmetricMatrix};
use mesh::FaceKind;

/// A point or vector of the section, mm.
pub(crate) type Vec2 = [f64; 2];

const NODES: usize = 8;
/// Full-integration quad8 would lock as nu nears 1/2; with 2 x 2 points it does not, and clamped sides leave no zero
/// mode.
const GAUSS_2: [f64; 2] = [-0.577_350_269_189_625_8, 0.577_350_269_189_625_8];
/// Gauss points and weights on an edge; tractions of a force next to the edge need more than stiffness does.
const GAUSS_6: [(f64, f64); 6] = [
    (-0.932_469_514_203_152, 0.171_324_492_379_170_36),
    (-0.661_209_386_466_264_5, 0.360_761_573_048_138_6),
    (-0.238_619_186_083_196_9, 0.467_913_934_572_691),
    (0.238_619_186_083_196_9, 0.467_913_934_572_691),
    (0.661_209_386_466_264_5, 0.360_761_573_048_138_6),
    (0.932_469_514_203_152, 0.171_324_492_379_170_36),
];

/// A body in plane strain, some nodes clamped.
pub(crate) struct PlaneBody {
    pub points: Vec<Vec2>,
    /// End, middle, end node of each boundary edge that is free, the material on its left.
    free_edges: Vec<[usize; 3]>,
    /// First matrix row of each node; `None`: clamped.
    rows: Vec<Option<usize>>,
    poisson: f64,
    /// Stiffness between free rows and clamped nodes: (row, node, axis, value).
    coupling: Vec<(usize, usize, usize, f64)>,
    factor: BoundaryLastFactor,
}

impl PlaneBody {
    /// Assembles and factors. `elements` are node numbers in the order of [`FaceKind::Quad8`].
    pub fn new(
        points: Vec<Vec2>,
        elements: &[[usize; NODES]],
        clamped: &[bool],
        free_edges: Vec<[usize; 3]>,
        poisson: f64,
    ) -> Result<Self, FemError> {
        let mut count = 0;
        let rows: Vec<Option<usize>> = clamped
            .iter()
            .map(|&fixed| {
                (!fixed).then(|| {
                    count += 2;
                    count - 2
                })
            })
            .collect();
        let (mut triplets, mut coupling) = (Vec::new(), Vec::new());
        for (tag, element) in elements.iter().enumerate() {
            let k = stiffness(element.map(|n| points[n]), poisson).ok_or(FemError::Inverted {
                kind: "quad8",
                tag: tag as u64,
                det_j_mm3: 0.0,
            })?;
            for (i, &ni) in element.iter().enumerate() {
                let Some(row) = rows[ni] else { continue };
                for (j, &nj) in element.iter().enumerate() {
                    for (a, b) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                        let value = k[2 * i + a][2 * j + b];
                        match rows[nj] {
                            Some(column) if column + b <= row + a => triplets.push((row + a, column + b, value)),
                            Some(_) => {}
                            None => coupling.push((row + a, nj, b, value)),
                        }
                    }
                }
            }
        }
        let factor = BoundaryLastFactor::new(&SymmetricMatrix::from_triplets(count, &triplets)?, &[])?;
        Ok(Self { points, free_edges, rows, poisson, coupling, factor })
    }

    /// Regular part of the indentation under a unit force on node `node`, along `inward` (unit vector into the
    /// material): the response of the body minus that of the half-plane, in units of K = 2 (1 - nu^2) / pi. The
    /// indentation at distance r is then -ln(r) + regular.
    ///
    /// The displacements and stresses of the half-plane (Flamant; Johnson, Contact Mechanics, 1985, section 2.2) are
    /// subtracted. The rest is smooth, and coarse elements resolve it well. Its tractions on the free edges and its
    /// displacements on the clamped nodes are those of the half-plane with opposite sign.
    pub fn regular_dents(&self, stations: &[(usize, Vec2)]) -> Result<Vec<f64>, FemError> {
        let mut rhs = Mat::<f64>::zeros(self.factor.n(), stations.len());
        for (column, &(node, inward)) in stations.iter().enumerate() {
            let force = Flamant { at: self.points[node], inward, poisson: self.poisson };
            self.load(&force, |row, value| rhs[(row, column)] += value);
        }
        self.factor.solve(rhs.as_mut())?;
        let k = 2.0 * (1.0 - self.poisson * self.poisson) / PI;
        Ok(stations
            .iter()
            .enumerate()
            .map(|(column, &(node, inward))| {
                let u = self.rows[node].map_or([0.0; 2], |row| [rhs[(row, column)], rhs[(row + 1, column)]]);
                dot(u, inward) / k
            })
            .collect())
    }

    fn load(&self, force: &Flamant, mut add: impl FnMut(usize, f64)) {
        for edge in &self.free_edges {
            let p = edge.map(|n| self.points[n]);
            for (x, weight) in GAUSS_6 {
                let n = [0.5 * x * (x - 1.0), 1.0 - x * x, 0.5 * x * (x + 1.0)];
                let dn = [x - 0.5, -2.0 * x, x + 0.5];
                let place = [0, 1].map(|k| (0..3).map(|i| n[i] * p[i][k]).sum());
                let tangent: Vec2 = [0, 1].map(|k| (0..3).map(|i| dn[i] * p[i][k]).sum());
                // Material on the left: the outward normal times the length is the tangent turned clockwise.
                let traction = force.traction(place, [tangent[1], -tangent[0]]);
                for (i, &node) in edge.iter().enumerate() {
                    if let Some(row) = self.rows[node] {
                        add(row, -weight * n[i] * traction[0]);
                        add(row + 1, -weight * n[i] * traction[1]);
                    }
                }
            }
        }
        let mut clamped: Vec<Option<Vec2>> = vec![None; self.points.len()];
        for &(row, node, axis, value) in &self.coupling {
            let u = clamped[node].get_or_insert_with(|| force.displacement(self.points[node]));
            add(row, value * u[axis]);
        }
    }
}

/// Unit force on the surface of a half-plane, E = 1, plane strain.
struct Flamant {
    at: Vec2,
    inward: Vec2,
    poisson: f64,
}

impl Flamant {
    /// Distance from the force, angle from its direction, radial and hoop unit vectors.
    fn polar(&self, p: Vec2) -> (f64, f64, Vec2, Vec2) {
        let across = [-self.inward[1], self.inward[0]];
        let d = [p[0] - self.at[0], p[1] - self.at[1]];
        let (deep, wide) = (dot(d, self.inward), dot(d, across));
        let (r, theta) = (deep.hypot(wide), wide.atan2(deep));
        let (sin, cos) = theta.sin_cos();
        let radial = [0, 1].map(|k| cos * self.inward[k] + sin * across[k]);
        let hoop = [0, 1].map(|k| cos * across[k] - sin * self.inward[k]);
        (r, theta, radial, hoop)
    }

    /// Chosen so that the surface sinks by -K ln r.
    fn displacement(&self, p: Vec2) -> Vec2 {
        let nu = self.poisson;
        let (k, c) = (2.0 * (1.0 - nu * nu) / PI, (1.0 + nu) / PI);
        let shear = (1.0 - 2.0 * nu) * c;
        let (r, theta, radial, hoop) = self.polar(p);
        let (sin, cos) = theta.sin_cos();
        let u = -k * cos * r.ln() - shear * theta * sin + c * cos;
        let v = k * sin * r.ln() + (2.0 * nu * c + shear - c) * sin - shear * theta * cos;
        [0, 1].map(|i| u * radial[i] + v * hoop[i])
    }

    /// sigma_rr = -2 cos(theta) / (pi r), all other stresses 0.
    fn traction(&self, p: Vec2, normal: Vec2) -> Vec2 {
        let (r, theta, radial, _) = self.polar(p);
        let size = -2.0 * theta.cos() / (PI * r) * dot(radial, normal);
        radial.map(|x| size * x)
    }
}

/// Stiffness of one quad8; `None` when it is inverted.
fn stiffness(x: [Vec2; NODES], nu: f64) -> Option<[[f64; 2 * NODES]; 2 * NODES]> {
    let scale = 1.0 / ((1.0 + nu) * (1.0 - 2.0 * nu));
    let (direct, cross, shear) = (scale * (1.0 - nu), scale * nu, scale * (0.5 - nu));
    let mut k = [[0.0; 2 * NODES]; 2 * NODES];
    let mut slopes = [[0.0; 2]; NODES];
    for xi in GAUSS_2 {
        for eta in GAUSS_2 {
            FaceKind::Quad8.shape_gradient([xi, eta], &mut slopes);
            let mut j = [[0.0; 2]; 2];
            for (p, s) in x.iter().zip(&slopes) {
                for (row, s) in j.iter_mut().zip(s) {
                    row[0] += s * p[0];
                    row[1] += s * p[1];
                }
            }
            let det = j[0][0] * j[1][1] - j[0][1] * j[1][0];
            if det <= 0.0 || det.is_nan() {
                return None;
            }
            let g = slopes.map(|[a, b]| [(j[1][1] * a - j[0][1] * b) / det, (j[0][0] * b - j[1][0] * a) / det]);
            for (m, p) in g.iter().enumerate() {
                for (n, q) in g.iter().enumerate() {
                    k[2 * m][2 * n] += det * (direct * p[0] * q[0] + shear * p[1] * q[1]);
                    k[2 * m][2 * n + 1] += det * (cross * p[0] * q[1] + shear * p[1] * q[0]);
                    k[2 * m + 1][2 * n] += det * (cross * p[1] * q[0] + shear * p[0] * q[1]);
                    k[2 * m + 1][2 * n + 1] += det * (direct * p[1] * q[1] + shear * p[0] * q[0]);
                }
            }
        }
    }
    Some(k)
}

fn dot(a: Vec2, b: Vec2) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}
