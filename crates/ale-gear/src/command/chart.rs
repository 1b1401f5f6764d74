//! `ale-gear chart`: a scene in, accuracy against cost of every model out.

use std::path::{Path, PathBuf};

use analysis::accuracy_chart::ChartOptions;
use analysis::motion::motion_precision;
use report::accuracy_chart::{chart_csv, chart_tables, work_precision_svg};

use super::overrides::Overrides;
use report::folder::Partial;

use report::check_memory;

use crate::{
    chart::chart,
    error::CommandError,
    output::{ResultDirectory, motion_precision_csv, motion_precision_svg, motion_precision_table, svg_to_png},
    phases::Phases,
    memory,
    scene::Scene,
    talk,
};

/// Words of `ale-gear chart`.
#[derive(Debug, clap::Args)]
pub(super) struct ChartArgs {
    /// Scene file
    scene: PathBuf,
    /// Folder for chart and tables; it appears when they are complete
    #[arg(long, short, value_name = "DIR")]
    out: PathBuf,
    #[command(flatten)]
    overrides: Overrides,
    /// Methods of integration of a scene in time instead: error against step and wall time
    #[arg(long, conflicts_with = "motion")]
    methods: bool,
    /// Coarse meshes and few positions, or steps that are not small: less than a minute
    #[arg(long)]
    quick: bool,
    /// Run the models in motion at the scene's torque and speed as well
    #[arg(long)]
    motion: bool,
    /// Leave out what would take longer than this, by what the coarser mesh took
    #[arg(long, value_name = "S", default_value = "240")]
    limit_s: f64,
    /// Replace the tables between `<!-- chart NAME -->` and `<!-- end -->` in this Markdown file, NAME being the scene's name
    #[arg(long, value_name = "FILE")]
    into: Option<PathBuf>,
}

/// Positions of a cycle in a quick look.
const QUICK_POSITIONS: u32 = 8;

impl ChartArgs {
    /// Every complaint about the words is made here, before any work starts or any file is written.
    fn plan(&self) -> Result<(Scene, ChartOptions), CommandError> {
        let mut scene = self.overrides.read(&self.scene)?;
        if !(self.limit_s > 0.0 && self.limit_s.is_finite()) {
            let message = format_args!("`--limit-s` is {}, allowed is above 0", self.limit_s);
            return Err(CommandError::input(message, Some("give seconds, such as `--limit-s 240`".into())));
        }
        if let Some(file) = &self.into {
            between(file, &scene.name)?;
        }
        if self.methods && scene.motion.is_none() {
            return Err(self.not_in_time());
        }
        let mut options = if self.quick {
            scene.analysis.positions_per_cycle = scene.analysis.positions_per_cycle.min(QUICK_POSITIONS);
            ChartOptions::quick(self.limit_s)
        } else {
            ChartOptions::whole(self.limit_s)
        };
        options.motion = self.motion;
        check_memory(&scene, memory::available_bytes())?;
        Ok((scene, options))
    }

    /// Runs all points; the text is the tables.
    pub(super) fn execute(self) -> Result<String, CommandError> {
        let (scene, options) = self.plan()?;
        let results = ResultDirectory::create(&self.out)?;
        let mut phases = Phases::with_bars();
        let quick = if self.quick { " --quick" } else { "" };
        let set: String = scene.set.iter().map(|word| format!(" {word}")).collect();
        if self.methods {
            let command = format!("ale-gear chart {} --out DIR{quick} --methods{set}", self.scene.display());
            return self.of_methods(&scene, &mut phases, results, &command);
        }
        let points = chart(&scene, &options, &mut phases)?;
        let motion = if self.motion { " --motion" } else { "" };
        let command = format!("ale-gear chart {} --out DIR{quick}{motion}{set}", self.scene.display());
        let tables = chart_tables(&points, &command, rayon::current_num_threads());
        let fault = |e: String| CommandError::failed(format_args!("work_precision.svg: {e}"), None);
        let svg = work_precision_svg(&scene.name, &points).map_err(fault)?;
        results.write("chart.csv", chart_csv(&points).as_bytes())?;
        results.write("work_precision.svg", svg.as_bytes())?;
        results.write("work_precision.png", &svg_to_png(&svg).map_err(fault)?)?;
        results.write("chart.md", format!("# {}\n\n{tables}", scene.name).as_bytes())?;
        results.finish(talk::note)?;
        if let Some(file) = &self.into {
            put_into(file, &scene.name, &tables)?;
        }
        Ok(format!("{tables}\nresults: {}\n", self.out.display()))
    }
}

impl ChartArgs {
    fn not_in_time(&self) -> CommandError {
        let what = format_args!("{}: `--methods` is for an analysis in time", self.scene.display());
        CommandError::input(what, Some("say `kind = \"dynamic\"` in [analysis]".into()))
    }

