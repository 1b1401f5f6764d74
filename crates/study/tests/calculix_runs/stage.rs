//! A position of a planetary stage beside one CalculiX model of sun, planets and ring on the same meshes.
//!
//! ```text
//! CalculiX: all bodies; the mean motion of each bore on its bearing; a spring in place of each pressed pair of teeth:
//!           u = - sum f . (u_1 + u_2)/F along the forces of its slices,   F = k u,   k = F/(sum of slices F_i a_i/F)
//! ```
//! a_i: what a slice gives way beside the matrices of the gears ([`gearbox::SliceForces::approach`]). Springs have the
//! stiffness of the contact, not its forces: these, the sharing, places and turns are found by CalculiX.

use std::{
    collections::{BTreeMap, BTreeSet},
    f64::consts::TAU,
    fmt::Write,
    sync::Arc,
};

use fem::{ElementOptions, Integration, Material};
use gearbox::{
    Bearing, Disc, ExactMesh, FlankForces, GearMesh, GearboxPosition, MeshElement, MeshOfGears, Operation, Shaft,
    StaticGearbox, Structure, Torque,
};
use geometry::{Gear, GearData, GearPair, Sense};
use ltca::StaticOptions;
use mesh::{BoreCoupling, Extent, Mesh, MeshedGear};
use nalgebra::{Matrix3x6, Matrix6, Matrix6x3, Rotation2, Vector2, Vector3, Vector6};
use reduction::ElasticGear;
use study::calculix::{Body, Calculix};
use testing::{Case, quadratic};

/// Planets mesh one after the other: 19 is no multiple of 3.
const TEETH: [u32; 3] = [19, 17, 53];
const PLANETS: usize = 3;
/// N mm at the ring.
const TORQUE: f64 = 1e5;
/// N/mm, N mm/rad; no turn.
const BEARING: [f64; 6] = [5e5, 5e5, 1e5, 1e8, 1e8, 0.0];
/// How far the pin of the first planet stands ahead along the circle, mm.
const PIN: f64 = 2e-3;
/// What holds the turn of the sun in CalculiX in place of a support, N mm/rad.
const HELD: f64 = 1e13;

/// Bodies: sun, planets, ring.
const RING: usize = 1 + PLANETS;

fn pairs() -> [GearPair; 2] {
    let gear = |teeth: u32, bore_diameter: f64| GearData {
        teeth,
        bore_diameter,
        face_width: 12.0,
        helix_angle: 0.0,
        ..GearData::default()
    };
    let ring = GearData { addendum_coefficient: 0.8, ..gear(TEETH[2], -186.0) }.with_usual_shaper(0.0);
    let [sun, planet, ring] = [gear(TEETH[0], 28.0), gear(TEETH[1], 24.0), ring].map(|data| Gear::new(data).unwrap());
    [GearPair::new(sun, planet.clone(), None).unwrap(), GearPair::new(planet, ring, None).unwrap()]
}

/// Rigid shafts in the frame of the carrier: sun in, ring out.
fn parts() -> (Structure, Vec<GearMesh>, Operation) {
    let pairs = pairs();
    let arm = pairs[0].centre_distance();
    let psi = |n: usize| TAU * n as f64 / PLANETS as f64;
    let shaft =
        |name: String, [x, y]: [f64; 2]| Shaft { name, origin: [x, y, 0.0], pieces: Vec::new(), longest_element: 1.0 };
    let mut structure = Structure::default();
    structure.shafts.push(shaft("sun".into(), [0.0; 2]));
    structure
        .shafts
        .extend((0..PLANETS).map(|n| shaft(format!("planet {n}"), [psi(n).cos(), psi(n).sin()].map(|x| arm * x))));
    structure.shafts.push(shaft("ring".into(), [0.0; 2]));
    structure.discs =
        structure.shafts.iter().enumerate().map(|(i, own)| Disc::seat(own.name.clone(), i, 0.0)).collect();
    structure.discs.extend([Disc::seat("input", 0, 0.0), Disc::seat("output", RING, 0.0)]);
    let bearing = |(i, own): (usize, &Shaft)| Bearing::diagonal(own.name.clone(), i, 0.0, BEARING);
    structure.bearings = structure.shafts.iter().enumerate().map(bearing).collect();
    structure.bearings[1].offset = Vector3::new(0.0, PIN, 0.0);
    let mesh =
        |discs: [usize; 2], which: usize| GearMesh { name: format!("{discs:?}"), discs, pair: pairs[which].clone() };
    let meshes = (1..=PLANETS).flat_map(|n| [mesh([0, n], 0), mesh([n, RING], 1)]).collect();
    // The ring turns with the planets, against the sun.
    let torques = vec![Torque { disc: RING + 2, torque: TORQUE }];
    let keys = vec![0.0; structure.discs.len()];
    (structure, meshes, Operation { input: RING + 1, sense: Sense::Ccw, torques, keys, held: Vec::new() })
}

