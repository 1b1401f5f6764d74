//! One condensation a gear, any window of it.

use std::{
    collections::BTreeMap,
    f64::consts::TAU,
    sync::{Arc, Mutex, PoisonError},
};

use faer::{Mat, MatRef};
use fem::{DofMap, ElementOptions, Material};
use geometry::{Gear, Side};
use mesh::{Face, GearMesh};
use nalgebra::{Rotation3, Vector3};

use crate::{
    FlankGrid, FlankGrids, HalfTooth, ReducedGear, ReductionError, Window,
    cyclic::{CyclicGear, PitchTurn, SectorMesh},
    general::{GeneralGear, Seen},
    load::{Coordinates, Load, missing},
};

/// What to keep.
#[derive(Debug, Clone)]
pub struct ReductionOptions {
    /// Sides of the teeth whose flanks are kept.
    pub sides: Vec<Side>,
    /// Number of teeth W of a window.
    pub window: usize,
    /// First tooth of the window that is reduced at once.
    pub first: u32,
    /// Element variants.
    pub elements: ElementOptions,
}

/// Which way a gear was condensed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ReductionWay {
    /// One sector, joined with itself.
    CyclicSector,
    /// The whole gear in one factor.
    General,
}

impl ReductionWay {
    /// In words, for tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::CyclicSector => "cyclic sector",
            Self::General => "general",
        }
    }
}

/// A gear that can be reduced to any window of its teeth.
///
/// Coordinates are the flank nodes of the window's teeth, or means of their displacements with the weights of loads on coarse grids
/// ([`FlankGrid`]). They are known from one sector where the gear is cyclic to round-off, else from one factor of the whole gear
/// ([`ReductionWay`]); the matrices are the same to 1e-9. A cyclic gear has the same matrices for all windows, in frames turned by whole pitches;
/// for any other gear further windows come from solves with the same factor, for the columns of the teeth they hold.
///
/// A periodic sector of one tooth is never unrolled to the whole gear: [`GearReducer::gear`] then is the sectors of the first
/// window and one more on either side, in the frame of the matrices.
#[derive(Debug)]
pub struct GearReducer {
    gear: GearMesh,
    material: Material,
    options: ReductionOptions,
    dofs: DofMap,
    coordinates: Coordinates,
    method: Method,
    base: Arc<ReducedGear>,
    others: Mutex<BTreeMap<u32, Arc<ReducedGear>>>,
    halves: Mutex<BTreeMap<(u32, Side), Arc<HalfTooth>>>,
}

#[derive(Debug)]
enum Method {
    Cyclic(Box<CyclicGear>),
    /// With the turn by one pitch of a whole gear that is cyclic all the same.
    General(Box<GeneralGear>, Option<PitchTurn>),
}

impl GearReducer {
    /// Condenses a gear to its flank nodes and reduces the first window.
    ///
    /// A periodic sector, and a whole gear that a turn by one pitch leaves the same to round-off, go the cyclic way.
    ///
    /// # Errors
    /// [`ReductionError`] when a flank is missing or the matrices are not what they must be.
    pub fn new(gear: GearMesh, material: Material, options: ReductionOptions) -> Result<Self, ReductionError> {
        Self::build(gear, material, options, false, |_| Ok(Coordinates::FlankNodes))
    }

    /// The same by one factor of the whole gear, whatever the gear is.
    ///
    /// # Errors
    /// As [`GearReducer::new`].
    pub fn general(gear: GearMesh, material: Material, options: ReductionOptions) -> Result<Self, ReductionError> {
        Self::build(gear, material, options, true, |_| Ok(Coordinates::FlankNodes))
    }

    /// Condenses a gear to grids over its flanks; `grids` makes those of every flank that a window may hold, on the mesh that
    /// [`GearReducer::gear`] will show. `general`: by one factor of the whole gear, whatever the gear is.
    ///
    /// # Errors
    /// [`ReductionError`] as for [`GearReducer::new`]; those of `grids`.
    pub fn on_grids<E: From<ReductionError>>(
        gear: GearMesh,
        material: Material,
        options: ReductionOptions,
        general: bool,
        grids: impl Fn(&GearMesh) -> Result<FlankGrids, E>,
    ) -> Result<Self, E> {
        Self::build(gear, material, options, general, |gear| Ok(Coordinates::Grids(grids(gear)?)))
    }

