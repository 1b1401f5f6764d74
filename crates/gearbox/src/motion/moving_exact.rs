//! The exact contact itself as a mesh in motion: every step solves it anew. Theory (81), (93).

use contact::{FlankProjection, SliceResult};

use super::{MeshDamper, MovingMesh, normal_damper::NormalDamper};
use crate::{ExactMesh, GearboxError, MeshElement, MeshReply, Vector12};

/// The driving flanks of an [`ExactMesh`], with a damper along their normal.
///
/// Pitch errors and all else that the pair has are in it. Turns of the nominal motion are turns of the gears: the energy
/// follows the mesh cycles by the moments about their axes.
#[derive(Debug)]
pub struct MovingExactMesh {
    mesh: ExactMesh,
    projection: FlankProjection,
    damping: f64,
    /// Angles of gear 1 and gear 2 a mesh cycle, rad about +z.
    per_cycle: [f64; 2],
    backlash: f64,
    at: Option<(Vector12, MeshReply)>,
}

impl MovingExactMesh {
    /// With a damper along the normal, N s/mm, held at the force of the flanks.
    pub fn new(mesh: ExactMesh, damping: f64) -> Self {
        let (pair, options) = (mesh.pair(), mesh.options());
        let sense = options.contact.sense.sign() as f64;
        let per_cycle = [sense * pair.pinion.pitch_angle(), -sense * pair.wheel.pitch_angle()];
        let backlash = pair.backlash() * pair.base_helix_angle().cos();
        let projection = FlankProjection::new(pair, options.side());
        Self { mesh, projection, damping, per_cycle, backlash, at: None }
    }
}

impl MeshElement for MovingExactMesh {
    fn go_to(&mut self, cycles: f64) -> Result<(), GearboxError> {
        self.at = None;
        self.mesh.go_to(cycles)
    }

    fn evaluate(&mut self, displacements: &Vector12) -> Result<MeshReply, GearboxError> {
        self.at = None;
        let reply = self.mesh.evaluate(displacements)?;
        self.at = Some((*displacements, reply.clone()));
        Ok(reply)
    }

    /// Refuses a window that is too narrow, and a place at which the other flanks would touch.
    fn check(&mut self) -> Result<(), GearboxError> {
        let [overlap, _] = self.overlaps()?;
        if -overlap > self.backlash {
            return Err(GearboxError::BeyondBacklash { gap_mm: -overlap, backlash_mm: self.backlash });
        }
        if overlap > 0.0 { self.mesh.check() } else { Ok(()) }
    }

    fn slices(&self) -> Vec<SliceResult> {
        self.mesh.slices()
    }
}

impl MovingMesh for MovingExactMesh {
    fn energy(&self) -> f64 {
        self.mesh.strain_energy()
    }

    fn energy_rate(&self) -> f64 {
        let moments = self.at.as_ref().map_or([0.0; 2], |(_, reply)| [reply.force[5], reply.force[11]]);
        -(moments[0] * self.per_cycle[0] + moments[1] * self.per_cycle[1])
    }

    fn damping(&mut self, rates: &Vector12, cycles: f64) -> MeshDamper {
        let mut all = MeshDamper::default();
        if let Some((_, reply)) = self.at.as_ref().filter(|(_, reply)| reply.normal_force > 0.0) {
            let lever = &self.projection.approach;
            let stiffness = -reply.tangent[(11, 11)] / (lever[11] * lever[11]);
            let (damping, force) = (self.damping, reply.normal_force);
            NormalDamper { lever, damping, force, stiffness, by_cycles: 0.0 }.add(rates, cycles, &mut all);
        }
        all
    }

    fn forget(&mut self) {
        self.at = None;
        self.mesh.forget_history();
    }

    fn overlaps(&mut self) -> Result<[f64; 2], GearboxError> {
        let deepest = self.mesh.deepest_overlap();
        let drive = match &self.at {
            // Flanks that press overlap; apart, their gap has to be looked for, and what was evaluated is lost.
            Some((_, reply)) if reply.normal_force > 0.0 => deepest,
            Some((d, _)) => {
                let d = *d;
                let gap = self.mesh.overlap(&d);
                self.mesh.evaluate(&d)?;
                gap
            }
            None => deepest,
        };
        Ok([drive, f64::NEG_INFINITY])
    }
}