/// What the program finds.
struct Own {
    structure: Structure,
    found: GearboxPosition,
    /// Meshes of the bodies.
    gears: [MeshedGear; 3],
    flanks: Vec<[FlankForces; 2]>,
}

/// With meshes that hear each other through the bodies of their gears, or each alone on them.
fn own(joined: bool) -> Own {
    let (structure, meshes, run) = parts();
    let mut kept: [Option<(Arc<[ElasticGear; 2]>, MeshOfGears)>; 2] = [None, None];
    let made = StaticGearbox::new(structure.clone(), meshes, run, |i, mesh, meshing| {
        let options = StaticOptions::new(TORQUE / PLANETS as f64, &mesh.pair)
            .with_contact(|c| (c.driver, c.sense, c.slices) = (meshing.driver, meshing.sense, 12));
        let known = kept[i % 2].take();
        let gears = known.as_ref().map_or_else(|| reduced(&mesh.pair, &options), |known| Arc::clone(&known.0));
        let own =
            ExactMesh::beside(known.as_ref().map(|known| &known.1), mesh.pair.clone(), Arc::clone(&gears), options)?;
        kept[i % 2] = Some((gears, own.of_gears()));
        Ok(Box::new(own) as Box<dyn MeshElement>)
    });
    let made = made.unwrap_or_else(|e| panic!("{e}"));
    let mut gearbox = if joined { made.joined() } else { made };
    let found = gearbox.solve(0.02).unwrap_or_else(|e| panic!("{e}"));
    let flanks = (0..2 * PLANETS).map(|mesh| gearbox.flank_forces(mesh).unwrap()).collect();
    let mesh = |which: usize, end: usize| match &kept[which].as_ref().unwrap().0[end] {
        ElasticGear::Reduced(reducer) => reducer.gear().clone(),
        ElasticGear::Full(_) => panic!("gears are reduced"),
    };
    let gears = [mesh(0, 0), mesh(0, 1), mesh(1, 1)];
    Own { structure, found, gears, flanks }
}

/// Both gears of a pair; bores are held by their means.
fn reduced(pair: &GearPair, options: &StaticOptions) -> Arc<[ElasticGear; 2]> {
    let data = [&pair.pinion, &pair.wheel].map(|gear| gear.data().clone());
    let mut case: Case = quadratic(data, None, TORQUE, [2, 2, 2, 1, 2], Extent::Whole);
    case.elements = ElementOptions { integration: Integration::Full, ..ElementOptions::default() };
    case.meshes = case.meshes.map(|gear| gear.coupled(BoreCoupling::Distributing));
    Arc::new(case.reduced_gears(options))
}

/// A spring in place of a pressed pair of teeth.
struct PairSpring {
    /// Its name: mesh and pair of teeth.
    pair: [usize; 2],
    /// N and N/mm.
    force: f64,
    stiffness: f64,
    /// Body, node and force over that of the pair.
    nodes: Vec<(usize, usize, Vector3<f64>)>,
}

impl Own {
    fn body_gear(&self, body: usize) -> &MeshedGear {
        &self.gears[[0, 1, 2][usize::from(body > 0) + usize::from(body == RING)]]
    }

    /// Bodies of a mesh.
    fn bodies(mesh: usize) -> [usize; 2] {
        let planet = 1 + mesh / 2;
        [[0, planet], [planet, RING]][mesh % 2]
    }

