//! Degrees of freedom of gears before and after their reduction.

use ltca::StaticModel;
use reduction::{ElasticGear, GearReducer};

/// The reducer of a gear; `None` for a gear with all its degrees of freedom.
pub fn reduced(gear: &ElasticGear) -> Option<&GearReducer> {
    match gear {
        ElasticGear::Reduced(r) => Some(r),
        ElasticGear::Full(_) => None,
    }
}

/// Free degrees of freedom of a gear's mesh.
pub(crate) fn free_dofs(gear: &ElasticGear) -> usize {
    match gear {
        ElasticGear::Reduced(r) => r.free_count(),
        ElasticGear::Full(f) => f.dofs.free_count(),
    }
}

/// Degrees of freedom that the analysis carries; `before` where nothing is reduced.
pub(crate) fn dof_after(model: &StaticModel, before: [usize; 2]) -> [usize; 2] {
    match model.contact_set().windows() {
        Some(windows) => [0, 1].map(|i| windows[i].reduced.coordinates()),
        None => before,
    }
}
