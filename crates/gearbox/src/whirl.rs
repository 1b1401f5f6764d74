//! Natural frequencies and whirl modes of spinning shafts. Theory (78), (80).

use std::ops::Range;

use faer::{Mat, c64};
use fem::{Modes, dense::general_eigen, natural_modes};
use nalgebra::{Complex, DMatrix, DVector, SymmetricEigen};

use crate::{Assembly, GearboxError, ModalEnergy, rigid_motions::NOTHING, turning_frame::TurningFrame};

/// Stiffness over mass, 1/s^2, and mass (t) that no machine has.
const MOST: f64 = 1e100;
/// Work of a turning frame on a free motion over the most that it does, up to which it is round-off.
const FREE: f64 = 1e-8;
/// Share of a mode's kinetic energy up to which that of a shaft across its axis is round-off.
const LATERAL: f64 = 1e-6;

/// A natural mode exp(lambda t), lambda = -decay + i frequency.
#[derive(Debug, Clone, PartialEq)]
pub struct WhirlMode {
    /// Angular frequency, rad/s, > 0.
    pub frequency: f64,
    /// Decay rate, 1/s; 0 without damping.
    pub decay: f64,
    /// Complex amplitudes of all coordinates of the [`Assembly`], mm and rad, with x^H M x = 1 t mm^2; the largest
    /// contribution to this product is real.
    pub shape: DVector<Complex<f64>>,
    /// Whirl of each shaft relative to its own spin: +1 forward on circles, -1 backward, 0 in a plane. Also 0 for a
    /// shaft that does not spin and for one that moves only along or about its axis.
    ///
    /// ```text
    /// w = -2 sign(Omega) sum Im(conj(x) y) / sum (|x|^2 + |y|^2)      over the nodes
    /// ```
    pub whirl: Vec<f64>,
    /// Shares of the mode's energy.
    pub energy: ModalEnergy,
}

/// All natural modes at one speed.
#[derive(Debug, Clone, PartialEq)]
pub struct WhirlModes {
    /// Speeds of the shafts, rad/s about +z.
    pub speeds: Vec<f64>,
    /// Oscillating modes, ascending in frequency.
    pub modes: Vec<WhirlMode>,
    /// Number of zero eigenvalues: two per rigid motion that is not held.
    pub zeros: usize,
    /// Decay rates of motions without oscillation, 1/s, ascending.
    pub decaying: Vec<f64>,
}

/// Natural modes of an assembly at any speed; the modes without spin are computed once.
#[derive(Debug, Clone)]
pub struct Rotors {
    pub(crate) assembly: Assembly,
    stiffness: DMatrix<f64>,
    mass: DMatrix<f64>,
    pub(crate) rest: Modes,
    /// Damping in the modes at rest.
    pub(crate) damping: DMatrix<f64>,
    /// Damping in the modes at rest that gives each of them the ratio 1: 2 W, 1/s.
    pub(crate) unit_damping: DMatrix<f64>,
    /// What a frame that turns adds, where a shaft is fixed in space.
    frame: Option<TurningFrame>,
}

/// What speeds add in the modes at rest.
pub(crate) struct Spin {
    /// Gyroscopic matrix, 1/s; skew-symmetric.
    pub rates: DMatrix<f64>,
    /// Stiffness and circulatory matrix by a frame that turns, 1/s^2.
    pub frame: Option<[DMatrix<f64>; 2]>,
}

/// Held parts: parts that do not move, or move as a whole.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Held {
    /// Shafts that are rigid in rigid bearings: they only rotate about their axes.
    pub shafts: Vec<usize>,
    /// Discs whose rotation is given, whatever the inertia of the machine there.
    pub turns: Vec<usize>,
}

impl Held {
    /// Displacements (0 .. 2) and turns (3 .. 5) that a shaft has as a whole; one whose turn is held at a disc has none about
    /// its axis.
    fn axes(&self, assembly: &Assembly, shaft: usize) -> Range<usize> {
        let structure = assembly.structure();
        let turns = !self.turns.iter().any(|&disc| structure.discs.get(disc).is_some_and(|d| d.shaft == shaft));
        let first = if self.shafts.contains(&shaft) { 5 } else { 0 };
        first..if turns { 6 } else { 5 }
    }
}

