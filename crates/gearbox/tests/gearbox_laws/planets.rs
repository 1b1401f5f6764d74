//! Planetary stages seen from their carriers: what carrier and pins are, torques, pin errors, and what is refused.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use std::f64::consts::TAU;

use gearbox::{
    Assembly, Bearing, Disc, GearMesh, GearboxError, GearboxPosition, LoadSharing, MeshElement, MeshSpring, Meshing,
    Operation, Rotors, SeatError, Shaft, StaticGearbox, Structure, Torque,
    rolling_bearing::{AxialSetting, RollingElements, Row},
};
use geometry::{Gear, GearData, GearPair, Sense};
use nalgebra::{Vector3, Vector6};

use crate::{
    involute_mesh::involutes,
    pairs::{operation, shaft, springs},
    rolling::{balls_209, made},
};

/// What makes the test mesh of a pair.
type Element = fn(usize, &GearMesh, &Meshing) -> Result<Box<dyn MeshElement>, GearboxError>;

/// Sun, planet and ring; module 3 mm: 3, 4, 5 and 6 planets go in evenly.
const TEETH: [u32; 3] = [40, 20, 80];
const RATIO: f64 = 2.0;
/// Torque of the ring, N mm.
const TORQUE: f64 = 8e5;
/// Stiffness of a mesh along its normal, N/mm, as [`involutes`] has it.
const MESH: f64 = 4e5;
/// Centre distance, mm, and where gears are on shafts of a length.
const ARM: f64 = 90.0;
const MIDDLE: f64 = 30.0;
const LENGTH: f64 = 60.0;

/// What carries the planets.
#[derive(Clone, Copy, PartialEq)]
pub enum Carried {
    /// Bearings in the ground.
    Ground,
    /// Bearings in a rigid body whose one bearing has these stiffnesses, N/mm and N mm/rad.
    Body(f64, f64),
    /// Bearings on pins, which sit in a carrier of beams.
    Pins,
}

#[derive(Clone, Copy)]
pub struct Stage {
    pub count: usize,
    pub helix_deg: f64,
    pub carried: Carried,
    /// How far the seat of planet 1 stands off along the circle, mm.
    pub off: f64,
    /// Radial stiffness of the bearings of sun, and of all others, N/mm.
    pub sun: f64,
    pub others: f64,
    /// Diameter of the shafts of gears, mm.
    pub thick: f64,
    /// Planets on balls.
    pub rolls: bool,
    pub torque: f64,
}

pub const STAGE: Stage = Stage {
    count: 3,
    helix_deg: 0.0,
    carried: Carried::Ground,
    off: 0.0,
    sun: 3e5,
    others: 3e5,
    thick: 40.0,
    rolls: false,
    torque: TORQUE,
};

impl Stage {
    fn pairs(self) -> [GearPair; 2] {
        let helix = self.helix_deg.to_radians();
        let gear = |teeth: u32, helix_angle: f64, bore_diameter: f64| GearData {
            teeth,
            helix_angle,
            bore_diameter,
            // Centre distances are those of spur gears.
            normal_module: 3.0 * helix.cos(),
            face_width: 20.0,
            ..GearData::default()
        };
        let [sun, planet] = [gear(TEETH[0], helix, 60.0), gear(TEETH[1], -helix, 30.0)];
        let ring = GearData { addendum_coefficient: 0.7, ..gear(TEETH[2], -helix, -300.0) }.with_usual_shaper(0.0);
        let [sun, planet, ring] = [sun, planet, ring].map(|data| Gear::new(data).unwrap());
        [GearPair::new(sun, planet.clone(), None).unwrap(), GearPair::new(planet, ring, None).unwrap()]
    }

