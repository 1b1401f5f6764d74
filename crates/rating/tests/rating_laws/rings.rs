//! Internal pairs: signs of ISO 21771 in all formulas, the rack as the limit from both sides, and Blok's heat on hollow flanks.

use rating::{
    FlankFactors, Lubricants, Lubrication, LubricationMethod, PairGeometry, PressedPlace, RatingInput, Rolling,
    ScuffingInput, SolvedContact, StandardRating, scuffing_rating, standard_rating,
};

use crate::pair::nrel;

/// A pinion of 36 teeth, module 21 mm, on a wheel of `teeth`, negative for a ring, of the same basic rack without profile shift.
fn geometry(teeth: f64) -> PairGeometry {
    let (m, alpha, sign) = (21.0, 20f64.to_radians(), teeth.signum());
    let z = [36.0, teeth];
    let base = z.map(|z| m * z * alpha.cos());
    let tip = z.map(|z| m * (z + 1.8));
    let distance = 0.5 * m * (z[0] + z[1]);
    let line = distance * alpha.sin();
    let end = |i: usize| 0.5 * (tip[i] * tip[i] - base[i] * base[i]).sqrt();
    let ends = [line - sign * end(1), end(0)];
    PairGeometry {
        teeth: [36, teeth.abs() as u32],
        normal_module: m,
        helix_angle: 0.0,
        base_helix_angle: 0.0,
        normal_pressure_angle: alpha,
        transverse_pressure_angle: alpha,
        working_pressure_angle: alpha,
        centre_distance: distance,
        face_width: 550.0,
        reference_diameter: z.map(|z| m * z),
        base_diameter: base,
        tip_diameter: tip,
        root_diameter: z.map(|z| m * (z - 2.5)),
        bore_diameter: [400.0, m * (teeth - 14.0)],
        path_of_contact: ends,
        eps_alpha: (ends[1] - ends[0]) / (std::f64::consts::PI * m * alpha.cos()),
        eps_beta: 0.0,
    }
}

fn input(teeth: f64) -> RatingInput<'static> {
    let geometry = geometry(teeth);
    let eps = geometry.eps_alpha;
    let alpha = geometry.working_pressure_angle;
    RatingInput {
        geometry,
        flank: FlankFactors {
            zone: (2.0 / (alpha.cos() * alpha.sin())).sqrt(),
            contact_ratio: ((4.0 - eps) / 3.0).sqrt(),
            helix: 1.0,
            ..nrel().flank
        },
        tangential_force: 5e5,
        pinion_speed_rpm: 200.0,
        ..nrel()
    }
}

fn lubrication() -> Lubrication {
    Lubrication {
        lubricant: Lubricants::built_in().find("mineral VG 220").unwrap().clone(),
        oil_temperature_c: 80.0,
        method: LubricationMethod::Dip,
        roughness_ra_um: [0.6; 2],
    }
}

/// Steel, driven by the pinion.
fn scuffing<'a>(pair: &'a RatingInput, standard: &'a StandardRating) -> ScuffingInput<'a> {
    let (young, poisson) = ([206_000.0; 2], [0.3; 2]);
    let (lubrication, driver, structural_factor) = (lubrication(), 0, 1.0);
    ScuffingInput { pair, standard, lubrication, young, poisson, driver, structural_factor }
}

/// Every number of pitting, bending and scuffing of a pinion on a rack, as the limit of rings and of external wheels.
#[test]
fn rings_and_wheels_become_the_same_rack() {
    let rated = |teeth: f64| {
        let input = input(teeth);
        let standard = standard_rating(&input).unwrap_or_else(|e| panic!("{e}"));
        let hot = scuffing_rating(&scuffing(&input, &standard)).unwrap_or_else(|e| panic!("{e}"));
        [
            standard.nominal_contact_stress_mpa,
            standard.pinion.pitting_safety,
            standard.pinion.bending_safety,
            standard.wheel.bending_safety,
            standard.dynamic_factor,
            standard.transverse_load_factor,
            hot.flash.mean_flash_temperature_k,
            hot.flash.contact_temperature_c,
            hot.integral.integral_temperature_c,
        ]
    };
    let (ring, wheel) = (rated(-1e7), rated(1e7));
    for (i, (ring, wheel)) in ring.into_iter().zip(wheel).enumerate() {
        assert!((ring / wheel - 1.0).abs() < 2e-5, "number {i}: ring {ring}, wheel {wheel}");
    }
    // Hollow flanks press less, and lie closer: the ring of 93 teeth is safer than the wheel of 93.
    assert!(rated(-93.0)[0] < 0.75 * rated(93.0)[0]);
}

