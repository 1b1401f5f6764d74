//! How a scene says that a shaft holds a bore.

use std::path::Path;

use mesh::{Bolts, Foundation};
use scene::{BoreScene, Coupling, Scene, SceneError};

fn read(more: &str) -> Result<Scene, SceneError> {
    let text = format!(
        "[pinion]\nteeth = 21\nhelix_angle_deg = 0.0\n[wheel]\nteeth = 32\n[pair]\nnormal_module_mm = 3.0\n\
         face_width_mm = 30.0\n[operation]\ntorque_nm = 100.0\n{more}"
    );
    Scene::parse(&text, Path::new("a.toml"))
}

/// All of it, rigidly, is what nothing is said of; each gear has its own.
#[test]
fn a_bore_is_read_as_it_is_written() {
    let scene = read("").unwrap();
    assert_eq!((scene.pinion.bore, scene.wheel.bore), (BoreScene::default(), BoreScene::default()));
    let springs = "[pinion.bore]\ncoupling = \"elastic\"\ntangential_n_per_mm3 = 900\naxial_n_per_mm3 = 1e3\n";
    let found = read(springs).unwrap().pinion.bore;
    let springs = Foundation::new([0.0, 900.0, 1e3], None).unwrap();
    assert_eq!((found.coupling, found.foundation().unwrap()), (Coupling::Elastic, springs));
    let bolts = |count: u32, more: &str| {
        let hold = "tangential_n_per_mm = 2e5\naxial_n_per_mm = 1e5\n";
        format!(
            "[wheel.bore]\ncoupling = \"elastic\"\n[wheel.bore.bolts]\ncount = {count}\nwidth_mm = 8.0\n{hold}{more}"
        )
    };
    let found =
        read(&bolts(6, "first_angle_deg = 30.0\nover_mm = [-4.0, 4.0]\n")).unwrap().wheel.bore.foundation().unwrap();
    let (first_angle, heights, stiffness) = (30f64.to_radians(), Some([-4.0, 4.0]), [0.0, 2e5, 1e5]);
    let wanted = Bolts { count: 6, first_angle, width: 8.0, heights, stiffness, opens_beyond: None };
    assert_eq!(found, Foundation::new([0.0; 3], Some(wanted)).unwrap());
    for (scene, said) in [
        ("[wheel.bore]\ncoupling = \"elastic\"\n[wheel.bore.bolts]\ncount = 6\n".into(), "an arc of the bore"),
        (bolts(6, "preload_n = 5.0\n"), "`preload_n` is of bolts that open"),
        (bolts(2, ""), "2 bolts alone"),
        (bolts(6, "over_mm = [3.0, 2.0]\n"), "`over_mm` is not two heights"),
    ] {
        let error = read(&scene).err().unwrap_or_else(|| panic!("not refused: {scene}"));
        assert!(error.to_string().contains(said), "{error}");
    }
    let scene = read("[wheel.bore]\nheld_mm = [-15.0, 2]\ncoupling = \"distributing\"\n").unwrap();
    let wanted = BoreScene { held_mm: Some([-15.0, 2.0]), coupling: Coupling::Distributing, ..BoreScene::default() };
    assert_eq!((scene.pinion.bore, scene.wheel.bore), (BoreScene::default(), wanted));
}

/// What is no part of a bore, and what no model or bound knows.
#[test]
fn bores_that_nothing_knows_are_refused() {
    let by_means = "[pinion.bore]\ncoupling = \"distributing\"\n";
    let part = "[pinion.bore]\nheld_mm = [0.0, 9.0]\n";
    for (more, said) in [
        ("[pinion.bore]\nheld_mm = [4.0, -4.0]\n".into(), "not two heights"),
        ("[pinion.bore]\nheld_mm = [4.0]\n".into(), "not two heights"),
        ("[pinion.bore]\ncoupling = \"rbe3\"\n".into(), "distributing"),
        (format!("{part}[analysis]\nmodel = \"iso\"\n"), "means nothing to the model \"iso\""),
        (format!("{by_means}[analysis]\nmodel = \"full\"\n"), "the model \"full\" does not know"),
        ("[pinion.bore]\ncoupling = \"elastic\"\n".into(), "let the gear turn about its axis"),
        (
            "[pinion.bore]\ncoupling = \"elastic\"\ntangential_n_per_mm3 = 1.0\n".into(),
            "let the gear move along its axis",
        ),
        ("[pinion.bore]\naxial_n_per_mm3 = 1.0\n".into(), "the coupling \"kinematic\" has none"),
        ("[pinion.bore]\ncoupling = \"elastic\"\naxial_n_per_mm3 = -1.0\n".into(), "axial_n_per_mm3"),
        (format!("{part}[accuracy]\nmean_ste = \"1 %\"\n"), "rigid bores"),
    ] {
        let error = read(&more).err().unwrap_or_else(|| panic!("not refused: {more}"));
        assert!(error.to_string().contains(said), "{more}: {error}");
    }
    let springs = "[pinion.bore]\ncoupling = \"elastic\"\ntangential_n_per_mm3 = 1.0\naxial_n_per_mm3 = 1.0\n";
    assert!(read(&format!("{springs}[analysis]\nmodel = \"full\"\n")).is_ok(), "springs, whole gear");
    assert!(read(&format!("{part}[analysis]\nmodel = \"full\"\n")).is_ok(), "a part of the bore, whole gear");
}
