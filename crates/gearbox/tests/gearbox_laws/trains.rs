//! Ratios, senses and phases of trains against counts by hand.

use std::f64::consts::{PI, TAU};

use gearbox::{Disc, GearMesh, GearboxError, Structure, Torque, Train, even_mesh_torques, mesh_torques};
use geometry::{Driver, Sense};

use crate::pairs::{operation, pair, shaft, two_stages};

/// A turn of the input by one pitch is one cycle of the first mesh, and 19/53 of one of the second: gear 3 turns with
/// gear 2. A whole number of turns of the middle shaft brings both back.
#[test]
fn phases_of_two_stages_are_those_counted_by_hand() {
    let (structure, meshes) = two_stages();
    for sense in [Sense::Ccw, Sense::Cw] {
        let train = Train::new(&structure, &meshes, &[0.0; 6], 4, sense).unwrap();
        let sign = sense.sign() as f64;
        for (found, wanted) in train.ratios().iter().zip([1.0, -17.0 / 53.0, 17.0 / 53.0 * 19.0 / 47.0]) {
            assert!((found - wanted).abs() < 1e-15, "{found} beside {wanted}");
        }
        assert_eq!(train.meshing().iter().map(|m| m.driver).collect::<Vec<_>>(), [Driver::Pinion; 2]);
        assert_eq!(train.meshing()[0].sense, sense);
        assert_eq!(train.meshing()[1].sense, sense.opposite(), "the middle shaft turns the other way");
        let start = train.cycles(0.0);
        for pitches in [1.0, 53.0, 1000.0] {
            let now = train.cycles(sign * pitches * TAU / 17.0);
            let gone = [now[0] - start[0], now[1] - start[1]];
            assert!((gone[0] - pitches).abs() < 1e-12 * pitches.max(10.0), "{gone:?}");
            assert!((gone[1] - pitches * 19.0 / 53.0).abs() < 1e-12 * pitches.max(10.0), "{gone:?}");
        }
    }
}

/// Keys turn the gears of a shaft against each other: by a pitch of gear 3 the second mesh is one cycle on, by half a
/// pitch half a cycle, and the first mesh does not know of it.
#[test]
fn a_key_shifts_the_phase_of_its_own_mesh() {
    let (structure, meshes) = two_stages();
    let at = |key: f64| {
        let mut keys = [0.0; 6];
        keys[2] = key;
        Train::new(&structure, &meshes, &keys, 4, Sense::Ccw).unwrap().cycles(0.3)
    };
    let (start, turned) = (at(0.0), at(0.5 * TAU / 19.0));
    assert_eq!(start[0], turned[0]);
    // The middle shaft turns clockwise: a turn about +z sets its gears back.
    assert!((turned[1] - start[1] + 0.5).abs() < 1e-12, "{} {}", start[1], turned[1]);
}

/// An idler's two meshes: it is driven on one flank of its teeth and drives with the other, so that a tooth's thickness
/// and the teeth between both places say how far the second mesh is from the first.
#[test]
fn an_idler_sets_its_meshes_apart_by_the_teeth_between_them() {
    for (teeth, direction) in [([20, 31, 20], 0.0), ([20, 31, 20], PI / 3.0), ([23, 30, 20], -1.0)] {
        let pairs = [pair([teeth[0], teeth[1]], 0.0), pair([teeth[1], teeth[2]], 0.0)];
        let [a, b] = [pairs[0].centre_distance(), pairs[1].centre_distance()];
        let far = [a + b * f64::cos(direction), b * f64::sin(direction), 0.0];
        let structure = Structure {
            shafts: vec![
                shaft("in", [0.0; 3], 100.0, 30.0),
                shaft("idler", [a, 0.0, 0.0], 100.0, 30.0),
                shaft("out", far, 100.0, 30.0),
            ],
            discs: (0..3).map(|s| Disc::seat(format!("gear {s}"), s, 50.0)).collect(),
            ..Structure::default()
        };
        let mesh =
            |name: &str, discs, pair: &geometry::GearPair| GearMesh { name: name.into(), discs, pair: pair.clone() };
        let meshes = [mesh("in", [0, 1], &pairs[0]), mesh("out", [1, 2], &pairs[1])];
        let train = Train::new(&structure, &meshes, &[0.0; 3], 0, Sense::Ccw).unwrap();
        // The input angle at which pair 0 of the first mesh meets at its pitch point, and where the second mesh is then.
        let pitch_point = |m: usize| {
            // Half a cycle, and the way from the middle of the path of contact to the pitch point.
            let p = &pairs[m];
            let [start, end] = p.path_of_contact();
            let at = p.pinion.base_radius() * p.working_pressure_angle().tan();
            let way = (at - 0.5 * (start + end)) / (p.pinion.base_radius() * p.pinion.pitch_angle());
            0.5 + way
        };
        let cycles = |angle: f64| train.cycles(angle);
        let rate = cycles(1.0)[0] - cycles(0.0)[0];
        let angle = (pitch_point(0) - cycles(0.0)[0]) / rate;
        let second = cycles(angle)[1] - pitch_point(1);
        // The idler's driven flank is then on the line of centres, at angle pi. The flank that drives is on the other side
        // of the same tooth: half a pitch on, less what the tooth is thinner by (0.05 mm). It has to turn clockwise from
        // pi to `direction`, where the second mesh has its pitch point.
        let z = f64::from(teeth[1]);
        let clockwise = (PI - direction).rem_euclid(TAU);
        let thinner = 0.05 / (PI * 3.0);
        let wanted = -z * clockwise / TAU + 0.5 - thinner;
        let off = second - wanted;
        assert!((off - off.round()).abs() < 1e-9, "{teeth:?}, {direction}: {second} beside {wanted} cycles");
    }
}