    /// Shafts: sun, ring, planets, carrier, pins. Discs: sun, ring, planets, input, output.
    pub fn parts(self) -> (Structure, Vec<GearMesh>, Operation) {
        let at = |n: usize| {
            let (sin, cos) = (TAU * n as f64 / self.count as f64).sin_cos();
            [ARM * cos, ARM * sin]
        };
        let long = |name: &str, [x, y]: [f64; 2]| shaft(name, [x, y, 0.0], LENGTH, self.thick);
        let mut shafts = vec![long("sun", [0.0; 2]), long("ring", [0.0; 2])];
        let planets: Vec<usize> = (0..self.count).map(|n| 2 + n).collect();
        shafts.extend((0..self.count).map(|n| long(&format!("planet {n}"), at(n))));
        let carrier = shafts.len();
        let both = |name: String, shaft: usize, k: f64| {
            [(10.0, 1e5), (50.0, 0.0)]
                .map(|(z, axial)| Bearing::diagonal(format!("{name} {z}"), shaft, z, [k, k, axial, 1e7, 1e7, 0.0]))
        };
        let mut bearings: Vec<Bearing> = both("sun".into(), 0, self.sun).into();
        bearings.extend(both("ring".into(), 1, self.others));
        for (n, &planet) in planets.iter().enumerate() {
            let (sin, cos) = (TAU * n as f64 / self.count as f64).sin_cos();
            let off = if n == 0 { self.off } else { 0.0 };
            let outer = match self.carried {
                Carried::Ground => None,
                Carried::Body(..) => Some(carrier),
                Carried::Pins => Some(carrier + 1 + n),
            };
            for own in both(format!("planet {n}"), planet, self.others) {
                let own = if self.rolls {
                    let law = made(RollingElements::Balls(balls_209()), &[ROW], 0.0, AxialSetting::Preload(50.0));
                    Bearing::rolling(own.name, planet, own.position, law)
                } else {
                    own
                };
                bearings.push(Bearing { outer, offset: Vector3::new(-off * sin, off * cos, 0.0), ..own });
            }
        }
        let mut standing = Vec::new();
        match self.carried {
            Carried::Ground => {}
            Carried::Body(k, turn) => {
                shafts.push(Shaft {
                    name: "carrier".into(),
                    origin: [0.0; 3],
                    pieces: Vec::new(),
                    longest_element: 1.0,
                });
                bearings.push(Bearing::diagonal("carrier", carrier, 0.0, [k, k, k, turn, turn, turn]));
                standing.push(carrier);
            }
            Carried::Pins => {
                shafts.push(shaft("carrier", [0.0; 3], LENGTH, 100.0));
                standing.push(carrier);
                let turn = [1e9, 0.0];
                for (own, turn) in both("carrier".into(), carrier, 1e6).into_iter().zip(turn) {
                    let mut stiffness = own.stiffness;
                    stiffness[(5, 5)] = turn;
                    bearings.push(Bearing { stiffness, ..own });
                }
                for n in 0..self.count {
                    let pin = shafts.len();
                    shafts.push(shaft(&format!("pin {n}"), [at(n)[0], at(n)[1], 0.0], LENGTH, 20.0));
                    standing.push(pin);
                    for own in both(format!("pin {n}"), pin, 1e6) {
                        let mut stiffness = own.stiffness;
                        stiffness[(5, 5)] = 1e8;
                        bearings.push(Bearing { stiffness, ..own }.in_shaft(carrier));
                    }
                }
            }
        }
        let mut discs = vec![Disc::seat("sun", 0, MIDDLE), Disc::seat("ring", 1, MIDDLE)];
        discs.extend(planets.iter().map(|&p| Disc::seat(format!("planet {}", p - 2), p, MIDDLE)));
        let input = discs.len();
        discs.extend([Disc::seat("input", 0, 0.0), Disc::seat("output", 1, LENGTH)]);
        let [outside, inside] = self.pairs();
        let mesh = |name: &str, n: usize, discs, pair: &GearPair| GearMesh {
            name: format!("{name} {n}"),
            discs,
            pair: pair.clone(),
        };
        let meshes = (0..self.count)
            .flat_map(|n| [mesh("sun", n, [0, 2 + n], &outside), mesh("ring", n, [2 + n, 1], &inside)])
            .collect();
        let structure = Structure { shafts, discs, bearings, standing, ..Structure::default() };
        // The ring turns with the planets, against the sun.
        let load = Torque { disc: input + 1, torque: self.torque };
        let run = operation(&structure, input, Sense::Ccw, vec![load]);
        (structure, meshes, run)
    }

