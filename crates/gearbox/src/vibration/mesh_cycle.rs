//! A mesh through its own cycle, in static equilibrium under load.

use crate::{GearboxError, GearboxPosition, MeshSample, StaticGearbox, Vector12};

/// Solves a gearbox at `positions` positions that are evenly spaced over one cycle of `mesh`. For each it returns that
/// mesh with its transmission error (mm), and its forces on the modes of its gears if its element keeps modes. The
/// other meshes should then be linear ([`crate::MeanMesh`]), because their cycles are not complete.
///
/// # Errors
/// [`GearboxError`] as for [`StaticGearbox::solve`]; [`GearboxError::Count`] if there is no mesh with this index.
pub fn own_cycle(
    gearbox: &mut StaticGearbox,
    mesh: usize,
    positions: usize,
    mut each: impl FnMut(),
) -> Result<(Vec<MeshSample>, Vec<f64>), GearboxError> {
    let (start, one) = (gearbox.train().cycles(0.0), gearbox.train().cycles(1.0));
    let slope = match (start.get(mesh), one.get(mesh)) {
        (Some(a), Some(b)) => b - a,
        _ => return Err(GearboxError::Count { what: "meshes", found: start.len(), wanted: mesh + 1 }),
    };
    let mut samples = Vec::with_capacity(positions);
    let mut errors = Vec::with_capacity(positions);
    for i in 0..positions {
        let position = gearbox.solve(i as f64 / positions as f64 / slope)?;
        if let Some(mut sample) = MeshSample::at(gearbox, &position, mesh) {
            sample.modal = gearbox.modal(mesh, &sample.displacements)?;
            samples.push(sample);
        }
        errors.push(position.meshes[mesh].transmission_error);
        each();
    }
    Ok((samples, errors))
}

impl MeshSample {
    /// A mesh at the last solved position of a gearbox, without modes; `None` if there is no mesh with this index.
    pub fn at(gearbox: &StaticGearbox, position: &GearboxPosition, mesh: usize) -> Option<Self> {
        let (state, reply) = (position.meshes.get(mesh)?, gearbox.replies().get(mesh)?);
        let displacements = Vector12::from(state.displacements);
        Some(Self { cycles: state.cycles, displacements, reply: reply.clone(), modal: None })
    }
}
