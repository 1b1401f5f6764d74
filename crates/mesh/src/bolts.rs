//! Springs at some places of a bore: bolts, keys, teeth of a spline. Theory (13d).

use std::f64::consts::TAU;

use nalgebra::{Matrix2, Vector2, Vector3};

use crate::{Face, FaceKind, Mesh, MeshError, SpringPoint, gauss_legendre, spring_point::along_cylinder};

/// Equal springs evenly around a bore, each spread over a rectangle of it.
///
/// ```text
/// k = K/(w h)     N/mm^3 on an arc w by a height h about each place; 0 elsewhere
/// ```
/// Bolts that open have no such spring along the radius: each presses there with one force N, spread evenly, and does not pull,
/// theory (38c).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bolts {
    /// Number.
    pub count: u32,
    /// Angle of the middle of the first one, counter-clockwise from +x in the gear's own frame, rad.
    pub first_angle: f64,
    /// Arc w on the bore, mm.
    pub width: f64,
    /// Lower and upper end along z, mm; `None`: those of the held faces.
    pub heights: Option<[f64; 2]>,
    /// Radial, tangential and axial stiffness K of each, N/mm.
    pub stiffness: [f64; 3],
    /// Force (N) that presses each along its radius before any load, where each opens; `None`: none opens.
    pub opens_beyond: Option<f64>,
}

/// A point of a bolt.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BoltPoint {
    /// Number of the bolt, from 0.
    pub bolt: usize,
    /// Copy of the mesh that has the face: the mesh turned by so many pitches.
    pub copy: u32,
    /// Share of the point in the bolt's rectangle; of all points of a bolt the sum is 1.
    pub share: f64,
    /// Place, mm, in the frame of the copy.
    pub position: Vector3<f64>,
    /// Face of the mesh, shape functions, and stiffness of the springs that do not open, in the frame of the copy.
    pub spring: SpringPoint,
}

/// Points of Gauss's rule on a stretch.
const POINTS: usize = 2;
/// Stretches of a bolt along the side of a face of the mesh.
const STRETCHES: f64 = 2.0;
/// Steps with which a point of a face is found, at most: Newton's method doubles the digits.
const STEPS: usize = 20;
/// How far outside of a face, in its own coordinates from -1 to 1, a point on its edge may be found.
const EDGE: f64 = 1e-9;

impl Bolts {
    /// Springs along radius, circumference and axis that do not open, N/mm.
    pub(crate) fn closed_stiffness(&self) -> [f64; 3] {
        let [radial, tangential, axial] = self.stiffness;
        [if self.opens_beyond.is_some() { 0.0 } else { radial }, tangential, axial]
    }

    /// Points of all bolts on the faces of a bore, bolt by bolt. The mesh has some of the faces of the gear, which its `copies`
    /// have all together, each turned by `pitch` (rad) from the one before.
    ///
    /// # Errors
    /// [`MeshError::BoltOffBore`] if a bolt reaches beyond the faces; [`MeshError::BoltsOverlap`].
    pub fn points(
        &self,
        mesh: &Mesh,
        faces: &[Face],
        (copies, pitch): (u32, f64),
    ) -> Result<Vec<BoltPoint>, MeshError> {
        let nodes = || faces.iter().flat_map(Face::nodes).map(|&n| mesh.nodes[n as usize]);
        let count = nodes().count().max(1) as f64;
        let radius = nodes().map(|[x, y, _]| x.hypot(y)).sum::<f64>() / count;
        let area: f64 = faces.iter().flat_map(|face| face.area_points(mesh)).map(|point| point.area).sum();
        let side = (area / faces.len().max(1) as f64).sqrt();
        let [from, to] = self.heights.unwrap_or_else(|| {
            nodes().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], [_, _, z]| [low.min(z), high.max(z)])
        });
        let widest = nodes().map(|[x, y, _]| x.hypot(y)).fold(0.0, f64::max);
        let (taken, around) = (f64::from(self.count) * self.width, TAU * widest);
        if taken > around * (1.0 + EDGE) {
            return Err(MeshError::BoltsOverlap { count: self.count, taken_mm: taken, around_mm: around });
        }
        let heights = stretched([from, to], side);
        let arcs = stretched([-0.5 * self.width, 0.5 * self.width], side);
        let mut all = Vec::with_capacity(self.count as usize * arcs.len() * heights.len());
        // The copy of the last point is tried first: of a helical mesh any may have the next one.
        let mut last = 0;
        for bolt in 0..self.count {
            let middle = self.first_angle + TAU * f64::from(bolt) / f64::from(self.count);
            for (&(arc, wide), &(z, high)) in arcs.iter().flat_map(|a| heights.iter().map(move |h| (a, h))) {
                let angle = middle + arc / radius;
                let on = |copy: u32| {
                    let own = angle - pitch * f64::from(copy);
                    faces.iter().find_map(|face| Some((copy, *face, at(mesh, face, own, z)?)))
                };
                let found = (0..copies).find_map(|k| on((last + k) % copies));
                let Some((copy, face, (shape, position))) = found else {
                    return Err(MeshError::BoltOffBore { bolt, angle_deg: angle.to_degrees(), z_mm: z });
                };
                last = copy;
                let share = wide * high;
                let stiffness = share * along_cylinder(self.closed_stiffness(), position);
                let spring = SpringPoint { face, shape, stiffness };
                all.push(BoltPoint { bolt: bolt as usize, copy, share, position, spring });
            }
        }
        Ok(all)
    }
}

