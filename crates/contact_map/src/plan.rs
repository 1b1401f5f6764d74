//! Requirements for a map. Theory (73).

/// Plan of a map: range and tolerances.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MapPlan {
    /// Mean force of the pair, N; errors are relative to the mean approach under it.
    pub mean_force: f64,
    /// Largest force, N.
    pub largest_force: f64,
    /// Smallest and largest tilt, rad; `None` if the scene has no tilt.
    pub tilt: Option<[f64; 2]>,
    /// Face width, mm.
    pub width: f64,
    /// Half of the path of contact, mm, for flanks with friction. Errors of the moment of friction along the path are
    /// relative to it. `None` without friction.
    pub half_path: Option<f64>,
    /// Target for the root mean square error of the approach, divided by the mean approach.
    pub tolerance: f64,
    /// Largest permitted error if a finer map would cost too many contacts; at least `tolerance`.
    pub worst: f64,
}
