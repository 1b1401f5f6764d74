//! From a file, or from words, to a checked plan.

use std::path::Path;

use cases::{Cases, Sampling};

use super::{
    Plan, PlanAxis, PlanOutput,
    check::{CLASSED, DESIGNS, SAMPLES, SEED, check, finish},
    classed,
    raw::{RawPlan, tables},
    tolerance::is_pitch,
    word::{AxisValues, AxisWord},
};
use crate::{Document, DocumentKind, SceneError, Setting, Source, nearest};

/// What a command line says of a plan.
#[derive(Debug, Clone, Default)]
pub struct PlanWords<'a> {
    /// Varied keys.
    pub vary: &'a [String],
    /// Wanted numbers of the headline.
    pub outputs: &'a [String],
    /// Wanted numbers that are read off columns.
    pub columns: &'a [PlanOutput],
    /// Design, samples, seed.
    pub design: Option<&'a str>,
    /// How many samples.
    pub samples: Option<u32>,
    /// Which ones.
    pub seed: Option<u32>,
}

impl Plan {
    /// Reads and checks a plan file and the scene that it names.
    ///
    /// # Errors
    /// [`SceneError`]: the first complaint, with its place in the plan file or in the scene.
    pub fn read(file: &Path) -> Result<Self, SceneError> {
        Self::of(&Document::read(file)?, &[])
    }

    /// Checks the text of a plan file; `file` is what messages name and what paths are relative to.
    ///
    /// # Errors
    /// As [`Plan::read`].
    pub fn parse(text: &str, file: &Path) -> Result<Self, SceneError> {
        Self::of(&Document::new(text.to_owned(), file), &[])
    }

    /// Checks a document; `settings`: keys of its scene that are set otherwise, behind those that it sets itself.
    ///
    /// # Errors
    /// As [`Plan::read`].
    pub fn of(document: &Document, settings: &[Setting]) -> Result<Self, SceneError> {
        let source = Source::of(document, tables);
        let raw: RawPlan = source.words(DocumentKind::Plan)?;
        check(&source, &raw, settings)
    }

    /// The plan of a scene that a command line says.
    ///
    /// # Errors
    /// [`SceneError`]: the first complaint, by the word that it is about.
    pub fn of_scene(document: Document, settings: &[Setting], words: &PlanWords<'_>) -> Result<Self, SceneError> {
        let wrong = |label: String, what: String| SceneError::Setting { label, what };
        let (mut axes, mut kinds) = (Vec::new(), Vec::new());
        for written in words.vary {
            let complain = |what: String| wrong(format!("--vary {written}"), what);
            let AxisWord { keys, values } = AxisWord::parse(written).map_err(complain)?;
            let (pitch, axis) = match values {
                AxisValues::Between([from, to]) => {
                    return Err(complain(format!(
                        "say how many, as `={from}:{to}:9`, or draw them, as `~{from}:{to}`"
                    )));
                }
                AxisValues::By(_) if keys.iter().any(|key| is_pitch(key)) => {
                    return Err(complain("pitch errors are drawn within a class, as `~iso1328:6`".into()));
                }
                AxisValues::By(axis) => (None, axis),
                AxisValues::Class(_) if keys.len() > 1 && keys.iter().any(|key| is_pitch(key)) => {
                    return Err(complain("pitch errors of each gear are drawn by a `--vary` of its own".into()));
                }
                AxisValues::Class(class) => {
                    let (known, key) = (document.machine(settings)?, &keys[0]);
                    let found = known.pair().and_then(|pair| classed(pair, key, class, pair.number_at(key)));
                    found.ok_or_else(|| complain(format!("ISO 1328 has no tolerance for it: {CLASSED}")))?
                }
            };
            axes.push(PlanAxis { keys, pitch });
            kinds.push(axis);
        }
        let design = match words.design {
            None => DESIGNS[0].1,
            Some(name) => {
                let names = DESIGNS.map(|(name, _)| name);
                let known = DESIGNS.iter().find(|(word, _)| *word == name).map(|(_, design)| *design);
                known.ok_or_else(|| {
                    let near = nearest(name, &names).unwrap_or(names[0]);
                    wrong(format!("--design {name}"), format!("is none; did you mean `{near}`?"))
                })?
            }
        };
        if let Some(samples) = words.samples.filter(|n| !(1..=SAMPLES[1]).contains(n)) {
            return Err(wrong(format!("--samples {samples}"), format!("allowed is 1 .. {}", SAMPLES[1])));
        }
        let sampling = Sampling {
            design,
            samples: words.samples.unwrap_or(SAMPLES[0]),
            seed: u64::from(words.seed.unwrap_or(SEED)),
        };
        let cases = Cases::new(kinds, &sampling).map_err(|e| wrong("--vary".into(), e.to_string()))?;
        let outputs = words.outputs.iter().map(|key| PlanOutput::Headline(key.clone()));
        let outputs = outputs.chain(words.columns.iter().cloned()).collect();
        let file = document.file().to_owned();
        let name = file.file_stem().map_or_else(|| "plan".into(), |stem| stem.to_string_lossy().into_owned());
        let settings = settings.to_vec();
        finish(Self { name, file, document, settings, axes, sampling, cases, outputs })
    }
}
