//! Normal modes of one gear, and the quantities that its equations of motion need.

use std::f64::consts::TAU;

use faer::{Mat, MatRef};
use fem::{DofMap, Material};
use mesh::Mesh;
use nalgebra::{Rotation3, Vector3};
use rayon::prelude::*;

use super::{
    choice::ModeChoice,
    krylov::{Eigenpairs, Until, lowest},
    pencil::Pencil,
    spin::{Spin, spin_products, swept},
    whole::Whole,
};
use crate::{GearReducer, ReductionError, Window, cyclic::VibratingSector, reducer::Method};

/// Normal modes of a gear with its bore held and its flanks free.
///
/// ```text
/// u(x, t) = sum_j phi_j(x) q_j(t),   phi_i' M phi_j = delta_ij,   phi_i' K phi_j = omega_i^2 delta_ij
/// q in mm t^(1/2)
/// ```
/// Shapes are in the gear's own frame, in which tooth 0 is always the same, so coordinates do not change when a window
/// moves. The gear is treated as rotating slowly relative to its modes: terms of the order of the angular velocity over
/// omega are neglected.
#[derive(Debug, Clone)]
pub struct GearModes {
    squares: Vec<f64>,
    waves: Option<Vec<u32>>,
    coupling: Vec<[f64; 6]>,
    shapes: Shapes,
    spin: Option<Spin>,
}

/// Where the shapes are known.
#[derive(Debug, Clone)]
pub(super) enum Shapes {
    /// On all free freedoms of the mesh, one column a mode.
    Whole(Mat<f64>),
    /// u_k = Re((x + i y) e^(i psi k)) in the frame of sector k, one column a mode of either part.
    Sector { dofs: DofMap, phases: Vec<f64>, parts: [Mat<f64>; 2] },
}

/// Columns of a Lanczos step for a whole gear.
pub(super) const WHOLE_BLOCK: usize = 8;
/// Columns of a Lanczos step for one harmonic.
pub(super) const HARMONIC_BLOCK: usize = 4;

impl GearReducer {
    /// Normal modes of the gear with its bore held and all flanks free.
    ///
    /// The modes of a cyclic gear are computed from one sector, harmonic by harmonic; those of any other gear from the
    /// factor of the whole gear.
    ///
    /// # Errors
    /// [`ReductionError::ModesNotConverged`]; [`ReductionError::Fem`].
    pub fn modes(&self, choice: ModeChoice) -> Result<GearModes, ReductionError> {
        match self.method()? {
            Method::Cyclic(cyclic) => of_sector(&cyclic.vibrating()?, self.material(), choice),
            Method::General(gear, _) => {
                let mesh = self.gear().mesh();
                let body = Whole { gear, mass: fem::assemble_mass(mesh, self.material(), self.dofs())? };
                of_whole(self, choice, lowest(&body, choice.until(), WHOLE_BLOCK)?)
            }
        }
    }
}

impl GearReducer {
    /// Whether another reducer has the same body, reduced by the same method. Then their modes belong to the same gear,
    /// even if the two are reduced to different flanks.
    ///
    /// # Errors
    /// [`ReductionError::Fem`] if a stored reduction must be computed again.
    pub fn has_body_of(&self, other: &Self) -> Result<bool, ReductionError> {
        let alike = self.material() == other.material() && self.elements() == other.elements();
        Ok(alike
            && match (self.method()?, other.method()?) {
                (Method::Cyclic(a), Method::Cyclic(b)) => a.has_sector_of(b),
                (Method::General(..), Method::General(..)) => {
                    let [a, b] = [self, other].map(GearReducer::gear);
                    a.mesh() == b.mesh() && a.bore_coupling() == b.bore_coupling() && a.bore_nodes() == b.bore_nodes()
                }
                _ => false,
            })
    }
}

/// Residuals with which the harmonic of the lowest frequency is looked for, and that frequency: known to 1e-12.
const ROUGH: f64 = 0.05;
const FINE: f64 = 1e-7;

