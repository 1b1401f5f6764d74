//! The standard's rating of a pair as a whole.

use rating::{
    Deviations, Edition, FlankFactors, GearInput, GivenFactors, Lubricants, Materials, MeshStiffness, PairGeometry,
    RatedSpectrum, RatingError, RatingInput, RootFactors, Spectrum, StandardRating, local_bending_safety,
    local_pitting_safety, standard_rating,
};

/// Radii of curvature of the pinion at both ends of the path of contact between tip circles, mm.
fn ends(base: [f64; 2], tip: [f64; 2]) -> [f64; 2] {
    let [one, two] = [0, 1].map(|i| 0.5 * (tip[i] * tip[i] - base[i] * base[i]).sqrt());
    [(861.0 * 861.0 - 0.25 * (base[0] + base[1]).powi(2)).sqrt() - two, one]
}

/// The third stage of NREL's 5 MW gearbox as KISSsoft 03/2017 prints it (report in the open repository gfsReboucas/Drivetrain): ISO 6336:2006, grade 6 of ISO 1328:1995, 175,200 h.
pub fn nrel() -> RatingInput<'static> {
    let steel = Materials::built_in().find("18CrNiMo7-6").unwrap();
    let alpha_n = 20f64.to_radians();
    // h_F*, s_Fn*, alpha_Fen, q_s as printed.
    let root = |lever: f64, chord: f64, angle: f64, notch: f64| {
        let slender = chord / lever;
        RootFactors {
            form: 6.0 * lever * angle.to_radians().cos() / (chord * chord * alpha_n.cos()),
            load_share: 1.0,
            stress_correction: (1.2 + 0.13 * slender) * notch.powf(1.0 / (1.21 + 2.3 / slender)),
            notch,
            rim: 1.0,
            deep_tooth: 1.0,
        }
    };
    let gear = |root: RootFactors| GearInput {
        material: steel,
        density: 7830.0,
        root,
        flank_roughness_um: 4.8,
        root_roughness_um: 20.0,
        reversed_load_ratio: 0.0,
        meshes_per_turn: 1.0,
    };
    let beta = 10f64.to_radians();
    RatingInput {
        edition: Edition::Iso2006,
        geometry: PairGeometry {
            teeth: [24, 95],
            normal_module: 14.0,
            helix_angle: beta,
            base_helix_angle: (beta.sin() * alpha_n.cos()).asin(),
            normal_pressure_angle: alpha_n,
            transverse_pressure_angle: (alpha_n.tan() / beta.cos()).atan(),
            working_pressure_angle: (0.5 * (320.026_f64 + 1266.770) / 861.0).acos(),
            centre_distance: 861.0,
            face_width: 360.0,
            reference_diameter: [341.183, 1350.517],
            base_diameter: [320.026, 1266.770],
            tip_diameter: [380.747, 1395.376],
            root_diameter: [319.623, 1334.252],
            bore_diameter: [179.10, 1193.32],
            path_of_contact: ends([320.026, 1266.770], [380.747, 1395.376]),
            eps_alpha: 1.463,
            eps_beta: 1.421,
        },
        flank: FlankFactors {
            zone: 2.307,
            elasticity: 189.812,
            contact_ratio: 1.0 / 1.4627f64.sqrt(),
            helix: 1.0 / beta.cos().sqrt(),
            single_contact: [1.0; 2],
        },
        stiffness: MeshStiffness { single: 13.832, mesh: 18.632 },
        gears: [gear(root(1.004, 2.227, 23.89, 2.620)), gear(root(1.151, 2.340, 22.20, 3.036))],
        lubricant: Lubricants::built_in().find("mineral VG 220").unwrap(),
        deviations: Deviations { base_pitch_um: 15.9, profile_form_um: 22.0, is_fine: false },
        tip_relief_um: None,
        tangential_force: 240_064.4,
        pinion_speed_rpm: 1165.9,
        factors: GivenFactors { application: 1.25, face_load: 1.15, dynamic: None, transverse: None },
        life_h: 175_200.0,
        limited_pitting: false,
        long_life: 0.85,
    }
}

fn rated(input: &RatingInput<'_>) -> StandardRating {
    standard_rating(input).unwrap_or_else(|e| panic!("{e}"))
}

