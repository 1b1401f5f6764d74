//! `ale-gear mesh`: look at, check or make meshes.

use mesh::MshFormat;
use std::{
    ops::RangeInclusive,
    path::{Path, PathBuf},
};

use clap::{Subcommand, ValueEnum};
use mesh::{GroupNames, Mesh, MeshInfo, MeshReport, Severity};
use report::tables::{mesh_findings, mesh_findings_json, mesh_info_table};

use super::{
    group_args::{GroupArgs, complaint},
    mesh_reduce::ReduceArgs,
    target::Target,
};
use crate::{error::CommandError, meshes, scene::Scene};

/// Subcommands of `ale-gear mesh`.
#[derive(Debug, Subcommand)]
pub(super) enum MeshCommand {
    /// Print elements, nodes, extent and groups of a mesh file
    Info {
        /// Gmsh file, format 2.2 or 4.1, text or binary
        file: PathBuf,
        /// As JSON
        #[arg(long)]
        json: bool,
    },
    /// Report problems of a mesh file; exit status 2 if it cannot be used
    Check {
        /// Gmsh file, format 2.2 or 4.1, text or binary
        file: PathBuf,
        /// Number of teeth of the whole gear, for the periodic faces of a sector
        #[arg(long, value_name = "Z")]
        teeth: Option<u32>,
        /// Scene that will use the mesh: everything a run would refuse is reported, with the group names of the scene
        #[arg(long, requires = "gear", conflicts_with_all = ["teeth", "bore", "flank_left", "flank_right", "cut_0", "cut_1"])]
        scene: Option<PathBuf>,
        /// Which gear of the scene
        #[arg(long, requires = "scene")]
        gear: Option<WhichGear>,
        #[command(flatten)]
        groups: GroupArgs,
        /// Findings as JSON
        #[arg(long)]
        json: bool,
    },
    /// Reduce the gears of a scene into the cache, or the gear of a mesh file, and report time and memory
    Reduce(ReduceArgs),
    /// Write the built-in mesh of a scene's gear
    Generate {
        /// Scene file
        scene: PathBuf,
        /// Which gear
        #[arg(long)]
        gear: WhichGear,
        /// Gmsh file to write
        #[arg(long, short)]
        output: PathBuf,
        /// Format version, 4.1 or 2.2
        #[arg(long, default_value = "4.1")]
        format: String,
        /// Text instead of binary
        #[arg(long)]
        ascii: bool,
    },
}

/// Numbers of teeth that a gear may have, as in a scene.
const TEETH: RangeInclusive<u32> = 5..=2000;

/// A gear of the pair.
#[derive(Debug, Clone, Copy, ValueEnum)]
pub(super) enum WhichGear {
    Pinion,
    Wheel,
}

impl MeshCommand {
    /// Does what was asked; the text is for stdout.
    pub(super) fn execute(self, quiet: bool) -> Result<String, CommandError> {
        match self {
            Self::Info { file, json } => {
                let found = MeshInfo::new(&read(&file)?);
                Ok(if json { format!("{:#}\n", serde_json::json!(found)) } else { mesh_info_table(&file, &found) })
            }
            Self::Check { file, scene: Some(scene), gear: Some(gear), json, .. } => check_as(&file, &scene, gear, json),
            Self::Check { file, teeth, groups, json, .. } => check(&file, teeth, &groups.names()?, json),
            Self::Reduce(args) => args.execute(),
            Self::Generate { scene, gear, output, format, ascii } => {
                let text = generate(&scene, gear, &output, &format, ascii)?;
                Ok(if quiet { String::new() } else { text })
            }
        }
    }
}

fn read(file: &Path) -> Result<Mesh, CommandError> {
    Mesh::read(file).map_err(complaint)
}

