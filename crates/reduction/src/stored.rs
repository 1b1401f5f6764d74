//! A reduced gear from a record; its factor is made again when something asks for it.

use std::{
    collections::BTreeMap,
    f64::consts::PI,
    sync::{Arc, Mutex, OnceLock, PoisonError},
};

use fem::{DofMap, ElementOptions, Material};
use geometry::{Gear, Side};
use mesh::GearMesh;

use crate::{
    GearReducer, HalfTooth, ReducedGear, ReductionError, ReductionOptions, ReductionRecord, StressModes, Window,
};

/// A gear of which only a [`ReductionRecord`] is known.
///
/// Windows and half teeth that are in the record come from it; whatever else is asked for (another window of a gear that is not cyclic, a
/// displacement field, stress modes) makes the factor first, once, as [`GearReducer::new`] does.
#[derive(Debug)]
pub struct StoredGear {
    gear: GearMesh,
    material: Material,
    options: ReductionOptions,
    dofs: DofMap,
    cyclic: bool,
    /// By the first tooth of each.
    windows: BTreeMap<u32, Arc<ReducedGear>>,
    halves: Mutex<BTreeMap<(u32, Side), Arc<HalfTooth>>>,
    reducer: OnceLock<Result<Box<GearReducer>, ReductionError>>,
}

impl StoredGear {
    /// A gear from its record; mesh, material and options must be those that the record was made of
    /// ([`crate::record_key`] sees to that).
    pub fn new(gear: GearMesh, material: Material, options: ReductionOptions, record: ReductionRecord) -> Self {
        let dofs = DofMap::new(gear.mesh().nodes.len(), gear.bore_nodes());
        let first = |w: &Arc<ReducedGear>| w.teeth.first().copied();
        let windows = record.windows.into_iter().filter_map(|w| Some((first(&w)?, w))).collect();
        let halves = Mutex::new(record.halves.into_iter().collect());
        Self { gear, material, options, dofs, cyclic: record.cyclic, windows, halves, reducer: OnceLock::new() }
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

    /// Whether all windows are alike.
    pub fn is_cyclic(&self) -> bool {
        self.cyclic
    }

    /// The gear with its factor, which the first call makes.
    ///
    /// # Errors
    /// Those of [`GearReducer::new`].
    pub fn reducer(&self) -> Result<&GearReducer, ReductionError> {
        let make = || GearReducer::new(self.gear.clone(), self.material, self.options.clone()).map(Box::new);
        self.reducer.get_or_init(make).as_deref().map_err(Clone::clone)
    }

    /// What a later run needs beyond the record that this gear came from; `None` when that was enough.
    pub fn record(&self) -> Option<ReductionRecord> {
        let reducer = self.reducer.get()?.as_ref().ok()?;
        let mut record = reducer.record();
        if record.cyclic {
            return None;
        }
        let known = |w: &Arc<ReducedGear>| w.teeth.first().is_some_and(|t| self.windows.contains_key(t));
        record.windows.retain(|w| !known(w));
        if record.windows.is_empty() {
            return None;
        }
        record.windows.extend(self.windows.values().cloned());
        let halves = self.halves.lock().unwrap_or_else(PoisonError::into_inner);
        record.halves = halves.iter().map(|(&flank, half)| (flank, half.clone())).collect();
        Some(record)
    }

    /// The window whose first tooth is `first`.
    ///
    /// # Errors
    /// [`ReductionError::MissingFlank`] when the mesh ends before the window does.
    pub fn window(&self, first: u32) -> Result<Window, ReductionError> {
        let z = self.gear.tooth_count().max(1);
        let (first, base) = (first % z, self.options.first % z);
        let (place, shift) = if self.cyclic { (base, (first + z - base) % z) } else { (first, 0) };
        match self.windows.get(&place) {
            Some(reduced) => Ok(Window { reduced: reduced.clone(), shift }),
            None => self.reducer()?.window(first),
        }
    }

    /// Half of a tooth of the mesh behind one flank. `geometry` is the gear that was meshed.
    ///
    /// # Errors
    /// [`ReductionError::MissingFlank`], [`ReductionError::Fem`].
    pub fn half_tooth(&self, geometry: &Gear, tooth: u32, side: Side) -> Result<Arc<HalfTooth>, ReductionError> {
        let mut halves = self.halves.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(half) = halves.get(&(tooth, side)) {
            return Ok(half.clone());
        }
        let half = HalfTooth::new(&self.gear, geometry, &self.material, self.elements(), tooth, side)?;
        let half = Arc::new(half);
        halves.insert((tooth, side), half.clone());
        Ok(half)
    }

    /// Angle of a window's frame in the gear's own frame, rad.
    pub fn frame_angle(&self, window: &Window) -> f64 {
        2.0 * PI * f64::from(window.shift) / f64::from(self.gear.tooth_count())
    }

    /// A window of this gear as the gear with the factor has it.
    fn own(&self, window: &Window) -> Result<(&GearReducer, Window), ReductionError> {
        let reducer = self.reducer()?;
        let first = window.reduced.teeth.first().copied().unwrap_or(self.options.first);
        Ok((reducer, reducer.window(first + window.shift)?))
    }

    /// As [`GearReducer::expand`].
    ///
    /// # Errors
    /// As there, and those of [`GearReducer::new`].
    pub fn expand(&self, window: &Window, u: &[f64]) -> Result<Vec<[f64; 3]>, ReductionError> {
        let (reducer, window) = self.own(window)?;
        reducer.expand(&window, u)
    }

    /// As [`GearReducer::material_nodes`].
    ///
    /// # Errors
    /// Those of [`GearReducer::new`].
    pub fn material_nodes(&self, window: &Window) -> Result<Vec<u32>, ReductionError> {
        let (reducer, window) = self.own(window)?;
        Ok(reducer.material_nodes(&window))
    }

    /// As [`GearReducer::material_node`]; the node itself where there is no factor.
    pub fn material_node(&self, window: &Window, node: u32) -> u32 {
        self.reducer().map_or(node, |reducer| reducer.material_node(window, node))
    }

    /// As [`GearReducer::stress_modes`].
    ///
    /// # Errors
    /// As there, and those of [`GearReducer::new`].
    pub fn stress_modes(&self, window: &Window, nodes: &[u32]) -> Result<StressModes, ReductionError> {
        let (reducer, window) = self.own(window)?;
        reducer.stress_modes(&window, nodes)
    }
}

impl GearReducer {
    /// What a later run needs of this gear: the windows and half teeth that were asked for so far.
    pub fn record(&self) -> ReductionRecord {
        ReductionRecord { cyclic: self.is_cyclic(), windows: self.reduced_windows(), halves: self.condensed_halves() }
    }
}
