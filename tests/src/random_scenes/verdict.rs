//! What became of a scene, and the table of all.

use std::collections::BTreeMap;

use serde_json::{Value as Json, json};

use super::{Attempt, RandomScene, Refusals, laws::names};

/// What became of a scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Outcome {
    /// A result that holds.
    Solved,
    /// A result that holds, with something to be said of it.
    SolvedWithWarnings,
    /// A result that is less exact than was asked.
    LessExact,
    /// The scene is wrong, and why.
    Refused,
    /// There is no answer, and why.
    NoSolution,
    /// A result whose certificate does not hold, marked so.
    Failed,
    /// Beyond its limit of time.
    Hung,
    /// The program has broken off.
    Broken,
}

impl Outcome {
    /// All of them, in the order of the table.
    pub const ALL: [Self; 8] = [
        Self::Solved,
        Self::SolvedWithWarnings,
        Self::LessExact,
        Self::Refused,
        Self::NoSolution,
        Self::Failed,
        Self::Hung,
        Self::Broken,
    ];

    /// In the table.
    pub fn name(self) -> &'static str {
        match self {
            Self::Solved => "solved",
            Self::SolvedWithWarnings => "solved with remarks",
            Self::LessExact => "less exact than asked",
            Self::Refused => "refused",
            Self::NoSolution => "no solution",
            Self::Failed => "certificate failed",
            Self::Hung => "hung",
            Self::Broken => "broke off",
        }
    }
}

/// What became of a scene.
#[derive(Debug, Clone)]
pub struct Verdict {
    /// Number of the scene.
    pub index: u64,
    /// Word of its model.
    pub model: String,
    /// In one word.
    pub outcome: Outcome,
    /// The pattern of its refusal in the list.
    pub reason: Option<String>,
    /// The message without the place.
    pub message: String,
    /// Warnings of the result.
    pub remarks: usize,
    /// The law that it was held against.
    pub law: Option<&'static str>,
    /// What is wrong: with any of these the program is at fault.
    pub wrong: Vec<String>,
    /// Wall time.
    pub seconds: f64,
}

impl Verdict {
    /// Verdict of the process; files are judged elsewhere.
    pub(super) fn of(index: u64, scene: &RandomScene, attempt: &Attempt, refusals: &Refusals) -> Self {
        let message = message(&attempt.said);
        let mut wrong = Vec::new();
        let outcome = match attempt.status {
            _ if attempt.late => Outcome::Hung,
            Some(0) => Outcome::Solved,
            Some(3) => Outcome::LessExact,
            Some(1) if message.contains("check failed") => Outcome::Failed,
            Some(1) => Outcome::NoSolution,
            Some(2) => Outcome::Refused,
            _ => Outcome::Broken,
        };
        let mut reason = None;
        match outcome {
            Outcome::Hung => wrong.push(format!("no end after {:.0} s", attempt.seconds)),
            Outcome::Broken => {
                let said: String = attempt.said.lines().take(40).collect::<Vec<_>>().join(" | ");
                wrong.push(format!("status {:?}: {said}", attempt.status));
            }
            Outcome::Solved | Outcome::SolvedWithWarnings => {}
            _ => match refusals.explain(&message, attempt.status.unwrap_or(0), &scene.draft) {
                Ok(pattern) => reason = Some(pattern),
                Err(said) => wrong.push(said),
            },
        }
        if attempt.said.contains("panicked at") && outcome != Outcome::Broken {
            wrong.push(format!("a panic on the way: {}", attempt.said));
        }
        let model = scene.model.to_owned();
        let seconds = attempt.seconds;
        Self { index, model, outcome, reason, message, remarks: 0, law: None, wrong, seconds }
    }

    /// In one word, remarks known.
    pub fn outcome(&self) -> Outcome {
        if self.outcome == Outcome::Solved && self.remarks > 0 { Outcome::SolvedWithWarnings } else { self.outcome }
    }

    /// As a line of JSON.
    pub fn to_json(&self) -> Json {
        json!({
            "index": self.index,
            "model": self.model,
            "outcome": self.outcome().name(),
            "reason": self.reason,
            "message": self.message,
            "remarks": self.remarks,
            "law": self.law,
            "wrong": self.wrong,
            "seconds": (1e3 * self.seconds).round() / 1e3,
        })
    }
}

/// The first line without the program's name and the place: in the document, in a mesh of it, of a key that is set, in the
/// first case of a plan.
fn message(said: &str) -> String {
    let mut rest = said.lines().find_map(|l| l.strip_prefix("ale-gear: ")).unwrap_or_default();
    loop {
        let shorter = PLACES.iter().find_map(|place| {
            let after = rest.strip_prefix(place)?;
            let end = if place.ends_with(": ") { 0 } else { after.find(": ")? + 2 };
            Some(&after[end..])
        });
        match shorter {
            Some(shorter) => rest = shorter,
            None => return rest.to_owned(),
        }
    }
}

/// Beginnings of a message that say where: what follows up to a colon belongs to them.
const PLACES: [&str; 4] = ["scene.toml", "--set ", "case.toml", "no case has a result; the first: "];

/// How many of each model ended how.
#[derive(Debug, Default)]
pub struct Tally {
    counts: BTreeMap<String, BTreeMap<Outcome, usize>>,
    reasons: BTreeMap<String, usize>,
    wrong: usize,
    laws: BTreeMap<&'static str, usize>,
    slowest: f64,
}

impl Tally {
    /// Counts one more: a line of [`Verdict::to_json`]; a line of something else is none.
    pub fn add(&mut self, line: &Json) {
        let word = |key: &str| line[key].as_str();
        let outcome = Outcome::ALL.into_iter().find(|o| word("outcome") == Some(o.name()));
        let (Some(model), Some(outcome)) = (word("model"), outcome) else { return };
        for row in [model, "all"] {
            *self.counts.entry(row.into()).or_default().entry(outcome).or_default() += 1;
        }
        if let Some(reason) = word("reason") {
            *self.reasons.entry(format!("{}: {reason}", outcome.name())).or_default() += 1;
        }
        self.wrong += usize::from(line["wrong"].as_array().is_none_or(|w| !w.is_empty()));
        if let Some(law) = names().find(|law| word("law") == Some(law)) {
            *self.laws.entry(law).or_default() += 1;
        }
        self.slowest = self.slowest.max(line["seconds"].as_f64().unwrap_or(0.0));
    }

    /// Scenes with something wrong.
    pub fn wrong(&self) -> usize {
        self.wrong
    }

    /// The table at the end.
    pub fn table(&self) -> String {
        let mut text = format!("{:16}", "model");
        Outcome::ALL.iter().for_each(|o| text += &format!(" | {:>21}", o.name()));
        for (model, counts) in &self.counts {
            text += &format!("\n{model:16}");
            Outcome::ALL.iter().for_each(|o| text += &format!(" | {:>21}", counts.get(o).unwrap_or(&0)));
        }
        text += "\n\n";
        let mut reasons: Vec<_> = self.reasons.iter().collect();
        reasons.sort_by_key(|(_, count)| std::cmp::Reverse(**count));
        reasons.iter().for_each(|(reason, count)| text += &format!("{count:6} {reason}\n"));
        let laws: Vec<String> = self.laws.iter().map(|(law, count)| format!("{law} {count}")).collect();
        text + &format!(
            "\nheld against laws: {}; slowest {:.1} s, wrong: {}\n",
            laws.join(", "),
            self.slowest,
            self.wrong
        )
    }
}
