//! A scene with its changes, solved, as the page takes it.

use std::{
    collections::BTreeMap,
    ops::ControlFlow,
    path::Path,
    sync::{Arc, Mutex, PoisonError},
};

use analysis::{
    AnalysisError, GearCache, Interest, RemarksAtRest, RestRequest, SharedGears, SharedModels, SolvedAtRest,
    accuracy::GearMemo,
    lumped::is_lumped,
    optimum::{Evaluated, optimise},
    results::{StaticHeadline, patterns, static_headline},
    solve_at_rest,
};
use answer::shown_units;
use export::view::View;
use ltca::StaticHistory;
use report::{
    charts::{LineChart, contact_pattern_maps},
    static_charts,
};
use scene::{
    Document, DocumentKind, Model, Scene,
    gearbox::Gearbox,
    optimum::{DesignParameter, Optimisation, OptimisationWords},
};
use serde::{Deserialize, Serialize};
use store::check_memory;

use crate::{
    fault::Fault,
    form::is_text,
    gearbox::{self, SolvedGearbox},
    outcome::Outcome,
    scene_text::{changed, flat},
    sliders::{Slider, completed, short, sliders, sliders_of_gearbox, with_starts},
};

/// What the machine says of itself.
#[derive(Debug, Clone, Copy)]
pub struct Machine {
    /// Memory that is free, bytes.
    pub free_bytes: fn() -> f64,
    /// Time since some moment, ms.
    pub clock_ms: fn() -> f64,
}

/// A move of the page, as JSON: the text of its scene, and all that is set otherwise by hand.
#[derive(Debug, Deserialize)]
pub struct Change {
    /// Number of the page.
    pub page: u64,
    /// Moves of a page are numbered as they are made.
    pub number: u64,
    text: String,
    /// Keys with dots, values as they are typed; nothing takes a key away.
    #[serde(default)]
    set: BTreeMap<String, String>,
    /// Keys that a search may move between two ends, so that the transmission error is flattest; none: no search.
    #[serde(default)]
    search: BTreeMap<String, [f64; 2]>,
}

/// What a search has found.
#[derive(Debug, Serialize)]
struct Sought {
    /// Values of the keys, as they are typed.
    set: BTreeMap<String, String>,
    /// Peak to peak of the static transmission error before and after, um.
    peak_to_peak_um: [f64; 2],
    evaluations: usize,
}

/// What the page gets.
#[derive(Debug, Serialize)]
struct Answer<'a> {
    number: u64,
    /// The scene with what was set, to copy out.
    text: &'a str,
    /// Keys of the scene as they are written.
    written: BTreeMap<String, String>,
    /// All keys, defaults filled in.
    effective: BTreeMap<String, String>,
    sliders: &'a [Slider],
    #[serde(skip_serializing_if = "Option::is_none")]
    sought: Option<Sought>,
    #[serde(skip_serializing_if = "Option::is_none")]
    fault: Option<Fault>,
    #[serde(skip_serializing_if = "Option::is_none")]
    result: Option<Outcome<'a>>,
}

/// What a document describes.
pub(crate) enum Subject {
    Pair(Box<Scene>),
    Gearbox(Box<Gearbox>),
}

/// Where scenes are tried, all on the same reduced gears.
pub struct Session<'a> {
    start: &'a str,
    /// The text that was read last, with the files that it names.
    last: Mutex<Document>,
    machine: Machine,
    models: SharedModels<'a>,
    /// Reduced gears of gearboxes.
    gears: GearMemo<'a>,
    schema: serde_json::Value,
}

/// What a move asks for: [`Session::take`].
pub struct Taken {
    /// The scene with what is set by hand.
    text: String,
    /// Sliders of the scene before.
    sliders: Vec<Slider>,
    /// The document checked, or what is wrong with it.
    subject: Result<Subject, Fault>,
    /// What a search may move.
    search: BTreeMap<String, [f64; 2]>,
}

impl Taken {
    /// What its gears have in common with others; `None` of a scene that is none.
    pub fn gears(&self) -> Option<Arc<SharedGears>> {
        match &self.subject {
            Ok(Subject::Pair(scene)) => Some(Arc::new(SharedGears::of(scene))),
            Ok(Subject::Gearbox(_)) | Err(_) => None,
        }
    }
}