/// Points between two ends, and their shares, which sum up to 1.
fn stretched([from, to]: [f64; 2], side: f64) -> Vec<(f64, f64)> {
    let count = (STRETCHES * (to - from) / side).ceil().max(1.0);
    let length = (to - from) / count;
    let points = gauss_legendre(POINTS);
    let of_stretch = |i: usize| {
        let start = from + i as f64 * length;
        points.iter().map(move |&(x, w)| (start + 0.5 * (1.0 + x) * length, 0.5 * w / count)).collect::<Vec<_>>()
    };
    (0..count as usize).flat_map(of_stretch).collect()
}

/// Shape functions and place of the point of a face at an angle (rad) about z and a height (mm); `None` if it is not on it.
fn at(mesh: &Mesh, face: &Face, angle: f64, z: f64) -> Option<([f64; 9], Vector3<f64>)> {
    let nodes: Vec<Vector3<f64>> = face.nodes().iter().map(|&n| Vector3::from(mesh.nodes[n as usize])).collect();
    let off = |x: &Vector3<f64>| {
        let turn = x.y.atan2(x.x) - angle;
        Vector2::new(x.xy().norm() * (turn - TAU * (turn / TAU).round()), x.z - z)
    };
    // Not far off: inside of the box about the nodes, and as far again on either side, as edges are curved.
    let ends = |k: usize| {
        nodes.iter().map(|x| off(x)[k]).fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], v| [a.min(v), b.max(v)])
    };
    if [0, 1].map(ends).into_iter().any(|[low, high]| low > high - low || -high > high - low) {
        return None;
    }
    let triangle = matches!(face.kind, FaceKind::Tri3 | FaceKind::Tri6);
    let (mut xi, mut shape, mut slope) = (if triangle { [1.0 / 3.0; 2] } else { [0.0; 2] }, [0.0; 9], [[0.0; 2]; 9]);
    for _ in 0..STEPS {
        face.kind.shape(xi, &mut shape);
        face.kind.shape_gradient(xi, &mut slope);
        let x: Vector3<f64> = nodes.iter().zip(shape).map(|(node, n)| n * node).sum();
        let tangent = |k: usize| nodes.iter().zip(slope).map(|(node, d)| d[k] * node).sum::<Vector3<f64>>();
        let along = Vector3::new(-x.y, x.x, 0.0) / x.xy().norm();
        let columns = [0, 1].map(tangent).map(|t| Vector2::new(along.dot(&t), t.z));
        let step = Matrix2::from_columns(&columns).try_inverse()? * off(&x);
        xi = [xi[0] - step.x, xi[1] - step.y];
        if step.amax() < EDGE {
            let [a, b] = xi;
            let inside = if triangle {
                a > -EDGE && b > -EDGE && a + b < 1.0 + EDGE
            } else {
                a.abs() < 1.0 + EDGE && b.abs() < 1.0 + EDGE
            };
            return inside.then_some((shape, x));
        }
    }
    None
}
