//! One factorisation a gear, any window of it.

use std::{
    collections::BTreeMap,
    f64::consts::PI,
    sync::{Arc, Mutex, PoisonError},
};

use faer::{Mat, Side as Triangle, linalg::solvers::DenseSolveCore};
use fem::{BoundaryLastFactor, DofMap, ElementOptions, Material, SymmetricMatrix};
use geometry::{Gear, Side};
use mesh::GearMesh;
use nalgebra::{Rotation3, Vector3};

use crate::{HalfTooth, ReducedGear, ReductionError, Window, pitch_permutation};

/// What to keep.
#[derive(Debug, Clone)]
pub struct ReductionOptions {
    /// Sides of the teeth whose flank nodes are kept.
    pub sides: Vec<Side>,
    /// Number of teeth W of a window.
    pub window: usize,
    /// First tooth of the window that is reduced with the factorisation.
    pub first: u32,
    /// Element variants.
    pub elements: ElementOptions,
}

/// A gear that can be reduced to any window of its teeth.
///
/// The factor of K has the boundary of the first window last, so that window's matrices are read off it. A gear that is
/// cyclic to round-off has the same matrices for all windows, in frames turned by whole pitches; for any other gear
/// the next windows come from solves with the same factor, for the columns of the teeth they hold.
#[derive(Debug)]
pub struct GearReducer {
    gear: GearMesh,
    material: Material,
    options: ReductionOptions,
    dofs: DofMap,
    stiffness: SymmetricMatrix,
    factor: BoundaryLastFactor,
    /// Where a turn by one pitch takes each node; `None` for a gear that is not cyclic.
    turn: Option<Vec<u32>>,
    base: Arc<ReducedGear>,
    others: Mutex<BTreeMap<u32, Arc<ReducedGear>>>,
    halves: Mutex<BTreeMap<(u32, Side), Arc<HalfTooth>>>,
}

/// How far a node may be from the place of its image for a gear to count as cyclic, relative to its size.
pub(crate) const CYCLIC_TOLERANCE: f64 = 1e-9;

impl GearReducer {
    /// Assembles, factors and reduces the first window.
    ///
    /// # Errors
    /// [`ReductionError`] when a flank is missing or the matrices are not what they must be.
    pub fn new(gear: GearMesh, material: Material, options: ReductionOptions) -> Result<Self, ReductionError> {
        let mesh = gear.mesh();
        let dofs = DofMap::new(mesh.nodes.len(), gear.bore_nodes());
        let stiffness = fem::assemble_stiffness(mesh, &material, &dofs, &options.elements)?;
        let teeth = window_teeth(&gear, options.first, options.window);
        let nodes = boundary_nodes(&gear, &teeth, &options.sides)?;
        let factor = BoundaryLastFactor::new(&stiffness, &node_dofs(&dofs, &nodes))?;
        let base = Arc::new(ReducedGear {
            teeth,
            sides: options.sides.clone(),
            nodes,
            stiffness: factor.condensed_stiffness(),
            compliance: factor.compliance(),
        });
        let size = mesh.nodes.iter().flatten().fold(0.0f64, |m, x| m.max(x.abs()));
        let pitch = 2.0 * PI / f64::from(gear.tooth_count());
        let turn = if gear.is_whole_gear() { pitch_permutation(mesh, pitch, CYCLIC_TOLERANCE * size) } else { None };
        Ok(Self {
            gear,
            material,
            options,
            dofs,
            stiffness,
            factor,
            turn,
            base,
            others: Mutex::default(),
            halves: Mutex::default(),
        })
    }

    /// The meshed gear.
    pub fn gear(&self) -> &GearMesh {
        &self.gear
    }

    /// Its material.
    pub fn material(&self) -> &Material {
        &self.material
    }

    /// Element variants used.
    pub fn elements(&self) -> &ElementOptions {
        &self.options.elements
    }

    /// Free degrees of freedom of the whole mesh.
    pub fn dofs(&self) -> &DofMap {
        &self.dofs
    }

    /// Stiffness of the whole mesh, bore held, N/mm.
    pub fn stiffness(&self) -> &SymmetricMatrix {
        &self.stiffness
    }

    /// The factorisation.
    pub fn factor(&self) -> &BoundaryLastFactor {
        &self.factor
    }

    /// Matrices of the window that was reduced with the factorisation.
    pub(crate) fn first_window(&self) -> &Arc<ReducedGear> {
        &self.base
    }

    /// Windows reduced so far, the first one first.
    pub(crate) fn reduced_windows(&self) -> Vec<Arc<ReducedGear>> {
        let others = self.others.lock().unwrap_or_else(PoisonError::into_inner);
        std::iter::once(&self.base).chain(others.values()).cloned().collect()
    }

