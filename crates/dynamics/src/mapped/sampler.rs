//! The contact of elastic gears as a contact map asks for it.

use contact_map::{ContactSample, LoadedSlice, PhaseContact};
use geometry::GearPair;
use ltca::StaticError;
use nalgebra::DVector;

use super::Projection;
use crate::{COORDINATES, Displacement, elastic_displacement::ElasticDisplacement, mesh_side::MeshSide};

/// One side of the teeth at one phase.
pub(super) struct SidePhase<'a> {
    pub pair: &'a GearPair,
    pub side: MeshSide,
    pub cycles: f64,
    pub projection: &'a Projection,
    /// Displacements that the map is made about.
    pub about: &'a Displacement,
}

impl SidePhase<'_> {
    fn displaced(&self, approach: f64, tilt: f64) -> ElasticDisplacement {
        let Self { projection, about, .. } = self;
        let rest = [approach - projection.approach.dot(about), tilt - projection.tilt.dot(about)];
        ElasticDisplacement { d: *about + projection.displacement(rest[0], rest[1]), q: DVector::zeros(0) }
    }
}

impl PhaseContact for SidePhase<'_> {
    type Error = StaticError;

    fn overlap(&mut self, approach: f64, tilt: f64) -> f64 {
        let at = self.displaced(approach, tilt);
        let poses = self.side.poses(self.pair, self.cycles, &at.d);
        self.side.undeformed_overlap(&poses)
    }

    fn sample(&mut self, approach: f64, tilt: f64) -> Result<ContactSample, StaticError> {
        let at = self.displaced(approach, tilt);
        self.side.forget();
        let force = self.side.evaluate(self.pair, self.cycles, &at, true)?;
        let turn = 2 * COORDINATES - 1;
        let per_turn = self.projection.approach[turn];
        let slices = self.side.pressed().map(|(position, force, length, pair)| LoadedSlice {
            force,
            length,
            lever: self.projection.lever(&position),
            pair,
        });
        Ok(ContactSample {
            force: -force.normal[turn] / per_turn,
            stiffness: force.stiffness[(turn, turn)] / (per_turn * per_turn),
            slices: slices.collect(),
        })
    }
}
