//! Planetary stages as gearboxes seen from their carriers: all axes stand still, the sun drives, the ring takes the load.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use std::{fmt::Write, path::Path};

use analysis::{Context, Ending, NoObserver, gearbox::GearboxResult, solve};
use scene::gearbox::Gearbox;

/// Module, mm.
const MODULE: f64 = 3.0;
/// Torque on the ring, N m.
const TORQUE: f64 = 820.0;

/// A stage of some planets.
#[derive(Clone, Copy)]
pub(crate) struct Stage {
    /// Of sun, planet and ring.
    pub(crate) teeth: [i32; 3],
    pub(crate) count: usize,
    /// How far the pin of planet 1 stands off along the circle, um.
    pub(crate) pin: f64,
    /// Radial stiffness of the sun's bearings, N/mm.
    pub(crate) sun: f64,
    /// Torque on the ring, N m.
    pub(crate) torque: f64,
}

/// Three planets, one after the other: 20 teeth of the sun leave a remainder of 2.
pub(crate) const STAGE: Stage = Stage { teeth: [20, 31, -82], count: 3, pin: 0.0, sun: 6e5, torque: TORQUE };

impl Stage {
    pub(crate) fn text(self) -> String {
        let mut t = String::from("name = \"stage\"\n");
        let a = 0.5 * MODULE * f64::from(self.teeth[0] + self.teeth[1]);
        for (name, x) in [("sun", 0.0), ("ring", 0.0), ("planet", a)] {
            let k = if name == "sun" { self.sun } else { 6e5 };
            let _ = write!(
                t,
                "[[shaft]]\nname = \"{name}\"\norigin_mm = [{x:?}, 0.0, 0.0]\n[[shaft.section]]\nlength_mm = 60.0\n\
                 outer_diameter_mm = 30.0\n[[bearing]]\nname = \"{name} a\"\nshaft = \"{name}\"\nposition_mm = 5.0\n\
                 stiffness_n_per_mm = [{k:?}, {k:?}, 2e5]\n[[bearing]]\nname = \"{name} b\"\nshaft = \"{name}\"\n\
                 position_mm = 55.0\nstiffness_n_per_mm = [{k:?}, {k:?}, 0.0]\n[[gear]]\nname = \"{name}\"\n\
                 shaft = \"{name}\"\nposition_mm = 30.0\n"
            );
        }
        for (pinion, wheel) in [("sun", "planet"), ("planet", "ring")] {
            let _ = write!(t, "[[mesh]]\npinion = \"{pinion}\"\nwheel = \"{wheel}\"\n{}", self.pair(pinion, wheel));
        }
        let errors: Vec<f64> = (0..self.count).map(|n| if n == 0 { self.pin } else { 0.0 }).collect();
        let _ = write!(
            t,
            "[[planets]]\nshafts = [\"planet\"]\naround = \"sun\"\ncount = {}\ntangential_errors_um = {errors:?}\n\
             [input]\nshaft = \"sun\"\nposition_mm = 0.0\n[[torque]]\nshaft = \"ring\"\nposition_mm = 60.0\n\
             torque_nm = {:?}\n[analysis]\npositions_per_cycle = {POSITIONS}\n",
            self.count, self.torque
        );
        t
    }

    pub(crate) fn solve(self) -> GearboxResult {
        self.solve_with(|text| text)
    }

    /// With its document changed.
    fn solve_with(self, change: impl Fn(String) -> String) -> GearboxResult {
        let text = change(self.text());
        let file = Gearbox::parse(&text, Path::new("stage.toml")).unwrap_or_else(|e| panic!("{e}\n{text}"));
        solve(&file, Context::new(&mut NoObserver)).and_then(Ending::finished).unwrap_or_else(|e| panic!("{e}"))
    }

