//! `ale-gear geometry`: the numbers of a pair that drawings ask for.

use std::path::PathBuf;

use analysis::facts::RunInfo;
use report::tables::{geometry_json, geometry_table, torque};
use scene::rexs_of;

use super::{measured::MeasuredArgs, overrides::Overrides, target::Target};
use crate::error::CommandError;

/// Words of `ale-gear geometry`.
#[derive(Debug, clap::Args)]
pub(super) struct GeometryArgs {
    /// Scene file; its meshes are not read
    scene: PathBuf,
    /// Print JSON with the names of `summary.json`
    #[arg(long)]
    json: bool,
    /// Also write the pair as a REXS file (1.4, XML)
    #[arg(long, value_name = "FILE")]
    rexs: Option<PathBuf>,
    #[command(flatten)]
    measured: MeasuredArgs,
    #[command(flatten)]
    overrides: Overrides,
}

impl GeometryArgs {
    /// The sheet, for stdout.
    pub(super) fn execute(self) -> Result<String, CommandError> {
        if let Some(file) = &self.rexs {
            Target::Rexs.check("--rexs", file)?;
        }
        let scene = self.overrides.read(&self.scene)?;
        let pair = scene.gear_pair()?;
        if let Some(file) = &self.rexs {
            files::write_file(file, rexs_of(&pair).as_bytes()).map_err(|e| CommandError::write(file, &e))?;
        }
        if let Some(text) = self.measured.execute(&scene, &pair)? {
            return Ok(text);
        }
        let facts = RunInfo::of_pair(&scene, &pair);
        if self.json {
            return Ok(geometry_json(&facts) + "\n");
        }
        let rpm = scene.pinion_speed() * 30.0 / std::f64::consts::PI;
        Ok(geometry_table(&scene.name, &facts, &torque(&scene), rpm).unwrap_or_default())
    }
}
