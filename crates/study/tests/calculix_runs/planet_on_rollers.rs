//! A gear between two meshes on its rollers, beside CalculiX on the same mesh.
//!
//! ```text
//! here:     one contact problem of both meshes and the rollers, by the matrices of the gear
//! CalculiX: the free gear under these forces; how its flanks move, and how rollers would press on its bore, is compared
//! ```

use std::{collections::BTreeMap, f64::consts::TAU, fmt::Write, sync::Arc};

use fem::{ElementOptions, Integration, Material};
use gearbox::{
    Bearing, Disc, ExactMesh, FlankForces, GearMesh, MeshElement, Operation, RollersOnBore, Shaft, StaticGearbox,
    Structure, Torque,
    rolling_bearing::{AxialSetting, RollerGeometry, RollerProfile, RollingBearing, RollingElements, Row},
};
use geometry::{Gear, GearData, GearPair, Sense};
use ltca::StaticOptions;
use mesh::{BoreCoupling, Extent, MeshedGear};
use nalgebra::{Matrix3x6, Matrix6, Rotation2, Vector2, Vector3, Vector6};
use reduction::{ElasticGear, GearReducer, Window};
use study::calculix::{Body, Calculix};
use testing::{Case, quadratic};

/// N mm at the output.
const TORQUE: f64 = 3e5;
const TEETH: [u32; 3] = [18, 24, 21];
/// Bore of the gear between, diameter and length of its rollers, mm, and their number.
const BORE: f64 = 52.0;
const ROLLER: f64 = 7.0;
const LENGTH: f64 = 12.0;
const ROLLERS: usize = 14;
/// Radial play, mm.
const PLAY: f64 = 0.015;
/// c of a contact of L mm with both rings, q = c L^(8/9) delta^(10/9), ISO/TS 16281, N/mm^2, and laminae of a roller.
const LINE: f64 = 35_948.0;
const LAMINAE: f64 = 41.0;

fn pairs() -> [GearPair; 2] {
    let gear = |i: usize| {
        let bore_diameter = if i == 1 { BORE } else { 0.5 * 3.0 * f64::from(TEETH[i]) };
        let own =
            GearData { teeth: TEETH[i], bore_diameter, face_width: 15.0, helix_angle: 0.0, ..GearData::default() };
        Gear::new(own).unwrap()
    };
    [[0, 1], [1, 2]].map(|[a, b]| GearPair::new(gear(a), gear(b), None).unwrap())
}

fn law() -> RollingBearing {
    let (contact_angle, profile) = (0.0, RollerProfile::Straight);
    let (diameter, pitch_diameter) = (ROLLER, BORE - ROLLER);
    let own = RollerGeometry { elements: ROLLERS, diameter, length: LENGTH, pitch_diameter, contact_angle, profile };
    let row = [Row { position: 0.0, thrust: 1.0 }];
    RollingBearing::new(RollingElements::Rollers(own), &row, PLAY, AxialSetting::Clearance(0.0)).unwrap()
}

/// The gear between on rollers about a pin that stands; the others are held.
fn parts() -> (Structure, Vec<GearMesh>, Operation) {
    let pairs = pairs();
    let [a, b] = [0, 1].map(|i| pairs[i].centre_distance());
    let at = [[0.0, 0.0], [a, 0.0], [a + b * 1.1f64.cos(), b * 1.1f64.sin()]];
    let shaft = |i: usize| Shaft {
        name: format!("shaft {i}"),
        origin: [at[i][0], at[i][1], 0.0],
        pieces: Vec::new(),
        longest_element: 1.0,
    };
    let seat = |name: &str, shaft: usize| Disc::seat(name, shaft, 0.0);
    let structure = Structure {
        shafts: (0..3).map(shaft).collect(),
        discs: vec![seat("pinion", 0), seat("gear", 1), seat("wheel", 2), seat("input", 0), seat("output", 2)],
        bearings: vec![
            Bearing::rolling("rollers", 1, 0.0, law()).in_bore_of(1),
            Bearing::diagonal("thrust", 1, 0.0, [0.0, 0.0, 1e5, 0.0, 0.0, 0.0]),
        ],
        ..Structure::default()
    };
    let torques = vec![Torque { disc: 4, torque: -TORQUE }];
    let run = Operation { input: 3, sense: Sense::Ccw, torques, keys: vec![0.0; 5], held: vec![0, 2] };
    let mesh = |(discs, pair): ([usize; 2], GearPair)| GearMesh { name: format!("{discs:?}"), discs, pair };
    (structure, [[0, 1], [1, 2]].into_iter().zip(pairs).map(mesh).collect(), run)
}

