//! Interface of the contact from which a map is sampled.

/// The contact of one side of the teeth at one phase.
pub trait PhaseContact {
    /// Error of the contact.
    type Error;

    /// Deepest overlap of the undeformed flanks along their normal, mm; negative if they are apart.
    fn overlap(&mut self, approach: f64, tilt: f64) -> f64;

    /// The contact at an approach (mm) and a tilt (rad).
    ///
    /// # Errors
    /// [`Self::Error`] if the contact cannot be solved.
    fn sample(&mut self, approach: f64, tilt: f64) -> Result<ContactSample, Self::Error>;
}

/// The contact at one approach and tilt.
#[derive(Debug, Clone, PartialEq)]
pub struct ContactSample {
    /// Force along the approach, +dV/d approach, N.
    pub force: f64,
    /// dF/d approach, N/mm.
    pub stiffness: f64,
    /// Loaded slices.
    pub slices: Vec<LoadedSlice>,
}

/// A loaded slice.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LoadedSlice {
    /// Normal force, N.
    pub force: f64,
    /// Length of contact line, mm.
    pub length: f64,
    /// Lever about the axis of the tilt, mm: approach of the slice per unit of tilt.
    pub lever: f64,
    /// Number of its tooth pair; one cycle later pair m + 1 is where pair m is now.
    pub pair: i64,
    /// Friction of the slice: force on gear 1 along the sliding direction, N, its moment with the position along the
    /// path of contact as lever, and its moment with the position over the face as lever, N mm. Theory (74b).
    pub friction: [f64; 3],
}