    /// Tables of the pair of two gears, on few elements.
    fn pair(self, pinion: &str, wheel: &str) -> String {
        let teeth = |name: &str| self.teeth[if name == "sun" { 0 } else { 1 + usize::from(name == "ring") }];
        // The ring's tips leave room for the planet's feet.
        let ring = format!("tip_diameter_mm = {:?}\n", -MODULE * f64::from(self.teeth[2]) - 4.8);
        let mut t = String::new();
        for (table, name) in [("pinion", pinion), ("wheel", wheel)] {
            let _ = write!(t, "[mesh.scene.{table}]\nteeth = {}\nthickness_allowance_mm = 0.1\n", teeth(name));
            t.push_str(match table {
                "pinion" => "helix_angle_deg = 0.0\n",
                _ if name == "ring" => &ring,
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
    pub(crate) fn forces(self, found: &GearboxResult) -> Vec<[Vec<f64>; 2]> {
        let of = |p: &gearbox::GearboxPosition, m: usize| {
            p.meshes[m * self.count..][..self.count].iter().map(|mesh| mesh.normal_force).collect()
        };
        found.positions.iter().map(|p| [of(p, 0), of(p, 1)]).collect()
    }

    /// Mean force of each planet on the sun, N.
    fn means(self) -> Vec<f64> {
        let all = self.forces(&self.solve());
        (0..self.count).map(|n| all.iter().map(|p| p[0][n]).sum::<f64>() / all.len() as f64).collect()
    }
}

/// Positions a mesh cycle.
pub(crate) const POSITIONS: usize = 9;

/// Without edges that press off the line of action T_sun : T_ring = z_sun : z_ring at every angle, and a planet's two forces
/// are equal. Planets share the load evenly in the mean. Each has the course of the first one as many cycles later as teeth
/// of the sun are between them: three, four, five and six planets, in phase and one after the other.
#[test]
fn planets_share_the_load_in_their_phases() {
    let evenly = |count: usize| Stage { teeth: [40, 20, -80], count, ..STAGE };
    for stage in [STAGE, evenly(3), evenly(4), evenly(5), evenly(6)] {
        let (Stage { teeth, count, .. }, found) = (stage, stage.solve());
        let wanted = TORQUE * f64::from(teeth[0]) / f64::from(-teeth[2]);
        let off = |p: &gearbox::GearboxPosition| (1e-3 * p.input_torque.abs() / wanted - 1.0).abs();
        let torque = found.positions.iter().map(off).fold(0.0, f64::max);
        let all = stage.forces(&found);
        let apart = all.iter().flat_map(|[sun, ring]| sun.iter().zip(ring)).map(|(a, b)| (a / b - 1.0).abs());
        let apart = apart.fold(0.0, f64::max);
        let mean = |k: usize| all.iter().map(|p| p[0][k]).sum::<f64>() / all.len() as f64;
        let uneven = (1..count).map(|k| (mean(k) / mean(0) - 1.0).abs()).fold(0.0, f64::max);
        let course = |k: usize, i: usize| all[i % POSITIONS][0][k];
        let shifted = |k: usize, by: usize| {
            (0..POSITIONS).map(|i| (course(k, i + by) / course(0, i) - 1.0).abs()).fold(0.0, f64::max)
        };
        // Cycles from planet to planet, in positions.
        let step = teeth[0] as usize * POSITIONS / count % POSITIONS;
        let late = |k: usize| {
            let by = k * step % POSITIONS;
            shifted(k, by).min(shifted(k, POSITIONS - by))
        };
        let (here, late) = (shifted(1, 0), (1..count).map(late).fold(0.0, f64::max));
        println!(
            "{teeth:?}, {count}: torques off by {torque:.1e}, forces of a planet apart by {apart:.1e}, means uneven by {uneven:.1e}"
        );
        println!("    second planet off the first by {here:.1e}, all {step} positions later by {late:.1e}");
        assert!(torque < 1e-8 && apart < 1e-8, "{torque:e}, {apart:e}");
        assert!(uneven < 1e-6 && late < 1e-6, "{uneven:e}, {late:e}");
        assert!(step == 0 || here > 1e-4, "the meshes are in phase");
        let factors: Vec<f64> = found.planets.iter().map(|own| own.factor.unwrap()).collect();
        let largest = all.iter().map(|[sun, _]| {
            let sum: f64 = sun.iter().sum();
            sun.iter().fold(0.0, |most: f64, f| most.max(f / sum)) * count as f64
        });
        let largest = largest.fold(0.0, f64::max);
        assert!(factors.iter().all(|k| (k / largest - 1.0).abs() < 1e-8), "{factors:?} beside {largest}");
    }
}

/// The tilt of a planet that is told is that of its shaft where its gear is, the largest of all positions; perfect planets in
/// phase tilt alike. One of the bearings of each is near the gear.
#[test]
fn planets_tilt_as_their_shafts_do() {
    let stage = Stage { teeth: [40, 20, -80], count: 4, pin: 5.0, ..STAGE };
    let change = |text: String| {
        let near = "name = \"planet a\"\nshaft = \"planet\"\nposition_mm = ";
        assert!(text.contains(near));
        text.replace(&format!("{near}5.0"), &format!("{near}20.0"))
    };
    let found = stage.solve_with(change);
    let at_gear = |shaft: usize, p: &gearbox::GearboxPosition| {
        let line = &p.shafts[shaft];
        let node = line.positions.iter().position(|z| (z - 30.0).abs() < 1e-9).unwrap();
        line.displacements[node][3].hypot(line.displacements[node][4])
    };
    for tilts in &found.planet_tilts {
        for (n, tilt) in tilts.iter().enumerate() {
            let largest = found.positions.iter().map(|p| at_gear(2 + n, p)).fold(0.0, f64::max);
            assert!(*tilt > 1e-6 && (tilt / largest - 1.0).abs() < 1e-12, "{tilts:?} beside {largest}");
        }
    }
    let even = Stage { pin: 0.0, ..stage }.solve_with(change);
    println!("{:.2e} rad with a pin off, {:.2e} rad", found.planet_tilts[0][0], even.planet_tilts[0][0]);
    let alike = |tilts: &Vec<f64>| tilts.iter().all(|own| (own / tilts[0] - 1.0).abs() < 1e-6);
    assert!(even.planet_tilts.len() == 2 && even.planet_tilts.iter().all(alike), "{:?}", even.planet_tilts);
}

/// A pin that stands off by e along the pitch circle: F_1 - F/3 : F_2 - F/3 = 2 : -1 with the sun fixed, in proportion to e;
/// with a sun that floats a stage of three planets shares evenly all the same.
#[test]
fn a_pin_error_is_shared_as_springs_share_it() {
    let mean = |stage: Stage| stage.means();
    let third = mean(Stage { sun: 6e7, ..STAGE })[0];
    let off = |stage: Stage| -> Vec<f64> { mean(stage).into_iter().map(|f| f - third).collect() };
    let fixed = [2.0, 4.0].map(|pin| off(Stage { pin, sun: 6e7, ..STAGE }));
    println!("a third: {third:.1} N; by 2 um {:.2?}, by 4 um {:.2?} N", fixed[0], fixed[1]);
    for off in &fixed {
        assert!((off[1] / off[0] + 0.5).abs() < 0.005 && (off[2] / off[0] + 0.5).abs() < 0.005, "{off:?}");
        assert!(off.iter().sum::<f64>().abs() < 1e-3 * third, "{off:?}");
    }
    assert!((fixed[1][0] / fixed[0][0] / 2.0 - 1.0).abs() < 0.01, "{fixed:?}");
    let floating = off(Stage { pin: 4.0, sun: 10.0, ..STAGE });
    println!("with a sun that floats {floating:.2?} N");
    let largest = floating.iter().copied().map(f64::abs).fold(0.0, f64::max);
    assert!(largest < 0.02 * fixed[1][0].abs(), "{floating:?} beside {:?}", fixed[1]);
}

/// K_gamma - 1 of a pin error goes with 1/torque: a hyperbola but for the contact, which is stiffer under more load.
#[test]
fn the_load_sharing_factor_falls_with_the_torque() {
    let extra = |times: f64| {
        let stage = Stage { pin: -4.0, sun: 6e7, torque: times * TORQUE, ..STAGE };
        // Means, for the meshes one after the other share unevenly without any error.
        let means = stage.means();
        times * (3.0 * means[0] / means.iter().sum::<f64>() - 1.0)
    };
    let all = [0.5, 1.0, 2.0].map(extra);
    println!("K_gamma - 1 times the torque: {all:.5?}");
    assert!(all[0] > 0.01 && all[0] < all[1] && all[1] < all[2] && all[2] < 1.1 * all[0], "{all:?}");
}

/// A pin goes through its planet, and a carrier around them: they are joined by bearings, and nothing is said of that. A part
/// of the carrier that the sun runs through is told, for nothing joins these.
#[test]
fn carriers_and_pins_are_not_said_to_collide() {
    let stage = |inner: f64| {
        let text = STAGE.text();
        let planet = "shaft = \"planet\"\nposition_mm";
        assert_eq!(text.matches(planet).count(), 3);
        // Both bearings, not the gear.
        let text = text.replacen(planet, "shaft = \"planet\"\nin_shaft = \"pin\"\nposition_mm", 2);
        let text = text.replace("shafts = [\"planet\"]", "shafts = [\"planet\", \"pin\"]");
        let held = "stiffness_n_per_mm = [1e6, 1e6, 1e6]\ntilt_stiffness_nm_per_rad = [1e5, 1e5]\n\
                    turn_stiffness_nm_per_rad = 1e6\n";
        let standing = |name: &str, x: f64, [outer, inner]: [f64; 2], seat: &str| {
            format!(
                "[[shaft]]\nname = \"{name}\"\nstands = true\norigin_mm = [{x:?}, 0.0, 0.0]\n[[shaft.section]]\nlength_mm = 60.0\n\
                 outer_diameter_mm = {outer:?}\ninner_diameter_mm = {inner:?}\n[[bearing]]\nname = \"of {name}\"\n\
                 shaft = \"{name}\"\n{seat}position_mm = 30.0\n{held}"
            )
        };
        let text = text
            + &standing("pin", 0.5 * MODULE * 51.0, [20.0, 0.0], "in_shaft = \"carrier\"\n")
            + &standing("carrier", 0.0, [200.0, inner], "");
        let file = Gearbox::parse(&text, Path::new("stage.toml")).unwrap_or_else(|e| panic!("{e}\n{text}"));
        let found = solve(&file, Context::new(&mut NoObserver)).and_then(Ending::finished).unwrap();
        found.remarks.iter().filter(|r| r.code() == "parts_collide").map(|r| r.text()).collect::<Vec<String>>()
    };
    let (wide, narrow) = (stage(180.0), stage(40.0));
    println!("{wide:?}, {narrow:?}");
    assert!(!wide.iter().chain(&narrow).any(|r| r.contains("planet") || r.contains("pin")), "{wide:?} {narrow:?}");
    assert!(narrow.iter().any(|r| r.contains("carrier") && r.contains("sun")), "{narrow:?}");
}

/// A pin so far off that its planet carries nothing: the others do, and all is in balance.
#[test]
fn a_planet_that_carries_nothing_is_in_balance() {
    let stage = Stage { pin: 200.0, ..STAGE };
    let found = stage.solve();
    let least = stage.forces(&found).iter().flat_map(|p| p[0].clone()).fold(f64::INFINITY, f64::min);
    println!("least force {least:.1} N, {:?}", found.certificate);
    assert!(least < 1.0, "{least} N");
    assert!(found.planets.iter().all(|own| own.factor.is_some_and(|k| k > 1.49)), "{:?}", found.planets);
    assert!(found.checks().failed().is_none(), "{:?}", found.checks().failed());
}

/// A pin so far ahead that flanks on the other side would touch is told, with the play that there is; one that stands as far
/// back takes as much, and all pins off alike take none.
#[test]
fn pins_beyond_the_backlash_are_told() {
    let told = |errors: &str| {
        let text =
            STAGE.text().replace("tangential_errors_um = [0.0, 0.0, 0.0]", &format!("tangential_errors_um = {errors}"));
        let file = Gearbox::parse(&text, Path::new("stage.toml")).unwrap_or_else(|e| panic!("{e}"));
        let found = solve(&file, Context::new(&mut NoObserver)).and_then(Ending::finished).unwrap();
        let said =
            found.remarks.iter().filter(|r| r.code() == "planets_without_play").map(|r| r.text()).collect::<Vec<_>>();
        let play: f64 = [found.pairs[0].backlash(), found.pairs[3].backlash()].into_iter().sum();
        let cosines: f64 = [0, 3].iter().map(|i| found.pairs[*i].working_pressure_angle().cos()).sum();
        (said, 1e3 * play / cosines)
    };
    let (none, limit) = told("[10.0, 0.0, 0.0]");
    println!("{limit} um of {none:?}");
    assert!(none.is_empty() && limit > 10.0);
    assert!(told(&format!("[{}, 0.0, 0.0]", 0.99 * limit)).0.is_empty());
    assert_eq!(told(&format!("[{}, 0.0, 0.0]", 1.01 * limit)).0.len(), 1);
    assert_eq!(told(&format!("[0.0, {}, 0.0]", -1.01 * limit)).0.len(), 1);
    assert_eq!(told(&format!("[{0}, {0}, {0}]", 1.01 * limit)).0, Vec::<String>::new());
}
