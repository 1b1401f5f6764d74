//! Position of a point of the smooth surface on the faces.

use mesh::FaceKind;

use super::{FacePoint, FlankPatch};

impl FlankPatch {
    /// The face point with the given surface coordinates; `None` outside the patch.
    ///
    /// Newton on the isoparametric map of surface coordinates, in the faces that cover the spot.
    pub(crate) fn face_at(&self, at: [f64; 2]) -> Option<FacePoint> {
        self.bins.around(at)?.iter().find_map(|&face| {
            let xi = self.invert(face as usize, at)?;
            inside(self.faces[face as usize].kind, xi).then_some(FacePoint { face: face as usize, xi })
        })
    }

    /// The face point with the given surface coordinates, or with the nearest ones that the faces reach: a smooth flank
    /// may be a hair longer than the mesh of it.
    pub(crate) fn nearest_face_at(&self, at: [f64; 2]) -> Option<FacePoint> {
        let [low, high] = self.range();
        let inset = [0, 1].map(|k| 1e-9 * (high[k] - low[k]));
        let clamped = [0, 1].map(|k| at[k].clamp(low[k] + inset[k], high[k] - inset[k]));
        self.face_at(clamped).or_else(|| {
            // Edges of the mesh are not quite lines of constant coordinates: step inwards until a face is met.
            let middle = [0, 1].map(|k| 0.5 * (low[k] + high[k]));
            [1e-6, 1e-4, 1e-2]
                .iter()
                .find_map(|share| self.face_at([0, 1].map(|k| clamped[k] + share * (middle[k] - clamped[k]))))
        })
    }

    /// Nearest face point at surface coordinates ([`FlankPatch::nearest_face_at`]), tried first from a face point found
    /// before for coordinates nearby.
    pub(crate) fn nearest_face_from(&self, at: [f64; 2], before: Option<FacePoint>) -> Option<FacePoint> {
        let near = before.and_then(|p| {
            let xi = self.invert_from(p.face, at, p.xi)?;
            inside(self.faces.get(p.face)?.kind, xi).then_some(FacePoint { face: p.face, xi })
        });
        near.or_else(|| self.nearest_face_at(at))
    }

    /// Whether the surface coordinates lie on the faces.
    pub(crate) fn covers(&self, at: [f64; 2]) -> bool {
        self.face_at(at).is_some()
    }

    fn invert(&self, face: usize, at: [f64; 2]) -> Option<[f64; 2]> {
        self.invert_from(face, at, self.faces.get(face)?.kind.centre())
    }

    fn invert_from(&self, face: usize, at: [f64; 2], mut xi: [f64; 2]) -> Option<[f64; 2]> {
        let f = self.faces.get(face)?;
        let count = f.kind.node_count();
        let (mut n, mut dn) = ([0.0; 9], [[0.0; 2]; 9]);
        for _ in 0..20 {
            f.kind.shape(xi, &mut n[..count]);
            f.kind.shape_gradient(xi, &mut dn[..count]);
            let (mut r, mut j) = ([-at[0], -at[1]], [[0.0; 2]; 2]);
            for (i, &node) in f.nodes[..count].iter().enumerate() {
                let q = self.nodes[node as usize].at;
                for (a, &q) in q.iter().enumerate() {
                    r[a] += n[i] * q;
                    j[a] = [j[a][0] + dn[i][0] * q, j[a][1] + dn[i][1] * q];
                }
            }
            let det = j[0][0] * j[1][1] - j[0][1] * j[1][0];
            let step = [(j[1][1] * r[0] - j[0][1] * r[1]) / det, (j[0][0] * r[1] - j[1][0] * r[0]) / det];
            if !(step[0].abs() < 10.0 && step[1].abs() < 10.0) {
                return None;
            }
            xi = [xi[0] - step[0], xi[1] - step[1]];
            if step[0].abs() + step[1].abs() < 1e-13 {
                return Some(xi);
            }
        }
        None
    }
}

/// Whether reference coordinates lie in the face, edges included.
fn inside(kind: FaceKind, [x, y]: [f64; 2]) -> bool {
    // Round-off of the inverse map at a shared edge: a point must not fall between two faces.
    const EDGE: f64 = 1e-9;
    match kind {
        FaceKind::Tri3 | FaceKind::Tri6 => x >= -EDGE && y >= -EDGE && x + y <= 1.0 + EDGE,
        FaceKind::Quad4 | FaceKind::Quad8 | FaceKind::Quad9 => x.abs() <= 1.0 + EDGE && y.abs() <= 1.0 + EDGE,
    }
}
