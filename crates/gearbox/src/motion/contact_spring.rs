//! The contact of a mesh about one displacement, phase by phase: what a spring of few numbers stands for. Theory (94).

use contact::FlankProjection;
use lumped::Fourier;

use super::SpringMesh;
use crate::{ExactMesh, GearboxError, Mesh, MeshElement, Meshing, Vector12};

/// Orders of a series over `n` samples that are kept: beyond them teeth that come and go would ring.
const SAMPLES_PER_ORDER: usize = 4;

/// Stiffness and excess of a mesh over its phase, from its exact contact.
#[derive(Debug, Clone, PartialEq)]
pub struct ContactSpring {
    /// Stiffness along the normal, N/mm, over the phase, 2 pi a mesh cycle.
    pub stiffness: Fourier,
    /// What the flanks are thicker by than nominal ones, along the normal, mm.
    pub excess: Fourier,
    /// Mean normal force, N.
    pub force: f64,
}

impl ContactSpring {
    /// Looks at the contact at `samples` phases of a cycle with the gears displaced by `about`.
    ///
    /// ```text
    /// F(c, d) = k(c) [a . d + e(c)],   k = dF/d(a . d),   e = F/k - a . d      at d = about
    /// ```
    /// # Errors
    /// [`GearboxError::Unmapped`] where flanks do not touch there at every phase.
    pub fn of(mesh: &mut ExactMesh, about: &Vector12, samples: usize) -> Result<Self, GearboxError> {
        let projection = FlankProjection::new(mesh.pair(), mesh.options().side());
        let a = &projection.approach;
        let (mut k, mut e, mut sum) = (Vec::new(), Vec::new(), 0.0);
        let samples = samples.max(1);
        for i in 0..samples {
            mesh.go_to(i as f64 / samples as f64)?;
            let reply = mesh.evaluate(about)?;
            let force = -reply.force[11] / a[11];
            let stiffness = -reply.tangent[(11, 11)] / (a[11] * a[11]);
            if !(force > 0.0 && stiffness > 0.0) {
                return Err(GearboxError::Unmapped { what: "flanks that are apart at some phase under their load" });
            }
            k.push(stiffness);
            e.push(force / stiffness - a.dot(about));
            sum += force;
        }
        let series = |quantity, values: &[f64]| {
            let found = Fourier::of_samples(quantity, values, samples / SAMPLES_PER_ORDER);
            found.map_err(|source| GearboxError::Mesh { mesh: quantity.to_owned(), source })
        };
        let (stiffness, excess) = (series("mesh stiffness, N/mm", &k)?, series("excess of the flanks, mm", &e)?);
        Ok(Self { stiffness, excess, force: sum / samples as f64 })
    }

    /// The mesh as it runs.
    ///
    /// # Errors
    /// As [`SpringMesh::new`].
    pub fn mesh(&self, mesh: &Mesh, meshing: &Meshing) -> Result<SpringMesh, GearboxError> {
        Ok(SpringMesh::new(mesh, meshing, self.stiffness.clone())?.with_excess(self.excess.clone()))
    }
}