    fn solve(self) -> (Structure, GearboxPosition) {
        self.solve_with(involutes)
    }

    fn solve_with(self, element: Element) -> (Structure, GearboxPosition) {
        let (structure, meshes, run) = self.parts();
        let made = StaticGearbox::new(structure.clone(), meshes, run, element);
        (structure, made.and_then(|mut g| g.solve(0.0)).unwrap_or_else(|e| panic!("{e}")))
    }

    fn meshes(self, which: usize) -> Vec<usize> {
        (0..self.count).map(|n| 2 * n + which).collect()
    }
}

const ROW: Row = Row { position: 0.0, thrust: 1.0 };

/// Planets whose bearings sit in a rigid body that is held stand as those in the ground, springs and balls: a carrier of
/// 1e11 N/mm gives way by some 1e-5 of what bearings of 3e5 N/mm do.
#[test]
fn a_rigid_carrier_that_is_held_is_the_ground() {
    for rolls in [false, true] {
        let stage = Stage { rolls, off: 2e-3, ..STAGE };
        let (_, ground) = stage.solve();
        let (_, body) = Stage { carried: Carried::Body(1e11, 1e15), ..stage }.solve();
        let largest = ground.meshes.iter().map(|m| m.normal_force).fold(0.0, f64::max);
        for (a, b) in ground.meshes.iter().zip(&body.meshes) {
            let off = (a.normal_force - b.normal_force).abs() / largest;
            assert!(off < 2e-5, "balls {rolls}: forces off by {off:e}");
            let off = (a.transmission_error / b.transmission_error - 1.0).abs();
            assert!(off < 2e-5, "balls {rolls}: transmission errors off by {off:e}");
        }
        for (a, b) in ground.bearings.iter().zip(&body.bearings) {
            let off = (0..3).map(|k| (a.force[k] - b.force[k]).abs()).fold(0.0, f64::max) / largest;
            assert!(off < 2e-5, "balls {rolls}: bearing forces off by {off:e}");
        }
    }
}

/// With pins in a carrier of beams: torques sun : ring : carrier = 1 : z_r/z_s : 1 + z_r/z_s, both forces of a planet are
/// equal, every shaft is in balance, and so is all of it on what stands in the ground, however far the carrier has turned.
/// Helical planets want to tilt. About axes across, beams are in balance where they are not displaced: what is left over is
/// less than axial forces on the largest displacement.
#[test]
fn a_stage_on_pins_is_in_balance() {
    for (count, helix_deg, rolls) in
        [(3, 0.0, false), (3, 12.0, true), (4, 12.0, false), (5, 0.0, true), (6, 12.0, false)]
    {
        let stage = Stage { count, helix_deg, rolls, carried: Carried::Pins, off: 2e-3, ..STAGE };
        let (structure, found) = stage.solve();
        let sun = found.input_torque;
        let off = (sun * RATIO / TORQUE - 1.0).abs();
        assert!(off < 1e-9, "{count} planets: torque of the sun off by {off:e}");
        let grounded = || structure.bearings.iter().zip(&found.bearings).filter(|(b, _)| b.outer.is_none());
        let of_carrier = 2 + count;
        // All about the axis of the stage.
        let held: f64 = grounded().filter(|(b, _)| b.shaft == of_carrier).map(|(_, s)| s.moment[2]).sum();
        let off = (held / (-sun * (1.0 + RATIO)) - 1.0).abs();
        assert!(off < 1e-9, "{count} planets: torque of the carrier off by {off:e}");
        for n in 0..count {
            let [a, b] = [0, 1].map(|k| found.meshes[2 * n + k].normal_force);
            assert!((a / b - 1.0).abs() < 1e-9, "planet {n} of {count}: {a} and {b} N");
        }
        // Newton's method is quadratic by the right slopes alone.
        let own = found.certificate;
        assert!(own.body_balance < 1e-9 && own.iterations < if rolls { 20 } else { 10 }, "{count} planets: {own:?}");
        let (mut force, mut moment) = (Vector3::zeros(), Vector3::<f64>::zeros());
        for (bearing, state) in grounded() {
            let [x, y, z] = structure.shafts[bearing.shaft].origin;
            let own = Vector3::from(state.force);
            force += own;
            moment += Vector3::new(x, y, z + bearing.position).cross(&own) + Vector3::from(state.moment);
        }
        moment.z += sun + TORQUE;
        let lag = found.output_lags[0];
        println!(
            "{count} planets at {helix_deg} degrees, {lag:.1e} rad: left over {:.1e} N, {:.1e} N mm",
            force.norm(),
            moment.z
        );
        assert!(lag > 1e-3 && force.norm() < 1e-9 * TORQUE / ARM, "{count} planets: {force:?} N left over");
        assert!(moment.z.abs() < 1e-9 * TORQUE, "{count} planets: {moment:?} N mm left over");
        let of_nodes = found.shafts.iter().flat_map(|line| &line.displacements).map(|d| d[0].hypot(d[1]));
        let axial: f64 = found.meshes.iter().map(|mesh| mesh.force[0][2].abs()).sum();
        let across = of_nodes.fold(0.0, f64::max) * axial + 1e-9 * TORQUE;
        assert!(moment.xy().norm() < across, "{count} planets: {moment:?} N mm left over, {across}");
    }
}