/// The nominal contact stress over Z_eps is the pressure of Hertz at the pitch point under the whole force: 1/rho = 1/rho_1 - 1/rho_2.
#[test]
fn contact_stress_of_a_ring_is_that_of_hertz() {
    let input = input(-93.0);
    let g = input.geometry;
    let standard = standard_rating(&input).unwrap();
    let [one, two] = [36.0f64, 93.0].map(|z| 0.5 * 21.0 * z * 20f64.to_radians().sin());
    let radius = one * two / (two - one);
    assert!((g.pitch_relative_radius() / radius - 1.0).abs() < 1e-12);
    let line_load = input.tangential_force / g.transverse_pressure_angle.cos() / g.face_width;
    // Z_E of the inputs has three digits.
    let pressure = input.flank.elasticity * (line_load / radius).sqrt();
    let found = standard.nominal_contact_stress_mpa / input.flank.contact_ratio;
    assert!((found / pressure - 1.0).abs() < 1e-12, "{found}, {pressure}");
}

/// Where one pair of teeth carries all of the load, the flash temperature of the standard is Blok's with the speeds and curvatures of
/// hollow flanks, but for its rounded constants (0.51 1.22 for 0.6213); flanks roll without sliding at the pitch point, in one sense.
#[test]
fn heat_of_a_ring_is_that_of_blok() {
    let input = input(-93.0);
    let g = input.geometry;
    let standard = standard_rating(&input).unwrap();
    let scuffing = scuffing(&input, &standard);
    let rolling = Rolling::new(&g, input.pinion_speed_rpm);
    let pitch = rolling.pitch().unwrap();
    assert!(pitch.sliding_speed() < 1e-12 * pitch.rolling_speed());
    let line = g.centre_distance * g.working_pressure_angle.sin();
    let places = |one: f64| {
        let radii = [one, one - line];
        let at = rolling.at(radii).unwrap();
        let same = [rolling.at_pinion(radii[0]).unwrap(), rolling.at_wheel(radii[1]).unwrap()];
        for other in same {
            assert!((other.relative_radius / at.relative_radius - 1.0).abs() < 1e-12);
            assert!((other.sliding_speed() - at.sliding_speed()).abs() < 1e-9 * at.rolling_speed());
        }
        let load = standard.face_load_factor * standard.transverse_load_factor * input.tangential_force;
        let line_load = load / g.transverse_pressure_angle.cos() / g.face_width;
        let pressure = (line_load * 206_000.0 / 0.91 / (std::f64::consts::TAU * at.relative_radius)).sqrt();
        PressedPlace { radii, force: line_load * g.face_width, line_load, pressure, is_edge: false }
    };
    let whole = scuffing_rating(&scuffing).unwrap();
    // The hottest place of the standard, in its parameter Gamma, under its share of the load.
    let hottest = places(g.pitch_radii()[0] * (1.0 + whole.flash.contact_temperature_at));
    let solved = SolvedContact::new(lubrication(), rolling, [hottest], 1, 5e6);
    let (local, field) = solved.scuffing(&scuffing).unwrap().unwrap();
    let pressure = hottest.pressure * whole.flash.load_sharing_factor.sqrt();
    let rise = field.temperature_c(0, hottest.radii[0], pressure) - local.bulk_temperature_c;
    let standard_rise =
        (whole.flash.contact_temperature_c - whole.flash.bulk_temperature_c) / whole.flash.approach_factor;
    assert!((rise / standard_rise - 1.0).abs() < 4e-3, "{rise}, {standard_rise}");
    let of_ring = field.temperature_c(1, hottest.radii[1], pressure) - local.bulk_temperature_c;
    assert!((of_ring / rise - 1.0).abs() < 1e-9, "{of_ring}, {rise}");
}
