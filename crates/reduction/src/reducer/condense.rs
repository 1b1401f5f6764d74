//! Selects the method of condensation and condenses the first window.

use std::sync::Arc;

use fem::{BoundaryLastFactor, Material, unless_unwanted};
use mesh::MeshedGear;

use super::{ReductionOptions, ReductionStage, ReductionWatch, ReductionWay};
use crate::{
    ReducedGear, ReductionError,
    cyclic::{BoltedGear, CyclicGear, PitchTurn, SectorMesh},
    general::{GeneralGear, Seen},
    load::{Coordinates, Load},
    window::Compliance,
};

/// The condensed gear.
#[derive(Debug)]
pub(crate) enum Method {
    /// From one sector.
    Cyclic(Box<CyclicGear>),
    /// From one factor; with the turn by one pitch of a whole gear that is cyclic all the same.
    General(Box<GeneralGear>, Option<PitchTurn>),
}

impl Method {
    fn summary(&self) -> Summary {
        match self {
            Self::Cyclic(gear) => {
                Summary { way: ReductionWay::CyclicSector, cyclic: true, free_count: gear.free_count() }
            }
            Self::General(gear, turn) => {
                Summary { way: ReductionWay::General, cyclic: turn.is_some(), free_count: gear.free_count() }
            }
        }
    }
}

/// What a gear was condensed by.
pub(super) enum Found {
    Method(Method),
    Bolted(Box<BoltedGear>),
}

/// What is known of the method without having it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Summary {
    pub(crate) way: ReductionWay,
    pub(crate) cyclic: bool,
    pub(crate) free_count: usize,
}

/// A condensed gear less its method.
pub(super) struct Condensed {
    /// The mesh as the reducer shows it.
    pub(super) gear: MeshedGear,
    pub(super) coordinates: Coordinates,
    pub(super) summary: Summary,
    /// The first window.
    pub(super) base: Arc<ReducedGear>,
}

impl Condensed {
    fn new(
        gear: MeshedGear,
        coordinates: Coordinates,
        options: &ReductionOptions,
        first: Opened,
        (method, compliance): (Method, Compliance),
    ) -> (Self, Method) {
        let base = Arc::new(first.reduced(options, compliance));
        (Self { gear, coordinates, summary: method.summary(), base }, method)
    }
}

/// A gear whose method is ready, and the window that is to be reduced first.
struct Ready {
    gear: MeshedGear,
    coordinates: Coordinates,
    first: Opened,
    method: Method,
}

