//! An optimisation of headline values of a pair or a gearbox, in statics or in time; derivatives are computed by
//! differences.

use std::{
    f64::consts::FRAC_1_PI,
    path::{Path, PathBuf},
};

use super::{
    DesignParameter,
    check::{parameters, settings, words as listed},
    file::varied,
    schema::{EVALUATIONS, RawOptimisation},
    words::{OptimisationWords, parameter},
};
use toml::Spanned;

use crate::{Document, Machine, Scene, SceneError, Setting, Source, gearbox::Gearbox, plan::PlanOutput, setting::path};

/// A pair or a gearbox, its parameters, and the headline values to be minimised.
#[derive(Debug, Clone)]
pub struct NumberOptimisation {
    /// Title.
    pub name: String,
    /// Path of the file; the path of the document is relative to its folder.
    pub file: PathBuf,
    /// Document of the pair or the gearbox.
    pub document: Document,
    /// Keys that are set to other values in all designs.
    pub settings: Vec<Setting>,
    /// Parameters of the design.
    pub parameters: Vec<DesignParameter>,
    /// Values whose mean magnitude is minimised; at least one.
    pub goals: Vec<PlanOutput>,
    /// Values with upper limits.
    pub limits: Vec<NumberLimit>,
    /// Loads under which they are evaluated; at least one.
    pub loads: Vec<NumberLoad>,
    /// Largest number of evaluations. Each solves the design and one neighbour per parameter, under every load.
    pub evaluations: u32,
}

/// A load under which values are evaluated.
#[derive(Debug, Clone, PartialEq)]
pub struct NumberLoad {
    /// Torque on the driven gear of a pair, or the first torque of a gearbox, N m.
    pub torque_nm: f64,
    /// Settings that apply it to the document; empty for the document's own load.
    pub settings: Vec<Setting>,
}

/// A value and its limit.
#[derive(Debug, Clone, PartialEq)]
pub struct NumberLimit {
    /// The value.
    pub output: PlanOutput,
    /// Upper limit, above 0, in the unit of its key.
    pub most: f64,
}

/// Step of a difference over the range of a parameter: far above the round-off of a solve, far below what bends a curve.
const STEP: f64 = 1e-3;

impl NumberOptimisation {
    /// The optimisation of a document given by words of a command line.
    ///
    /// # Errors
    /// [`SceneError`]: the first error, with the word that it concerns.
    pub fn of_scene(
        document: Document,
        settings: &[Setting],
        words: &OptimisationWords<'_>,
    ) -> Result<Self, SceneError> {
        let wrong = |label: String, what: &str| SceneError::Setting { label, what: what.to_owned() };
        let beside = [
            ("--measure", words.measure.is_some()),
            ("--max-pressure", words.max_pressure_mpa.is_some()),
            ("--max-edge-pressure", words.max_edge_pressure_mpa.is_some()),
            ("--front", words.front > 0),
        ];
        if let Some((word, _)) = beside.into_iter().find(|(_, given)| *given) {
            return Err(wrong(word.into(), "goes with the transmission error of a pair, not with `--goal`"));
        }
        let own = document.machine(settings)?;
        let known = |key: &str| number_at((&document, settings), &own, key);
        let mut parameters = Vec::new();
        for word in words.parameters {
            let complain = |what: String| wrong(format!("--vary {word}"), &what);
            parameters.push(parameter(word, known).map_err(complain)?);
        }
        if parameters.is_empty() {
            return Err(wrong("--vary".into(), "names no key that may change: say `--vary KEY=FROM:TO`"));
        }
        let limit = |word: &String| limit(word).map_err(|what| wrong(format!("--limit {word}"), &what));
        let limits = words.limits.iter().map(limit).collect::<Result<Vec<_>, _>>()?;
        let goal = |word: &String| PlanOutput::parse(word).map_err(|what| wrong(format!("--goal {word}"), &what));
        let goals = words.goals.iter().map(goal).collect::<Result<Vec<_>, _>>()?;
        let evaluations = words.evaluations.clamp(1, EVALUATIONS[1]);
        let (name, file) = (document.stem(), document.file().to_owned());
        let loads = loads(&own, words.torques_nm).map_err(|what| wrong("--torques".into(), &what))?;
        Self { name, file, document, settings: settings.to_vec(), parameters, goals, limits, loads, evaluations }
            .finish()
    }

