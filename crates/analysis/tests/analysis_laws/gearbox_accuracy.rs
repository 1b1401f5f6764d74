//! Laws of bounds of gearboxes: what they hold, when the ladder is left, what they have in common with those of pairs.

use std::path::Path;

use analysis::{
    Blame, Context, NoObserver, StaticAnalysis,
    accuracy::{Bound, Cause, Quantity, Rung},
    gearbox::GearboxResult,
};
use scene::{Scene, gearbox::Gearbox};

/// A pair on two shafts, whose pinion sits beside the middle.
fn text(held: bool, more: &str) -> String {
    let shaft = |name: &str, x: f64| {
        let bearing = |name: &str, at: f64, axial: f64| {
            format!(
                "[[bearing]]\nname = \"{name} {at}\"\nshaft = \"{name}\"\nposition_mm = {at:?}\n\
                 stiffness_n_per_mm = [2e5, 2e5, {axial:?}]\n"
            )
        };
        let bearings = if held { String::new() } else { bearing(name, 10.0, 1e5) + &bearing(name, 150.0, 0.0) };
        format!(
            "[[shaft]]\nname = \"{name}\"\norigin_mm = [{x:?}, 0.0, 0.0]\nheld = {held}\n\
             [[shaft.section]]\nlength_mm = 160.0\nouter_diameter_mm = 30.0\n{bearings}"
        )
    };
    let gear = |name: &str| format!("[[gear]]\nname = \"{name}\"\nshaft = \"{name}\"\nposition_mm = 45.0\n");
    let pair = "[[mesh]]\nname = \"pair\"\npinion = \"a\"\nwheel = \"b\"\n\
                [mesh.scene.pinion]\nteeth = 24\nhelix_angle_deg = 15.0\nbore_diameter_mm = 30.0\n\
                [mesh.scene.wheel]\nteeth = 31\nbore_diameter_mm = 30.0\n\
                [mesh.scene.pair]\nnormal_module_mm = 3.0\nface_width_mm = 15.0\n\
                [mesh.scene.operation]\ntorque_nm = 200.0\n";
    let load = "[input]\nshaft = \"a\"\nposition_mm = 0.0\n[[torque]]\nshaft = \"b\"\nposition_mm = 160.0\ntorque_nm = 200.0\n";
    let apart = 3.0 * 55.0 / 2.0 / 15f64.to_radians().cos();
    [shaft("a", 0.0), shaft("b", apart), gear("a"), gear("b")].concat() + pair + load + more
}

fn file(text: &str) -> Gearbox {
    Gearbox::parse(text, "box.toml".as_ref()).unwrap_or_else(|e| panic!("{e}"))
}

fn solved(text: &str) -> GearboxResult {
    analysis::solve(&file(text), Context::new(&mut NoObserver))
        .and_then(|e| e.finished())
        .unwrap_or_else(|e| panic!("{e}"))
}

fn bound(result: &GearboxResult, quantity: Quantity) -> Bound {
    let all = &result.accuracy.as_ref().unwrap().bounds;
    all.iter().find(|b| b.quantity == quantity).unwrap_or_else(|| panic!("no bound of {}", quantity.key())).clone()
}

/// Tables that put both gears on a rung.
fn on_rung(text: &str, elements_profile: u32) -> String {
    let scene = Scene::builder().pinion(24, 15.0).wheel(31).normal_module_mm(3.0).face_width_mm(15.0).torque_nm(200.0);
    let rung = Rung::ALL.into_iter().find(|rung| rung.elements_profile == elements_profile).unwrap();
    let own = rung.mesher(&scene.build().unwrap());
    let counts = [
        ("profile", own.elements_profile),
        ("fillet", own.elements_fillet),
        ("thickness", own.elements_thickness),
        ("face", own.elements_face),
        ("rim", own.elements_rim),
    ];
    let keys: String = counts.iter().map(|(key, n)| format!("elements_{key} = {n}\n")).collect();
    let tables = ["pinion", "wheel"].map(|gear| format!("[mesh.scene.{gear}.mesher]\n{keys}")).concat();
    text.replace("[input]", &format!("{tables}[input]"))
}

