//! All keys of a scene file: type, range, default, meaning. Checks take ranges and defaults from here, and so does the
//! JSON Schema.
//!
//! | module | tables |
//! |---|---|
//! | `scene` | the file itself, pair, load, contact, analysis, output |
//! | `gear` | a gear with mesh and material |
//! | `flank` | micro-geometry |
//! | `accuracy` | headline numbers that an accuracy may be asked of |
//! | `motion` | bodies, bearings, torques, integration, analyses in time |
//! | `models` | cheaper models |
//! | `rating` | whether the pair will hold |
//! | `json` | all of them as JSON Schema |
//!
//! An enum of words is defined below the first row that uses it. Nothing here depends on the checked scene.

mod accuracy;
mod flank;
mod gear;
mod json;
mod models;
mod motion;
mod rating;
mod scene;

use crate::table::{Key, ValueKind};

pub use accuracy::Quantity;
pub(crate) use accuracy::{Asked, GEARBOX_ACCURACY, RawGearboxAccuracy};
pub use flank::{FlankScene, ModificationScene};
pub(crate) use flank::{RawFlank, RawModification};
pub(crate) use gear::*;
pub use gear::{BoltsScene, BoreScene, Coupling, GearScene, Material, MesherScene, ShaperScene};
pub(crate) use json::DOCUMENTS;
pub use json::json_schema;
pub(crate) use models::*;
pub use models::{
    DiscScene, ImpactScene, Law, Lumped8Scene, Lumped12Scene, MeshScene, Shaft18Scene, ShaftCoordinate, ShaftScene,
    Sharing, StiffnessFrom, SupportScene,
};
pub(crate) use motion::*;
pub use motion::{
    Axis, BasinScene, BearingScene, BodyScene, Boundary, ContinuationKey, ContinuationScene, DriveBy, Integration,
    ModesScene, MotionScene, RampScene, Run, SteadyBy, SweepScene, SweepWay,
};
pub(crate) use rating::*;
pub use rating::{LubricationScene, RatedGearScene, RatingEdition, RatingScene};
pub(crate) use scene::*;
pub use scene::{
    Analysis, ContactScene, FieldName, Flanks, Gap, Kind, Method, MisalignmentScene, Model, Operation, OutputScene,
    PairScene, Reduction, Turn,
};

/// All keys of the scene file as dotted paths: `pinion.modification.drive.tip_relief_um`, `pinion.shaft.discs.0.at_mm`.
pub fn all_keys() -> Vec<String> {
    let mut all = Vec::new();
    SCENE.walk("", &mut |path, table| {
        let leaf = |key: &&Key| !matches!(key.kind, ValueKind::Table(_) | ValueKind::Tables(_));
        // Of a list of tables the first one stands for all.
        let path = path.strip_prefix('[').and_then(|p| p.strip_suffix(']')).map_or(path.into(), |p| format!("{p}.0"));
        let dotted = |key: &Key| if path.is_empty() { key.name.to_owned() } else { format!("{path}.{}", key.name) };
        all.extend(table.keys.iter().filter(leaf).map(dotted));
    });
    all
}

/// What a key of the scene says; `None` of keys of one name that say different things.
pub(crate) fn meaning(name: &str) -> Option<&'static str> {
    let mut all = Vec::new();
    SCENE.walk("", &mut |_, table| all.extend(table.about(name)));
    all.dedup();
    if all.len() == 1 { all.pop() } else { None }
}

/// Every table of the scene file with its keys, the file itself first; a list of tables has brackets about its name.
pub(crate) fn tables() -> Vec<(String, Vec<&'static str>)> {
    SCENE.names()
}

#[cfg(test)]
mod tests {
    use mesh::StructuredOptions;