/// Entries of a matrix.
type Entries<'a> = &'a dyn Fn(usize, usize) -> f64;

/// What the program finds.
struct Own {
    gear: MeshedGear,
    rollers: RollersOnBore,
    flanks: [FlankForces; 2],
    /// Displacement of the gear's bore in the mean: x, y, and turns about them.
    moved: [f64; 4],
    /// Forces of the rollers, N.
    zone: Vec<f64>,
    /// Displacement of both flanks along the forces on them, in the mean over these, mm.
    flank_displacements: [f64; 2],
}

fn own() -> Own {
    let (structure, meshes, run) = parts();
    let mut kept = Vec::new();
    let made = StaticGearbox::new(structure, meshes, run, |i, mesh, meshing| {
        let options = StaticOptions::new(TORQUE, &mesh.pair)
            .with_contact(|c| (c.driver, c.sense, c.slices) = (meshing.driver, meshing.sense, 16));
        let data = [&mesh.pair.pinion, &mesh.pair.wheel].map(|gear| gear.data().clone());
        let mut case: Case = quadratic(data, None, TORQUE, [2, 2, 2, 3, 2], Extent::Whole);
        case.elements = ElementOptions { integration: Integration::Full, ..ElementOptions::default() };
        case.meshes[1 - i] = case.meshes[1 - i].clone().coupled(BoreCoupling::Distributing);
        let gears: Arc<[ElasticGear; 2]> = Arc::new(case.reduced_gears(&options));
        kept.push(Arc::clone(&gears));
        Ok(Box::new(ExactMesh::new(mesh.pair.clone(), gears, options)?) as Box<dyn MeshElement>)
    });
    let mut gearbox = made.unwrap_or_else(|e| panic!("{e}")).joined();
    let found = gearbox.solve(0.05).unwrap_or_else(|e| panic!("{e}"));
    let rollers = gearbox.rollers_on_bore(0).unwrap();
    let flanks = [0, 1].map(|mesh| gearbox.flank_forces(mesh).unwrap()[1 - mesh].clone());
    let reducers = [0, 1].map(|mesh| match &kept[mesh][1 - mesh] {
        ElasticGear::Reduced(reducer) => reducer,
        ElasticGear::Full(_) => panic!("gears are reduced"),
    });
    let state = found.rolling[0].unwrap();
    let moved = [0, 1, 3, 4].map(|k| state.displacement[k]);
    let zone = law().zone_of(&found.laminae[0]).iter().map(|own| own.force).collect();
    let flank_displacements = displacements(reducers, &rollers, &flanks, moved);
    Own { gear: reducers[0].gear().clone(), rollers, flanks, moved, zone, flank_displacements }
}

