//! Response to the orders of all meshes over speed. Theory (90).

use std::{f64::consts::TAU, sync::Arc};

use geometry::Sense;
use nalgebra::{Complex, DMatrix, DVector};

use reduction::GearModes;

use super::{MeshExcitation, excitation::turned_about, response::Spinning};
use crate::{
    Assembly, ElasticBody, ElasticMesh, GearMesh, GearboxError, Held, Rotors, Structure, Train, Vector12,
    even_mesh::{guessed_lever, turn},
};

/// Vibration of a gearbox with mass about its equilibrium, with linear meshes.
#[derive(Debug, Clone)]
pub struct Vibration {
    rotors: Rotors,
    /// Spin of each shaft in space over that of the input, about +z.
    ratios: Vec<f64>,
    meshes: Vec<SwingingMesh>,
}

/// Data of a mesh that vibrates.
#[derive(Debug, Clone)]
struct SwingingMesh {
    discs: [usize; 2],
    excitation: MeshExcitation,
    /// Turn of its axes to the common ones, of displacements and modes.
    turn: DMatrix<f64>,
    /// Compression of an evenly loaded mesh for unit displacements.
    lever: Vector12,
    /// Cycles with the input at its start, and cycles a rad of the input.
    start: f64,
    cycles: f64,
}

/// Response to one order of one mesh at one speed. Amplitudes are peaks of Re(x exp(i w t)), with t = 0 when the input
/// is at its start.
#[derive(Debug, Clone, PartialEq)]
pub struct Harmonic {
    /// Mesh that excites.
    pub mesh: usize,
    /// Order of its frequency, from 1.
    pub order: usize,
    /// Angular frequency, rad/s.
    pub frequency: f64,
    /// Displacements of all coordinates of the [`Assembly`], mm and rad.
    pub displacements: DVector<Complex<f64>>,
    /// Dynamic normal force of every mesh, N, from the torque on its gear 1; positive if it increases the contact
    /// force.
    pub mesh_forces: Vec<Complex<f64>>,
    /// Force and moment of each bearing on the housing, six entries per bearing: N, N mm. Only of springs.
    pub bearing_forces: DVector<Complex<f64>>,
}

impl Vibration {
    /// Vibration of a structure with mass, its `meshes` with their train, and the excitation of each mesh, in order.
    /// The structure must have no mesh springs.
    ///
    /// # Errors
    /// [`GearboxError`]: another number of excitations, or the errors of [`Rotors::holding`].
    pub fn new(
        structure: Structure,
        parts: (&[GearMesh], &Train, Sense),
        excitations: Vec<MeshExcitation>,
        held: &Held,
    ) -> Result<Self, GearboxError> {
        Self::with_modes(structure, parts, excitations, &[], held)
    }

    /// The same with elastic modes of gears, disc by disc ([`crate::elastic_gears`]); the coordinates of the
    /// excitations include the modes of their gears.
    ///
    /// # Errors
    /// The errors of [`Vibration::new`]; excitations with other coordinates, and gears whose mass is less than that
    /// moved by their modes.
    pub fn with_modes(
        structure: Structure,
        (meshes, train, sense): (&[GearMesh], &Train, Sense),
        excitations: Vec<MeshExcitation>,
        modes: &[Option<Arc<GearModes>>],
        held: &Held,
    ) -> Result<Self, GearboxError> {
        let structure = Structure { bodies: bodies((meshes, train), modes), ..structure };
        if excitations.len() != meshes.len() {
            let (found, wanted) = (excitations.len(), meshes.len());
            return Err(GearboxError::Count { what: "excitations of meshes", found, wanted });
        }
        let (start, one) = (train.cycles(0.0), train.cycles(1.0));
        let mut swinging = Vec::with_capacity(meshes.len());
        let mut elastic_meshes = Vec::with_capacity(meshes.len());
        for (i, (mesh, excitation)) in meshes.iter().zip(excitations).enumerate() {
            let meshing = &train.meshing()[i];
            let turn = turn_with_modes(meshing.direction, &structure, (mesh, modes), &excitation)?;
            let stiffness = -turned_about(&turn, &excitation.tangent);
            elastic_meshes.push(ElasticMesh { name: mesh.name.clone(), discs: mesh.discs, stiffness });
            let (lever, cycles) = (guessed_lever(mesh, meshing)?, (one[i] - start[i]).abs());
            swinging.push(SwingingMesh { discs: mesh.discs, excitation, turn, lever, start: start[i], cycles });
        }
        let assembly = Assembly::new(Structure { elastic_meshes, ..structure })?;
        let turns = assembly.structure().fixed.is_some() && held.turns.is_empty();
        let free = turns.then(|| assembly.turned((train.ratios_in_space(), train.frame_ratio())));
        let rotors = Rotors::beside_turn(assembly, held, free.as_ref())?;
        let ratios = train.ratios_in_space().iter().map(|r| r * sense.sign() as f64).collect();
        Ok(Self { rotors, ratios, meshes: swinging })
    }

