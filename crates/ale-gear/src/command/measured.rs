//! `ale-gear geometry --measured`: what a measured gear says, and the files that a scene takes.

use std::path::{Path, PathBuf};

use geometry::GearPair;
use report::measured_files;
use scene::Scene;

use crate::error::CommandError;

/// Words of a measured gear.
#[derive(Debug, clap::Args)]
pub(super) struct MeasuredArgs {
    /// Evaluate a measured gear in place of the sheet: `pinion=FILE` or `wheel=FILE`, a curve file (MKA); writes topographies by
    /// tooth, pitch errors, deviations and waves into `--out`
    #[arg(long, value_name = "GEAR=FILE", requires = "out", conflicts_with = "json")]
    measured: Option<String>,
    /// Folder for the files of `--measured`; created if missing
    #[arg(long, value_name = "DIR", requires = "measured")]
    out: Option<PathBuf>,
}

impl MeasuredArgs {
    /// What is said of the measured gear, once its files are written; `None` where none is asked for.
    pub(super) fn execute(&self, scene: &Scene, pair: &GearPair) -> Result<Option<String>, CommandError> {
        let (Some(word), Some(out)) = (&self.measured, &self.out) else { return Ok(None) };
        let (gear, file) = match word.split_once('=') {
            Some(("pinion", file)) => (("pinion", &pair.pinion), file),
            Some(("wheel", file)) => (("wheel", &pair.wheel), file),
            _ => {
                let what = format!("--measured {word}: no gear is named");
                return Err(CommandError::input(what, Some("as in `--measured pinion=gear.mka`".into())));
            }
        };
        let path = Path::new(file);
        let read = files::read_regular_file(path, files::most::DATA);
        let bytes = read.map_err(|e| CommandError::input(format_args!("{file}: {e}"), None))?;
        let refused = |e: metrology::MetrologyError| CommandError::input(&e, e.hint());
        let measured = metrology::read_mka(&bytes, path).map_err(refused)?;
        let made = measured_files(&measured, gear.1, (gear.0, scene.side()), file).map_err(refused)?;
        std::fs::create_dir_all(out).map_err(|e| CommandError::write(out, &e))?;
        let mut all = made.files;
        for table in &made.tables {
            all.push((format!("{}.csv", table.name), table.csv().map_err(report::ReportError::from)?));
        }
        for (name, content) in &all {
            let path = out.join(name);
            files::write_file(&path, content.as_bytes()).map_err(|e| CommandError::write(&path, &e))?;
        }
        Ok(Some(made.text))
    }
}
