//! The contact of a mesh about one displacement, phase by phase, which a spring with few parameters replaces. Theory
//! (94a).

use contact::FlankProjection;
use lumped::Fourier;

use super::{SpringMesh, TiltingSpring, tilting_spring::TiltingCoefficients};
use crate::{ExactMesh, GearMesh, GearboxError, MeshElement, Meshing, Vector12, even_mesh::guessed_stiffness};

/// Orders of a series over `n` samples that are kept: beyond them teeth that come and go would ring.
const SAMPLES_PER_ORDER: usize = 4;

/// Relative difference from a mean force that is wanted, and steps to it.
const NEAR: f64 = 1e-3;
const STEPS: usize = 20;

/// Force, tilting moment and their stiffness over the phase of a mesh, from its exact contact.
#[derive(Debug, Clone, PartialEq)]
pub struct ContactSpring {
    projection: FlankProjection,
    coefficients: TiltingCoefficients,
    /// Mean normal force, N.
    pub force: f64,
    /// Mean length of the loaded contact lines, mm.
    pub length: f64,
}

impl ContactSpring {
    /// Evaluates the contact at `samples` phases of a cycle with the gears displaced by `about`.
    ///
    /// ```text
    /// F = dV/dx,  M = dV/dgamma,  K their slopes at d = about;   delta_0 = F/K_xx = x + e,   k = K_xx
    /// s k = 2 M/delta_0 - K_xg,   m delta_0 = K_xg - M/delta_0,   n delta_0^2 = K_gg - s^2 k - 4 s m delta_0
    /// ```
    /// # Errors
    /// [`GearboxError::Unmapped`] if the flanks do not touch there at every phase.
    pub fn of(mesh: &mut ExactMesh, about: &Vector12, samples: usize) -> Result<Self, GearboxError> {
        let projection = FlankProjection::new(mesh.pair(), mesh.options().side());
        let samples = samples.max(1);
        let mut all: [Vec<f64>; 5] = Default::default();
        let (mut sum, mut length) = (0.0, 0.0);
        for i in 0..samples {
            mesh.go_to(i as f64 / samples as f64)?;
            let (force, own) = sample(mesh, &projection, about)?;
            all.iter_mut().zip(own).for_each(|(list, x)| list.push(x));
            sum += force;
            length += mesh.pressed_length();
        }
        let series = |quantity, values: &[f64]| {
            let found = Fourier::of_samples(quantity, values, samples / SAMPLES_PER_ORDER);
            found.map_err(|source| GearboxError::Mesh { mesh: quantity.to_owned(), source })
        };
        let [k, e, s, m, n] = &all;
        let coefficients = TiltingCoefficients {
            stiffness: series("mesh stiffness, N/mm", k)?,
            excess: series("excess of the flanks, mm", e)?,
            place: series("place of the mesh force, mm", s)?,
            by_tilt: [series("stiffness by tilt, N/(mm rad)", m)?, series("stiffness by tilt, N/(mm rad^2)", n)?],
            tilt: projection.tilt.dot(about),
        };
        let [force, length] = [sum, length].map(|x| x / samples as f64);
        Ok(Self { projection, coefficients, force, length })
    }

    /// The contact about a displacement that is moved along the normal until the mean force (N) has a given value. For
    /// teeth with pitch errors this gives the contact of teeth in nominal positions at the same displacement.
    ///
    /// # Errors
    /// The errors of [`ContactSpring::of`].
    pub fn under(mesh: &mut ExactMesh, about: &Vector12, force: f64, samples: usize) -> Result<Self, GearboxError> {
        let projection = FlankProjection::new(mesh.pair(), mesh.options().side());
        let apart = force / guessed_stiffness(mesh.pair());
        let (mut about, mut left) = (*about, STEPS);
        loop {
            let found = Self::of(mesh, &about, samples);
            left -= 1;
            let further = match &found {
                Ok(own) if left == 0 || (own.force - force).abs() <= NEAR * force => return found,
                Ok(own) => (force - own.force) / own.stiffness().mean,
                Err(GearboxError::Unmapped { .. }) if left > 0 => apart,
                Err(_) => return found,
            };
            about += projection.displacement(further, 0.0);
        }
    }

    /// Stiffness along the normal, N/mm, over the phase; 2 pi is one mesh cycle.
    pub fn stiffness(&self) -> &Fourier {
        &self.coefficients.stiffness
    }

    /// The spring of a mesh in motion; both flanks of a tooth can touch.
    ///
    /// # Errors
    /// The errors of [`SpringMesh::new`].
    pub fn mesh(&self, mesh: &GearMesh, meshing: &Meshing) -> Result<TiltingSpring, GearboxError> {
        let c = &self.coefficients;
        let both = SpringMesh::new(mesh, meshing, c.stiffness.clone())?.with_excess(c.excess.clone());
        let coast = both.with_coast_flanks(mesh, meshing)?.without_drive_flanks();
        Ok(TiltingSpring::new(self.projection, c.clone(), coast))
    }
}

/// Force, and the five coefficients, at one phase.
fn sample(
    mesh: &mut ExactMesh,
    projection: &FlankProjection,
    about: &Vector12,
) -> Result<(f64, [f64; 5]), GearboxError> {
    let reply = mesh.evaluate(about)?;
    let ways = [projection.displacement(1.0, 0.0), projection.displacement(0.0, 1.0)];
    let [force, moment] = ways.map(|w| -reply.force.dot(&w));
    let slope = |i: usize, j: usize| -ways[i].dot(&(reply.tangent * ways[j]));
    let (k, mixed, tilting) = (slope(0, 0), 0.5 * (slope(0, 1) + slope(1, 0)), slope(1, 1));
    if !(force > 0.0 && k > 0.0) {
        return Err(GearboxError::Unmapped { what: "flanks that are apart at some phase under their load" });
    }
    let delta = force / k;
    let (s, m) = ((2.0 * moment / delta - mixed) / k, (mixed - moment / delta) / delta);
    let n = (tilting - s * s * k - 4.0 * s * m * delta) / (delta * delta);
    Ok((force, [k, delta - projection.approach.dot(about), s, m, n]))
}
