//! The elastic gears of an analysis, reduced or with all their degrees of freedom.

use crate::{GearReducer, ReductionError, Window, elastic_bore::ElasticBore};
use fem::{DofMap, ElementOptions, Material, SymmetricMatrix};
use mesh::{BoreCoupling, MeshedGear};

/// A gear with all its degrees of freedom, held at its bore.
#[derive(Debug)]
pub struct FullGear {
    /// The meshed gear.
    pub gear: MeshedGear,
    /// Material of the gear.
    pub material: Material,
    /// Element variants.
    pub elements: ElementOptions,
    /// Free degrees of freedom.
    pub dofs: DofMap,
    /// Stiffness K, N/mm.
    pub stiffness: SymmetricMatrix,
}

impl FullGear {
    /// Assembles the gear.
    ///
    /// # Errors
    /// [`ReductionError::Fem`]; [`ReductionError::NotReduced`] for a bore with distributing coupling.
    pub fn new(gear: MeshedGear, material: Material, elements: &ElementOptions) -> Result<Self, ReductionError> {
        if gear.bore_coupling() == BoreCoupling::Distributing {
            return Err(ReductionError::NotReduced);
        }
        let dofs = DofMap::new(gear.mesh().nodes.len(), gear.held_nodes());
        let bore = ElasticBore::of(&gear);
        let stiffness = ElasticBore::stiffness(bore.as_ref(), gear.mesh(), (&material, elements), &dofs)?;
        Ok(Self { gear, material, elements: *elements, dofs, stiffness })
    }
}

/// A gear of an analysis.
#[derive(Debug)]
#[allow(clippy::large_enum_variant, reason = "two of them live as long as the program")]
pub enum ElasticGear {
    /// Reduced to its flanks, or to coarse grids over them.
    Reduced(GearReducer),
    /// With all its degrees of freedom.
    Full(FullGear),
}

impl ElasticGear {
    /// The reduced window whose first tooth is `first`; `None` for a gear with all its degrees of freedom.
    ///
    /// # Errors
    /// [`ReductionError`].
    pub fn window(&self, first: u32) -> Result<Option<Window>, ReductionError> {
        match self {
            Self::Reduced(r) => r.window(first).map(Some),
            Self::Full(_) => Ok(None),
        }
    }

    /// Whether the window that starts at tooth `first` has the same matrices as another window. No matrix is computed
    /// for the answer.
    pub fn shares_matrices(&self, window: &Window, first: u32) -> bool {
        match self {
            Self::Reduced(r) => r.shares_matrices(window, first),
            Self::Full(_) => false,
        }
    }

    /// The meshed gear.
    pub fn gear(&self) -> &MeshedGear {
        match self {
            Self::Reduced(r) => r.gear(),
            Self::Full(f) => &f.gear,
        }
    }

    /// The material of the gear.
    pub fn material(&self) -> &Material {
        match self {
            Self::Reduced(r) => r.material(),
            Self::Full(f) => &f.material,
        }
    }
}