impl GearReducer {
    /// Lowest omega^2 of the gear with its bore held and its flanks free, (rad/s)^2; infinite where nothing moves.
    ///
    /// # Errors
    /// As [`Self::modes`].
    pub(crate) fn lowest_square(&self) -> Result<f64, ReductionError> {
        let first = |pencil: &dyn Pencil, residual: f64, block: usize| -> Result<f64, ReductionError> {
            let pairs = lowest(pencil, Until::First { residual }, block)?;
            Ok(pairs.squares.first().copied().unwrap_or(f64::INFINITY))
        };
        match self.method()? {
            Method::Cyclic(cyclic) => {
                let sector = cyclic.vibrating()?;
                let of = |waves: u32, residual: f64| first(&sector.harmonic(waves)?, residual, HARMONIC_BLOCK);
                let all = (0..=sector.teeth / 2).into_par_iter().map(|n| of(n, ROUGH));
                let rough = all.collect::<Result<Vec<f64>, ReductionError>>()?;
                // A Ritz value lies above its square, and the square is no farther below than the residual says.
                let least = rough.iter().copied().fold(f64::INFINITY, f64::min);
                let may_be = |square: f64| square.is_finite() && square <= (1.0 + 2.0 * ROUGH) * least;
                let near: Vec<u32> = (0..).zip(&rough).filter(|(_, square)| may_be(**square)).map(|(n, _)| n).collect();
                let fine = near.into_par_iter().map(|n| of(n, FINE)).collect::<Result<Vec<f64>, ReductionError>>()?;
                Ok(fine.into_iter().fold(f64::INFINITY, f64::min))
            }
            Method::General(gear, _) => {
                let mass = fem::assemble_mass(self.gear().mesh(), self.material(), self.dofs())?;
                first(&Whole { gear, mass }, FINE, WHOLE_BLOCK)
            }
        }
    }
}

/// The modes of a gear that is known as a whole.
pub(super) fn of_whole(
    reducer: &GearReducer,
    choice: ModeChoice,
    found: Eigenpairs,
) -> Result<GearModes, ReductionError> {
    let Eigenpairs { mut squares, shapes } = found;
    squares.truncate(choice.cut(&squares));
    let shapes = shapes.get(.., ..squares.len()).to_owned();
    let of_motion = inertia_of((reducer.gear().mesh(), reducer.material(), reducer.dofs()), rigid)?;
    let coupling = products(&of_motion, shapes.as_ref());
    Ok(GearModes { squares, waves: None, coupling, shapes: Shapes::Whole(shapes), spin: None })
}

/// Modes by harmonics.
fn of_sector(sector: &VibratingSector, material: &Material, choice: ModeChoice) -> Result<GearModes, ReductionError> {
    let z = sector.teeth;
    let of_wave = |waves: u32, until: Until| lowest(&sector.harmonic(waves)?, until, HARMONIC_BLOCK);
    let all = |until: Until| -> Result<Vec<Eigenpairs>, ReductionError> {
        (0..=z / 2).into_par_iter().map(|n| of_wave(n, until)).collect()
    };
    let found = match choice.until() {
        Until::Count(count) => {
            let mut first = all(Until::Count(count.min(HARMONIC_BLOCK)))?;
            // Nothing above the last of the wanted number of any modes is wanted.
            let mut squares: Vec<f64> = first.iter().flat_map(|e| &e.squares).copied().collect();
            squares.sort_unstable_by(f64::total_cmp);
            let enough = squares.get(count.wrapping_sub(1)).copied();
            let until = enough.map_or(Until::Count(count), Until::Below);
            let more = |e: &Eigenpairs| enough.is_none_or(|bound| e.squares.last().is_some_and(|&s| s < bound));
            let again: Vec<u32> = (0..=z / 2).filter(|&n| count > 0 && more(&first[n as usize])).collect();
            let further: Result<Vec<_>, _> = again.par_iter().map(|&n| of_wave(n, until)).collect();
            for (n, pairs) in again.iter().zip(further?) {
                first[*n as usize] = pairs;
            }
            first
        }
        until => all(until)?,
    };
    of_harmonics(sector, material, choice, &found)
}

