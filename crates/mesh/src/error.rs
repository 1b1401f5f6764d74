//! Errors of this crate.

use std::path::PathBuf;

use crate::msh::MshError;
use crate::numbered::folded;

/// A mesh that cannot be read, written or interpreted as a gear.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum MeshError {
    /// The file cannot be opened or read.
    #[error("{}: cannot be read: {source}", path.display())]
    Read {
        /// Path of the file.
        path: PathBuf,
        /// Cause of the failure.
        source: std::io::Error,
    },
    /// The file cannot be written.
    #[error("{}: cannot be written: {source}", path.display())]
    Write {
        /// Path of the file.
        path: PathBuf,
        /// Cause of the failure.
        source: std::io::Error,
    },
    /// The content of the file is not a valid mesh.
    #[error(transparent)]
    Msh(Box<MshError>),
    /// Lists of a mesh that contradict each other.
    #[error("the mesh is inconsistent: {what}")]
    Inconsistent {
        /// Description of the contradiction.
        what: String,
    },
    /// A tag that the file format cannot hold.
    #[error("tag {tag} does not fit into format 2.2 (largest: {})", i32::MAX)]
    TagTooLarge {
        /// The tag, or the largest tag that would be needed.
        tag: u64,
    },
    /// A part of the gear for which there is no physical group.
    #[error("no physical group `{wanted}`; the mesh has {}", list(found))]
    MissingGroup {
        /// Name of the group; `<k>` stands for a tooth number.
        wanted: String,
        /// Names of the two-dimensional groups in the mesh.
        found: Vec<String>,
    },
    /// A pattern of group names without a placeholder for the tooth number.
    #[error("the group name `{pattern}` must contain {{k}} where the tooth number stands")]
    NoToothNumber {
        /// The pattern.
        pattern: String,
    },
    /// Two groups that name the same flank of the same tooth.
    #[error("groups `{first}` and `{second}` name the same flank: tooth {tooth} of {teeth}")]
    SameTooth {
        /// Name of the first group.
        first: String,
        /// Name of the second group.
        second: String,
        /// Number of the tooth, 0..teeth.
        tooth: u32,
        /// Number of teeth of the gear.
        teeth: u32,
    },
    /// A face of a group that is not a boundary face of the body.
    #[error("group `{group}`: face with nodes {nodes:?} {what}")]
    NotOnBoundary {
        /// Name of the group.
        group: String,
        /// Corner nodes of the face, by tag.
        nodes: Vec<u64>,
        /// What the faces are instead.
        what: &'static str,
    },
    /// The flanks of the given gear are not in the mesh.
    #[error(
        "the flanks of this gear are not in the mesh: {:.0} % of their area lies within {tolerance_mm} mm of the helicoids",
        100.0 * coverage
    )]
    NoFlanks {
        /// Share of the area of the flanks that was found, 0..1.
        coverage: f64,
        /// Tolerance for the distance, mm.
        tolerance_mm: f64,
    },
    /// The flanks are there, but the teeth are thicker or thinner than those of the gear.
    #[error("the teeth of the mesh are {thicker_mm:.4} mm thicker than the gear's, measured along the base tangent")]
    ToothThickness {
        /// Difference of thickness, both flanks together, mm; negative if thinner.
        thicker_mm: f64,
    },
    /// The mid-face of the mesh is not at z = 0.
    #[error("mid-face of the mesh is at z = {z_mm:.4} mm, not at 0")]
    MidFace {
        /// Height of the mesh's mid-face, mm.
        z_mm: f64,
    },
    /// There is no boundary face on the bore cylinder.
    #[error("no boundary face has the bore radius {wanted_mm:.4} mm; the smallest radius is {found_mm:.4} mm")]
    NoBore {
        /// Radius of the gear's bore, mm.
        wanted_mm: f64,
        /// Smallest radius of any node, mm.
        found_mm: f64,
    },
    /// No face of the bore lies in the range that is to be held.
    #[error(
        "no face of the bore lies between z = {from_mm:.4} and {to_mm:.4} mm as a whole; the bore reaches from \
         {low_mm:.4} to {high_mm:.4} mm"
    )]
    NotHeld {
        /// Lower end of the held range, mm.
        from_mm: f64,
        /// Upper end of the held range, mm.
        to_mm: f64,
        /// Lowest height of the bore, mm.
        low_mm: f64,
        /// Greatest height of the bore, mm.
        high_mm: f64,
    },
    /// An elastic foundation of the bore with a stiffness that is none.
    #[error("the stiffness of an elastic bore is {found} N/mm^3, and must be finite and at least 0")]
    BadFoundation {
        /// The stiffness, N/mm^3.
        found: f64,
    },
    /// A force that is negative or not finite.
    #[error("a preload of {found} N")]
    BadPreload {
        /// The force, N.
        found: f64,
    },
    /// Bolts that open without a stiffness.
    #[error("bolts open along the radius and have no stiffness there")]
    NothingOpens,
    /// An elastic foundation of the bore that leaves the gear a motion.
    #[error("the springs of the elastic bore let the gear {motion}: it has no {missing} stiffness")]
    FreeBore {
        /// What the gear may do.
        motion: &'static str,
        /// Direction without a spring.
        missing: &'static str,
    },
    /// Too few places that hold a gear by themselves.
    #[error("{count} bolts alone hold the gear, and let it tilt about the line between them: it takes {fewest}")]
    FewBolts {
        /// Number of bolts.
        count: u32,
        /// Fewest that hold.
        fewest: u32,
    },
    /// Bolts that take more than the bore has.
    #[error("{count} bolts hold {taken_mm:.2} mm of a bore that is {around_mm:.2} mm around")]
    BoltsOverlap {
        /// Number of bolts.
        count: u32,
        /// Arcs of all together, mm.
        taken_mm: f64,
        /// Circumference of the bore, mm.
        around_mm: f64,
    },
    /// A bolt that touches more than the bore.
    #[error("bolt {bolt} reaches beyond the held faces of the bore, at {angle_deg:.3} deg, z {z_mm:.4} mm")]
    BoltOffBore {
        /// Number of the bolt, from 0.
        bolt: u32,
        /// Angle of the place, deg.
        angle_deg: f64,
        /// Height of the place, mm.
        z_mm: f64,
    },
    /// The mesh is not a sector with two cuts, and only such a sector can be repeated.
    #[error("the mesh is no periodic sector: it has no cuts")]
    NoCuts,
    /// A node of one cut that coincides with no node of the other.
    #[error(
        "node {node} of `{cut}`, turned by {angle_deg:.6} deg, meets no node of `{other}`: \
         the nearest is {distance_mm:.3e} mm away, allowed is {tolerance_mm:.1e} mm"
    )]
    CutsApart {
        /// Tag of the node.
        node: u64,
        /// Name of the cut that has the node.
        cut: String,
        /// Name of the other cut.
        other: String,
        /// Angle of the sector, deg; negative if measured from the second cut to the first.
        angle_deg: f64,
        /// Distance from the nearest node of the other cut, mm.
        distance_mm: f64,
        /// Tolerance for the distance, mm.
        tolerance_mm: f64,
    },
    /// A face of one cut that coincides with no face of the other, although its nodes coincide.
    #[error("the face of `{cut}` with nodes {nodes:?} meets no face of `{other}`, though its nodes do")]
    CutFaces {
        /// Name of the cut that has the face.
        cut: String,
        /// Name of the other cut.
        other: String,
        /// Corner nodes of the face, by tag.
        nodes: Vec<u64>,
    },
    /// Parts of the cut faces that belong to no group.
    #[error(
        "node {node}, turned by one tooth, meets node {other}, but is not in `{}`: `{}` and `{}` hold only a part of the \
         cut faces", cuts[0], cuts[0], cuts[1]
    )]
    CutInPart {
        /// Tag of the node on the first cut.
        node: u64,
        /// Tag of the node on the second cut.
        other: u64,
        /// Names of the cuts.
        cuts: [String; 2],
    },
    /// A node that lies on both cuts, but not on the axis.
    #[error("the two cuts of the sector share a node off the axis")]
    CutsCross,
    /// The whole gear would have more nodes than can be solved.
    #[error("the whole gear would have {nodes} nodes: at most {most} are made")]
    TooLarge {
        /// Number of nodes of the whole gear.
        nodes: u64,
        /// Largest number of nodes.
        most: u64,
    },
}