/// A ring of gears has the last one set by its timing; ratios that disagree are refused.
#[test]
fn rings_are_timed_and_must_agree() {
    // Two gears on each of two shafts: the same ratio twice closes, unlike ones do not.
    let twice = |second: [u32; 2]| {
        let pairs = [pair([20, 40], 0.0), pair(second, 0.0)];
        let structure = Structure {
            shafts: vec![
                shaft("in", [0.0; 3], 200.0, 30.0),
                shaft("out", [pairs[0].centre_distance(), 0.0, 0.0], 200.0, 30.0),
            ],
            discs: [(0, 50.0), (1, 50.0), (0, 150.0), (1, 150.0)]
                .map(|(s, z)| Disc::seat(format!("{s} at {z}"), s, z))
                .into(),
            ..Structure::default()
        };
        let mesh =
            |name: &str, discs, pair: &geometry::GearPair| GearMesh { name: name.into(), discs, pair: pair.clone() };
        let meshes = [mesh("left", [0, 1], &pairs[0]), mesh("right", [2, 3], &pairs[1])];
        Train::new(&structure, &meshes, &[0.0, 0.0, 0.05, 0.0], 0, Sense::Ccw)
    };
    let train = twice([20, 40]).unwrap();
    assert_eq!(train.meshing()[0].timing, 0.0);
    // Gear 3 sits 0.05 rad ahead: gear 4 has to be set back by half of that.
    assert!((train.meshing()[1].timing + 0.025).abs() < 1e-12, "{}", train.meshing()[1].timing);
    assert!(matches!(twice([21, 39]), Err(GearboxError::Ratios { .. })));
}

/// What stands in the wrong place is refused with its name.
#[test]
fn axes_and_gears_in_wrong_places_are_refused() {
    let (structure, meshes) = two_stages();
    let of =
        |structure: &Structure, meshes: &[GearMesh], keys: &[f64]| Train::new(structure, meshes, keys, 4, Sense::Ccw);
    let mut far = structure.clone();
    far.shafts[2].origin[0] += 1.0;
    assert!(matches!(of(&far, &meshes, &[0.0; 6]), Err(GearboxError::Distance { mesh, .. }) if mesh == "second"));
    let mut beside = structure.clone();
    beside.discs[1].position += 1.0;
    assert!(matches!(of(&beside, &meshes, &[0.0; 6]), Err(GearboxError::Beside { .. })));
    assert!(
        matches!(of(&structure, &meshes[..1], &[0.0; 6]), Err(GearboxError::NotDriven { shaft }) if shaft == "slow")
    );
    assert!(matches!(of(&structure, &meshes, &[0.0; 5]), Err(GearboxError::Count { found: 5, wanted: 6, .. })));
    assert!(matches!(of(&structure, &meshes, &[f64::NAN; 6]), Err(GearboxError::OutOfRange { .. })));
    let mut none = meshes.clone();
    none[1].discs[1] = 9;
    assert!(matches!(of(&structure, &none, &[0.0; 6]), Err(GearboxError::NoDisc { disc: 9, .. })));
}

/// Without friction a torque goes through a train by the numbers of teeth: what every mesh of two stages presses on both of
/// its gears, and that a ring is left to stiffness.
#[test]
fn torques_of_meshes_go_by_the_teeth() {
    let (structure, meshes) = two_stages();
    let load = Torque { disc: 5, torque: -4e5 };
    let found = mesh_torques(&structure, &meshes, &operation(&structure, 4, Sense::Ccw, vec![load])).unwrap();
    let teeth = |mesh: &gearbox::GearMesh| [&mesh.pair.pinion, &mesh.pair.wheel].map(|g| f64::from(g.teeth()));
    let [first, second] = [teeth(&meshes[0]), teeth(&meshes[1])];
    let wanted_second = [4e5 * second[0] / second[1], 4e5];
    // The middle shaft passes on what it gets: its two gears press against each other.
    let wanted_first = [-wanted_second[0] * first[0] / first[1], -wanted_second[0]];
    for (found, wanted) in found.iter().zip([wanted_first, wanted_second]) {
        for (a, b) in found.iter().zip(wanted) {
            assert!((a / b - 1.0).abs() < 1e-14, "{a} for {b} N mm");
        }
    }
    let loaded = operation(&structure, 4, Sense::Ccw, vec![load]);
    let near = |found: &[[f64; 2]], wanted: &[[f64; 2]]| {
        let pairs = found.iter().flatten().zip(wanted.iter().flatten());
        pairs.for_each(|(a, b)| assert!((a / b - 1.0).abs() < 1e-12, "{a} for {b} N mm"));
    };
    near(&even_mesh_torques(&structure, &meshes, &loaded).unwrap(), &found);
    let ring = [meshes.clone(), vec![meshes[0].clone()]].concat();
    assert_eq!(mesh_torques(&structure, &ring, &loaded), None);
    let half = found[0].map(|t| 0.5 * t);
    near(&even_mesh_torques(&structure, &ring, &loaded).unwrap(), &[half, found[1], half]);
    // No teeth reach the shaft that is loaded.
    assert_eq!(even_mesh_torques(&structure, &meshes[..1], &loaded), None);
}