impl Rotors {
    /// Computes the modes without spin, from which all others are composed.
    ///
    /// The number of zero frequencies without spin is the number of rigid motions that bearings and meshes do not
    /// resist. These are counted from the connections of the shafts, and not from the magnitude of frequencies.
    ///
    /// # Errors
    /// [`GearboxError::Matrix`] if a coordinate has no mass; [`GearboxError::LostMode`] if the square of the lowest
    /// other frequency is below n eps times that of the highest (n coordinates), which is round-off.
    pub fn new(assembly: Assembly) -> Result<Self, GearboxError> {
        Self::holding(assembly, &Held::default())
    }

    /// Rotors with held parts: q = B z, B'K B and B'M B.
    ///
    /// # Errors
    /// The errors of [`Rotors::new`]; [`GearboxError::NoShaft`], [`GearboxError::NoDisc`] for parts that do not exist.
    pub fn holding(assembly: Assembly, held: &Held) -> Result<Self, GearboxError> {
        Self::beside_turn(assembly, held, None)
    }

    /// Rotors whose train turns freely by `free`, displacements of all coordinates. Springs and mean tangents hold that a little
    /// where planets go round under load, for their seats do not turn here:
    ///
    /// ```text
    /// K := P' K P,   P = 1 - r r' M/(r' M r)
    /// ```
    pub(crate) fn beside_turn(
        assembly: Assembly,
        held: &Held,
        free: Option<&DVector<f64>>,
    ) -> Result<Self, GearboxError> {
        assembly.structure().check_linear()?;
        let (mut stiffness, mass) = (assembly.stiffness(), assembly.mass());
        let mut more = 0;
        if let Some(r) = free {
            let (pressed, heavy) = (&stiffness * r, &mass * r);
            let (work, inertia) = (r.dot(&pressed), r.dot(&heavy));
            // What is held by round-off alone is counted by the connections.
            let gross = r.component_mul(r).dot(&stiffness.diagonal());
            more = usize::from(work.abs() > NOTHING * gross);
            stiffness.ger(-1.0 / inertia, &heavy, &pressed, 1.0);
            stiffness.ger(-1.0 / inertia, &pressed, &heavy, 1.0);
            stiffness.ger(work / inertia / inertia, &heavy, &heavy, 1.0);
        }
        // Beyond this squares of frequencies are no numbers, and the search for them does not end.
        let steepest = stiffness.amax() / mass.diagonal().min();
        if steepest.is_nan() || steepest > MOST || mass.amax() > MOST {
            return Err(fem::FemError::NotFinite { row: 0, column: 0 }.into());
        }
        let mut rest = if *held == Held::default() {
            natural_modes(&stiffness, &mass)?
        } else {
            let basis = basis(&assembly, held)?;
            let of = |matrix: &DMatrix<f64>| {
                let own = basis.transpose() * matrix * &basis;
                0.5 * (&own + own.transpose())
            };
            let found = natural_modes(&of(&stiffness), &of(&mass))?;
            Modes { shapes: &basis * found.shapes, ..found }
        };
        let rigid = more + assembly.rigid_motions(|shaft| held.axes(&assembly, shaft), true);
        told_from_round_off(&rest.frequencies, rigid)?;
        rest.frequencies.iter_mut().take(rigid).for_each(|w| *w = 0.0);
        let damping = rest.shapes.transpose() * assembly.damping() * &rest.shapes;
        let unit_damping = DMatrix::from_diagonal(&DVector::from_iterator(
            rest.frequencies.len(),
            rest.frequencies.iter().map(|w| 2.0 * w),
        ));
        let frame = TurningFrame::of(&assembly, &mass)?;
        Ok(Self { assembly, stiffness, mass, rest, damping, unit_damping, frame })
    }

    /// The assembly.
    pub fn assembly(&self) -> &Assembly {
        &self.assembly
    }