/// Axial forces of both meshes of a helical planet are opposite, on both sides of its axis: its bearings hold the moment
/// F_t tan b (d_ws + d_wr)/2, which tilts it, to 1e-6 under a load that moves nothing by more than that of the radii. Spur
/// planets on both sides alike do not tilt.
#[test]
fn helical_planets_are_tilted_by_their_meshes() {
    for (count, helix_deg) in [(3, 0.0), (3, 12.0), (4, -20.0)] {
        let stage = Stage { count, helix_deg, torque: 1e-3 * TORQUE, carried: Carried::Body(1e6, 1e11), ..STAGE };
        let (structure, found) = stage.solve();
        let of_teeth = 1.5 * f64::from(TEETH[1]);
        for n in 0..count {
            let mut held = Vector3::zeros();
            for (bearing, state) in structure.bearings.iter().zip(&found.bearings).filter(|(b, _)| b.shaft == 2 + n) {
                let arm = Vector3::new(0.0, 0.0, bearing.position - MIDDLE);
                held += arm.cross(&Vector3::from(state.force)) + Vector3::from(state.moment);
            }
            let axial = [2 * n, 2 * n + 1].map(|m| found.meshes[m].force[[1, 0][m % 2]][2]);
            let tangential = found.input_torque / count as f64 / (1.5 * f64::from(TEETH[0]));
            let wanted = tangential * helix_deg.to_radians().tan().abs() * 2.0 * of_teeth;
            let off = (held.xy().norm() - wanted).abs() / (tangential * of_teeth);
            let tilt = [found.meshes[2 * n].tilt(1), found.meshes[2 * n + 1].tilt(0)];
            println!("{helix_deg} degrees: {:.6} of {wanted:.6} N mm, tilts {tilt:?}", held.xy().norm());
            assert!(off < 1e-6 && (axial[0] + axial[1]).abs() < 1e-9 * tangential, "{off:e}, {axial:?}");
            assert!((tilt[0] - tilt[1]).abs() <= 1e-12 * tilt[0] && (tilt[0] > 1e-9) == (helix_deg != 0.0), "{tilt:?}");
        }
    }
}