impl From<MshError> for MeshError {
    fn from(error: MshError) -> Self {
        Self::Msh(Box::new(error))
    }
}

/// Names for a message, at most twelve; those of teeth as one pattern.
pub(crate) fn list(names: &[String]) -> String {
    if names.is_empty() {
        return "no groups of dimension 2".into();
    }
    let shown = folded(names);
    let more = if shown.len() > 12 { format!(" and {} more", shown.len() - 12) } else { String::new() };
    shown.into_iter().take(12).collect::<Vec<_>>().join(", ") + &more
}

impl MeshError {
    /// What the user can do next.
    pub fn hint(&self) -> Option<String> {
        let hint = match self {
            Self::Msh(error) => return error.hint(),
            Self::Read { .. } => "paths in a scene are relative to the scene file",
            Self::Write { .. } => "is the folder there, may it be written, or is the disk full?",
            Self::Inconsistent { .. } => "this is a fault of the program that made the mesh",
            Self::TagTooLarge { .. } => "write format 4.1, or renumber the mesh",
            Self::MissingGroup { .. } => {
                "name the groups in the mesher (Gmsh: physical surfaces, Mesh.SaveAll = 0), or map its own names in the scene's `groups` table"
            }
            Self::NoToothNumber { .. } => "for example flank_left = \"Left_{k}\"",
            Self::SameTooth { .. } => "tooth numbers count modulo the number of teeth: is that number right?",
            Self::NotOnBoundary { .. } => {
                "surface groups must hold boundary faces of the elements: mesh surfaces and volume together"
            }
            Self::NoFlanks { .. } => {
                "do number of teeth, module, helix angle and hand fit the mesh? is its axis the z axis, its unit mm?"
            }
            Self::ToothThickness { .. } => "profile_shift or thickness_allowance_mm of the scene differ from the mesh",
            Self::MidFace { .. } => "move the mesh so that its mid-face is at z = 0",
            Self::NoCuts => "name its periodic faces `cut_0` (clockwise) and `cut_1`, or mesh the whole gear",
            Self::CutsApart { .. } => {
                "is the number of teeth right, and `cut_0` the clockwise cut? make `cut_1` by turning `cut_0`: mesh one and copy it (Gmsh: `Periodic Surface`, coordinates with 16 digits)"
            }
            Self::CutFaces { .. } => "mesh one cut and copy it to the other by a turn (Gmsh: `Periodic Surface`)",
            Self::CutInPart { .. } => "put all faces of each cut into its group",
            Self::CutsCross => "is the sector the smallest part that repeats, one tooth?",
            Self::TooLarge { .. } => "make the sector's mesh coarser",
            Self::NotHeld { .. } => {
                "whole faces of the mesh are held: hold a longer part, or mesh the bore finer along the face"
            }
            Self::FewBolts { .. } => {
                "give the bore `tangential_n_per_mm3` and `axial_n_per_mm3` too, or state more bolts"
            }
            Self::BoltsOverlap { .. } => "make them narrower or fewer; `width_mm` is the arc of each",
            Self::BoltOffBore { .. } => "set `over_mm` of the bolts to a part of what is held, and mesh the whole bore",
            Self::BadFoundation { .. } => "leave the key out where nothing holds",
            Self::BadPreload { .. } => "state a preload of 0 or more",
            Self::NothingOpens => "state `radial_n_per_mm` of the bolts, or leave `opens` out",
            Self::FreeBore { missing: "axial", .. } => {
                "state `axial_n_per_mm3` too; without axial forces any small stiffness gives the same answer"
            }
            Self::FreeBore { .. } => {
                "state `tangential_n_per_mm3` too; where no torque passes, as on a bearing, a thousandth of the radial one will do"
            }
            Self::NoBore { .. } => "set bore_diameter_mm to that of the mesh, or name the bore's group",
        };
        Some(hint.to_owned())
    }
}