    fn build<E: From<ReductionError>>(
        gear: GearMesh,
        material: Material,
        options: ReductionOptions,
        general: bool,
        coordinates: impl Fn(&GearMesh) -> Result<Coordinates, E>,
    ) -> Result<Self, E> {
        let mut turn = PitchTurn::of_gear(&gear);
        let sectors = if general { None } else { sectors(&gear, turn.as_ref(), &options)? };
        if let Some((part, copies)) = sectors {
            let seen = copies.as_ref().unwrap_or(&gear);
            let coordinates = coordinates(seen)?;
            let first = First::new(seen, &coordinates, &options)?;
            let cyclic = CyclicGear::new(part, &material, &options.elements, &first.loads, coordinates.are_nodes())?;
            if let Some(cyclic) = cyclic {
                let compliance = cyclic.compliance();
                let method = Method::Cyclic(Box::new(cyclic));
                let gear = copies.unwrap_or(gear);
                return Ok(Self::assembled(gear, material, options, coordinates, method, (first, compliance)));
            }
        }
        let gear = if gear.is_periodic_sector() {
            let whole = gear.whole().map_err(ReductionError::from)?;
            turn = PitchTurn::of_gear(&whole);
            whole
        } else {
            gear
        };
        let coordinates = coordinates(&gear)?;
        let first = First::new(&gear, &coordinates, &options)?;
        let (last, seen) =
            if coordinates.are_nodes() { (&first.nodes[..], Seen::Last) } else { (&[][..], Seen::Loads(&first.loads)) };
        let factor = GeneralGear::new(gear.mesh(), gear.bore_nodes(), &material, &options.elements, last)?;
        let compliance = factor.compliance(seen)?;
        let method = Method::General(Box::new(factor), turn);
        Ok(Self::assembled(gear, material, options, coordinates, method, (first, compliance)))
    }

    fn assembled(
        gear: GearMesh,
        material: Material,
        options: ReductionOptions,
        coordinates: Coordinates,
        method: Method,
        (first, compliance): (First, Mat<f64>),
    ) -> Self {
        let dofs = DofMap::new(gear.mesh().nodes.len(), gear.bore_nodes());
        let base = Arc::new(ReducedGear::new(first.teeth, options.sides.clone(), first.nodes, compliance));
        let (others, halves) = Default::default();
        Self { gear, material, options, dofs, coordinates, method, base, others, halves }
    }

    /// The mesh: the whole gear as it was given, or the sectors about the first window.
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

    /// Free degrees of freedom of the mesh.
    pub fn dofs(&self) -> &DofMap {
        &self.dofs
    }

    /// Number of free degrees of freedom of the gear, all its sectors counted.
    pub fn free_count(&self) -> usize {
        match &self.method {
            Method::Cyclic(cyclic) => cyclic.free_count(),
            Method::General(..) => self.dofs.free_count(),
        }
    }

    /// Which way the gear was condensed.
    pub fn way(&self) -> ReductionWay {
        match &self.method {
            Method::Cyclic(_) => ReductionWay::CyclicSector,
            Method::General(..) => ReductionWay::General,
        }
    }

    /// Whether all windows are alike: the gear is the same after a turn by one pitch.
    pub fn is_cyclic(&self) -> bool {
        matches!(self.method, Method::Cyclic(_) | Method::General(_, Some(_)))
    }

    /// The grid of a flank; `None` for a gear reduced to its flank nodes.
    pub fn grid(&self, tooth: u32, side: Side) -> Option<&FlankGrid> {
        match &self.coordinates {
            Coordinates::FlankNodes => None,
            Coordinates::Grids(grids) => grids.get(&(tooth, side)),
        }
    }

    /// Positions (mm) and faces that carry the load of a flank: the mesh's own, or those of the grid over it.
    pub fn flank(&self, tooth: u32, side: Side) -> Option<(&[[f64; 3]], &[Face])> {
        match &self.coordinates {
            Coordinates::FlankNodes => Some((&self.gear.mesh().nodes, self.gear.flank(tooth, side)?)),
            Coordinates::Grids(grids) => grids.get(&(tooth, side)).map(|g| (&g.positions[..], &g.faces[..])),
        }
    }

