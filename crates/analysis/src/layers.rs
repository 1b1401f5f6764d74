//! Wide gears that are condensed by their layers: when this is used, and the number of layers.

use geometry::{Gear, GearData};
use mesh::{BoreCoupling, Extent, GroupNames, MeshedGear, StructuredOptions, generate};
use reduction::{LayerStack, ReductionOptions};
use scene::{Method, Model, Scene};

use crate::meshes::{BUILT_IN, SceneMesh, options_of};

/// Width that tells of the middle of a gear, over the distance from its bore to its tips: a force moves nothing beyond
/// half of it, and end faces beyond half of it change nothing.
const DEPTHS: f64 = 4.5;
/// Layers at least.
const LEAST: usize = 12;
/// Times as many layers from which on fewer of them are condensed: below, the whole gear costs about as much.
const MORE: f64 = 1.2;

/// The shorter gear that is condensed in the place of a wide one, and what it stands for; `None` where a gear is condensed
/// as a whole: not made by the built-in mesher, not held along its whole bore, not wide, or fields of it are asked for.
pub(crate) fn shorter_gear(
    scene: &Scene,
    exact: &Gear,
    mesh: &SceneMesh,
    options: &ReductionOptions,
    i: usize,
) -> Option<(MeshedGear, LayerStack)> {
    let (gear, whole) = (scene.gears()[i], &mesh.gear);
    let asked = scene.analysis.model == Model::Reduced
        && scene.motion.is_none()
        && scene.contact.method == Method::Slice
        && !scene.analysis.is_general()
        && !scene.output.root_stress
        && !scene.output.vtu;
    let held = gear.bore.held_mm.is_none() && whole.bore_coupling() == BoreCoupling::Kinematic;
    if !asked
        || !held
        || !mesh.facts.source.starts_with(BUILT_IN)
        || !whole.is_periodic_sector()
        || options.sides.len() != 1
    {
        return None;
    }
    let (data, made) = (exact.data(), options_of(gear));
    let layers = made.elements_face as usize;
    let layer = data.face_width / layers as f64;
    let depth = (exact.tip_radius() - 0.5 * data.bore_diameter).abs();
    let condensed = ((DEPTHS * depth / layer).ceil() as usize).max(LEAST);
    if MORE * condensed as f64 > layers as f64 {
        return None;
    }
    let short = Gear::new(GearData { face_width: layer * condensed as f64, ..data.clone() }).ok()?;
    let made = StructuredOptions { elements_face: condensed as u32, extent: Extent::Periodic, ..made };
    let (short, _) = MeshedGear::find(generate(&short, &made).ok()?, &short, &GroupNames::default()).ok()?;
    // Nodes of one cut are those of the other in the next copy.
    let on_cut = whole.cuts().map(|[cut, _]| cut.nodes()).unwrap_or_default();
    let held = whole.held_nodes();
    let held_on_cut = on_cut.iter().filter(|n| held.binary_search(n).is_ok()).count();
    let free = whole.mesh().nodes.len() - on_cut.len() - (held.len() - held_on_cut);
    let free_count = 3 * whole.tooth_count() as usize * free;
    Some((short, LayerStack { layers, condensed, free_count }))
}
