//! Periodic motions followed along a key, stable and unstable, around folds.

use scene::plan::{AxisValues, AxisWord};

use super::{
    super::{Answer, FileWords, run::RunArgs},
    VaryArgs,
};
use crate::error::CommandError;

impl VaryArgs {
    /// Follows the branch: a run of the scene as a continuation.
    pub(super) fn branch(&self, quiet: bool) -> Result<Answer, CommandError> {
        self.only(&["--vary", "--start", "--json"], "`--start branch`")?;
        let example = "as `--vary 'operation.speed_rpm=1000:6000'`";
        let [word] = &self.vary[..] else {
            let what = format_args!("{}: a branch is followed along one", self.axes());
            return Err(CommandError::input(what, Some(example.into())));
        };
        let axis =
            AxisWord::parse(word).map_err(|e| CommandError::input(format_args!("{}: {e}", self.said(word)), None))?;
        let (AxisValues::Between([from, to]), [key]) = (&axis.values, &axis.keys[..]) else {
            let what = format_args!("{}: a branch is followed along one key between two values", self.said(word));
            return Err(CommandError::input(what, Some(example.into())));
        };
        let words = [
            "analysis.kind=dynamic".to_owned(),
            "motion.run=continuation".to_owned(),
            format!("motion.continuation.key={key}"),
            format!("motion.continuation.from={from}"),
            format!("motion.continuation.to={to}"),
        ];
        let (overrides, cache) = (self.overrides.clone().behind(words), self.cache.clone());
        let (file, out) = (self.file.clone(), self.folder()?.clone());
        RunArgs::of_file(FileWords { file, out, overrides, cache, json: self.json }).execute(quiet)
    }
}