    /// Angle of the frame of a body, in which it stands in the deck, rad.
    fn angle(&self, body: usize) -> f64 {
        let found = (0..self.flanks.len()).find_map(|mesh| {
            let end = Self::bodies(mesh).iter().position(|own| *own == body)?;
            Some(self.flanks[mesh][end].angle)
        });
        found.unwrap()
    }

    fn springs(&self) -> Vec<PairSpring> {
        let (mut all, mut worst) = (Vec::new(), 0.0f64);
        for (mesh, flanks) in self.flanks.iter().enumerate() {
            let pairs: BTreeSet<usize> = flanks[0].slices.iter().map(|own| own.pair).collect();
            for pair in pairs {
                let of_pair = |end: usize| flanks[end].slices.iter().filter(move |own| own.pair == pair);
                let force: f64 = of_pair(0).map(|own| own.force).sum();
                let approach = of_pair(0).map(|own| own.force * own.approach).sum::<f64>() / force;
                let mut nodes = Vec::new();
                for (end, body) in Self::bodies(mesh).into_iter().enumerate() {
                    let gear = self.body_gear(body).mesh();
                    let turn = Rotation2::new(flanks[end].angle - self.angle(body));
                    let first = nodes.len();
                    for (node, [fx, fy, fz]) in of_pair(end).flat_map(|own| &own.nodes) {
                        let [x, y, z] = gear.nodes[*node as usize];
                        let (x, f) = (turn * Vector2::new(x, y), turn * Vector2::new(*fx, *fy));
                        let at = node_at(&gear.nodes, Vector3::new(x.x, x.y, z));
                        nodes.push((body, at, Vector3::new(f.x, f.y, *fz) / force));
                    }
                    // Faces are not quite the flank: what is missing of the resultant acts as the mean of the bore does.
                    let mut missing = Vector6::zeros();
                    for own in of_pair(end) {
                        for at in [0, 3] {
                            let [x, y, z] = [0, 1, 2].map(|k| own.wrench[at + k] / force);
                            let across = turn * Vector2::new(x, y);
                            [across.x, across.y, z].into_iter().enumerate().for_each(|(k, w)| missing[at + k] += w);
                        }
                    }
                    for (_, node, f) in &nodes[first..] {
                        missing -= motions(gear, *node).tr_mul(f);
                    }
                    worst = worst.max(missing.fixed_rows::<3>(0).norm()).max(missing[5].abs() / self.radius(body));
                    let shares = mean_motion(self.body_gear(body));
                    nodes.extend(shares.iter().map(|(node, share)| (body, *node, share.tr_mul(&missing))));
                }
                all.push(PairSpring { pair: [mesh, pair], force, stiffness: force / approach, nodes });
            }
        }
        println!("forces on nodes are off by {worst:.1e} of those on flanks");
        assert!(worst < 1e-2, "{worst}");
        all
    }

    /// Reference radius of a body, mm.
    fn radius(&self, body: usize) -> f64 {
        1.5 * f64::from(self.body_gear(body).tooth_count())
    }
}

fn node_at(nodes: &[[f64; 3]], x: Vector3<f64>) -> usize {
    let off = |n: &usize| (Vector3::from(nodes[*n]) - x).norm();
    let found = (0..nodes.len()).min_by(|a, b| off(a).total_cmp(&off(b))).unwrap();
    assert!(off(&found) < 1e-6, "no node at {x}");
    found
}

/// Displacements of a node by the six motions of a rigid body.
fn motions(mesh: &Mesh, node: usize) -> Matrix3x6<f64> {
    let mut all = Matrix3x6::identity();
    all.fixed_view_mut::<3, 3>(0, 3).copy_from(&-Vector3::from(mesh.nodes[node]).cross_matrix());
    all
}

/// Mean motion of a bore: node and shares in its six coordinates by those of the node.
fn mean_motion(gear: &MeshedGear) -> Vec<(usize, Matrix6x3<f64>)> {
    let motions = |n: u32| motions(gear.mesh(), n as usize);
    let weights = gear.bore_weights();
    let sum: Matrix6<f64> = weights.iter().map(|&(n, w)| w * motions(n).transpose() * motions(n)).sum();
    let inverse = sum.try_inverse().unwrap();
    weights.iter().map(|&(n, w)| (n as usize, w * inverse * motions(n).transpose())).collect()
}

