//! The points of the chart: methods to compute a cycle times mesh densities. Each point is a separate scene.

use scene::{Gap, MesherScene, Method, Model, Reduction, Scene};

use super::lumped_scene;

/// A density of the built-in mesher, quadratic elements.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Density {
    /// Elements along the active profile; the other counts follow from it.
    pub profile: u32,
}

impl Density {
    /// The four densities of a full chart; the last one is for the reference.
    pub const ALL: [Self; 4] = [Self { profile: 2 }, Self { profile: 4 }, Self { profile: 8 }, Self { profile: 12 }];
    /// The densities of a quick chart.
    pub const QUICK: [Self; 3] = [Self { profile: 2 }, Self { profile: 3 }, Self { profile: 4 }];

    /// Counts for the transmission error: about those of the default, but half as many in fillet and rim;
    /// `sector_teeth` stays the scene's own.
    fn mesher(self, own: Option<MesherScene>) -> MesherScene {
        let p = self.profile;
        MesherScene {
            order: 2,
            elements_profile: p,
            elements_fillet: (p / 2).max(2),
            // Even, so that nodes lie on the tooth's centre surface, where slice contact cuts it.
            elements_thickness: 2 * p.div_ceil(3),
            elements_face: p.max(2),
            elements_rim: (p / 2).max(2),
            ..own.unwrap_or_default()
        }
    }
}

/// Program that computes a point.
#[derive(Debug, Clone, Copy)]
pub enum Engine {
    /// This program, with the scene edited.
    Own(fn(&mut Scene)),
    /// A cheaper model, with the scene edited: the static pair under load, phase by phase.
    Lumped(fn(&mut Scene)),
    /// CalculiX on the same mesh.
    Calculix,
}

/// Part of a cycle that is run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Share {
    /// Every position.
    Whole,
    /// One or two positions, which take minutes each.
    Part,
}

/// Mesh densities of a method.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Range {
    /// The method has no mesh.
    None,
    /// All densities.
    All,
    /// All densities except that of the reference, which is computed by this method itself.
    BelowReference,
    /// This number of the coarsest densities.
    First(usize),
}

/// A method to compute a cycle: one series of the chart.
#[derive(Debug, Clone, Copy)]
pub struct Way {
    /// Name in tables and legend.
    pub name: &'static str,
    /// Program that computes it.
    pub engine: Engine,
    /// Mesh densities.
    pub range: Range,
    /// Part of the cycle.
    pub share: Share,
}

/// Penalty of the penalty points and of CalculiX's contact, MPa/mm.
pub(super) const PENALTY: f64 = 1e7;

/// The methods, cheapest first. A new method is one more entry.
pub fn ways() -> Vec<Way> {
    let own = |name, range, edit| Way { name, engine: Engine::Own(edit), range, share: Share::Whole };
    let lumped = |name, range, edit| Way { name, engine: Engine::Lumped(edit), range, share: Share::Whole };
    vec![
        own("iso", Range::None, iso),
        lumped("lumped8", Range::None, lumped_scene::lumped8),
        lumped("lumped12", Range::None, lumped_scene::lumped12),
        lumped("shaft18", Range::None, lumped_scene::shaft18),
        lumped("impact", Range::None, lumped_scene::impact),
        lumped(FED, Range::BelowReference, lumped_scene::lumped12_fed),
        SLICE_WAY,
        own("slice, general reduction", Range::BelowReference, slice_general),
        own("nodal", Range::All, nodal),
        own("nodal with penalty", Range::BelowReference, penalty),
        FULL_WAY,
        Way { name: CALCULIX, engine: Engine::Calculix, range: Range::First(2), share: Share::Part },
    ]
}

/// Name of the way that is reduced by sectors where it can be, with slices.
const SLICE: &str = "slice";
/// Name of a cheaper model whose mesh cycle comes from the reduced model.
pub const FED: &str = "lumped12, fed by slice";
/// Name of the method with all degrees of freedom, with which others are compared.
pub const FULL: &str = "full";
/// Name of CalculiX's points.
pub const CALCULIX: &str = "CalculiX";

/// Reduced by sectors where it can be, with slices.
pub(super) const SLICE_WAY: Way =
    Way { name: SLICE, engine: Engine::Own(slice), range: Range::BelowReference, share: Share::Whole };
