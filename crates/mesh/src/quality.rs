//! Shape quality of an element: Jacobian determinant and scaled Jacobian.

use std::sync::OnceLock;

use crate::element::QuadratureRule;
use crate::{ElementKind, Mesh};

/// Points that are judged at a time.
const POINTS: usize = 4;

/// Gradients of the shape functions where an element is judged, one list a kind.
struct Samples {
    /// dN/d(xi) at the integration points of the stiffness, then at the corners.
    gradients: Vec<Vec<[f64; 3]>>,
    /// The same for some points at a time, node by node: points beside each other. The last point fills what is left.
    side_by_side: Vec<Vec<[[f64; POINTS]; 3]>>,
    /// Each corner with its three neighbours, in the order that gives a positive volume.
    corners: Vec<(usize, [usize; 3])>,
    /// Scaled Jacobian of a cube, of a regular tetrahedron, of a right prism over a regular triangle.
    ideal: f64,
}

fn samples(kind: ElementKind) -> &'static Samples {
    static ALL: OnceLock<Vec<Samples>> = OnceLock::new();
    let all = ALL.get_or_init(|| ElementKind::ALL.into_iter().map(Samples::new).collect());
    &all[ElementKind::ALL.iter().position(|&k| k == kind).unwrap_or(0)]
}

impl Samples {
    fn new(kind: ElementKind) -> Self {
        let at = &kind.reference_nodes()[..kind.corner_count()];
        let points = kind.quadrature(QuadratureRule::Stiffness).iter().map(|q| q.xi).chain(at.iter().copied());
        let gradients: Vec<Vec<[f64; 3]>> = points
            .map(|xi| {
                let mut dn = vec![[0.0; 3]; kind.node_count()];
                kind.shape_gradient(xi, &mut dn);
                dn
            })
            .collect();
        let corners = (0..kind.corner_count())
            .map(|c| {
                let mut next = kind.edges().iter().filter_map(|&[a, b]| match c {
                    _ if a == c => Some(b),
                    _ if b == c => Some(a),
                    _ => None,
                });
                let mut three = [(); 3].map(|()| next.next().unwrap_or(c));
                if det(&three.map(|n| minus(at[n], at[c]))) < 0.0 {
                    three.swap(0, 1);
                }
                (c, three)
            })
            .collect();
        let ideal = match kind.corner_count() {
            8 => 1.0,
            6 => 0.75_f64.sqrt(),
            _ => 0.5_f64.sqrt(),
        };
        let beside = |points: &[Vec<[f64; 3]>]| {
            let at = |k: usize| &points[k.min(points.len() - 1)];
            let of_node = |n: usize| [0, 1, 2].map(|i| std::array::from_fn(|k| at(k)[n][i]));
            (0..kind.node_count()).map(of_node).collect()
        };
        let side_by_side = gradients.chunks(POINTS).map(beside).collect();
        Self { gradients, side_by_side, corners, ideal }
    }
}

fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn det(m: &[[f64; 3]; 3]) -> f64 {
    m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1])
        + m[0][1] * (m[1][2] * m[2][0] - m[1][0] * m[2][2])
        + m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0])
}

/// Determinant of dx/d(xi) for shape function gradients `dn`, mm^3.
fn det_j(dn: &[[f64; 3]], positions: &[[f64; 3]]) -> f64 {
    let mut j = [[0.0; 3]; 3];
    for (g, x) in dn.iter().zip(positions) {
        for (row, gi) in j.iter_mut().zip(g) {
            for (entry, xk) in row.iter_mut().zip(x) {
                *entry += gi * xk;
            }
        }
    }
    det(&j)
}

/// Positions of an element's nodes, into the front of `into`.
pub(crate) fn positions<'a>(mesh: &Mesh, element: &[u32], into: &'a mut [[f64; 3]; 27]) -> &'a [[f64; 3]] {
    for (slot, &node) in into.iter_mut().zip(element) {
        *slot = mesh.nodes[node as usize];
    }
    &into[..element.len().min(27)]
}

/// Least det J over integration points and corners, mm^3; an element where it is not above 0 is inverted.
pub(crate) fn min_det_j(kind: ElementKind, positions: &[[f64; 3]]) -> f64 {
    pulp::Arch::new().dispatch(LeastDetJ { gradients: &samples(kind).side_by_side, positions })
}

