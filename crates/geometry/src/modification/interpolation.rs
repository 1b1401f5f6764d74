//! Bicubic interpolation with continuous slope over a grid with uneven steps.

/// Values on a grid; between them a cubic in either direction.
///
/// Tensor product of the one-dimensional Hermite cubic whose slope at each node is that of the parabola through the
/// node and its two neighbours (at the ends, through the last three nodes). The result is continuous with its first
/// derivatives, is linear in the values, and reproduces any polynomial of degree 2 in either direction. Outside the
/// grid it goes on along the tangent.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Bicubic {
    x: Vec<f64>,
    y: Vec<f64>,
    /// f, f_x, f_y, f_xy at the nodes, row by row (x slow, y fast).
    nodes: Vec<[f64; 4]>,
}

impl Bicubic {
    /// `x` and `y` strictly ascend and have at least two values each. `values` are stored row by row: x varies slowly,
    /// y fast.
    pub fn new(x: Vec<f64>, y: Vec<f64>, values: Vec<f64>) -> Self {
        let columns = y.len();
        let mut nodes: Vec<[f64; 4]> = values.iter().map(|&f| [f, 0.0, 0.0, 0.0]).collect();
        // f_y and f_x from f, f_xy from f_y.
        for row in nodes.chunks_mut(columns.max(1)) {
            let slopes = slopes(&y, row.iter().map(|n| n[0]).collect());
            row.iter_mut().zip(slopes).for_each(|(n, s)| n[2] = s);
        }
        for (from, to) in [(0, 1), (2, 3)] {
            for j in 0..columns {
                let column = nodes.iter().skip(j).step_by(columns).map(|n| n[from]).collect();
                let slopes = slopes(&x, column);
                nodes.iter_mut().skip(j).step_by(columns).zip(slopes).for_each(|(n, s)| n[to] = s);
            }
        }
        Self { x, y, nodes }
    }

    /// Number of grid lines in x and in y.
    pub fn lines(&self) -> [usize; 2] {
        [self.x.len(), self.y.len()]
    }

    /// Value and derivatives by x and y.
    pub fn at(&self, x: f64, y: f64) -> [f64; 3] {
        let (i, wx) = weights(&self.x, x);
        let (j, wy) = weights(&self.y, y);
        let mut sum = [0.0; 3];
        for (a, wx) in wx.iter().enumerate() {
            for (b, wy) in wy.iter().enumerate() {
                let [f, fx, fy, fxy] = self.nodes[(i + a) * self.y.len() + j + b];
                // wx: [value, slope] basis functions, then their derivatives.
                for (s, [cx, dx], [cy, dy]) in [(0, wx[0], wy[0]), (1, wx[1], wy[0]), (2, wx[0], wy[1])] {
                    sum[s] += cx * (cy * f + dy * fy) + dx * (cy * fx + dy * fxy);
                }
            }
        }
        sum
    }
}

/// Slopes of the parabolas through three neighbours.
fn slopes(x: &[f64], f: Vec<f64>) -> Vec<f64> {
    let n = x.len();
    let secant = |i: usize| (f[i + 1] - f[i]) / (x[i + 1] - x[i]);
    if n == 2 {
        return vec![secant(0); 2];
    }
    (0..n)
        .map(|i| {
            let k = i.clamp(1, n - 2);
            let (left, right) = (secant(k - 1), secant(k));
            let curvature = (right - left) / (x[k + 1] - x[k - 1]);
            // Newton's form about the middle node: f' = left + c (2 x_i - x_(k-1) - x_k).
            left + curvature * (2.0 * x[i] - x[k - 1] - x[k])
        })
        .collect()
}

/// Cell of `at`, and for either end of it [[value, slope] weights, their derivatives].
fn weights(x: &[f64], at: f64) -> (usize, [[[f64; 2]; 2]; 2]) {
    let last = x.len() - 1;
    if at <= x[0] {
        return (0, [[[1.0, at - x[0]], [0.0, 1.0]], [[0.0; 2]; 2]]);
    }
    if at >= x[last] {
        return (last - 1, [[[0.0; 2]; 2], [[1.0, at - x[last]], [0.0, 1.0]]]);
    }
    let i = x.partition_point(|v| *v <= at).clamp(1, last) - 1;
    let h = x[i + 1] - x[i];
    let t = (at - x[i]) / h;
    let s = 1.0 - t;
    let first = [[s * s * (1.0 + 2.0 * t), h * t * s * s], [-6.0 * t * s / h, s * (1.0 - 3.0 * t)]];
    let second = [[t * t * (3.0 - 2.0 * t), -h * t * t * s], [6.0 * t * s / h, t * (3.0 * t - 2.0)]];
    (i, [first, second])
}

#[cfg(test)]
mod tests {
    use super::Bicubic;

    fn grid(f: impl Fn(f64, f64) -> f64) -> Bicubic {
        let (x, y) = (vec![0.0, 0.3, 1.0, 1.2], vec![-2.0, -1.9, 0.5, 1.0, 3.0]);
        let values = x.iter().flat_map(|&x| y.iter().map(move |&y| (x, y))).map(|(x, y)| f(x, y)).collect();
        Bicubic::new(x, y, values)
    }

    /// Parabolas are reproduced on uneven steps, with their slopes.
    #[test]
    fn quadratics_are_exact() {
        let f = |x: f64, y: f64| (1.0 + 2.0 * x - 3.0 * x * x) * (0.5 - y + 0.25 * y * y);
        let g = grid(f);
        for (x, y) in [(0.1, -1.95), (0.3, 0.5), (0.7, 2.9), (1.19, -0.7), (1.2, 3.0), (0.0, -2.0)] {
            let [value, dx, dy] = g.at(x, y);
            let wanted =
                [f(x, y), (2.0 - 6.0 * x) * (0.5 - y + 0.25 * y * y), (1.0 + 2.0 * x - 3.0 * x * x) * (-1.0 + 0.5 * y)];
            for (a, b) in [value, dx, dy].iter().zip(wanted) {
                assert!((a - b).abs() < 1e-13 * (1.0 + b.abs()), "at ({x}, {y}): {a} not {b}");
            }
        }
    }

    /// Value and slopes do not jump at nodes, cell edges and the edge of the grid; nodes keep their values.
    #[test]
    fn slopes_are_continuous() {
        let f = |x: f64, y: f64| (3.0 * x).sin() * (2.0 * y).cos();
        let g = grid(f);
        for x in [0.0, 0.3, 0.77, 1.2] {
            for y in [-2.0, -1.9, 0.1, 1.0, 3.0] {
                let e = 1e-9;
                let here = g.at(x, y);
                for (a, b) in [(e, 0.0), (-e, 0.0), (0.0, e), (0.0, -e)] {
                    let there = g.at(x + a, y + b);
                    for k in 0..3 {
                        assert!((here[k] - there[k]).abs() < 1e-7, "at ({x}, {y}), quantity {k}");
                    }
                }
            }
        }
        assert!((g.at(0.3, 0.5)[0] - f(0.3, 0.5)).abs() < 1e-15);
    }

    /// Two lines in each direction make a bilinear patch.
    #[test]
    fn the_least_grid_is_bilinear() {
        let g = Bicubic::new(vec![0.0, 2.0], vec![0.0, 1.0], vec![0.0, 1.0, 2.0, 5.0]);
        assert!((g.at(1.0, 0.5)[0] - 2.0).abs() < 1e-15);
    }
}