/// Every degree of freedom.
pub(super) const FULL_WAY: Way =
    Way { name: FULL, engine: Engine::Own(full), range: Range::First(2), share: Share::Part };

fn iso(scene: &mut Scene) {
    scene.analysis.model = Model::Iso;
    scene.modes = None;
    scene.analysis.reduction = None;
}

/// Reduces by cyclic sectors, if the mesh is that of a cyclic gear.
fn reduced(scene: &mut Scene) {
    scene.analysis.model = Model::Reduced;
    scene.modes = None;
    scene.analysis.reduction = Some(Reduction::Auto);
}

pub(super) fn slice(scene: &mut Scene) {
    reduced(scene);
    scene.contact.method = Method::Slice;
    scene.contact.penalty_mpa_per_mm = None;
    scene.contact.gap = None;
    scene.contact.points_per_face_edge = None;
}

fn nodal(scene: &mut Scene) {
    reduced(scene);
    scene.contact.method = Method::Nodal;
    scene.contact.slices = None;
    scene.contact.corner_contact = None;
    scene.contact.penalty_mpa_per_mm = None;
    scene.contact.gap = Some(Gap::Smooth);
}

fn penalty(scene: &mut Scene) {
    nodal(scene);
    scene.contact.penalty_mpa_per_mm = Some(PENALTY);
}

fn full(scene: &mut Scene) {
    slice(scene);
    scene.analysis.model = Model::Full;
    scene.analysis.reduction = None;
}

fn slice_general(scene: &mut Scene) {
    slice(scene);
    scene.analysis.reduction = Some(Reduction::General);
}

/// Slices of the reference over those of the scene.
const FINER: u32 = 2;
/// Slices where the scene says none.
const SLICES: u32 = 32;

/// The reference's way: slices, the scene's number of them doubled.
pub(super) fn reference(scene: &mut Scene) {
    slice(scene);
    scene.contact.slices = Some(FINER * scene.contact.slices.unwrap_or(SLICES));
}

/// One point of the chart.
#[derive(Debug, Clone)]
pub struct Point {
    /// Method of the point.
    pub way: Way,
    /// Mesh of the point; `None` without one.
    pub density: Option<Density>,
    /// Number of positions of the cycle that are run; a divisor of [`Point::positions_asked`].
    pub positions: u32,
    /// Number of positions of the cycle.
    pub positions_asked: u32,
    /// The complete scene of the point.
    pub scene: Scene,
}

impl Point {
    /// The scene computed by one method on one mesh, with at most `part` positions if the method computes a part of the
    /// cycle.
    pub fn new(scene: &Scene, way: Way, density: Option<Density>, part: u32) -> Self {
        let mut own = meshed(scene, density);
        match way.engine {
            Engine::Own(edit) | Engine::Lumped(edit) => edit(&mut own),
            // It takes the whole meshes, as `full` does.
            Engine::Calculix => full(&mut own),
        }
        let positions_asked = scene.analysis.positions_per_cycle;
        let positions = match way.share {
            Share::Whole => positions_asked,
            Share::Part => (1..=part).rev().find(|n| positions_asked.is_multiple_of(*n)).unwrap_or(1),
        };
        own.analysis.positions_per_cycle = positions;
        own.analysis.cycles = 1;
        own.output.root_stress = false;
        own.output.contact_lines = false;
        own.output.vtu = false;
        Self { way, density, positions, positions_asked, scene: own }
    }
}

/// The scene with both gears made by the built-in mesher at a density.
pub(super) fn meshed(scene: &Scene, density: Option<Density>) -> Scene {
    let mut own = scene.clone();
    let Some(density) = density else { return own };
    for gear in [&mut own.pinion, &mut own.wheel] {
        gear.mesher = Some(density.mesher(gear.mesher));
        gear.mesh = None;
        gear.groups = mesh::GroupNames::default();
    }
    own
}

/// Densities of a way among those of a chart, coarse to fine.
pub(super) fn densities(way: &Way, all: &[Density]) -> Vec<Option<Density>> {
    let count = match way.range {
        Range::None => return vec![None],
        Range::All => all.len(),
        Range::BelowReference => all.len().saturating_sub(1),
        Range::First(n) => n.min(all.len()),
    };
    all[..count].iter().copied().map(Some).collect()
}
