//! From a file, or from words, to a checked optimisation.

use std::path::Path;

use cases::{Cases, Sampling};
use design::{Goal, Measure, Over};

use super::{
    DesignParameter, Optimisation, TorqueWeight,
    check::{EVALUATIONS, FRONT, PRESSURES, check, default_parameters, finish, grain, measure, stem},
    raw::{RawOptimisation, tables},
};
use crate::{
    Document, DocumentKind, SceneError, Setting, Source,
    plan::{AxisValues, AxisWord, DESIGNS, SEED},
};

/// What a command line says of an optimisation.
#[derive(Debug, Clone, Default)]
pub struct OptimisationWords<'a> {
    /// Keys that may change, `KEY=FROM:TO`; a choice of tip reliefs and crowning without them.
    pub parameters: &'a [String],
    /// Torques, N m; the scene's own without them.
    pub torques_nm: &'a [f64],
    /// What shall be small.
    pub measure: Option<&'a str>,
    /// Limit of the contact pressure, MPa.
    pub max_pressure_mpa: Option<f64>,
    /// Limit of it at end faces and tip edges, MPa.
    pub max_edge_pressure_mpa: Option<f64>,
    /// Numbers of the headline that shall be small, in place of the transmission error ([`NumberOptimisation`](super::NumberOptimisation)).
    pub goals: &'a [String],
    /// Limits of numbers of the headline, `KEY=MOST`; with `goals`.
    pub limits: &'a [String],
    /// Evaluations at the most.
    pub evaluations: u32,
    /// Points of the trade-off.
    pub front: u32,
}

impl Optimisation {
    /// Reads and checks an optimisation file and the scene that it names.
    ///
    /// # Errors
    /// [`SceneError`]: the first complaint, with its place in the file or in the scene.
    pub fn read(file: &Path) -> Result<Self, SceneError> {
        Self::of(&Document::read(file)?, &[])
    }

    /// Checks the text of an optimisation file; `file` is what messages name and what paths are relative to.
    ///
    /// # Errors
    /// As [`Optimisation::read`].
    pub fn parse(text: &str, file: &Path) -> Result<Self, SceneError> {
        Self::of(&Document::new(text.to_owned(), file), &[])
    }

    /// Checks a document; `settings`: keys of its scene that are set otherwise, behind those that it sets itself.
    ///
    /// # Errors
    /// As [`Optimisation::read`].
    pub fn of(document: &Document, settings: &[Setting]) -> Result<Self, SceneError> {
        let source = Source::of(document, tables);
        let raw: RawOptimisation = source.words(DocumentKind::Optimisation)?;
        check(&source, &raw, settings)
    }

    /// Whether a document is an optimisation: it names a scene or what may change.
    pub fn is_one(document: &Document) -> bool {
        ["scene", "parameter", "tolerance"].iter().any(|key| document.has(key))
    }

    /// The optimisation of a scene that a command line says.
    ///
    /// # Errors
    /// [`SceneError`]: the first complaint, by the word that it is about.
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
            return Err(wrong(format!("--torques {none}"), "is no torque above 0".into()));
        }
        let limits = [("max-pressure", words.max_pressure_mpa), ("max-edge-pressure", words.max_edge_pressure_mpa)];
        for (word, limit) in limits {
            if let Some(limit) = limit.filter(|limit| !(PRESSURES[0]..=PRESSURES[1]).contains(limit)) {
                return Err(wrong(format!("--{word} {limit}"), "is no limit, 1 to 1000000 MPa".into()));
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
            name: stem(document.file()),
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

/// What `KEY=FROM:TO` lets change, from the scene's own value on; the error says what is wrong with it.
pub(super) fn parameter(word: &str, known: impl Fn(&str) -> Option<f64>) -> Result<DesignParameter, String> {
    let AxisWord { keys, values } = AxisWord::parse(word)?;
    let AxisValues::Between(bounds) = values else {
        return Err("say KEY=FROM:TO; the search begins at the scene's own value".into());
    };
    if !(bounds[1] > bounds[0] && bounds.iter().all(|b| b.is_finite())) {
        return Err("its second bound is not above the first".into());
    }
    let middle = if bounds[0] <= 0.0 && bounds[1] >= 0.0 { 0.0 } else { 0.5 * (bounds[0] + bounds[1]) };
    let start = known(&keys[0]).unwrap_or(middle).clamp(bounds[0], bounds[1]);
    let grain = grain(&keys[0]);
    Ok(DesignParameter { keys, bounds, start, grain })
}
