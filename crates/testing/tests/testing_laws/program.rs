//! Programs as cargo finds them in a package, the files that their `mod` lines lead to, and the tests in these.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// Top of the repository.
pub fn repository() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().nth(2).unwrap()
}

/// Folders of the packages of the workspace.
pub fn packages() -> Vec<PathBuf> {
    let top = repository();
    let mut packages = entries(&top.join("crates"));
    packages.extend(["tests", "benches"].map(|name| top.join(name)));
    packages
}

/// A package's `Cargo.toml`.
pub fn manifest(package: &Path) -> toml::Value {
    let file = package.join("Cargo.toml");
    let text = fs::read_to_string(&file).unwrap_or_else(|e| panic!("{}: {e}", file.display()));
    toml::from_str(&text).unwrap_or_else(|e| panic!("{}: {e}", file.display()))
}

/// Name of a package.
pub fn package_name(package: &Path) -> String {
    manifest(package)["package"]["name"].as_str().unwrap().to_owned()
}

/// What is in a folder, in the order of names; nothing where there is none.
pub fn entries(folder: &Path) -> Vec<PathBuf> {
    let mut found: Vec<PathBuf> = fs::read_dir(folder).into_iter().flatten().map(|e| e.unwrap().path()).collect();
    found.sort();
    found
}

/// Whether a file ends in one of these.
pub fn ends_in(file: &Path, extensions: &[&str]) -> bool {
    file.extension().is_some_and(|e| extensions.iter().any(|other| e == *other))
}

/// Folders of builds and results.
const MADE: [&str; 3] = ["target", "out", ".git"];

/// Files below a folder that end in one of these.
pub fn files_below(folder: &Path, extensions: &[&str]) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in entries(folder) {
        if !entry.is_dir() {
            found.extend(ends_in(&entry, extensions).then_some(entry));
        } else if !MADE.iter().any(|made| entry.ends_with(made)) {
            found.extend(files_below(&entry, extensions));
        }
    }
    found
}

/// What a program is for; cargo looks for each in a folder of its own.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    Library,
    Binary,
    Test,
    Bench,
    Example,
    Build,
}

/// A library, a binary, a test program, a bench or an example.
#[derive(Debug)]
pub struct Program {
    pub kind: Kind,
    pub name: String,
    /// Files with the paths of their modules, `search` or `keys::rows`; the root's is empty.
    pub files: Vec<(String, PathBuf)>,
}

impl Program {
    fn new(kind: Kind, name: String, root: PathBuf) -> Self {
        let mut program = Self { kind, name, files: Vec::new() };
        program.follow("", root, true);
        program
    }

    /// Adds a file and all that its `mod` lines lead to. `owns` says whether its modules lie beside it, as those of
    /// `main.rs` and `mod.rs` do.
    fn follow(&mut self, module: &str, file: PathBuf, owns: bool) {
        let text = fs::read_to_string(&file).unwrap_or_else(|e| panic!("{}: {e}", file.display()));
        self.files.push((module.to_owned(), file.clone()));
        let beside = file.parent().unwrap();
        let folder = if owns { beside.to_owned() } else { file.with_extension("") };
        for (name, path) in modules(&text) {
            let below = if module.is_empty() { name.clone() } else { format!("{module}::{name}") };
            let choices = match path {
                Some(path) => vec![(beside.join(path), true)],
                None => {
                    vec![(folder.join(&name).with_extension("rs"), false), (folder.join(&name).join("mod.rs"), true)]
                }
            };
            if let Some((file, owns)) = choices.into_iter().find(|(file, _)| file.is_file()) {
                self.follow(&below, file, owns);
            }
        }
    }

    /// Names of the tests, `search::finds_all` for the function `finds_all` of the module `search`.
    pub fn tests(&self) -> Vec<String> {
        let full = |module: &str, name: String| if module.is_empty() { name } else { format!("{module}::{name}") };
        let in_file = |(module, file): &(String, PathBuf)| -> Vec<String> {
            let text = fs::read_to_string(file).unwrap();
            test_functions(&text).into_iter().map(|name| full(module, name)).collect()
        };
        self.files.iter().flat_map(in_file).collect()
    }
}

/// Names of the modules that a text leaves to other files, with the path where one is given.
fn modules(text: &str) -> Vec<(String, Option<String>)> {
    let (mut found, mut path) = (Vec::new(), None);
    for line in text.lines().map(str::trim) {
        if let Some(given) = line.strip_prefix("#[path = \"") {
            path = given.split('"').next().map(str::to_owned);
            continue;
        }
        let item = if line.starts_with("pub") { line.split_once(' ').map_or("", |(_, item)| item) } else { line };
        if let Some(name) = item.strip_prefix("mod ").and_then(|name| name.strip_suffix(';')) {
            found.push((name.to_owned(), path.take()));
        }
        if !line.starts_with("#[") {
            path = None;
        }
    }
    found
}

/// Names of the functions below `#[test]`; those that a macro names are not seen.
fn test_functions(text: &str) -> Vec<String> {
    let name = |after: &str| {
        let line =
            after.lines().map(str::trim).find(|l| !l.is_empty() && !l.starts_with("#[") && !l.starts_with("//"))?;
        let name: String = line.strip_prefix("fn ")?.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
        (!name.is_empty()).then_some(name)
    };
    text.split("#[test]").skip(1).filter_map(name).collect()
}

/// All programs that cargo finds in a package.
pub fn programs(package: &Path) -> Vec<Program> {
    let named = |file: &Path| file.file_stem().unwrap().to_string_lossy().into_owned();
    let own = named(package);
    let mut found = Vec::new();
    let single = [("src/lib.rs", Kind::Library), ("src/main.rs", Kind::Binary), ("build.rs", Kind::Build)];
    for (file, kind) in single {
        let root = package.join(file);
        found.extend(root.is_file().then(|| Program::new(kind, own.clone(), root)));
    }
    let folders =
        [("src/bin", Kind::Binary), ("tests", Kind::Test), ("benches", Kind::Bench), ("examples", Kind::Example)];
    for (folder, kind) in folders {
        for entry in entries(&package.join(folder)) {
            let root = if entry.is_dir() { entry.join("main.rs") } else { entry.clone() };
            found.extend((root.is_file() && ends_in(&root, &["rs"])).then(|| Program::new(kind, named(&entry), root)));
        }
    }
    found
}

/// Rust files of a package that none of its programs reads.
pub fn read_by_none(package: &Path) -> Vec<PathBuf> {
    let read: BTreeSet<PathBuf> =
        programs(package).into_iter().flat_map(|p| p.files).map(|(_, file)| file.canonicalize().unwrap()).collect();
    files_below(package, &["rs"]).into_iter().filter(|file| !read.contains(&file.canonicalize().unwrap())).collect()
}