    /// Half teeth condensed so far.
    pub(crate) fn condensed_halves(&self) -> Vec<((u32, Side), Arc<HalfTooth>)> {
        let halves = self.halves.lock().unwrap_or_else(PoisonError::into_inner);
        halves.iter().map(|(&flank, half)| (flank, half.clone())).collect()
    }

    /// Whether the mesh is the same after a turn by one pitch.
    pub fn is_cyclic(&self) -> bool {
        self.turn.is_some()
    }

    /// Angle of a window's frame in the gear's own frame, rad.
    pub fn frame_angle(&self, window: &Window) -> f64 {
        2.0 * PI * f64::from(window.shift) / f64::from(self.gear.tooth_count())
    }

    /// The window whose first tooth is `first`.
    ///
    /// # Errors
    /// [`ReductionError::MissingFlank`] when the mesh ends before the window does.
    pub fn window(&self, first: u32) -> Result<Window, ReductionError> {
        let z = self.gear.tooth_count();
        let first = first % z;
        if first == self.options.first % z {
            return Ok(Window { reduced: self.base.clone(), shift: 0 });
        }
        if self.is_cyclic() {
            return Ok(Window { reduced: self.base.clone(), shift: (first + z - self.options.first % z) % z });
        }
        let mut others = self.others.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(reduced) = others.get(&first) {
            return Ok(Window { reduced: reduced.clone(), shift: 0 });
        }
        let reduced = Arc::new(self.reduce_by_solves(first)?);
        others.insert(first, reduced.clone());
        Ok(Window { reduced, shift: 0 })
    }

    /// Half of a tooth of the mesh behind one flank, condensed when first asked for. `geometry` is the gear that was meshed.
    ///
    /// # Errors
    /// [`ReductionError::MissingFlank`], [`ReductionError::Fem`].
    pub fn half_tooth(&self, geometry: &Gear, tooth: u32, side: Side) -> Result<Arc<HalfTooth>, ReductionError> {
        let mut halves = self.halves.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(half) = halves.get(&(tooth, side)) {
            return Ok(half.clone());
        }
        let half = HalfTooth::new(&self.gear, geometry, &self.material, &self.options.elements, tooth, side)?;
        let half = Arc::new(half);
        halves.insert((tooth, side), half.clone());
        Ok(half)
    }

    /// C = R K^-1 R' by solves with the factor, and K^ as its inverse.
    fn reduce_by_solves(&self, first: u32) -> Result<ReducedGear, ReductionError> {
        let teeth = window_teeth(&self.gear, first, self.options.window);
        let nodes = boundary_nodes(&self.gear, &teeth, &self.options.sides)?;
        let dofs = node_dofs(&self.dofs, &nodes);
        let n = dofs.len();
        let mut compliance = Mat::<f64>::zeros(n, n);
        // Blocks keep the full-length columns in check: 256 columns of 10^5 freedoms are 200 MB.
        for start in (0..n).step_by(256) {
            let width = (n - start).min(256);
            let mut columns = Mat::<f64>::zeros(self.dofs.free_count(), width);
            for j in 0..width {
                columns[(dofs[start + j], j)] = 1.0;
            }
            self.factor.solve(columns.as_mut())?;
            for j in 0..width {
                for (i, &dof) in dofs.iter().enumerate() {
                    compliance[(i, start + j)] = columns[(dof, j)];
                }
            }
        }
        let symmetric = Mat::from_fn(n, n, |i, j| 0.5 * (compliance[(i, j)] + compliance[(j, i)]));
        let stiffness =
            symmetric.llt(Triangle::Lower).map_err(|_| ReductionError::NotPositiveDefinite { first })?.inverse();
        Ok(ReducedGear { teeth, sides: self.options.sides.clone(), nodes, stiffness, compliance: symmetric })
    }

    /// The mesh's own nodes under a window's boundary nodes: turned on by its shift.
    pub fn material_nodes(&self, window: &Window) -> Vec<u32> {
        window.reduced.nodes.iter().map(|&n| self.material_node(window, n)).collect()
    }

    /// The mesh's own node at the place of `node` of the window's frame: turned on by the window's shift.
    pub fn material_node(&self, window: &Window, node: u32) -> u32 {
        match &self.turn {
            Some(turn) => (0..window.shift).fold(node, |n, _| turn.get(n as usize).copied().unwrap_or(n)),
            None => node,
        }
    }

