//! A gearbox at one angle of its input: the equilibrium, started from an extrapolation of the last positions, and its
//! results. Theory (84).

use contact::SliceResult;
use ltca::FilletField;
use nalgebra::DVector;

use crate::{
    BoltForce, GearboxError, GearboxPosition, MeshForces, StaticGearbox, Vector12,
    joined_meshes::AcrossMeshes,
    position::{Solved, position},
    rolling_bearing::RollingReply,
    search::{Trial, coordinates},
    train::at_mesh,
};

impl StaticGearbox {
    /// Equilibrium with the input rotated by `angle` (rad about +z) from its start.
    ///
    /// # Errors
    /// [`GearboxError`].
    pub fn solve(&mut self, angle: f64) -> Result<GearboxPosition, GearboxError> {
        if !angle.is_finite() {
            let part = "the input".into();
            return Err(GearboxError::OutOfRange { part, quantity: "angle, rad", value: angle });
        }
        let cycles = self.train.cycles(angle);
        for ((element, &c), mesh) in self.elements.iter_mut().zip(&cycles).zip(&self.meshes) {
            element.go_to(c).map_err(|source| at_mesh(mesh, source))?;
        }
        let load = self.seats.basis.transpose() * &self.load;
        let start = continued(&self.last, angle).unwrap_or_else(|| self.norms.displacements(&load));
        let sought = match self.search(&load, start) {
            Err(failed @ GearboxError::NoEquilibrium { .. }) if !self.compliant_support.is_empty() => {
                self.by_heavier_loads(&load).ok_or(failed)
            }
            other => other,
        };
        let Trial { found, mut replies, across, mut pressed } = sought?;
        let Self { elements, meshes, last, .. } = self;
        let mut slices: Vec<Vec<SliceResult>> = elements.iter().map(|e| e.slices()).collect();
        let mut roots = Vec::with_capacity(elements.len());
        for (element, mesh) in elements.iter_mut().zip(meshes.iter()) {
            element.check().map_err(|source| at_mesh(mesh, source))?;
            roots.push(element.root_stress().map_err(|source| at_mesh(mesh, source))?);
        }
        last.insert(0, (angle, found.displacements.clone()));
        last.truncate(2);
        let moved = Moved { step: &found.last_step, from: &found.displacements - &found.last_step };
        self.follow((&mut replies, &across, &mut pressed), (&mut slices, &mut roots), &moved);
        let forces = self.in_common_axes(&replies);
        self.replies.clone_from(&replies);
        let (laminae, bolts) = (self.laminae(), self.bolt_forces());
        Ok(position(self, Solved { angle, cycles, found, replies, pressed, laminae, bolts, forces, slices, roots }))
    }

    /// Forces of the laminae of each bearing that presses the bore of a gear, N; none of the others.
    fn laminae(&self) -> Vec<Vec<f64>> {
        let mut all = vec![Vec::new(); self.assembly.structure().bearings.len()];
        for bore in self.joined.iter().flat_map(|joined| &joined.bores) {
            all[self.compliant_support[bore.bearing].bearing].clone_from(&bore.forces);
        }
        all
    }

    /// Forces of the bolts of each disc.
    fn bolt_forces(&mut self) -> Vec<Vec<BoltForce>> {
        let Self { joined, elements, assembly, .. } = self;
        let mut all = vec![Vec::new(); assembly.structure().discs.len()];
        for (disc, forces) in joined.iter().flat_map(|joined| joined.bolt_forces(elements)) {
            all[disc] = forces;
        }
        all
    }

    /// Forces of the meshes after a last small step. Where the load lies does not change in it: forces of the slices, their
    /// sum and stress in fillets go with the moment on gear 2, pressures as its square root.
    fn follow(
        &self,
        (replies, across, pressed): (&mut [MeshForces], &[AcrossMeshes], &mut [RollingReply]),
        (slices, roots): (&mut [Vec<SliceResult>], &mut [[Vec<FilletField>; 2]]),
        moved: &Moved<'_>,
    ) {
        let y = &self.seats.basis * &moved.from;
        let by = |part: usize| -> Vector12 {
            coordinates(part, &self.to_gears, (&self.compliant_support, &self.seats.basis, &y)) * moved.step
        };
        let steps: Vec<Vector12> = self.to_gears.iter().map(|to_gears| to_gears * moved.step).collect();
        for own in across.iter().filter(|own| own.of >= replies.len()) {
            let followed = own.tangent * by(own.by);
            pressed[own.of - replies.len()].force += followed.fixed_rows::<5>(0);
        }
        for (i, ((reply, slices), roots)) in replies.iter_mut().zip(slices).zip(roots).enumerate() {
            let before = reply.force[11];
            reply.force += reply.tangent * steps[i];
            for own in across.iter().filter(|own| own.of == i) {
                reply.force += own.tangent * by(own.by);
            }
            let grown = reply.force[11] / before;
            if grown > 0.0 && grown.is_finite() {
                reply.normal_force *= grown;
                for slice in slices {
                    slice.line_load *= grown;
                    slice.pressure *= grown.sqrt();
                }
                roots.iter_mut().flatten().for_each(|fillet| fillet.grow(grown));
            }
        }
    }

    /// Forces and moments of the meshes on their gears, common axes.
    fn in_common_axes(&self, replies: &[MeshForces]) -> Vec<Vector12> {
        self.places.iter().zip(replies).map(|((_, turn), reply)| turn * reply.force).collect()
    }
}

/// A last small step, and where it began.
struct Moved<'a> {
    step: &'a DVector<f64>,
    from: DVector<f64>,
}

/// Where the last positions lead to at an angle: on along the line through both, as far as they are apart; else where
/// the last one is. `None` where there is none. A position that has failed leaves the others as they are.
fn continued(last: &[(f64, DVector<f64>)], angle: f64) -> Option<DVector<f64>> {
    let (at, z) = last.first()?;
    let Some((before, y)) = last.get(1) else { return Some(z.clone()) };
    let part = (angle - at) / (at - before);
    Some(if part.abs() <= 1.0 + 1e-9 { z + part * (z - y) } else { z.clone() })
}
