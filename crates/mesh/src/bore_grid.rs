//! Pressures on a bore, as rolling elements make them: hats on an even grid over it. Theory (13e).

use std::{collections::BTreeMap, f64::consts::TAU};

use nalgebra::{Vector3, Vector6};

use crate::{Face, FaceKind, Mesh, gauss_legendre};

/// Radial pressures on the held faces of a bore: of station a and height h
///
/// ```text
/// p = hat_a(angle) hat_h(z),   f_i = integral of N_i p e_r dA      angles 2 pi a/stations, heights from end to end
/// ```
/// N: shape functions of the faces. Such a pressure has no moment about the axis. Of a whole gear with stations by equal
/// numbers in each pitch, pressures of sectors are alike.
#[derive(Debug, Clone, PartialEq)]
pub struct BoreGrid {
    /// Number of stations around, counter-clockwise from +x in the gear's own frame.
    pub stations: usize,
    /// Number of heights.
    pub heights: usize,
    /// Mean radius of the faces, mm.
    pub radius: f64,
    /// Lower and upper end of the faces along z, mm.
    pub ends: [f64; 2],
    /// Forces (N) on nodes under a unit pressure, 1 MPa at the peak of the hat: height by height of each station in turn.
    pub loads: Vec<Vec<(u32, [f64; 3])>>,
    /// Their resultants: force (N) and moment about the origin (N mm).
    pub resultants: Vec<Vector6<f64>>,
}

/// Points of Gauss's rule on a part of a face.
const POINTS: usize = 2;
/// Parts of a face along the shorter side of a hat.
const PARTS: f64 = 3.0;

impl BoreGrid {
    /// Grid over the held faces of a bore, with `stations` around the whole gear and at least two heights; over those of a
    /// sector pressures that do not reach it are empty.
    pub fn new(mesh: &Mesh, faces: &[Face], stations: usize, heights: usize) -> Self {
        let nodes = || faces.iter().flat_map(Face::nodes).map(|&n| Vector3::from(mesh.nodes[n as usize]));
        let ends = nodes().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x.z), high.max(x.z)]);
        let heights = heights.max(2);
        let count = stations * heights;
        let mut loads: Vec<BTreeMap<u32, [f64; 3]>> = vec![BTreeMap::new(); count];
        let mut resultants = vec![Vector6::zeros(); count];
        let (mut area, mut by_radius) = (0.0, 0.0);
        let (pitch, high) = (TAU / stations as f64, (ends[1] - ends[0]) / (heights - 1) as f64);
        for face in faces {
            for point in points(mesh, face, [pitch, high]) {
                let (x, own) = (point.position, point.area);
                let radius = x.xy().norm();
                (area, by_radius) = (area + own, by_radius + own * radius);
                let outward = Vector3::new(x.x, x.y, 0.0) / radius.max(f64::MIN_POSITIVE);
                let around = x.y.atan2(x.x).rem_euclid(TAU) / pitch;
                let along = ((x.z - ends[0]) / high).clamp(0.0, (heights - 1) as f64);
                for ((a, by_angle), (h, by_height)) in
                    hats(around).into_iter().flat_map(|a| hats(along).map(move |h| (a, h)))
                {
                    let pressed = by_angle * by_height * own * outward;
                    if h >= heights || by_angle * by_height == 0.0 {
                        continue;
                    }
                    let at = (a % stations) * heights + h;
                    let moment = x.cross(&pressed);
                    resultants[at] += Vector6::from_fn(|k, _| if k < 3 { pressed[k] } else { moment[k - 3] });
                    for (&node, share) in face.nodes().iter().zip(point.shape) {
                        let sum = loads[at].entry(node).or_default();
                        (0..3).for_each(|k| sum[k] += share * pressed[k]);
                    }
                }
            }
        }
        let loads = loads.into_iter().map(|load| load.into_iter().collect()).collect();
        Self { stations, heights, radius: by_radius / area, ends, loads, resultants }
    }

    /// Number of pressures.
    pub fn count(&self) -> usize {
        self.loads.len()
    }

    /// Angle of a station, rad.
    pub fn angle(&self, station: usize) -> f64 {
        TAU * station as f64 / self.stations as f64
    }
}

/// A point of a face.
struct Point {
    shape: [f64; 9],
    position: Vector3<f64>,
    area: f64,
}

/// Both hats over a place that is counted in spacings, and their heights.
fn hats(place: f64) -> [(usize, f64); 2] {
    let low = place.floor();
    [(low as usize, 1.0 - (place - low)), (low as usize + 1, place - low)]
}

/// Points of a face on parts that are smaller than hats of some width (rad) and height (mm).
fn points(mesh: &Mesh, face: &Face, [width, height]: [f64; 2]) -> Vec<Point> {
    let nodes: Vec<Vector3<f64>> = face.nodes().iter().map(|&n| Vector3::from(mesh.nodes[n as usize])).collect();
    let first = nodes[0].xy();
    let across = |x: &Vector3<f64>| (first.x * x.y - first.y * x.x).atan2(first.dot(&x.xy()));
    let extent = |of: &dyn Fn(&Vector3<f64>) -> f64| {
        let [low, high] =
            nodes.iter().map(of).fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], v| [a.min(v), b.max(v)]);
        high - low
    };
    let parts = (PARTS * (extent(&across) / width).max(extent(&|x| x.z) / height)).ceil().max(1.0);
    let triangle = matches!(face.kind, FaceKind::Tri3 | FaceKind::Tri6);
    let rule = gauss_legendre(POINTS);
    let of_part = |i: usize| {
        let on = move |x: f64| (i as f64 + 0.5 * (1.0 + x)) / parts;
        rule.iter().map(move |&(x, w)| (on(x), 0.5 * w / parts)).collect::<Vec<_>>()
    };
    let line: Vec<(f64, f64)> = (0..parts as usize).flat_map(of_part).collect();
    let mut all = Vec::with_capacity(line.len().pow(2));
    for (&(u, a), &(v, b)) in line.iter().flat_map(|a| line.iter().map(move |b| (a, b))) {
        // A square, folded for triangles.
        let (xi, weight) = if triangle {
            ([u, v * (1.0 - u)], a * b * (1.0 - u))
        } else {
            ([2.0 * u - 1.0, 2.0 * v - 1.0], 4.0 * a * b)
        };
        let (mut shape, mut slope) = ([0.0; 9], [[0.0; 2]; 9]);
        face.kind.shape(xi, &mut shape);
        face.kind.shape_gradient(xi, &mut slope);
        let position = nodes.iter().zip(shape).map(|(x, n)| n * x).sum();
        let tangent = |k: usize| nodes.iter().zip(slope).map(|(x, d)| d[k] * x).sum::<Vector3<f64>>();
        all.push(Point { shape, position, area: weight * tangent(0).cross(&tangent(1)).norm() });
    }
    all
}
