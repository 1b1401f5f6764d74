//! Finds the bore of a mesh without a bore group: the innermost cylinder about z that faces the axis.

use geometry::Vec3;

use crate::{Face, FaceTable, Mesh, flank_fit::centre_and_area};

/// Least cosine between a face's normal and the direction to the axis (30 deg).
const LEAST_COSINE: f64 = 0.866;
/// Share of the radius by which corners of one cylinder differ at the most.
const ROUND: f64 = 1e-3;

impl Mesh {
    /// Smallest and largest radius (mm) of the nodes of the bore. The bore consists of the boundary faces that face the
    /// z axis and have all corners on the innermost cylinder of such faces. `None` if no face does, as in a solid gear.
    pub fn bore_radii(&self) -> Option<[f64; 2]> {
        let table = FaceTable::new(self);
        let radius = |n: u32| {
            let [x, y, _] = self.nodes[n as usize];
            x.hypot(y)
        };
        let inwards = |face: &Face| {
            let (centre, area) = centre_and_area(self, face);
            let inward = -Vec3::new(centre.x, centre.y, 0.0);
            area.dot(&inward) > LEAST_COSINE * area.norm() * inward.norm()
        };
        let facing: Vec<Face> = table.boundary().iter().map(|owner| owner.face(self)).filter(inwards).collect();
        let corners = |face: &Face| face.corners().iter().map(|&n| radius(n)).collect::<Vec<_>>();
        let widest = |face: &Face| corners(face).into_iter().fold(0.0, f64::max);
        // A face across a step has one end farther out: its wider end is what counts.
        let least = facing.iter().map(widest).fold(f64::INFINITY, f64::min);
        let on_bore = |face: &&Face| corners(face).iter().all(|r| (r - least).abs() <= ROUND * least);
        let nodes = facing.iter().filter(on_bore).flat_map(|face| face.nodes().to_vec());
        let [low, high] = nodes.map(radius).fold([f64::INFINITY, 0.0], |[low, high], r| [low.min(r), high.max(r)]);
        (low <= high && high > 0.0).then_some([low, high])
    }
}