    /// Undamped modes without spin: angular frequencies (rad/s, 0 for rigid motions) and shapes of unit mass.
    pub fn modes_at_rest(&self) -> &Modes {
        &self.rest
    }

    /// Natural modes with the shafts spinning at `speeds` in space (rad/s about +z, one per shaft).
    ///
    /// ```text
    /// q = Phi eta,   d/dt [W eta; eta'] = [0, W; -W, -Phi'(C + G) Phi] [W eta; eta']      W = diag(omega) at rest
    /// ```
    /// Without damping this matrix is skew-symmetric, and its eigenvalues lie on the imaginary axis to round-off. Where a
    /// shaft is fixed in space ([`Structure::fixed`](crate::Structure::fixed)), all is seen in the frame of the carrier, which
    /// turns as the shafts that stand in it do; theory (86b). W^2 is then that matrix with what the frame adds, in its own
    /// axes; a negative square has the other sign in the lower row.
    ///
    /// # Errors
    /// [`GearboxError::Count`], [`GearboxError::OutOfRange`], also where shafts that stand have several speeds;
    /// [`GearboxError::Matrix`].
    pub fn whirl_modes(&self, speeds: &[f64]) -> Result<WhirlModes, GearboxError> {
        let Spin { rates, frame } = self.spin(speeds)?;
        let n = self.rest.frequencies.len();
        let rates = &self.damping + rates;
        let Stiffened { axes, squares, rates, circulating } = Stiffened::of(&self.rest.frequencies, rates, frame);
        let omega: Vec<f64> = squares.iter().map(|s| s.abs().sqrt()).collect();
        let state = Mat::from_fn(2 * n, 2 * n, |i, j| match (i < n, j < n) {
            (true, true) => 0.0,
            (true, false) if j - n == i => omega[i],
            (false, true) => {
                let own = if i - n == j { -squares[j].signum() * omega[j] } else { 0.0 };
                let dragged = circulating.as_ref().filter(|_| omega[j] > 0.0);
                own - dragged.map_or(0.0, |c| c[(i - n, j)] / omega[j])
            }
            (false, false) => -rates[(i - n, j - n)],
            _ => 0.0,
        });
        let (values, vectors) = general_eigen(state.as_ref())?;
        let largest = values.iter().map(|v| v.norm()).fold(0.0, f64::max);
        let small = 2.0 * n as f64 * f64::EPSILON * largest;
        let mut found = WhirlModes { speeds: speeds.to_vec(), modes: Vec::new(), zeros: 0, decaying: Vec::new() };
        for (j, value) in values.iter().enumerate() {
            if value.norm() <= small {
                found.zeros += 1;
            } else if value.im > small {
                let mut eta = DVector::from_fn(n, |i, _| complex(vectors[(n + i, j)] / *value));
                if let Some(axes) = &axes {
                    let [re, im] = [eta.map(|x| x.re), eta.map(|x| x.im)].map(|part| axes * part);
                    eta = DVector::from_fn(n, |i, _| Complex::new(re[i], im[i]));
                }
                found.modes.push(self.mode(*value, &eta, speeds));
            } else if value.im.abs() <= small {
                found.decaying.push(-value.re);
            }
        }
        found.modes.sort_by(|a, b| a.frequency.total_cmp(&b.frequency));
        found.decaying.sort_by(f64::total_cmp);
        Ok(found)
    }

    /// What speeds in space add in the modes at rest. Theory (86b).
    pub(crate) fn spin(&self, speeds: &[f64]) -> Result<Spin, GearboxError> {
        let mut gyroscopic = self.assembly.gyroscopic(speeds)?;
        let speed = self.assembly.structure().frame_speed(speeds)?;
        let modal = |matrix: &DMatrix<f64>| self.rest.shapes.transpose() * matrix * &self.rest.shapes;
        let frame = self.frame.as_ref().filter(|_| speed != 0.0).map(|own| {
            let stiffness = speed * speed * &own.pull + speed * own.tilted(&gyroscopic);
            gyroscopic += speed * &own.coriolis;
            let n = self.rest.frequencies.len();
            let dragged = own.dragged.as_ref().map_or_else(|| DMatrix::zeros(n, n), |c| speed * modal(c));
            [modal(&stiffness), dragged]
        });
        let rates = modal(&gyroscopic);
        // Skew-symmetric to the last bit: no damping by round-off.
        Ok(Spin { rates: 0.5 * (&rates - rates.transpose()), frame })
    }

