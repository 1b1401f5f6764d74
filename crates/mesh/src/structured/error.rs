//! Reasons for which a gear cannot be meshed.

/// Errors of the structured mesher.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StructuredError {
    /// The order is neither linear nor quadratic.
    #[error("order = {order}: elements are of order 1 or 2")]
    Order {
        /// Order requested.
        order: u32,
    },
    /// A number of elements that is too small.
    #[error("{name} = {value}: at least {least}, at most 10000")]
    Count {
        /// Name of the option.
        name: &'static str,
        /// Value of the option.
        value: u32,
        /// Smallest permitted value.
        least: u32,
    },
    /// A sector of zero teeth, or of all teeth.
    #[error("a sector of {teeth} teeth cannot be cut from a gear of {gear_teeth}")]
    Sector {
        /// Number of teeth requested.
        teeth: u32,
        /// Number of teeth of the gear.
        gear_teeth: u32,
    },
    /// The bore is too close to the fillets: it reaches the neck between tooth and rim.
    #[error("bore diameter {bore_diameter_mm:.3} mm leaves too thin a rim: at most {largest_mm:.3} mm can be meshed")]
    RimTooThin {
        /// Bore diameter, mm.
        bore_diameter_mm: f64,
        /// Largest bore diameter that can be meshed, mm.
        largest_mm: f64,
    },
    /// Too few elements along the face for a steep helix: the elements would be twisted too much.
    #[error("elements_face = {elements_face}: each layer would turn by {turn_deg:.1} deg, at most {most_deg:.1}")]
    Twist {
        /// Elements along the face requested.
        elements_face: u32,
        /// Rotation of the section over one element, deg.
        turn_deg: f64,
        /// Limit, deg.
        most_deg: f64,
        /// Elements along the face that are sufficient.
        least: u32,
    },
    /// The shape cannot be filled with valid elements.
    #[error(
        "element in column {column}, row {row} of the {block} is too distorted: \
         scaled Jacobian {scaled_jacobian:.3}, at least {least} needed"
    )]
    Distorted {
        /// Part of the mesh: `tooth` (rows from the tip, columns from the right flank) or `rim` (rows from the fillet,
        /// columns from cut to cut).
        block: &'static str,
        /// Row, from 0.
        row: usize,
        /// Column, from 0.
        column: usize,
        /// Worst scaled Jacobian at the nodes of the element.
        scaled_jacobian: f64,
        /// Limit.
        least: f64,
    },
    /// The mesh would have more nodes than can be solved.
    #[error("the mesh would have up to {nodes} nodes: at most {most} are made")]
    TooLarge {
        /// Nodes requested, an upper estimate.
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