    /// Place among a window's boundary nodes of a node of [`GearReducer::flank`].
    pub fn boundary_position(&self, window: &Window, (tooth, side): (u32, Side), node: u32) -> Option<usize> {
        let Coordinates::Grids(grids) = &self.coordinates else { return window.reduced.position(node) };
        let mut at = 0;
        for &t in &window.reduced.teeth {
            for &s in &window.reduced.sides {
                let grid = grids.get(&(t, s))?;
                if (t, s) == (tooth, side) {
                    return ((node as usize) < grid.positions.len()).then_some(at + node as usize);
                }
                at += grid.positions.len();
            }
        }
        None
    }

    /// Angle of a window's frame in the gear's own frame, rad.
    pub fn frame_angle(&self, window: &Window) -> f64 {
        TAU * f64::from(window.shift) / f64::from(self.gear.tooth_count())
    }

    /// The window whose first tooth is `first`.
    ///
    /// # Errors
    /// [`ReductionError::MissingFlank`] when the mesh ends before the window does.
    pub fn window(&self, first: u32) -> Result<Window, ReductionError> {
        let z = self.gear.tooth_count();
        let (first, base) = (first % z, self.options.first % z);
        if first == base || self.is_cyclic() {
            return Ok(Window { reduced: self.base.clone(), shift: (first + z - base) % z });
        }
        let mut others = self.others.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(reduced) = others.get(&first) {
            return Ok(Window { reduced: reduced.clone(), shift: 0 });
        }
        let Method::General(general, _) = &self.method else {
            return Ok(Window { reduced: self.base.clone(), shift: 0 });
        };
        let options = ReductionOptions { first, ..self.options.clone() };
        let other = First::new(&self.gear, &self.coordinates, &options)?;
        let compliance = general.compliance(Seen::Loads(&other.loads))?;
        let reduced = Arc::new(ReducedGear::new(other.teeth, options.sides, other.nodes, compliance));
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
        let (elements, flank) = (&self.options.elements, (tooth, side));
        let half = match &self.coordinates {
            Coordinates::FlankNodes => HalfTooth::new(&self.gear, geometry, &self.material, elements, tooth, side)?,
            Coordinates::Grids(grids) => {
                let grid = grids.get(&flank).ok_or_else(|| missing(&self.gear, flank))?;
                HalfTooth::on_grid(&self.gear, geometry, &self.material, elements, flank, grid)?
            }
        };
        let half = Arc::new(half);
        halves.insert(flank, half.clone());
        Ok(half)
    }

    /// The mesh's own nodes under a window's boundary nodes: turned on by its shift.
    pub fn material_nodes(&self, window: &Window) -> Vec<u32> {
        window.reduced.nodes.iter().map(|&n| self.material_node(window, n)).collect()
    }

    /// The mesh's own node at the place of `node` of the window's frame: turned on by the window's shift.
    ///
    /// `node` itself where the mesh does not have that place, being some sectors only.
    pub fn material_node(&self, window: &Window, node: u32) -> u32 {
        match &self.method {
            Method::Cyclic(cyclic) => cyclic.turned_node(node, window.shift).unwrap_or(node),
            Method::General(_, Some(turn)) => {
                (0..window.shift).fold(node, |n, _| turn.nodes.get(n as usize).copied().unwrap_or(n))
            }
            Method::General(_, None) => node,
        }
    }

    /// Displacement (mm) of every node of the mesh in the gear's own frame when the window's coordinates are `u` and all else is free
    /// of load: T u = [u_B; Phi_IC u_B].
    ///
    /// # Errors
    /// [`ReductionError::WrongLength`]; [`ReductionError::NotPositiveDefinite`] where forces do not follow from coordinates: a grid with
    /// more nodes than the mesh can tell apart.
    pub fn expand(&self, window: &Window, u: &[f64]) -> Result<Vec<[f64; 3]>, ReductionError> {
        match &self.method {
            Method::Cyclic(cyclic) => cyclic.expand(&self.forces(window, u)?, window.shift),
            Method::General(general, turn) => {
                let column = |x: &[f64]| MatRef::from_column_major_slice(x, x.len(), 1).to_owned();
                let field = if self.is_last(window) {
                    check_length(window, u)?;
                    general.fields(Seen::Last, &column(u), &column(&[]))?
                } else {
                    let f = self.forces(window, u)?;
                    general.fields(Seen::Loads(&self.loads(window)?), &column(u), &column(&f))?
                };
                let field = self.dofs.to_nodes(field.col_as_slice(0))?;
                Ok(match turn {
                    Some(turn) if window.shift > 0 => self.turned(window, &field, turn),
                    _ => field,
                })
            }
        }
    }

