//! A gear known by its answer to loads on a coarse grid over its flanks, however fine the mesh.

use std::{
    collections::BTreeMap,
    f64::consts::PI,
    sync::{Arc, Mutex, PoisonError},
};

use faer::Mat;
use fem::{BoundaryLastFactor, DofMap, Material};
use geometry::{Gear, Side};
use mesh::{Face, GearMesh};

use crate::{
    HalfTooth, ReducedGear, ReductionError, ReductionOptions, Window, pitch_permutation,
    reducer::{CYCLIC_TOLERANCE, window_teeth},
};

/// A coarse mesh of faces over one flank; loads on its nodes act on the nodes of the fine mesh about them.
///
/// W - W_c of slice contact is smooth over half a tooth thickness, so a grid as coarse as that holds it, and the size of the reduced
/// gear does not grow with the mesh. Positions and loads are in the gear's own frame.
#[derive(Debug, Clone, PartialEq)]
pub struct FlankGrid {
    /// Faces; node numbers count the grid's nodes from 0.
    pub faces: Vec<Face>,
    /// Grid nodes, mm.
    pub positions: Vec<[f64; 3]>,
    /// Nodes of the mesh that carry a unit load on each grid node, and their shares.
    pub loads: Vec<Vec<(u32, f64)>>,
}

/// A gear reduced to grids over its flanks: coordinates are three displacements a grid node, means of the mesh's displacements with
/// the weights of the loads.
#[derive(Debug)]
pub struct GridReducer {
    gear: GearMesh,
    material: Material,
    options: ReductionOptions,
    dofs: DofMap,
    factor: BoundaryLastFactor,
    cyclic: bool,
    grids: BTreeMap<(u32, Side), FlankGrid>,
    windows: Mutex<BTreeMap<u32, Arc<ReducedGear>>>,
    halves: Mutex<BTreeMap<(u32, Side), Arc<HalfTooth>>>,
}

/// Full-length columns that go through the factor together: 256 of 10^5 freedoms are 200 MB.
const COLUMNS: usize = 256;

impl GridReducer {
    /// Assembles and factors; windows are reduced when first asked for. `grids` holds every flank that a window may hold.
    ///
    /// # Errors
    /// [`ReductionError::Fem`].
    pub fn new(
        gear: GearMesh,
        material: Material,
        options: ReductionOptions,
        grids: BTreeMap<(u32, Side), FlankGrid>,
    ) -> Result<Self, ReductionError> {
        let mesh = gear.mesh();
        let dofs = DofMap::new(mesh.nodes.len(), gear.bore_nodes());
        let factor = {
            let stiffness = fem::assemble_stiffness(mesh, &material, &dofs, &options.elements)?;
            BoundaryLastFactor::new(&stiffness, &[])?
        };
        let size = mesh.nodes.iter().flatten().fold(0.0f64, |m, x| m.max(x.abs()));
        let pitch = 2.0 * PI / f64::from(gear.tooth_count());
        let cyclic = gear.is_whole_gear() && pitch_permutation(mesh, pitch, CYCLIC_TOLERANCE * size).is_some();
        let (windows, halves) = Default::default();
        Ok(Self { gear, material, options, dofs, factor, cyclic, grids, windows, halves })
    }

    /// The meshed gear.
    pub fn gear(&self) -> &GearMesh {
        &self.gear
    }

    /// Its material.
    pub fn material(&self) -> &Material {
        &self.material
    }

    /// Free degrees of freedom of the whole mesh.
    pub fn dofs(&self) -> &DofMap {
        &self.dofs
    }

    /// Whether all windows are alike.
    pub fn is_cyclic(&self) -> bool {
        self.cyclic
    }

    /// The grid of a flank.
    pub fn grid(&self, tooth: u32, side: Side) -> Option<&FlankGrid> {
        self.grids.get(&(tooth, side))
    }

