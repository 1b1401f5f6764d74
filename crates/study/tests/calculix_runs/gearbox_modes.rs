//! Natural frequencies of a box of one stage whose gears are elastic bodies, beside CalculiX.
//!
//! ```text
//! CalculiX: both gears whole, their contact; shafts as tubes; bores and the shafts' sections at gears, bearings and ends rigid
//! here:     modes of both gears, the rest of their compliance in the exact contact; shafts as beams
//! ```

use std::{f64::consts::TAU, fmt::Write, sync::Arc};

use fem::{
    ElementOptions, Integration, Material,
    beam::{BeamPiece, BeamSection},
};
use gearbox::{
    Bearing, Disc, ExactMesh, GearMesh, Held, MeshElement, MeshExcitation, Operation, Shaft, StaticGearbox, Structure,
    Torque, Train, Vibration, elastic_gears, own_cycle, turn_levers,
};
use geometry::{GearData, Sense, Side};
use ltca::StaticOptions;
use mesh::Extent;
use reduction::{ElasticGear, ModeChoice};
use study::calculix::{Body, Calculix};
use testing::{Case, quadratic};

/// N mm at the output.
const TORQUE: f64 = 6e4;
/// Place in the mesh cycle: two pairs carry.
const CYCLES: f64 = 0.1;
/// Frequencies that are compared.
const COUNT: usize = 10;
/// Modes of each gear up to here, Hz.
const KEPT_HZ: f64 = 30e3;
/// Inner diameter of the shafts, and length, mm; where input, bearings, gear and output are.
const HOLE: f64 = 8.0;
const LENGTH: f64 = 90.0;
const PLACES: [f64; 5] = [0.0, 12.0, 35.0, 78.0, LENGTH];
const GEAR: usize = 2;
const BEARINGS: [usize; 2] = [1, 3];
/// Stiffness of every bearing, N/mm and N mm: x, y, z and the tilts.
const STIFFNESS: [[f64; 6]; 2] = [[2e5, 1.5e5, 1e5, 1e7, 1e7, 0.0], [1.5e5, 2e5, 0.0, 1e7, 1e7, 0.0]];

/// A stage of 20 and 50 teeth, module 2.5 mm; the wheel is a disc of 6 mm.
fn stage() -> Case {
    let data = GearData { normal_module: 2.5, helix_angle: 0.0, ..GearData::default() };
    let pinion = GearData { teeth: 20, face_width: 6.0, bore_diameter: 22.0, ..data.clone() };
    let wheel = GearData { teeth: 50, face_width: 6.0, bore_diameter: 26.0, ..data };
    let mut case = quadratic([pinion, wheel], None, TORQUE, [3, 2, 2, 2, 2], Extent::Whole);
    case.elements = ElementOptions { integration: Integration::Full, ..ElementOptions::default() };
    case
}

fn structure(case: &Case) -> Structure {
    let gears = [&case.pair.pinion, &case.pair.wheel];
    let shaft = |i: usize, x: f64| {
        let section = BeamSection::new(gears[i].data().bore_diameter, HOLE, Material::STEEL).unwrap();
        let pieces = vec![BeamPiece { length: LENGTH, section }];
        Shaft { name: format!("shaft {i}"), origin: [x, 0.0, 0.0], pieces, longest_element: 4.0 }
    };
    let disc = |i: usize| {
        let own = fem::mass_properties(case.meshes[i].mesh(), &Material::STEEL).unwrap();
        let inertia = own.inertia_about_tmm2([0.0; 3]);
        let (mass, diametral_inertia) = (own.mass_t, 0.5 * (inertia[0][0] + inertia[1][1]));
        Disc {
            mass,
            diametral_inertia,
            polar_inertia: inertia[2][2],
            ..Disc::seat(format!("gear {i}"), i, PLACES[GEAR])
        }
    };
    let bearing = |i: usize, b: usize| Bearing::diagonal("bearing", i, PLACES[BEARINGS[b]], STIFFNESS[b]);
    Structure {
        shafts: vec![shaft(0, 0.0), shaft(1, case.pair.centre_distance())],
        discs: vec![disc(0), disc(1), Disc::seat("input", 0, PLACES[0]), Disc::seat("output", 1, LENGTH)],
        bearings: [[0, 0], [0, 1], [1, 0], [1, 1]].map(|[i, b]| bearing(i, b)).into(),
        ..Structure::default()
    }
}

