//! What can keep a gear from being meshed.

/// Why the structured mesher gives no mesh.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StructuredError {
    /// Only linear and quadratic elements exist.
    #[error("order = {order}: elements are of order 1 or 2")]
    Order {
        /// Order asked for.
        order: u32,
    },
    /// A number of elements without meaning.
    #[error("{name} = {value}: at least {least}, at most 10000")]
    Count {
        /// Name of the option.
        name: &'static str,
        /// Value of the option.
        value: u32,
        /// Least value.
        least: u32,
    },
    /// A sector of no teeth, or of all.
    #[error("a sector of {teeth} teeth cannot be cut from a gear of {gear_teeth}")]
    Sector {
        /// Teeth asked for.
        teeth: u32,
        /// Teeth of the gear.
        gear_teeth: u32,
    },
    /// The bore reaches the tooth's neck.
    #[error("bore diameter {bore_diameter_mm:.3} mm leaves too thin a rim: at most {largest_mm:.3} mm can be meshed")]
    RimTooThin {
        /// Bore diameter, mm.
        bore_diameter_mm: f64,
        /// Largest bore diameter that can be meshed, mm.
        largest_mm: f64,
    },
    /// Too few elements along the face of a steep helix: they would be wrung out.
    #[error("elements_face = {elements_face}: each layer would turn by {turn_deg:.1} deg, at most {most_deg:.1}")]
    Twist {
        /// Elements along the face asked for.
        elements_face: u32,
        /// Turn of the section over one element, deg.
        turn_deg: f64,
        /// Limit, deg.
        most_deg: f64,
        /// Elements along the face that suffice.
        least: u32,
    },
    /// The shape cannot be filled with sound elements.
    #[error(
        "element in column {column}, row {row} of the {block} is too distorted: \
         scaled Jacobian {scaled_jacobian:.3}, at least {least} needed"
    )]
    Distorted {
        /// `tooth` (rows from the tip, columns from the right flank) or `rim` (rows from the fillet, columns from cut
        /// to cut).
        block: &'static str,
        /// Row, from 0.
        row: usize,
        /// Column, from 0.
        column: usize,
        /// Worst scaled Jacobian at its nodes.
        scaled_jacobian: f64,
        /// Limit.
        least: f64,
    },
    /// More nodes than anything here could solve.
    #[error("the mesh would have up to {nodes} nodes: at most {most} are made")]
    TooLarge {
        /// Nodes asked for, from above.
        nodes: u128,
        /// Limit.
        most: u32,
    },
}

impl StructuredError {
    /// What the user can do next.
    pub fn hint(&self) -> Option<String> {
        Some(match self {
            Self::Order { .. } => "order 2 pays in tooth bending; order 1 is for quick looks".into(),
            Self::Count { name, least, .. } => format!("set {name} to {least} or more"),
            Self::Sector { gear_teeth, .. } => {
                format!("take 1 to {} teeth, or the whole gear", gear_teeth.saturating_sub(1))
            }
            Self::RimTooThin { largest_mm, .. } => format!("make the bore smaller than {largest_mm:.3} mm"),
            Self::Twist { least, .. } => format!("set elements_face to {least} or more"),
            Self::Distorted { block: "tooth", .. } => {
                "raise elements_profile and elements_fillet, or lower helix angle or undercut".into()
            }
            Self::Distorted { .. } => "raise elements_fillet, or make the bore smaller".into(),
            Self::TooLarge { .. } => "lower the element counts, or mesh a periodic sector".into(),
        })
    }
}
