//! Distribution of a mode's energy: the shaft, bearing or mesh that it deforms, and the masses that it moves. Theory
//! (80).

use nalgebra::{Complex, DMatrix, DVector};

use crate::{Assembly, ElasticBody};

/// A part that holds energy; indices start from 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Component {
    /// A shaft.
    Shaft(usize),
    /// A bearing.
    Bearing(usize),
    /// The housing.
    Housing,
    /// A mesh: the indices of springs come first, then those of whole stiffnesses.
    Mesh(usize),
    /// A disc or gear body: its kinetic energy, including that of its elastic modes.
    Disc(usize),
    /// The elastic modes of the gear on a disc: their strain energy outside the mesh.
    Body(usize),
    /// A machine at an end of the train.
    Machine(usize),
}

/// A part and its share of the energy, 0 .. 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EnergyShare {
    /// Part that holds the energy.
    pub component: Component,
    /// Share of the energy, 0 .. 1.
    pub share: f64,
}

/// Shares of all parts in the strain energy and in the kinetic energy of a mode, averaged over a period. Each list adds
/// up to 1.
#[derive(Debug, Clone, PartialEq)]
pub struct ModalEnergy {
    /// Strain energy of shafts, bearings, housing and meshes. Empty if nothing is deformed: a free motion whose
    /// frequency is caused only by gyroscopic moments.
    pub strain: Vec<EnergyShare>,
    /// Kinetic energy of shafts, discs and machines.
    pub kinetic: Vec<EnergyShare>,
}

/// Strain energy over the work of all inner forces below which it is round-off.
const ROUND_OFF: f64 = 1e-12;

impl ModalEnergy {
    /// Energy shares of complex amplitudes x: x^H K x and x^H M x, part by part, over those of all matrices.
    pub(crate) fn of(assembly: &Assembly, [k, m]: [&DMatrix<f64>; 2], shape: &DVector<Complex<f64>>) -> Self {
        let parts = [shape.map(|x| x.re), shape.map(|x| x.im)];
        let sections = parts.each_ref().map(|p| assembly.of_sections(p));
        let mut strain = Vec::new();
        let mut kinetic = Vec::new();
        // What entries of the stiffness make of the amplitudes: the measure of round-off.
        let mut gross = 0.0;
        for (i, (at, line)) in assembly.lines().enumerate() {
            let own = sections.each_ref().map(|p| p.rows(at, line.mass.nrows()).into_owned());
            let of = |m: &DMatrix<f64>| own.iter().map(|p| p.dot(&(m * p))).sum::<f64>();
            strain.push((Component::Shaft(i), of(&line.stiffness)));
            kinetic.push((Component::Shaft(i), of(&line.mass)));
            gross += own.iter().map(|p| p.component_mul(p).dot(&line.stiffness.diagonal())).sum::<f64>();
        }
        let at_bearings = parts.each_ref().map(|p| assembly.supports().energies(&assembly.at_bearings(p)));
        for i in 0..at_bearings[0].0.len() {
            strain.push((Component::Bearing(i), at_bearings[0].0[i] + at_bearings[1].0[i]));
        }
        if let [(_, Some(a)), (_, Some(b))] = at_bearings {
            strain.push((Component::Housing, a + b));
        }
        for (i, spring) in assembly.structure().springs.iter().enumerate() {
            let of = |p: &DVector<f64>| spring.stiffness * assembly.compression(i, p).powi(2);
            strain.push((Component::Mesh(i), of(&parts[0]) + of(&parts[1])));
        }
        let springs = assembly.structure().springs.len();
        for (i, mesh) in assembly.structure().elastic_meshes.iter().enumerate() {
            let own = parts.each_ref().map(|p| assembly.at_mesh(mesh.discs, p));
            strain.push((Component::Mesh(springs + i), own.iter().map(|u| u.dot(&(&mesh.stiffness * u))).sum()));
        }
        for (i, disc) in assembly.structure().discs.iter().enumerate() {
            let Some(at) = assembly.disc(i) else { continue };
            let square = |axis: usize| shape[at + axis].norm_sqr();
            let shift: f64 = (0..3).map(square).sum();
            let turn = disc.diametral_inertia * (square(3) + square(4)) + disc.polar_inertia * square(5);
            let modes: f64 =
                assembly.bodies().filter(|(_, _, body)| body.disc == i).map(|own| of_modes(own, shape)).sum();
            kinetic.push((Component::Disc(i), disc.mass * shift + turn + modes));
        }
        for (at, _, body) in assembly.bodies() {
            let energy = |(i, square): (usize, &f64)| square * shape[at + i].norm_sqr();
            // Of no modes there is no negative zero.
            strain.push((Component::Body(body.disc), 0.0 + body.squares.iter().enumerate().map(energy).sum::<f64>()));
        }
        for (i, machine) in assembly.structure().machines.iter().enumerate() {
            let Some(at) = assembly.disc(machine.disc) else { continue };
            kinetic.push((Component::Machine(i), machine.inertia * shape[at + 5].norm_sqr()));
        }
        let total = |matrix: &DMatrix<f64>| parts.iter().map(|p| p.dot(&(matrix * p))).sum::<f64>();
        Self { strain: shares(&strain, total(k), ROUND_OFF * gross), kinetic: shares(&kinetic, total(m), 0.0) }
    }
}

/// p^H p + 2 Re p^H L d: what modes add to the kinetic energy of their disc.
fn of_modes((at, disc, body): (usize, usize, &ElasticBody), shape: &DVector<Complex<f64>>) -> f64 {
    let one = |i: usize| {
        let shared: Complex<f64> = (0..6).map(|axis| shape[disc + axis] * body.coupling[(i, axis)]).sum();
        shape[at + i].norm_sqr() + 2.0 * (shape[at + i].conj() * shared).re
    };
    (0..body.count()).map(one).sum()
}

/// Shares in a total; none where that is at most `least`.
fn shares(energies: &[(Component, f64)], total: f64, least: f64) -> Vec<EnergyShare> {
    if total <= least {
        return Vec::new();
    }
    energies.iter().map(|(component, e)| EnergyShare { component: *component, share: e / total }).collect()
}
