//! One condensation per gear, and any of its windows. Theory (11), (12).

mod asked;
mod bolts;
mod bore_pressures;
mod condense;
mod options;
mod parts;
mod recorded;
mod several_windows;
mod tooth_windows;
mod windows;

use std::{
    f64::consts::TAU,
    sync::{Arc, OnceLock},
};

use fem::{DofMap, ElementOptions, Material};
use geometry::Side;
use mesh::{Face, MeshedGear};

use crate::{FlankGrid, FlankGrids, LayerStack, ReducedGear, ReductionError, cyclic::BoltedGear, load::Coordinates};
use asked::Asked;
use condense::{Condensed, Found, condense, method_again};

pub use bolts::{BoltCompliance, BoltsAndFlanks};
pub use options::{ReductionOptions, ReductionStage, ReductionWatch, ReductionWay};
pub use parts::TablePart;

pub(crate) use condense::{Method, Summary};

/// A gear that can be reduced to any window of its teeth.
///
/// Coordinates are the flank nodes of the window's teeth, or weighted means of their displacements that belong to loads
/// on coarse grids ([`FlankGrid`]). They are computed from one sector if the gear is cyclic to round-off, otherwise
/// with one factor of the whole gear ([`ReductionWay`]). All methods give the same matrices to 1e-9. A cyclic gear has
/// the same matrices for all windows, in frames rotated by whole pitches. For any other gear, further windows select
/// the columns of their teeth; these columns come from solves with the same factor and may be stored in a
/// [`PartStore`](crate::PartStore).
///
/// A periodic sector of one tooth is never expanded to the whole gear. [`GearReducer::gear`] then returns the sectors
/// of the first window and one more on either side, in the frame of the matrices.
///
/// A gear from a [`ReductionRecord`](crate::ReductionRecord) is condensed only if a result is requested that the record
/// does not have: another window of a gear that is not cyclic, a displacement field, stress modes, mass.
#[derive(Debug)]
pub struct GearReducer {
    gear: MeshedGear,
    /// The mesh that was given, where `gear` was made of it.
    given: Option<MeshedGear>,
    material: Material,
    options: ReductionOptions,
    pub(crate) dofs: DofMap,
    coordinates: Coordinates,
    summary: Summary,
    method: OnceLock<Result<Method, ReductionError>>,
    /// One sector of a gear on bolts; its `method` is for what the sector does not give.
    bolted: OnceLock<Result<Box<BoltedGear>, ReductionError>>,
    pub(crate) base: Arc<ReducedGear>,
    asked: Asked,
    /// Of a wide gear, of which `gear` has a part of the layers.
    stack: Option<LayerStack>,
}

impl GearReducer {
    /// Condenses a gear to its flank nodes and reduces the first window.
    ///
    /// The cyclic method is used for a periodic sector, and for a whole gear that is invariant to round-off under
    /// rotation by one pitch.
    ///
    /// # Errors
    /// [`ReductionError`] if a flank is missing or the matrices are not valid.
    pub fn new(gear: MeshedGear, material: Material, options: ReductionOptions) -> Result<Self, ReductionError> {
        Self::watched(gear, material, options, false, ReductionWatch::IDLE)
    }

    /// Condenses with one factor of the whole gear, even if the gear is cyclic.
    ///
    /// # Errors
    /// Those of [`GearReducer::new`].
    pub fn general(gear: MeshedGear, material: Material, options: ReductionOptions) -> Result<Self, ReductionError> {
        Self::watched(gear, material, options, true, ReductionWatch::IDLE)
    }

    /// As [`GearReducer::new`], or as [`GearReducer::general`] if `general` is set, but reports progress and can be
    /// cancelled.
    ///
    /// # Errors
    /// Those of [`GearReducer::new`], and an error with [`ReductionError::is_unwanted`] after a cancellation.
    pub fn watched(
        gear: MeshedGear,
        material: Material,
        options: ReductionOptions,
        general: bool,
        watch: ReductionWatch<'_>,
    ) -> Result<Self, ReductionError> {
        Self::build(gear, material, options, (general, watch), |_| Ok(Coordinates::FlankNodes))
    }

    /// Condenses a gear to grids over its flanks. `grids` makes the grids of all flanks that a window may contain, on
    /// the mesh that [`GearReducer::gear`] will return. With `general` one factor of the whole gear is used, even if
    /// the gear is cyclic.
    ///
    /// # Errors
    /// [`ReductionError`] as for [`GearReducer::new`]; the errors of `grids`.
    pub fn on_grids<E: From<ReductionError>>(
        gear: MeshedGear,
        material: Material,
        options: ReductionOptions,
        general: bool,
        grids: impl Fn(&MeshedGear) -> Result<FlankGrids, E>,
    ) -> Result<Self, E> {
        Self::build(gear, material, options, (general, ReductionWatch::IDLE), |gear| {
            Ok(Coordinates::Grids(grids(gear)?))
        })
    }