/// First frequencies with elastic gears and with rigid ones, Hz, and the flanks that press.
fn own_frequencies(case: &Case) -> ([Vec<f64>; 2], Side) {
    let structure = structure(case);
    let meshes = vec![GearMesh { name: "stage".into(), discs: [0, 1], pair: case.pair.clone() }];
    let mut keys = vec![0.0; 4];
    let train = |keys: &[f64]| Train::new(&structure, &meshes, keys, 2, Sense::Ccw).unwrap();
    // One place of the cycle, where CalculiX has it.
    keys[0] = (CYCLES - train(&keys).cycles(0.0)[0]) * case.pair.pinion.pitch_angle();
    let train = train(&keys);
    let torques = vec![Torque { disc: 3, torque: TORQUE }];
    let run = Operation { input: 2, sense: Sense::Ccw, torques, keys, held: Vec::new() };
    let meshing = train.meshing()[0];
    let options = StaticOptions::new(TORQUE, &case.pair)
        .with_contact(|c| (c.driver, c.sense, c.slices) = (meshing.driver, meshing.sense, 32));
    let gears: Arc<[ElasticGear; 2]> = Arc::new(case.reduced_gears(&options));
    let choose = |reducer: &reduction::GearReducer| reducer.modes(ModeChoice::Below { hz: KEPT_HZ });
    let modes = elastic_gears(&structure, &meshes, std::slice::from_ref(&gears), choose).unwrap();
    let pair_modes = [0, 1].map(|disc| modes[disc].clone().unwrap());
    for (own, name) in pair_modes.iter().zip(["pinion", "wheel"]) {
        println!("{name}: {} modes, {:.0?} Hz", own.count(), &own.frequencies_hz()[..own.count().min(8)]);
    }
    let mut solved = StaticGearbox::new(structure.clone(), meshes.clone(), run.clone(), |_, mesh, _| {
        let exact = ExactMesh::new(mesh.pair.clone(), Arc::clone(&gears), options.clone())?;
        Ok(Box::new(exact.with_modes(pair_modes.clone())?) as Box<dyn MeshElement>)
    })
    .unwrap();
    let (samples, errors) = own_cycle(&mut solved, 0, 1, || {}).unwrap();
    assert!((samples[0].cycles - CYCLES).abs() < 1e-9, "{} cycles", samples[0].cycles);
    let turns = turn_levers(&meshes[0], &meshing).unwrap();
    let held = Held { shafts: Vec::new(), turns: vec![run.input] };
    let all = [true, false].map(|elastic| {
        let mut samples = samples.clone();
        if !elastic {
            samples[0].modal = None;
        }
        let excitation = MeshExcitation::new(&samples, &errors, 0, turns).unwrap();
        let own = if elastic { modes.clone() } else { Vec::new() };
        let parts = (&meshes[..], &train, run.sense);
        let box_ = Vibration::with_modes(structure.clone(), parts, vec![excitation], &own, &held).unwrap();
        let rest = &box_.rotors().modes_at_rest().frequencies;
        rest.iter().take(COUNT).map(|w| w / TAU).collect()
    });
    (all, meshing.side())
}

/// Cards, and the numbers that come next.
#[derive(Default)]
struct Cards {
    text: String,
    node: usize,
    element: usize,
}

impl Cards {
    fn line(&mut self, what: std::fmt::Arguments<'_>) {
        self.text.write_fmt(what).unwrap();
        self.text.push('\n');
    }

    /// A node that no element has.
    fn free_node(&mut self, [x, y, z]: [f64; 3]) -> usize {
        self.node += 1;
        let number = self.node;
        self.line(format_args!("*NODE\n{number}, {x:.12e}, {y:.12e}, {z:.12e}"));
        number
    }

    /// Two nodes that stand for displacement and turn of a rigid section about `at`; `nodes` follow them.
    fn rigid(&mut self, at: [f64; 3], nodes: &[(usize, [f64; 3])]) -> [usize; 2] {
        let [shift, turn] = [self.free_node(at), self.free_node(at)];
        self.follow([shift, turn], at, nodes);
        [shift, turn]
    }