    /// Vibration in modes up to `highest` (rad/s), plus the static response to forces at gears and bearings beyond
    /// these modes, including gyroscopic moments of discs and elastic modes of gears ([`Rotors::reduced`]).
    ///
    /// # Errors
    /// No errors other than those that [`Vibration::new`] has already checked.
    pub fn reduced(&self, highest: f64) -> Result<Self, GearboxError> {
        let assembly = self.rotors.assembly();
        let structure = assembly.structure();
        let heavy = structure.discs.iter().enumerate().filter(|(_, d)| d.polar_inertia > 0.0).map(|(i, _)| i);
        let discs = self.meshes.iter().flat_map(|m| m.discs).chain(heavy).filter_map(|d| assembly.disc(d));
        let held = structure.bearings.iter().enumerate().flat_map(|(i, bearing)| {
            let of = |(node, own): (usize, &nalgebra::Matrix6<f64>)| {
                // Coordinates of the node that compress a spring of the bearing.
                let pressed = own.transpose() * bearing.stiffness * own;
                (0..6).filter(move |k| pressed[(*k, *k)] > 0.0).map(move |k| node + k)
            };
            assembly.bearing_ends(i).flat_map(of).collect::<Vec<_>>()
        });
        let mut at: Vec<usize> = discs.flat_map(|d| d..d + 6).chain(held).chain(assembly.modes()).collect();
        at.sort_unstable();
        at.dedup();
        let loads = DMatrix::from_fn(assembly.size(), at.len(), |i, j| f64::from(u8::from(i == at[j])));
        Ok(Self { rotors: self.rotors.reduced(highest, &loads)?, ..self.clone() })
    }

    /// Shafts, gears and mean meshes.
    pub fn rotors(&self) -> &Rotors {
        &self.rotors
    }

    /// Spins of all shafts in space with the input at `speed`, rad/s about +z.
    pub fn speeds(&self, speed: f64) -> Vec<f64> {
        self.ratios.iter().map(|r| r * speed).collect()
    }

    /// Mesh frequency of each mesh divided by the rotation frequency of the input: the mesh order relative to the
    /// input.
    pub fn mesh_orders(&self) -> Vec<f64> {
        self.meshes.iter().map(|m| m.cycles * TAU).collect()
    }

    /// Mean stiffness of each mesh along its normal, N/mm, as felt by a rotation of gear 1 alone.
    ///
    /// ```text
    /// k = -T_66/h_6^2      h: lever of the normal, theory (53)
    /// ```
    pub fn mesh_stiffness(&self) -> Vec<f64> {
        self.meshes.iter().map(|m| -m.excitation.mean.tangent[(5, 5)] / (m.lever[5] * m.lever[5])).collect()
    }

    /// Excitation of each mesh.
    pub fn excitations(&self) -> impl Iterator<Item = &MeshExcitation> {
        self.meshes.iter().map(|m| &m.excitation)
    }

