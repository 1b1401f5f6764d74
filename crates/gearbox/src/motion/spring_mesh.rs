//! A mesh as a spring whose stiffness varies over the mesh cycle, with pitch errors, backlash and a damper. Theory
//! (94).

use std::f64::consts::TAU;

use dynamics::FlankInstant;
use lumped::{
    Fourier,
    shaft18::{MeshGeometry, MeshLine},
};
use nalgebra::{SMatrix, Vector6};

use super::{MeshLosses, MovingMesh, PitchErrors, normal_damper::NormalDamper};
use crate::{GearMesh, GearboxError, MeshElement, MeshForces, Meshing, Vector12, mesh_element::finite_cycles};

/// Flanks that press along one line of action.
///
/// ```text
/// delta = h . d + e(c) - j,   e: excess and pitch errors,   V = k(c) delta^2/2,   F = k delta  (delta > 0),   0 else
/// ```
#[derive(Debug, Clone)]
struct Flanks {
    /// h.
    lever: Vector12,
    /// j: clearance, mm.
    clearance: f64,
    /// Whether excess and errors press (+1) or relieve (-1) these flanks.
    errors: f64,
    at: Pressed,
}

/// Approach of pressed flanks.
#[derive(Debug, Clone, Copy, Default)]
struct Pressed {
    /// delta, mm.
    compression: f64,
    /// k (N/mm) and dk/dc.
    stiffness: [f64; 2],
    /// de/dc, mm a cycle.
    error_rate: f64,
}

impl Flanks {
    /// Their damper (N s/mm), where they press.
    fn damper(&self, damping: f64) -> Option<NormalDamper<'_>> {
        let (force, stiffness, by_cycles) = (self.at.force(), self.at.stiffness[0], self.at.error_rate);
        (self.at.compression > 0.0).then_some(NormalDamper { lever: &self.lever, damping, force, stiffness, by_cycles })
    }
}

impl Pressed {
    fn force(&self) -> f64 {
        if self.compression > 0.0 { self.stiffness[0] * self.compression } else { 0.0 }
    }
}

/// A mesh with few parameters, for vibration of the shafts when the details of the contact are not needed.
#[derive(Debug, Clone)]
pub struct SpringMesh {
    sides: [Option<Flanks>; 2],
    stiffness: Fourier,
    excess: Fourier,
    errors: PitchErrors,
    damping: f64,
    cycles: f64,
}

impl SpringMesh {
    /// The driving flanks of a mesh as it runs. `stiffness` along the normal (N/mm) is a function of the phase; 2 pi is
    /// one mesh cycle. Without errors, backlash and damping.
    ///
    /// # Errors
    /// [`GearboxError::Mesh`] if the gears have no line of action, [`GearboxError::OutOfRange`] for a stiffness that is
    /// not above 0 everywhere.
    pub fn new(mesh: &GearMesh, meshing: &Meshing, stiffness: Fourier) -> Result<Self, GearboxError> {
        let least = stiffness.least();
        if !(least > 0.0 && least.is_finite()) {
            let (part, quantity) = (mesh.name.clone(), "mesh stiffness, N/mm");
            return Err(GearboxError::OutOfRange { part, quantity, value: least });
        }
        let drive =
            Flanks { lever: lever(&line(mesh, meshing.side())?), clearance: 0.0, errors: 1.0, at: Pressed::default() };
        let (excess, errors) = (Fourier::constant(0.0), PitchErrors::default());
        Ok(Self { sides: [Some(drive), None], stiffness, excess, errors, damping: 0.0, cycles: 0.0 })
    }

    /// Mesh with flanks that are thicker than nominal ones, mm along the normal over the phase, 2 pi a mesh cycle: the
    /// static transmission error is in it.
    #[must_use]
    pub(crate) fn with_excess(self, excess: Fourier) -> Self {
        Self { excess, ..self }
    }

    /// Mesh with pitch errors of both gears.
    #[must_use]
    pub fn with_errors(self, errors: PitchErrors) -> Self {
        Self { errors, ..self }
    }

