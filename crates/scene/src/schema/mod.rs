//! Every key of a scene file once: type, range, default, meaning. Checks take ranges and defaults from here, and so
//! does the JSON Schema.
//!
//! | module | tables |
//! |---|---|
//! | `scene` | the file itself, pair, load, contact, analysis, output |
//! | `gear` | a gear with mesh and material |
//! | `crate::modification` | micro-geometry: rows, checks, and what geometry they are |
//! | `motion` | bodies, bearings, torques, integration, analyses in time |
//! | `ladder` | cheaper models |
//! | `json` | all of them as JSON Schema |

mod gear;
mod json;
mod ladder;
mod motion;
mod scene;

pub(crate) use gear::*;
pub use json::json_schema;
pub(crate) use ladder::*;
pub use ladder::{ImpactScene, Lumped12Scene, SupportScene};
pub(crate) use motion::*;
pub use motion::{BasinScene, ContinuationScene, RampScene};
pub(crate) use scene::*;
pub use scene::{MisalignmentScene, Operation};

pub(crate) const INF: f64 = f64::INFINITY;

/// An enum of which each value is a word of the scene file.
pub(crate) trait Choice: Copy + 'static {
    /// Words and values; the first one is the default.
    const CHOICES: &'static [(&'static str, Self)];
}

/// A field of a checked table.
pub(crate) trait Field {
    /// Whether the written scene leaves it out.
    fn is_absent(&self) -> bool {
        false
    }
}

impl Field for f64 {}
impl Field for u32 {}
impl<T> Field for Option<T> {
    fn is_absent(&self) -> bool {
        self.is_none()
    }
}

/// A table of the scene file.
#[derive(Debug)]
pub(crate) struct Table {
    /// What it is about.
    pub about: &'static str,
    /// What may stand in it.
    pub keys: &'static [Key],
    /// Keys without a default.
    pub needed: &'static [&'static str],
}

/// A key of a table.
#[derive(Debug)]
pub(crate) struct Key {
    /// As in the file, with its unit.
    pub name: &'static str,
    /// What may stand behind it.
    pub kind: Kind,
    /// What it says.
    pub about: &'static str,
}