    /// Number that the first node of a flank's grid has in a window's coordinates.
    pub fn first_node(&self, window: &Window, tooth: u32, side: Side) -> Option<usize> {
        let mut at = 0;
        for &t in &window.reduced.teeth {
            for &s in &window.reduced.sides {
                if (t, s) == (tooth, side) {
                    return Some(at);
                }
                at += self.grids.get(&(t, s))?.positions.len();
            }
        }
        None
    }

    /// The window whose first tooth is `first`.
    ///
    /// # Errors
    /// [`ReductionError::MissingFlank`] when there is no grid for one of its flanks.
    pub fn window(&self, first: u32) -> Result<Window, ReductionError> {
        let z = self.gear.tooth_count();
        let (first, base) = (first % z, self.options.first % z);
        let (first, shift) = if self.cyclic { (base, (first + z - base) % z) } else { (first, 0) };
        let mut windows = self.windows.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(reduced) = windows.get(&first) {
            return Ok(Window { reduced: reduced.clone(), shift });
        }
        let reduced = Arc::new(self.reduce(first)?);
        windows.insert(first, reduced.clone());
        Ok(Window { reduced, shift })
    }

    fn reduce(&self, first: u32) -> Result<ReducedGear, ReductionError> {
        let teeth = window_teeth(&self.gear, first, self.options.window);
        let mut grids = Vec::new();
        for &tooth in &teeth {
            for &side in &self.options.sides {
                let missing = || ReductionError::MissingFlank { tooth, side, available: self.gear.teeth() };
                grids.push(self.grids.get(&(tooth, side)).ok_or_else(missing)?);
            }
        }
        let compliance = grid_compliance(&self.factor, self.dofs.free_count(), &grids, |n| self.dofs.position(n))?;
        let nodes = (0..compliance.nrows() as u32 / 3).collect();
        Ok(ReducedGear { teeth, sides: self.options.sides.clone(), nodes, stiffness: Mat::new(), compliance })
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
        let missing = || ReductionError::MissingFlank { tooth, side, available: self.gear.teeth() };
        let grid = self.grid(tooth, side).ok_or_else(missing)?;
        let elements = &self.options.elements;
        let half = HalfTooth::on_grid(&self.gear, geometry, &self.material, elements, (tooth, side), grid)?;
        let half = Arc::new(half);
        halves.insert((tooth, side), half.clone());
        Ok(half)
    }
}

/// P K^-1 P' for the loads P of some grids, three directions a grid node, mm/N; `position` places a mesh node among the free ones.
pub(crate) fn grid_compliance(
    factor: &BoundaryLastFactor,
    free: usize,
    grids: &[&FlankGrid],
    position: impl Fn(u32) -> Option<usize>,
) -> Result<Mat<f64>, ReductionError> {
    let loads: Vec<Vec<(usize, f64)>> = grids
        .iter()
        .flat_map(|g| &g.loads)
        .flat_map(|load| {
            let placed: Vec<(usize, f64)> = load.iter().filter_map(|&(n, w)| Some((3 * position(n)?, w))).collect();
            [0, 1, 2].map(|axis| placed.iter().map(|&(at, w)| (at + axis, w)).collect())
        })
        .collect();
    let n = loads.len();
    let mut compliance = Mat::<f64>::zeros(n, n);
    for start in (0..n).step_by(COLUMNS) {
        let width = (n - start).min(COLUMNS);
        let mut columns = Mat::<f64>::zeros(free, width);
        for (j, load) in loads[start..start + width].iter().enumerate() {
            load.iter().for_each(|&(dof, w)| columns[(dof, j)] = w);
        }
        factor.solve(columns.as_mut())?;
        for j in 0..width {
            for (i, load) in loads.iter().enumerate() {
                compliance[(i, start + j)] = load.iter().map(|&(dof, w)| w * columns[(dof, j)]).sum();
            }
        }
    }
    Ok(Mat::from_fn(n, n, |i, j| 0.5 * (compliance[(i, j)] + compliance[(j, i)])))
}
