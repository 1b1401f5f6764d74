//! A scene written out says the same as the scene read.

use std::path::Path;

use crate::util::{ISO_SCENE, repository};
use ale_gear::resolution::with_slices;
use ale_gear::scene::{Driver, Model, Scene, Sense};
use geometry::Side;

/// Every scene of the repository, with its defaults written out, reads back as itself.
#[test]
fn scenes_survive_a_round_trip() {
    let mut seen = 0;
    for entry in std::fs::read_dir(repository().join("scenes")).unwrap() {
        let file = entry.unwrap().path();
        if file.extension().is_some_and(|e| e == "toml") {
            let scene = Scene::read(&file).unwrap_or_else(|e| panic!("{e}"));
            let again = Scene::parse(&scene.to_toml(), &file).unwrap_or_else(|e| panic!("{e}\n{}", scene.to_toml()));
            assert_eq!(scene, again);
            seen += 1;
        }
    }
    assert!(seen >= 4, "only {seen} scenes");
}

/// What is left out has the documented value.
#[test]
fn defaults_are_those_of_the_documentation() {
    let minimal = "[pinion]\nteeth = 20\nhelix_angle_deg = 0\n[wheel]\nteeth = 40\n\
                   [pair]\nnormal_module_mm = 2\nface_width_mm = 10\n[operation]\ntorque_nm = 1\n";
    let scene = Scene::parse(minimal, Path::new("tiny.toml")).unwrap();
    assert_eq!(scene.name, "tiny");
    assert_eq!((scene.pinion.bore_diameter_mm, scene.wheel.bore_diameter_mm), (22.0, 44.0));
    assert_eq!((scene.wheel.helix_angle_deg, scene.wheel.thickness_allowance_mm), (0.0, 0.0));
    assert!(scene.wheel.helix_angle_deg.is_sign_positive());
    assert_eq!((scene.operation.speed_rpm, scene.operation.driver), (1000.0, Driver::Pinion));
    assert_eq!((scene.analysis.positions_per_cycle, scene.analysis.cycles), (32, 1));
    assert_eq!((scene.analysis.model, scene.contact.slices), (Model::Reduced, Some(32)));
    assert_eq!(scene.pinion.mesher.map(|m| (m.order, m.sector_teeth)), Some((2, 0)));
    assert_eq!(scene.wheel.material.young_mpa, 2.06e5);
}

/// Slices and face elements follow width, micro-geometry and load where the scene does not say them, stand in the
/// written scene, and are kept where it does.
#[test]
fn slices_and_face_elements_follow_the_pair() {
    let text = |width: f64, crowning: f64, more: &str| {
        format!(
            "[pinion]\nteeth = 30\nhelix_angle_deg = 20\n[pinion.modification]\nlead_crowning_um = {crowning:?}\n[wheel]\nteeth = 30\n\
             [pair]\nnormal_module_mm = 3\nface_width_mm = {width:?}\n[operation]\ntorque_nm = {:?}\n{more}",
            7.5 * width
        )
    };
    let counts = |text: &str| {
        let scene = with_slices(Scene::parse(text, Path::new("a.toml")).unwrap());
        let again = Scene::parse(&scene.to_toml(), Path::new("a.toml")).unwrap();
        assert_eq!(scene, again);
        (scene.contact.slices.unwrap(), scene.pinion.mesher.unwrap().elements_face)
    };
    assert_eq!(counts(&text(20.0, 0.0, "")), (32, 6));
    let wide = counts(&text(120.0, 0.0, ""));
    assert!(wide.0 > 64 && wide.1 == 24, "40 modules wide: {wide:?}");
    let crowned = counts(&text(45.0, 30.0, ""));
    assert!(crowned.0 > counts(&text(45.0, 0.0, "")).0, "15 modules wide, crowned: {crowned:?}");
    assert_eq!(counts(&text(120.0, 0.0, "[contact]\nslices = 20\n[pinion.mesher]\nelements_face = 7\n")), (20, 7));
}

/// The pinion pushes with its left flanks when it drives counter-clockwise; either change turns that round.
#[test]
fn driver_and_rotation_choose_the_flanks() {
    let mut scene = Scene::parse(ISO_SCENE, Path::new("a.toml")).unwrap();
    for (driver, rotation, side) in [
        (Driver::Pinion, Sense::Ccw, Side::Left),
        (Driver::Pinion, Sense::Cw, Side::Right),
        (Driver::Wheel, Sense::Ccw, Side::Right),
        (Driver::Wheel, Sense::Cw, Side::Left),
    ] {
        scene.operation.driver = driver;
        scene.operation.rotation = rotation;
        assert_eq!(scene.side(), side, "{driver:?} {rotation:?}");
    }
}

/// What stands in the table of one flank replaces what stands in that of both, key by key; a start is one key however
/// it is given.
#[test]
fn flanks_take_what_both_share_and_what_is_their_own() {
    let text = format!(
        "{}[pinion.modification]\nlead_crowning_um = 5\nbias_um = 1\ntip_relief_um = 8\ntip_relief_start_roll_deg = 24\n\
         [pinion.modification.drive]\nbias_um = -2\ntip_relief_start_diameter_mm = 98\n\
         [pair.misalignment]\ndeviation_um = 3\n",
        ISO_SCENE.replace("\"iso\"", "\"reduced\"")
    );
    let scene = Scene::parse(&text, Path::new("a.toml")).unwrap();
    let ground = &scene.pinion.modification;
    assert_eq!((ground.drive.bias_um, ground.coast.bias_um), (Some(-2.0), Some(1.0)));
    assert_eq!((ground.drive.lead_crowning_um, ground.coast.lead_crowning_um), (Some(5.0), Some(5.0)));
    assert_eq!((ground.drive.tip_relief_start_roll_deg, ground.drive.tip_relief_start_diameter_mm), (None, Some(98.0)));
    assert_eq!((ground.coast.tip_relief_start_roll_deg, ground.coast.tip_relief_start_diameter_mm), (Some(24.0), None));
    assert!(scene.wheel.modification.is_none());
    assert_eq!(scene.pair.misalignment.deviation_um, 3.0);
    assert_eq!(scene, Scene::parse(&scene.to_toml(), Path::new("a.toml")).unwrap());
}
