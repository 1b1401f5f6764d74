//! `ale-gear geometry`: the numbers of a pair that drawings ask for.

use std::path::PathBuf;

use report::tables::geometry_table;

use super::overrides::Overrides;
use crate::error::CommandError;

/// Words of `ale-gear geometry`.
#[derive(Debug, clap::Args)]
pub(super) struct GeometryArgs {
    /// Scene file; meshes are not looked at
    scene: PathBuf,
    /// As JSON, with the names of `summary.json`
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    overrides: Overrides,
}

impl GeometryArgs {
    /// The sheet, for stdout.
    pub(super) fn execute(self) -> Result<String, CommandError> {
        let scene = self.overrides.read(&self.scene)?;
        let sheet = scene.gear_pair()?.sheet();
        if self.json {
            // Numbers and strings: there is nothing that JSON could refuse.
            return Ok(serde_json::to_string_pretty(&sheet).unwrap_or_default() + "\n");
        }
        Ok(geometry_table(&scene.name, &sheet, scene.pinion_speed() * 30.0 / std::f64::consts::PI))
    }
}