/// A document as it was solved.
enum Solved {
    /// A scene, its positions, and the time that took, ms.
    Pair(Box<(Scene, StaticHistory, f64)>),
    Gearbox(Box<SolvedGearbox>),
}

impl std::fmt::Debug for Session<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Session").field("start", &self.start).finish_non_exhaustive()
    }
}

impl std::fmt::Debug for Taken {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Taken").field("text", &self.text).finish_non_exhaustive()
    }
}

impl<'a> Session<'a> {
    /// With the text of a scene to begin with.
    pub fn new(start: &'a str, file: &Path, machine: Machine, cache: &'a dyn GearCache) -> Self {
        let (models, schema) = (SharedModels::new(cache), scene::json_schema()["$defs"]["pair"].take());
        let last = Mutex::new(Document::new(start.to_owned(), file));
        Self { start, last, machine, models, gears: GearMemo::new(cache), schema }
    }

    /// The scene to begin with, where this page can show it.
    pub fn first_scene(&self) -> Option<Scene> {
        match self.subject(self.start) {
            Ok(Subject::Pair(scene)) => Some(*scene),
            Ok(Subject::Gearbox(_)) | Err(_) => None,
        }
    }

    /// Reduces the gears of a scene for those that come.
    pub fn warm(&self, scene: &Scene, interest: Interest<'_>) {
        if self.fits(scene).is_ok() {
            let _ = self.at_rest(scene, interest);
        }
    }

    /// The scene that a move asks for.
    pub fn take(&self, change: &Change) -> Taken {
        let before = flat(&change.text);
        let moved = match self.subject(&change.text) {
            Ok(Subject::Pair(scene)) => {
                scene.gear_pair().map_or_else(|_| Vec::new(), |pair| sliders(&scene, &pair, &before))
            }
            Ok(Subject::Gearbox(file)) => sliders_of_gearbox(&file, &before),
            Err(_) => Vec::new(),
        };
        let wanted = with_starts(&change.set, &change.search, &before);
        let set = completed(&wanted, &moved, &before);
        let (text, refused) = match changed(&change.text, &set, |key| is_text(&self.schema, key)) {
            Ok(text) => (text, None),
            Err(fault) => (change.text.clone(), Some(fault)),
        };
        let subject = match refused {
            None => self.subject(&text),
            Some(fault) => Err(fault),
        };
        Taken { text, sliders: moved, subject, search: change.search.clone() }
    }

