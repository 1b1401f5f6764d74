//! Errors in the data of a gear or a pair.

/// A gear whose flank is undercut by the tip of its rack.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Undercut {
    /// Name of the gear, `pinion` or `wheel`.
    pub gear: &'static str,
    /// Profile shift coefficients of pinion and wheel that give a sufficient contact ratio; `None` if there are none.
    pub cure: Option<[f64; 2]>,
    /// Whether these coefficients need the centre distance that follows from them, instead of a given one.
    pub moves_axes: bool,
}

/// How the teeth of a gear inside a ring interfere with the ring, other than at the roots.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum InternalInterference {
    /// The ring's tip reaches below the base circle of the inner gear.
    Involute,
    /// The tip corners collide after they have left contact.
    Trochoid,
}

/// Gear data from which no gear, or no running pair, can be made.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum GeometryError {
    /// A value outside its valid range.
    #[error("{name} = {value} is out of range: {expected}")]
    OutOfRange {
        /// Name of the quantity.
        name: &'static str,
        /// Value of the quantity.
        value: f64,
        /// The permitted range.
        expected: &'static str,
    },
    /// The two flanks of a tooth meet below the tip circle.
    #[error(
        "the teeth are pointed: tip diameter {tip_diameter_mm:.3} mm, but the flanks meet at {pointed_diameter_mm:.3} mm"
    )]
    PointedTooth {
        /// Tip diameter requested, mm.
        tip_diameter_mm: f64,
        /// Diameter at which the tooth thickness becomes zero, mm.
        pointed_diameter_mm: f64,
    },
    /// The tooth has no thickness left at the reference circle.
    #[error("the teeth have no thickness: {thickness_mm:.4} mm in the normal section at the reference circle")]
    Thickness {
        /// Normal tooth thickness, mm; zero or negative.
        thickness_mm: f64,
    },
    /// The tip rounding of the rack is wider than the rack's tooth.
    #[error("root radius coefficient {coefficient} is too large: at most {largest:.4} fits the tooth space")]
    RootRadius {
        /// Coefficient requested.
        coefficient: f64,
        /// Largest coefficient that fits.
        largest: f64,
    },
    /// The bore reaches into the root circle.
    #[error("bore diameter {bore_diameter_mm} mm leaves no rim below the root diameter {root_diameter_mm:.3} mm")]
    Bore {
        /// Bore diameter, mm.
        bore_diameter_mm: f64,
        /// Root diameter, mm.
        root_diameter_mm: f64,
    },
    /// The two gears cannot mesh with each other.
    #[error("pinion and wheel differ in {name}: {pinion} and {wheel}")]
    Mismatch {
        /// The quantity that must be equal on both gears.
        name: &'static str,
        /// Pinion's value.
        pinion: f64,
        /// Wheel's value.
        wheel: f64,
    },
    /// The base circles overlap.
    #[error("centre distance {centre_distance_mm} mm is too small: the base circles need more than {least_mm:.4} mm")]
    CentreDistance {
        /// Centre distance, mm.
        centre_distance_mm: f64,
        /// Sum of the base radii, mm.
        least_mm: f64,
    },
    /// The teeth are too thick for the centre distance.
    #[error("the teeth jam: backlash along the line of action is {backlash_mm:.4} mm")]
    Jammed {
        /// Transverse base backlash, mm; negative here.
        backlash_mm: f64,
        /// Centre distance at which unthinned teeth with these profile shifts have no backlash, mm.
        nominal_mm: f64,
        /// Profile shift of the ring with the opposite sign, if it fits the centre distance.
        ring_shift: Option<f64>,
    },
    /// The tip of one gear reaches the root circle of the other.
    #[error("the {gear}'s tip runs into its mate's root circle: clearance {clearance_mm:.4} mm")]
    TipClearance {
        /// Gear whose tip it is.
        gear: &'static str,
        /// Clearance, mm; negative here.
        clearance_mm: f64,
    },
    /// The tip of one gear cuts into the fillet of the other.
    #[error(
        "interference at the root: the {tip}'s tip enters the fillet of the {root} by {depth_mm:.4} mm; its teeth are involute \
         from diameter {form_diameter_mm:.3} mm only"
    )]
    Interference {
        /// Gear whose tip it is.
        tip: &'static str,
        /// Gear whose fillet it is.
        root: &'static str,
        /// Largest depth along the arc in the transverse section, mm.
        depth_mm: f64,
        /// Root form diameter of the gear whose fillet is cut, mm.
        form_diameter_mm: f64,
    },
    /// A ring is given as gear 1, or runs inside a ring.
    #[error("the pinion is an internal gear: a ring is the wheel of its pair")]
    InternalPinion,
    /// The tips of a ring and of the inner gear collide away from the path of contact.
    #[error(
        "trochoid interference: the tip corners of pinion and ring run into each other by {:.4} deg of the ring",
        -margin.to_degrees()
    )]
    Trochoid {
        /// Angle of the ring by which the tip corners clear each other, rad; negative here.
        margin: f64,
        /// Largest tip diameter of the pinion without this interference, mm; `None` if no tip is short enough.
        pinion_tip_mm: Option<f64>,
    },
    /// The ring's tip reaches below the pinion's base circle or into its fillet.
    #[error(
        "involute interference: the ring's tip ({tip_diameter_mm:.3} mm) asks for involute of the pinion from {path_mm:.4} mm on \
         along the line of action, which has it from {form_mm:.4} mm on; the tip enters the pinion by {depth_mm:.4} mm"
    )]
    Involute {
        /// Tip diameter of the ring, mm; negative.
        tip_diameter_mm: f64,
        /// Path coordinate at which the ring's tip touches, measured from the pinion's tangent point, mm.
        path_mm: f64,
        /// Path coordinate at which the pinion's involute starts, mm.
        form_mm: f64,
        /// Largest depth along the arc in the transverse section, mm.
        depth_mm: f64,
        /// Tip diameter of the ring at which its tip stays on the pinion's involute, mm; `None` if there is none.
        ring_tip_mm: Option<f64>,
    },
    /// The shaper cuts away the tips of the ring.
    #[error(
        "the shaper of {teeth} teeth interferes with the tips of the ring that it makes: {}", match kind {
            InternalInterference::Involute => format!("they reach {:.4} mm below its base circle along the line of action", -amount),
            InternalInterference::Trochoid => format!("its tip corners run into them by {:.4} deg of the ring", -amount.to_degrees()),
        }
    )]
    ShaperInterference {
        /// Kind of the interference.
        kind: InternalInterference,
        /// Margin in mm along the line of action, or in rad of the ring; negative here.
        amount: f64,
        /// Number of teeth of the shaper.
        teeth: u32,
        /// Nearest number of shaper teeth without interference.
        cure: Option<u32>,
    },
    /// The teeth do not reach each other.
    #[error(
        "the pair has no path of contact: the tips reach {overlap_mm:.4} mm into each other along the line of action"
    )]
    NoContact {
        /// Length of the path of contact, mm; zero or negative here.
        overlap_mm: f64,
    },
    /// The gears have no common face: they pass each other axially.
    #[error(
        "the faces do not overlap: the pinion's is from {:.4} to {:.4} mm, the wheel's from {:.4} to {:.4} mm over the \
         pinion's mid-face", pinion_mm[0], pinion_mm[1], wheel_mm[0], wheel_mm[1]
    )]
    FacesApart {
        /// End faces of the pinion, measured from its mid-face, mm.
        pinion_mm: [f64; 2],
        /// End faces of the wheel, measured from the pinion's mid-face, mm.
        wheel_mm: [f64; 2],
    },
    /// There are moments at which no pair of teeth is in contact.
    #[error("total contact ratio {contact_ratio:.4} is below 1: the teeth lose each other")]
    ContactRatio {
        /// Total contact ratio eps_gamma.
        contact_ratio: f64,
        /// The gear whose flank is undercut by its rack; `None` if neither is.
        undercut: Option<Undercut>,
    },
    /// A place along the profile that lies off the flank.
    #[error("{name}: {value:.4} {unit} is not on the flank, which reaches from {low:.4} to {high:.4}")]
    OffFlank {
        /// Name of the feature that was placed there.
        name: &'static str,
        /// Place that was requested.
        value: f64,
        /// Unit of the three values `value`, `low` and `high`.
        unit: &'static str,
        /// Value at the root form circle.
        low: f64,
        /// Value at the tip circle.
        high: f64,
    },
    /// A topography whose grid does not cover the flank.
    #[error("the topography covers less than half of the flank {direction}")]
    GridOffFlank {
        /// `along the profile` or `across the face`.
        direction: &'static str,
    },
    /// A topography of a tooth that the gear does not have.
    #[error("the topography has a tooth {tooth}, but the gear has teeth 0 to {}", teeth.saturating_sub(1))]
    NoSuchTooth {
        /// Number of the tooth.
        tooth: u32,
        /// Number of teeth of the gear.
        teeth: u32,
    },
    /// A list of pitch errors whose length differs from the number of teeth.
    #[error("{given} pitch errors for {teeth} teeth")]
    PitchErrors {
        /// Number of values given.
        given: usize,
        /// Number of teeth of the gear.
        teeth: u32,
    },
}