    fn mode(&self, value: c64, eta: &DVector<Complex<f64>>, speeds: &[f64]) -> WhirlMode {
        let parts = [eta.map(|x| x.re), eta.map(|x| x.im)].map(|part| &self.rest.shapes * part);
        let heavy = [0, 1].map(|k| &self.mass * &parts[k]);
        let share = |i: usize| parts[0][i] * heavy[0][i] + parts[1][i] * heavy[1][i];
        let total: f64 = (0..parts[0].len()).map(share).sum();
        let most = (0..parts[0].len()).max_by(|a, b| share(*a).total_cmp(&share(*b))).unwrap_or(0);
        let largest = Complex::new(parts[0][most], parts[1][most]);
        let turn = largest.conj() / largest.norm().max(f64::MIN_POSITIVE) / total.max(f64::MIN_POSITIVE).sqrt();
        let shape = DVector::from_fn(parts[0].len(), |i, _| Complex::new(parts[0][i], parts[1][i]) * turn);
        let whirl = self.whirl(&shape, speeds);
        let energy = ModalEnergy::of(&self.assembly, [&self.stiffness, &self.mass], &shape);
        // No negative zero: what does not decay decays by nothing.
        WhirlMode { frequency: value.im, decay: 0.0 - value.re, shape, whirl, energy }
    }

    fn whirl(&self, shape: &DVector<Complex<f64>>, speeds: &[f64]) -> Vec<f64> {
        let parts = [shape.map(|x| x.re), shape.map(|x| x.im)];
        let heavy = parts.each_ref().map(|p| &self.mass * p);
        let energy = |i: usize| parts[0][i] * heavy[0][i] + parts[1][i] * heavy[1][i];
        let of_shaft = |((at, line), speed): ((usize, &fem::beam::BeamLine), &f64)| {
            let nodes: Vec<usize> = (0..line.positions().len()).map(|i| at + 6 * i).collect();
            let across: f64 = nodes.iter().flat_map(|&i| [i, i + 1, i + 3, i + 4]).map(energy).sum();
            let (mut area, mut square) = (0.0, 0.0);
            for i in nodes {
                let (x, y) = (shape[i], shape[i + 1]);
                area -= 2.0 * (x.conj() * y).im;
                square += x.norm_sqr() + y.norm_sqr();
            }
            if *speed == 0.0 || across <= LATERAL || square == 0.0 { 0.0 } else { speed.signum() * area / square }
        };
        self.assembly.lines().zip(speeds).map(of_shaft).collect()
    }
}

/// Squares of frequencies with what a frame adds, in the axes of both together.
struct Stiffened {
    /// Axes by the modes at rest; `None`: those themselves.
    axes: Option<DMatrix<f64>>,
    /// (rad/s)^2; negative where the frame turns faster than a mode swings.
    squares: Vec<f64>,
    /// Damping and gyroscopic matrix, 1/s.
    rates: DMatrix<f64>,
    /// Circulatory matrix by dampers in space, 1/s^2.
    circulating: Option<DMatrix<f64>>,
}

/// Number of free motions on which the frame does no work. Each stays free beside what it does to the others, of which squares have more
/// than the second order of its speed:
///
/// ```text
/// D_rr := D_rk (W^2 + D)_kk^-1 D_kr      r: those motions; k: the others
/// ```
fn keep_free(omega: &[f64], stiffness: &mut DMatrix<f64>) -> usize {
    *stiffness = 0.5 * (&*stiffness + stiffness.transpose());
    let most = stiffness.amax();
    let is_free = |i: &usize| omega[*i] == 0.0 && stiffness[(*i, *i)].abs() < FREE * most;
    let (free, held): (Vec<usize>, Vec<usize>) = (0..omega.len()).partition(is_free);
    let own = |i: usize, j: usize| if i == j { omega[i] * omega[i] } else { 0.0 };
    let k = DMatrix::from_fn(held.len(), held.len(), |i, j| own(held[i], held[j]) + stiffness[(held[i], held[j])]);
    let across = DMatrix::from_fn(held.len(), free.len(), |i, j| stiffness[(held[i], free[j])]);
    let Some(followed) = k.lu().solve(&across) else { return 0 };
    let block = across.tr_mul(&followed);
    for (i, r) in free.iter().enumerate() {
        free.iter().enumerate().for_each(|(j, s)| stiffness[(*r, *s)] = 0.5 * (block[(i, j)] + block[(j, i)]));
    }
    free.len()
}

