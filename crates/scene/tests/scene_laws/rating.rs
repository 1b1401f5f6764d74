//! `[rating]`: what is asked for, what is refused, what is written again.

use scene::{
    DataFile, Scene, SceneError,
    gearbox::{Gearbox, gearbox_of_pair},
};

const PAIR: &str = "[pinion]\nteeth = 24\nhelix_angle_deg = 10.0\n[wheel]\nteeth = 47\n[pair]\n\
                    normal_module_mm = 3.0\nface_width_mm = 30.0\n[operation]\ntorque_nm = 300.0\n";
const RATING: &str = "[rating]\nlife_h = 2e4\napplication_factor = 1.25\ntolerance_class = 6\n\
                      lubricant = \"mineral VG 220\"\n[rating.pinion]\nmaterial = \"18CrNiMo7-6\"\n\
                      flank_roughness_rz_um = 4.8\nroot_roughness_rz_um = 20.0\n[rating.wheel]\n\
                      material = \"16MnCr5\"\nflank_roughness_rz_um = 4.8\nroot_roughness_rz_um = 20.0\n";

fn read(text: &str) -> Result<Scene, SceneError> {
    Scene::parse(text, "a.toml".as_ref())
}

/// Every missing input is named, all at once, and nothing is assumed.
#[test]
fn what_is_missing_is_asked_for_by_name() {
    let error = read(&format!("{PAIR}[rating]\n")).unwrap_err();
    let SceneError::Missing { keys, .. } = &error else { panic!("{error}") };
    assert_eq!(keys.len(), 10, "{keys:?}");
    assert_eq!((&*keys[0], &*keys[9]), ("`[rating] life_h`", "`[rating.wheel] root_roughness_rz_um`"));
    let whole = format!("{PAIR}{RATING}");
    assert!(read(&whole).is_ok());
    for key in [
        "life_h",
        "application_factor",
        "tolerance_class",
        "lubricant",
        "material",
        "flank_roughness_rz_um",
        "root_roughness_rz_um",
    ] {
        let line = whole.lines().find(|line| line.starts_with(key)).unwrap();
        let error = read(&whole.replacen(&format!("{line}\n"), "", 1)).unwrap_err().to_string();
        assert!(error.contains(key), "{error}");
    }
}

/// A scene with a rating is the same when its own text is read, and names of tables are checked.
#[test]
fn ratings_are_written_as_they_are_read() {
    let scene = read(&format!("{PAIR}{RATING}")).unwrap();
    assert_eq!(read(&scene.to_toml()).unwrap().rating, scene.rating);
    let typo = read(&format!("{PAIR}{RATING}").replace("16MnCr5", "16MnCr4")).unwrap_err();
    assert_eq!(typo.hint().as_deref(), Some("did you mean \"16MnCr5\"?"), "{typo}");
    let unknown = read(&format!("{PAIR}{RATING}").replace("mineral VG 220", "olive")).unwrap_err();
    assert!(unknown.hint().unwrap().contains("`lubricants = \"FILE\"`"), "{unknown}");
}

/// A table of one's own replaces the program's, and a damaged one is refused with its name.
#[test]
fn tables_of_ones_own_replace_those_of_the_program() {
    let folder = tempfile::tempdir().unwrap();
    let row = "[[material]]\nname = \"mine\"\ngroup = \"nitrided\"\ncontact_limit_mpa = 1200.0\n\
               root_limit_mpa = 400.0\nsurface_hardness_hv = 700.0\nsource = \"test\"\n";
    std::fs::write(folder.path().join("steel.toml"), row).unwrap();
    let text = format!("{PAIR}{RATING}").replace("[rating]\n", "[rating]\nmaterials = \"steel.toml\"\n");
    let at = folder.path().join("a.toml");
    let unknown = Scene::parse(&text, &at).unwrap_err().to_string();
    assert!(unknown.contains("`material` is \"18CrNiMo7-6\", which the table of materials does not have"), "{unknown}");
    let own = text.replace("18CrNiMo7-6", "mine").replace("16MnCr5", "mine");
    let scene = Scene::parse(&own, &at).unwrap();
    let rating = scene.rating.as_ref().unwrap();
    assert_eq!(rating.material_of(1).unwrap().contact_limit_mpa, 1200.0);
    assert_eq!(scene.files().len(), 1);
    std::fs::write(folder.path().join("steel.toml"), row.replace("1200.0", "0.0")).unwrap();
    let damaged = Scene::parse(&own, &at).unwrap_err().to_string();
    assert!(damaged.contains("steel.toml: material \"mine\": `contact_limit_mpa` is 0"), "{damaged}");
}

/// Without slices K_Hbeta is asked for; motions are not rated.
#[test]
fn a_rating_needs_a_load_distribution_and_rest() {
    let iso = format!("{PAIR}[analysis]\nmodel = \"iso\"\n{RATING}");
    let error = read(&iso).unwrap_err().to_string();
    assert!(error.ends_with("missing `[rating] face_load_factor`"), "{error}");
    assert!(read(&iso.replace("[rating]\n", "[rating]\nface_load_factor = 1.2\n")).is_ok());
    let moving = read(&format!("{PAIR}[analysis]\nkind = \"dynamic\"\n{RATING}")).unwrap_err();
    assert!(matches!(moving, SceneError::NotYet { .. }), "{moving}");
    let idle = read(&format!("{PAIR}{RATING}").replace("torque_nm = 300.0", "torque_nm = 0.0")).unwrap_err();
    assert!(idle.to_string().contains("nothing is loaded"), "{idle}");
}

