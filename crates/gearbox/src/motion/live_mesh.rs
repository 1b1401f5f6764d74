//! A mesh at its place between two bodies.

use nalgebra::{DMatrix, Dyn, OMatrix, SMatrix, U12};

use super::MovingMesh;
use crate::{GearboxError, Mesh, MeshReply, Vector12, static_gearbox::at_mesh};

/// An element, what the coordinates of the motion do to its gears, and its last answer.
pub(super) struct LiveMesh {
    element: Box<dyn MovingMesh>,
    /// D: displacements of both gears in the mesh's own axes by the coordinates z, 12 x n; the turn of the whole train
    /// displaces nothing.
    pub to_gears: OMatrix<f64, U12, Dyn>,
    /// First reduced coordinates of both gears, and the turn from the mesh's axes to the common ones.
    pub gears: [usize; 2],
    pub turn: SMatrix<f64, 12, 12>,
    /// Mesh cycles a radian of the input.
    pub cycles_per_turn: f64,
    last: Option<(f64, Vector12, MeshReply)>,
}

impl LiveMesh {
    pub fn new(
        element: Box<dyn MovingMesh>,
        basis: &DMatrix<f64>,
        gears: [usize; 2],
        turn: SMatrix<f64, 12, 12>,
        cycles_per_turn: f64,
    ) -> Self {
        let at_gears = OMatrix::<f64, U12, Dyn>::from_fn(basis.ncols(), |i, j| basis[(gears[i / 6] + i % 6, j)]);
        Self { element, to_gears: turn.transpose() * at_gears, gears, turn, cycles_per_turn, last: None }
    }

    /// Forces at a place; the same place once more costs nothing.
    pub fn reply(&mut self, mesh: &Mesh, cycles: f64, d: &Vector12) -> Result<&MeshReply, GearboxError> {
        let known = self.last.as_ref().is_some_and(|(c, at, _)| *c == cycles && at == d);
        if !known {
            self.last = None;
            let named = |source| at_mesh(mesh, source);
            self.element.go_to(cycles).map_err(named)?;
            let reply = self.element.evaluate(d).map_err(named)?;
            self.last = Some((cycles, *d, reply));
        }
        // It is there in either case.
        let lost = GearboxError::OutOfRange { part: mesh.name.clone(), quantity: "mesh cycles", value: cycles };
        self.last.as_ref().map(|(_, _, reply)| reply).ok_or(lost)
    }

    /// Forgets what it remembers of earlier places.
    pub fn forget(&mut self) {
        self.last = None;
        self.element.forget();
    }

    /// The element, standing where it was asked last.
    pub fn element(&mut self) -> &mut dyn MovingMesh {
        &mut *self.element
    }
}