/// Condenses a gear to its coordinates; `general`: by one factor of the whole gear, whatever the gear is; `watch` hears
/// what is begun and may lose interest. `first_tooth`: of the window's compliance the columns of its first tooth alone.
pub(super) fn condense<E: From<ReductionError>>(
    gear: MeshedGear,
    material: &Material,
    options: &ReductionOptions,
    (general, watch): (bool, ReductionWatch<'_>),
    first_tooth: bool,
    coordinates: impl Fn(&MeshedGear) -> Result<Coordinates, E>,
) -> Result<(Condensed, Found), E> {
    let has_bolts = gear.bore_coupling().beside_bolts().is_some();
    let gear = if has_bolts && gear.is_periodic_sector() { gear.whole().map_err(ReductionError::from)? } else { gear };
    if has_bolts && !general && gear.is_whole_gear() {
        let coordinates = coordinates(&gear)?;
        (watch.tell)(ReductionStage::Sector);
        if let Some(bolted) = bolted_again(&gear, material, options, &coordinates, watch)? {
            let first = Opened::new(&gear, &coordinates, options)?;
            let compliance = Compliance::Whole(bolted.compliance(&first.loads)?);
            let (way, cyclic, free_count) = (ReductionWay::SectorAndBolts, false, bolted.free_count());
            let base = Arc::new(first.reduced(options, compliance));
            let condensed = Condensed { gear, coordinates, summary: Summary { way, cyclic, free_count }, base };
            return Ok((condensed, Found::Bolted(Box::new(bolted))));
        }
    }
    let ready = ready(gear, material, options, (general, watch), &|| None, coordinates)?;
    let Ready { gear, coordinates, first, method } = ready;
    let compliance = match &method {
        Method::Cyclic(cyclic) if first_tooth => {
            let count = first.of_first_tooth(&gear, &coordinates, options)?;
            Compliance::Whole(cyclic.compliance().columns(count))
        }
        Method::Cyclic(cyclic) => Compliance::Teeth(cyclic.compliance()),
        Method::General(..) if first_tooth => return Err(ReductionError::NoSectorOfLayers.into()),
        Method::General(factor, _) => {
            (watch.tell)(ReductionStage::Compliance);
            let seen = if coordinates.are_nodes() { Seen::Last } else { Seen::Loads(&first.loads) };
            Compliance::Whole(factor.compliance(seen, watch.wanted)?)
        }
    };
    let (condensed, method) = Condensed::new(gear, coordinates, options, first, (method, compliance));
    Ok((condensed, Found::Method(method)))
}

/// The sector of a whole gear on bolts, under the loads of its first window.
pub(super) fn bolted_again(
    gear: &MeshedGear,
    material: &Material,
    options: &ReductionOptions,
    coordinates: &Coordinates,
    watch: ReductionWatch<'_>,
) -> Result<Option<BoltedGear>, ReductionError> {
    let first = Opened::new(gear, coordinates, options)?;
    BoltedGear::new(gear, (material, &options.elements), &first.loads, coordinates.are_nodes(), watch.wanted)
}

/// The method of a gear that was condensed to its flank nodes before, without its compliance, which is known; `factor` is
/// asked for that of its sector.
pub(super) fn method_again(
    gear: MeshedGear,
    material: &Material,
    options: &ReductionOptions,
    general: bool,
    factor: KnownFactor<'_>,
) -> Result<Method, ReductionError> {
    let nodes = |_: &MeshedGear| Ok::<_, ReductionError>(Coordinates::FlankNodes);
    Ok(ready(gear, material, options, (general, ReductionWatch::IDLE), factor, nodes)?.method)
}

/// Who may have the factor of a sector.
type KnownFactor<'a> = &'a dyn Fn() -> Option<BoundaryLastFactor>;

fn ready<E: From<ReductionError>>(
    gear: MeshedGear,
    material: &Material,
    options: &ReductionOptions,
    (general, watch): (bool, ReductionWatch<'_>),
    factor: KnownFactor<'_>,
    coordinates: impl Fn(&MeshedGear) -> Result<Coordinates, E>,
) -> Result<Ready, E> {
    let mut turn = PitchTurn::of_gear(&gear);
    // The means of a bore join all sectors, and bolts stand at some of them.
    let general = general || !gear.bore_coupling().is_by_sectors();
    let sectors = if general { None } else { sectors(&gear, turn.as_ref(), options)? };
    if let Some((part, copies)) = sectors {
        let seen = copies.as_ref().unwrap_or(&gear);
        let coordinates = coordinates(seen)?;
        let first = Opened::new(seen, &coordinates, options)?;
        (watch.tell)(ReductionStage::Sector);
        let kept = (coordinates.are_nodes(), factor());
        let cyclic = CyclicGear::new(part, material, &options.elements, &first.loads, kept, watch.wanted)?;
        if let Some(cyclic) = cyclic {
            unless_unwanted(watch.wanted).map_err(ReductionError::from)?;
            let method = Method::Cyclic(Box::new(cyclic));
            return Ok(Ready { gear: copies.unwrap_or(gear), coordinates, first, method });
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
    let first = Opened::new(&gear, &coordinates, options)?;
    let last = if coordinates.are_nodes() { &first.nodes[..] } else { &[] };
    (watch.tell)(ReductionStage::Factor { free_count: 3 * (gear.mesh().nodes.len() - gear.held_nodes().len()) });
    let factor = GeneralGear::new(&gear, material, &options.elements, last, watch.wanted)?;
    let method = Method::General(Box::new(factor), turn);
    Ok(Ready { gear, coordinates, first, method })
}

/// A window before it is reduced.
pub(super) struct Opened {
    teeth: Vec<u32>,
    nodes: Vec<u32>,
    /// Unit loads of its coordinates.
    pub(super) loads: Vec<Load>,
}

impl Opened {
    pub(super) fn new(
        gear: &MeshedGear,
        coordinates: &Coordinates,
        options: &ReductionOptions,
    ) -> Result<Self, ReductionError> {
        let z = gear.tooth_count();
        // Teeth first, first + 1, ... counter-clockwise.
        let teeth: Vec<u32> = (0..options.window as u32).map(|i| (options.first % z + i) % z).collect();
        let nodes = coordinates.nodes(gear, &teeth, &options.sides)?;
        let loads = coordinates.loads(gear, &teeth, &options.sides)?;
        Ok(Self { teeth, nodes, loads })
    }

    /// Teeth, counter-clockwise.
    pub(super) fn teeth(&self) -> &[u32] {
        &self.teeth
    }

    /// Boundary nodes.
    pub(super) fn nodes(&self) -> &[u32] {
        &self.nodes
    }

    /// Number of the boundary nodes on the first tooth, which come before all others.
    fn of_first_tooth(
        &self,
        gear: &MeshedGear,
        coordinates: &Coordinates,
        options: &ReductionOptions,
    ) -> Result<usize, ReductionError> {
        let own = coordinates.nodes(gear, &self.teeth[..self.teeth.len().min(1)], &options.sides)?;
        if self.nodes.starts_with(&own) { Ok(own.len()) } else { Err(ReductionError::NoSectorOfLayers) }
    }

    /// The window with its compliance.
    pub(super) fn reduced(self, options: &ReductionOptions, compliance: Compliance) -> ReducedGear {
        ReducedGear::new(self.teeth, options.sides.clone(), self.nodes, compliance)
    }
}

/// One sector of a cyclic gear, and the mesh of those about the window if `gear` itself is a sector.
pub(super) fn sectors(
    gear: &MeshedGear,
    turn: Option<&PitchTurn>,
    options: &ReductionOptions,
) -> Result<Option<(SectorMesh, Option<MeshedGear>)>, ReductionError> {
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
