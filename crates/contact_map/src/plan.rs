//! What a map is asked for. Theory (73).

/// Plan of a map: range and tolerances.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MapPlan {
    /// Force that the pair carries on average, N: errors are relative to the mean approach under it.
    pub mean_force: f64,
    /// Largest force, N.
    pub largest_force: f64,
    /// Least and largest tilt, rad; `None` where the scene has none.
    pub tilt: Option<[f64; 2]>,
    /// Width of face, mm.
    pub width: f64,
    /// Half of the path of contact, mm, of flanks with friction: errors of the moment that friction has by its place
    /// there are told over it. `None` without friction.
    pub half_path: Option<f64>,
    /// Root mean square of the approach's error, over the mean approach, that is aimed at.
    pub tolerance: f64,
    /// Error with which a map is taken as well, where a finer one would cost too many contacts; no less than that.
    pub worst: f64,
}
