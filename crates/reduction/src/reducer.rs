//! One condensation a gear, any window of it. Theory (11), (12).

use std::{
    collections::BTreeMap,
    f64::consts::TAU,
    sync::{Arc, Mutex, OnceLock, PoisonError},
};

use faer::Mat;
use fem::{DofMap, ElementOptions, Material};
use geometry::{Gear, Side};
use mesh::{Face, GearMesh};

use crate::{
    FlankGrid, FlankGrids, HalfTooth, ModeChoice, ReducedGear, ReductionError, ReductionRecord, Window,
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
///
/// A gear from a [`ReductionRecord`] is condensed only when something asks for more than the record has: another window of a gear that is not
/// cyclic, a displacement field, stress modes, mass.
#[derive(Debug)]
pub struct GearReducer {
    gear: GearMesh,
    /// The mesh that was given, where `gear` was made of it.
    given: Option<GearMesh>,
    material: Material,
    options: ReductionOptions,
    pub(crate) dofs: DofMap,
    coordinates: Coordinates,
    summary: Summary,
    method: OnceLock<Result<Method, ReductionError>>,
    /// Lowest frequency with the bore held and the flanks free, Hz, once it was asked for.
    lowest: OnceLock<f64>,
    /// Further windows, half teeth and frequencies that came from a record, so many.
    recorded: Option<[usize; 3]>,
    pub(crate) base: Arc<ReducedGear>,
    others: Mutex<BTreeMap<u32, Arc<ReducedGear>>>,
    halves: Mutex<BTreeMap<(u32, Side), Arc<HalfTooth>>>,
}

/// What is known of the method without having it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Summary {
    pub(crate) way: ReductionWay,
    pub(crate) cyclic: bool,
    pub(crate) free_count: usize,
}

/// A condensed gear before its parts are put together.
struct Condensed {
    gear: GearMesh,
    coordinates: Coordinates,
    method: Method,
    first: First,
    compliance: Mat<f64>,
}