    /// Response to all orders of all meshes with the input at `speed` (rad/s, above 0), mesh by mesh.
    ///
    /// ```text
    /// w = k dc/dt,   f = g_k exp(2 pi i k c(0)),   dynamic force = g_k exp(2 pi i k c(0)) + T x
    /// ```
    ///
    /// # Errors
    /// The errors of [`Rotors::response`].
    pub fn harmonics(&self, speed: f64, damping_ratio: f64) -> Result<Vec<Harmonic>, GearboxError> {
        if !(speed.is_finite() && speed > 0.0) {
            let part = "the input".into();
            return Err(GearboxError::OutOfRange { part, quantity: "speed, rad/s", value: speed });
        }
        let spinning = Spinning::new(&self.rotors, &self.speeds(speed), damping_ratio)?;
        let mut all = Vec::new();
        for (mesh, own) in self.meshes.iter().enumerate() {
            for order in 1..=own.excitation.orders.len() {
                all.push(self.harmonic(&spinning, mesh, order, speed)?);
            }
        }
        Ok(all)
    }

    fn harmonic(
        &self,
        spinning: &Spinning<'_>,
        mesh: usize,
        order: usize,
        speed: f64,
    ) -> Result<Harmonic, GearboxError> {
        let own = &self.meshes[mesh];
        let phase = Complex::from_polar(1.0, TAU * (order as f64 * own.start).fract());
        let assembly = self.rotors.assembly();
        let mut force = DVector::zeros(assembly.size());
        let exciting = &own.excitation.orders[order - 1] * phase;
        assembly.add_at_mesh(own.discs, &(complex(&own.turn) * &exciting), &mut force);
        let frequency = order as f64 * TAU * own.cycles * speed;
        let displacements = spinning.amplitudes(frequency, &force)?;
        let of_mesh = |(i, m): (usize, &SwingingMesh)| {
            let moved = complex(&m.turn.transpose()) * assembly.at_mesh(m.discs, &displacements);
            let mut f = complex(&m.excitation.tangent) * moved;
            if i == mesh {
                f += &exciting;
            }
            -f[5] / m.lever[5]
        };
        let mesh_forces = self.meshes.iter().enumerate().map(of_mesh).collect();
        let parts = [displacements.map(|x| x.re), displacements.map(|x| x.im)];
        let [re, im] = parts.map(|q| assembly.supports().forces(&assembly.at_bearings(&q)));
        let bearing_forces = DVector::from_fn(re.len(), |i, _| -Complex::new(re[i], im[i]));
        Ok(Harmonic { mesh, order, frequency, displacements, mesh_forces, bearing_forces })
    }
}

fn complex(m: &DMatrix<f64>) -> DMatrix<Complex<f64>> {
    m.map(Complex::from)
}

/// Modes of every gear that has some, as it stands with the input at its start.
fn bodies((meshes, train): (&[GearMesh], &Train), modes: &[Option<Arc<GearModes>>]) -> Vec<ElasticBody> {
    let angle = |disc: usize| {
        let mut places = meshes.iter().zip(train.meshing());
        places.find_map(|(mesh, meshing)| {
            let end = mesh.discs.iter().position(|own| *own == disc)?;
            Some(meshing.gear_angles(&mesh.pair)[end])
        })
    };
    let one = |(disc, own): (usize, &Option<Arc<GearModes>>)| Some(ElasticBody::new(disc, own.as_ref()?, angle(disc)?));
    modes.iter().enumerate().filter_map(one).collect()
}

