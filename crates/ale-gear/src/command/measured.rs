//! `ale-gear geometry --measured`: what a measured gear says, and the files that a scene takes.

use std::path::{Path, PathBuf};

use geometry::GearPair;
use metrology::GdeNames;
use report::measured_files;
use scene::Scene;

use crate::error::CommandError;

/// Words of a measured gear.
#[derive(Debug, clap::Args)]
pub(super) struct MeasuredArgs {
    /// Evaluate a measured gear in place of the sheet: `pinion=FILE` or `wheel=FILE`, a curve file (MKA) or with `--names` an
    /// XML file (GDE); writes topographies by tooth, pitch errors, deviations and waves into `--out`
    #[arg(long, value_name = "GEAR=FILE", requires = "out", conflicts_with = "json")]
    measured: Option<String>,
    /// Where an XML file (VDI/VDE 2610) has its values: TOML with a path of elements a key, such as `teeth = "gear/@z"`
    ///
    /// From the root: `teeth`, `normal_module` (mm), `helix_angle` and `pressure_angle` (degrees), `profiles` and `helices`
    /// (elements of one trace each). From a trace: `tooth`, `side`, `place` (height of a profile or diameter of a helix, mm),
    /// `from` and `to` (diameters of a profile, heights of a helix, mm), `values` (um, positive where the flank stands proud).
    /// Words: `left` and `right` (sides), `first_tooth` (number of the first tooth, 1 unless stated), `undefined` (number that
    /// stands for no value).
    #[arg(long, value_name = "FILE", requires = "measured")]
    names: Option<PathBuf>,
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
        if gear.1.is_internal() {
            let what = format!("the {} is a ring: measured rings are not read", gear.0);
            let hint = "state its micro-geometry, or a `topography` file".to_owned();
            return Err(CommandError::input(what, Some(hint)));
        }
        let path = Path::new(file);
        let refused = |e: metrology::MetrologyError| CommandError::input(&e, e.hint());
        let measured = match &self.names {
            None => metrology::read_mka(&bytes_of(path)?, path),
            Some(names) => {
                let (names_of, text) = (text_of(names)?, text_of(path)?);
                GdeNames::parse(&names_of, names).and_then(|own| metrology::read_gde(&text, &own, path))
            }
        };
        let measured = measured.map_err(refused)?;
        let made = measured_files(&measured, gear.1, (gear.0, scene.side()), file).map_err(refused)?;
        std::fs::create_dir_all(out).map_err(|e| CommandError::write(out, &e))?;
        let mut all = made.files;
        for table in &made.tables {
            all.push((format!("{}.csv", table.name), table.csv().map_err(report::ReportError::from)?));
        }
        for (name, content) in &all {
            is_ours(&out.join(name), content)?;
        }
        for (name, content) in &all {
            let path = out.join(name);
            files::write_file(&path, content.as_bytes()).map_err(|e| CommandError::write(&path, &e))?;
        }
        Ok(Some(made.text))
    }
}

/// Refuses to replace a file that does not begin as what is to be written there, up to the name of what it is of.
fn is_ours(path: &Path, content: &str) -> Result<(), CommandError> {
    let head = |bytes: &[u8]| bytes.split(|byte| b"\n;".contains(byte)).next().map(<[u8]>::to_vec);
    match std::fs::read(path) {
        Ok(there) if !there.is_empty() && head(&there) != head(content.as_bytes()) => {
            let what = format!("{}: a file of another kind is there", path.display());
            Err(CommandError::input(what, Some("name another folder with `--out`".into())))
        }
        _ => Ok(()),
    }
}

fn bytes_of(path: &Path) -> Result<Vec<u8>, CommandError> {
    let read = files::read_regular_file(path, files::most::DATA);
    let hint = || Some("name a file that exists and can be read".to_owned());
    read.map_err(|e| CommandError::input(format_args!("{}: {e}", path.display()), hint()))
}

fn text_of(path: &Path) -> Result<String, CommandError> {
    let not_text = |_| {
        let hint = "save it as UTF-8".to_owned();
        CommandError::input(format_args!("{}: is no UTF-8 text", path.display()), Some(hint))
    };
    String::from_utf8(bytes_of(path)?).map_err(not_text)
}