    /// A field of the whole gear, moved on by the window's shift.
    fn turned(&self, window: &Window, field: &[[f64; 3]], turn: &PitchTurn) -> Vec<[f64; 3]> {
        let forward = Rotation3::from_axis_angle(&Vector3::z_axis(), self.frame_angle(window));
        let mut image: Vec<u32> = (0..field.len() as u32).collect();
        for _ in 0..window.shift {
            image.iter_mut().for_each(|n| *n = turn.nodes[*n as usize]);
        }
        let mut turned = vec![[0.0; 3]; field.len()];
        for (&to, u) in image.iter().zip(field) {
            turned[to as usize] = (forward * Vector3::from(*u)).into();
        }
        turned
    }

    /// Coordinates of the window `to`, in its own frame, of the field that `u` describe in the window `from`.
    ///
    /// ```text
    /// kept teeth:    u_B(to) = u_B(from)
    /// oncoming one:  u_B(to) = rows of Phi_IC of the old window times u_B(from)
    /// ```
    /// # Errors
    /// As [`GearReducer::expand`].
    pub fn carry(&self, from: &Window, to: &Window, u: &[f64]) -> Result<Vec<f64>, ReductionError> {
        let (z, loads) = (self.gear.tooth_count(), self.loads(to)?);
        if let Method::Cyclic(cyclic) = &self.method {
            return cyclic.carry(&self.forces(from, u)?, (to.shift + z - from.shift) % z, &loads);
        }
        let field = self.expand(from, u)?;
        let back = Rotation3::from_axis_angle(&Vector3::z_axis(), -self.frame_angle(to));
        let mut carried = Vec::with_capacity(3 * loads.len());
        for load in &loads {
            let moved = |&(n, w): &(u32, f64)| w * Vector3::from(field[self.material_node(to, n) as usize]);
            let mean: Vector3<f64> = load.iter().map(moved).sum();
            carried.extend_from_slice((back * mean).as_slice());
        }
        Ok(carried)
    }

    /// Columns `columns` of T = [I; Phi_IC] of the first window, one row a free degree of freedom of the mesh.
    ///
    /// # Errors
    /// [`ReductionError::WrongLength`] when a column does not exist; else as [`GearReducer::expand`].
    pub fn constraint_modes(&self, columns: &[usize]) -> Result<Mat<f64>, ReductionError> {
        let n = self.base.coordinates();
        if let Some(&given) = columns.iter().find(|&&c| c >= n) {
            return Err(ReductionError::WrongLength { given, wanted: n });
        }
        let window = Window { reduced: self.base.clone(), shift: 0 };
        let mut modes = Mat::zeros(self.dofs.free_count(), columns.len());
        for (j, &column) in columns.iter().enumerate() {
            let mut unit = vec![0.0; n];
            unit[column] = 1.0;
            let field = self.expand(&window, &unit)?;
            for (i, &node) in self.dofs.free_nodes().iter().enumerate() {
                (0..3).for_each(|axis| modes[(3 * i + axis, j)] = field[node as usize][axis]);
            }
        }
        Ok(modes)
    }

    /// M^ = T' M T of the first window, t; the same for every window of a cyclic gear.
    ///
    /// # Errors
    /// [`ReductionError::Fem`]; [`ReductionError::NotPositiveDefinite`] as for [`GearReducer::expand`].
    pub fn condensed_mass(&self) -> Result<Mat<f64>, ReductionError> {
        let window = Window { reduced: self.base.clone(), shift: 0 };
        let stiffness = self.stiffness_of(&window)?;
        match &self.method {
            Method::Cyclic(cyclic) => cyclic.mass(stiffness),
            Method::General(general, _) if self.is_last(&window) => {
                general.mass(Seen::Last, self.gear.mesh(), &self.material, stiffness)
            }
            Method::General(general, _) => {
                general.mass(Seen::Loads(&self.loads(&window)?), self.gear.mesh(), &self.material, stiffness)
            }
        }
    }

