//! Loads of a life: what each does alone adds up, of a pair, of a gearbox, and of gears in several meshes.

use std::path::Path;

use ::rating::GearRating;
use analysis::{Context, Ending, NoObserver, StaticAnalysis, pair_rating::RatingHeadline, solve};
use scene::{Setting, gearbox::Gearbox};

use crate::rating::{close, coarse, rated, rated_scene};

/// A spectrum of the nominal load alone does the damage that the standard's life says.
#[test]
fn a_spectrum_of_the_nominal_load_is_the_nominal_load() {
    let folder = std::env::temp_dir().join(format!("ale-gear-spectrum-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    std::fs::write(folder.join("loads.csv"), "torque_nm,speed_rpm,duration_h\n300,1000,4\n0,0,4\n").unwrap();
    let scene = coarse().relative_to(&folder).set("rating.spectrum", "loads.csv").build().unwrap();
    std::fs::remove_dir_all(&folder).unwrap();
    let (rating, _) = rated_scene(&scene);
    let damage = rating.spectrum.unwrap();
    let life = rating.standard.pinion.pitting_life_h;
    assert!((damage.pinion.pitting_damage * life / 500.0 - 1.0).abs() < 1e-9, "half of 1000 h");
}

/// A misaligned pair with a coarse mesh and root stress, under loads; the text is that of the table.
fn under_loads(torque_nm: f64, loads: &str) -> RatingHeadline {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("loads.csv"), loads).unwrap();
    let scene = coarse().relative_to(folder.path()).set("rating.spectrum", "loads.csv");
    let scene = scene.set("pair.misalignment.in_plane_of_action_um", 20.0).set("output.root_stress", true);
    rated(scene.torque_nm(torque_nm)).0
}

/// Loads of a pair are solved each by itself: standard and local damage of a spectrum, place by place, are the sums of runs under one load after the other for their shares of the life, with the K_Hbeta, pressures and root stresses that these have.
#[test]
fn a_spectrum_of_a_pair_adds_up_over_its_loads() {
    let heading = "torque_nm,speed_rpm,share\n";
    let both = under_loads(300.0, &format!("{heading}300,1000,1\n120,1000,3\n0,1000,4\n"));
    // Idle time takes the rest of the life.
    let heavy = under_loads(300.0, &format!("{heading}300,1000,1\n0,0,7\n"));
    let light = under_loads(120.0, &format!("{heading}120,1000,3\n0,0,5\n"));
    assert!(light.standard.face_load_factor > 1.05 * heavy.standard.face_load_factor);
    type Sums = fn(&RatingHeadline) -> Vec<f64>;
    let of: [(&str, Sums); 3] = [
        ("standard", |own| {
            let gears = own.spectrum.as_ref().map(|s| [s.pinion, s.wheel]).unwrap();
            gears.iter().flat_map(|g| [g.pitting_damage, g.bending_damage]).collect()
        }),
        ("root", |own| own.local_spectrum.as_ref().unwrap().roots.as_ref().unwrap().concat()),
        ("places", |own| own.local_spectrum.as_ref().unwrap().flanks.concat()),
    ];
    for (what, of) in of {
        let parts = of(&heavy).into_iter().zip(of(&light));
        for (i, (sum, (heavy, light))) in of(&both).into_iter().zip(parts).enumerate() {
            let wanted = heavy + light;
            assert!((sum - wanted).abs() <= 1e-9 * wanted, "{what} {i}: {sum:e}, {heavy:e} and {light:e} alone");
        }
    }
    let local = both.local_spectrum.as_ref().unwrap();
    for gear in 0..2 {
        assert_eq!(local.flanks[gear].iter().copied().fold(0.0, f64::max), local.pitting_damage[gear]);
        let roots = &local.roots.as_ref().unwrap()[gear];
        assert_eq!(roots.iter().copied().fold(0.0, f64::max), local.bending_damage.unwrap()[gear]);
        // One point is the worst, and most of a fillet bears nearly nothing.
        assert!(roots.iter().filter(|sum| **sum < 0.1 * local.bending_damage.unwrap()[gear]).count() > roots.len() / 2);
    }
}

/// Where no load does damage the safety is that of the place that is pressed hardest, and so it is finite. A load without harm changes nothing; one that would bend the teeth by their own size is refused before the work.
#[test]
fn loads_without_harm_and_beyond_reason() {
    let heading = "torque_nm,speed_rpm,share\n";
    let coarse_under = |loads: &str, more: &[(&str, f64)]| {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("loads.csv"), loads).unwrap();
        let scene = coarse().relative_to(folder.path()).set("rating.spectrum", "loads.csv");
        more.iter().fold(scene, |scene, (key, value)| scene.set(key, *value)).build().unwrap()
    };
    let (level, _) = rated_scene(&coarse_under(&format!("{heading}20,1000,1\n"), &[("rating.long_life_factor", 1.0)]));
    let local = level.local_spectrum.unwrap();
    assert_eq!(local.pitting_damage, [0.0; 2]);
    assert!(local.pitting_safety.iter().all(|s| s.is_finite() && *s > 1.0), "{:?}", local.pitting_safety);
    let of = |loads: &str| rated_scene(&coarse_under(&format!("{heading}{loads}"), &[])).0;
    let [with, without] = ["300,1000,1\n1e-20,1000,1\n0.1,1000,1\n", "300,1000,1\n0,0,2\n"].map(of);
    assert_eq!(with.local_spectrum.unwrap().pitting_damage, without.local_spectrum.unwrap().pitting_damage);
    let heavy = StaticAnalysis::new(&coarse_under(&format!("{heading}300,1000,1\n1e7,1000,1\n"), &[])).solve();
    let refused = heavy.unwrap_err().to_string();
    assert!(refused.contains("a load of the spectrum: 1.00e7 N m would bend the teeth"), "{refused}");
}