    /// u = shift + turn x r.
    fn follow(&mut self, [shift, turn]: [usize; 2], at: [f64; 3], nodes: &[(usize, [f64; 3])]) {
        for (node, place) in nodes {
            let r: [f64; 3] = std::array::from_fn(|k| place[k] - at[k]);
            for axis in 0..3 {
                let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
                let terms = [(turn, next, -r[last]), (turn, last, r[next])];
                let terms: Vec<_> = terms.into_iter().filter(|t| t.2.abs() > 1e-9).collect();
                self.line(format_args!("*EQUATION\n{}", 2 + terms.len()));
                let mut card = format!("{node}, {0}, 1., {shift}, {0}, -1.", axis + 1);
                for (turn, about, arm) in terms {
                    write!(card, ", {turn}, {}, {arm:.12e}", about + 1).unwrap();
                }
                self.line(format_args!("{card}"));
            }
        }
    }

    /// A spring between a direction of a node and the ground.
    fn spring(&mut self, node: usize, axis: usize, stiffness: f64) {
        self.element += 1;
        let number = self.element;
        self.line(format_args!("*ELEMENT, TYPE=SPRING1, ELSET=spring_{number}\n{number}, {node}"));
        self.line(format_args!("*SPRING, ELSET=spring_{number}\n{}\n{stiffness:.12e}", axis + 1));
    }

    /// A tube along z of quadratic bricks; nodes of the sections at `PLACES`.
    fn tube(&mut self, name: &str, x: f64, radii: [f64; 2]) -> Vec<Vec<(usize, [f64; 3])>> {
        const AROUND: usize = 12;
        const ACROSS: usize = 2;
        let mut heights = vec![0.0];
        let mut levels = vec![0];
        for ends in PLACES.windows(2) {
            let steps = 2 * ((ends[1] - ends[0]) / 5.0).ceil() as usize;
            heights.extend((1..=steps).map(|i| ends[0] + (ends[1] - ends[0]) * i as f64 / steps as f64));
            levels.push(heights.len() - 1);
        }
        let mut numbers = std::collections::BTreeMap::new();
        let mut sections = vec![Vec::new(); PLACES.len()];
        for (k, z) in heights.iter().enumerate() {
            for (i, j) in (0..2 * AROUND).flat_map(|i| (0..=2 * ACROSS).map(move |j| (i, j))) {
                if i % 2 + j % 2 + k % 2 > 1 {
                    continue;
                }
                let radius = radii[0] + (radii[1] - radii[0]) * j as f64 / (2 * ACROSS) as f64;
                let (sin, cos) = (TAU * i as f64 / (2 * AROUND) as f64).sin_cos();
                let place = [x + radius * cos, radius * sin, z - PLACES[GEAR]];
                let number = self.free_node(place);
                numbers.insert((i, j, k), number);
                if let Some(section) = levels.iter().position(|level| *level == k) {
                    sections[section].push((number, place));
                }
            }
        }
        self.line(format_args!("*ELEMENT, TYPE=C3D20, ELSET={name}"));
        for k in (0..heights.len() - 1).step_by(2) {
            for (i, j) in (0..AROUND).flat_map(|i| (0..ACROSS).map(move |j| (2 * i, 2 * j))) {
                let at = |[a, b, c]: [usize; 3]| numbers[&((i + a) % (2 * AROUND), j + b, k + c)].to_string();
                let ring = |c: usize| [[0, 0, c], [0, 2, c], [2, 2, c], [2, 0, c]];
                let edges = |c: usize| [[0, 1, c], [1, 2, c], [2, 1, c], [1, 0, c]];
                let nodes = [ring(0), ring(2), edges(0), edges(2), ring(1)].concat();
                let words: Vec<String> = nodes.into_iter().map(at).collect();
                self.element += 1;
                let number = self.element;
                self.line(format_args!("{number}, {},\n{}", words[..10].join(", "), words[10..].join(", ")));
            }
        }
        self.line(format_args!("*SOLID SECTION, ELSET={name}, MATERIAL=material_pinion"));
        sections
    }
}

