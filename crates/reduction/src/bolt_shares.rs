//! Bolts as forces on the freedoms under them. Theory (13g).

use faer::Mat;
use mesh::{BoltPoint, Bolts};
use nalgebra::Vector3;

/// First of the three freedoms of a node in a copy of a sector.
pub(crate) type FreedomsOf<'a> = &'a dyn Fn(u32, u32) -> Option<usize>;

/// What bolts do on some freedoms.
#[derive(Debug)]
pub(crate) struct BoltShares {
    /// Forces by 1 N of each bolt along its radius, spread evenly, m x bolts.
    pub along: Mat<f64>,
    /// Forces of the springs of each bolt that do not open, along radius, circumference and axis, by displacements of -1 mm, N/mm,
    /// 3 bolts x m.
    pub springs: Mat<f64>,
}

impl BoltShares {
    /// Of points of bolts; `rows` are the three freedoms of a node of a copy among `count`, and `way` is -1 for a gear that is
    /// pressed inwards.
    pub fn new((bolts, points): (&Bolts, &[BoltPoint]), (count, rows): (usize, FreedomsOf<'_>), way: f64) -> Self {
        let number = bolts.count as usize;
        let (mut along, mut springs) = (Mat::zeros(count, number), Mat::zeros(3 * number, count));
        for point in points {
            let radius = Vector3::new(point.position.x, point.position.y, 0.0).normalize();
            let axes = [way * radius, Vector3::z().cross(&radius), Vector3::z()];
            for (&node, share) in point.spring.face.nodes().iter().zip(point.spring.shape) {
                let Some(row) = rows(point.copy, node) else { continue };
                for k in 0..3 {
                    along[(row + k, point.bolt)] += point.share * share * axes[0][k];
                    for (axis, direction) in axes.iter().enumerate() {
                        springs[(3 * point.bolt + axis, row + k)] += share * (point.spring.stiffness * direction)[k];
                    }
                }
            }
        }
        Self { along, springs }
    }
}

/// Stiffness of the springs that do not open on so many freedoms (N/mm); `rows` are the three of a node of a copy.
pub(crate) fn springs(points: &[BoltPoint], count: usize, rows: FreedomsOf<'_>) -> Mat<f64> {
    let mut stiffness = Mat::zeros(count, count);
    for point in points {
        let spring = &point.spring;
        let nodes = || spring.face.nodes().iter().zip(spring.shape).map(|(&n, share)| (rows(point.copy, n), share));
        for ((to, a), (from, b)) in nodes().flat_map(|x| nodes().map(move |y| (x, y))) {
            let (Some(to), Some(from)) = (to, from) else { continue };
            for (i, j) in (0..3).flat_map(|i| (0..3).map(move |j| (i, j))) {
                stiffness[(to + i, from + j)] += a * b * spring.stiffness[(i, j)];
            }
        }
    }
    stiffness
}