/// A spectrum of the nominal load alone is as safe as the local rating: the factor on pressures that makes the worst sum 1 is its safety.
#[test]
fn local_damage_of_the_nominal_load_is_its_safety() {
    let own = under_loads(300.0, "torque_nm,speed_rpm,share\n300,1000,1\n");
    let (local, damage) = (own.local.unwrap(), own.local_spectrum.unwrap());
    for gear in 0..2 {
        close("pitting", damage.pitting_safety[gear], local.pitting_safety[gear], 1e-9);
        close("bending", damage.bending_safety.unwrap()[gear], local.bending_safety.unwrap()[gear], 1e-9);
    }
}

/// A misaligned pair that a spectrum breaks: the sums of its worst places are told with these places. A pair with bounds has
/// the loads of its spectrum solved as well, by the model that is taken in the end.
#[test]
fn places_that_fail_are_told_and_bounds_keep_the_loads() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("loads.csv"), "torque_nm,speed_rpm,share\n900,1000,1\n500,1000,1\n").unwrap();
    let scene = coarse().relative_to(folder.path()).set("rating.spectrum", "loads.csv");
    let scene = scene.set("pair.misalignment.in_plane_of_action_um", 40.0).set("output.root_stress", true);
    let scene = scene.torque_nm(900.0);
    let plain = StaticAnalysis::new(&scene.build().unwrap()).solve().unwrap();
    let told = |all: &[answer::Remark]| all.iter().filter(|r| r.code() == "local_spectrum_fails").count();
    let rating = RatingHeadline::of(&plain.scene, &plain.history).unwrap();
    let local = rating.local_spectrum.unwrap();
    assert!(local.pitting_damage.iter().all(|sum| *sum > 1.0), "{:?}", local.pitting_damage);
    let high = local.pitting_damage.iter().chain(&local.bending_damage.unwrap()).filter(|sum| **sum > 1.0).count();
    assert_eq!(told(&plain.history.remarks), high, "{:?}", plain.history.remarks);
    // The worst point of a fillet is where the largest root stress is, not one that the contact above it pulls.
    for gear in 0..2 {
        let peaks = plain.history.positions.iter().flat_map(|p| &p.root_stress[gear]).map(|own| own.max_principal);
        let roots = &plain.history.roots.as_ref().unwrap()[gear];
        let peaks: Vec<_> = peaks.filter(|peak| peak.stress > 0.0).collect();
        let most = peaks.iter().max_by(|a, b| a.stress.total_cmp(&b.stress)).unwrap();
        let largest = roots.tension.iter().copied().fold(0.0, f64::max);
        assert_eq!(largest, most.stress, "gear {gear}");
        let there: Vec<_> = roots.places.iter().zip(&roots.tension).filter(|own| *own.1 == largest).collect();
        assert_eq!(there.len(), 1, "gear {gear}: {there:?}");
        assert!((there[0].0[0] / most.radius - 1.0).abs() < 1e-6, "gear {gear}: {there:?}, {most:?}");
    }
    let bounded = scene.set("analysis.model", "reduced").set("accuracy.mean_ste", "90 %").build().unwrap();
    let bounded = StaticAnalysis::new(&bounded).solve().unwrap();
    let own = RatingHeadline::of(&bounded.scene, &bounded.history).unwrap().local_spectrum.unwrap();
    assert_eq!(own.pitting_damage, local.pitting_damage);
    assert_eq!(own.roots, local.roots);
    assert_eq!(told(&bounded.history.remarks), high);
}