/// A pin that stands ahead by e along the circle, in the sense of the sun, in bearings that do not give way: with the path
/// stiffness k of a planet its force is less than the mean by k e (1 - 1/N) with the sun fixed and by k e (1 - 3/N) with
/// one that floats, to 2e-3: bearings of 1e9 N/mm and shafts
/// of 1 m in diameter stand for rigid ones.
///
/// ```text
/// k = (cos a_s + cos a_r)^2/(1/k_s + 1/k_r)        along the circle; a: working pressure angles
/// ```
#[test]
fn a_pin_error_is_shared_by_the_path_stiffness() {
    let e = 1e-3;
    for count in [3, 4, 5, 6] {
        let rigid = Stage { count, others: 1e9, sun: 1e9, thick: 1e3, ..STAGE };
        let lean: f64 = rigid.pairs().iter().map(|p| p.working_pressure_angle().cos()).sum();
        let stiffness = lean * lean * 0.5 * MESH;
        for (sun, share) in [(1e9, 1.0), (1e-3, 3.0)] {
            let forces = |off: f64| -> Vec<f64> {
                let stage = Stage { off, sun, ..rigid };
                let (_, found) = stage.solve();
                stage.meshes(0).into_iter().map(|m| lean * found.meshes[m].normal_force).collect()
            };
            let (even, off) = (forces(0.0), forces(e));
            let mean = off.iter().sum::<f64>() / count as f64;
            assert!(even.iter().all(|f| (f / mean - 1.0).abs() < 1e-9), "{count} planets: {even:?}");
            let wanted = -stiffness * e * (1.0 - share / count as f64);
            let miss = (off[0] - mean - wanted).abs() / (stiffness * e);
            println!("{count} planets, sun {sun:e} N/mm: {:.2} beside {wanted:.2} N", off[0] - mean);
            assert!(off.iter().all(|f| *f > 0.0) && miss < 2e-3, "{count} planets: {off:?}, missed by {miss:e}");
        }
    }
}

/// K_gamma - 1 goes with 1/torque as long as all planets carry: a pin error takes a force, not a share. Exactly so of springs
/// on the ground, to 1e-9; of involutes on pins but for pressure angles, which follow the displacements of the axes in
/// proportion to the torque. The share of each is its force over the
/// sum, and a planet that carries nothing leaves N/(N - 1) and more to the others.
#[test]
fn the_load_sharing_factor_is_a_hyperbola_over_the_torque() {
    let over = |(carried, element): (Carried, Element), torque: f64, off: f64| {
        let stage = Stage { torque, off, carried, ..STAGE };
        let (_, found) = stage.solve_with(element);
        let sharing = [0, 1].map(|which| LoadSharing::of(std::slice::from_ref(&found), &stage.meshes(which)));
        let forces: Vec<f64> = stage.meshes(0).iter().map(|m| found.meshes[*m].normal_force).collect();
        (sharing, forces)
    };
    let (linear, exact): ((Carried, Element), (Carried, Element)) =
        ((Carried::Ground, springs), (Carried::Pins, involutes));
    let extra = |stage: (Carried, Element), torque: f64| {
        let ([sun, ring], forces) = over(stage, torque, 10e-3);
        let sum: f64 = forces.iter().sum();
        for (own, force) in sun.planets.iter().zip(&forces) {
            assert!((own.mean - force / sum).abs() < 1e-15 && own.least == own.largest, "{own:?}");
        }
        let [sun, ring] = [sun, ring].map(|own| own.factor.unwrap());
        assert!((sun / ring - 1.0).abs() < 1e-9, "{sun} and {ring}");
        sun - 1.0
    };
    let of = |stage: (Carried, Element)| [1.0, 2.0, 5.0].map(|times| times * extra(stage, times * TORQUE));
    let all = of(linear);
    println!("K_gamma - 1 times the torque, springs on the ground: {all:?}");
    assert!(all[0] > 0.02 && all.iter().all(|own| (own / all[0] - 1.0).abs() < 1e-9), "{all:?}");
    let all = of(exact);
    println!("K_gamma - 1 times the torque: {all:?}");
    assert!(all[0] > 0.02 && all.iter().all(|own| (own / all[0] - 1.0).abs() < 1e-3), "{all:?}");
    let [twice, five] = [1, 2].map(|i| all[i] - all[0]);
    assert!((five / twice / 4.0 - 1.0).abs() < 0.01, "{all:?}");
    let ([idle, _], forces) = over(exact, TORQUE, 1.0);
    assert!(forces[0] == 0.0 && idle.planets[0].mean == 0.0, "{forces:?}");
    assert!(idle.factor.unwrap() >= 1.5 - 1e-12, "{idle:?}");
    assert_eq!(LoadSharing::of(&[], &[0, 2]).factor, None);
}

