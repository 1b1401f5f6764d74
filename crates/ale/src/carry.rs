//! Generalised coordinates at a tooth change. Theory (15).

use reduction::{GearReducer, Window};

use crate::AleError;

/// Coordinates of the window `to` that describe the displacement (or velocity) field that `coordinates` describe in
/// the window `from`.
///
/// ```text
/// kept teeth:    u_B(new) = u_B(old)
/// oncoming one:  u_B(new) = rows of Phi_IC of the old window times u_B(old)
/// ```
/// Both in the window's own frame, three values a boundary node, so a change of frame turns them. With the outgoing tooth
/// unloaded the field is the same before and after: its boundary displacement was what the constraint modes of the new
/// window give. Starting the oncoming tooth from zero instead would tear the field.
///
/// # Errors
/// [`AleError::Reduction`] when the coordinates do not fit the window.
pub fn carry_coordinates(
    gear: &GearReducer,
    from: &Window,
    to: &Window,
    coordinates: &[f64],
) -> Result<Vec<f64>, AleError> {
    Ok(gear.carry(from, to, coordinates)?)
}
