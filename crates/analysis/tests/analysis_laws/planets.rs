//! Planetary stages as gearboxes seen from their carriers: all axes stand still, the sun drives, the ring takes the load.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use std::{f64::consts::TAU, fmt::Write, path::Path};

use analysis::{Context, Ending, NoObserver, gearbox::GearboxResult, solve};
use scene::gearbox::Gearbox;

/// Module, mm; planets.
const MODULE: f64 = 3.0;
const PLANETS: usize = 3;
/// Torque on the ring, N m.
const TORQUE: f64 = 820.0;

/// A stage of 20, 31 and -82 teeth.
#[derive(Clone, Copy)]
struct Stage {
    /// How far the pin of planet 1 stands off along the pitch circle, mm.
    pin: f64,
    /// Radial stiffness of the sun's bearings, N/mm.
    sun: f64,
}

const TEETH: [i32; 3] = [20, 31, -82];

impl Stage {
    fn text(self) -> String {
        let mut t = String::from("name = \"stage\"\n");
        let a = 0.5 * MODULE * f64::from(TEETH[0] + TEETH[1]);
        let places = (0..PLANETS).map(|k| {
            let (sin, cos) = (TAU * k as f64 / PLANETS as f64).sin_cos();
            let off = if k == 0 { self.pin } else { 0.0 };
            [a * cos - off * sin, a * sin + off * cos]
        });
        let names: Vec<String> = (1..=PLANETS).map(|k| format!("planet {k}")).collect();
        let all = names.iter().map(String::as_str).zip(places);
        let shafts: Vec<(&str, [f64; 2])> = [("sun", [0.0; 2]), ("ring", [0.0; 2])].into_iter().chain(all).collect();
        for (name, [x, y]) in &shafts {
            let k = if *name == "sun" { self.sun } else { 6e5 };
            let _ = write!(
                t,
                "[[shaft]]\nname = \"{name}\"\norigin_mm = [{x:?}, {y:?}, 0.0]\n[[shaft.section]]\nlength_mm = 60.0\n\
                 outer_diameter_mm = 30.0\n[[bearing]]\nname = \"{name} a\"\nshaft = \"{name}\"\nposition_mm = 5.0\n\
                 stiffness_n_per_mm = [{k:?}, {k:?}, 2e5]\n[[bearing]]\nname = \"{name} b\"\nshaft = \"{name}\"\n\
                 position_mm = 55.0\nstiffness_n_per_mm = [{k:?}, {k:?}, 0.0]\n[[gear]]\nname = \"{name}\"\n\
                 shaft = \"{name}\"\nposition_mm = 30.0\n"
            );
        }
        for name in &names {
            for (pinion, wheel, more) in [("sun", name.as_str(), ""), (name, "ring", "timing = \"keyed\"\n")] {
                let _ =
                    write!(t, "[[mesh]]\npinion = \"{pinion}\"\nwheel = \"{wheel}\"\n{more}{}", pair(pinion, wheel));
            }
        }
        let _ = write!(
            t,
            "[input]\nshaft = \"sun\"\nposition_mm = 0.0\n[[torque]]\nshaft = \"ring\"\nposition_mm = 60.0\n\
             torque_nm = {TORQUE:?}\n[analysis]\npositions_per_cycle = 9\n"
        );
        t
    }

    fn solve(self) -> GearboxResult {
        let text = self.text();
        let file = Gearbox::parse(&text, Path::new("stage.toml")).unwrap_or_else(|e| panic!("{e}\n{text}"));
        solve(&file, Context::new(&mut NoObserver)).and_then(Ending::finished).unwrap_or_else(|e| panic!("{e}"))
    }
}

/// Tables of the pair of two gears, on few elements.
fn pair(pinion: &str, wheel: &str) -> String {
    let teeth = |name: &str| TEETH[if name == "sun" { 0 } else { 1 + usize::from(name == "ring") }];
    let mut t = String::new();
    for (table, name) in [("pinion", pinion), ("wheel", wheel)] {
        let _ = write!(t, "[mesh.scene.{table}]\nteeth = {}\nthickness_allowance_mm = 0.1\n", teeth(name));
        t.push_str(match table {
            "pinion" => "helix_angle_deg = 0.0\n",
            _ if name == "ring" => "tip_diameter_mm = 241.2\n",
            _ => "",
        });
        let _ = write!(
            t,
            "[mesh.scene.{table}.mesher]\norder = 1\nelements_profile = 2\nelements_fillet = 2\nelements_thickness = 2\n\
             elements_face = 3\nelements_rim = 2\nsector_teeth = 1\n"
        );
    }
    t + "[mesh.scene.pair]\nnormal_module_mm = 3.0\nface_width_mm = 20.0\n[mesh.scene.operation]\ntorque_nm = 100.0\n\
         [mesh.scene.contact]\nslices = 8\ncorner_contact = false\n"
}