impl GeometryError {
    /// What the user can do next.
    pub fn hint(&self) -> Option<String> {
        Some(match self {
            Self::OutOfRange { name, expected, .. } => format!("give {name} {expected}"),
            Self::PointedTooth { pointed_diameter_mm, .. } => {
                format!(
                    "lower the profile shift or the addendum, or set the tip diameter below {pointed_diameter_mm:.3} mm"
                )
            }
            Self::Thickness { .. } => "raise the profile shift, or lower the thickness allowance".into(),
            Self::RootRadius { largest, .. } => format!("use a root radius coefficient of at most {largest:.4}"),
            Self::Bore { root_diameter_mm, .. } => {
                format!("a rim of about two modules needs a bore well below {root_diameter_mm:.1} mm")
            }
            Self::Mismatch { .. } => "both gears of a pair share module, pressure angle and helix angle".into(),
            Self::CentreDistance { least_mm, .. } => format!("the centre distance must exceed {least_mm:.4} mm"),
            Self::Jammed { ring_shift: Some(x), .. } => format!(
                "the centre distance fits a ring of profile shift {x}: ISO 21771 has minus the sign of conventions with z_2 > 0"
            ),
            Self::Jammed { nominal_mm, .. } => {
                // A pinion has more room nearer to the axis of its ring.
                let [way, raise] = if *nominal_mm < 0.0 { ["lower", " raise"] } else { ["raise", ""] };
                let fits = nominal_mm.abs();
                format!(
                    "{way} the centre distance (teeth of full thickness fit at {fits:.4} mm) or{raise} the thickness allowances"
                )
            }
            Self::TipClearance { .. } => "raise the centre distance or the dedendum, or shorten the tip".into(),
            Self::Interference { tip, root, .. } => format!(
                "shorten the {tip}'s tip (addendum, tip diameter), raise the dedendum or the centre distance, or shift the {root}'s profile outwards"
            ),
            Self::InternalPinion => {
                "make the ring the wheel: exchange the tables [pinion] and [wheel], and `driver` with them".into()
            }
            Self::Trochoid { pinion_tip_mm: Some(tip), .. } => {
                format!("set `tip_diameter_mm` of the pinion to {tip}")
            }
            Self::Involute { ring_tip_mm: Some(tip), .. } => format!("set `tip_diameter_mm` of the ring to {tip}"),
            Self::Trochoid { .. } | Self::Involute { .. } => {
                "take fewer teeth of the pinion, or a larger pressure angle".into()
            }
            Self::ShaperInterference { cure: Some(teeth), .. } => format!("set `teeth` of the shaper to {teeth}"),
            Self::ShaperInterference { .. } => {
                "no shaper of this shift makes these tips: shorten them (`tip_diameter_mm`, `addendum_coefficient`)"
                    .into()
            }
            Self::NoContact { .. } => "lower the centre distance or raise the tip diameters".into(),
            Self::FacesApart { pinion_mm, wheel_mm } => {
                let widths = 0.5 * (pinion_mm[1] - pinion_mm[0] + wheel_mm[1] - wheel_mm[0]);
                format!("the offset of the mid-faces must be less than half of both face widths, {widths:.4} mm")
            }
            Self::ContactRatio { undercut: Some(Undercut { gear, cure, moves_axes }), .. } => match cure {
                Some([pinion, wheel]) => format!(
                    "the rack undercuts the {gear}, which takes away its flank: set `profile_shift` of the pinion to \
                     {pinion} and of the wheel to {wheel}{}",
                    if *moves_axes { ", and leave `centre_distance_mm` out" } else { "" }
                ),
                None => format!(
                    "the rack undercuts the {gear}, which takes away its flank, and no profile shift gives it back: more \
                     teeth, or a larger pressure angle"
                ),
            },
            Self::ContactRatio { .. } => {
                "lower the centre distance, or raise addendum, helix angle or face width".into()
            }
            Self::OffFlank { name, low, high, .. } => format!("put the {name} between {low:.4} and {high:.4}"),
            Self::GridOffFlank { .. } => {
                "rows are diameters (not radii) in mm or roll angles in deg, columns heights in mm from mid-face".into()
            }
            Self::NoSuchTooth { .. } => "count teeth from 0, as pitch errors are".into(),
            Self::PitchErrors { teeth, .. } => format!("give {teeth} values, tooth 0 first"),
        })
    }
}
