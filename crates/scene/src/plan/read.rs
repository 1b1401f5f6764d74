//! Reads a file, or words of a command line, and makes a checked plan.

use std::path::Path;

use cases::{Cases, Sampling};

use super::{
    Plan, PlanOutput,
    check::{DESIGNS, axis, check, finish},
    classed,
    schema::{RawPlan, SAMPLES, SEED, tables},
};
use crate::{Document, DocumentKind, SceneError, Setting, Source, nearest};

/// Options of a plan on a command line.
#[derive(Debug, Clone, Default)]
pub struct PlanWords<'a> {
    /// Varied keys.
    pub vary: &'a [String],
    /// Wanted values: of the headline by their keys, of columns as `mean(ste_um)`.
    pub outputs: &'a [String],
    /// Wanted values that are computed from columns.
    pub columns: &'a [PlanOutput],
    /// Design of experiments.
    pub design: Option<&'a str>,
    /// Number of samples.
    pub samples: Option<u32>,
    /// Seed of the samples.
    pub seed: Option<u32>,
}

impl Plan {
    /// Reads and checks a plan file and the scene that it names.
    ///
    /// # Errors
    /// [`SceneError`]: the first error, with its place in the plan file or in the scene.
    pub fn read(file: &Path) -> Result<Self, SceneError> {
        Self::of(&Document::read(file)?, &[])
    }

    /// Checks the text of a plan file. `file` is used in messages, and paths are relative to its folder.
    ///
    /// # Errors
    /// The errors of [`Plan::read`].
    pub fn parse(text: &str, file: &Path) -> Result<Self, SceneError> {
        Self::of(&Document::new(text.to_owned(), file), &[])
    }

    /// Checks a document. `settings` set keys of its scene, in addition to and after its own settings.
    ///
    /// # Errors
    /// The errors of [`Plan::read`].
    pub fn of(document: &Document, settings: &[Setting]) -> Result<Self, SceneError> {
        let own = words_of(document)?;
        let (source, raw) = (own.source(), own.raw()?);
        check(&source, &raw, (base_of(&source, &raw, document)?, settings))
    }

    /// The plan of a scene given by a command line.
    ///
    /// # Errors
    /// [`SceneError`]: the first error, with the word that it concerns.
    pub fn of_scene(document: Document, settings: &[Setting], words: &PlanWords<'_>) -> Result<Self, SceneError> {
        let wrong = |label: String, what: String| SceneError::Setting { label, what };
        let (mut axes, mut kinds) = (Vec::new(), Vec::new());
        let classed = |key: &str, class: u32| {
            let known = document.machine(settings).ok()?;
            let pair = known.pair()?;
            classed(pair, key, class, pair.number_at(key))
        };
        for written in words.vary {
            let complain = |what: String| wrong(format!("--vary {written}"), what);
            let (own, kind) = axis(written, &classed).map_err(complain)?;
            axes.push(own);
            kinds.push(kind);
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
        let output = |word: &String| PlanOutput::parse(word).map_err(|what| wrong(format!("--output {word}"), what));
        let mut outputs = words.outputs.iter().map(output).collect::<Result<Vec<_>, _>>()?;
        outputs.extend(words.columns.iter().cloned());
        let file = document.file().to_owned();
        let name = document.stem();
        let settings = settings.to_vec();
        finish(Self { name, file, document, settings, axes, sampling, cases, outputs })
    }
}

/// What a document says of a plan.
pub(super) struct PlanTables(Document);

/// The words of a plan in a document: of a file of its own, or of the table that stands in what it varies.
pub(super) fn words_of(document: &Document) -> Result<PlanTables, SceneError> {
    document.one_task()?;
    // A plan names what it varies, or stands in it as one of its tables.
    let own = if document.has("scene") { document.clone() } else { document.only(&["name", "vary"]) };
    Ok(PlanTables(own))
}

impl PlanTables {
    pub fn source(&self) -> Source<'_> {
        Source::of(&self.0, tables)
    }

    pub fn raw(&self) -> Result<RawPlan, SceneError> {
        self.source().words(DocumentKind::Plan)
    }
}

/// What a plan varies: the document that it names, or the one that it stands in.
pub(super) fn base_of(s: &Source<'_>, raw: &RawPlan, document: &Document) -> Result<Document, SceneError> {
    match &raw.scene {
        Some(scene) => s.named(scene, "plan file"),
        None if document.base_kind().is_some() => Ok(document.clone()),
        None => {
            let advice = "give the path of a scene or a gearbox file, or write [vary] into one";
            Err(s.conflict(&(0..0), "a plan without `scene`", advice))
        }
    }
}