/// Least det J of points side by side.
struct LeastDetJ<'a> {
    gradients: &'a [Vec<[[f64; POINTS]; 3]>],
    positions: &'a [[f64; 3]],
}

impl pulp::NullaryFnOnce for LeastDetJ<'_> {
    type Output = f64;

    // Compiled for each set of instructions that there may be; the processor's own is chosen as the program runs.
    #[inline(always)]
    fn call(self) -> f64 {
        let mut least = f64::INFINITY;
        for some in self.gradients {
            let mut j = [[[0.0; POINTS]; 3]; 3];
            for (g, x) in some.iter().zip(self.positions) {
                for (row, gi) in j.iter_mut().zip(g) {
                    for (entries, xk) in row.iter_mut().zip(x) {
                        (0..POINTS).for_each(|p| entries[p] += gi[p] * xk);
                    }
                }
            }
            least = (0..POINTS).map(|p| det(&j.map(|row| row.map(|entries| entries[p])))).fold(least, f64::min);
        }
        least
    }
}

/// Scaled Jacobian, the minimum over the corners: 1 for the ideal shape, 0 for a flat element, negative for an inverted
/// one.
///
/// ```text
/// min over corners of  e1 . (e2 x e3) / (|e1| |e2| |e3|) / ideal
/// ```
/// e are the three edges that meet in a corner, taken as straight lines.
pub fn scaled_jacobian(kind: ElementKind, positions: &[[f64; 3]]) -> f64 {
    let samples = samples(kind);
    let of_corner = |&(c, next): &(usize, [usize; 3])| {
        let edges = next.map(|n| minus(positions[n], positions[c]));
        let lengths: f64 = edges.iter().map(|e| e.iter().map(|x| x * x).sum::<f64>().sqrt()).product();
        if lengths > 0.0 { det(&edges) / lengths / samples.ideal } else { 0.0 }
    };
    samples.corners.iter().map(of_corner).fold(f64::INFINITY, f64::min)
}

/// Volume of an element by quadrature, mm^3.
pub(crate) fn element_volume(kind: ElementKind, positions: &[[f64; 3]]) -> f64 {
    let rule = kind.quadrature(QuadratureRule::Stiffness);
    rule.iter().zip(&samples(kind).gradients).map(|(q, dn)| q.weight * det_j(dn, positions)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The ideal element of each family scores 1, its mirror image -1.
    #[test]
    fn ideal_shapes_score_one() {
        let slant = |x: [f64; 3], kind: ElementKind| match kind.corner_count() {
            8 => x,
            // Reference triangle to the regular one, then the apex over its centre.
            6 => [x[0] + 0.5 * x[1], 0.75_f64.sqrt() * x[1], x[2]],
            _ => [x[0] + 0.5 * x[1] + 0.5 * x[2], 0.75_f64.sqrt() * (x[1] + x[2] / 3.0), (2.0_f64 / 3.0).sqrt() * x[2]],
        };
        for kind in ElementKind::ALL {
            let nodes: Vec<[f64; 3]> = kind.reference_nodes().iter().map(|&x| slant(x, kind)).collect();
            assert!((scaled_jacobian(kind, &nodes) - 1.0).abs() < 1e-14, "{kind:?}");
            assert!(min_det_j(kind, &nodes) > 0.1, "{kind:?}");
            let mirrored: Vec<[f64; 3]> = nodes.iter().map(|x| [x[0], x[1], -x[2]]).collect();
            assert!((scaled_jacobian(kind, &mirrored) + 1.0).abs() < 1e-14, "{kind:?}");
            assert!(min_det_j(kind, &mirrored) < 0.0, "{kind:?}");
        }
    }

    #[test]
    fn reference_volumes() {
        for kind in ElementKind::ALL {
            let expected = [8.0, 1.0, 1.0 / 6.0][[8, 6, 4].iter().position(|&c| c == kind.corner_count()).unwrap()];
            assert!((element_volume(kind, kind.reference_nodes()) - expected).abs() < 1e-14, "{kind:?}");
        }
    }
}
