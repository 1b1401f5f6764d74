//! Line contact in plane strain with the band resolved: the reference that closed forms of it are held against.
//!
//! Nothing of the library's local compliance is used: fully integrated quad8 on a lattice that is fine at the band,
//! pressure linear between the nodes, gap and pressure complementary in the mean with the pressure's own shape
//! functions.

use faer::{Mat, linalg::solvers::Solve};
use fem::{BoundaryLastFactor, SymmetricMatrix};
use mesh::FaceKind;

/// A point of the section, mm.
pub type Vec2 = [f64; 2];

/// A body of `rows` x `columns` half elements (even numbers); column 0 is the loaded surface.
pub struct Lattice<'a> {
    pub rows: usize,
    pub columns: usize,
    /// Right-handed: columns inwards turned by -90 degrees from rows, or the other way round; found by itself.
    pub point: &'a dyn Fn(usize, usize) -> Vec2,
    pub clamped: &'a dyn Fn(usize, usize) -> bool,
    pub young: f64,
    pub poisson: f64,
}

impl Lattice<'_> {
    fn carries(row: usize, column: usize) -> bool {
        row.is_multiple_of(2) || column.is_multiple_of(2)
    }

    /// Compliance (mm^2/N) of the surface nodes in rows `first..=last` along the directions `inward`.
    pub fn compliance(&self, first: usize, last: usize, inward: &[Vec2]) -> Mat<f64> {
        let (rows, columns) = (self.rows, self.columns);
        let mut place = vec![None; (rows + 1) * (columns + 1)];
        let mut count = 0;
        for row in 0..=rows {
            for column in 0..=columns {
                if Self::carries(row, column) && !(self.clamped)(row, column) {
                    place[row * (columns + 1) + column] = Some(count);
                    count += 2;
                }
            }
        }
        let mut triplets = Vec::new();
        for row in (0..rows).step_by(2) {
            for column in (0..columns).step_by(2) {
                let offsets = [[0, 0], [2, 0], [2, 2], [0, 2], [1, 0], [2, 1], [1, 2], [0, 1]];
                let at = offsets.map(|[r, c]| (row + r, column + c));
                let k = self.stiffness(at.map(|(r, c)| (self.point)(r, c)));
                let dofs = at.map(|(r, c)| place[r * (columns + 1) + c]);
                for (i, di) in dofs.iter().enumerate() {
                    for (j, dj) in dofs.iter().enumerate() {
                        let (Some(di), Some(dj)) = (di, dj) else { continue };
                        for (a, b) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                            if dj + b <= di + a {
                                triplets.push((di + a, dj + b, k[2 * i + a][2 * j + b]));
                            }
                        }
                    }
                }
            }
        }
        let matrix = SymmetricMatrix::from_triplets(count, &triplets).unwrap();
        let kept: Vec<usize> = (first..=last)
            .flat_map(|row| {
                let dof = place[row * (columns + 1)].unwrap_or_else(|| panic!("row {row} is clamped"));
                [dof, dof + 1]
            })
            .collect();
        let c = BoundaryLastFactor::new(&matrix, &kept).unwrap().compliance();
        let n = last - first + 1;
        Mat::from_fn(n, n, |i, j| {
            (0..4).map(|k| inward[i][k / 2] * c[(2 * i + k / 2, 2 * j + k % 2)] * inward[j][k % 2]).sum()
        })
    }

    fn stiffness(&self, x: [Vec2; 8]) -> [[f64; 16]; 16] {
        let nu = self.poisson;
        let scale = self.young / ((1.0 + nu) * (1.0 - 2.0 * nu));
        let (direct, cross, shear) = (scale * (1.0 - nu), scale * nu, scale * (0.5 - nu));
        let mut k = [[0.0; 16]; 16];
        let mut slopes = [[0.0; 2]; 8];
        for point in FaceKind::Quad8.quadrature() {
            FaceKind::Quad8.shape_gradient(point.xi, &mut slopes);
            let mut j = [[0.0; 2]; 2];
            for (p, s) in x.iter().zip(&slopes) {
                for a in 0..2 {
                    for b in 0..2 {
                        j[a][b] += s[a] * p[b];
                    }
                }
            }
            let det = j[0][0] * j[1][1] - j[0][1] * j[1][0];
            let g = slopes.map(|[a, b]| [(j[1][1] * a - j[0][1] * b) / det, (j[0][0] * b - j[1][0] * a) / det]);
            let w = det.abs() * point.weight;
            for (m, p) in g.iter().enumerate() {
                for (n, q) in g.iter().enumerate() {
                    k[2 * m][2 * n] += w * (direct * p[0] * q[0] + shear * p[1] * q[1]);
                    k[2 * m][2 * n + 1] += w * (cross * p[0] * q[1] + shear * p[1] * q[0]);
                    k[2 * m + 1][2 * n] += w * (cross * p[1] * q[0] + shear * p[0] * q[1]);
                    k[2 * m + 1][2 * n + 1] += w * (direct * p[1] * q[1] + shear * p[0] * q[0]);
                }
            }
        }
        k
    }
}