/// A loose wish is kept by the first settings, a narrower one by finer ones; what is left is told with its reason, every
/// bound is made of its terms, and a run by hand with finer meshes, slices, positions and shaft elements lies within all
/// bounds of both.
#[test]
fn settings_are_refined_until_the_bounds_keep_what_is_asked() {
    let vibration = "[vibration]\nfrom_rpm = 500.0\nto_rpm = 1000.0\nspeeds = 2\n";
    let of = |asked: &str, vibration: &str| {
        let more = format!("[accuracy]\n{asked}\n[analysis]\npositions_per_cycle = 8\n{vibration}");
        solved(&text(false, &more))
    };
    let loose = of("misalignment_in_plane = \"20 %\"\nnatural_frequency = \"5 %\"\nbearing_force = \"5 %\"", vibration);
    let narrow = of("mean_ste = \"0.2 %\"", "");
    let told = |result: &GearboxResult| result.accuracy.as_ref().unwrap().settings.clone();
    assert_eq!(told(&loose).len(), 1);
    let (last, before) = told(&narrow).split_last().map(|(last, before)| (last.clone(), before.to_vec())).unwrap();
    assert!(!before.is_empty() && before.iter().all(|own| own.left_because.is_some()), "{before:?}");
    assert_eq!((before[0].elements_profile, before[0].positions_per_cycle), (Some(3), 8));
    assert!(last.left_because.is_none() && last.positions_per_cycle > 8, "{last:?}");
    let by_hand = format!(
        "[mesh.scene.contact]\nslices = 64\n[analysis]\npositions_per_cycle = 32\nshaft_elements = 48\n{vibration}"
    );
    let (contact, more) = by_hand.split_once("[analysis]").unwrap();
    let fine = on_rung(&text(false, &format!("[analysis]{more}")), 6).replace("[input]", &format!("{contact}[input]"));
    let fine = solved(&fine);
    assert!(fine.accuracy.is_none(), "nobody asked for bounds");
    let force = |i: usize| {
        let [x, y, z] = fine.bearings[i].force;
        x.hypot(y).hypot(z)
    };
    let mesh = &fine.meshes[0];
    let hertz = fine.vibration.as_ref().unwrap().modes[0].modes[0].frequency / std::f64::consts::TAU;
    for result in [&loose, &narrow] {
        assert!(result.accuracy.as_ref().unwrap().is_met() && result.verdict(&file(&text(false, ""))).is_ok());
        let mut bearings = 0..fine.bearings.len();
        for own in &result.accuracy.as_ref().unwrap().bounds {
            let exact = match own.quantity {
                Quantity::MeanSte => 1e3 * mesh.transmission_error[0],
                Quantity::PeakToPeakSte => 1e3 * mesh.transmission_error[1],
                Quantity::MaxPressure => mesh.max_pressure,
                Quantity::MisalignmentInPlane => 1e3 * mesh.misalignment[0],
                Quantity::FaceLoadFactor => mesh.face_load_factor.unwrap(),
                Quantity::BearingForce => force(bearings.next().unwrap()),
                Quantity::NaturalFrequency => hertz,
                other => panic!("a number of a pair: {}", other.key()),
            };
            let range = own.value - own.below..=own.value + own.above;
            assert!(range.contains(&exact), "{}: {exact} is outside of {}", own.name(), own.words());
            let terms: f64 = own.terms.iter().map(|t| t.amount).sum();
            assert!((terms / own.corrected_within - 1.0).abs() < 1e-12, "{}: {terms}", own.name());
            let mesh = own.terms.iter().find(|t| t.cause == Cause::Mesh).unwrap();
            assert!(mesh.amount > 0.0, "{}: {:?}", own.name(), own.terms);
        }
        assert_eq!(bearings.next(), None, "every bearing has its bound");
    }
    let of = |result: &GearboxResult| bound(result, Quantity::MeanSte).largest();
    assert!(of(&narrow) < of(&loose), "{} and {} um", of(&narrow), of(&loose));
}

