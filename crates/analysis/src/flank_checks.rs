//! Checks that the flanks named by a mesh are those of its gear. If not, the most common mistakes are tested and named.

use std::f64::consts::FRAC_PI_2;

use geometry::{Gear, Side, Vec3};
use mesh::{DEFAULT_TOLERANCE_MODULES, GroupNames, MeshedGear};
use nalgebra::Rotation3;

use crate::{AnalysisError, error::mismatch};

/// The flanks of a mesh beside those of its gear.
pub(crate) struct NamedFlanks<'a> {
    /// The mesh's file, for messages.
    pub file: &'a str,
    /// `pinion` or `wheel`.
    pub whose: &'a str,
    /// The mesh with its parts.
    pub found: &'a MeshedGear,
    /// The gear.
    pub exact: &'a Gear,
    /// What the mesh calls its parts.
    pub names: &'a GroupNames,
}

/// What may be wrong with a whole mesh: where a point of it should lie, and on the flank of which tooth and side.
struct Mistake<'a> {
    /// Words of the hint.
    hint: String,
    place: Box<dyn Fn(Vec3) -> Vec3 + 'a>,
    tooth: i64,
    opposite: bool,
}

impl Mistake<'_> {
    fn naming(hint: &str, tooth: i64, opposite: bool) -> Self {
        Self { hint: hint.to_owned(), place: Box::new(|p| p), tooth, opposite }
    }

    fn moved<'a>(hint: String, place: impl Fn(Vec3) -> Vec3 + 'a) -> Mistake<'a> {
        Mistake { hint, place: Box::new(place), tooth: 0, opposite: false }
    }
}