/// As [`check`], and as a run of the scene does.
fn check_as(file: &Path, scene: &Path, which: WhichGear, json: bool) -> Result<String, CommandError> {
    let scene = Scene::read(scene)?;
    let pair = scene.gear_pair()?;
    let (whose, gear, exact) = match which {
        WhichGear::Pinion => ("pinion", &scene.pinion, &pair.pinion),
        WhichGear::Wheel => ("wheel", &scene.wheel, &pair.wheel),
    };
    let told = check(file, Some(gear.teeth), &gear.groups, json)?;
    let name = file.display().to_string();
    meshes::checked_mesh(&scene, whose, (gear, exact), read(file)?, [name.clone(), name])?;
    Ok(told)
}

fn check(file: &Path, teeth: Option<u32>, names: &GroupNames, json: bool) -> Result<String, CommandError> {
    if let Some(wrong) = teeth.filter(|z| !TEETH.contains(z)) {
        let message = format_args!("`--teeth` is {wrong}, allowed is {} .. {}", TEETH.start(), TEETH.end());
        return Err(CommandError::input(message, Some("give the number of teeth of the whole gear".into())));
    }
    let mesh = read(file)?;
    let report = MeshReport::of_gear(&mesh, names, teeth);
    // Neighbouring teeth tell how many there are.
    if let (Some(said), Some(found)) = (teeth, MeshInfo::with_names(&mesh, names).gear.teeth)
        && said != found
    {
        return Err(CommandError::input(
            format_args!(
                "{}: {said} teeth are asked for, and its teeth lie as those of a gear of {found} do",
                file.display()
            ),
            Some(format!("is the number right, `--teeth {found}`; or is it the mesh of another gear?")),
        ));
    }
    let t = mesh_findings(&report);
    let errors = report.findings.iter().filter(|f| f.severity == Severity::Error).count();
    if errors > 0 {
        let list = t.trim_end().replace('\n', "\n  ");
        return Err(CommandError::input(
            format_args!("{}: cannot be used\n  {list}", file.display()),
            Some("element and node numbers are the tags that Gmsh shows".into()),
        ));
    }
    if json {
        return Ok(mesh_findings_json(&report));
    }
    let verdict = if report.findings.is_empty() { "nothing wrong found" } else { "can be used" };
    Ok(format!("{}: {verdict}\n{t}", file.display()))
}

fn generate(scene: &Path, which: WhichGear, output: &Path, format: &str, ascii: bool) -> Result<String, CommandError> {
    let format = msh_format(format, ascii)?;
    Target::Mesh.check("--output", output)?;
    if output.extension().is_none_or(|end| end != "msh") {
        let message = format_args!("`--output` is {}, allowed is a name that ends in `.msh`", output.display());
        return Err(CommandError::input(message, Some("Gmsh converts it into other formats".into())));
    }
    let scene = Scene::read(scene)?;
    let pair = scene.gear_pair()?;
    let mesh = match which {
        WhichGear::Pinion => meshes::generated(&scene, "pinion", &scene.pinion, &pair.pinion)?,
        WhichGear::Wheel => meshes::generated(&scene, "wheel", &scene.wheel, &pair.wheel)?,
    };
    mesh.write(output, format).map_err(|e| CommandError::failed(&e, e.hint()))?;
    Ok(format!("{}: {} nodes, {} elements\n", output.display(), mesh.nodes.len(), mesh.element_count()))
}

/// Format of a mesh file by the words of the command line.
///
/// # Errors
/// Exit status 2 for another version than 4.1 and 2.2.
fn msh_format(version: &str, ascii: bool) -> Result<MshFormat, CommandError> {
    match (version, ascii) {
        ("4.1", true) => Ok(MshFormat::Ascii41),
        ("4.1", false) => Ok(MshFormat::Binary41),
        ("2.2", true) => Ok(MshFormat::Ascii22),
        ("2.2", false) => Ok(MshFormat::Binary22),
        _ => Err(CommandError::input(format_args!("`--format` is {version}, allowed is 4.1 or 2.2"), None)),
    }
}
