//! Bulk compliance of a body in few modes: what is left of a mesh's compliance when its local dents are taken away is smooth.

use faer::{Mat, MatRef, Side};

use crate::{Support, Vec3};

/// Low-rank form of the bulk compliance of one body.
///
/// ```text
/// D = W - sum over flanks of W_c  ~  Y Y',    0 <= D - Y Y'  (semi-definite)
/// ```
/// | name | shape   | unit        | meaning                                              |
/// |------|---------|-------------|------------------------------------------------------|
/// | D    | 3n x 3n | mm/N        | how far the centre surfaces of the teeth give way    |
/// | Y    | 3n x r  | sqrt(mm/N)  | modes; r about 40 for three teeth at 1e-4            |
///
/// A row with the support a sees phi = a' Y, and two rows see each other with phi_i phi_j'. Pivoted Cholesky (Harbrecht,
/// Peters, Schneider, Appl. Numer. Math. 62, 2012) finds a few more modes than needed, the eigenvectors of Y'Y the best of
/// them. What is left out is semi-definite, so no entry between two places is off by more than the larger of their own
/// errors: [`BulkModes::error`] bounds them all.
#[derive(Debug, Clone)]
pub struct BulkModes {
    /// Y, node by node x, y, z, each with the r modes side by side.
    modes: Vec<f64>,
    rank: usize,
    error: f64,
    scale: f64,
}

/// One body's compliance and what is to be taken away of it, to make [`BulkModes`] of.
#[derive(Debug, Clone)]
pub struct BulkCompliance<'a> {
    /// W, mm/N, 3n x 3n, node by node x, y, z.
    pub whole: MatRef<'a, f64>,
    /// W_c of each flank with the numbers its nodes have in W.
    pub halves: Vec<(&'a [u32], MatRef<'a, f64>)>,
    /// Direction of the contact forces at the nodes: unit normals of the flank, zero where none acts.
    pub normals: Vec<Vec3>,
    /// Largest tangential share of a force: friction, edges, and the turn of the normal between nodes.
    pub tangential: f64,
}

/// Error of the pivoted Cholesky relative to what is allowed in all.
const PIVOT_SHARE: f64 = 0.1;

impl BulkCompliance<'_> {
    /// Column `dof` of D.
    fn column(&self, dof: usize, out: &mut [f64]) {
        out.iter_mut().zip(self.whole.col(dof).iter()).for_each(|(o, w)| *o = *w);
        let (node, axis) = ((dof / 3) as u32, dof % 3);
        for (numbers, half) in &self.halves {
            let Ok(own) = numbers.binary_search(&node) else { continue };
            for (k, &number) in numbers.iter().enumerate() {
                for b in 0..3 {
                    out[3 * number as usize + b] -= half[(3 * k + b, 3 * own + axis)];
                }
            }
        }
    }

    /// Weighted directions that a node is looked at in: its normal and two tangents, the latter with their share.
    fn directions(&self, node: usize) -> [Vec3; 3] {
        let n = self.normals[node];
        let length = n.norm();
        if length == 0.0 {
            return [Vec3::zeros(); 3];
        }
        let n = n / length;
        let aside = if n.z.abs() < 0.9 { Vec3::z() } else { Vec3::x() };
        let t = n.cross(&aside).normalize();
        [n, self.tangential * t, self.tangential * n.cross(&t)]
    }

    /// d' D d at each node for each of its directions.
    fn diagonal(&self, directions: &[[Vec3; 3]]) -> Vec<[f64; 3]> {
        let block = |node: usize| -> [[f64; 3]; 3] {
            let mut d = [[0.0; 3]; 3];
            for (a, row) in d.iter_mut().enumerate() {
                for (b, v) in row.iter_mut().enumerate() {
                    *v = self.whole[(3 * node + a, 3 * node + b)];
                    for (numbers, half) in &self.halves {
                        if let Ok(own) = numbers.binary_search(&(node as u32)) {
                            *v -= half[(3 * own + a, 3 * own + b)];
                        }
                    }
                }
            }
            d
        };
        directions
            .iter()
            .enumerate()
            .map(|(node, of_node)| {
                let d = block(node);
                of_node.map(|v| (0..3).map(|a| (0..3).map(|b| v[a] * d[a][b] * v[b]).sum::<f64>()).sum())
            })
            .collect()
    }
}

