//! Results of a gearbox in static equilibrium at its positions.

use contact::SliceResult;
use ltca::FilletField;

use crate::rolling_bearing::RollingState;

/// Deflection line of a shaft.
#[derive(Debug, Clone, PartialEq)]
pub struct ShaftLine {
    /// Axial positions of the nodes, mm from the shaft's z = 0, ascending.
    pub positions: Vec<f64>,
    /// Displacements x, y, z (mm) and rotations about them (rad) of each node, common axes.
    pub displacements: Vec<[f64; 6]>,
}

/// Load of a bearing; zero on a held shaft, whose reaction is given separately.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct BearingState {
    /// Force on the shaft, N.
    pub force: [f64; 3],
    /// Moment on the shaft about the bearing's middle, N mm.
    pub moment: [f64; 3],
    /// Displacement of the shaft relative to the seat in the housing, mm, and relative rotations (rad). The fourth and
    /// fifth entries are the tilt that the bearing must tolerate.
    pub displacement: [f64; 6],
}

/// State of a mesh.
#[derive(Debug, Clone, PartialEq)]
pub struct MeshState {
    /// Mesh cycles: whole cycles plus the phase as fraction ([`crate::Train::cycles`]).
    pub cycles: f64,
    /// Displacements of gear 1 and gear 2 from their nominal positions, mm and rad, in the mesh's own axes.
    pub displacements: [f64; 12],
    /// Force on gear 1 and gear 2, N, common axes.
    pub force: [[f64; 3]; 2],
    /// Moment on gear 1 and gear 2 about their centres, N mm, common axes.
    pub moment: [[f64; 3]; 2],
    /// Sum of the normal forces, N.
    pub normal_force: f64,
    /// Transmission error from the rotations of both gears, mm on the transverse line of action; positive if the driven
    /// gear lags.
    ///
    /// ```text
    /// te = s (r_b1 theta_1 + r_b2 theta_2)      theta: turns about +z beside the nominal ones, s = +1 left, -1 right flanks
    /// ```
    /// It includes the deflection of the axes, for which the driven gear compensates by a larger lag.
    pub transmission_error: f64,
    /// f_in: deviation of gear 2's axis from gear 1's in the plane of action, mm over the face width; positive if the
    /// gap opens with increasing z ([`contact::Misalignment`]). It is caused only by shafts, bearings and housing.
    pub misalignment_in_plane: f64,
    /// f_across: the same deviation perpendicular to the plane of action.
    pub misalignment_across: f64,
    /// Loaded slices, for elements with slices: the line load over the face width.
    pub slices: Vec<SliceResult>,
    /// Stress in the root fillets of the windows of gear 1 and gear 2, for elements that compute it.
    pub root_stress: [Vec<FilletField>; 2],
}

impl MeshState {
    /// Tilt of gear 1 (0) or gear 2 (1): angle of its axis from the nominal one, rad.
    ///
    /// ```text
    /// tilt = sqrt(theta_x^2 + theta_y^2)
    /// ```
    pub fn tilt(&self, gear: usize) -> f64 {
        let [x, y] = [3, 4].map(|k| self.displacements.get(6 * gear + k).copied().unwrap_or(f64::NAN));
        x.hypot(y)
    }
}

/// Residuals of a solved position.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GearboxCertificate {
    /// Residual forces at the seats before the last small step, divided by the load, in the norm of the compliance.
    pub residual: f64,
    /// Largest sum of forces, or of moments, on a shaft, divided by the largest one that acts on it: meshes, torques,
    /// bearings.
    pub body_balance: f64,
    /// Number of Newton steps.
    pub iterations: usize,
}

/// Results of a gearbox at one angle of its input.
#[derive(Debug, Clone, PartialEq)]
pub struct GearboxPosition {
    /// Angle of the input shaft from its start, rad about +z.
    pub input_angle: f64,
    /// Shafts in their order.
    pub shafts: Vec<ShaftLine>,
    /// Bearings in their order.
    pub bearings: Vec<BearingState>,
    /// Details of those bearings that have rolling elements.
    pub rolling: Vec<Option<RollingState>>,
    /// Forces of the laminae of those that press the bore of a gear, roller by roller of each row in turn, N
    /// ([`crate::rolling_bearing::RollingBearing::zone_of`]); none of the others.
    pub laminae: Vec<Vec<f64>>,
    /// Forces of the bolts of each disc on its gear; none of discs without bolts, and of meshes that are not exact or not joined.
    pub bolts: Vec<Vec<crate::BoltForce>>,
    /// Meshes in their order.
    pub meshes: Vec<MeshState>,
    /// Torque that holds the input, N mm about +z.
    pub input_torque: f64,
    /// Force (N) and moment about its origin (N mm) that hold a held shaft; `None` for shafts in bearings.
    pub held_reactions: Vec<Option<[f64; 6]>>,
    /// Lag of the discs with torques behind their nominal rotation, rad, in the order of the torques: the transmission
    /// error from input to output.
    pub output_lags: Vec<f64>,
    /// Residuals of the solution.
    pub certificate: GearboxCertificate,
}

/// K_Hbeta of a mesh over several positions, for a face with `slices` slices ([`ltca::face_load_factor`]); `None` if
/// its element has no slices, and without load.
pub fn face_load_factor(positions: &[GearboxPosition], mesh: usize, slices: usize) -> Option<f64> {
    let of_mesh = positions.iter().filter_map(|p| p.meshes.get(mesh));
    ltca::face_load_factor(slices, of_mesh.flat_map(|m| &m.slices))
}

/// Heights on gear 1 (mm, ascending), each with its largest line load (N/mm) over several positions.
pub fn line_load(positions: &[GearboxPosition], mesh: usize) -> Vec<(f64, f64)> {
    let of_mesh = positions.iter().filter_map(|p| p.meshes.get(mesh));
    let mut of_height = ltca::load_envelope(of_mesh.flat_map(|m| &m.slices));
    of_height.sort_by(|a, b| a.0.total_cmp(&b.0));
    of_height
}