/// Integrals of the pressure's shape functions (linear between nodes) times the elements' (quadratic) over the surface
/// with nodes at `x` (element ends and middles by turns, an end first): nodes x pressures.
pub fn loads(x: &[f64]) -> Mat<f64> {
    let mut b = Mat::zeros(x.len(), x.len());
    let gauss = [(-0.6f64.sqrt(), 5.0 / 9.0), (0.0, 8.0 / 9.0), (0.6f64.sqrt(), 5.0 / 9.0)];
    for e in (0..x.len() - 1).step_by(2) {
        for half in 0..2 {
            let length = x[e + half + 1] - x[e + half];
            for (g, w) in gauss {
                let t = 0.5 * (g + 1.0);
                let xi = -1.0 + half as f64 + t;
                let n = [0.5 * xi * (xi - 1.0), 1.0 - xi * xi, 0.5 * xi * (xi + 1.0)];
                for (i, n) in n.iter().enumerate() {
                    b[(e + i, e + half)] += 0.5 * w * length.abs() * n * (1.0 - t);
                    b[(e + i, e + half + 1)] += 0.5 * w * length.abs() * n * t;
                }
            }
        }
    }
    b
}

/// A solved line contact.
pub struct Band {
    pub approach: f64,
    /// Pressure at every node, MPa.
    pub pressure: Vec<f64>,
    /// Weights that sum pressure to load.
    pub weights: Vec<f64>,
}

/// Contact of bodies whose compliances at the nodes `x` sum to `compliance`, under a line load q (N/mm), with an
/// initial gap.
pub fn press(x: &[f64], compliance: &Mat<f64>, gap: impl Fn(f64) -> f64, q: f64) -> Band {
    let b = loads(x);
    let n = x.len();
    let c = b.transpose() * compliance * &b;
    let nodes: Vec<f64> = x.iter().map(|&x| gap(x)).collect();
    // The mean gap of each pressure function: quadratic between nodes as the displacements are.
    let gaps: Vec<f64> = (0..n).map(|j| (0..n).map(|i| b[(i, j)] * nodes[i]).sum()).collect();
    let weights: Vec<f64> = (0..n).map(|j| (0..n).map(|i| b[(i, j)]).sum()).collect();
    let mut active: Vec<bool> = {
        let least = nodes.iter().copied().fold(f64::INFINITY, f64::min);
        let reach = 4.0 * q * (c[(n / 2, n / 2)] / (weights[n / 2] * weights[n / 2])).abs();
        nodes.iter().map(|g| g - least < reach).collect()
    };
    for _ in 0..200 {
        let on: Vec<usize> = (0..n).filter(|&i| active[i]).collect();
        let m = on.len();
        let system = Mat::from_fn(m + 1, m + 1, |i, j| match (i < m, j < m) {
            (true, true) => c[(on[i], on[j])],
            (true, false) => -weights[on[i]],
            (false, true) => -weights[on[j]],
            _ => 0.0,
        });
        let rhs = Mat::from_fn(m + 1, 1, |i, _| if i < m { -gaps[on[i]] } else { -q });
        let answer = system.partial_piv_lu().solve(&rhs);
        let mut pressure = vec![0.0; n];
        on.iter().enumerate().for_each(|(k, &i)| pressure[i] = answer[(k, 0)]);
        let approach = answer[(m, 0)];
        let next: Vec<bool> = (0..n)
            .map(|i| {
                if active[i] {
                    pressure[i] > 0.0
                } else {
                    let open: f64 = on.iter().map(|&k| c[(i, k)] * pressure[k]).sum::<f64>() + gaps[i];
                    open < approach * weights[i] * (1.0 - 1e-12)
                }
            })
            .collect();
        if next == active {
            return Band { approach, pressure, weights };
        }
        active = next;
    }
    panic!("the band of {q} N/mm does not settle");
}

/// Dent in the middle of a Hertzian band of half-width `a` about x = 0, mm.
pub fn under_hertz(x: &[f64], compliance: &Mat<f64>, a: f64, q: f64) -> f64 {
    let b = loads(x);
    let n = x.len();
    let mut p: Vec<f64> = x.iter().map(|x| (1.0 - (x / a).powi(2)).max(0.0).sqrt()).collect();
    let total: f64 = (0..n).map(|j| (0..n).map(|i| b[(i, j)]).sum::<f64>() * p[j]).sum();
    p.iter_mut().for_each(|p| *p *= q / total);
    let middle = (0..n).min_by(|&i, &j| x[i].abs().total_cmp(&x[j].abs())).unwrap();
    (0..n).map(|j| p[j] * (0..n).map(|i| compliance[(middle, i)] * b[(i, j)]).sum::<f64>()).sum()
}

/// Positions from `start` to `end`: `fine` (element ends and middles by turns) inside, outside it elements that grow by
/// `growth` up to `largest`.
pub fn graded(start: f64, fine: &[f64], end: f64, growth: f64, largest: f64) -> Vec<f64> {
    let (low, high) = (fine[0], fine[fine.len() - 1]);
    let out = |from: f64, to: f64, first: f64| -> Vec<f64> {
        let (mut steps, mut sum, mut step) = (Vec::new(), 0.0, first);
        while sum < (to - from).abs() - 1e-9 {
            step = (step * growth).min(largest);
            steps.push(step);
            sum += step;
        }
        let mut at = from;
        let scale = (to - from) / sum.max(1e-300);
        steps
            .iter()
            .flat_map(|s| {
                let before = at;
                at += s * scale;
                [0.5 * (before + at), at]
            })
            .collect()
    };
    let mut all: Vec<f64> = out(low, start, fine[2] - fine[0]).into_iter().rev().collect();
    all.extend(fine);
    all.extend(out(high, end, high - fine[fine.len() - 3]));
    all
}

/// Ends and middles of elements of about `h` from `low` to `high`.
pub fn even(low: f64, high: f64, h: f64) -> Vec<f64> {
    let count = 2 * ((high - low) / h - 1e-9).ceil().max(1.0) as usize;
    (0..=count).map(|i| low + (high - low) * i as f64 / count as f64).collect()
}
