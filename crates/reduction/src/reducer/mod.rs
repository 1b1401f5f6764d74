//! One condensation a gear, any window of it. Theory (11), (12).

mod asked;
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

use crate::{FlankGrid, FlankGrids, LayerStack, ReducedGear, ReductionError, load::Coordinates};
use asked::Asked;
use condense::{Condensed, condense, method_again};

pub use options::{ReductionOptions, ReductionStage, ReductionWatch, ReductionWay};
pub use parts::TablePart;

pub(crate) use condense::{Method, Summary};

/// A gear that can be reduced to any window of its teeth.
///
/// Coordinates are the flank nodes of the window's teeth, or means of their displacements with the weights of loads on
/// coarse grids ([`FlankGrid`]). They are known from one sector where the gear is cyclic to round-off, else from one
/// factor of the whole gear ([`ReductionWay`]); the matrices are the same to 1e-9. A cyclic gear has the same matrices
/// for all windows, in frames turned by whole pitches; for any other gear further windows are selections of the columns
/// of their teeth, which come from solves with the same factor and may be kept in a [`PartStore`](crate::PartStore).
///
/// A periodic sector of one tooth is never unrolled to the whole gear: [`GearReducer::gear`] then is the sectors of the
/// first window and one more on either side, in the frame of the matrices.
///
/// A gear from a [`ReductionRecord`](crate::ReductionRecord) is condensed only when something asks for more than the
/// record has: another window of a gear that is not cyclic, a displacement field, stress modes, mass.
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
    pub(crate) base: Arc<ReducedGear>,
    asked: Asked,
    /// Of a wide gear, of which `gear` has a part of the layers.
    stack: Option<LayerStack>,
}

impl GearReducer {
    /// Condenses a gear to its flank nodes and reduces the first window.
    ///
    /// A periodic sector, and a whole gear that a turn by one pitch leaves the same to round-off, go the cyclic way.
    ///
    /// # Errors
    /// [`ReductionError`] when a flank is missing or the matrices are not what they must be.
    pub fn new(gear: MeshedGear, material: Material, options: ReductionOptions) -> Result<Self, ReductionError> {
        Self::watched(gear, material, options, false, ReductionWatch::IDLE)
    }

    /// Reducer by one factor of the whole gear, whatever the gear is.
    ///
    /// # Errors
    /// As [`GearReducer::new`].
    pub fn general(gear: MeshedGear, material: Material, options: ReductionOptions) -> Result<Self, ReductionError> {
        Self::watched(gear, material, options, true, ReductionWatch::IDLE)
    }

    /// As [`GearReducer::new`], or where `general` as [`GearReducer::general`], while somebody waits.
    ///
    /// # Errors
    /// As [`GearReducer::new`], and [`ReductionError::is_unwanted`].
    pub fn watched(
        gear: MeshedGear,
        material: Material,
        options: ReductionOptions,
        general: bool,
        watch: ReductionWatch<'_>,
    ) -> Result<Self, ReductionError> {
        Self::build(gear, material, options, (general, watch), |_| Ok(Coordinates::FlankNodes))
    }

    /// Condenses a gear to grids over its flanks; `grids` makes those of every flank that a window may hold, on the
    /// mesh that [`GearReducer::gear`] will show. `general`: by one factor of the whole gear, whatever the gear is.
    ///
    /// # Errors
    /// [`ReductionError`] as for [`GearReducer::new`]; those of `grids`.
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
        let (condensed, method) = condense(gear, &material, &options, way, false, coordinates)?;
        Ok(Self::assembled(material, options, condensed, OnceLock::from(Ok(method))))
    }

    /// Reduces the first window of a wide gear by a shorter one of the same layers, `gear`: of its compliance the
    /// columns that the first tooth's flank has, which tell those of all others. One sector, one side.
    ///
    /// # Errors
    /// [`ReductionError::NoSectorOfLayers`]; else as [`GearReducer::new`].
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

    /// The layers of which this gear knows a part; `None` for a gear that is known as a whole.
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
        let (given, asked, stack) = Default::default();
        Self { stack, gear, given, material, options, dofs, coordinates, summary, method, base, asked }
    }

    /// Lowest frequency of the gear with its bore held and its flanks free, Hz; infinite for one that has no freedom.
    /// Found once; a record keeps it.
    ///
    /// # Errors
    /// As [`GearReducer::modes`].
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
            let general = self.summary.way == ReductionWay::General;
            let method = method_again(gear, &self.material, &self.options, general, &|| self.kept_factor())?;
            self.keep_factor(&method);
            Ok(method)
        };
        self.method.get_or_init(again).as_ref().map_err(Clone::clone)
    }

    /// The mesh: the whole gear as it was given, or the sectors about the first window.
    pub fn gear(&self) -> &MeshedGear {
        &self.gear
    }

    /// Material of the gear.
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
        self.stack.map_or(self.summary.free_count, |stack| stack.free_count)
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

    /// What is kept of the flanks.
    pub(crate) fn coordinates(&self) -> &Coordinates {
        &self.coordinates
    }
}