/// A gearbox of two held shafts is the pair: on the same mesh and positions it has the pair's numbers, and bounds that are
/// at least the pair's.
#[test]
fn a_held_pair_has_bounds_that_hold_those_of_the_pair() {
    let asked = "[accuracy]\nmean_ste = \"50 %\"\n[analysis]\npositions_per_cycle = 8\n";
    let turned = |key: f64| {
        let own =
            text(true, asked).replacen("position_mm = 45.0\n", &format!("position_mm = 45.0\nkey_deg = {key:?}\n"), 1);
        solved(&own)
    };
    // A key that brings the beginning of the turn to that of a mesh cycle.
    let start = turned(0.0).positions[0].meshes[0].cycles;
    let own = turned(-start * 360.0 / 24.0);
    let pair = Scene::builder().pinion(24, 15.0).wheel(31).normal_module_mm(3.0).face_width_mm(15.0).torque_nm(200.0);
    let pair = pair
        .set("analysis.positions_per_cycle", 8)
        .set("pinion.bore_diameter_mm", 30.0)
        .set("wheel.bore_diameter_mm", 30.0);
    let alone = StaticAnalysis::new(&Rung::ALL[1].scene(&pair.build().unwrap())).solve().unwrap();
    let alone = alone.facts.accuracy.unwrap();
    for quantity in [Quantity::MeanSte, Quantity::PeakToPeakSte, Quantity::MaxPressure] {
        let [own, pair] =
            [bound(&own, quantity), alone.bounds.iter().find(|b| b.quantity == quantity).unwrap().clone()];
        assert!((own.value / pair.value - 1.0).abs() < 1e-6, "{} beside {}", own.words(), pair.words());
        let holds = own.below >= pair.below * (1.0 - 1e-6) && own.above >= pair.above * (1.0 - 1e-6);
        assert!(holds, "{}: {} beside {}", own.name(), own.words(), pair.words());
        assert!(own.largest() < 5.0 * pair.largest() + 0.05 * own.value, "{} beside {}", own.words(), pair.words());
    }
    assert_eq!(bound(&own, Quantity::MisalignmentInPlane).value, 0.0);
}

/// Meshes and slices that the scenes of the pairs state stay: they are held against rungs of the ladder. What cannot be
/// kept with them is told at once, and the result fails.
#[test]
fn what_cannot_be_kept_fails() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/gearbox/two_stages.toml");
    let written = std::fs::read_to_string(&path).unwrap();
    let (at_rest, _) = written.split_once("[vibration]").unwrap();
    let file = Gearbox::parse(&format!("{at_rest}[accuracy]\nmean_ste = \"0.001 %\"\n"), &path).unwrap();
    let result = analysis::solve(&file, Context::new(&mut NoObserver)).unwrap().finished().unwrap();
    let accuracy = result.accuracy.as_ref().unwrap();
    assert!(accuracy.settings.len() == 1 && accuracy.settings[0].elements_profile.is_none(), "{:?}", accuracy.settings);
    assert_eq!(accuracy.settings[0].slices[0], 16, "as the gearbox sets it");
    let failed = result.verdict(&file).unwrap_err();
    assert!(failed.blame() == Blame::Inexact && failed.hint().is_some(), "{failed}");
    assert!(failed.to_string().contains("mean_ste of first is") && failed.to_string().contains("mean_ste of second"));
    // Linear elements are 10 % too stiff: the mesh is most of the bound.
    let own = bound(&result, Quantity::MeanSte);
    assert!(own.by(Cause::Mesh) > 0.5 * own.largest() && own.met == Some(false), "{own:?}");
    let left = accuracy.not_covered.iter().any(|said| said.contains("are differences between settings"));
    assert!(left, "{:?}", accuracy.not_covered);
}