    /// Mesh with coast flanks at the pair's backlash, along their own line of action.
    ///
    /// # Errors
    /// The errors of [`SpringMesh::new`].
    pub fn with_coast_flanks(mut self, mesh: &GearMesh, meshing: &Meshing) -> Result<Self, GearboxError> {
        let line = line(mesh, meshing.side().opposite())?;
        // Backlash is counted on the transverse line of action.
        let clearance = mesh.pair.backlash() * line.cos_base_helix;
        self.sides[1] = Some(Flanks { lever: lever(&line), clearance, errors: -1.0, at: Pressed::default() });
        Ok(self)
    }

    /// Mesh with the coast flanks alone.
    pub(super) fn without_drive_flanks(mut self) -> Self {
        self.sides[0] = None;
        self
    }

    /// Mesh with a damper along the normal, N s/mm, limited by the force of the flanks: it never pulls, and exerts no
    /// force where contact only begins.
    #[must_use]
    pub fn with_damping(self, damping: f64) -> Self {
        Self { damping, ..self }
    }

    fn flanks(&self) -> impl Iterator<Item = &Flanks> {
        self.sides.iter().flatten()
    }
}

impl MeshElement for SpringMesh {
    fn go_to(&mut self, cycles: f64) -> Result<(), GearboxError> {
        self.cycles = finite_cycles(cycles)?;
        Ok(())
    }

    fn evaluate(&mut self, displacements: &Vector12) -> Result<MeshForces, GearboxError> {
        let phase = TAU * (self.cycles - self.cycles.floor());
        let ([k, slope], [excess, along]) = (self.stiffness.with_slope(phase), self.excess.with_slope(phase));
        let [own, own_rate] = self.errors.at(self.cycles);
        let [error, error_rate] = [excess + own, TAU * along + own_rate];
        let mut reply = MeshForces { force: Vector12::zeros(), tangent: SMatrix::zeros(), normal_force: 0.0 };
        for side in self.sides.iter_mut().flatten() {
            let compression = side.lever.dot(displacements) + side.errors * error - side.clearance;
            side.at = Pressed { compression, stiffness: [k, TAU * slope], error_rate: side.errors * error_rate };
            if compression > 0.0 {
                reply.force -= side.at.force() * side.lever;
                reply.tangent -= k * side.lever * side.lever.transpose();
                reply.normal_force += side.at.force();
            }
        }
        Ok(reply)
    }
}

impl MovingMesh for SpringMesh {
    fn period(&self) -> u64 {
        self.errors.period()
    }

    fn energy(&self) -> f64 {
        self.flanks().map(|s| 0.5 * s.at.force() * s.at.compression).sum()
    }

    fn energy_rate(&self) -> f64 {
        let of = |s: &Flanks| {
            let square = s.at.compression.max(0.0).powi(2);
            0.5 * s.at.stiffness[1] * square + s.at.force() * s.at.error_rate
        };
        self.flanks().map(of).sum()
    }

    fn losses(&mut self, rates: &Vector12, cycles: f64) -> MeshLosses {
        let mut all = MeshLosses::default();
        self.flanks().filter_map(|s| s.damper(self.damping)).for_each(|own| own.add(rates, cycles, &mut all));
        all
    }

    fn by_side(&mut self, rates: &Vector12, cycles: f64) -> Result<[FlankInstant; 2], GearboxError> {
        let of = |side: &Option<Flanks>| {
            let damper = side.as_ref().and_then(|own| own.damper(self.damping));
            damper.map_or_else(FlankInstant::default, |own| own.instant(rates, cycles))
        };
        Ok(self.sides.each_ref().map(of))
    }

    fn levers(&self) -> Option<Vec<Vector12>> {
        Some(self.flanks().map(|s| s.lever).collect())
    }

    fn overlaps(&mut self) -> Result<[f64; 2], GearboxError> {
        Ok(self.sides.each_ref().map(|s| s.as_ref().map_or(f64::NEG_INFINITY, |s| s.at.compression)))
    }
}

fn line(mesh: &GearMesh, side: geometry::Side) -> Result<MeshLine, GearboxError> {
    let line = MeshGeometry::of_pair(&mesh.pair, side).line();
    line.map_err(|source| GearboxError::Mesh { mesh: mesh.name.clone(), source })
}

fn lever(line: &MeshLine) -> Vector12 {
    let h: &[Vector6<f64>; 2] = &line.levers;
    Vector12::from_fn(|i, _| h[i / 6][i % 6])
}
