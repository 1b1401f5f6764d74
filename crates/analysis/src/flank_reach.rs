//! Checks that the flanks named by a mesh reach as far as the contact of the pair.

use geometry::{GearPair, Side};
use mesh::DEFAULT_TOLERANCE_MODULES;

use crate::{AnalysisError, error::mismatch, flank_checks::NamedFlanks};

/// Share of the path of contact, or of the common face, that a flank may lack with a remark alone: chamfers and roundings.
const LARGEST_LACK: f64 = 0.1;

impl NamedFlanks<'_> {
    /// Checks that named flanks reach from the start of the active profile to its end and over the common face, because
    /// contact ignores everything beyond the last node. Returns a remark about the flank with the largest gap, if it is
    /// less than [`LARGEST_LACK`] of path or face.
    ///
    /// ```text
    /// d_Nf = 2 sqrt(r_b^2 + xi_A^2),   d_Na = 2 sqrt(r_b^2 + xi_E^2)      xi: path of contact, from the gear's own tangent point
    /// ```
    ///
    /// # Errors
    /// [`AnalysisError::Refused`] if it is larger.
    pub fn reach(&self, pair: &GearPair) -> Result<Option<answer::Remark>, AnalysisError> {
        let Self { found, exact, .. } = *self;
        let [start, end] = pair.path_of_contact();
        let length = pair.tangent_length();
        let (path, face) = if self.whose == "pinion" {
            ([start, end], pair.common_face())
        } else {
            ([length - end, length - start], pair.common_face().map(|z| z - pair.mid_face_offset()))
        };
        let slack = DEFAULT_TOLERANCE_MODULES * exact.data().normal_module;
        let mut worst: Option<Lack> = None;
        for (tooth, side) in found.teeth().into_iter().flat_map(|t| [(t, Side::Left), (t, Side::Right)]) {
            let nodes = found.flank(tooth, side).unwrap_or_default().iter().flat_map(|face| face.nodes());
            let places = nodes.map(|&node| {
                let p = self.point(node);
                [exact.sign() * p.x.hypot(p.y), p.z]
            });
            let none = [[f64::INFINITY, f64::NEG_INFINITY]; 2];
            let [radii, heights] = places.fold(none, |[r, z], p| [widened(r, p[0]), widened(z, p[1])]);
            // Radii and paths of a ring are negative: both grow towards the tip. Places on the path of contact that the lowest and the highest node stand for.
            let base = exact.base_radius();
            let own = radii.map(|r| exact.sign() * (r * r - base * base).max(0.0).sqrt());
            let [from, to] = path.map(|xi| exact.sign() * base.hypot(xi));
            let flank = FlankName { tooth, side };
            let candidates = [
                (radii[0] - from, Edge::Root, own[0] - path[0], path, [2.0 * radii[0], 2.0 * from]),
                (to - radii[1], Edge::Tip, path[1] - own[1], path, [2.0 * radii[1], 2.0 * to]),
                (heights[0] - face[0], Edge::Low, heights[0] - face[0], face, [heights[0], face[0]]),
                (face[1] - heights[1], Edge::High, face[1] - heights[1], face, [heights[1], face[1]]),
            ];
            for (off, edge, lacks, [low, high], places) in candidates {
                let share = lacks / (high - low);
                if off > slack && worst.as_ref().is_none_or(|w| share > (1.0 + 1e-6) * w.share) {
                    worst = Some(Lack { flank, edge, share, places });
                }
            }
        }
        match worst {
            Some(lack) if lack.share > LARGEST_LACK => Err(mismatch(self.file, lack.said(self), lack.hint(self))),
            other => Ok(other.map(|lack| {
                let said = format!("{}: {}", self.file, lack.said(self));
                crate::remark::mesh_lacks_face(said, 100.0 * lack.share, lack.hint(self))
            })),
        }
    }
}

/// One flank of a mesh.
#[derive(Debug, Clone, Copy)]
struct FlankName {
    tooth: u32,
    side: Side,
}

/// Where a flank of a mesh ends too early.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Edge {
    Root,
    Tip,
    Low,
    High,
}

/// What a flank of a mesh lacks.
struct Lack {
    flank: FlankName,
    edge: Edge,
    /// Share of the path of contact, or of the common face.
    share: f64,
    /// Where the flank ends and where it has to: diameters or heights, mm.
    places: [f64; 2],
}

impl Lack {
    fn said(&self, flanks: &NamedFlanks<'_>) -> String {
        let whose = flanks.whose;
        let (FlankName { tooth, side }, [found, wanted]) = (self.flank, self.places);
        let (side, share) = (side.name(), 100.0 * self.share);
        let (ends, where_contact) = match self.edge {
            Edge::Root => ("begins at diameter", format!("the {whose}'s contact at d_Nf = {wanted:.3} mm")),
            Edge::Tip => ("ends at diameter", format!("the {whose}'s contact at d_Na = {wanted:.3} mm")),
            Edge::Low => ("begins at z =", format!("the common face at z = {wanted:.3} mm")),
            Edge::High => ("ends at z =", format!("the common face at z = {wanted:.3} mm")),
        };
        let whole = if matches!(self.edge, Edge::Root | Edge::Tip) { "path of contact" } else { "face" };
        format!(
            "the {side} flank of tooth {tooth} {ends} {found:.3} mm, {where_contact}: {share:.1} % of the {whole} \
             has no face to carry it"
        )
    }

    fn hint(&self, flanks: &NamedFlanks<'_>) -> String {
        let NamedFlanks { whose, exact, names, .. } = *flanks;
        let group = names.flank_of(self.flank.side, i64::from(self.flank.tooth));
        let found = self.places[0];
        match self.edge {
            Edge::Root => format!(
                "put the faces from the root form diameter {:.3} mm on into the group `{group}`, and mesh the involute from there",
                2.0 * exact.form_radius()
            ),
            Edge::Tip => format!(
                "put the faces up to the tip into the group `{group}`; of a tooth that is chamfered there give \
                 `tip_diameter_mm = {found:.3}` in [{whose}]"
            ),
            Edge::Low | Edge::High => format!(
                "put the faces up to the end face into the group `{group}`, or give the {whose} the `face_width_mm` of its \
                 flanks"
            ),
        }
    }
}

fn widened([low, high]: [f64; 2], x: f64) -> [f64; 2] {
    [low.min(x), high.max(x)]
}
