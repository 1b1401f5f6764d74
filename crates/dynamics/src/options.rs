//! What is asked of a quasi-static analysis.

use ale::Sense;
use contact::{GapSource, Law};
use geometry::{GearPair, Side};

use crate::Offset;

/// Which gear drives.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Driver {
    /// Gear 1.
    Pinion,
    /// Gear 2.
    Wheel,
}

/// How contact is made discrete.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Method {
    /// One line load an axial slice; bulk compliance from the mesh, local compliance in closed form.
    Slice,
    /// Points of the flank mesh.
    Nodal,
}

/// How the bulk compliance behind slices is held.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Bulk {
    /// The mesh's own matrices, entry by entry.
    Exact,
    /// Interpolated in a table ([`contact::BulkTable`]) that is off by at most this share of the largest self-compliance of a slice;
    /// exact where no table of reasonable size is.
    Table(f64),
}

impl Default for Bulk {
    /// A table good to a thousandth: the transmission error is off by less than a ten thousandth then.
    fn default() -> Self {
        Self::Table(1e-3)
    }
}

/// Operation, contact and window of a quasi-static analysis.
#[derive(Debug, Clone, PartialEq)]
pub struct StaticOptions {
    /// Which gear drives.
    pub driver: Driver,
    /// Sense in which the pinion turns.
    pub sense: Sense,
    /// Torque on the driven gear, N mm, >= 0.
    pub torque: f64,
    /// Slices or points.
    pub method: Method,
    /// Slices over the face width.
    pub slices: usize,
    /// How the bulk compliance behind slices is held, for reduced gears.
    pub bulk: Bulk,
    /// Let tip edges press off the line of action, as deflected teeth do ([`Method::Slice`]). Off, for study only: slices end where
    /// the undeflected flanks end, and the transmission error steps whenever a pair comes or goes under load.
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
    /// Teeth of the window; `None`: floor(eps_gamma) + 1, at least 3.
    pub window: Option<usize>,
    /// Compute stress in the root fillets at every station.
    pub root_stress: bool,
    /// How far a flank node may lie from the smooth nominal flank, mm.
    pub surface_tolerance: f64,
    /// Rigid displacement of pinion and wheel: misalignment.
    pub offsets: [Offset; 2],
}

impl StaticOptions {
    /// Defaults for a torque (N mm) on the driven gear of `pair`: pinion drives counter-clockwise, exact contact, 6 points an edge.
    pub fn new(torque: f64, pair: &GearPair) -> Self {
        Self {
            driver: Driver::Pinion,
            sense: Sense::Ccw,
            torque,
            method: Method::Slice,
            slices: 32,
            bulk: Bulk::default(),
            corner_contact: true,
            friction: 0.0,
            law: Law::Exact,
            gap: GapSource::Smooth,
            points_per_face_edge: 6,
            both_flanks: false,
            window: None,
            root_stress: false,
            surface_tolerance: 0.01 * pair.pinion.data().normal_module,
            offsets: [Offset::default(); 2],
        }
    }

    /// The pinion's flanks that carry the load: the leading ones when it drives, the trailing ones when it is driven.
    pub fn side(&self) -> Side {
        match (self.driver, self.sense) {
            (Driver::Pinion, Sense::Ccw) | (Driver::Wheel, Sense::Cw) => Side::Left,
            (Driver::Pinion, Sense::Cw) | (Driver::Wheel, Sense::Ccw) => Side::Right,
        }
    }

    /// The same with the other gear as the driver: the options of the coast flanks.
    pub fn driven_backwards(&self) -> Self {
        let driver = match self.driver {
            Driver::Pinion => Driver::Wheel,
            Driver::Wheel => Driver::Pinion,
        };
        Self { driver, ..self.clone() }
    }

    /// Sides of the teeth whose flanks are kept.
    pub fn sides(&self) -> Vec<Side> {
        if self.both_flanks { vec![self.side(), self.side().opposite()] } else { vec![self.side()] }
    }

    /// Index of the driven gear: 0 pinion, 1 wheel.
    pub fn driven(&self) -> usize {
        match self.driver {
            Driver::Pinion => 1,
            Driver::Wheel => 0,
        }
    }
}
