//! Contact that a map is sampled from.

/// The contact of one side of the teeth at one phase, as a map asks for it.
pub trait PhaseContact {
    /// Error of the contact.
    type Error;

    /// Deepest overlap of the undeformed flanks along their normal, mm; negative where they are apart.
    fn overlap(&mut self, approach: f64, tilt: f64) -> f64;

    /// The contact at an approach (mm) and a tilt (rad).
    ///
    /// # Errors
    /// [`Self::Error`].
    fn sample(&mut self, approach: f64, tilt: f64) -> Result<ContactSample, Self::Error>;
}

/// The contact at one approach and tilt.
#[derive(Debug, Clone, PartialEq)]
pub struct ContactSample {
    /// Force along the approach, -dV/d approach turned round, N.
    pub force: f64,
    /// dF/d approach, N/mm.
    pub stiffness: f64,
    /// Slices that carry load.
    pub slices: Vec<LoadedSlice>,
}

/// A slice that carries load.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LoadedSlice {
    /// Normal force, N.
    pub force: f64,
    /// Length of contact line, mm.
    pub length: f64,
    /// Lever about the axis of the tilt, mm: approach of the slice per tilt.
    pub lever: f64,
    /// Number of its pair of teeth: at a phase one cycle later pair m + 1 stands where pair m stands now.
    pub pair: i64,
    /// Friction there: force on gear 1 along the sliding, N, its moment by the place along the path of contact and its
    /// moment by the place over the face, N mm. Theory (74b).
    pub friction: [f64; 3],
}