/// Three gears in a row on held shafts, the middle one between the others, driven at `input` and loaded by torques: ratings of both meshes, and remarks on what is `stated` of the middle gear.
fn row_of_gears(input: &str, loads: &[(&str, f64)], stated: &str) -> (Vec<RatingHeadline>, Vec<String>) {
    let [a, b] = [46.0, 111.0];
    let mut t = String::from("name = \"row\"\n[rating]\nspeed_rpm = 1000.0\n");
    for (name, x, key) in [("left", 0.0, 0.0), ("middle", a, 0.0), ("right", b, 0.0)] {
        t += &format!(
            "[[shaft]]\nname = \"{name}\"\norigin_mm = [{x:?}, 0.0, 0.0]\nheld = true\n[[shaft.section]]\nlength_mm = 60.0\n\
             outer_diameter_mm = 20.0\n[[gear]]\nname = \"{name}\"\nshaft = \"{name}\"\nposition_mm = 30.0\nkey_deg = {key:?}\n"
        );
    }
    let rated = "flank_roughness_rz_um = 4.8\nroot_roughness_rz_um = 20.0\nmaterial = \"18CrNiMo7-6\"\n";
    for (pinion, wheel, teeth, more) in
        [("left", "middle", [17, 29], ""), ("middle", "right", [29, 36], "timing = \"keyed\"\n")]
    {
        t += &format!("[[mesh]]\nname = \"{pinion}\"\npinion = \"{pinion}\"\nwheel = \"{wheel}\"\n{more}");
        for (gear, teeth) in ["pinion", "wheel"].into_iter().zip(teeth) {
            let helix = if gear == "pinion" { "helix_angle_deg = 0.0\n" } else { "" };
            t += &format!(
                "[mesh.scene.{gear}]\nteeth = {teeth}\n{helix}thickness_allowance_mm = 0.1\n[mesh.scene.{gear}.mesher]\norder = 1\n\
                 elements_profile = 3\nelements_fillet = 2\nelements_thickness = 2\nelements_face = 4\nelements_rim = 2\n"
            );
        }
        t += &format!(
            "[mesh.scene.pair]\nnormal_module_mm = 2.0\nface_width_mm = 20.0\n[mesh.scene.operation]\ntorque_nm = 100.0\n\
             [mesh.scene.contact]\nslices = 8\n[mesh.scene.rating]\nlife_h = 2e4\napplication_factor = 1.0\ntolerance_class = 6\n\
             lubricant = \"mineral VG 220\"\n[mesh.scene.rating.pinion]\n{rated}{}[mesh.scene.rating.wheel]\n{rated}{}",
            if pinion == "middle" { stated } else { "" },
            if wheel == "middle" { stated } else { "" }
        );
    }
    t += &format!("[input]\nshaft = \"{input}\"\nposition_mm = 0.0\n[analysis]\npositions_per_cycle = 4\n");
    for (shaft, torque) in loads {
        t += &format!("[[torque]]\nshaft = \"{shaft}\"\nposition_mm = 60.0\ntorque_nm = {torque:?}\n");
    }
    let file = Gearbox::parse(&t, "row.toml".as_ref()).unwrap_or_else(|e| panic!("{e}\n{t}"));
    let found = solve(&file, Context::<Gearbox>::new(&mut NoObserver)).and_then(Ending::finished);
    let found = found.unwrap_or_else(|e| panic!("{e}"));
    let said = found.remarks.iter().filter(|r| r.code() == "rating_states_few_loads").map(|r| r.to_string()).collect();
    (found.meshes.iter().map(|mesh| mesh.rating.clone().unwrap()).collect(), said)
}