impl BulkModes {
    /// The fewest modes with which no self-compliance of a node, in the direction of its normal (or along the flank, with the tangential
    /// share squared), is off by more than `tolerance` times the largest of them.
    pub fn new(bulk: &BulkCompliance<'_>, tolerance: f64) -> Self {
        let count = bulk.normals.len();
        let directions: Vec<[Vec3; 3]> = (0..count).map(|node| bulk.directions(node)).collect();
        let mut left = bulk.diagonal(&directions);
        let scale = left.iter().map(|d| d[0]).fold(0.0, f64::max);
        let allowed = tolerance * scale;
        let columns = pivoted(bulk, &directions, &mut left, PIVOT_SHARE * allowed);
        let missed = |left: &[[f64; 3]]| left.iter().flatten().fold(0.0f64, |m, e| m.max(*e));
        let found = columns.len();
        let y = Mat::from_fn(3 * count, found, |i, m| columns[m][i]);
        // Best combinations first: eigenvectors of the weighted Y'Y.
        let weighted = Mat::from_fn(3 * count, found, |i, m| seen(&columns[m], i / 3, &directions[i / 3][i % 3]));
        let gram = weighted.transpose() * &weighted;
        let Ok(eigen) = gram.self_adjoint_eigen(Side::Lower) else {
            return Self::of(y.as_ref(), found, missed(&left), scale);
        };
        // Ascending: the least mode first.
        let (turned, basis) = (&weighted * eigen.U(), eigen.U());
        let mut dropped = 0;
        let mut error = missed(&left);
        for m in 0..found {
            for (i, e) in left.iter_mut().flatten().enumerate() {
                *e += turned[(i, m)] * turned[(i, m)];
            }
            let now = missed(&left);
            if now > allowed {
                break;
            }
            (dropped, error) = (m + 1, now);
        }
        let kept = &y * basis.subcols(dropped, found - dropped);
        Self::of(kept.as_ref(), found - dropped, error, scale)
    }

    fn of(y: MatRef<'_, f64>, rank: usize, error: f64, scale: f64) -> Self {
        let modes = (0..y.nrows()).flat_map(|i| (0..rank).map(move |m| y[(i, m)])).collect();
        Self { modes, rank, error, scale }
    }

    /// Number of modes r.
    pub fn rank(&self) -> usize {
        self.rank
    }

    /// Largest error of a self-compliance at the nodes relative to the largest self-compliance.
    pub fn error(&self) -> f64 {
        if self.scale > 0.0 { self.error / self.scale } else { 0.0 }
    }

    /// Adds a' Y to `phi` (r values) for a unit force at a support, in its direction of the opening or, with friction, of its load.
    pub fn project(&self, support: &Support, direction: &Vec3, phi: &mut [f64]) {
        let r = self.rank;
        for (&node, &w) in support.nodes[..support.count].iter().zip(&support.weights) {
            let at = 3 * node as usize * r;
            let Some(of_node) = self.modes.get(at..at + 3 * r) else { continue };
            let (x, rest) = of_node.split_at(r);
            let (y, z) = rest.split_at(r);
            let d = w * direction;
            for (((p, x), y), z) in phi.iter_mut().zip(x).zip(y).zip(z) {
                *p += d.x * x + d.y * y + d.z * z;
            }
        }
    }
}

/// Component along `direction` of what a column says of a node.
fn seen(column: &[f64], node: usize, direction: &Vec3) -> f64 {
    direction.x * column[3 * node] + direction.y * column[3 * node + 1] + direction.z * column[3 * node + 2]
}

/// Columns of the pivoted Cholesky factor until no entry of the diagonal `left` exceeds `allowed`.
fn pivoted(
    bulk: &BulkCompliance<'_>,
    directions: &[[Vec3; 3]],
    left: &mut [[f64; 3]],
    allowed: f64,
) -> Vec<Vec<f64>> {
    let dofs = 3 * directions.len();
    let mut columns: Vec<Vec<f64>> = Vec::new();
    let mut part = vec![0.0; dofs];
    while columns.len() < dofs {
        let all = left.iter().enumerate().flat_map(|(node, of)| of.iter().enumerate().map(move |(k, &e)| (e, node, k)));
        // The first of equals, so that the choice is the same everywhere.
        let best = all.fold((0.0, 0, 0), |best, one| if one.0 > best.0 { one } else { best });
        let (pivot, node, k) = best;
        if pivot <= allowed || pivot.is_nan() {
            break;
        }
        let d = directions[node][k];
        let mut column = vec![0.0; dofs];
        for axis in 0..3 {
            bulk.column(3 * node + axis, &mut part);
            column.iter_mut().zip(&part).for_each(|(c, p)| *c += d[axis] * p);
        }
        for before in &columns {
            let share = seen(before, node, &d);
            column.iter_mut().zip(before).for_each(|(c, b)| *c -= share * b);
        }
        let own = seen(&column, node, &d);
        if own <= 0.0 {
            // Round-off: nothing is left here.
            left[node][k] = 0.0;
            continue;
        }
        let root = own.sqrt();
        column.iter_mut().for_each(|c| *c /= root);
        for (node, of_node) in left.iter_mut().enumerate() {
            for (e, d) in of_node.iter_mut().zip(&directions[node]) {
                let s = seen(&column, node, d);
                *e = (*e - s * s).max(0.0);
            }
        }
        left[node][k] = 0.0;
        columns.push(column);
    }
    columns
}
