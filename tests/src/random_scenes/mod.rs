//! Random scenes over the whole documented range of every key, of all models, at rest and in time.
//!
//! A scene is determined by its seed and its number alone. It is small: few elements, positions, steps and cycles, so
//! that nearly all are solved within a second.
//!
//! | module | what it draws or says |
//! |---|---|
//! | `draft` | chance, keys with values, files beside the scene |
//! | `gears`, `rings`, `meshes`, `flanks` | the pair: geometry, material, errors; internal pairs; its meshes; its micro-geometry |
//! | `model`, `question` | which model; load, contact, positions, files |
//! | `rating` | whether it will hold |
//! | `motion`, `cheaper` | motion in time; the models with few coordinates |
//! | `machines`, `plans` | gearboxes; plans over a random pair |
//! | `whole_range` | any key of the schema over its whole range |
//! | `laws` | laws that no model may break: the same scene told in another way |
//! | `mirror`, `size`, `exchange`, `driver`, `lead` | one of them each |
//! | `told`, `headline` | a scene told again; headlines of two results that ought to agree |
//! | `attempt` | the program run on one scene in a process of its own, within limits of time and memory |
//! | `trial` | a scene solved and judged, and held against a law |
//! | `judge`, `balance`, `case`, `csv` | what must hold of the files of a result |
//! | `refusals` | which reasons of refusals are known, and whether they are true |
//! | `verdict` | what became of a scene, as a line of JSON, and the table of all |

mod attempt;
mod balance;
mod case;
mod cheaper;
mod csv;
mod draft;
mod driver;
mod exchange;
mod flanks;
mod gears;
mod headline;
mod judge;
mod laws;
mod lead;
mod machines;
mod meshes;
mod mirror;
mod model;
mod motion;
mod plans;
mod question;
mod rating;
mod refusals;
mod rings;
mod size;
mod told;
mod trial;
mod verdict;
mod whole_range;

pub use attempt::{Attempt, Limits};
pub use csv::Csv;
pub use draft::Draft;
pub use machines::draw_gearbox;
pub use plans::draw_plan;
pub use refusals::{Refusals, matches};
pub use size::power;
pub use trial::try_scene;
pub use verdict::{Outcome, Tally, Verdict};
pub use whole_range::keys_of_schema;

use model::Asked;

/// Share of scenes with keys of the whole schema on top.
const ANYTHING: f64 = 0.2;
/// Share of scenes on meshes of other programs.
const FOREIGN: f64 = 0.08;

/// A scene with the files that it names.
#[derive(Debug)]
pub struct RandomScene {
    /// Keys, values, files.
    pub draft: Draft,
    /// Word of its model.
    pub model: &'static str,
    /// Whether any key of the schema was set on top of a scene that fits together.
    pub anything: bool,
    /// Whether its meshes come from files.
    pub foreign: bool,
}

/// Draws a document of a seed and a number.
pub type Drawer = fn(u64, u64) -> RandomScene;

/// Kinds of documents that are drawn, and how.
pub const KINDS: [(&str, Drawer); 3] = [("pairs", draw), ("gearboxes", draw_gearbox), ("plans", draw_plan)];

/// How documents of a kind are drawn.
///
/// # Errors
/// For a word that is none of [`KINDS`].
pub fn drawer(kind: &str) -> Result<Drawer, String> {
    let found = KINDS.iter().find(|(name, _)| *name == kind).map(|(_, draw)| *draw);
    found.ok_or_else(|| format!("`{kind}`: {} are drawn", KINDS.map(|(name, _)| name).join(", ")))
}

/// Scene number `index` of a seed.
pub fn draw(seed: u64, index: u64) -> RandomScene {
    let mut d = Draft::new(seed, index);
    let asked = model::draw_model(&mut d);
    let foreign = asked.meshed && d.chance(FOREIGN);
    // The factor of all degrees of freedom takes minutes for gears of many teeth.
    let most_teeth = if asked.model == "full" { 24.0 } else { 2000.0 };
    let sizes = if foreign { meshes::draw_foreign(&mut d) } else { gears::draw_pair(&mut d, most_teeth) };
    if asked.meshed && !foreign {
        meshes::draw_mesher(&mut d, &sizes, asked.model != "full");
    }
    gears::draw_materials(&mut d);
    if asked.ground {
        of_flanks(&mut d, &sizes, &asked);
    }
    question::draw_operation(&mut d, &sizes, &asked);
    question::draw_contact(&mut d, &asked);
    question::draw_analysis(&mut d, &sizes, &asked);
    if asked.in_time {
        motion::draw_motion(&mut d, &sizes, &asked);
        cheaper::draw_cheaper(&mut d, &sizes, &asked);
    }
    question::draw_output(&mut d, &asked);
    question::draw_accuracy(&mut d, &asked);
    question::draw_derivatives(&mut d, &asked);
    if asked.meshed && !foreign {
        gears::draw_faces_and_bores(&mut d, &sizes);
    }
    let anything = d.chance(ANYTHING);
    if anything {
        let keys = keys_of_schema();
        for _ in 0..d.whole(1, 3) {
            whole_range::draw_any_key(&mut d, keys);
        }
    }
    // Last, so that all other scenes of a seed stay what they are.
    if !anything && !foreign {
        rings::draw_ring(&mut d, &asked);
        rating::draw_rating(&mut d, &asked);
    }
    RandomScene { draft: d, model: asked.model, anything, foreign }
}

fn of_flanks(d: &mut Draft, sizes: &gears::Sizes, asked: &Asked) {
    if d.chance(0.4) {
        flanks::draw_modifications(d, sizes);
    }
    if asked.meshed && d.chance(0.25) {
        gears::draw_misalignment(d, sizes);
    }
    // Lists of hundreds of numbers are no small scenes.
    if d.chance(0.1) && sizes.teeth.iter().all(|z| *z <= 300) {
        gears::draw_pitch_errors(d, sizes);
    }
}