    use super::*;
    use crate::Scene;
    use crate::keys::advice;
    use crate::spanned::NAMED;
    use crate::table::Table;

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
        SCENE.walk("", &mut |path, table| all.push((path.to_owned(), table)));
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
                    ValueKind::Number { .. } => ("\"x\"", "must be a number"),
                    ValueKind::Whole { .. } | ValueKind::SignedWhole { .. } => ("0.5", "must be a whole number"),
                    ValueKind::Word { .. } | ValueKind::Text => ("1", "must be a text in quotes"),
                    ValueKind::Switch { .. } => ("1", "must be true or false"),
                    ValueKind::Words { .. }
                    | ValueKind::Texts
                    | ValueKind::Numbers
                    | ValueKind::Wholes
                    | ValueKind::Rows { .. }
                    | ValueKind::Tables(_) => ("1", "must be a list"),
                    ValueKind::Document(_) => ("1", NAMED),
                    ValueKind::Table(_) => ("1", "must be a table"),
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
            ValueKind::Word { choices, .. } | ValueKind::Words { choices } => Some(choices),
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
                "rating",
                "life_h = 1.0\napplication_factor = 1.0\ntolerance_class = 6\nlubricant = \"a\"\n[rating.pinion]\nmaterial = \"a\"\nflank_roughness_rz_um = 3.0\nroot_roughness_rz_um = 16.0\n[rating.wheel]\nmaterial = \"a\"\nflank_roughness_rz_um = 3.0\nroot_roughness_rz_um = 16.0\n",
            ),
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
            // Shafts are many tables deep; their one list is that of the axes, checked in `models/shaft.rs`.
            if path.contains("shaft") {
                continue;
            }
            for key in table.keys {
                let Some(choices) = of(key) else { continue };
                let list = matches!(key.kind, ValueKind::Words { .. });
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
                if !list && matches!(key.kind, ValueKind::Word { first_is_default: true, .. }) {
                    assert_eq!(taken[0], wanted[0], "[{path}] {}: the default", key.name);
                }
                wanted.sort_unstable();
                taken.sort_unstable();
                assert_eq!(taken, wanted, "[{path}] {}", key.name);
            }
        }
    }

    #[test]
    fn advice_finds_neighbours_tables_and_units() {
        let of = |table: &str| tables().into_iter().find(|(name, _)| name == table).unwrap().1;
        assert_eq!(advice((tables, None), ("face_widht_mm", false), &of("pair")), "did you mean `face_width_mm`?");
        assert_eq!(advice((tables, None), ("teeth", false), &of("pair")), "`teeth` belongs to [pinion]");
        assert_eq!(advice((tables, None), ("torque", false), &of("operation")), "did you mean `torque_nm`?");
        assert_eq!(advice((tables, None), ("keeps", false), &of("pair")), "`keeps` belongs to [[pinion.shaft.discs]]");
        for word in ["module", "module_mm", "m_n", "m", "modul"] {
            assert_eq!(
                advice((tables, None), (word, false), &of("pair")),
                "did you mean `normal_module_mm`?",
                "{word}"
            );
        }
        for word in ["module", "module_mm", "m_n"] {
            assert_eq!(
                advice((tables, None), (word, false), &of("")),
                "did you mean `normal_module_mm` in [pair]?",
                "{word}"
            );
        }
        assert_eq!(advice((tables, None), ("rpm", false), &of("operation")), "did you mean `speed_rpm`?");
        let beside =
            (tables as crate::keys::Tables, Some(("a gearbox file", crate::gearbox::tables as crate::keys::Tables)));
        assert_eq!(advice(beside, ("steps_per_cycle", false), &of("motion")), "did you mean `steps_per_mesh_cycle`?");
        let known = advice(beside, ("key_deg", false), &of("pinion"));
        assert!(known.starts_with("`key_deg` belongs to [[gear]] of a gearbox file; known here: "), "{known}");
        let long = "a".repeat(1 << 24);
        assert!(advice((tables, None), (&long, false), &of("pair")).starts_with("known here"));
        assert!(advice((tables, None), ("colour", false), &["poisson"]).starts_with("known here"));
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
