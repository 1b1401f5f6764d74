//! Mean of a mesh over its cycle, and its deviation from the mean. Theory (86), (87).

use std::f64::consts::TAU;

use nalgebra::{Complex, DMatrix, DVector, SMatrix};

use crate::{
    GearMesh, GearboxError, MeshElement, MeshForces, Meshing, ModalForces, Vector12, even_mesh::guessed_lever,
};

/// A mesh at one position of its cycle, in its own axes.
#[derive(Debug, Clone, PartialEq)]
pub struct MeshSample {
    /// Mesh cycles ([`crate::Train::cycles`]).
    pub cycles: f64,
    /// Displacements of both gears, mm and rad.
    pub displacements: Vector12,
    /// Forces at this position, and their tangent.
    pub reply: MeshForces,
    /// The same with elastic modes of the gears as coordinates, if the mesh keeps modes.
    pub modal: Option<ModalForces>,
}

impl MeshSample {
    /// Displacements, and amplitudes of modes behind them.
    fn coordinates(&self) -> DVector<f64> {
        let modes = self.modal.as_ref().map_or(&[][..], |own| own.amplitudes.as_slice());
        DVector::from_iterator(12 + modes.len(), self.displacements.iter().chain(modes).copied())
    }

    /// Forces on these.
    fn force(&self) -> DVector<f64> {
        let rigid = || DVector::from_column_slice(self.reply.force.as_slice());
        self.modal.as_ref().map_or_else(rigid, |own| own.force.clone())
    }

    /// How forces follow coordinates.
    fn tangent(&self) -> DMatrix<f64> {
        let rigid = || DMatrix::from_column_slice(12, 12, self.reply.tangent.as_slice());
        self.modal.as_ref().map_or_else(rigid, |own| own.tangent.clone())
    }
}

/// A mesh linearised about its mean, for all phases: f = f_0 + T (q - q_0).
#[derive(Debug, Clone, PartialEq)]
pub struct MeanMesh {
    /// Mean displacements q_0, mm and rad.
    pub displacements: Vector12,
    /// Mean forces f_0, N and N mm.
    pub force: Vector12,
    /// Tangent T = df/dq, symmetric: N/mm, N, N mm.
    pub tangent: SMatrix<f64, 12, 12>,
    /// Mean of the sum of the normal forces, N.
    pub normal_force: f64,
}

impl MeanMesh {
    /// Means of several samples; `None` for an empty list.
    pub fn of(samples: &[MeshSample]) -> Option<Self> {
        if samples.is_empty() {
            return None;
        }
        let share = 1.0 / samples.len() as f64;
        let tangent = share * samples.iter().map(|s| s.reply.tangent).sum::<SMatrix<f64, 12, 12>>();
        Some(Self {
            displacements: share * samples.iter().map(|s| s.displacements).sum::<Vector12>(),
            force: share * samples.iter().map(|s| s.reply.force).sum::<Vector12>(),
            tangent: 0.5 * (tangent + tangent.transpose()),
            normal_force: share * samples.iter().map(|s| s.reply.normal_force).sum::<f64>(),
        })
    }
}

/// Levers of the rotations of gear 1 and gear 2 on the normal approach of a mesh's flanks, mm: those of its normal
/// (theory (53)).
///
/// # Errors
/// [`GearboxError::Mesh`] if the gears have no line of action.
pub fn turn_levers(mesh: &GearMesh, meshing: &Meshing) -> Result<[f64; 2], GearboxError> {
    let lever = guessed_lever(mesh, meshing)?;
    Ok([lever[5], lever[11]])
}

/// A tangent that does not resist a turn with the teeth: turns count by h_1 theta_1 + h_2 theta_2 alone.
///
/// ```text
/// P'T P,   P: theta_i -> (h_1 theta_1 + h_2 theta_2)/(2 h_i)
/// ```
/// Contact points off the line of action have levers some 1e-4 unlike: left as they are, a free train would swing.
fn turning_with_the_teeth(tangent: &DMatrix<f64>, [h1, h2]: [f64; 2]) -> DMatrix<f64> {
    let mut p = DMatrix::identity(tangent.nrows(), tangent.nrows());
    (p[(5, 5)], p[(5, 11)]) = (0.5, 0.5 * h2 / h1);
    (p[(11, 5)], p[(11, 11)]) = (0.5 * h1 / h2, 0.5);
    turned_about(&p.transpose(), tangent)
}

/// A M A', column by column: matrices of twelve coordinates have the same bits with modes behind them and without.
pub(super) fn turned_about(a: &DMatrix<f64>, m: &DMatrix<f64>) -> DMatrix<f64> {
    let product = |a: &DMatrix<f64>, b: &DMatrix<f64>| {
        let mut all = DMatrix::zeros(a.nrows(), b.ncols());
        all.column_iter_mut().zip(b.column_iter()).for_each(|(mut own, column)| own.gemv(1.0, a, &column, 0.0));
        all
    };
    product(&product(a, m), &a.transpose())
}