/// The modes of a gear from those of its harmonics 0 .. z/2, the lowest first.
pub(super) fn of_harmonics(
    sector: &VibratingSector,
    material: &Material,
    choice: ModeChoice,
    found: &[Eigenpairs],
) -> Result<GearModes, ReductionError> {
    let z = sector.teeth;
    let mut order: Vec<(f64, u32, usize)> = Vec::new();
    for (n, pairs) in (0..).zip(found) {
        order.extend(pairs.squares.iter().enumerate().map(|(i, &s)| (s, n, i)));
    }
    order.sort_by(|a, b| a.0.total_cmp(&b.0).then((a.1, a.2).cmp(&(b.1, b.2))));
    let squares: Vec<f64> = order.iter().map(|o| o.0).collect();
    order.truncate(choice.cut(&squares));
    let rows = sector.dofs().free_count();
    // From unit mass of one sector's amplitude to unit mass of the gear.
    let part = |row: usize, j: usize, part: usize| {
        let (_, n, i) = order[j];
        let shapes = &found[n as usize].shapes;
        let parts = shapes.nrows() / rows.max(1);
        if part < parts { shapes[(part * rows + row, i)] * (parts as f64 / f64::from(z)).sqrt() } else { 0.0 }
    };
    let parts = [0, 1].map(|p| Mat::from_fn(rows, order.len(), |row, j| part(row, j, p)));
    let waves: Vec<u32> = order.iter().map(|o| o.1).collect();
    let phases: Vec<f64> = waves.iter().map(|&n| sector.phase(n)).collect();
    let shared = |field: fn(usize, Vector3<f64>) -> Vector3<f64>| -> Result<Vec<[f64; 6]>, ReductionError> {
        let of_motion = inertia_of((sector.mesh(), material, sector.dofs()), field)?;
        let [re, im] = parts.each_ref().map(|p| products(&of_motion, p.as_ref()));
        Ok((0..order.len()).map(|j| around(z, sector.way, (phases[j], re[j], im[j]))).collect())
    };
    let (coupling, swept) = (shared(rigid)?, shared(swept)?);
    let places: Vec<(u32, usize)> = order.iter().map(|o| (o.1, o.2)).collect();
    let spin = Spin { way: sector.way, products: spin_products(sector, found, &places)?, swept };
    let shapes = Shapes::Sector { dofs: sector.dofs().clone(), phases, parts };
    let squares = order.iter().map(|o| o.0).collect();
    Ok(GearModes { squares, waves: Some(waves), coupling, shapes, spin: Some(spin) })
}

/// Unit displacements of a rigid body along and about the axes of its frame, at x.
fn rigid(j: usize, x: Vector3<f64>) -> Vector3<f64> {
    let unit = Vector3::from_fn(|i, _| f64::from(u8::from(i == j % 3)));
    if j < 3 { unit } else { unit.cross(&x) }
}

/// M times a field of six columns, on the free freedoms: t, t mm.
fn inertia_of(
    (mesh, material, dofs): (&Mesh, &Material, &DofMap),
    field: impl Fn(usize, Vector3<f64>) -> Vector3<f64>,
) -> Result<Mat<f64>, ReductionError> {
    let all = DofMap::new(mesh.nodes.len(), &[]);
    let motion = Mat::from_fn(all.free_count(), 6, |row, j| field(j, Vector3::from(mesh.nodes[row / 3]))[row % 3]);
    let inertia = fem::assemble_mass(mesh, material, &all)?.multiply(motion.as_ref())?;
    Ok(Mat::from_fn(dofs.free_count(), 6, |row, j| {
        dofs.node_and_axis(row).map_or(0.0, |(node, axis)| inertia[(3 * node as usize + axis, j)])
    }))
}

/// Phi' M R, row by row.
fn products(of_motion: &Mat<f64>, shapes: MatRef<'_, f64>) -> Vec<[f64; 6]> {
    let all = fem::dense::product(shapes.transpose(), of_motion.as_ref());
    (0..all.nrows()).map(|j| std::array::from_fn(|k| all[(j, k)])).collect()
}

/// Sum over the ring of what sectors give in their own frames, in the gear's frame.
fn around(teeth: u32, way: f64, (phase, re, im): (f64, [f64; 6], [f64; 6])) -> [f64; 6] {
    let mut sum = [0.0; 6];
    for k in 0..teeth {
        let (sin, cos) = (phase * f64::from(k)).sin_cos();
        let own: [f64; 6] = std::array::from_fn(|i| cos * re[i] - sin * im[i]);
        let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), way * (TAU * f64::from(k) / f64::from(teeth)));
        for at in [0, 3] {
            let turned = turn * Vector3::new(own[at], own[at + 1], own[at + 2]);
            (0..3).for_each(|i| sum[at + i] += turned[i]);
        }
    }
    sum
}

impl GearModes {
    pub(super) fn shapes(&self) -> &Shapes {
        &self.shapes
    }

    pub(super) fn spin(&self) -> Option<&Spin> {
        self.spin.as_ref()
    }

    /// Number of modes m.
    pub fn count(&self) -> usize {
        self.squares.len()
    }

    /// omega^2, (rad/s)^2, ascending.
    pub fn squares(&self) -> &[f64] {
        &self.squares
    }