/// Turn of a mesh's coordinates to the common axes: displacements, and behind them the modes of both gears, whose patterns
/// stand in space.
fn turn_with_modes(
    direction: f64,
    structure: &Structure,
    (mesh, modes): (&GearMesh, &[Option<Arc<GearModes>>]),
    excitation: &MeshExcitation,
) -> Result<DMatrix<f64>, GearboxError> {
    let (found, wanted) =
        (excitation.tangent.nrows(), 12 + mesh.discs.iter().map(|d| structure.modes_of(*d)).sum::<usize>());
    if found != wanted {
        return Err(GearboxError::Count { what: "coordinates of the excitation of a mesh", found, wanted });
    }
    let mut all = DMatrix::identity(wanted, wanted);
    all.view_mut((0, 0), (12, 12)).copy_from(&turn(direction));
    let mut at = 12;
    for own in mesh.discs.iter().filter_map(|disc| modes.get(*disc)?.as_ref()) {
        if let Some(standing) = own.standing() {
            // p of the mesh's axes is e^(phi N) p of the common ones.
            all.view_mut((at, at), (own.count(), own.count())).copy_from(&standing.turned(-direction));
        }
        at += own.count();
    }
    Ok(all)
}

/// Frequencies that are one, relative.
const SAME: f64 = 1e-9;

/// Root mean square of a sum of harmonics, given as pairs of frequency and complex amplitude (peak). Harmonics of the
/// same frequency are added before they are squared, such as those of two meshes of an idler.
///
/// ```text
/// rms = sqrt(sum over frequencies |sum a|^2 / 2)
/// ```
pub fn rms(harmonics: impl IntoIterator<Item = (f64, Complex<f64>)>) -> f64 {
    let mut all: Vec<(f64, Complex<f64>)> = harmonics.into_iter().collect();
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    let one = |a: &(f64, Complex<f64>), b: &(f64, Complex<f64>)| b.0 - a.0 <= SAME * b.0.abs();
    let squares = all.chunk_by(one).map(|same| same.iter().map(|(_, a)| *a).sum::<Complex<f64>>().norm_sqr());
    (0.5 * squares.sum::<f64>()).sqrt()
}

/// Places of a period at which orders are added up.
const PLACES: usize = 128;

/// Largest decrease of a sum of harmonics below its mean, given frequency, order and complex amplitude (peak) of each.
/// Orders of the same fundamental frequency are added with their phases; those of different ones are added as if they
/// coincided at some time.
pub fn taken_off(harmonics: impl IntoIterator<Item = (f64, usize, Complex<f64>)>) -> f64 {
    type Own = (f64, usize, Complex<f64>);
    let mut all: Vec<Own> = harmonics.into_iter().map(|(hz, order, a)| (hz / order as f64, order, a)).collect();
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    let lowest = |same: &[Own]| {
        let at = |place: usize| {
            let turn = std::f64::consts::TAU * place as f64 / PLACES as f64;
            same.iter().map(|(_, order, a)| (a * Complex::cis(turn * *order as f64)).re).sum::<f64>()
        };
        (0..PLACES).map(at).fold(0.0, f64::min)
    };
    all.chunk_by(|a: &Own, b: &Own| b.0 - a.0 <= SAME * b.0.abs()).map(|same| -lowest(same)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Orders of one mesh count as they stand to each other: cos t + cos 2t falls by 9/8, sin t + sin 2t by 1.76; those of
    /// two frequencies by their sum; two meshes of one frequency, as of an idler, by what is left of both.
    #[test]
    fn orders_take_off_what_they_reach_together() {
        let (one, turned) = (Complex::new(8.0, 0.0), Complex::new(0.0, -8.0));
        let near = |all: &[(f64, usize, Complex<f64>)], wanted: f64| {
            let found = taken_off(all.iter().copied());
            assert!((found - wanted).abs() < 2e-3 * wanted + 1e-9, "{found}, not {wanted}");
        };
        near(&[(50.0, 1, one), (100.0, 2, one)], 9.0);
        near(&[(50.0, 1, turned), (100.0, 2, turned)], 8.0 * 1.7602);
        near(&[(50.0, 1, one), (33.0, 1, turned)], 16.0);
        near(&[(50.0, 1, one), (50.0, 1, -one)], 0.0);
    }
}
