//! Contact points: quadrature points of the flank faces of body 1.

use mesh::{FaceKind, gauss_legendre};

use crate::{
    Vec3,
    flank::{FacePoint, FlankPatch, GapSource},
};

/// One contact point of a patch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactPoint {
    /// Position of the point on the faces.
    pub at: FacePoint,
    /// Surface coordinates.
    pub coordinates: [f64; 2],
    /// Position in the body's own frame, mm: on the smooth surface, or on the facet.
    pub position: Vec3,
    /// Area that the point represents, mm^2.
    pub area: f64,
}

/// Gauss points of all faces, `per_edge` x `per_edge` per face, face by face.
///
/// All weights are positive. A uniform pressure gives consistent nodal forces if there are at least 2 (linear) or 3
/// (quadratic faces) points per edge; 6 are sufficient in every case. A band narrower than an element then contains
/// several points, and on faces finer than the band the nodal pressure converges to Hertz's
/// (`crates/contact/tests/contact_laws/hertz.rs`). A single point per face does not determine the alternating pressure:
/// it is 20 to 40 % off, at any refinement.
pub fn contact_points(patch: &FlankPatch, per_edge: usize, source: GapSource) -> Vec<ContactPoint> {
    let gauss = gauss_legendre(per_edge.max(1));
    let mut points = Vec::with_capacity(patch.face_count() * gauss.len() * gauss.len());
    for face in 0..patch.face_count() {
        for &(x, wx) in &gauss {
            for &(y, wy) in &gauss {
                let (xi, weight) = match patch.face_kind(face) {
                    FaceKind::Tri3 | FaceKind::Tri6 => {
                        // Square collapsed to the triangle: x' = (1+x)/2, y' = (1-x')(1+y)/2.
                        let (s, t) = (0.5 * (1.0 + x), 0.5 * (1.0 + y));
                        ([s, (1.0 - s) * t], 0.25 * wx * wy * (1.0 - s))
                    }
                    FaceKind::Quad4 | FaceKind::Quad8 | FaceKind::Quad9 => ([x, y], wx * wy),
                };
                let at = FacePoint { face, xi };
                let coordinates = patch.coordinates(at);
                let position = match source {
                    GapSource::Smooth => patch.surface().point(coordinates),
                    GapSource::Facet => patch.facet_point(at),
                };
                points.push(ContactPoint { at, coordinates, position, area: weight * patch.area_ratio(at) });
            }
        }
    }
    points
}