/// Displacements of both flanks along their forces by the matrices of the gear.
fn displacements(
    reducers: [&GearReducer; 2],
    rollers: &RollersOnBore,
    flanks: &[FlankForces; 2],
    moved: [f64; 4],
) -> [f64; 2] {
    let pitch = TAU / f64::from(TEETH[1]);
    // Windows in the axes of the rollers' frame.
    let windows = [0, 1].map(|i| {
        let own = reducers[i].window(0).unwrap();
        let base = Window { shift: 0, ..own };
        let apart = ((flanks[i].angle - rollers.angle) / pitch).round();
        assert!((flanks[i].angle - rollers.angle - apart * pitch).abs() < 1e-9);
        Window { shift: (apart as i64).rem_euclid(i64::from(TEETH[1])) as u32, ..base }
    });
    let forces = [0, 1].map(|i| {
        let mut all = vec![0.0; windows[i].reduced.coordinates()];
        for (node, force) in flanks[i].by_node() {
            let at = 3 * windows[i].reduced.position(node).unwrap();
            all[at..at + 3].copy_from_slice(&force);
        }
        all
    });
    let mut pressed = vec![0.0; rollers.grid.count()];
    for (force, shares) in rollers.forces.iter().zip(&rollers.shares) {
        for (q, share) in shares {
            rollers.prints[*q].iter().for_each(|(g, part)| pressed[*g] += force * share * part);
        }
    }
    [0, 1].map(|i| {
        let mut moves = vec![0.0; forces[i].len()];
        let mut add = |matrix: Entries<'_>, by: &[f64]| {
            for (row, sum) in moves.iter_mut().enumerate() {
                *sum += (0..by.len()).map(|j| matrix(row, j) * by[j]).sum::<f64>();
            }
        };
        let own = windows[i].reduced.compliance();
        add(&|r, c| own[(r, c)], &forces[i]);
        let other = 1 - i;
        let between = reducers[i].compliance_between(&windows[i], (reducers[other], &windows[other])).unwrap();
        add(&|r, c| between[(r, c)], &forces[other]);
        let bore = reducers[i].flanks_under_bore(&windows[i], &rollers.grid).unwrap();
        add(&|r, c| bore[(r, c)], &pressed);
        let size = forces[i].chunks(3).map(Vector3::from_column_slice).sum::<Vector3<f64>>().norm();
        let elastic: f64 = forces[i].iter().zip(&moves).map(|(f, u)| f * u).sum();
        let turn = Rotation2::new(flanks[i].angle);
        let mesh = reducers[i].gear().mesh();
        let rigid: f64 = flanks[i]
            .by_node()
            .into_iter()
            .map(|(node, [fx, fy, fz])| {
                let [x, y, z] = mesh.nodes[node as usize];
                let (x, f) = (turn * Vector2::new(x, y), turn * Vector2::new(fx, fy));
                let [ux, uy, about_x, about_y] = moved;
                f.x * (ux + about_y * z) + f.y * (uy - about_x * z) + fz * (about_x * x.y - about_y * x.x)
            })
            .sum();
        (elastic + rigid) / size
    })
}

/// The free gear under the forces of both meshes and of its rollers, which are in balance: six freedoms hold it without force.
fn deck(own: &Own) -> String {
    let mesh = own.gear.mesh();
    let held = own.gear.clone().coupled(BoreCoupling::Kinematic);
    let body = Body { gear: &held, material: &Material::STEEL, angle: 0.0, centre: [0.0, 0.0] };
    let mut text = body.text("gear", [1, 1]).unwrap();
    let near = |x: f64, y: f64| {
        let off = |n: &&u32| (Vector3::from(mesh.nodes[**n as usize]) - Vector3::new(x, y, 0.0)).norm();
        held.bore_nodes().iter().min_by(|a, b| off(a).total_cmp(&off(b))).unwrap() + 1
    };
    let [a, b, c] = [(0.5, 0.0), (-0.5, 0.0), (0.0, 0.5)].map(|(x, y)| near(x * BORE, y * BORE));
    writeln!(text, "*BOUNDARY\n{a}, 1, 3\n{b}, 2, 3\n{c}, 3, 3").unwrap();
    let mut sums: BTreeMap<usize, [f64; 3]> = BTreeMap::new();
    let all: Vec<(usize, [f64; 3])> = loads(own).into_iter().chain(by_rollers(own)).collect();
    let rest = balance(own, &all);
    for (node, force) in all.into_iter().chain(rest) {
        let sum = sums.entry(node).or_default();
        (0..3).for_each(|k| sum[k] += force[k]);
    }
    writeln!(text, "*STEP\n*STATIC\n*CLOAD").unwrap();
    for (node, force) in sums {
        (0..3).for_each(|k| writeln!(text, "{}, {}, {:.12e}", node + 1, k + 1, force[k]).unwrap());
    }
    writeln!(text, "*NODE PRINT, NSET=all_gear\nU\n*END STEP").unwrap();
    text
}

/// Forces of the rollers on the nodes of the bore.
fn by_rollers(own: &Own) -> Vec<(usize, [f64; 3])> {
    let rollers = &own.rollers;
    let mut all = Vec::new();
    for (lamina, shares) in rollers.forces.iter().zip(&rollers.shares).filter(|own| *own.0 > 0.0) {
        for (q, share) in shares {
            for (g, part) in &rollers.prints[*q] {
                let on = |(node, force): &(u32, [f64; 3])| (*node as usize, force.map(|f| lamina * share * part * f));
                all.extend(rollers.grid.loads[*g].iter().map(on));
            }
        }
    }
    all
}