/// Writes an equation: the displacement of a new node along its first axis is the sum of others.
fn equation(text: &mut String, node: usize, terms: &BTreeMap<(usize, usize), f64>) {
    let terms: Vec<_> = terms.iter().filter(|(_, share)| **share != 0.0).collect();
    writeln!(text, "*EQUATION\n{}\n{node}, 1, -1.", terms.len() + 1).unwrap();
    terms.iter().for_each(|((node, axis), share)| writeln!(text, "{node}, {axis}, {share:.12e}").unwrap());
}

/// The deck and the numbers of the first new nodes: one of each coordinate of each body, and one of each pair of teeth. They move
/// along their first axis alone: what CalculiX keeps of an equation goes with the axes that a node has.
fn deck(own: &Own, springs: &[PairSpring]) -> (String, [usize; 2]) {
    let mut text = String::new();
    let (mut first, mut next) = (Vec::new(), [1, 1]);
    for body in 0..=RING {
        let held = own.body_gear(body).clone().coupled(BoreCoupling::Kinematic);
        // Each stands in its own frame: they meet in equations alone.
        let gear = Body { gear: &held, material: &Material::STEEL, angle: 0.0, centre: [0.0, 0.0] };
        text += &gear.text(&format!("body{body}"), next).unwrap();
        first.push(next[0]);
        next = [next[0] + held.mesh().nodes.len(), next[1] + held.mesh().element_count()];
    }
    let [seats, mut element] = next;
    let pressed = seats + 6 * (RING + 1);
    writeln!(text, "*NODE, NSET=found").unwrap();
    (seats..pressed + springs.len()).for_each(|node| writeln!(text, "{node}, 0., 0., 0.").unwrap());
    let mut loads = String::new();
    let mut spring = |text: &mut String, node: usize, stiffness: f64| {
        writeln!(text, "*ELEMENT, TYPE=SPRING1, ELSET=spring{element}\n{element}, {node}").unwrap();
        writeln!(text, "*SPRING, ELSET=spring{element}\n1\n{stiffness:.12e}").unwrap();
        element += 1;
    };
    for (body, &from) in first.iter().enumerate() {
        let mean = mean_motion(own.body_gear(body));
        let mut stiffness = BEARING;
        if body == 0 {
            stiffness[5] = HELD;
        }
        for k in 0..6 {
            let terms = mean.iter().flat_map(|(n, shares)| (0..3).map(move |i| ((from + n, 1 + i), shares[(k, i)])));
            let at = seats + 6 * body + k;
            equation(&mut text, at, &terms.collect());
            if stiffness[k] > 0.0 {
                spring(&mut text, at, stiffness[k]);
            }
        }
        let offset = own.structure.bearings[body].offset;
        let off = Rotation2::new(-own.angle(body)) * Vector2::new(offset.x, offset.y);
        for (k, load) in [BEARING[0] * off.x, BEARING[1] * off.y].into_iter().enumerate().filter(|own| own.1 != 0.0) {
            writeln!(loads, "{}, 1, {load:.12e}", seats + 6 * body + k).unwrap();
        }
    }
    writeln!(loads, "{}, 1, {TORQUE:.12e}", seats + 6 * RING + 5).unwrap();
    for (k, own) in springs.iter().enumerate() {
        let mut terms = BTreeMap::new();
        for (body, node, share) in &own.nodes {
            (0..3).for_each(|i| *terms.entry((first[*body] + node, 1 + i)).or_default() -= share[i]);
        }
        equation(&mut text, pressed + k, &terms);
        spring(&mut text, pressed + k, own.stiffness);
    }
    writeln!(text, "*BOUNDARY").unwrap();
    writeln!(text, "found, 2, 3").unwrap();
    writeln!(text, "*STEP\n*STATIC\n*CLOAD\n{loads}*NODE PRINT, NSET=found\nU\n*END STEP").unwrap();
    (text, [seats, pressed])
}

/// Displacements by node of all tables of a print.
fn displacements(print: &str) -> BTreeMap<usize, [f64; 3]> {
    let row = |line: &str| {
        let words: Vec<&str> = line.split_whitespace().collect();
        let [node, x, y, z] = words[..] else { return None };
        Some((node.parse().ok()?, [x.parse().ok()?, y.parse().ok()?, z.parse().ok()?]))
    };
    print.lines().filter_map(row).collect()
}