    /// The text of a scene with the values at which its transmission error is flattest; `None` where nobody waits for it
    /// any more.
    fn sought(
        &self,
        text: &str,
        search: &BTreeMap<String, [f64; 2]>,
        interest: Interest<'_>,
    ) -> Result<Option<(String, Sought)>, Fault> {
        let words: Vec<String> = search.iter().map(|(key, [from, to])| format!("{key}={from:?}:{to:?}")).collect();
        let words = OptimisationWords { parameters: &words, evaluations: EVALUATIONS, ..OptimisationWords::default() };
        let plan = Optimisation::of_scene(self.document(text), &[], &words).map_err(|e| Fault::of_scene(text, &e))?;
        self.fits(&plan.drawn)?;
        let goes_on = |_: Evaluated, _: Option<f64>| {
            if (interest.positions)() { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
        };
        let found = match optimise(&self.models, &plan, goes_on) {
            Ok(found) => found,
            Err(AnalysisError::Cancelled) => return Ok(None),
            Err(e) => return Err(Fault::of_analysis(text, &e)),
        };
        let value = |(own, value): (&DesignParameter, &f64)| (own.name().to_owned(), short(*value));
        let set: BTreeMap<String, String> = plan.parameters.iter().zip(&found.values).map(value).collect();
        let start = found.found.steps.first().and_then(|step| step.goal).unwrap_or_default();
        let peak_to_peak_um = [start, found.plan.goal.value(&found.evaluation.curves)];
        let moved = changed(text, &set, |key| is_text(&self.schema, key))?;
        Ok(Some((moved, Sought { set, peak_to_peak_um, evaluations: found.found.steps.len() })))
    }

    /// The answer to a move as JSON; `None` where nobody waits for it any more.
    pub fn answer(&self, number: u64, taken: Taken, interest: Interest<'_>) -> Option<Vec<u8>> {
        let Taken { mut text, sliders, mut subject, search } = taken;
        let mut sought = None;
        if subject.is_ok() && !search.is_empty() {
            match self.sought(&text, &search, interest) {
                Ok(None) => return None,
                Ok(Some((moved, found))) => {
                    subject = self.subject(&moved);
                    (text, sought) = (moved, Some(found));
                }
                Err(fault) => subject = Err(fault),
            }
        }
        let effective = match &subject {
            Ok(Subject::Pair(scene)) => flat(&scene.to_toml()),
            Ok(Subject::Gearbox(file)) => gearbox::effective(file),
            Err(_) => BTreeMap::new(),
        };
        let solved = match subject.and_then(|subject| self.solved(&text, &subject, interest)) {
            Ok(None) => return None,
            Ok(Some(solved)) => Ok(solved),
            Err(fault) => Err(fault),
        };
        let answer = Answer {
            number,
            text: &text,
            written: flat(&text),
            effective,
            sliders: &sliders,
            sought,
            fault: None,
            result: None,
        };
        Some(match &solved {
            Ok(Solved::Pair(solved)) => shown(answer, &text, solved),
            Ok(Solved::Gearbox(solved)) => json(&Answer { result: Some(solved.outcome()), ..answer }),
            Err(fault) => json(&Answer { fault: Some(fault.clone()), ..answer }),
        })
    }

    /// What a text describes, checked, where this page can show it.
    fn subject(&self, text: &str) -> Result<Subject, Fault> {
        let document = self.document(text);
        if document.base_kind() == Some(DocumentKind::Gearbox) {
            let file = document.gearbox(&[]).map_err(|e| Fault::of_scene(text, &e))?;
            return Ok(Subject::Gearbox(Box::new(file)));
        }
        let scene = document.scene(&[]).map_err(|e| Fault::of_scene(text, &e))?;
        if scene.motion.is_some() || is_lumped(&scene) {
            let fault = Fault::new("this page shows a pair at rest, and the scene asks for a motion", AT_REST);
            return Err(fault.about(if is_lumped(&scene) { "analysis.model" } else { "analysis.kind" }));
        }
        if scene.analysis.model == Model::Full {
            let fault = Fault::new("the model \"full\" takes minutes a position, and this page follows the hand", HELD);
            return Err(fault.about("analysis.model"));
        }
        Ok(Subject::Pair(Box::new(scene)))
    }

    /// The text with the files that it names, of which those of the text before are not read again.
    fn document(&self, text: &str) -> Document {
        let mut last = self.last.lock().unwrap_or_else(PoisonError::into_inner);
        *last = last.edited(text.to_owned());
        last.clone()
    }

    /// Whether memory holds what a scene needs, now.
    fn fits(&self, scene: &Scene) -> Result<(), Fault> {
        check_memory(scene, (self.machine.free_bytes)()).map(drop).map_err(|e| Fault::of_memory(&e))
    }

    fn solved(&self, text: &str, subject: &Subject, interest: Interest<'_>) -> Result<Option<Solved>, Fault> {
        let scene = match subject {
            Subject::Pair(scene) => scene,
            Subject::Gearbox(file) => {
                file.meshes.iter().try_for_each(|mesh| self.fits(&mesh.scene))?;
                let start = (self.machine.clock_ms)();
                let solved = gearbox::solved(text, file, &self.gears, interest)?;
                let solve_ms = (self.machine.clock_ms)() - start;
                return Ok(solved.map(|solved| Solved::Gearbox(Box::new(solved.within(solve_ms)))));
            }
        };
        self.fits(scene)?;
        let start = (self.machine.clock_ms)();
        match self.at_rest(scene, interest) {
            Ok(SolvedAtRest { scene, history, .. }) => {
                Ok(Some(Solved::Pair(Box::new((scene, history, (self.machine.clock_ms)() - start)))))
            }
            Err(AnalysisError::Cancelled) => Ok(None),
            Err(e) => Err(Fault::of_analysis(text, &e)),
        }
    }

    /// A scene at rest on the models that are kept; the page shows no derivatives.
    fn at_rest(&self, scene: &Scene, interest: Interest<'_>) -> Result<SolvedAtRest, AnalysisError> {
        let mut scene = scene.clone();
        scene.output.derivatives.clear();
        solve_at_rest(
            &scene,
            &self.models,
            RestRequest { interest, ..RestRequest::to_the_end(RemarksAtRest::Collected) },
        )
    }
}

/// Evaluations of a search at the most.
const EVALUATIONS: u32 = 30;

const AT_REST: &str = "take `kind = \"static\"` and `model = \"reduced\"` in [analysis]; `ale-gear run` solves motions";
const HELD: &str = "take `model = \"reduced\"` in [analysis]; `ale-gear run` solves it";

/// The answer with all that is drawn of a solved scene.
fn shown(answer: Answer<'_>, text: &str, (scene, history, solve_ms): &(Scene, StaticHistory, f64)) -> Vec<u8> {
    let drawn = || -> Result<_, Fault> {
        let statistics = |e: study::StudyError| Fault { hint: e.hint(), ..Fault::new(e.to_string(), "") };
        let pair = scene.gear_pair().map_err(|e| Fault::of_scene(text, &e))?;
        let headline = static_headline(scene, history).map_err(statistics)?;
        let maps = if scene.has_slices() {
            contact_pattern_maps(&patterns(scene, &pair, &history.positions).map_err(statistics)?).into()
        } else {
            Vec::new()
        };
        Ok((View::of_history(scene, &pair, history), headline, maps))
    };
    let (view, headline, maps) = match drawn() {
        Ok(drawn) => drawn,
        Err(fault) => return json(&Answer { fault: Some(fault), ..answer }),
    };
    let charts = static_charts(scene, history, &headline.ste_harmonics_um);
    let result = Outcome {
        name: &scene.name,
        solve_ms: *solve_ms,
        headline: held(&headline),
        glance: glance(scene, &headline),
        charts: charts.iter().map(LineChart::plot).collect(),
        maps,
        view: Some(view),
        remarks: history.remarks.iter().map(|said| shown_units(&said.to_string())).collect(),
    };
    json(&Answer { result: Some(result), ..answer })
}

/// The headline as a run has it but for tooth changes: a run looks for the one that closes its last cycle as well.
fn held(headline: &StaticHeadline) -> serde_json::Value {
    let mut all = serde_json::to_value(headline).unwrap_or_default();
    if let Some(numbers) = all.as_object_mut() {
        numbers.retain(|key, _| !key.starts_with("tooth_change"));
    }
    all
}

/// The numbers that a hand follows.
fn glance(scene: &Scene, headline: &StaticHeadline) -> Vec<[String; 2]> {
    let mesh_hz = scene.pinion_speed() / std::f64::consts::TAU * f64::from(scene.pinion.teeth);
    let harmonic = headline.ste_harmonics_um.first().copied().unwrap_or(f64::NAN);
    let mut rows = vec![
        ("peak-to-peak STE", format!("{:.3} um", headline.peak_to_peak_ste_um)),
        ("first mesh harmonic of STE", format!("{harmonic:.3} um")),
        ("mean STE", format!("{:.2} um", headline.mean_ste_um)),
        ("mean mesh stiffness", format!("{:.0} N/um", headline.mean_mesh_stiffness_n_per_um)),
        ("largest pressure", format!("{:.0} MPa", headline.max_pressure_mpa)),
        ("largest force of a pair", format!("{:.0} N", headline.max_pair_force_n)),
    ];
    if let Some(factor) = headline.face_load_factor {
        rows.push(("face load factor", format!("{factor:.3}")));
    }
    rows.push(("mesh frequency", format!("{mesh_hz:.0} Hz")));
    rows.into_iter().map(|(what, value)| [what.to_owned(), shown_units(&value)]).collect()
}

/// Numbers, texts and lists: JSON refuses none of them.
fn json(answer: &Answer<'_>) -> Vec<u8> {
    serde_json::to_vec(answer).unwrap_or_default()
}
