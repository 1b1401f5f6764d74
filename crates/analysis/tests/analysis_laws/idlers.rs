//! The idler of the scenes: reversed bending in the results and in the rating.

use std::path::Path;

use analysis::{Context, NoObserver, gearbox::GearboxResult};
use scene::gearbox::Gearbox;

fn scene() -> Gearbox {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/gearbox/idler.toml");
    Gearbox::read(&file).unwrap_or_else(|e| panic!("{e}"))
}

fn solve(file: &Gearbox) -> GearboxResult {
    let found = analysis::solve(file, Context::new(&mut NoObserver)).and_then(|ending| ending.finished());
    found.unwrap_or_else(|e| panic!("{e}"))
}

/// An idler's roots are bent to and fro: R within a quarter of the -1.2 of ISO 6336-3, annex B, on both sides of its teeth. Gears
/// of one mesh are bent one way: R is above -0.5 on the side that is pressed. What a gear's roots see is the worst of all
/// positions of its meshes, and the rating of the solved root stress has the factor of reversed bending.
#[test]
fn the_roots_of_an_idler_are_bent_to_and_fro() {
    let file = scene();
    let found = solve(&file);
    let gear = |name: &str| {
        let at = file.gears.iter().position(|own| own.name == name).unwrap();
        (at, found.root_bending[at].unwrap())
    };
    let (idler, fillets) = gear("idler");
    for own in &fillets {
        let ratio = own.ratio().unwrap();
        assert!((ratio / -1.2 - 1.0).abs() < 0.25, "{ratio}: {own:?}");
        assert!((own.range() - (own.largest - own.least)).abs() < 1e-12);
    }
    for name in ["pinion", "wheel"] {
        let (_, [worst, other]) = gear(name);
        let ratio = worst.ratio().unwrap();
        assert!((-0.5..=0.0).contains(&ratio) && worst.largest > other.largest, "{name}: {worst:?}, {other:?}");
    }
    // The peaks of both meshes of the idler: it is the wheel of the first one and the pinion of the second one.
    let ends = [(0, 1), (1, 0)];
    let peaks =
        found.positions.iter().flat_map(|p| ends.iter().flat_map(|(mesh, end)| &p.meshes[*mesh].root_stress[*end]));
    let largest = peaks.map(|field| field.peaks.max_principal.seen()).fold(0.0, f64::max);
    let shown = fillets.iter().map(|own| own.largest).fold(0.0, f64::max);
    assert!(shown >= largest && shown < 1.5 * largest, "{shown} beside {largest} MPa");
    let headline = found.headline();
    for (key, wanted) in [
        ("max_root_stress_mpa", fillets[0].largest),
        ("root_stress_range_mpa", fillets[0].range()),
        ("root_stress_ratio", fillets[0].ratio().unwrap()),
    ] {
        assert_eq!(headline[key][idler].as_f64(), Some(wanted), "{key}");
    }
    // S_F by the solved stress is the bearable stress, reversed bending in it, over the solved one.
    for (mesh, end) in ends {
        let rating = found.meshes[mesh].rating.as_ref().unwrap();
        let (standard, local) = (rating.standard.gears()[end], rating.local.unwrap());
        assert!(standard.bending.mean_stress_factor < 0.8, "{}", standard.bending.mean_stress_factor);
        let (stress, safety) = (local.root_stress_mpa.unwrap()[end], local.bending_safety.unwrap()[end]);
        assert!((safety * stress / standard.root_stress_limit_mpa - 1.0).abs() < 1e-12);
        let solved = stress / local.load_factor;
        assert!(solved > 0.5 * shown && solved < 1.001 * shown, "{solved} of {shown} MPa");
    }
}

/// A mesh whose scene does not ask for root stress has none; a gear of which no mesh has any is told as unknown.
#[test]
fn root_stress_is_of_the_meshes_that_ask_for_it() {
    let mut file = scene();
    file.positions_per_cycle = 2;
    file.meshes[1].scene.output.root_stress = false;
    let found = solve(&file);
    let known: Vec<bool> = found.root_bending.iter().map(Option::is_some).collect();
    assert_eq!(known, [true, true, false]);
    assert!(found.headline()["max_root_stress_mpa"][2].is_null());
    assert!(found.positions[0].meshes[1].root_stress.iter().all(Vec::is_empty));
    file.meshes[0].scene.output.root_stress = false;
    let none = solve(&file);
    assert!(none.headline().get("max_root_stress_mpa").is_none());
    assert!(GearboxResult::headline_keys(&file).iter().all(|(key, _)| !key.contains("root_stress")));
}