/// The whole deck: contact under load, then frequencies about it.
fn deck(case: &Case, side: Side) -> String {
    let (pair, distance) = (&case.pair, case.pair.centre_distance());
    let angle = pair.middle_angle(side) + (CYCLES - 0.5) * pair.pinion.pitch_angle();
    let closing = 2e-3 / pair.wheel.base_radius();
    let angles = [angle, pair.wheel_angle(side, angle) + side.sign() * closing];
    let mut cards = Cards::default();
    let (mut turns, names) = (Vec::new(), ["pinion", "wheel"]);
    let mut bores = Vec::new();
    for i in 0..2 {
        let (meshed, centre) = (&case.meshes[i], [[0.0, 0.0], [distance, 0.0]][i]);
        let body = Body { gear: meshed, material: &Material::STEEL, angle: angles[i], centre };
        let first = [cards.node + 1, cards.element + 1];
        cards.text += &body.text(names[i], first).unwrap();
        for k in -1i64..=1 {
            let teeth = [k, -k][i].rem_euclid(i64::from(meshed.tooth_count())) as u32;
            cards.text +=
                &body.flank_text(&format!("{}_{}", names[i], k + 1), names[i], (teeth, side), first[1]).unwrap();
        }
        let (sin, cos) = angles[i].sin_cos();
        let place = |n: u32| {
            let [x, y, z] = meshed.mesh().nodes[n as usize];
            (first[0] + n as usize, [centre[0] + cos * x - sin * y, sin * x + cos * y, z])
        };
        bores.push(meshed.bore_nodes().iter().map(|n| place(*n)).collect::<Vec<_>>());
        cards.node += meshed.mesh().nodes.len();
        cards.element += meshed.mesh().element_count();
    }
    for (i, gear) in [&pair.pinion, &pair.wheel].into_iter().enumerate() {
        let x = [0.0, distance][i];
        let sections = cards.tube(&format!("shaft_{i}"), x, [HOLE, gear.data().bore_diameter].map(|d| 0.5 * d));
        for (section, nodes) in sections.iter().enumerate() {
            let at = [x, 0.0, PLACES[section] - PLACES[GEAR]];
            let own = cards.rigid(at, nodes);
            if section == GEAR {
                cards.follow(own, at, &bores[i]);
            }
            if let Some(b) = BEARINGS.iter().position(|place| *place == section) {
                let springs = STIFFNESS[b].iter().enumerate().filter(|(_, k)| **k > 0.0);
                springs.for_each(|(axis, k)| cards.spring(own[axis / 3], axis % 3, *k));
            }
            if section == [0, PLACES.len() - 1][i] {
                turns.push(own[1]);
            }
        }
    }
    cards.line(format_args!("*SURFACE INTERACTION, NAME=flanks"));
    cards.line(format_args!("*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n1e7"));
    for k in 0..3 {
        cards.line(format_args!("*CONTACT PAIR, INTERACTION=flanks, TYPE=SURFACE TO SURFACE\npinion_{k}, wheel_{k}"));
    }
    cards.line(format_args!("*BOUNDARY\n{}, 3, 3", turns[0]));
    cards.line(format_args!("*STEP, INC=100\n*STATIC\n1., 1."));
    cards.line(format_args!("*CLOAD\n{}, 3, {:.12e}", turns[1], side.sign() * TORQUE));
    cards.line(format_args!("*END STEP\n*STEP, PERTURBATION\n*FREQUENCY\n{}\n*END STEP", COUNT + 2));
    cards.text
}

/// Frequencies in cycles per time of a `.dat` file, the lowest ones.
fn frequencies(print: &str) -> Vec<f64> {
    let (_, table) = print.split_once("E I G E N V A L U E   O U T P U T").unwrap_or_default();
    let row = |line: &str| {
        let words: Vec<f64> = line.split_whitespace().map_while(|w| w.parse().ok()).collect();
        (words.len() == 5).then(|| words[3])
    };
    table.lines().filter_map(row).take(COUNT).collect()
}

/// The first ten frequencies within 2 %, where rigid gears are off by more than a twentieth in some.
pub fn elastic_gears_in_a_box(calculix: Calculix) {
    let case = stage();
    let ([elastic, rigid], side) = own_frequencies(&case);
    let folder = tempfile::tempdir().unwrap();
    let (print, _, said) = calculix.solve(&deck(&case, side), folder.path()).unwrap_or_else(|e| panic!("{e}"));
    let wanted = frequencies(&print);
    assert_eq!(wanted.len(), COUNT, "{said}\n{print}");
    let mut worst = 0.0f64;
    for (i, other) in wanted.iter().enumerate() {
        let off = [&elastic, &rigid].map(|own| own[i] / other - 1.0);
        println!(
            "mode {}: {:.1} Hz, CalculiX {other:.1} Hz, {:+.2} %; rigid gears {:.1} Hz, {:+.1} %",
            i + 1,
            elastic[i],
            100.0 * off[0],
            rigid[i],
            100.0 * off[1]
        );
        worst = worst.max(off[0].abs());
    }
    assert!(worst < 0.02, "off by {:.2} %", 100.0 * worst);
}
