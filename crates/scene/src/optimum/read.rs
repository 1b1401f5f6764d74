//! Reads a file, or words of a command line, and makes a checked optimisation.

use std::path::Path;

use cases::{Cases, Sampling};
use design::{Goal, Measure, Over};

use super::{
    NumberOptimisation, Optimisation, TorqueWeight,
    check::{check, default_parameters, finish, measure, words as listed},
    numbers::numbers,
    schema::{EVALUATIONS, FRONT, PRESSURES, RawOptimisation, tables},
    words::{OptimisationWords, parameter},
};
use crate::{
    Document, DocumentKind, SceneError, Setting, Source,
    plan::{DESIGNS, SEED},
};

impl Optimisation {
    /// Reads and checks an optimisation file and the scene that it names.
    ///
    /// # Errors
    /// [`SceneError`]: the first error, with its place in the file or in the scene.
    pub fn read(file: &Path) -> Result<Self, SceneError> {
        Self::of(&Document::read(file)?, &[])
    }

    /// Checks the text of an optimisation file. `file` is used in messages, and paths are relative to its folder.
    ///
    /// # Errors
    /// The errors of [`Optimisation::read`].
    pub fn parse(text: &str, file: &Path) -> Result<Self, SceneError> {
        Self::of(&Document::new(text.to_owned(), file), &[])
    }

    /// Checks a document. `settings` set keys of its scene, in addition to and after its own settings.
    ///
    /// # Errors
    /// The errors of [`Optimisation::read`].
    pub fn of(document: &Document, settings: &[Setting]) -> Result<Self, SceneError> {
        document.one_task()?;
        let own = own(document);
        let source = Source::of(&own, tables);
        let raw: RawOptimisation = source.words(DocumentKind::Optimisation)?;
        check(&source, &raw, (base(&source, &raw, document)?, settings))
    }

    /// Whether a document is an optimisation, and whether it optimises headline values.
    pub fn is_one(document: &Document) -> (bool, bool) {
        let is = document.has("optimise");
        let own = own(document);
        let raw = Source::of(&own, tables).words::<RawOptimisation>(DocumentKind::Optimisation);
        (is, is && raw.is_ok_and(|raw| !listed(&raw.optimise.goal).is_empty()))
    }

    /// The optimisation of a scene given by a command line.
    ///
    /// # Errors
    /// [`SceneError`]: the first error, with the word that it concerns.
    pub fn of_scene(
        document: Document,
        settings: &[Setting],
        words: &OptimisationWords<'_>,
    ) -> Result<Self, SceneError> {
        let wrong = |label: String, what: String| SceneError::Setting { label, what };
        if let Some(limit) = words.limits.first() {
            return Err(wrong(format!("--limit {limit}"), "goes with `--goal`".into()));
        }
        let own = document.scene(settings)?;
        let known = |key: &str| own.number_at(key);
        let mut parameters = words
            .parameters
            .iter()
            .map(|word| parameter(word, known).map_err(|what| wrong(format!("--vary {word}"), what)))
            .collect::<Result<Vec<_>, _>>()?;
        if parameters.is_empty() {
            parameters = default_parameters(&own)?;
        }
        let list = if words.torques_nm.is_empty() { vec![own.operation.torque_nm] } else { words.torques_nm.to_vec() };
        if let Some(none) = list.iter().find(|t| !(t.is_finite() && **t > 0.0)) {
            return Err(wrong(format!("--torques {none}"), "is not a torque above 0".into()));
        }
        let limits = [("max-pressure", words.max_pressure_mpa), ("max-edge-pressure", words.max_edge_pressure_mpa)];
        for (word, limit) in limits {
            if let Some(limit) = limit.filter(|limit| !(PRESSURES[0]..=PRESSURES[1]).contains(limit)) {
                return Err(wrong(format!("--{word} {limit}"), "is not a limit, 1 to 1000000 MPa".into()));
            }
        }
        for (word, number, most) in [("evaluations", words.evaluations, EVALUATIONS[1]), ("front", words.front, FRONT)]
        {
            if number > most {
                return Err(wrong(format!("--{word} {number}"), format!("is more than {most}")));
            }
        }
        let measure = match words.measure {
            None => Measure::PeakToPeak,
            Some(word) => match measure(word).map_err(|what| wrong(format!("--measure {word}"), what))? {
                Measure::Harmonics(_) => Measure::Harmonics(vec![1]),
                other => other,
            },
        };
        let sampling = Sampling { design: DESIGNS[0].1, samples: 1, seed: u64::from(SEED) };
        let samples = Cases::new(Vec::new(), &sampling).map_err(|e| wrong("samples".into(), e.to_string()))?;
        finish(Self {
            name: document.stem(),
            file: document.file().to_owned(),
            document,
            drawn: own,
            settings: settings.to_vec(),
            parameters,
            torques: list.into_iter().map(|torque_nm| TorqueWeight { torque_nm, weight: 1.0 }).collect(),
            goal: Goal { measure, over: Over::Mean },
            max_pressure_mpa: words.max_pressure_mpa,
            max_edge_pressure_mpa: words.max_edge_pressure_mpa,
            evaluations: words.evaluations.max(1),
            front: words.front,
            slices: None,
            tolerances: Vec::new(),
            sampling,
            samples,
        })
    }
}

/// What a document says of an optimisation: all of it where it names another one, else its table.
fn own(document: &Document) -> Document {
    if document.has("scene") { document.clone() } else { document.only(&["name", "optimise"]) }
}

/// The pair or the gearbox that is optimised.
fn base(s: &Source<'_>, raw: &RawOptimisation, document: &Document) -> Result<Document, SceneError> {
    match &raw.scene {
        Some(scene) => s.named(scene, "optimisation file"),
        None if document.base_kind().is_some() => Ok(document.clone()),
        None => {
            let advice = "give the path of a scene or a gearbox file, or write [optimise] into one";
            Err(s.conflict(&(0..0), "an optimisation without `scene`", advice))
        }
    }
}

impl NumberOptimisation {
    /// Checks a document whose `[optimise]` has a `goal`. `settings` set keys in addition to and after its own
    /// settings.
    ///
    /// # Errors
    /// [`SceneError`]: the first error, with its place.
    pub fn of(document: &Document, settings: &[Setting]) -> Result<Self, SceneError> {
        document.one_task()?;
        let own = own(document);
        let source = Source::of(&own, tables);
        let raw: RawOptimisation = source.words(DocumentKind::Optimisation)?;
        let base = base(&source, &raw, document)?;
        numbers(&source, &raw, (base, settings))
    }
}