    /// Frequencies, Hz, ascending.
    pub fn frequencies_hz(&self) -> Vec<f64> {
        self.squares.iter().map(|s| s.sqrt() / TAU).collect()
    }

    /// Number of waves around the axis of each mode (nodal diameters); `None` for a gear that is not condensed by
    /// sectors.
    pub fn waves(&self) -> Option<&[u32]> {
        self.waves.as_deref()
    }

    /// psi of a mode, rad: what neighbouring sectors differ by.
    pub(super) fn phase(&self, mode: usize) -> Option<f64> {
        match &self.shapes {
            Shapes::Sector { phases, .. } => phases.get(mode).copied(),
            Shapes::Whole(_) => None,
        }
    }

    /// Phi' M R: inertia that each mode shares with rigid motion of the gear about its centre, along x, y, z (t^(1/2))
    /// and about x, y, z (t^(1/2) mm) of the gear's own frame.
    ///
    /// In a cyclic gear, modes without waves couple with translation along z and rotation about z, modes with one wave
    /// with x, y and the tilts. All other modes have no coupling.
    pub fn coupling(&self) -> &[[f64; 6]] {
        &self.coupling
    }

    /// Phi_B: the modes in the coordinates of a window, in the window's frame, 3 n_B x m, t^(-1/2).
    ///
    /// `reducer` is the one from which the modes come, or another one of the same gear, reduced by the same method to
    /// other flanks.
    ///
    /// # Errors
    /// [`ReductionError::OtherGear`] if it is neither.
    pub fn on_window(&self, reducer: &GearReducer, window: &Window) -> Result<Mat<f64>, ReductionError> {
        let loads = reducer.loads(window)?;
        let mut shapes = Mat::zeros(3 * loads.len(), self.count());
        for (i, load) in loads.iter().enumerate() {
            for &(node, weight) in load {
                for (j, u) in self.at(reducer, window, node)?.into_iter().enumerate() {
                    (0..3).for_each(|axis| shapes[(3 * i + axis, j)] += weight * u[axis]);
                }
            }
        }
        Ok(shapes)
    }

    /// Displacement (t^(-1/2)) of every node of the reducer's mesh in one mode, in the gear's own frame.
    ///
    /// # Errors
    /// [`ReductionError::OtherGear`]; [`ReductionError::WrongLength`] for a mode that does not exist.
    pub fn field(&self, reducer: &GearReducer, mode: usize) -> Result<Vec<[f64; 3]>, ReductionError> {
        if mode >= self.count() {
            return Err(ReductionError::WrongLength { given: mode, wanted: self.count() });
        }
        let window = Window { reduced: reducer.base.clone(), shift: 0 };
        let nodes = 0..reducer.gear().mesh().nodes.len() as u32;
        nodes.map(|n| Ok(self.at(reducer, &window, n)?[mode].into())).collect()
    }

    /// All modes at the place that `node` of a window's frame stands for, in that frame.
    fn at(&self, reducer: &GearReducer, window: &Window, node: u32) -> Result<Vec<Vector3<f64>>, ReductionError> {
        match (&self.shapes, reducer.method()?) {
            (Shapes::Sector { dofs, phases, parts }, Method::Cyclic(cyclic)) => {
                let place = cyclic.place(node).ok_or(ReductionError::OtherGear)?;
                let turn = reducer.gear().pitches_on(place.copy);
                let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), turn);
                let Some(position) = dofs.position(place.node) else { return Ok(vec![Vector3::zeros(); self.count()]) };
                let own = |(j, phase): (usize, &f64)| {
                    let (sin, cos) = (phase * f64::from(place.copy + window.shift)).sin_cos();
                    let u = |axis| cos * parts[0][(3 * position + axis, j)] - sin * parts[1][(3 * position + axis, j)];
                    turn * Vector3::new(u(0), u(1), u(2))
                };
                Ok(phases.iter().enumerate().map(own).collect())
            }
            (Shapes::Whole(shapes), Method::General(..)) if shapes.nrows() == reducer.dofs().free_count() => {
                let node = reducer.material_node(window, node);
                let back = Rotation3::from_axis_angle(&Vector3::z_axis(), -reducer.frame_angle(window));
                let Some(position) = reducer.dofs().position(node) else {
                    return Ok(vec![Vector3::zeros(); self.count()]);
                };
                let u = |j: usize| Vector3::from_fn(|axis, _| shapes[(3 * position + axis, j)]);
                Ok((0..self.count()).map(|j| back * u(j)).collect())
            }
            _ => Err(ReductionError::OtherGear),
        }
    }
}