/// The condensed gear.
#[derive(Debug)]
pub(crate) enum Method {
    /// From one sector.
    Cyclic(Box<CyclicGear>),
    /// From one factor; with the turn by one pitch of a whole gear that is cyclic all the same.
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
        let condensed = Self::condense(gear, &material, &options, general, coordinates)?;
        Ok(Self::assembled(material, options, condensed))
    }

    fn condense<E: From<ReductionError>>(
        gear: GearMesh,
        material: &Material,
        options: &ReductionOptions,
        general: bool,
        coordinates: impl Fn(&GearMesh) -> Result<Coordinates, E>,
    ) -> Result<Condensed, E> {
        let mut turn = PitchTurn::of_gear(&gear);
        let sectors = if general { None } else { sectors(&gear, turn.as_ref(), options)? };
        if let Some((part, copies)) = sectors {
            let seen = copies.as_ref().unwrap_or(&gear);
            let coordinates = coordinates(seen)?;
            let first = First::new(seen, &coordinates, options)?;
            let cyclic = CyclicGear::new(part, material, &options.elements, &first.loads, coordinates.are_nodes())?;
            if let Some(cyclic) = cyclic {
                let compliance = cyclic.compliance();
                let method = Method::Cyclic(Box::new(cyclic));
                let gear = copies.unwrap_or(gear);
                return Ok(Condensed { gear, coordinates, method, first, compliance });
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
        let first = First::new(&gear, &coordinates, options)?;
        let (last, seen) =
            if coordinates.are_nodes() { (&first.nodes[..], Seen::Last) } else { (&[][..], Seen::Loads(&first.loads)) };
        let factor = GeneralGear::new(gear.mesh(), gear.bore_nodes(), material, &options.elements, last)?;
        let compliance = factor.compliance(seen)?;
        let method = Method::General(Box::new(factor), turn);
        Ok(Condensed { gear, coordinates, method, first, compliance })
    }

    fn assembled(material: Material, options: ReductionOptions, condensed: Condensed) -> Self {
        let Condensed { gear, coordinates, method, first, compliance } = condensed;
        let dofs = DofMap::new(gear.mesh().nodes.len(), gear.bore_nodes());
        let base = Arc::new(ReducedGear::new(first.teeth, options.sides.clone(), first.nodes, compliance));
        let (others, halves) = Default::default();
        let summary = match &method {
            Method::Cyclic(c) => Summary { way: ReductionWay::CyclicSector, cyclic: true, free_count: c.free_count() },
            Method::General(_, turn) => {
                Summary { way: ReductionWay::General, cyclic: turn.is_some(), free_count: dofs.free_count() }
            }
        };
        let method = OnceLock::from(Ok(method));
        let (given, recorded, lowest) = (None, None, OnceLock::new());
        Self {
            gear,
            given,
            material,
            options,
            dofs,
            coordinates,
            summary,
            method,
            lowest,
            recorded,
            base,
            others,
            halves,
        }
    }

    /// A gear from what was kept of it. Mesh, material and options must be those that the record was made of ([`crate::record_key`]
    /// sees to that); with `record` of another first window the gear is reduced anew.
    ///
    /// # Errors
    /// As [`GearReducer::new`].
    pub fn from_record(
        gear: GearMesh,
        material: Material,
        options: ReductionOptions,
        record: ReductionRecord,
    ) -> Result<Self, ReductionError> {
        let ReductionRecord { summary, lowest_hz, windows, halves } = record;
        let first = options.first % gear.tooth_count().max(1);
        let by_first = windows.into_iter().filter_map(|w| Some((w.teeth.first().copied()?, w)));
        let mut others: BTreeMap<u32, Arc<ReducedGear>> = by_first.collect();
        let general = summary.way == ReductionWay::General;
        let Some(base) = others.remove(&first) else {
            return Self::build(gear, material, options, general, |_| Ok(Coordinates::FlankNodes));
        };
        let seen = match (gear.is_periodic_sector(), general) {
            (false, _) => None,
            (true, true) => Some(gear.clone().whole()?),
            (true, false) => sectors(&gear, None, &options)?.and_then(|(_, copies)| copies),
        };
        let (gear, given) = match seen {
            Some(seen) => (seen, Some(gear)),
            None => (gear, None),
        };
        let dofs = DofMap::new(gear.mesh().nodes.len(), gear.bore_nodes());
        let recorded = Some([others.len(), halves.len(), usize::from(lowest_hz.is_some())]);
        let lowest = lowest_hz.map_or_else(OnceLock::new, OnceLock::from);
        let (others, halves) = (Mutex::new(others), Mutex::new(halves.into_iter().collect()));
        let (coordinates, method) = (Coordinates::FlankNodes, OnceLock::new());
        Ok(Self {
            gear,
            given,
            material,
            options,
            dofs,
            coordinates,
            summary,
            method,
            lowest,
            recorded,
            base,
            others,
            halves,
        })
    }

    /// What a later run needs of this gear: the windows, half teeth and lowest frequency that were asked for so far. `None` when a record has
    /// it all already, and for a gear reduced to grids.
    pub fn record(&self) -> Option<ReductionRecord> {
        let others = self.others.lock().unwrap_or_else(PoisonError::into_inner);
        let halves = self.halves.lock().unwrap_or_else(PoisonError::into_inner);
        let lowest_hz = self.lowest.get().copied();
        let new = self.recorded != Some([others.len(), halves.len(), usize::from(lowest_hz.is_some())]);
        (new && self.coordinates.are_nodes()).then(|| ReductionRecord {
            summary: self.summary,
            lowest_hz,
            windows: std::iter::once(&self.base).chain(others.values()).cloned().collect(),
            halves: halves.iter().map(|(&flank, half)| (flank, half.clone())).collect(),
        })
    }

    /// Lowest frequency of the gear with its bore held and its flanks free, Hz; infinite for one that has no freedom. Found once; a record keeps it.
    ///
    /// # Errors
    /// As [`GearReducer::modes`].
    pub fn lowest_elastic_hz(&self) -> Result<f64, ReductionError> {
        if let Some(hz) = self.lowest.get() {
            return Ok(*hz);
        }
        let hz = self.modes(ModeChoice::Count(1))?.frequencies_hz().first().copied().unwrap_or(f64::INFINITY);
        Ok(*self.lowest.get_or_init(|| hz))
    }

    /// Whether the gear came from a record.
    pub fn is_from_record(&self) -> bool {
        self.recorded.is_some()
    }

    /// The condensed gear behind the windows; a gear from a record is condensed by the first call.
    pub(crate) fn method(&self) -> Result<&Method, ReductionError> {
        let again = || {
            let gear = self.given.as_ref().unwrap_or(&self.gear).clone();
            let general = self.summary.way == ReductionWay::General;
            let nodes = |_: &GearMesh| Ok::<_, ReductionError>(Coordinates::FlankNodes);
            Ok(Self::condense(gear, &self.material, &self.options, general, nodes)?.method)
        };
        self.method.get_or_init(again).as_ref().map_err(Clone::clone)
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
        self.summary.free_count
    }

    /// Which way the gear was condensed.
    pub fn way(&self) -> ReductionWay {
        self.summary.way
    }

    /// Whether all windows are alike: the gear is the same after a turn by one pitch.
    pub fn is_cyclic(&self) -> bool {
        self.summary.cyclic
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
        let Method::General(general, _) = self.method()? else {
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
        if window.shift == 0 {
            return node;
        }
        match self.method() {
            Ok(Method::Cyclic(cyclic)) => cyclic.turned_node(node, window.shift).unwrap_or(node),
            Ok(Method::General(_, Some(turn))) => {
                (0..window.shift).fold(node, |n, _| turn.nodes.get(n as usize).copied().unwrap_or(n))
            }
            Ok(Method::General(_, None)) | Err(_) => node,
        }
    }

    /// Whether the window's nodes are last in the factor.
    pub(crate) fn is_last(&self, window: &Window) -> bool {
        self.coordinates.are_nodes() && Arc::ptr_eq(&window.reduced, &self.base)
    }

    /// What is kept of the flanks.
    pub(crate) fn coordinates(&self) -> &Coordinates {
        &self.coordinates
    }

    /// Unit loads of a window's coordinates.
    pub(crate) fn loads(&self, window: &Window) -> Result<Vec<Load>, ReductionError> {
        self.coordinates.loads(&self.gear, &window.reduced.teeth, &self.options.sides)
    }
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