/// Natural frequencies of Lin and Parker's stage (1999), a carrier at rest: rotational modes once, translational ones twice,
/// planet modes N - 3 times, to the printed digits. Axial and tilting motions are beyond; what holds the carrier's turn here,
/// and not there, is so soft that 0 Hz becomes 1.
#[test]
fn lin_and_parkers_stage_has_the_printed_frequencies() {
    let rotational = [[1475.7, 1930.3, 2658.3, 7462.8, 11775.3], [1536.5, 1970.6, 2625.7, 7773.6, 13071.1]];
    let translational =
        [[743.2, 1102.4, 1896.0, 2276.4, 6986.3, 9647.9], [727.3, 1091.2, 1892.8, 2342.5, 7189.9, 10437.6]];
    let of_planets = [vec![], vec![1808.2, 5963.8, 6981.7]];
    for (k, count) in [3, 4].into_iter().enumerate() {
        let mut wanted = [&rotational[k][..], &translational[k], &translational[k], &of_planets[k]].concat();
        wanted.sort_by(f64::total_cmp);
        let rest = Rotors::new(Assembly::new(lin_and_parker(count)).unwrap()).unwrap();
        let found: Vec<f64> = rest.modes_at_rest().frequencies.iter().map(|w| w / TAU).collect();
        println!("{count} planets: {:.2?}", &found[..=wanted.len()]);
        assert!(found[0] < 2.0 && found[wanted.len() + 1] > 1.5e4, "{found:?}");
        for (found, wanted) in found[1..].iter().zip(&wanted) {
            // Half a unit of the last digit.
            assert!((found - wanted).abs() < 0.051, "{count} planets: {found} beside {wanted} Hz");
        }
    }
}

/// Masses, I/r^2 (kg) and stiffnesses (N/m) of the paper; radii drop out.
pub fn lin_and_parker(count: usize) -> Structure {
    let (bearings_k, mesh_k, ring_turn, angle) = (1e5, 5e5, 1e6, 24.6f64.to_radians());
    // Base radii of sun, ring and planet, and the circle of the pins, mm.
    let [sun_r, ring_r, planet_r, arm] = [20.0, 80.0, 30.0, 50.0 / angle.cos()];
    let mut structure = Structure { standing: vec![2], ..Structure::default() };
    let mut body = |name: String, [x, y]: [f64; 2], [mass, inertia]: [f64; 2], radius: f64| {
        let shaft = structure.shafts.len();
        structure.shafts.push(Shaft {
            name: name.clone(),
            origin: [x, y, 0.0],
            pieces: Vec::new(),
            longest_element: 1.0,
        });
        let polar_inertia = 1e-3 * inertia * radius * radius;
        structure.discs.push(Disc {
            mass: 1e-3 * mass,
            diametral_inertia: 1.0,
            polar_inertia,
            ..Disc::seat(name, shaft, 0.0)
        });
        shaft
    };
    body("sun".into(), [0.0; 2], [0.4, 0.39], sun_r);
    body("ring".into(), [0.0; 2], [2.35, 3.0], ring_r);
    body("carrier".into(), [0.0; 2], [5.43, 6.29], arm);
    let psi = |n: usize| TAU * n as f64 / count as f64;
    for n in 0..count {
        body(format!("planet {n}"), [arm * psi(n).cos(), arm * psi(n).sin()], [0.66, 0.61], planet_r);
    }
    let held = |name: &str, shaft: usize, turn: f64| {
        Bearing::diagonal(name, shaft, 0.0, [bearings_k, bearings_k, 5e8, 1e11, 1e11, turn])
    };
    structure.bearings =
        vec![held("sun", 0, 0.0), held("ring", 1, ring_turn * ring_r * ring_r), held("carrier", 2, 1e3)];
    for n in 0..count {
        structure.bearings.push(held("planet", 3 + n, 0.0).in_shaft(2));
        let across = |x: f64, y: f64, turn: f64| Vector6::new(x, y, 0.0, 0.0, 0.0, turn);
        let ((sin, cos), (tilt_s, tilt_c)) = (psi(n).sin_cos(), angle.sin_cos());
        // Of zeta and eta.
        let planet = |zeta: f64, eta: f64, turn: f64| across(zeta * cos - eta * sin, zeta * sin + eta * cos, turn);
        let (at_sun, at_ring) = ((psi(n) - angle).sin_cos(), (psi(n) + angle).sin_cos());
        let meshes = [
            ("sun", 0, across(-at_sun.0, at_sun.1, sun_r), planet(-tilt_s, -tilt_c, planet_r)),
            ("ring", 1, across(-at_ring.0, at_ring.1, ring_r), planet(tilt_s, -tilt_c, -planet_r)),
        ];
        let spring = |(name, gear, own, of_planet): (&str, usize, Vector6<f64>, Vector6<f64>)| MeshSpring {
            name: name.into(),
            discs: [gear, 3 + n],
            levers: [own, of_planet],
            stiffness: mesh_k,
        };
        structure.springs.extend(meshes.into_iter().map(spring));
    }
    structure
}