    /// The methods of integration of a scene in time.
    fn of_methods(
        &self,
        scene: &Scene,
        phases: &mut Phases,
        results: ResultDirectory,
        command: &str,
    ) -> Result<String, CommandError> {
        if scene.motion.is_none() {
            return Err(self.not_in_time());
        }
        let found = motion_precision(scene, phases, self.quick)?;
        let fault = |e: String| CommandError::failed(format_args!("motion_precision.svg: {e}"), None);
        let svg = motion_precision_svg(&scene.name, &found).map_err(fault)?;
        let table = motion_precision_table(&found, command);
        results.write("motion_precision.csv", motion_precision_csv(&found).as_bytes())?;
        results.write("motion_precision.svg", svg.as_bytes())?;
        results.write("motion_precision.png", &svg_to_png(&svg).map_err(fault)?)?;
        results.write("motion_precision.md", format!("# {}\n\n{table}", scene.name).as_bytes())?;
        results.finish(talk::note)?;
        if let Some(file) = &self.into {
            put_into(file, &scene.name, &table)?;
        }
        Ok(format!("{table}\nresults: {}\n", self.out.display()))
    }
}

/// A file and the bytes of it that the tables replace.
struct Place {
    text: String,
    start: usize,
    end: usize,
}

/// The place of a scene's tables.
///
/// # Errors
/// Exit status 2 when the file or its marks are not there.
fn between(file: &Path, name: &str) -> Result<Place, CommandError> {
    let (open, close) = (format!("<!-- chart {name} -->\n"), "<!-- end -->");
    let hint = || Some(format!("put the two lines `{}` and `{close}` where the tables shall stand", open.trim()));
    let complain = |what: String| CommandError::input(format_args!("--into {}: {what}", file.display()), hint());
    let text = std::fs::read_to_string(file).map_err(|e| complain(e.to_string()))?;
    let start = text.find(&open).map(|at| at + open.len()).ok_or_else(|| complain(format!("no `{}`", open.trim())))?;
    let end = text[start..].find(close).map(|at| start + at).ok_or_else(|| complain(format!("no `{close}`")))?;
    Ok(Place { text, start, end })
}

fn put_into(file: &Path, name: &str, tables: &str) -> Result<(), CommandError> {
    let Place { text, start, end } = between(file, name)?;
    let whole = format!("{}\n{tables}\n{}", &text[..start], &text[end..]);
    replace(file, whole.as_bytes()).map_err(|e| CommandError::write(file, &e))
}

/// Writes a file beside it first: one that is half written would be lost. A link stays, and what it leads to is replaced, with the permissions it had.
fn replace(file: &Path, content: &[u8]) -> std::io::Result<()> {
    let target = std::fs::canonicalize(file)?;
    let name = target.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let new = Partial::new(target.with_file_name(format!(".{name}.partial-{}", std::process::id())));
    std::fs::write(new.path(), content)?;
    std::fs::set_permissions(new.path(), std::fs::metadata(&target)?.permissions())?;
    std::fs::rename(new.path(), &target)?;
    new.keep();
    Ok(())
}

#[cfg(all(test, unix))]
mod tests {
    use std::os::unix::fs::{PermissionsExt, symlink};

    use super::*;

    /// Through a link to a file, and through one to its folder; a file that stands beside it under a like name is nobody's.
    #[test]
    fn tables_go_where_a_link_leads_to() {
        let scratch = tempfile::tempdir().unwrap();
        let (book, page) = (scratch.path().join("book"), scratch.path().join("book/page.md"));
        std::fs::create_dir(&book).unwrap();
        std::fs::write(&page, "# A\n<!-- chart a -->\nold\n<!-- end -->\nrest\n").unwrap();
        std::fs::set_permissions(&page, std::fs::Permissions::from_mode(0o640)).unwrap();
        std::fs::write(book.join("page.new"), "mine").unwrap();
        let (link, folder) = (scratch.path().join("link.md"), scratch.path().join("docs"));
        symlink("book/page.md", &link).unwrap();
        symlink("book", &folder).unwrap();
        for (file, table) in [(link.clone(), "first"), (folder.join("page.md"), "second")] {
            put_into(&file, "a", table).unwrap();
            let wanted = format!("# A\n<!-- chart a -->\n\n{table}\n<!-- end -->\nrest\n");
            assert_eq!(std::fs::read_to_string(&page).unwrap(), wanted);
        }
        for path in [&link, &folder] {
            assert!(std::fs::symlink_metadata(path).unwrap().is_symlink(), "{} is a link no more", path.display());
        }
        assert_eq!(std::fs::metadata(&page).unwrap().permissions().mode() & 0o777, 0o640);
        assert_eq!(std::fs::read_to_string(book.join("page.new")).unwrap(), "mine");
        assert_eq!(std::fs::read_dir(&book).unwrap().count(), 2);
    }
}