    fn build<E: From<ReductionError>>(
        gear: MeshedGear,
        material: Material,
        options: ReductionOptions,
        way: (bool, ReductionWatch<'_>),
        coordinates: impl Fn(&MeshedGear) -> Result<Coordinates, E>,
    ) -> Result<Self, E> {
        let (condensed, found) = condense(gear, &material, &options, way, false, coordinates)?;
        Ok(match found {
            Found::Method(method) => Self::assembled(material, options, condensed, OnceLock::from(Ok(method))),
            Found::Bolted(bolted) => {
                let bolted = OnceLock::from(Ok(bolted));
                Self { bolted, ..Self::assembled(material, options, condensed, OnceLock::new()) }
            }
        })
    }

    /// Reduces the first window of a wide gear by means of a shorter one with equal layers, `gear`. Only the columns of
    /// the compliance for the first tooth's flank are computed, because all others follow from them. For one sector and
    /// one side.
    ///
    /// # Errors
    /// [`ReductionError::NoSectorOfLayers`]; otherwise those of [`GearReducer::new`].
    pub fn of_layers(
        gear: MeshedGear,
        material: Material,
        options: ReductionOptions,
        stack: LayerStack,
        watch: ReductionWatch<'_>,
    ) -> Result<Self, ReductionError> {
        let nodes = |_: &MeshedGear| Ok::<_, ReductionError>(Coordinates::FlankNodes);
        let (condensed, _) = condense(gear, &material, &options, (false, watch), true, nodes)?;
        let method = Err(ReductionError::Layers { layers: stack.layers, condensed: stack.condensed });
        Ok(Self { stack: Some(stack), ..Self::assembled(material, options, condensed, OnceLock::from(method)) })
    }

    /// The layers of this gear, if only a part of them was condensed; `None` for a gear that was condensed as a whole.
    pub fn stack(&self) -> Option<LayerStack> {
        self.stack
    }

    /// A reducer that nothing was asked of.
    fn assembled(
        material: Material,
        options: ReductionOptions,
        condensed: Condensed,
        method: OnceLock<Result<Method, ReductionError>>,
    ) -> Self {
        let Condensed { gear, coordinates, summary, base } = condensed;
        let dofs = DofMap::new(gear.mesh().nodes.len(), gear.held_nodes());
        let (given, asked, stack, bolted) = Default::default();
        Self { stack, gear, given, material, options, dofs, coordinates, summary, method, bolted, base, asked }
    }

    /// Lowest frequency of the gear with its bore held and its flanks free, Hz; infinite for a gear without degrees of
    /// freedom. It is computed once and stored in a record.
    ///
    /// # Errors
    /// Those of [`GearReducer::modes`].
    pub fn lowest_elastic_hz(&self) -> Result<f64, ReductionError> {
        if let Some(hz) = self.asked.lowest_hz.get() {
            return Ok(*hz);
        }
        let hz = self.lowest_square()?.sqrt() / TAU;
        Ok(*self.asked.lowest_hz.get_or_init(|| hz))
    }

    /// The condensed gear behind the windows; a gear from a record is condensed by the first call.
    pub(crate) fn method(&self) -> Result<&Method, ReductionError> {
        let again = || {
            let gear = self.given.as_ref().unwrap_or(&self.gear).clone();
            let general = self.summary.way != ReductionWay::CyclicSector;
            let method = method_again(gear, &self.material, &self.options, general, &|| self.kept_factor())?;
            self.keep_factor(&method);
            Ok(method)
        };
        self.method.get_or_init(again).as_ref().map_err(Clone::clone)
    }

    /// The mesh: the whole gear as given, or the sectors around the first window.
    pub fn gear(&self) -> &MeshedGear {
        &self.gear
    }

    /// Material of the gear.
    pub fn material(&self) -> &Material {
        &self.material
    }

    /// Variants of the elements.
    pub fn elements(&self) -> &ElementOptions {
        &self.options.elements
    }

    /// Free degrees of freedom of the mesh.
    pub fn dofs(&self) -> &DofMap {
        &self.dofs
    }

    /// Number of free degrees of freedom of the gear, including all its sectors.
    pub fn free_count(&self) -> usize {
        self.stack.map_or(self.summary.free_count, |stack| stack.free_count)
    }

    /// Method by which the gear was condensed.
    pub fn way(&self) -> ReductionWay {
        self.summary.way
    }

    /// Whether all windows are equal: the gear is invariant under rotation by one pitch.
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

    /// Positions (mm) and faces that carry the load of a flank: those of the mesh or those of the grid over it.
    pub fn flank(&self, tooth: u32, side: Side) -> Option<(&[[f64; 3]], &[Face])> {
        match &self.coordinates {
            Coordinates::FlankNodes => Some((&self.gear.mesh().nodes, self.gear.flank(tooth, side)?)),
            Coordinates::Grids(grids) => grids.get(&(tooth, side)).map(|g| (&g.positions[..], &g.faces[..])),
        }
    }

    /// What is kept of the flanks.
    pub(crate) fn coordinates(&self) -> &Coordinates {
        &self.coordinates
    }
}