    /// Displacement (mm) of every node in the gear's own frame when the window's coordinates are `u` and all else is free
    /// of load: T u = [u_B; Phi_IC u_B].
    ///
    /// # Errors
    /// [`ReductionError::WrongLength`].
    pub fn expand(&self, window: &Window, u: &[f64]) -> Result<Vec<[f64; 3]>, ReductionError> {
        let wanted = window.reduced.coordinates();
        if u.len() != wanted {
            return Err(ReductionError::WrongLength { given: u.len(), wanted });
        }
        let free = if Arc::ptr_eq(&window.reduced, &self.base) {
            self.factor.expand(Mat::from_fn(wanted, 1, |i, _| u[i]).as_ref())?
        } else {
            // The boundary of another window is interior to the factor: the loads that hold it there, then K^-1.
            let mut load = Mat::<f64>::zeros(self.dofs.free_count(), 1);
            let dofs = node_dofs(&self.dofs, &window.reduced.nodes);
            for (i, &dof) in dofs.iter().enumerate() {
                let row = window.reduced.stiffness.row(i);
                load[(dof, 0)] = u.iter().zip(row.iter()).map(|(a, b)| a * b).sum();
            }
            self.factor.solve(load.as_mut())?;
            load
        };
        let field = self.dofs.to_nodes(&(0..free.nrows()).map(|i| free[(i, 0)]).collect::<Vec<_>>())?;
        let Some(turn) = self.turn.as_ref().filter(|_| window.shift != 0) else {
            return Ok(field);
        };
        let forward = Rotation3::from_axis_angle(&Vector3::z_axis(), self.frame_angle(window));
        let mut image: Vec<u32> = (0..field.len() as u32).collect();
        for _ in 0..window.shift {
            image.iter_mut().for_each(|n| *n = turn[*n as usize]);
        }
        let mut turned = vec![[0.0; 3]; field.len()];
        for (&to, u) in image.iter().zip(&field) {
            turned[to as usize] = (forward * Vector3::from(*u)).into();
        }
        Ok(turned)
    }

    /// Columns `columns` of T = [I; Phi_IC] of the first window, one row a free degree of freedom.
    ///
    /// # Errors
    /// [`ReductionError::Fem`] when a column does not exist.
    pub fn constraint_modes(&self, columns: &[usize]) -> Result<Mat<f64>, ReductionError> {
        let n = self.base.coordinates();
        if let Some(&given) = columns.iter().find(|&&c| c >= n) {
            return Err(ReductionError::WrongLength { given, wanted: n });
        }
        let unit = Mat::from_fn(n, columns.len(), |i, j| f64::from(u8::from(i == columns[j])));
        Ok(self.factor.expand(unit.as_ref())?)
    }

    /// M^ = T' M T of the first window, t; the same for every window of a cyclic gear.
    ///
    /// Column block by column block: T c by back-substitution, M times that, T' by forward substitution. Phi_IC is never
    /// held as a whole.
    ///
    /// # Errors
    /// [`ReductionError::Fem`].
    pub fn condensed_mass(&self) -> Result<Mat<f64>, ReductionError> {
        let mass = fem::assemble_mass(self.gear.mesh(), &self.material, &self.dofs)?;
        let n = self.base.coordinates();
        let mut condensed = Mat::<f64>::zeros(n, n);
        for start in (0..n).step_by(128) {
            let columns: Vec<usize> = (start..(start + 128).min(n)).collect();
            let modes = self.constraint_modes(&columns)?;
            let block = self.factor.condense(mass.multiply(modes.as_ref())?.as_ref())?;
            condensed.as_mut().subcols_mut(start, columns.len()).copy_from(&block);
        }
        Ok(Mat::from_fn(n, n, |i, j| 0.5 * (condensed[(i, j)] + condensed[(j, i)])))
    }
}

/// Teeth first, first + 1, ... counter-clockwise.
pub(crate) fn window_teeth(gear: &GearMesh, first: u32, count: usize) -> Vec<u32> {
    (0..count as u32).map(|i| (first + i) % gear.tooth_count()).collect()
}

/// Nodes of the flanks, ascending, each once.
fn boundary_nodes(gear: &GearMesh, teeth: &[u32], sides: &[Side]) -> Result<Vec<u32>, ReductionError> {
    let mut nodes = Vec::new();
    for &tooth in teeth {
        for &side in sides {
            let faces = gear.flank(tooth, side).ok_or_else(|| ReductionError::MissingFlank {
                tooth,
                side,
                available: gear.teeth(),
            })?;
            for &node in faces.iter().flat_map(|f| f.nodes()) {
                if gear.bore_nodes().binary_search(&node).is_ok() {
                    let node = gear.mesh().node_tags[node as usize];
                    return Err(ReductionError::BoreOnFlank { node, tooth, side });
                }
                nodes.push(node);
            }
        }
    }
    nodes.sort_unstable();
    nodes.dedup();
    Ok(nodes)
}

/// Matrix rows of the nodes' free freedoms, x, y, z of each node in turn.
pub(crate) fn node_dofs(dofs: &DofMap, nodes: &[u32]) -> Vec<usize> {
    nodes.iter().flat_map(|&n| (0..3).filter_map(move |axis| dofs.dof(n, axis))).collect()
}