/// What cannot be is told, with names and numbers.
#[test]
fn seats_that_cannot_be_are_refused() {
    let stage = Stage { carried: Carried::Pins, ..STAGE };
    let carrier = 2 + stage.count;
    let planet = "planet 0 10";
    let told = |change: &dyn Fn(&mut Structure, &mut Operation)| -> GearboxError {
        let (mut structure, meshes, mut run) = stage.parts();
        change(&mut structure, &mut run);
        let Err(error) = StaticGearbox::new(structure, meshes, run, involutes) else { panic!("taken") };
        assert!(error.hint().is_some_and(|hint| !hint.is_empty()), "{error}");
        error
    };
    let seat = |outer: usize| {
        move |s: &mut Structure| s.bearings.iter_mut().find(|b| b.name == planet).unwrap().outer = Some(outer)
    };
    let refused = [
        (told(&|s, _| seat(2)(s)), SeatError::Itself { bearing: planet.into(), shaft: "planet 0".into() }),
        (told(&|s, _| seat(1)(s)), SeatError::Turns { bearing: planet.into(), shaft: "ring".into(), arm_mm: ARM }),
        (
            told(&|s, _| {
                let turns = s.bearings.iter_mut().filter(|b| b.shaft == carrier || b.outer == Some(carrier));
                turns.for_each(|b| b.stiffness[(5, 5)] = 0.0);
            }),
            SeatError::Free { shaft: "carrier".into() },
        ),
        (told(&|s, _| s.discs[0].shaft = carrier), SeatError::Stands { part: "sun".into(), shaft: "carrier".into() }),
        (told(&|_, run| run.held = vec![carrier]), SeatError::Nothing { shaft: "carrier".into() }),
        (
            told(&|s, run| {
                s.bearings[0].outer = Some(1);
                run.held = vec![1];
            }),
            SeatError::Held { bearing: "sun 10".into(), shaft: "ring".into() },
        ),
    ];
    for (k, (found, wanted)) in refused.into_iter().enumerate() {
        let GearboxError::Seat(found) = found else { panic!("{k}: {found}") };
        assert_eq!(found, wanted);
    }
    let error = told(&|s, _| seat(99)(s));
    assert!(matches!(error, GearboxError::NoShaft { shaft: 99, .. }), "{error}");
    let error = told(&|s, _| s.shafts[carrier].origin[2] = -55.0);
    assert!(matches!(error, GearboxError::OffShaft { .. }), "{error}");
    let error = told(&|s, _| s.bearings[4].offset.x = f64::NAN);
    assert!(matches!(error, GearboxError::OutOfRange { .. }), "{error}");
}
