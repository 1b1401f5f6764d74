//! Starts over a plane of displacement and rate: to which motion each of them leads.

use scene::plan::AxisWord;

use super::{
    super::{Answer, FileWords, run::RunArgs},
    VaryArgs,
};
use crate::error::CommandError;

/// What is varied, and the keys of `[motion.basins]` for its ends and the number of its values.
const PLANE: [(&str, [&str; 3]); 2] =
    [("start_um", ["from_um", "to_um", "columns"]), ("start_mm_s", ["from_mm_s", "to_mm_s", "rows"])];

impl VaryArgs {
    /// Runs the scene from each state of the plane that the words say, or that of `[motion.basins]`.
    pub(super) fn basin(&self, quiet: bool) -> Result<Answer, CommandError> {
        self.only(&["--vary", "--start", "--json"], "`--start basin`")?;
        let example = "as `--vary 'start_um=-20:20:41' --vary 'start_mm_s=-100:100:41'`";
        let mut words = vec!["analysis.kind=dynamic".to_owned(), "motion.run=basins".to_owned()];
        let mut varied = Vec::new();
        for word in &self.vary {
            let refuse =
                |what: &str| CommandError::input(format_args!("{}: {what}", self.said(word)), Some(example.into()));
            let axis = AxisWord::parse(word).map_err(|e| refuse(&e))?;
            let plane = PLANE.iter().find(|(name, _)| axis.keys[..] == [*name]);
            let (_, keys) = plane.ok_or_else(|| refuse("starts differ in `start_um` and `start_mm_s`"))?;
            if varied.contains(keys) {
                return Err(refuse("it is varied twice"));
            }
            varied.push(*keys);
            let values = axis.list().filter(|values| is_even(values));
            let Some([first, .., last]) = values else { return Err(refuse("starts are evenly spaced")) };
            let numbers = [first.to_string(), last.to_string(), values.map_or(0, <[f64]>::len).to_string()];
            words.extend(keys.iter().zip(numbers).map(|(key, number)| format!("motion.basins.{key}={number}")));
        }
        let (overrides, cache) = (self.overrides.clone().behind(words), self.cache.clone());
        let (file, out) = (self.file.clone(), self.folder()?.clone());
        RunArgs::of_file(FileWords { file, out, overrides, cache, json: self.json }).execute(quiet)
    }
}

/// Whether values ascend by the same step.
fn is_even(values: &[f64]) -> bool {
    let step = (values[values.len() - 1] - values[0]) / (values.len().max(2) - 1) as f64;
    step > 0.0 && values.windows(2).all(|pair| (pair[1] - pair[0] - step).abs() < 1e-6 * step)
}
