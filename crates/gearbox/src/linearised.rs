//! A gearbox linearised about its static equilibrium: springs instead of rolling elements. Theory (101).

use crate::{
    GearboxError, GearboxPosition, Structure,
    rolling_bearing::{RollingState, Tangent},
};

impl Structure {
    /// The structure with springs instead of rolling elements, linearised about the mean of several static positions
    /// with the mean of the tangents. Vibration models are made from it; motion models start with it.
    ///
    /// # Errors
    /// [`GearboxError::Count`] if there are no positions, or if they belong to another gearbox.
    pub fn about(&self, positions: &[GearboxPosition]) -> Result<Self, GearboxError> {
        let mut linear = self.clone();
        for (i, bearing) in linear.bearings.iter_mut().enumerate() {
            if bearing.law.take().is_none() {
                continue;
            }
            let states: Vec<RollingState> =
                positions.iter().filter_map(|p| p.rolling.get(i).copied().flatten()).collect();
            let missing = GearboxError::Count { what: "states of a bearing", found: states.len(), wanted: 1 };
            let own = Tangent::about(&states).ok_or(missing)?;
            // Springs act between shaft and seat: of a bore that rolling elements pressed they hold its gear as a rigid ring.
            bearing.bore_of = None;
            // States count from where the seat stands, as the preload of a bearing does.
            bearing.stiffness += own.stiffness;
            bearing.preload += own.preload;
            bearing.stored += own.stored;
        }
        Ok(linear)
    }

    /// Checks that all bearings are springs.
    pub(crate) fn check_linear(&self) -> Result<(), GearboxError> {
        match self.bearings.iter().find(|b| b.law.is_some()) {
            Some(own) => Err(GearboxError::NotLinear { bearing: own.name.clone() }),
            None => Ok(()),
        }
    }
}
