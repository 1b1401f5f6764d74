//! Words that set keys beside the file of a scene or a gearbox.

use std::path::Path;

use crate::{
    resolution::with_slices,
    scene::{Scene, SceneError, Setting},
};

/// Keys that stand in place of the file's.
#[derive(Debug, Clone, Default, clap::Args)]
pub(super) struct Overrides {
    /// What a plan sets itself: these words hold before it.
    #[arg(skip)]
    of_plan: Vec<Setting>,
    /// Set a key of the file, e.g. `operation.torque_nm=200` or `gear.0.position_mm=50`; repeatable
    #[arg(long = "set", value_name = "KEY=VALUE", help_heading = "Overrides")]
    set: Vec<String>,
    /// Torque on the driven gear: short for `--set operation.torque_nm=NM`
    #[arg(long, value_name = "NM", help_heading = "Overrides", allow_negative_numbers = true)]
    torque_nm: Option<f64>,
    /// Use the cheapest model within this error, e.g. `1%` of the mean STE or `max_pressure=5%`; repeatable
    #[arg(long, value_name = "[KEY=]AMOUNT", help_heading = "Overrides")]
    accuracy: Vec<String>,
}

impl Overrides {
    /// What is set, in the order in which it holds.
    ///
    /// # Errors
    /// Words that are no key with a value.
    pub fn settings(&self) -> Result<Vec<Setting>, SceneError> {
        // First, so that `--set analysis.model=reduced` holds beside it: what is asked is then estimated, not chosen.
        let mut all = self.accuracy.iter().map(|w| Setting::accuracy(w)).collect::<Result<Vec<_>, _>>()?.concat();
        all.extend(self.of_plan.iter().cloned());
        for word in &self.set {
            all.push(Setting::parse(word)?);
        }
        if let Some(torque) = self.torque_nm {
            all.push(Setting::number("operation.torque_nm", torque)?.called("--torque-nm"));
        }
        Ok(all)
    }

    /// The words of the command line once more, each behind a space, as a shell takes them.
    pub fn again(&self) -> String {
        let plain = |c: char| c.is_ascii_alphanumeric() || "_-+.,:/=".contains(c);
        let word = |own: &String| {
            if own.chars().all(plain) { own.clone() } else { format!("'{}'", own.replace('\'', "'\\''")) }
        };
        let all = |option: &str, words: &[String]| -> String {
            words.iter().map(|own| format!(" {option} {}", word(own))).collect()
        };
        let torque = self.torque_nm.map_or_else(String::new, |torque| format!(" --torque-nm {torque}"));
        format!("{}{torque}{}", all("--set", &self.set), all("--accuracy", &self.accuracy))
    }

    /// Whether a torque is set by a word of its own.
    pub fn has_torque(&self) -> bool {
        self.torque_nm.is_some()
    }

    /// Whether an accuracy is asked for.
    pub fn has_accuracy(&self) -> bool {
        !self.accuracy.is_empty()
    }

    /// These behind other words.
    pub fn behind(mut self, words: impl IntoIterator<Item = String>) -> Self {
        self.set.splice(0..0, words);
        self
    }

    /// These behind what a plan sets itself.
    pub fn behind_plan(self, of_plan: Vec<Setting>) -> Self {
        Self { of_plan, ..self }
    }

    /// The scene with these keys.
    ///
    /// # Errors
    /// As of [`Scene::read_with`].
    pub fn read(&self, scene: &Path) -> Result<Scene, SceneError> {
        Scene::read_with(scene, &self.settings()?).map(with_slices)
    }
}