/// All printed numbers of the rating, to what the printed digits of its inputs leave.
#[test]
fn third_stage_of_nrel() {
    let r = rated(&nrel());
    let close = |what: &str, value: f64, printed: f64, most: f64| {
        assert!((value / printed - 1.0).abs() < most, "{what}: {value}, printed is {printed}");
    };
    close("v", r.line_speed_m_per_s, 20.83, 3e-4);
    close("n_E1", r.resonance_speed_rpm, 2843.0, 2e-4);
    close("K_V", r.dynamic_factor, 1.092, 4.6e-4);
    close("K_Halpha", r.transverse_load_factor, 1.069, 4.7e-4);
    close("K_Fbeta", r.face_load_factor_bending, 1.136, 5e-4);
    close("sigma_H0", r.nominal_contact_stress_mpa, 570.79, 2e-4);
    let rows = [
        (&r.pinion, 739.61, 1338.30, 1.81, 117.92, 195.64, 637.15, 3.26),
        (&r.wheel, 739.61, 1387.31, 1.88, 127.69, 211.85, 654.72, 3.09),
    ];
    for (gear, h, hg, s_h, f0, f, fg, s_f) in rows {
        close("sigma_H", gear.contact_stress_mpa, h, 3e-4);
        close("sigma_HG", gear.contact_stress_limit_mpa, hg, 5e-4);
        assert!((gear.pitting_safety - s_h).abs() < 0.0051, "S_H {}, printed is {s_h}", gear.pitting_safety);
        close("sigma_F0", gear.nominal_root_stress_mpa, f0, 1e-3);
        close("sigma_F", gear.root_stress_mpa, f, 1e-3);
        close("sigma_FG", gear.root_stress_limit_mpa, fg, 3e-4);
        assert!((gear.bending_safety - s_f).abs() < 0.0051, "S_F {}, printed is {s_f}", gear.bending_safety);
    }
    assert!((r.pinion.load_cycles / 12_255.788e6 - 1.0).abs() < 1e-4);
    assert!(r.outside.is_empty(), "{:?}", r.outside);
}

/// Exchanged gears have each other's rating: the standard knows no driver.
#[test]
fn exchanged_gears_are_rated_alike() {
    let one = nrel();
    let exchange = |x: [f64; 2]| [x[1], x[0]];
    let g = one.geometry;
    let other = RatingInput {
        geometry: PairGeometry {
            teeth: [95, 24],
            reference_diameter: exchange(g.reference_diameter),
            base_diameter: exchange(g.base_diameter),
            tip_diameter: exchange(g.tip_diameter),
            root_diameter: exchange(g.root_diameter),
            bore_diameter: exchange(g.bore_diameter),
            path_of_contact: ends(exchange(g.base_diameter), exchange(g.tip_diameter)),
            ..g
        },
        gears: [one.gears[1], one.gears[0]],
        pinion_speed_rpm: one.pinion_speed_rpm * 24.0 / 95.0,
        ..one
    };
    let (one, other) = (rated(&one), rated(&other));
    for (a, b) in one.gears().into_iter().zip([&other.wheel, &other.pinion]) {
        for (a, b) in [
            (a.pitting_safety, b.pitting_safety),
            (a.bending_safety, b.bending_safety),
            (a.load_cycles, b.load_cycles),
            (a.pitting_life_h, b.pitting_life_h),
        ] {
            // Lives go with the 65th power of the load, and the printed diameters are not quite as 24 to 95.
            assert!((a / b - 1.0).abs() < 1e-4, "{a}, exchanged {b}");
        }
    }
}

/// With load factors that stay, contact stress grows with the root of the load, root stress with the load, and the life at safety 1 is the required one.
#[test]
fn stresses_follow_the_load() {
    let given = GivenFactors { dynamic: Some(1.1), transverse: Some(1.05), ..nrel().factors };
    let at = |share: f64| rated(&RatingInput { factors: given, tangential_force: share * 240_064.4, ..nrel() });
    let (one, four) = (at(1.0), at(4.0));
    for (a, b) in one.gears().into_iter().zip(four.gears()) {
        assert!((b.contact_stress_mpa / a.contact_stress_mpa - 2.0).abs() < 1e-12);
        assert!((b.root_stress_mpa / a.root_stress_mpa - 4.0).abs() < 1e-12);
    }
    // A life within the lines: where S_H is 1, the life is the one that was asked for.
    let short = RatingInput { factors: given, life_h: 1000.0, ..nrel() };
    let safety = rated(&short).pinion.pitting_safety;
    let full = RatingInput { tangential_force: short.tangential_force * safety * safety, ..short };
    let r = rated(&full);
    assert!((r.pinion.pitting_safety - 1.0).abs() < 1e-12);
    assert!((r.pinion.pitting_life_h / 1000.0 - 1.0).abs() < 1e-9, "{}", r.pinion.pitting_life_h);
}

