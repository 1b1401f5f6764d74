//! A fresh folder and the built program in it.

#![allow(dead_code)] // each test file uses its own part

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;

/// A folder of its own and one for the cache, gone with the value.
pub struct Scratch(tempfile::TempDir, tempfile::TempDir);

/// How a run ended.
pub struct Run {
    pub code: Option<i32>,
    pub stdout: String,
    pub stderr: String,
}

impl Scratch {
    pub fn new() -> Self {
        Self(tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap())
    }

    pub fn path(&self) -> &Path {
        self.0.path()
    }

    pub fn file(self, name: &str, content: impl AsRef<[u8]>) -> Self {
        std::fs::write(self.path().join(name), content).unwrap();
        self
    }

    /// A page of the folder, with slashes as they are.
    pub fn page(&self, name: &str) -> String {
        self.read(name).replace("&#x2f;", "/")
    }

    pub fn read(&self, name: &str) -> String {
        std::fs::read_to_string(self.path().join(name)).unwrap()
    }

    /// Names in the folder, ascending.
    pub fn names(&self) -> Vec<String> {
        let entries = std::fs::read_dir(self.path()).unwrap();
        let mut names: Vec<String> = entries.map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    pub fn ale_gear<const N: usize>(&self, words: [&str; N]) -> Run {
        self.command(&words)
    }

    pub fn command(&self, words: &[&str]) -> Run {
        Self::done(self.program().args(words))
    }

    /// The built program in this folder; what it says does not depend on how fast the machine is, nor on what the user
    /// has cached.
    pub fn program(&self) -> Command {
        self.here(Command::new(env!("CARGO_BIN_EXE_ale-gear")))
    }

    fn here(&self, mut command: Command) -> Command {
        command.current_dir(self.path()).env("XDG_CACHE_HOME", self.1.path());
        command.env(ale_gear::talk::PROGRESS_AFTER_S, "never");
        command
    }

    /// Commands as a user types them, `ale-gear` on the path; ends at the first that fails.
    pub fn shell(&self, script: &str) -> Run {
        let built = Path::new(env!("CARGO_BIN_EXE_ale-gear")).parent().unwrap().to_owned();
        let others = std::env::var_os("PATH").unwrap_or_default();
        let path = std::env::join_paths(std::iter::once(built).chain(std::env::split_paths(&others))).unwrap();
        Self::done(self.here(Command::new("sh")).args(["-e", "-c", script]).env("PATH", path))
    }

    /// Runs a command to its end.
    pub fn done(command: &mut Command) -> Run {
        let output = command.output().unwrap();
        let text = |bytes| String::from_utf8(bytes).unwrap();
        Run { code: output.status.code(), stdout: text(output.stdout), stderr: text(output.stderr) }
    }
}

impl Run {
    /// What stderr says without the lines of a file that it shows: `  7 | ...` and the mark below.
    pub fn complaint(&self) -> String {
        let shown = |line: &&str| !(line.starts_with("  ") && line.contains(" | "));
        self.stderr.lines().filter(shown).map(|line| format!("{line}\n")).collect()
    }
}

/// Top of the repository.
pub fn repository() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().nth(2).unwrap().to_owned()
}

/// A complete scene of the default pair with the model `iso`.
pub const ISO_SCENE: &str = r#"[pinion]
teeth = 30
helix_angle_deg = 20.0
bore_diameter_mm = 60.0
thickness_allowance_mm = 0.05
[wheel]
teeth = 30
bore_diameter_mm = 60.0
thickness_allowance_mm = 0.05
[pair]
normal_module_mm = 3.0
face_width_mm = 20.0
[operation]
torque_nm = 150.0
[analysis]
model = "iso"
"#;

/// Where the tables on motion begin in [`motion_scene`]: few steps.
pub const MOTION_LINES: &str = "[motion]\nsteps_per_mesh_cycle = 16\nsteps_per_resonance = 0\n";

/// The default pair on tiny meshes, few steps; `motion` are further lines of the scene.
pub fn motion_scene(cycles: u32, motion: &str) -> String {
    let mesher =
        "mesher = { order = 1, elements_profile = 2, elements_thickness = 2, elements_face = 2, elements_rim = 1 }\n";
    let cycles = if cycles > 0 { format!("cycles = {cycles}\n") } else { String::new() };
    ISO_SCENE
        .replace("[wheel]\n", &format!("{mesher}[wheel]\n{mesher}"))
        .replace("model = \"iso\"\n", &format!("kind = \"dynamic\"\npositions_per_cycle = 4\n{cycles}"))
        + MOTION_LINES
        + motion
}

/// The tiny scene of [`motion_scene`] at rest.
pub fn tiny_at_rest(positions: u32) -> String {
    let scene = motion_scene(0, "");
    let at_rest = scene.split("kind = \"dynamic\"").next().unwrap_or_default();
    format!("{at_rest}positions_per_cycle = {positions}\n")
}

/// A column of a file of rows.
pub fn column(csv: &str, name: &str) -> Vec<f64> {
    let mut lines = csv.lines();
    let at = lines.next().unwrap().split(',').position(|n| n == name).unwrap_or_else(|| panic!("no column {name}"));
    lines.map(|line| line.split(',').nth(at).unwrap().parse().unwrap()).collect()
}

/// All scenes of the repository.
pub fn scenes() -> Vec<PathBuf> {
    let (mut folders, mut scenes) = (vec![repository().join("scenes")], Vec::new());
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            match path.extension() {
                _ if path.is_dir() => folders.push(path),
                Some(e) if e == "toml" => scenes.push(path),
                _ => {}
            }
        }
    }
    scenes.sort();
    scenes
}

/// Sectors of five teeth: a chart of them takes a second or two a point.
pub fn five_teeth() -> String {
    let elements = "order = 1\nelements_profile = 4\nelements_fillet = 3\nelements_thickness = 3\nelements_face = 6\nelements_rim = 3\n";
    let mesher = |gear: &str| format!("[{gear}.mesher]\n{elements}sector_teeth = 5\n");
    let scene = ISO_SCENE.replace("model = \"iso\"", "positions_per_cycle = 8");
    format!("name = \"small\"\n{scene}{}{}", mesher("pinion"), mesher("wheel"))
}

/// Fields of a line of CSV; quoted ones without their quotes.
pub fn fields(line: &str) -> Vec<String> {
    let mut inside = false;
    let mut all = vec![String::new()];
    let mut left = line.chars().peekable();
    while let Some(c) = left.next() {
        match c {
            '"' if inside && left.next_if_eq(&'"').is_some() => all.last_mut().unwrap().push('"'),
            '"' => inside = !inside,
            ',' if !inside => all.push(String::new()),
            _ => all.last_mut().unwrap().push(c),
        }
    }
    all
}

/// Rows of a chart by the names of its columns.
pub fn chart_rows(csv: &str) -> Vec<BTreeMap<String, String>> {
    let header = fields(csv.lines().next().unwrap());
    let row = |line: &str| -> BTreeMap<String, String> {
        let row = fields(line);
        assert_eq!(row.len(), header.len(), "{line}");
        header.iter().cloned().zip(row).collect()
    };
    csv.lines().skip(1).map(row).collect()
}

/// Sentence and hint of a remark of a summary, as people read them.
pub fn remark_words(remark: &serde_json::Value) -> String {
    let word = |key: &str| remark[key].as_str().unwrap_or_default();
    format!("{}; {}", word("text"), word("hint"))
}