/// Normal forces of the meshes of planets with the sun and with the ring, position by position, N.
fn forces(found: &GearboxResult) -> Vec<[[f64; PLANETS]; 2]> {
    let of = |p: &gearbox::GearboxPosition| [0, 1].map(|m| std::array::from_fn(|k| p.meshes[2 * k + m].normal_force));
    found.positions.iter().map(of).collect()
}

/// Without edges that press off the line of action T_sun : T_ring = z_sun : z_ring at every angle, and a planet's two forces
/// are equal; planets share the load evenly in the
/// mean, each with the course of the one before a third of a mesh cycle later, for 20 teeth of the sun leave a remainder of 2.
#[test]
fn planets_share_the_load_one_after_the_other() {
    let found = Stage { pin: 0.0, sun: 6e5 }.solve();
    let wanted = TORQUE * f64::from(TEETH[0]) / f64::from(-TEETH[2]);
    let torque = found.positions.iter().map(|p| (1e-3 * p.input_torque.abs() / wanted - 1.0).abs()).fold(0.0, f64::max);
    let all = forces(&found);
    let apart = all.iter().flat_map(|[sun, ring]| sun.iter().zip(ring)).map(|(a, b)| (a / b - 1.0).abs());
    let apart = apart.fold(0.0, f64::max);
    let mean = |k: usize| all.iter().map(|p| p[0][k]).sum::<f64>() / all.len() as f64;
    let uneven = (1..PLANETS).map(|k| (mean(k) / mean(0) - 1.0).abs()).fold(0.0, f64::max);
    let course = |k: usize| -> Vec<f64> { all.iter().map(|p| p[0][k]).collect() };
    let (first, second) = (course(0), course(1));
    let shifted = |by: usize| (0..9).map(|i| (second[(i + by) % 9] / first[i] - 1.0).abs()).fold(0.0, f64::max);
    let (here, third) = (shifted(0), shifted(3).min(shifted(6)));
    println!("torques off by {torque:.1e}, forces of a planet apart by {apart:.1e}, means uneven by {uneven:.1e}");
    println!("second planet off the first by {here:.1e}, a third of a cycle later by {third:.1e}");
    assert!(torque < 1e-8 && apart < 1e-8, "{torque:e}, {apart:e}");
    assert!(uneven < 1e-6 && third < 1e-6, "{uneven:e}, {third:e}");
    assert!(here > 1e-4, "the meshes are in phase");
}

/// A pin that stands off by e along the pitch circle: F_1 - F/3 : F_2 - F/3 = 2 : -1 with the sun fixed, in proportion to e;
/// with a sun that floats a stage of three planets shares evenly all the same.
#[test]
fn a_pin_error_is_shared_as_springs_share_it() {
    let mean = |stage: Stage| {
        let all = forces(&stage.solve());
        let of = |k: usize| all.iter().map(|p| p[0][k]).sum::<f64>() / all.len() as f64;
        [of(0), of(1), of(2)]
    };
    let third = mean(Stage { pin: 0.0, sun: 6e7 })[0];
    let fixed = [2e-3, 4e-3].map(|pin| mean(Stage { pin, sun: 6e7 }).map(|f| f - third));
    println!("a third: {third:.1} N; by 2 um {:.2?}, by 4 um {:.2?} N", fixed[0], fixed[1]);
    for off in &fixed {
        assert!((off[1] / off[0] + 0.5).abs() < 0.005 && (off[2] / off[0] + 0.5).abs() < 0.005, "{off:?}");
        assert!(off.iter().sum::<f64>().abs() < 1e-3 * third, "{off:?}");
    }
    assert!((fixed[1][0] / fixed[0][0] / 2.0 - 1.0).abs() < 0.01, "{fixed:?}");
    let floating = mean(Stage { pin: 4e-3, sun: 10.0 }).map(|f| f - third);
    println!("with a sun that floats {floating:.2?} N");
    let largest = floating.into_iter().map(f64::abs).fold(0.0, f64::max);
    assert!(largest < 0.02 * fixed[1][0].abs(), "{floating:?} beside {:?}", fixed[1]);
}

/// A pin so far off that its planet carries nothing: the others do, and all is in balance.
#[test]
fn a_planet_that_carries_nothing_is_in_balance() {
    let found = Stage { pin: -0.2, sun: 6e5 }.solve();
    let least = forces(&found).iter().flat_map(|p| p[0]).fold(f64::INFINITY, f64::min);
    println!("least force {least:.1} N, {:?}", found.certificate);
    assert!(least < 1.0, "{least} N");
    assert!(found.checks().failed().is_none(), "{:?}", found.checks().failed());
}