/// What may stand behind a key.
#[derive(Debug)]
pub(crate) enum Kind {
    /// A number within a range; an infinite end depends on the rest of the scene. No default: it follows from other
    /// keys, or there is none.
    Number { low: f64, high: f64, default: Option<f64> },
    /// A whole number.
    Whole { low: u32, high: u32, default: Option<u32> },
    /// One of some words; the first is what holds where none is written, unless that depends on other keys.
    Word { choices: &'static [&'static str], first_is_default: bool },
    /// Some of some words.
    Words { choices: &'static [&'static str] },
    /// On or off.
    Switch { default: bool },
    /// Any text: a name, a path.
    Text,
    /// A list of texts.
    Texts,
    /// A list of numbers.
    Numbers,
    /// Rows of so many numbers.
    Rows { columns: usize },
    /// A table of its own.
    Table(&'static Table),
    /// Tables of one kind, as many as one likes.
    Tables(&'static Table),
}

pub(crate) const fn key(name: &'static str, kind: Kind, about: &'static str) -> Key {
    Key { name, kind, about }
}

/// A number with a default.
pub(crate) const fn number(name: &'static str, low: f64, high: f64, default: f64, about: &'static str) -> Key {
    key(name, Kind::Number { low, high, default: Some(default) }, about)
}

/// A number that must be there.
pub(crate) const fn must(name: &'static str, low: f64, high: f64, about: &'static str) -> Key {
    bare(name, low, high, about)
}

/// A number without.
pub(crate) const fn bare(name: &'static str, low: f64, high: f64, about: &'static str) -> Key {
    key(name, Kind::Number { low, high, default: None }, about)
}

pub(crate) const fn whole(name: &'static str, low: u32, high: u32, default: u32, about: &'static str) -> Key {
    key(name, Kind::Whole { low, high, default: Some(default) }, about)
}

pub(crate) const fn bare_whole(name: &'static str, low: u32, high: u32, about: &'static str) -> Key {
    key(name, Kind::Whole { low, high, default: None }, about)
}

pub(crate) const fn word(name: &'static str, choices: &'static [&'static str], about: &'static str) -> Key {
    key(name, Kind::Word { choices, first_is_default: true }, about)
}

/// A word whose default depends on other keys.
pub(crate) const fn bare_word(name: &'static str, choices: &'static [&'static str], about: &'static str) -> Key {
    key(name, Kind::Word { choices, first_is_default: false }, about)
}

pub(crate) const fn words(name: &'static str, choices: &'static [&'static str], about: &'static str) -> Key {
    key(name, Kind::Words { choices }, about)
}

pub(crate) const fn switch(name: &'static str, default: bool, about: &'static str) -> Key {
    key(name, Kind::Switch { default }, about)
}

pub(crate) const fn text(name: &'static str, about: &'static str) -> Key {
    key(name, Kind::Text, about)
}

pub(crate) const fn texts(name: &'static str, about: &'static str) -> Key {
    key(name, Kind::Texts, about)
}

pub(crate) const fn numbers(name: &'static str, about: &'static str) -> Key {
    key(name, Kind::Numbers, about)
}

pub(crate) const fn rows(name: &'static str, columns: usize, about: &'static str) -> Key {
    key(name, Kind::Rows { columns }, about)
}

pub(crate) const fn table(name: &'static str, of: &'static Table) -> Key {
    key(name, Kind::Table(of), of.about)
}

pub(crate) const fn list(name: &'static str, of: &'static Table) -> Key {
    key(name, Kind::Tables(of), of.about)
}

impl Table {
    /// Range and default of a number; `value!` names no key that has no row.
    pub fn number(&self, name: &str) -> (f64, f64, Option<f64>) {
        match self.keys.iter().find(|k| k.name == name).map(|k| &k.kind) {
            Some(&Kind::Number { low, high, default }) => (low, high, default),
            _ => (f64::NEG_INFINITY, f64::INFINITY, None),
        }
    }

    /// Whether a switch is on where nothing is written.
    pub fn switch(&self, name: &str) -> bool {
        self.keys.iter().any(|k| k.name == name && matches!(k.kind, Kind::Switch { default: true }))
    }

    /// What a key says; none of one that stands in another table.
    pub fn about(&self, name: &str) -> Option<&'static str> {
        self.keys.iter().find(|k| k.name == name).map(|k| k.about)
    }

    /// Range and default of a whole number.
    pub fn whole(&self, name: &str) -> (u32, u32, Option<u32>) {
        match self.keys.iter().find(|k| k.name == name).map(|k| &k.kind) {
            Some(&Kind::Whole { low, high, default }) => (low, high, default),
            _ => (0, u32::MAX, None),
        }
    }
}

/// Every key of the scene file with dots before it: `pinion.modification.drive.tip_relief_um`,
/// `pinion.shaft.discs.0.at_mm`.
pub fn all_keys() -> Vec<String> {
    let mut all = Vec::new();
    walk("", &SCENE, &mut |path, table| {
        let leaf = |key: &&Key| !matches!(key.kind, Kind::Table(_) | Kind::Tables(_));
        // Of a list of tables the first one stands for all.
        let path = path.strip_prefix('[').and_then(|p| p.strip_suffix(']')).map_or(path.into(), |p| format!("{p}.0"));
        let dotted = |key: &Key| if path.is_empty() { key.name.to_owned() } else { format!("{path}.{}", key.name) };
        all.extend(table.keys.iter().filter(leaf).map(dotted));
    });
    all
}

/// What a key of the scene says, of several of one name the first.
pub(crate) fn meaning(name: &str) -> Option<&'static str> {
    let mut found = None;
    walk("", &SCENE, &mut |_, table| found = found.or(table.about(name)));
    found
}

/// Every table of the scene file with its keys, the file itself first; a list of tables has brackets about its name.
pub(crate) fn tables() -> Vec<(String, Vec<&'static str>)> {
    let mut all = Vec::new();
    walk("", &SCENE, &mut |path, table| all.push((path.to_owned(), table.keys.iter().map(|k| k.name).collect())));
    all
}

/// Visits a table and those in it, with their names.
fn walk(path: &str, table: &'static Table, visit: &mut impl FnMut(&str, &'static Table)) {
    visit(path, table);
    let inner = |key: &Key| if path.is_empty() { key.name.to_owned() } else { format!("{path}.{}", key.name) };
    for key in table.keys {
        match key.kind {
            Kind::Table(of) => walk(&inner(key), of, visit),
            Kind::Tables(of) => walk(&format!("[{}]", inner(key)), of, visit),
            _ => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use mesh::StructuredOptions;

    use super::*;
    use crate::Scene;

    /// A scene of which every table has what it needs, with `line` in `table`.
    fn scene_with(table: &str, line: &str) -> String {
        let needed = [
            ("pinion", "teeth = 30\nhelix_angle_deg = 20.0\n"),
            ("wheel", "teeth = 30\n"),
            ("pair", "normal_module_mm = 3.0\nface_width_mm = 20.0\n"),
            ("operation", "torque_nm = 150.0\n"),
        ];
        let mut text = if table.is_empty() { format!("{line}\n") } else { String::new() };
        for (name, lines) in needed {
            let own = if name == table { format!("{line}\n") } else { String::new() };
            text += &format!("[{name}]\n{lines}{own}");
        }
        if !table.is_empty() && needed.iter().all(|(name, _)| *name != table) {
            text += &format!("[{table}]\n{line}\n");
        }
        text
    }

    fn complaint(table: &str, line: &str) -> String {
        let text = scene_with(table, line);
        Scene::parse(&text, "a.toml".as_ref()).expect_err(&text).to_string()
    }

    fn every_table() -> Vec<(String, &'static Table)> {
        let mut all = Vec::new();
        walk("", &SCENE, &mut |path, table| all.push((path.to_owned(), table)));
        all
    }

    /// What the reader takes is what the tables list, no more and no less: the reader itself names what it knows when
    /// it meets another key.
    #[test]
    fn the_tables_are_the_words_that_are_read() {
        for (path, table) in every_table() {
            let text = scene_with(&path, "zzz_unknown = 1");
            let error = toml::from_str::<crate::schema::RawScene>(&text).expect_err(&text);
            let said = error.message().to_owned();
            let rest = said.strip_prefix("unknown field `zzz_unknown`").unwrap_or_else(|| panic!("[{path}]: {said}"));
            let mut known: Vec<&str> = rest.split('`').skip(1).step_by(2).collect();
            let mut listed: Vec<&str> = table.keys.iter().map(|k| k.name).collect();
            known.sort_unstable();
            listed.sort_unstable();
            assert_eq!(known, listed, "[{path}]: read and listed");
        }
    }

    /// Every key has the type that the reader wants: a value of another type is refused as such.
    #[test]
    fn the_types_are_those_that_are_read() {
        for (path, table) in every_table() {
            for key in table.keys {
                let (wrong, expected) = match key.kind {
                    Kind::Number { .. } => ("\"x\"", "must be a number"),
                    Kind::Whole { .. } => ("0.5", "must be a whole number"),
                    Kind::Word { .. } | Kind::Text => ("1", "must be a text in quotes"),
                    Kind::Switch { .. } => ("1", "must be true or false"),
                    Kind::Words { .. } | Kind::Texts | Kind::Numbers | Kind::Rows { .. } | Kind::Tables(_) => {
                        ("1", "must be a list")
                    }
                    Kind::Table(_) => ("1", "must be a table"),
                };
                // Tables that every scene has stand there already.
                if path.is_empty() && SCENE.needed.contains(&key.name) {
                    continue;
                }
                let line = format!("{} = {wrong}", key.name);
                let needed = table.needed.contains(&key.name)
                    && ["pinion", "wheel", "pair", "operation"].contains(&path.as_str());
                // Both are needed by some scenes alone, and stand in this one.
                let given = ["pinion.helix_angle_deg", "wheel.helix_angle_deg", "pair.face_width_mm"];
                if needed || given.contains(&format!("{path}.{}", key.name).as_str()) {
                    continue;
                }
                let said = complaint(&path, &line);
                assert!(said.contains(expected), "[{path}] {line}: {said}");
            }
        }
    }

    /// Choices are those that are taken.
    #[test]
    fn the_choices_are_those_that_are_taken() {
        let of = |key: &Key| match key.kind {
            Kind::Word { choices, .. } | Kind::Words { choices } => Some(choices),
            _ => None,
        };
        // Where a table belongs to some models only, or a word to others, the scene says so first.
        let with: &[(&str, &str)] = &[
            ("pinion.body", "[analysis]\nkind = \"dynamic\"\n"),
            ("wheel.body", "[analysis]\nkind = \"dynamic\"\n"),
            ("drive", "[analysis]\nkind = \"dynamic\"\n"),
            ("motion", "[analysis]\nkind = \"dynamic\"\n"),
            (
                "motion.sweep",
                "from_rpm = 1.0\nto_rpm = 2.0\n[analysis]\nkind = \"dynamic\"\n[motion]\nrun = \"sweep\"\n",
            ),
            (
                "motion.basins",
                "from_um = -1.0\nto_um = 2.0\nfrom_mm_s = -1.0\nto_mm_s = 1.0\n[analysis]\nkind = \"dynamic\"\n[motion]\nrun = \"basins\"\n",
            ),
            (
                "motion.continuation",
                "from = 1.0\nto = 2.0\n[analysis]\nkind = \"dynamic\"\n[motion]\nrun = \"continuation\"\n",
            ),
            ("modes", "[analysis]\nkind = \"dynamic\"\nmodel = \"reduced+modes\"\n"),
            (
                "mesh",
                "[analysis]\nmodel = \"lumped8\"\n[pinion.bearing]\nstiffness_x_n_per_mm = 1e5\nstiffness_y_n_per_mm = 1e5\nstiffness_z_n_per_mm = 1e5\n[wheel.bearing]\nstiffness_x_n_per_mm = 1e5\nstiffness_y_n_per_mm = 1e5\nstiffness_z_n_per_mm = 1e5\n",
            ),
            (
                "lumped8",
                "[analysis]\nmodel = \"lumped8\"\n[pinion.bearing]\nstiffness_x_n_per_mm = 1e5\nstiffness_y_n_per_mm = 1e5\nstiffness_z_n_per_mm = 1e5\n[wheel.bearing]\nstiffness_x_n_per_mm = 1e5\nstiffness_y_n_per_mm = 1e5\nstiffness_z_n_per_mm = 1e5\n",
            ),
        ];
        for (path, table) in every_table() {
            // Shafts are many tables deep; their one list is that of the axes, checked in `ladder/shaft.rs`.
            if path.contains("shaft") {
                continue;
            }
            for key in table.keys {
                let Some(choices) = of(key) else { continue };
                let list = matches!(key.kind, Kind::Words { .. });
                let line = if list { format!("{} = [\"zzz\"]", key.name) } else { format!("{} = \"zzz\"", key.name) };
                let before = with.iter().find(|(p, _)| *p == path).map_or("", |(_, t)| t);
                let relief = key.name.strip_suffix("_shape").map_or(String::new(), |what| match what {
                    "end_relief" => "\nend_relief_upper_um = 1.0\nend_relief_upper_length_mm = 1.0".into(),
                    what => format!("\n{what}_um = 1.0\n{what}_start_roll_deg = 20.0"),
                });
                let said = complaint(&path, &format!("{line}{relief}\n{before}"));
                let mut wanted: Vec<&str> = choices.to_vec();
                let allowed = said.split("allowed is ").nth(1).unwrap_or_else(|| panic!("[{path}] {line}: {said}"));
                let mut taken: Vec<&str> = allowed.split('"').skip(1).step_by(2).collect();
                if !list && matches!(key.kind, Kind::Word { first_is_default: true, .. }) {
                    assert_eq!(taken[0], wanted[0], "[{path}] {}: the default", key.name);
                }
                wanted.sort_unstable();
                taken.sort_unstable();
                assert_eq!(taken, wanted, "[{path}] {}", key.name);
            }
        }
    }

    /// The mesher's own defaults are those of the table.
    #[test]
    fn the_mesher_begins_with_the_same_numbers() {
        let d = StructuredOptions::default();
        let own = [
            ("order", d.order),
            ("elements_profile", d.elements_profile),
            ("elements_fillet", d.elements_fillet),
            ("elements_thickness", d.elements_thickness),
            ("elements_rim", d.elements_rim),
        ];
        for (key, value) in own {
            assert_eq!(MESHER.whole(key).2, Some(value), "{key}");
        }
    }
}