/// What has no meaning is refused by name; what the standard does not cover is told.
#[test]
fn odd_inputs_are_refused_or_told() {
    let refused = |input: RatingInput<'_>| standard_rating(&input).unwrap_err().to_string();
    let e = refused(RatingInput { tangential_force: 0.0, ..nrel() });
    assert!(e.starts_with("the tangential force in N is 0"), "{e}");
    let e = refused(RatingInput { life_h: f64::NAN, ..nrel() });
    assert!(e.starts_with("the required life in h is NaN"), "{e}");
    let flat = PairGeometry { root_diameter: [400.0, 1400.0], ..nrel().geometry };
    assert!(refused(RatingInput { geometry: flat, ..nrel() }).starts_with("a tooth height in mm"));
    let steep = PairGeometry { helix_angle: 35f64.to_radians(), ..nrel().geometry };
    let told = rated(&RatingInput { geometry: steep, ..nrel() }).outside;
    assert_eq!(told.iter().map(|o| o.quantity).collect::<Vec<_>>(), ["the helix angle in degrees"]);
    let soft = rating::Material { yield_stress_mpa: None, ..Materials::built_in().find("C45 200 HV").unwrap().clone() };
    let gears = nrel().gears.map(|g| GearInput { material: &soft, ..g });
    let lacking = standard_rating(&RatingInput { gears, ..nrel() }).unwrap_err();
    assert!(matches!(lacking, RatingError::MaterialLacks { key: "yield_stress_mpa", .. }), "{lacking}");
}

/// A spectrum of one load is that load: the factor that makes Miner's sum 1 is the safety of the standard, and the sum the required life over the one that is borne. Halves of the same load do the same damage; idle time none.
#[test]
fn spectra_add_up() {
    let input = RatingInput { life_h: 2000.0, ..nrel() };
    let nominal = [162_105.5, 1165.9];
    let of = |text: &str| RatedSpectrum::new(&input, &Spectrum::parse(text).unwrap(), nominal).unwrap().rating();
    let one = of("torque_nm, speed_rpm, share\n162105.5, 1165.9, 1\n");
    let r = rated(&input);
    for (gear, damage) in r.gears().into_iter().zip([one.pinion, one.wheel]) {
        assert!((damage.pitting_safety / gear.pitting_safety - 1.0).abs() < 1e-9, "{damage:?}");
        assert!((damage.bending_safety / gear.bending_safety - 1.0).abs() < 1e-9, "{damage:?}");
        assert!((damage.pitting_damage * gear.pitting_life_h / 2000.0 - 1.0).abs() < 1e-9);
    }
    let halves = of("speed_rpm, duration_h, torque_nm\n1165.9, 7, 162105.5 # full load\n\n1165.9, 7, 162105.5\n");
    assert!((halves.pinion.pitting_damage / one.pinion.pitting_damage - 1.0).abs() < 1e-12);
    let idle = of("torque_nm,speed_rpm,duration_s\n162105.5,1165.9,1800\n0,0,1800\n");
    assert!((idle.pinion.pitting_damage / one.pinion.pitting_damage - 0.5).abs() < 1e-12);
    let lighter = of("torque_nm,speed_rpm,share\n162105.5,1165.9,0.5\n100000,1165.9,0.5\n");
    assert!(lighter.wheel.pitting_damage < one.wheel.pitting_damage);
    assert!(lighter.wheel.pitting_safety > one.wheel.pitting_safety);
}

/// A damaged spectrum is refused with its line.
#[test]
fn damaged_spectra_are_refused() {
    for (text, said) in [
        ("", "line 1: the file is empty"),
        ("torque,speed_rpm,share\n", "line 1: the columns are torque, speed_rpm, share"),
        ("torque_nm,speed_rpm,share\n1,2\n", "line 2: 2 values, the heading has 3"),
        ("torque_nm,speed_rpm,share\n1,2,3\n1,x,3\n", "line 3: `1,x,3` has a value that is not a number"),
        ("torque_nm,speed_rpm,share\n1,-2,3\n", "line 2:"),
        ("torque_nm,speed_rpm,share\n1,1e12,3\n", "line 2: `1,1e12,3`: at most 1e9 N m and 1e7 1/min are taken"),
        ("torque_nm,speed_rpm,share,duration_h\n1,2,3,4\n", "line 1: `share` and `duration_h` both say how long"),
        ("torque_nm,torque_nm,speed_rpm,share\n1,2,3,4\n", "line 1: two columns are `torque_nm`"),
        ("torque_nm,speed_rpm,share\n1,2,0\n0,2,1\n", "line 1: no load with a torque and a speed lasts any time"),
    ] {
        let error = Spectrum::parse(text).unwrap_err().to_string();
        assert!(error.starts_with(said), "{error}");
    }
}

/// Local safeties fall with stress and load as the standard's do, and where nothing presses there is none.
#[test]
fn local_safeties_follow_stress_and_load() {
    assert_eq!(local_pitting_safety(1500.0, 1000.0, 1.0, 1.0), 1.5);
    assert_eq!(local_pitting_safety(1500.0, 800.0, 1.25, 4.0), 0.75);
    assert_eq!(local_bending_safety(800.0, 200.0, 2.0), 2.0);
    assert!(local_pitting_safety(1500.0, 0.0, 1.0, 1.0).is_nan() && local_bending_safety(800.0, -5.0, 1.0).is_nan());
}
