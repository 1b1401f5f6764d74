//! State of a cheaper model at an instant.

use scene::{Driver, Model, Scene};
use serde::{Deserialize, Serialize};

/// A row of a run: the quantities that every model of a pair with few coordinates has at an instant, and `None` for
/// those that only other models have.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct LumpedRow {
    /// Time, s.
    pub time: f64,
    /// Mesh cycles since the start; only for shafts.
    pub mesh_cycles: Option<f64>,
    /// Angle of the pinion, rad, 0 when pair 0 is in the middle of its path of contact; not for shafts.
    pub pinion_angle: Option<f64>,
    /// Mesh phase, 0 .. 1.
    pub mesh_phase: f64,
    /// Speed of pinion and wheel about +z, rad/s; only for rigid gears.
    pub speeds: Option<[f64; 2]>,
    /// Dynamic transmission error on the transverse line of action, um; positive if the driven gear lags.
    pub transmission_error_um: f64,
    /// Relative displacement of the flanks along the transverse line of action, mm; only for lumped gears.
    pub mesh_deflection: Option<f64>,
    /// Mesh stiffness on the transverse line of action, N/mm; only for lumped gears.
    pub mesh_stiffness: Option<f64>,
    /// Compression of the mesh along the normal, mm, and its rate, mm/s; only for shafts.
    pub compression: Option<[f64; 2]>,
    /// Mesh stiffness along the normal, N/mm; only for shafts.
    pub normal_mesh_stiffness: Option<f64>,
    /// Length of the contact lines, mm, 0 if the flanks are apart; not for shafts.
    pub contact_line_length: Option<f64>,
    /// Number of pairs in contact on the driving side; only for rigid gears.
    pub pairs_in_contact: Option<usize>,
    /// Normal force, N; for a lumped mesh it is negative on the coast flanks, and where a linear mesh pulls.
    pub normal_force: f64,
    /// Friction force on the driver across the line of action, N; only for lumped gears.
    pub friction_force: Option<f64>,
    /// Sum of the normal forces on the coast flanks, N; only for rigid gears, like all fields below.
    pub coast_normal_force: Option<f64>,
    /// Smallest normal force of a slice in contact, N; 0 without contact.
    pub least_slice_force: Option<f64>,
    /// Deepest overlap of driving and coast flanks, mm; negative if they are apart, 0 if nothing is near.
    pub overlap: Option<[f64; 2]>,
    /// Largest normal force of a pair, N.
    pub largest_pair_force: Option<f64>,
    /// Forces x, y, z (N) and moments about x, y, z (N mm) of the mesh on pinion and wheel, about their own centres.
    pub wrench: [[f64; 6]; 2],
    /// The friction part of these forces and moments.
    pub friction_wrench: Option<Box<[[f64; 6]; 2]>>,
    /// Coordinates of the gears, mm and rad, in the order of [`gear_coordinates`].
    pub displacement: Vec<f64>,
    /// Rates of the coordinates, mm/s and rad/s.
    pub velocity: Vec<f64>,
}

impl LumpedRow {
    /// Whether every value is a finite number.
    pub fn is_finite(&self) -> bool {
        let plain = [self.time, self.mesh_phase, self.transmission_error_um, self.normal_force];
        let known = [
            self.mesh_cycles,
            self.pinion_angle,
            self.mesh_deflection,
            self.mesh_stiffness,
            self.normal_mesh_stiffness,
            self.contact_line_length,
            self.friction_force,
            self.coast_normal_force,
            self.least_slice_force,
            self.largest_pair_force,
        ];
        let pairs = [self.speeds, self.compression, self.overlap];
        let wrenches = self.wrench.iter().chain(self.friction_wrench.iter().flat_map(|both| &**both)).flatten();
        let mut all = (plain.iter().chain(known.iter().flatten()))
            .chain(pairs.iter().flatten().flatten())
            .chain(wrenches)
            .chain(&self.displacement)
            .chain(&self.velocity);
        all.all(|x| x.is_finite())
    }
}

/// Direction of a gear's motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CoordinateAxis {
    /// Across the transverse line of action.
    Across,
    /// Along the transverse line of action.
    Along,
    /// Along global x.
    X,
    /// Along global y.
    Y,
    /// Along the axis.
    Z,
    /// About global x.
    TiltX,
    /// About global y.
    TiltY,
    /// About the axis, relative to the nominal rotation.
    Turn,
}

/// Number of an axis among the six of a gear: x, y, z, and the turns about them.
pub(super) fn axis_number(axis: CoordinateAxis) -> usize {
    SIX.iter().position(|a| *a == axis).unwrap_or(SIX.len() - 1)
}

/// A coordinate of a gear.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct GearCoordinate {
    /// 0 for the pinion, 1 for the wheel.
    pub gear: usize,
    /// Direction of the coordinate.
    pub axis: CoordinateAxis,
}

/// Axes of a gear with four coordinates.
const FOUR: [CoordinateAxis; 4] =
    [CoordinateAxis::Across, CoordinateAxis::Along, CoordinateAxis::Z, CoordinateAxis::Turn];
/// Axes of a gear with six coordinates.
pub(super) const SIX: [CoordinateAxis; 6] = [
    CoordinateAxis::X,
    CoordinateAxis::Y,
    CoordinateAxis::Z,
    CoordinateAxis::TiltX,
    CoordinateAxis::TiltY,
    CoordinateAxis::Turn,
];

/// Coordinates of the gears in the rows of a scene's model, in order. For lumped gears the driver's come first, for
/// shafts the pinion's; rigid gears have none in their rows.
pub fn gear_coordinates(scene: &Scene) -> Vec<GearCoordinate> {
    let by_role = match scene.operation.driver {
        Driver::Pinion => [0, 1],
        Driver::Wheel => [1, 0],
    };
    if scene.analysis.model.has_reduced_gears() {
        let of = |gear: usize| scene.gears()[gear].body.iter().flat_map(|b| &b.free).map(move |axis| (gear, *axis));
        let all = of(0).chain(of(1));
        return all.map(|(gear, axis)| GearCoordinate { gear, axis: SIX[axis.number()] }).collect();
    }
    let (gears, axes): ([usize; 2], &[CoordinateAxis]) = match scene.analysis.model {
        Model::Lumped8 => (by_role, &FOUR),
        Model::Lumped12 => (by_role, &SIX),
        Model::Shaft18 => ([0, 1], &SIX),
        _ => return Vec::new(),
    };
    gears.iter().flat_map(|&gear| axes.iter().map(move |&axis| GearCoordinate { gear, axis })).collect()
}