impl Stiffened {
    fn of(omega: &[f64], rates: DMatrix<f64>, frame: Option<[DMatrix<f64>; 2]>) -> Self {
        let squares: Vec<f64> = omega.iter().map(|w| w * w).collect();
        let Some([mut stiffness, circulating]) = frame else {
            return Self { axes: None, squares, rates, circulating: None };
        };
        let free = keep_free(omega, &mut stiffness);
        squares.iter().enumerate().for_each(|(i, square)| stiffness[(i, i)] += square);
        let found = SymmetricEigen::new(stiffness);
        let (axes, mut squares) = (found.eigenvectors, found.eigenvalues.as_slice().to_vec());
        // Of what stays free there is no square, not even round-off.
        let mut order: Vec<usize> = (0..squares.len()).collect();
        order.sort_by(|a, b| squares[*a].abs().total_cmp(&squares[*b].abs()));
        order[..free].iter().for_each(|i| squares[*i] = 0.0);
        let turned = |matrix: &DMatrix<f64>| axes.tr_mul(&(matrix * &axes));
        let (rates, circulating) = (turned(&rates), turned(&circulating));
        let circulating = (circulating.amax() > 0.0).then_some(circulating);
        Self { squares, rates, circulating, axes: Some(axes) }
    }
}

/// Whether natural frequencies (rad/s, ascending) beyond the `rigid` first are more than round-off of the highest.
pub(crate) fn told_from_round_off(frequencies: &[f64], rigid: usize) -> Result<(), GearboxError> {
    let highest = frequencies.last().copied().unwrap_or(0.0);
    let least = highest * (frequencies.len() as f64 * f64::EPSILON).sqrt();
    match frequencies.get(rigid) {
        Some(&lowest) if lowest < least => {
            let hz = |w: f64| w / std::f64::consts::TAU;
            Err(GearboxError::LostMode { least_hz: hz(least), highest_hz: hz(highest) })
        }
        _ => Ok(()),
    }
}

/// B: a column for each way in which something can still move.
fn basis(assembly: &Assembly, held: &Held) -> Result<DMatrix<f64>, GearboxError> {
    let count = assembly.structure().shafts.len();
    if let Some(&shaft) = held.shafts.iter().find(|s| **s >= count) {
        return Err(GearboxError::NoShaft { part: "what is held".into(), shaft, count });
    }
    let count = assembly.structure().discs.len();
    let turn = |&disc: &usize| {
        let no_disc = || GearboxError::NoDisc { part: "a turn that is held".into(), disc, count };
        assembly.disc(disc).map(|at| at + 5).ok_or_else(no_disc)
    };
    let turns = held.turns.iter().map(turn).collect::<Result<Vec<_>, _>>()?;
    let mut columns = Vec::new();
    for (shaft, (at, line)) in assembly.lines().enumerate() {
        let all = at..at + line.stiffness.nrows();
        if !held.shafts.contains(&shaft) {
            columns.extend(all.filter(|i| !turns.contains(i)).map(|i| vec![i]));
        } else if !turns.iter().any(|i| all.contains(i)) {
            columns.push(all.skip(5).step_by(6).collect());
        }
    }
    columns.extend(assembly.modes().map(|i| vec![i]));
    Ok(DMatrix::from_fn(assembly.size(), columns.len(), |i, j| if columns[j].contains(&i) { 1.0 } else { 0.0 }))
}

fn complex(x: c64) -> Complex<f64> {
    Complex::new(x.re, x.im)
}
