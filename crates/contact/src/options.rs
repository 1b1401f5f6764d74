//! Options of the contact of a pair.

use geometry::{Driver, GearPair, Sense, Side};

use crate::{Offset, complementarity::Law, flank::GapSource};

/// Discretisation of contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Method {
    /// One line load per axial slice; bulk compliance from the mesh, local compliance in closed form.
    Slice,
    /// Points of the flank mesh.
    Nodal,
}

/// Storage of the bulk compliance of slices.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Bulk {
    /// The mesh's own matrices, entry by entry.
    Exact,
    /// Interpolated in a table ([`crate::BulkTable`]) with an error of at most this share of the largest
    /// self-compliance of a slice. Exact if no table of reasonable size reaches this error.
    Table(f64),
}

impl Default for Bulk {
    /// A table good to a thousandth: the transmission error is off by less than a ten thousandth then.
    fn default() -> Self {
        Self::Table(1e-3)
    }
}

/// Which flanks touch, where the gears are, and how contact is discretised.
#[derive(Debug, Clone, PartialEq)]
pub struct ContactOptions {
    /// Driving gear.
    pub driver: Driver,
    /// Sense of rotation of the pinion.
    pub sense: Sense,
    /// Slices or points.
    pub method: Method,
    /// Slices over the face width.
    pub slices: usize,
    /// Storage of the bulk compliance of slices, for reduced gears.
    pub bulk: Bulk,
    /// Whether tip edges may touch off the line of action, as those of deflected teeth do ([`Method::Slice`]). Without
    /// it, which is for study only, slices end where the undeflected flanks end, and the transmission error jumps
    /// whenever a pair enters or leaves contact under load.
    pub corner_contact: bool,
    /// Coefficient of friction.
    pub friction: f64,
    /// Contact law of points.
    pub law: Law,
    /// Surfaces between which gaps are measured: smooth flanks or faces of the mesh.
    pub gap: GapSource,
    /// Gauss points along each edge of a flank face.
    pub points_per_face_edge: usize,
    /// Whether both flanks of the window's teeth are kept, not only the driving ones.
    pub both_flanks: bool,
    /// Tolerance for the distance of a flank node from the smooth nominal flank, mm.
    pub surface_tolerance: f64,
    /// Rigid displacements of pinion and wheel: misalignment.
    pub offsets: [Offset; 2],
    /// Angle by which the zero of the transmission error differs from the wheel angle at which the unloaded flanks
    /// touch, rad.
    pub wheel_turn: f64,
}

impl ContactOptions {
    /// Defaults for `pair`: the pinion drives and rotates counter-clockwise, 32 slices, exact contact, 6 points per
    /// edge.
    pub fn new(pair: &GearPair) -> Self {
        Self {
            driver: Driver::Pinion,
            sense: Sense::Ccw,
            method: Method::Slice,
            slices: 32,
            bulk: Bulk::default(),
            corner_contact: true,
            friction: 0.0,
            law: Law::Exact,
            gap: GapSource::Smooth,
            points_per_face_edge: 6,
            both_flanks: false,
            surface_tolerance: 0.01 * pair.pinion.data().normal_module,
            offsets: [Offset::default(); 2],
            wheel_turn: 0.0,
        }
    }

    /// The pinion flanks that carry the load.
    pub fn side(&self) -> Side {
        self.driver.loaded_side(self.sense)
    }

    /// Sides of the teeth whose flanks are kept.
    pub fn sides(&self) -> Vec<Side> {
        if self.both_flanks { vec![self.side(), self.side().opposite()] } else { vec![self.side()] }
    }

    /// Index of the driven gear: 0 for the pinion, 1 for the wheel.
    pub fn driven(&self) -> usize {
        self.driver.driven()
    }
}