/// Forces of all pairs of teeth and how planets share the load, displacements of the bores, and the lag of the ring within
/// 0.1 %. Each mesh alone on the bodies of its gears is off by more than that.
pub fn agrees_on_a_stage(calculix: Calculix) {
    let own = own(true);
    let springs = own.springs();
    let (text, [seats, pressed]) = deck(&own, &springs);
    let folder = tempfile::tempdir().unwrap();
    let (print, memory, said) = calculix.solve(&text, folder.path()).unwrap_or_else(|e| panic!("{e}"));
    let moved = displacements(&print);
    assert!(moved.len() == 6 * (RING + 1) + springs.len(), "{said}");
    println!("CalculiX took {memory:.0?} MB");
    let largest = springs.iter().map(|own| own.force).fold(0.0, f64::max);
    let mut of_forces = 0.0f64;
    let mut of_meshes = vec![[0.0; 2]; own.flanks.len()];
    for (k, spring) in springs.iter().enumerate() {
        let theirs = spring.stiffness * moved[&(pressed + k)][0];
        of_forces = of_forces.max((spring.force - theirs).abs() / largest);
        let [mesh, pair] = spring.pair;
        println!(
            "mesh {mesh}, pair {pair}: {:.2} N, CalculiX {theirs:.2} N; {:.4e} N/mm",
            spring.force, spring.stiffness
        );
        of_meshes[mesh][0] += spring.force;
        of_meshes[mesh][1] += theirs;
    }
    let sharing = |which: usize, whose: usize| -> Vec<f64> {
        let forces: Vec<f64> = (0..PLANETS).map(|n| of_meshes[2 * n + which][whose]).collect();
        let sum: f64 = forces.iter().sum();
        forces.iter().map(|f| PLANETS as f64 * f / sum).collect()
    };
    let mut of_sharing = 0.0f64;
    for which in 0..2 {
        let [ours, theirs] = [0, 1].map(|whose| sharing(which, whose));
        println!("shares of planets {ours:.5?}, CalculiX {theirs:.5?}");
        of_sharing = ours.iter().zip(&theirs).map(|(a, b)| (a - b).abs()).fold(of_sharing, f64::max);
    }
    let (mut of_places, mut farthest) = (0.0f64, 0.0f64);
    for body in 0..=RING {
        let [x, y, ..] = own.found.shafts[body].displacements[0];
        let [tx, ty] = [0, 1].map(|k| moved[&(seats + 6 * body + k)][0]);
        let theirs = Rotation2::new(own.angle(body)) * Vector2::new(tx, ty);
        println!("body {body}: {x:.6} {y:.6} mm, CalculiX {:.6} {:.6} mm", theirs.x, theirs.y);
        of_places = of_places.max((theirs - Vector2::new(x, y)).norm());
        farthest = farthest.max(x.hypot(y));
    }
    let turn = |body: usize| moved[&(seats + 6 * body + 5)][0];
    let lag = own.found.output_lags[0];
    let theirs = turn(RING) - turn(0) * f64::from(TEETH[0]) / f64::from(TEETH[2]);
    println!("lag {lag:.6e} rad, CalculiX {theirs:.6e} rad");
    let all = [of_forces, of_sharing, of_places / farthest, (lag.abs() / theirs.abs() - 1.0).abs()];
    println!("off: forces of pairs {:.1e}, shares {:.1e}, places {:.1e}, lag {:.1e}", all[0], all[1], all[2], all[3]);
    assert!(all.iter().all(|off| *off < 1e-3), "{all:?}");
    let alone = self::own(false);
    let of_lag = (alone.found.output_lags[0].abs() / theirs.abs() - 1.0).abs();
    let pairs =
        alone.springs().iter().zip(&springs).map(|(a, b)| (a.force - b.force).abs() / largest).fold(0.0, f64::max);
    println!("each mesh alone on the bodies: forces off by {pairs:.1e}, lag by {of_lag:.1e}");
    assert!(pairs.max(of_lag) > 1e-3, "{pairs}, {of_lag}");
}