impl MeshElement for MeanMesh {
    fn go_to(&mut self, _cycles: f64) -> Result<(), GearboxError> {
        Ok(())
    }

    fn evaluate(&mut self, displacements: &Vector12) -> Result<MeshForces, GearboxError> {
        let force = self.force + self.tangent * (displacements - self.displacements);
        Ok(MeshForces { force, tangent: self.tangent, normal_force: self.normal_force })
    }
}

/// A mesh for vibration: its mean, and the order components of the force by which it deviates from the mean.
///
/// ```text
/// f(c) = f_0 + T (q - q_0) + g(c),   g_k = 2/N sum_j (f_j - T q_j) exp(-2 pi i k c_j)
/// ```
/// q are twelve displacements, then the amplitudes of elastic modes if these are kept; c are mesh cycles; f_j, q_j, T_j
/// the values in static equilibrium under load; T the mean of T_j. If the static forces do not change, as in any train
/// without closed loops, g is -T times the displacements of the loaded transmission error: mean mesh stiffness times
/// the harmonics of the STE. The rest of g is the resultant that moves over the width with the contact lines. The
/// linear response at zero frequency equals the loaded static gearbox exactly.
#[derive(Debug, Clone, PartialEq)]
pub struct MeshExcitation {
    /// The static mean, which includes all elasticity of the gears.
    pub mean: MeanMesh,
    /// Tangent T of the coordinates, symmetric, (12 + m) x (12 + m): N/mm, N, N mm, with mm t^(1/2) instead of mm for
    /// modes. It does not resist a rotation with the teeth.
    pub tangent: DMatrix<f64>,
    /// g_1, g_2, ... (peak of a cosine over the cycles, forces on the coordinates in the mesh's own axes): N, N mm.
    pub orders: Vec<DVector<Complex<f64>>>,
    /// Single-sided amplitudes of the same orders of the loaded transmission error, mm, if it is given.
    pub transmission_error: Vec<Complex<f64>>,
}

impl MeshExcitation {
    /// Excitation from samples evenly spaced over one cycle, with the transmission error (mm) of each. Orders are 1 ..
    /// `orders`, but below half the number of samples. `turns` are the [`turn_levers`]; the mean does not resist a
    /// rotation with the teeth. `None` without samples.
    pub fn new(samples: &[MeshSample], transmission_error: &[f64], orders: usize, turns: [f64; 2]) -> Option<Self> {
        let mut mean = MeanMesh::of(samples)?;
        let rigid = turning_with_the_teeth(&DMatrix::from_column_slice(12, 12, mean.tangent.as_slice()), turns);
        mean.tangent = SMatrix::from_column_slice(rigid.as_slice());
        let tangent = mean_of(samples, MeshSample::tangent)?;
        let tangent = turning_with_the_teeth(&(0.5 * (&tangent + tangent.transpose())), turns);
        let (centre, force_0) = (mean_of(samples, MeshSample::coordinates)?, mean_of(samples, MeshSample::force)?);
        let orders = 1..=orders.min(samples.len().saturating_sub(1) / 2);
        // Means are taken off first: what does not move has no round-off.
        let start = |s: &MeshSample| (s.force() - &force_0) - &tangent * (s.coordinates() - &centre);
        let wave = |order: usize, s: &MeshSample| {
            Complex::from_polar(2.0 / samples.len() as f64, -TAU * (order as f64 * s.cycles).fract())
        };
        let force = |k: usize| {
            let one = |s: &MeshSample| start(s).map(|x| Complex::from(x) * wave(k, s));
            samples.iter().map(one).fold(DVector::zeros(centre.len()), |sum, own| sum + own)
        };
        let level = transmission_error.iter().sum::<f64>() / transmission_error.len().max(1) as f64;
        let error = |k: usize| {
            let one = |(s, te): (&MeshSample, &f64)| wave(k, s) * (te - level);
            samples.iter().zip(transmission_error).map(one).sum::<Complex<f64>>()
        };
        Some(Self {
            orders: orders.clone().map(force).collect(),
            transmission_error: orders.map(error).collect(),
            mean,
            tangent,
        })
    }
}

/// Mean over samples; `None` without any, and where they keep unlike modes.
fn mean_of<C: nalgebra::Dim>(
    samples: &[MeshSample],
    of: impl Fn(&MeshSample) -> nalgebra::OMatrix<f64, nalgebra::Dyn, C>,
) -> Option<nalgebra::OMatrix<f64, nalgebra::Dyn, C>>
where
    nalgebra::DefaultAllocator: nalgebra::allocator::Allocator<nalgebra::Dyn, C>,
{
    let mut sum = of(samples.first()?);
    for sample in &samples[1..] {
        let own = of(sample);
        if own.shape() != sum.shape() {
            return None;
        }
        sum += own;
    }
    Some(sum * (1.0 / samples.len() as f64))
}