/// The teeth of an idler bend both ways in every turn (Y_M of ISO 6336-3, annex B, for equal loads on both flanks), those of a gear that drives two others bend one way twice a turn; the outer gears are rated as those of a pair.
#[test]
fn gears_in_two_meshes_are_rated_by_both() {
    let factor = |gear: &GearRating| gear.bending.mean_stress_factor;
    let cycles = |own: &RatingHeadline| own.standard.gears().map(|gear| gear.load_cycles);
    // The idler passes on what it gets.
    let (idles, said) = row_of_gears("left", &[("right", 80.0)], "");
    assert!(said.is_empty(), "{said:?}");
    let material = ::rating::Materials::built_in().find("18CrNiMo7-6").unwrap();
    let [driven, driving] = [&idles[0].standard.wheel, &idles[1].standard.pinion];
    for own in [driven, driving] {
        let wanted = ::rating::mean_stress_factor(material, own.stress_correction_factor, 1.0);
        assert!((factor(own) / wanted - 1.0).abs() < 1e-6 && wanted < 0.8, "{} beside {wanted}", factor(own));
    }
    assert_eq!([&idles[0].standard.pinion, &idles[1].standard.wheel].map(factor), [1.0; 2]);
    let ratio = cycles(&idles[0])[1] / cycles(&idles[0])[0];
    assert!((ratio - 17.0 / 29.0).abs() < 1e-12, "one load a turn: {ratio}");
    // Each number is stated by itself, and what is stated too small is told.
    let (own, said) = row_of_gears("left", &[("right", 80.0)], "meshes_per_turn = 1\n");
    assert!(said.is_empty() && factor(&own[0].standard.wheel) == factor(driven), "{said:?}");
    let (own, said) = row_of_gears("left", &[("right", 80.0)], "reversed_load_ratio = 0.0\n");
    assert!(said.len() == 2 && said[0].contains("1.000 of this load on the other flank"), "{said:?}");
    assert_eq!(factor(&own[0].standard.wheel), 1.0);
    // One that drives both, alike and with hardly a load on one.
    let (drives, _) = row_of_gears("middle", &[("left", 40.0), ("right", 80.0)], "");
    assert_eq!([&drives[0].standard.wheel, &drives[1].standard.pinion].map(factor), [1.0; 2]);
    let ratio = cycles(&drives[0])[1] / cycles(&drives[0])[0];
    assert!((ratio - 2.0 * 17.0 / 29.0).abs() < 1e-12, "two loads a turn: {ratio}");
    let (drives, _) = row_of_gears("middle", &[("left", 40.0), ("right", 0.1)], "");
    let ratio = cycles(&drives[0])[1] / cycles(&drives[0])[0];
    assert!((ratio - 17.0 / 29.0).abs() < 1e-12, "one load a turn that counts: {ratio}");
}