/// What scuffing, micropitting and losses need is asked for by name, all at once; what nothing reads is refused.
#[test]
fn oil_and_flanks_are_asked_for_by_name() {
    let with = |lines: &str| format!("{PAIR}{RATING}").replace("[rating]\n", &format!("[rating]\n{lines}"));
    let missing = |lines: &str| match read(&with(lines)).unwrap_err() {
        SceneError::Missing { keys, .. } => keys,
        other => panic!("{other}"),
    };
    let rough = ["`[rating.pinion] flank_roughness_ra_um`", "`[rating.wheel] flank_roughness_ra_um`"];
    let hot = ["`[rating] oil_temperature_c`", "`[rating] lubrication`"];
    assert_eq!(missing("oil_temperature_c = 80.0\n"), rough);
    assert_eq!(missing("scuffing = true\n"), [&hot[..], &["`[rating] structural_factor`"], &rough[..]].concat());
    assert_eq!(missing("micropitting = true\n"), [&hot[..], &["`[rating] material_factor`"], &rough[..]].concat());
    let stated = "micropitting = true\npermissible_specific_film_thickness = 0.3\n";
    assert_eq!(missing(stated), [&hot[..], &rough[..]].concat());
    let smooth = |lines: &str| with(lines).replace("material =", "flank_roughness_ra_um = 0.6\nmaterial =");
    let scene =
        read(&smooth("oil_temperature_c = 80.0\nlubrication = \"spray\"\nscuffing = true\nstructural_factor = 1.0\n"));
    let scene = scene.unwrap();
    assert_eq!(scene.rating.as_ref().unwrap().lubrication, Some(scene::LubricationScene::Spray));
    assert_eq!(read(&scene.to_toml()).unwrap().rating, scene.rating);
    for (lines, key) in [
        ("oil_temperature_c = 80.0\nlubrication = \"dip\"\n", "lubrication"),
        ("oil_temperature_c = 80.0\nstructural_factor = 1.0\n", "structural_factor"),
        ("oil_temperature_c = 80.0\nmaterial_factor = 1.0\n", "material_factor"),
        (
            "oil_temperature_c = 80.0\npermissible_specific_film_thickness = 0.3\n",
            "permissible_specific_film_thickness",
        ),
        ("", "flank_roughness_ra_um"),
    ] {
        let error = read(&smooth(lines)).unwrap_err().to_string();
        assert!(error.contains(&format!("`{key}` belongs to")), "{error}");
    }
    let iso = |lines: &str| {
        let text = smooth(lines).replace("[rating]\n", "[rating]\nface_load_factor = 1.2\n");
        read(&text.replace("[rating]\n", "[analysis]\nmodel = \"iso\"\n[rating]\n"))
    };
    let error = iso("oil_temperature_c = 80.0\n").unwrap_err().to_string();
    assert!(error.contains("`oil_temperature_c` wants the pressures"), "{error}");
    assert!(iso("oil_temperature_c = 80.0\nlubrication = \"dip\"\nscuffing = true\nstructural_factor = 1.0\n").is_ok());
    let film = "oil_temperature_c = 80.0\nlubrication = \"dip\"\nmicropitting = true\nmaterial_factor = 1.0\n";
    let error = iso(film).unwrap_err().to_string();
    assert!(error.contains("`micropitting` wants the pressures"), "{error}");
}

/// A pair's loads are those of the gearbox that stands for it; the scene of a mesh has none of its own.
#[test]
fn loads_belong_to_the_gearbox() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("loads.csv"), "torque_nm,speed_rpm,share\n300,1000,1\n90,1500,3\n").unwrap();
    let text = format!("{PAIR}{RATING}").replace("[rating]\n", "[rating]\nspectrum = \"loads.csv\"\n");
    let scene = Scene::parse(&text, &folder.path().join("a.toml")).unwrap();
    let of_pair = gearbox_of_pair(&scene).unwrap().text;
    let gearbox =
        Gearbox::parse(&of_pair, &folder.path().join("box.toml")).unwrap_or_else(|e| panic!("{e}\n{of_pair}"));
    let loads = gearbox.rating.unwrap().spectrum.unwrap();
    assert_eq!(Some(loads.values()), scene.rating.as_ref().unwrap().spectrum.as_ref().map(DataFile::values));
    let own = of_pair.replace("[mesh.scene.rating]\n", "[mesh.scene.rating]\nspectrum = \"loads.csv\"\n");
    assert_ne!(own, of_pair);
    let refused = Gearbox::parse(&own, &folder.path().join("box.toml")).unwrap_err();
    assert!(refused.to_string().contains("the scene of mesh \"pair\" has a load spectrum of its own"), "{refused}");
    assert!(refused.hint().unwrap().contains("`spectrum`"), "{refused}");
}
