//! Options of the contact of a pair.

use geometry::{Driver, GearPair, Sense, Side};

use crate::{Offset, complementarity::Law, flank::GapSource};

/// Discretisation of contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Method {
    /// One line load an axial slice; bulk compliance from the mesh, local compliance in closed form.
    Slice,
    /// Points of the flank mesh.
    Nodal,
}

/// Storage of the bulk compliance behind slices.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Bulk {
    /// The mesh's own matrices, entry by entry.
    Exact,
    /// Interpolated in a table ([`crate::BulkTable`]) that is off by at most this share of the largest self-compliance
    /// of a slice; exact where no table of reasonable size is.
    Table(f64),
}

impl Default for Bulk {
    /// A table good to a thousandth: the transmission error is off by less than a ten thousandth then.
    fn default() -> Self {
        Self::Table(1e-3)
    }
}

/// Which flanks touch, where the gears stand, and how contact is made discrete.
#[derive(Debug, Clone, PartialEq)]
pub struct ContactOptions {
    /// Driving gear.
    pub driver: Driver,
    /// Sense in which the pinion turns.
    pub sense: Sense,
    /// Slices or points.
    pub method: Method,
    /// Slices over the face width.
    pub slices: usize,
    /// How the bulk compliance behind slices is held, for reduced gears.
    pub bulk: Bulk,
    /// Let tip edges press off the line of action, as deflected teeth do ([`Method::Slice`]). Off, for study only:
    /// slices end where the undeflected flanks end, and the transmission error steps whenever a pair comes or goes
    /// under load.
    pub corner_contact: bool,
    /// Coefficient of friction.
    pub friction: f64,
    /// Contact law of points.
    pub law: Law,
    /// Gaps between smooth flanks or between the faces of the mesh.
    pub gap: GapSource,
    /// Gauss points along each edge of a flank face.
    pub points_per_face_edge: usize,
    /// Keep both flanks of the window's teeth, not the driving ones alone.
    pub both_flanks: bool,
    /// How far a flank node may lie from the smooth nominal flank, mm.
    pub surface_tolerance: f64,
    /// Rigid displacement of pinion and wheel: misalignment.
    pub offsets: [Offset; 2],
    /// Turn by which the wheel stands off where the unloaded flanks touch, rad: transmission error counts from there.
    pub wheel_turn: f64,
}

impl ContactOptions {
    /// Defaults for `pair`: pinion drives counter-clockwise, 32 slices, exact contact, 6 points an edge.
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

    /// The pinion's flanks that carry the load.
    pub fn side(&self) -> Side {
        self.driver.loaded_side(self.sense)
    }

    /// Sides of the teeth whose flanks are kept.
    pub fn sides(&self) -> Vec<Side> {
        if self.both_flanks { vec![self.side(), self.side().opposite()] } else { vec![self.side()] }
    }

    /// Index of the driven gear: 0 pinion, 1 wheel.
    pub fn driven(&self) -> usize {
        self.driver.driven()
    }
}