/// Loads of a gearbox add up: each does the damage that it does alone, with its own K_Hbeta, speed and forces of rolling elements; idle time does none.
#[test]
fn a_spectrum_of_a_gearbox_adds_up_over_its_loads() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/gearbox/rated.toml");
    let text = std::fs::read_to_string(&file).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let loads = folder.path().join("loads.csv");
    std::fs::write(&loads, "torque_nm,speed_rpm,share\n740,1500,1\n200,2400,2\n0,0,1\n").unwrap();
    let solved = |settings: &[(&str, f64)], spectrum: Option<&Path>| {
        let text = match spectrum {
            Some(path) => text.replace("rated_loads.csv", &path.display().to_string()),
            None => text.lines().filter(|line| !line.starts_with("spectrum")).collect::<Vec<_>>().join("\n"),
        };
        let mut all = vec![Setting::number("analysis.positions_per_cycle", 2.0).unwrap()];
        all.extend(settings.iter().map(|(key, value)| Setting::number(key, *value).unwrap()));
        let file = Gearbox::parse_with(&text, &file, &all).unwrap_or_else(|e| panic!("{e}"));
        let found = solve(&file, Context::<Gearbox>::new(&mut NoObserver)).and_then(Ending::finished);
        found.unwrap_or_else(|e| panic!("{e}"))
    };
    let whole = solved(&[], Some(&loads));
    let alone = [(740.0, 1500.0), (200.0, 2400.0)]
        .map(|(torque, speed)| solved(&[("torque.0.torque_nm", torque), ("rating.speed_rpm", speed)], None));
    let shares = [0.25, 0.5];
    for (i, bearing) in whole.bearings.iter().enumerate() {
        let used: f64 = alone
            .iter()
            .zip(shares)
            .map(|(own, q)| {
                let life = own.bearings[i].rolling.as_ref().unwrap().life;
                life.map_or(0.0, |life| q / life.rated_hours().unwrap())
            })
            .sum();
        let life = bearing.rolling.as_ref().unwrap().spectrum_life_h.unwrap();
        assert!((life * used - 1.0).abs() < 1e-9, "{}: {life} h, {used}", bearing.name);
    }
    let mut uneven = 0.0f64;
    for (i, mesh) in whole.meshes.iter().enumerate() {
        let [nominal, light] = [0, 1].map(|k| alone[k].meshes[i].rating.as_ref().unwrap());
        uneven = uneven.max((light.standard.face_load_factor / nominal.standard.face_load_factor - 1.0).abs());
        let found = mesh.rating.as_ref().unwrap().spectrum.clone().unwrap();
        for (k, damage) in [found.pinion, found.wheel].into_iter().enumerate() {
            // Curves of bearable stress are those of the nominal load.
            let curves = nominal.standard.gears()[k];
            let loads = [nominal, light].map(|own| own.standard.gears()[k]).into_iter().zip(shares);
            let sums = loads.fold([0.0, 0.0], |[h, f], (own, q)| {
                let cycles = q * own.load_cycles;
                [
                    h + curves.pitting_curve.damage(cycles, own.contact_stress_mpa),
                    f + curves.bending_curve.damage(cycles, own.root_stress_mpa),
                ]
            });
            for (sum, own) in sums.into_iter().zip([damage.pitting_damage, damage.bending_damage]) {
                assert!((own / sum - 1.0).abs() < 1e-9, "{}: {own}, {sum}", mesh.name);
            }
        }
    }
    assert!(uneven > 0.01, "loads share their K_Hbeta: {uneven}");
}