/// Force of a lamina by its approach, N.
fn pressed(approach: f64) -> f64 {
    LINE * LENGTH.powf(8.0 / 9.0) / LAMINAE * approach.max(0.0).powf(10.0 / 9.0)
}

/// Displacements of a node by the motions of a rigid gear.
fn rigid_motions(own: &Own, node: usize) -> Matrix3x6<f64> {
    let mut all = Matrix3x6::identity();
    all.fixed_view_mut::<3, 3>(0, 3).copy_from(&-Vector3::from(own.gear.mesh().nodes[node]).cross_matrix());
    all
}

/// What is missing of the balance of forces on nodes, spread over the bore as its mean seat does: forces on the nodes of faces
/// have not quite the direction and the place of those on the flanks.
fn balance(own: &Own, forces: &[(usize, [f64; 3])]) -> Vec<(usize, [f64; 3])> {
    let resultant: Vector6<f64> =
        forces.iter().map(|(n, f)| rigid_motions(own, *n).transpose() * Vector3::from(*f)).sum();
    let size = own.zone.iter().sum::<f64>();
    println!("left over {resultant:.1?} N, N mm, rollers {size:.0} N");
    let (force, moment) = (resultant.fixed_rows::<3>(0).norm(), resultant.fixed_rows::<3>(3).norm());
    assert!(force < 3e-3 * size && moment < 3e-3 * size * BORE, "{resultant}");
    let weights = own.gear.bore_weights();
    let motions = |n: u32| rigid_motions(own, n as usize);
    let sum: Matrix6<f64> = weights.iter().map(|&(n, w)| w * motions(n).transpose() * motions(n)).sum();
    let shares = sum.lu().solve(&resultant).unwrap();
    weights.iter().map(|&(n, w)| (n as usize, (-w * motions(n) * shares).into())).collect()
}

/// Displacements of all nodes less the mean motion of the bore.
fn without_mean(own: &Own, moved: &BTreeMap<usize, [f64; 3]>) -> Vec<Vector3<f64>> {
    let mesh = own.gear.mesh();
    let motion = |n: usize| rigid_motions(own, n);
    let (mut sum, mut by) = (Matrix6::zeros(), Vector6::zeros());
    for (n, weight) in own.gear.bore_weights() {
        let motion = motion(n as usize);
        sum += weight * motion.transpose() * motion;
        by += weight * motion.transpose() * Vector3::from(moved[&(n as usize + 1)]);
    }
    let mean = sum.lu().solve(&by).unwrap();
    (0..mesh.nodes.len()).map(|n| Vector3::from(moved[&(n + 1)]) - motion(n) * mean).collect()
}

/// Rigid motion of the gear in the rollers' frame: x, y, and turns about them.
fn in_frame(own: &Own) -> [f64; 4] {
    let [ux, uy, about_x, about_y] = own.moved;
    let back = Rotation2::new(-own.rollers.angle);
    let [u, turn] = [Vector2::new(ux, uy), Vector2::new(about_x, about_y)].map(|x| back * x);
    [u.x, u.y, turn.x, turn.y]
}

/// Approach of all laminae with the bore displaced, mm.
fn approaches(own: &Own, moved: &[Vector3<f64>]) -> Vec<f64> {
    let opens = |q: usize| -> f64 {
        let on = |(node, force): &(u32, [f64; 3])| Vector3::from(*force).dot(&moved[*node as usize]);
        let part = |(g, share): &(usize, f64)| share * own.rollers.grid.loads[*g].iter().map(on).sum::<f64>();
        own.rollers.prints[q].iter().map(part).sum()
    };
    let of_print: Vec<f64> = (0..own.rollers.prints.len()).map(opens).collect();
    let all = own.rollers.shares.iter().zip(&own.rollers.gaps);
    all.map(|(shares, gap)| -gap - shares.iter().map(|(q, share)| share * of_print[*q]).sum::<f64>()).collect()
}