    /// Stress at `nodes` (6 rows a node) for unit coordinates of a window, MPa/mm, in the frame of its matrices.
    pub(crate) fn stress_of(&self, window: &Window, nodes: &[u32]) -> Result<Mat<f64>, ReductionError> {
        let by_force = match &self.method {
            Method::Cyclic(cyclic) => cyclic.stress(nodes)?,
            Method::General(general, _) => {
                let (mesh, count) = (self.gear.mesh(), window.reduced.coordinates());
                let operator = fem::StressOperator::new(mesh, &self.material, self.elements(), &self.dofs, nodes)?;
                if self.is_last(window) {
                    return general.stress(Seen::Last, count, &operator);
                }
                general.stress(Seen::Loads(&self.loads(window)?), count, &operator)?
            }
        };
        // From stress of unit forces to that of unit displacements: the forces that these take are K^.
        Ok(fem::dense::product(by_force.as_ref(), self.stiffness_of(window)?.as_ref()))
    }

    /// Whether the window's nodes are last in the factor.
    fn is_last(&self, window: &Window) -> bool {
        self.coordinates.are_nodes() && Arc::ptr_eq(&window.reduced, &self.base)
    }

    fn loads(&self, window: &Window) -> Result<Vec<Load>, ReductionError> {
        self.coordinates.loads(&self.gear, &window.reduced.teeth, &self.options.sides)
    }

    fn stiffness_of<'a>(&self, window: &'a Window) -> Result<&'a Mat<f64>, ReductionError> {
        let first = window.reduced.teeth.first().copied().unwrap_or(0);
        window.reduced.stiffness().ok_or(ReductionError::NotPositiveDefinite { first })
    }

    /// Forces that hold a window's coordinates at `u`, N.
    fn forces(&self, window: &Window, u: &[f64]) -> Result<Vec<f64>, ReductionError> {
        check_length(window, u)?;
        let first = window.reduced.teeth.first().copied().unwrap_or(0);
        window.reduced.forces(u).ok_or(ReductionError::NotPositiveDefinite { first })
    }
}

fn check_length(window: &Window, u: &[f64]) -> Result<(), ReductionError> {
    let (given, wanted) = (u.len(), window.reduced.coordinates());
    if given == wanted { Ok(()) } else { Err(ReductionError::WrongLength { given, wanted }) }
}

/// A window before it is reduced.
struct First {
    teeth: Vec<u32>,
    nodes: Vec<u32>,
    loads: Vec<Load>,
}

impl First {
    fn new(gear: &GearMesh, coordinates: &Coordinates, options: &ReductionOptions) -> Result<Self, ReductionError> {
        let z = gear.tooth_count();
        // Teeth first, first + 1, ... counter-clockwise.
        let teeth: Vec<u32> = (0..options.window as u32).map(|i| (options.first % z + i) % z).collect();
        let nodes = coordinates.nodes(gear, &teeth, &options.sides)?;
        let loads = coordinates.loads(gear, &teeth, &options.sides)?;
        Ok(Self { teeth, nodes, loads })
    }
}

/// One sector of a cyclic gear, and the mesh of those about the window if `gear` itself is a sector.
fn sectors(
    gear: &GearMesh,
    turn: Option<&PitchTurn>,
    options: &ReductionOptions,
) -> Result<Option<(SectorMesh, Option<GearMesh>)>, ReductionError> {
    if let Some(turn) = turn {
        return Ok(SectorMesh::of_whole(gear, turn).map(|part| (part, None)));
    }
    if !gear.is_periodic_sector() {
        return Ok(None);
    }
    let z = i64::from(gear.tooth_count());
    // A sector may have the two flanks of a tooth, or of a space; its numbers count down from z where they are below 0.
    let signed = |t: u32| if 2 * i64::from(t) > z { i64::from(t) - z } else { i64::from(t) };
    let teeth = gear.teeth().into_iter().map(signed);
    let [low, high] = teeth.fold([i64::MAX, i64::MIN], |[a, b], t| [a.min(t), b.max(t)]);
    // One more on either side: half teeth and fillets of the outermost teeth reach into them.
    let from = (i64::from(options.first) - high - 1).rem_euclid(z) as u32;
    let count = (options.window as i64 + high - low + 2).min(z) as u32;
    let copies = gear.copies(from, count)?;
    Ok(SectorMesh::of_sector(gear, &copies).map(|part| (part, Some(copies.gear))))
}