impl NamedFlanks<'_> {
    /// Checks that named flanks lie where this gear has its flanks. Otherwise the mesh belongs to another gear, and the
    /// gaps of one gear would be combined with the compliance of the other.
    ///
    /// # Errors
    /// [`AnalysisError::Refused`] with a node that is off the flank, and the mistake that explains all such nodes, if
    /// there is one.
    pub fn lie_on_the_gear(&self) -> Result<(), AnalysisError> {
        let Self { file, whose, found, exact, .. } = *self;
        let allowed = DEFAULT_TOLERANCE_MODULES * exact.data().normal_module;
        // Faces share nodes.
        let mut checked = vec![None; found.mesh().nodes.len()];
        for (tooth, side, node) in self.nodes() {
            if checked[node as usize].replace((tooth, side)) == Some((tooth, side)) {
                continue;
            }
            let off = self.distance(side, i64::from(tooth), self.point(node));
            if off > allowed {
                let far = if off.is_finite() { format!("{off:.3} mm") } else { "far".into() };
                let said = format!(
                    "node {} of the {} flank of tooth {tooth} lies {far} off the {whose}'s flank, allowed is \
                     {allowed:.3} mm",
                    found.mesh().node_tags[node as usize],
                    side.name()
                );
                return Err(mismatch(file, said, self.explanation(allowed)));
            }
        }
        let [low, high] = self.heights();
        let middle = 0.5 * (low + high);
        // A spur gear has its flanks at any height, the face width has not.
        if middle.abs() > LARGEST_SHIFT * (high - low) {
            let said = format!("the {whose}'s flanks lie at z = {low:.3} to {high:.3} mm, not about z = 0");
            return Err(mismatch(file, said, shifted(middle)));
        }
        let width = exact.face_width();
        if high.max(-low) > 0.5 * width + allowed {
            let said = format!(
                "the {whose}'s flanks reach from z = {low:.3} to {high:.3} mm, and its face is {width:.3} mm wide"
            );
            let hint =
                format!("is `face_width_mm` of the {whose} that of the mesh, and mid-face of the mesh at z = 0?");
            return Err(mismatch(file, said, hint));
        }
        Ok(())
    }

    /// Checks that named flanks are complete: contact ignores places where the mesh has no face to carry it.
    ///
    /// ```text
    /// A = b r_b (u_a^2 - u_f^2) / (2 cos b_b)
    /// ```
    /// Area of a flank from the root form circle to the tip, mm^2.
    ///
    /// # Errors
    /// [`AnalysisError::Refused`] for a missing group, or one that covers only part of its flank.
    pub fn are_whole(&self) -> Result<(), AnalysisError> {
        let Self { file, whose, found, exact, names } = *self;
        let profile = exact.profile();
        let arc = 0.5 * exact.base_radius() * (profile.roll_tip().powi(2) - profile.roll_form().powi(2));
        let whole = exact.face_width() * arc / exact.base_helix_angle().cos();
        for (tooth, side) in found.teeth().into_iter().flat_map(|t| [(t, Side::Left), (t, Side::Right)]) {
            let faces = found.flank(tooth, side).unwrap_or_default();
            if faces.is_empty() {
                let group = names.flank_of(side, i64::from(tooth));
                let said = format!("no physical group `{group}`, though the other flank of tooth {tooth} has one");
                return Err(mismatch(
                    file,
                    said,
                    "name both flanks of a tooth, or neither; the program finds unnamed ones",
                ));
            }
            let area = found.mesh().areas(faces);
            if area < COVERED * whole {
                let said = format!(
                    "the faces of the {} flank of tooth {tooth} cover {:.0} % of the {whose}'s flank, {area:.2} of \
                     {whole:.2} mm^2",
                    side.name(),
                    100.0 * area / whole
                );
                let hint =
                    "are all faces of the flank in its group, and are face width and tip diameter those of the mesh?";
                return Err(mismatch(file, said, hint));
            }
        }
        Ok(())
    }

    /// Nodes of all flanks, each with its tooth and side.
    fn nodes(&self) -> impl Iterator<Item = (u32, Side, u32)> + '_ {
        let flanks = self.found.teeth().into_iter().flat_map(|t| [(t, Side::Left), (t, Side::Right)]);
        flanks.flat_map(|(tooth, side)| {
            let faces = self.found.flank(tooth, side).unwrap_or_default();
            faces.iter().flat_map(|face| face.nodes()).map(move |&node| (tooth, side, node))
        })
    }

    /// Where a node of the mesh is, mm.
    pub fn point(&self, node: u32) -> Vec3 {
        Vec3::from(self.found.mesh().nodes[node as usize])
    }

    /// Distance of a point from a flank of the gear, mm; infinite where it faces none.
    fn distance(&self, side: Side, tooth: i64, point: Vec3) -> f64 {
        self.exact.flank_of(side, tooth).locate(&point).map_or(f64::INFINITY, |foot| foot.distance.abs())
    }

    /// Lowest and highest node of the flanks, mm.
    fn heights(&self) -> [f64; 2] {
        let heights = self.nodes().map(|(_, _, node)| self.point(node).z);
        heights.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], z| [low.min(z), high.max(z)])
    }

    /// The mistake with which all nodes lie within `allowed` of their flanks, in words.
    fn explanation(&self, allowed: f64) -> String {
        let fits = |mistake: &Mistake<'_>| {
            self.nodes().all(|(tooth, side, node)| {
                let side = if mistake.opposite { side.opposite() } else { side };
                self.distance(side, i64::from(tooth) + mistake.tooth, (mistake.place)(self.point(node))) <= allowed
            })
        };
        let unknown = "is it the mesh of this gear (teeth, helix angle and its hand, profile shift, thinning), axis on z, \
                       tooth 0 on +x?";
        let known = self.mistakes().iter().find(|m| fits(m)).map(|m| m.hint.clone());
        known.or_else(|| self.other_numbers(allowed)).unwrap_or_else(|| unknown.to_owned())
    }

    /// Where all groups are flanks of this gear under other numbers, as those of a mesher that counts all its surfaces:
    /// what each of the first ones is.
    fn other_numbers(&self, allowed: f64) -> Option<String> {
        let teeth = i64::from(self.exact.teeth());
        let mut groups: Vec<((u32, Side), Vec<Vec3>)> = Vec::new();
        for (tooth, side, node) in self.nodes() {
            if groups.last().is_none_or(|(own, _)| *own != (tooth, side)) {
                groups.push(((tooth, side), Vec::new()));
            }
            if let Some((_, points)) = groups.last_mut() {
                points.push(self.point(node));
            }
        }
        let lies = |points: &[Vec3]| {
            let places = (0..teeth).flat_map(|tooth| [(tooth, Side::Left), (tooth, Side::Right)]);
            let on = |(tooth, side): &(i64, Side)| points.iter().all(|p| self.distance(*side, *tooth, *p) <= allowed);
            places.into_iter().find(on)
        };
        let found: Vec<((u32, Side), (i64, Side))> =
            groups.iter().map(|(own, points)| Some((*own, lies(points)?))).collect::<Option<_>>()?;
        let told = found.iter().filter(|((tooth, side), (k, s))| (i64::from(*tooth), *side) != (*k, *s)).take(3);
        let told = told.map(|((tooth, side), (k, s))| {
            let group = self.names.flank_of(*side, i64::from(*tooth));
            format!("`{group}` is the {} flank of tooth {k}", s.name())
        });
        let told = told.collect::<Vec<_>>().join(", ");
        Some(format!(
            "the groups are flanks of this gear under other numbers: {told}. {{k}} is the number of the tooth, 0 on +x, \
             counter-clockwise: rename the groups, or name a pattern that no group has in [{}.groups] \
             (`flank_left = \"none_{{k}}\"`, `flank_right = \"none_{{k}}\"`), and flanks are found by their shape",
            self.whose
        ))
    }

    /// The commonest ones.
    fn mistakes(&self) -> Vec<Mistake<'static>> {
        let [low, high] = self.heights();
        let middle = 0.5 * (low + high);
        let turned = |angle: f64, what: String| {
            let back = Rotation3::from_axis_angle(&Vec3::z_axis(), -angle);
            Mistake::moved(what, move |p| back * p)
        };
        let quarter = |quarters: i32, axis: &str| {
            let by = 90 * quarters;
            turned(
                f64::from(quarters) * FRAC_PI_2,
                format!(
                    "the mesh is turned by {by} deg: its tooth 0 lies on {axis}, it must lie on +x (turn it by {} deg)",
                    -by
                ),
            )
        };
        let pitch = self.exact.pitch_angle();
        vec![
            Mistake::naming(
                "teeth are numbered from 1 in the mesh: the tooth on +x is number 0 (`flank_left_0`), the next \
                 counter-clockwise 1",
                -1,
                false,
            ),
            Mistake::naming(
                "left and right are swapped: seen from +z the left flank is the counter-clockwise side of a tooth",
                0,
                true,
            ),
            Mistake::moved(shifted(middle), move |p| p - Vec3::new(0.0, 0.0, middle)),
            quarter(1, "+y"),
            quarter(-1, "-y"),
            quarter(2, "-x"),
            turned(
                0.5 * pitch,
                "a tooth space lies on +x: the middle of tooth 0 must (turn the mesh by half a pitch)".into(),
            ),
            Mistake::moved(
                "the mesh has the other hand of helix: give `helix_angle_deg` the other sign, or mirror the mesh"
                    .into(),
                |p| Vec3::new(p.x, p.y, -p.z),
            ),
        ]
    }
}

/// What to do with a mesh whose mid-face is at `middle`, mm.
fn shifted(middle: f64) -> String {
    format!(
        "mid-face of the mesh is at z = {middle:.4} mm: it must be at 0, move the mesh by {:.4} mm along z",
        -middle
    )
}

/// Distance of the flanks' middle from mid-face over their width from which on they are another face: chamfers at one
/// end are less.
const LARGEST_SHIFT: f64 = 0.25;

/// Share of a flank that its faces must cover: groups may begin at the active root circle or leave out chamfers.
const COVERED: f64 = 0.75;
