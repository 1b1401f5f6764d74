//! Shafts of the model as beam elements instead of stations: how good is the lumped model?

use fem::{
    Modes,
    beam::{BeamLine, BeamTheory, NODE_COORDINATES},
    natural_modes,
};
use nalgebra::{DMatrix, DVector};

use super::ShaftSystem;
use crate::LumpedError;

/// Matrices of a system of shafts in beam elements.
#[derive(Debug, Clone, PartialEq)]
pub struct Continuum {
    /// Stiffness of shafts, supports and meshes.
    pub stiffness: DMatrix<f64>,
    /// Mass.
    pub mass: DMatrix<f64>,
}

impl Continuum {
    /// Beam model with at least as many elements on each shaft as `elements` says, all no longer than its length over
    /// that; what sits at the stations is rigid and of no width, meshes have their mean stiffness.
    ///
    /// # Errors
    /// [`LumpedError`] when data have no meaning.
    pub fn new(system: &ShaftSystem, elements: u32, theory: BeamTheory) -> Result<Self, LumpedError> {
        system.check()?;
        let mut lines = Vec::new();
        for shaft in &system.shafts {
            let mut places: Vec<f64> = shaft.stations.iter().map(|s| s.position).collect();
            places.extend(shaft.supports.iter().map(|s| s.position));
            let longest = shaft.length() / f64::from(elements.max(1));
            lines.push(BeamLine::new(&shaft.pieces()?, &places, longest, theory)?);
        }
        let mut first = vec![0];
        for line in &lines {
            first.push(first[first.len() - 1] + NODE_COORDINATES * line.positions().len());
        }
        let n = first[lines.len()];
        let (mut stiffness, mut mass) = (DMatrix::zeros(n, n), DMatrix::zeros(n, n));
        for ((shaft, line), &at) in system.shafts.iter().zip(&lines).zip(&first) {
            let size = line.stiffness.nrows();
            stiffness.view_mut((at, at), (size, size)).copy_from(&line.stiffness);
            mass.view_mut((at, at), (size, size)).copy_from(&line.mass);
            for s in &shaft.stations {
                let node = at + NODE_COORDINATES * line.node_at(s.position);
                let inertia = [s.mass, s.mass, s.mass, s.transverse_inertia, s.transverse_inertia, s.polar_inertia];
                inertia.into_iter().enumerate().for_each(|(axis, m)| mass[(node + axis, node + axis)] += m);
            }
            for s in &shaft.supports {
                let node = at + NODE_COORDINATES * line.node_at(s.position);
                s.stiffness.into_iter().enumerate().for_each(|(axis, k)| stiffness[(node + axis, node + axis)] += k);
            }
        }
        for mesh in &system.meshes {
            let line = mesh.geometry.line()?;
            let mut lever = DVector::zeros(n);
            for (place, h) in mesh.gears.iter().zip(&line.levers) {
                let shaft = place.shaft;
                let node = lines[shaft].node_at(system.station(*place)?.position);
                let mut own = lever.rows_mut(first[shaft] + NODE_COORDINATES * node, NODE_COORDINATES);
                own += h;
            }
            stiffness.ger(mesh.stiffness.mean, &lever, &lever, 1.0);
        }
        Ok(Self { stiffness, mass })
    }
}

/// Natural frequencies of a system in beam elements, at least as many on each shaft as `elements` says.
///
/// # Errors
/// [`LumpedError`], also when there is no mass somewhere (a segment of density 0).
pub fn continuum_modes(system: &ShaftSystem, elements: u32, theory: BeamTheory) -> Result<Modes, LumpedError> {
    let continuum = Continuum::new(system, elements, theory)?;
    Ok(natural_modes(&continuum.stiffness, &continuum.mass)?)
}