    /// What the whole must be: every key is there once and changes something, and the start is a machine.
    fn finish(self) -> Result<Self, SceneError> {
        let wrong =
            |what: String, advice: &str| SceneError::Asked { file: self.file.clone(), what, advice: advice.to_owned() };
        let mut keys: Vec<&str> = self.parameters.iter().flat_map(|p| &p.keys).map(String::as_str).collect();
        keys.sort_unstable();
        if let Some(twice) = keys.windows(2).find(|pair| pair[0] == pair[1]) {
            return Err(wrong(format!("changes `{}` twice", twice[0]), "name each key once, with one pair of bounds"));
        }
        let plain = |machine: Machine| match machine {
            Machine::Pair(scene) => Machine::Pair(Box::new(Scene { set: Vec::new(), ..*scene })),
            Machine::Gearbox(mut file) => {
                file.meshes.iter_mut().for_each(|mesh| mesh.scene.set.clear());
                Machine::Gearbox(Box::new(Gearbox { set: Vec::new(), ..*file }))
            }
        };
        let start = plain(self.machine(&self.start())?);
        for (k, parameter) in self.parameters.iter().enumerate() {
            let mut values = self.start();
            values[k] = if values[k] == parameter.bounds[0] { parameter.bounds[1] } else { parameter.bounds[0] };
            let between = values[k] + FRAC_1_PI * (self.start()[k] - values[k]);
            let at = |value: f64| {
                self.machine(
                    &values.iter().enumerate().map(|(i, x)| if i == k { value } else { *x }).collect::<Vec<_>>(),
                )
            };
            if let (true, Err(SceneError::WrongType { .. })) = (between.fract() != 0.0, at(between)) {
                let advice = format!(
                    "list its values: `ale-gear vary {} --out DIR --vary {}=A,B,C`",
                    self.file.display(),
                    parameter.name()
                );
                return Err(wrong(format!("changes `{}`, which is a whole number", parameter.name()), &advice));
            }
            if plain(self.machine(&values)?) == start {
                let advice = "name a key that acts on this machine, within other bounds";
                return Err(wrong(format!("changes `{}`, which changes nothing", parameter.name()), advice));
            }
        }
        Ok(self)
    }

    /// All values that are evaluated: goals, then limits.
    pub fn outputs(&self) -> Vec<PlanOutput> {
        self.goals.iter().cloned().chain(self.limits.iter().map(|limit| limit.output.clone())).collect()
    }

    /// Names of the goals without indices of entries; their endings give the units.
    pub fn goal_names(&self) -> impl Iterator<Item = &str> {
        self.goals.iter().map(|output| match output {
            PlanOutput::Headline(key) => key.split('.').rfind(|part| part.parse::<usize>().is_err()).unwrap_or(key),
            PlanOutput::Column { column, .. } => column,
        })
    }

    /// Path of the file of the pair or the gearbox.
    pub fn scene_file(&self) -> &Path {
        self.document.file()
    }

    /// Initial values of the search.
    pub fn start(&self) -> Vec<f64> {
        self.parameters.iter().map(|p| p.start).collect()
    }

    /// Settings of a design in addition to the document.
    ///
    /// # Errors
    /// [`SceneError::Setting`] for an unknown key.
    pub fn settings_of(&self, values: &[f64]) -> Result<Vec<Setting>, SceneError> {
        let each = self.parameters.iter().zip(values);
        let own = each.flat_map(|(p, value)| p.keys.iter().map(move |key| varied(key, *value)));
        self.settings.iter().cloned().map(Ok).chain(own).collect()
    }

    /// The pair or the gearbox of a design.
    ///
    /// # Errors
    /// [`SceneError`] if the document does not permit the values.
    pub fn machine(&self, values: &[f64]) -> Result<Machine, SceneError> {
        self.document.machine(&self.settings_of(values)?)
    }

    /// The pair or the gearbox of a design under a load.
    ///
    /// # Errors
    /// [`SceneError`] if the document does not permit the values.
    pub fn machine_under(&self, values: &[f64], load: &NumberLoad) -> Result<Machine, SceneError> {
        let mut settings = self.settings_of(values)?;
        settings.extend(load.settings.iter().cloned());
        self.document.machine(&settings)
    }

    /// The neighbouring design, one difference away along a parameter and within its bounds; and the difference.
    pub fn beside(&self, values: &[f64], parameter: usize) -> (Vec<f64>, f64) {
        let [lowest, highest] = self.parameters[parameter].bounds;
        let step = STEP * (highest - lowest);
        let step = if values[parameter] + step <= highest { step } else { -step };
        let mut beside = values.to_vec();
        beside[parameter] += step;
        (beside, step)
    }
}

