//! `ale-gear mesh reduce`: gears condensed to their flanks, without a run.

use std::{
    fmt::Write,
    path::{Path, PathBuf},
};

use analysis::{
    reduction_alone::{ReducedRow, ReducedScene, reduce_mesh, reduce_scene},
    remark::Remark,
};
use fem::Material;
use mesh::{Mesh, MeshedGear};
use serde_json::json;

use super::{
    cache_args::CacheArgs,
    group_args::{GroupArgs, complaint},
    overrides::Overrides,
};
use store::folder::Cache;

use crate::{error::CommandError, phases::Phases, scene::Scene};

/// Words of `ale-gear mesh reduce`.
#[derive(Debug, clap::Args)]
pub(super) struct ReduceArgs {
    /// Scene file, whose gears go into the cache; or a Gmsh file (`.msh`), whose gear is reduced for its time and
    /// memory alone
    #[arg(value_name = "SCENE|MESH")]
    file: PathBuf,
    #[command(flatten)]
    cache: CacheArgs,
    #[command(flatten)]
    overrides: Overrides,
    #[command(flatten)]
    of_mesh: MeshArgs,
    /// Print rows and phases as JSON
    #[arg(long)]
    json: bool,
}

/// What a scene says of itself and a mesh does not.
#[derive(Debug, clap::Args)]
#[command(next_help_heading = "Of a mesh file")]
struct MeshArgs {
    /// Number of teeth of the whole gear
    #[arg(long, value_name = "Z")]
    teeth: Option<u32>,
    /// Teeth of the window [default: 3]
    #[arg(long, value_name = "W")]
    window_teeth: Option<usize>,
    /// Young's modulus [default: 206000]
    #[arg(long, value_name = "MPA")]
    young_mpa: Option<f64>,
    /// Poisson's ratio [default: 0.3]
    #[arg(long)]
    poisson: Option<f64>,
    #[command(flatten)]
    groups: GroupArgs,
}

/// Density where only stiffness counts, t/mm^3.
const STEEL: f64 = 7.85e-9;

impl ReduceArgs {
    /// Reduces; the text is a table of the gears and of the phases.
    pub(super) fn execute(self) -> Result<String, CommandError> {
        let mut phases = Phases::with_bars();
        let json = self.json;
        let (rows, remarks) = if self.file.extension().is_some_and(|e| e.eq_ignore_ascii_case("msh")) {
            (vec![self.of_mesh.reduce(&self.file, &self.overrides, &mut phases)?], Vec::new())
        } else {
            self.of_mesh.refuse(&self.file)?;
            let scene = self.overrides.read(&self.file)?;
            reduced(&scene, &mut phases, &self.cache.open())?
        };
        Ok(if json {
            format!("{:#}\n", json!({ "gears": rows, "phases": phases.rows(), "remarks": remarks }))
        } else {
            table(&rows, &phases, &remarks)
        })
    }
}

impl MeshArgs {
    /// A scene says these things itself.
    fn refuse(&self, scene: &Path) -> Result<(), CommandError> {
        let given = [
            ("--teeth", self.teeth.is_some()),
            ("--window-teeth", self.window_teeth.is_some()),
            ("--young-mpa", self.young_mpa.is_some()),
            ("--poisson", self.poisson.is_some()),
            ("names of groups", self.groups.any()),
        ];
        match given.into_iter().find(|(_, given)| *given) {
            None => Ok(()),
            Some((flag, _)) => Err(CommandError::input(
                format_args!("{}: {flag} belongs to a mesh file", scene.display()),
                Some("a scene says it itself; `--set KEY=VALUE` changes it".into()),
            )),
        }
    }

    fn reduce(self, file: &Path, overrides: &Overrides, phases: &mut Phases) -> Result<ReducedRow, CommandError> {
        if !overrides.settings()?.is_empty() {
            return Err(CommandError::input(
                format_args!("{}: `--set` and `--torque-nm` belong to a scene", file.display()),
                Some("give a scene file, or `--young-mpa`, `--poisson`, `--window-teeth`".into()),
            ));
        }
        let names = self.groups.names()?;
        let mesh = phases.run("read", || Mesh::read(file)).map_err(complaint)?;
        let found = mesh::MeshInfo::new(&mesh).gear.teeth;
        let Some(teeth) = self.teeth.or(found) else {
            return Err(CommandError::input(
                format_args!("{}: the number of teeth is not known from the mesh", file.display()),
                Some("give it with `--teeth Z`".into()),
            ));
        };
        let of_file = |e: mesh::MeshError| CommandError::input(format_args!("{}: {e}", file.display()), e.hint());
        let gear = MeshedGear::from_groups(mesh, &names, teeth).map_err(of_file)?;
        let material = Material::new(self.young_mpa.unwrap_or(2.06e5), self.poisson.unwrap_or(0.3), STEEL)
            .map_err(|e| CommandError::input(&e, e.hint()))?;
        Ok(reduce_mesh(&file.display().to_string(), gear, material, self.window_teeth.unwrap_or(3), phases)?)
    }
}

/// Both gears of a scene, with the files of their records; remarks come second.
fn reduced(scene: &Scene, phases: &mut Phases, cache: &Cache) -> Result<(Vec<ReducedRow>, Vec<Remark>), CommandError> {
    let ReducedScene { mut rows, keys, remarks } = reduce_scene(scene, phases, cache)?;
    for (row, key) in rows.iter_mut().zip(keys.keys()) {
        let file = key.as_ref().and_then(|key| cache.file(key)).filter(|f| f.is_file());
        row.file = file.map(|f| f.display().to_string());
    }
    Ok((rows, remarks))
}

fn table(rows: &[ReducedRow], phases: &Phases, remarks: &[Remark]) -> String {
    let mut t = String::new();
    for row in rows {
        let source = if row.from_cache { ", from the cache" } else { "" };
        // Writing to a String cannot fail.
        let _ = writeln!(
            t,
            "{}: {} DOF -> {} coordinates of {} teeth ({}{source})",
            row.gear, row.dof_before, row.coordinates, row.window_teeth, row.way
        );
        if let Some(file) = &row.file {
            let _ = writeln!(t, "  {file}");
        }
    }
    let _ = writeln!(t, "\n  {:<14} {:>10} {:>14}", "phase", "wall s", "peak MB");
    for phase in phases.rows() {
        let mb = phase.peak_memory_mb.map_or_else(|| "-".to_owned(), |m| format!("{m:.0}"));
        let _ = writeln!(t, "  {:<14} {:>10.2} {mb:>14}", phase.name, phase.wall_s);
    }
    for warning in remarks {
        let _ = writeln!(t, "\nwarning: {warning}");
    }
    t
}