/// Forces of both meshes on the nodes of the gear in the rollers' frame.
fn loads(own: &Own) -> Vec<(usize, [f64; 3])> {
    let mesh = own.gear.mesh();
    let near = |x: Vector3<f64>| {
        let off = |n: &usize| (Vector3::from(mesh.nodes[*n]) - x).norm();
        let found = (0..mesh.nodes.len()).min_by(|a, b| off(a).total_cmp(&off(b))).unwrap();
        assert!(off(&found) < 1e-6, "no node at {x}");
        found
    };
    own.flanks
        .iter()
        .flat_map(|flank| {
            let turn = Rotation2::new(flank.angle - own.rollers.angle);
            flank.by_node().into_iter().map(move |(node, [fx, fy, fz])| {
                let [x, y, z] = mesh.nodes[node as usize];
                let (x, f) = (turn * Vector2::new(x, y), turn * Vector2::new(fx, fy));
                (near(Vector3::new(x.x, x.y, z)), [f.x, f.y, fz])
            })
        })
        .collect()
}

/// Displacements by node of all tables of a print.
fn displacement(print: &str) -> BTreeMap<usize, [f64; 3]> {
    let row = |line: &str| {
        let words: Vec<&str> = line.split_whitespace().collect();
        let [node, x, y, z] = words[..] else { return None };
        Some((node.parse().ok()?, [x.parse().ok()?, y.parse().ok()?, z.parse().ok()?]))
    };
    print.lines().filter_map(row).collect()
}

/// Displacements of both flanks within 0.1 %, and rollers on the bore as CalculiX deforms it press by the same forces within
/// 0.1 % of the largest; on a rigid one they would be off by more than a tenth.
pub fn agrees_on_a_planet_on_rollers(calculix: Calculix) {
    let own = own();
    let folder = tempfile::tempdir().unwrap();
    let (print, _, said) = calculix.solve(&deck(&own), folder.path()).unwrap_or_else(|e| panic!("{e}"));
    let moved = displacement(&print);
    let mesh = own.gear.mesh();
    assert!(moved.len() == mesh.nodes.len(), "{said}");
    let [ux, uy, about_x, about_y] = in_frame(&own);
    let rigid = |n: usize| {
        let [x, y, z] = mesh.nodes[n];
        Vector3::new(ux + about_y * z, uy - about_x * z, about_x * y - about_y * x)
    };
    let elastic = without_mean(&own, &moved);
    let all: Vec<Vector3<f64>> = elastic.iter().enumerate().map(|(n, u)| u + rigid(n)).collect();
    let zone_of = |moved: &[Vector3<f64>]| -> Vec<f64> {
        let forces: Vec<f64> = approaches(&own, moved).into_iter().map(pressed).collect();
        forces.chunks(forces.len() / ROLLERS).map(|own| own.iter().sum()).collect()
    };
    let theirs = zone_of(&all);
    let largest = theirs.iter().copied().fold(0.0, f64::max);
    let off = |zone: &[f64]| own.zone.iter().zip(zone).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / largest;
    let stiff = off(&zone_of(&(0..all.len()).map(rigid).collect::<Vec<_>>()));
    let of_zone = off(&theirs);
    println!("rollers {:.1?} N, CalculiX {theirs:.1?} N: {:.4} % of the largest", own.zone, 100.0 * of_zone);
    let loads = loads(&own);
    let (first, second) = loads.split_at(own.flanks[0].by_node().len());
    let of_flanks = [first, second].map(|loads| {
        let size = loads.iter().map(|own| Vector3::from(own.1)).sum::<Vector3<f64>>().norm();
        loads.iter().map(|(n, f)| Vector3::from(*f).dot(&all[*n])).sum::<f64>() / size
    });
    println!("flanks {:.6?} mm, CalculiX {of_flanks:.6?} mm", own.flank_displacements);
    let worst = own.flank_displacements.iter().zip(of_flanks).map(|(a, b)| (a / b - 1.0).abs()).fold(0.0, f64::max);
    assert!(of_zone < 1e-3 && worst < 1e-3, "off by {of_zone:e}, {worst:e}");
    assert!(stiff > 0.1, "a rigid bore is off by {stiff} alone");
}
