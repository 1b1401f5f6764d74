//! Scuffing, films and losses: printed numbers of NREL's third stage, and laws of heat, film and friction.

use rating::{
    Lubricants, Lubrication, LubricationMethod, PressedPlace, RatingError, RatingInput, Rolling, ScuffingInput,
    ScuffingRating, SolvedContact, StandardRating, permissible_film, scuffing_rating, standard_micropitting,
    standard_rating, test_specific_film,
};

use crate::{factors::printed, pair::nrel};

/// KISSsoft's inputs beside those of pitting: bath at 80 C, R_a 0.6 um, X_W = 1.
fn lubrication() -> Lubrication {
    Lubrication {
        lubricant: Lubricants::built_in().find("mineral VG 220").unwrap().clone(),
        oil_temperature_c: 80.0,
        method: LubricationMethod::Dip,
        roughness_ra_um: [0.6; 2],
    }
}

fn input<'a>(pair: &'a RatingInput<'a>, standard: &'a StandardRating) -> ScuffingInput<'a> {
    let (young, poisson) = ([206_000.0; 2], [0.3; 2]);
    ScuffingInput { pair, standard, lubrication: lubrication(), young, poisson, driver: 0, structural_factor: 1.0 }
}

fn rated(change: impl FnOnce(&mut ScuffingInput<'_>)) -> Result<ScuffingRating, RatingError> {
    let pair = nrel();
    let standard = standard_rating(&pair).unwrap();
    let mut input = input(&pair, &standard);
    change(&mut input);
    scuffing_rating(&input)
}

/// All numbers that KISSsoft 03/2017 prints of scuffing after ISO/TR 13989, from which ISO/TS 6336-20 and -21 took over the formulas.
#[test]
fn scuffing_of_nrel_third_stage() {
    let r = rated(|_| ()).unwrap();
    printed(r.thermo_elastic_factor, "50.058");
    printed(r.helical_load_factor, "1.274");
    printed(r.angle_factor, "1.016");
    printed(r.optimal_tip_relief_um, "44.74");
    printed(r.tip_relief_um, "2.00");
    printed(r.oil_viscosity_mpa_s, "30.09");
    printed(r.flash.mean_friction_coefficient, "0.041");
    printed(r.flash.lubricant_factor, "0.843");
    printed(r.flash.mean_flash_temperature_k, "30.20");
    printed(r.flash.bulk_temperature_c, "94.19");
    printed(r.flash.contact_temperature_at, "0.529");
    printed(r.flash.approach_factor, "1.000");
    printed(r.flash.load_sharing_factor, "0.889");
    // eps_alpha and the tip diameters of the report are rounded: 4e-5 of the flash temperature.
    assert!((r.flash.contact_temperature_c - 169.50).abs() < 0.01, "{}", r.flash.contact_temperature_c);
    printed(r.flash.scuffing_temperature_c, "451.98");
    printed(r.flash.safety, "4.156");
    printed(r.integral.mean_friction_coefficient, "0.030");
    printed(r.integral.contact_ratio_factor, "0.263");
    printed(r.integral.geometry_factor, "0.230");
    printed(r.integral.approach_factor, "1.000");
    printed(r.integral.tip_relief_factor, "1.095");
    printed(r.integral.mean_flash_temperature_k, "16.25");
    printed(r.integral.bulk_temperature_c, "91.37");
    printed(r.integral.integral_temperature_c, "115.75");
    printed(r.integral.scuffing_temperature_c, "455.17");
    printed(r.integral.safety, "3.932");
}

/// The start of approach is warmer than the hottest place behind it, by X_J, and its safety is the least one.
#[test]
fn approach_begins_hot() {
    let r = rated(|_| ()).unwrap();
    assert!(r.flash.start_temperature_c > r.flash.contact_temperature_c);
    assert_eq!(r.least_safety(), r.integral.safety.min(r.flash.start_safety));
    // Where the wheel drives, approach is at the tip of the pinion, where the way is longer.
    let other = rated(|input| input.driver = 1).unwrap();
    assert!(other.flash.start_temperature_c > r.flash.start_temperature_c);
    let relieved = nrel();
    let relieved = RatingInput { tip_relief_um: Some(100.0), ..relieved };
    let standard = standard_rating(&relieved).unwrap();
    let relieved = scuffing_rating(&input(&relieved, &standard)).unwrap();
    assert!(relieved.flash.start_temperature_c < r.flash.start_temperature_c);
    assert_eq!(relieved.tip_relief_um, relieved.optimal_tip_relief_um);
}

/// More load, rougher flanks and warmer oil bring scuffing nearer; a better oil and spray do not.
#[test]
fn scuffing_follows_oil_and_surface() {
    let base = rated(|_| ()).unwrap();
    let rough = rated(|input| input.lubrication.roughness_ra_um = [1.2; 2]).unwrap();
    let hot = rated(|input| input.lubrication.oil_temperature_c = 110.0).unwrap();
    for worse in [rough, hot] {
        assert!(worse.flash.safety < base.flash.safety && worse.integral.safety < base.integral.safety);
    }
    let mut oil = lubrication().lubricant.clone();
    oil.scuffing_load_stage = Some(9.0);
    let weak = rated(|input| input.lubrication.lubricant = oil.clone()).unwrap();
    assert!(weak.flash.safety < base.flash.safety && weak.integral.safety < base.integral.safety);
    // 302 N m at load stage 9: 80 + 302 (0.23 + 0.3 (100/220)^0.02).
    printed(weak.integral.scuffing_temperature_c, "238.64");
    let bathed = rated(|input| input.lubrication.method = LubricationMethod::Submerged).unwrap();
    assert!(bathed.flash.bulk_temperature_c < base.flash.bulk_temperature_c);
}

/// A material or an oil without the number that a formula needs is asked for it by name.
#[test]
fn missing_numbers_are_asked_for() {
    let mut oil = lubrication().lubricant.clone();
    (oil.scuffing_load_stage, oil.micropitting_load_stage) = (None, None);
    let error = rated(|input| input.lubrication.lubricant = oil.clone()).unwrap_err();
    assert!(error.to_string().contains("states no `scuffing_load_stage`"), "{error}");
    let error = permissible_film(&oil, 1.0, None).unwrap_err();
    assert!(error.to_string().contains("states no `micropitting_load_stage`"), "{error}");
    assert_eq!(permissible_film(&oil, 1.0, Some(0.3)).unwrap(), (0.3, None));
    oil.micropitting_load_stage = Some(11.0);
    assert!(matches!(test_specific_film(&oil), Err(RatingError::OutOfRange { .. })));
    let pair = nrel();
    let mut steel = pair.gears[1].material.clone();
    steel.specific_heat_j_per_kg_k = None;
    let mut pair = pair;
    pair.gears[1].material = &steel;
    let standard = standard_rating(&pair).unwrap();
    let error = scuffing_rating(&input(&pair, &standard)).unwrap_err();
    assert!(error.to_string().contains("states no `specific_heat_j_per_kg_k`"), "{error}");
}

/// Places of NREL's third stage under an evenly spread load: from A to E in equal steps.
fn places(count: usize, load: f64) -> Vec<PressedPlace> {
    let g = nrel().geometry;
    let tip = |i: usize| 0.5 * (g.tip_diameter[i].powi(2) - g.base_diameter[i].powi(2)).sqrt();
    let line = g.centre_distance * g.working_pressure_angle.sin();
    let (start, end) = (line - tip(1), tip(0));
    let line_load = load / g.transverse_pressure_angle.cos() / g.face_width / 1.463;
    let e_r = 206_000.0 / 0.91;
    (0..count)
        .map(|i| {
            let one = start + (end - start) * (i as f64 + 0.5) / count as f64;
            let radii = [one, line - one];
            let normal = one * radii[1] / line / g.base_helix_angle.cos();
            let pressure = (line_load * e_r / (std::f64::consts::TAU * normal)).sqrt();
            // All places together carry the normal force of the pair.
            let force = load / g.transverse_pressure_angle.cos() / g.base_helix_angle.cos() / count as f64;
            PressedPlace { radii, force, line_load, pressure, is_edge: false }
        })
        .collect()
}

/// With the load of the standard between its buttressed ends (K_Hbeta and K_Halpha in it), the local contact temperature in the middle of recess is that of the standard's formula, but for its two rounded constants (0.51 1.22 for 0.6213).
#[test]
fn evenly_spread_load_has_the_standard_flash_temperature() {
    let pair = nrel();
    let standard = standard_rating(&pair).unwrap();
    let input = input(&pair, &standard);
    let spread = standard.face_load_factor * standard.transverse_load_factor;
    let rolling = Rolling::new(&pair.geometry, pair.pinion_speed_rpm);
    let solved = SolvedContact::new(lubrication(), rolling, places(2000, 240_064.4 * spread), 1, 5e6);
    let (local, field) = solved.scuffing(&input).unwrap().unwrap();
    let whole = scuffing_rating(&input).unwrap();
    // The standard has the ends at 1.3 of the load: its mean is a little higher.
    let share = local.mean_flash_temperature_k / whole.flash.mean_flash_temperature_k;
    assert!((0.96..0.985).contains(&share), "{share}");
    // The end of recess under 1.3 of the load: theta_fl goes with the 0.95th power of it.
    let g = pair.geometry;
    let tip = 0.5 * (g.tip_diameter[0].powi(2) - g.base_diameter[0].powi(2)).sqrt();
    let pressure = places(2000, 240_064.4 * spread).last().unwrap().pressure * 1.3_f64.sqrt();
    let rise = field.temperature_c(0, tip, pressure) - local.bulk_temperature_c;
    let printed = whole.flash.contact_temperature_c - whole.flash.bulk_temperature_c;
    assert!((rise / printed - 1.0).abs() < 4e-3, "{rise}, {printed}");
    assert!(field.temperature_c(0, tip, 0.0).is_nan());
}

/// Friction loses what its coefficient says: the mean coefficient times the work of the forces along the sliding, the same coefficient at any length of the mesh cycle that is looked at.
#[test]
fn losses_are_friction_times_sliding() {
    let pair = nrel();
    let rolling = Rolling::new(&pair.geometry, pair.pinion_speed_rpm);
    let at =
        |count: usize| SolvedContact::new(lubrication(), rolling, places(count, 240_064.4), 1, 5e6).loss().unwrap();
    let (coarse, fine) = (at(400), at(4000));
    assert!((coarse.mesh_loss_w / fine.mesh_loss_w - 1.0).abs() < 1e-3);
    // H_v of Ohlendorf for the way from A to E: the places share one load, as the sum over a mesh cycle does.
    let eps = [0.852_039, 0.610_687];
    let loss_factor = std::f64::consts::PI * (1.0 / 24.0 + 1.0 / 95.0) / pair.geometry.base_helix_angle.cos()
        * (eps[0] * eps[0] + eps[1] * eps[1])
        / (eps[0] + eps[1]);
    let power = 240_064.4 * 20.828;
    let mean = fine.mesh_loss_w / (power * loss_factor);
    assert!((fine.mean_friction_coefficient / mean - 1.0).abs() < 2e-3, "{fine:?}, {mean}");
    assert!((1.0 - fine.efficiency - fine.mesh_loss_w / 5e6).abs() < 1e-15);
    let none: [PressedPlace; 0] = [];
    assert!(SolvedContact::new(lubrication(), rolling, none, 1, 5e6).loss().is_none());
}

/// Films grow with speed and viscosity, hardly with load; the safety is that of the thinnest one, and tip edges do not count.
#[test]
fn films_follow_speed_and_oil() {
    let pair = nrel();
    let film = |rpm: f64, oil_c: f64, load: f64| {
        let pair = RatingInput { pinion_speed_rpm: rpm, tangential_force: load, ..pair };
        let standard = standard_rating(&pair).unwrap();
        let lubrication = Lubrication { oil_temperature_c: oil_c, ..lubrication() };
        let input = ScuffingInput { lubrication: lubrication.clone(), ..input(&pair, &standard) };
        let rolling = Rolling::new(&pair.geometry, rpm);
        let mut all = places(200, load);
        all.push(PressedPlace { is_edge: true, pressure: 1e4, ..all[0] });
        let power = load * pair.geometry.reference_diameter[0] * rpm * std::f64::consts::PI / 6e4;
        let solved = SolvedContact::new(lubrication, rolling, all, 1, power);
        let (rating, field) = solved.micropitting(&input, 1.0, None).unwrap().unwrap();
        let place = places(200, load)[0];
        assert!(field.specific(0, place.radii[0], place.pressure) >= rating.specific_film_thickness);
        let both = [0, 1].map(|gear| field.specific(gear, place.radii[gear], place.pressure));
        assert!((both[1] - both[0]).abs() <= 1e-12 * both[0], "{both:?}");
        rating
    };
    let base = film(1165.9, 80.0, 240_064.4);
    assert!((base.safety - base.specific_film_thickness / base.permissible_specific_film_thickness).abs() < 1e-15);
    assert!(
        (base.permissible_specific_film_thickness / base.test_specific_film_thickness.unwrap() - 1.4).abs() < 1e-12
    );
    assert!((base.film_thickness_um / 0.6 - base.specific_film_thickness).abs() < 1e-15);
    assert!(film(600.0, 80.0, 240_064.4).safety < base.safety);
    assert!(film(1165.9, 100.0, 240_064.4).safety < base.safety);
    let heavy = film(1165.9, 80.0, 2.0 * 240_064.4);
    assert!(heavy.safety < base.safety && heavy.safety > 0.6 * base.safety);
    // Hotter than the law of the pressure-viscosity coefficient reaches: no film, in place of no number.
    let burnt = film(1165.9, 600.0, 240_064.4);
    assert_eq!((burnt.film_thickness_um, burnt.safety), (0.0, 0.0));
}

/// The test gears: H_v = 0.195, a contact stress at C of 1550 MPa at load stage 10 are built in; an oil that stands a higher stage is asked for a thinner film.
#[test]
fn a_better_oil_bears_a_thinner_film() {
    let mut oil = lubrication().lubricant.clone();
    let films: Vec<f64> = (5..=10)
        .map(|stage| {
            oil.micropitting_load_stage = Some(f64::from(stage));
            test_specific_film(&oil).unwrap()
        })
        .collect();
    assert!(films.windows(2).all(|w| w[1] < w[0]), "{films:?}");
    assert!(films.iter().all(|film| (0.05..0.5).contains(film)), "{films:?}");
}

/// Spur teeth, whose ends nothing buttresses: at the ends of the path a third of the load, and numbers everywhere.
#[test]
fn spur_pairs_have_a_third_of_the_load_at_the_ends() {
    let pair = nrel();
    let alpha = 20f64.to_radians();
    let base = pair.geometry.base_diameter;
    let g = rating::PairGeometry {
        helix_angle: 0.0,
        base_helix_angle: 0.0,
        transverse_pressure_angle: alpha,
        reference_diameter: base.map(|d| d / alpha.cos()),
        eps_beta: 0.0,
        ..pair.geometry
    };
    let pair = RatingInput { geometry: g, ..pair };
    let standard = standard_rating(&pair).unwrap();
    let r = scuffing_rating(&input(&pair, &standard)).unwrap();
    assert!(r.flash.safety > 0.0 && r.flash.start_safety > 0.0, "{r:?}");
    // A pair alone from B to D: the hottest place is there or at the ends, and its share is 1/3 .. 1.
    assert!((1.0 / 3.0 - 1e-9..=1.0).contains(&r.flash.load_sharing_factor));
    assert_eq!(r.helical_load_factor, 1.0);
}

/// Method B is method A with the load of the standard: a contact that is pressed so at its contact points has the same film;
/// the test gears at load stage 10 have that of the permissible film, and more load or speed act as on the solved contact.
#[test]
fn method_b_is_the_contact_of_the_standard() {
    let pair = nrel();
    let of = |rpm: f64, load: f64| {
        let pair = RatingInput { pinion_speed_rpm: rpm, tangential_force: load, ..pair };
        let standard = standard_rating(&pair).unwrap();
        let input = input(&pair, &standard);
        let found = standard_micropitting(&input, 1.0, None).unwrap().unwrap();
        let (permissible, _) = permissible_film(&input.lubrication.lubricant, 1.0, None).unwrap();
        assert!((found.safety * permissible / found.specific_film_thickness - 1.0).abs() < 1e-12);
        assert!((found.film_thickness_um / 0.6 / found.specific_film_thickness - 1.0).abs() < 1e-12);
        let geometry = &pair.geometry;
        let rolling = Rolling::new(geometry, rpm);
        // The point by the diameter that is told, pressed as it is there, without the load factors that are added again.
        let radius = 0.5 * (found.pinion_diameter_mm.powi(2) - geometry.base_diameter[0].powi(2)).sqrt();
        let line = geometry.centre_distance * geometry.working_pressure_angle.sin();
        let factor = (standard.application_factor * standard.dynamic_factor).sqrt();
        let place = PressedPlace {
            radii: [radius, line - radius],
            force: load,
            line_load: load / geometry.face_width,
            pressure: found.pressure_mpa / factor,
            is_edge: false,
        };
        let power = load * geometry.reference_diameter[0] * rpm * std::f64::consts::PI / 6e4;
        let solved = SolvedContact::new(input.lubrication.clone(), rolling, [place], 1, power);
        let (own, _) = solved.micropitting(&input, 1.0, None).unwrap().unwrap();
        // Bulk temperatures differ by the loss, which is that of one place here.
        let bulk = own.bulk_temperature_c - found.bulk_temperature_c;
        let film = own.specific_film_thickness / found.specific_film_thickness;
        assert!((film - 1.0).abs() < 0.03 * bulk.abs().max(0.1), "film {film}, bulk {bulk} K apart");
        found
    };
    let base = of(1165.9, 240_064.4);
    assert!((0.05..0.5).contains(&base.tooth_loss_factor) && base.bulk_temperature_c > 80.0, "{base:?}");
    assert!(["A", "E"].contains(&base.point), "the film is thinnest where flanks slide most: {base:?}");
    assert!(of(600.0, 240_064.4).safety < base.safety && of(1165.9, 480_128.8).safety < base.safety);
}