/// The words of an optimisation of numbers.
///
/// # Errors
/// [`SceneError`]: the first complaint, with its place.
pub(super) fn numbers(
    s: &Source<'_>,
    raw: &RawOptimisation,
    (document, more): (Document, &[Setting]),
) -> Result<NumberOptimisation, SceneError> {
    let asked = &raw.optimise;
    let beside = [
        ("measure", asked.measure.is_some()),
        ("harmonics", asked.harmonics.is_some()),
        ("weights", asked.weights.is_some()),
        ("max_pressure_mpa", asked.max_pressure_mpa.is_some()),
        ("max_edge_pressure_mpa", asked.max_edge_pressure_mpa.is_some()),
        ("front", asked.front.is_some()),
        ("quantile", asked.quantile.is_some()),
        ("tolerances", asked.tolerances.is_some()),
        ("design", asked.design.is_some()),
        ("samples", asked.samples.is_some()),
        ("seed", asked.seed.is_some()),
    ];
    if let Some((key, _)) = beside.into_iter().find(|(_, given)| *given) {
        let what = format!("`{key}` goes with the transmission error of a pair, not with `goal`");
        return Err(s.conflict(&(0..0), what, "leave one of both out"));
    }
    let settings = settings(s, raw, more)?;
    let own = document.machine(&settings)?;
    let parameters = parameters(s, asked, |key| number_at((&document, &settings), &own, key))?;
    if parameters.is_empty() {
        return Err(s.conflict(&(0..0), "nothing may change", "say `keys = [\"KEY=FROM:TO\"]` in [optimise]"));
    }
    let word = |word: &Spanned<String>, what: String| s.conflict(&word.span(), what, "see [optimise] in docs/scene.md");
    let goals = listed(&asked.goal).iter().map(|w| PlanOutput::parse(w.get_ref()).map_err(|what| word(w, what)));
    let goals = goals.collect::<Result<Vec<_>, _>>()?;
    let limits = listed(&asked.limit).iter().map(|w| limit(w.get_ref()).map_err(|what| word(w, what)));
    let limits = limits.collect::<Result<Vec<_>, _>>()?;
    let evaluations = s.whole("evaluations", &asked.evaluations, EVALUATIONS[0], 1, EVALUATIONS[1])?;
    let (name, file) = (s.title(&raw.name)?, s.file.to_owned());
    let asked_nm = asked.torques_nm.as_ref().map_or(&[][..], |list| list.get_ref());
    let asked_nm: Vec<f64> = asked_nm.iter().map(|own| *own.get_ref()).collect();
    let at = asked.torques_nm.as_ref().map_or(0..0, Spanned::span);
    let loads = loads(&own, &asked_nm).map_err(|what| s.conflict(&at, what, "give torques in N m"))?;
    NumberOptimisation { name, file, document, settings, parameters, goals, limits, loads, evaluations }.finish()
}

/// Loads of some torques (N m), of a gearbox on the first `[[torque]]` with all others in proportion; without any the
/// machine's own load.
fn loads(machine: &Machine, torques_nm: &[f64]) -> Result<Vec<NumberLoad>, String> {
    let own: Vec<(String, f64)> = match machine {
        Machine::Pair(scene) => vec![("operation.torque_nm".to_owned(), scene.operation.torque_nm)],
        Machine::Gearbox(file) => {
            let torques = file.torques.iter().enumerate();
            torques.map(|(i, own)| (format!("torque.{i}.torque_nm"), 1e-3 * own.torque)).collect()
        }
    };
    let first = own.first().map_or(0.0, |(_, torque_nm)| *torque_nm);
    if torques_nm.is_empty() {
        return Ok(vec![NumberLoad { torque_nm: first, settings: Vec::new() }]);
    }
    if let Some(none) = torques_nm.iter().find(|t| !(t.is_finite() && **t > 0.0)) {
        return Err(format!("{none} is not a torque above 0"));
    }
    if first == 0.0 && own.len() > 1 {
        return Err("the first [[torque]] has none that others could go with".to_owned());
    }
    let of = |&torque_nm: &f64| {
        let scaled = |(key, own): &(String, f64)| {
            Setting::number(key, if first == 0.0 { torque_nm } else { own * torque_nm / first })
        };
        let settings = own.iter().map(scaled).collect::<Result<Vec<_>, _>>().map_err(|e| e.to_string())?;
        Ok(NumberLoad { torque_nm, settings })
    };
    torques_nm.iter().map(of).collect()
}

/// The limit that `NUMBER=MOST` says.
fn limit(word: &str) -> Result<NumberLimit, String> {
    let (key, most) = word.split_once('=').ok_or("has no `=`: say `KEY=MOST`")?;
    let most = most.trim().parse::<f64>().ok().filter(|most| most.is_finite() && *most > 0.0);
    Ok(NumberLimit { output: PlanOutput::parse(key)?, most: most.ok_or("says no number above 0")? })
}

/// The number that a document, with what is set beside it, says at a key, if it says one.
fn number_at((document, settings): (&Document, &[Setting]), machine: &Machine, key: &str) -> Option<f64> {
    let file = match machine {
        Machine::Pair(scene) => return scene.number_at(key),
        Machine::Gearbox(file) => file,
    };
    let path = path(key)?;
    match &path[..] {
        [mesh, which, scene, of_pair @ ..] if mesh == "mesh" && scene == "scene" => {
            file.meshes[file.mesh_called(which)?].scene.number_at(&of_pair.join("."))
        }
        _ => document.number_at(&path, settings),
    }
}
