//! Stress modes against the long way: displacement of the whole mesh, then its stress, from elements and from the free
//! surface.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use std::path::Path;

use faer::Mat;
use fem::{DofMap, ElementOptions, Material, StressOperator};
use geometry::{Gear, GearData, Side};
use mesh::{Extent, GroupNames, Mesh, MeshedGear, RootFillets, StructuredOptions};
use reduction::{GearReducer, ReductionError, ReductionOptions, Window};

fn pinion() -> Gear {
    Gear::new(GearData::default()).unwrap()
}

/// The default pinion by the built-in mesher, whole: cyclic.
fn whole(order: u32) -> MeshedGear {
    let options = StructuredOptions {
        order,
        elements_profile: 2,
        elements_fillet: 2,
        elements_thickness: 2,
        elements_face: 3,
        elements_rim: 1,
        extent: Extent::Whole,
    };
    MeshedGear::from_groups(mesh::generate(&pinion(), &options).unwrap(), &GroupNames::default(), 30).unwrap()
}

/// A mesh that Gmsh made.
fn by_gmsh(name: &str) -> MeshedGear {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../meshes").join(name);
    MeshedGear::from_groups(Mesh::read(&path).unwrap(), &GroupNames::default(), 30).unwrap()
}

fn reducer(gear: MeshedGear, first: u32, window: usize) -> GearReducer {
    let options = ReductionOptions { sides: vec![Side::Left], window, first, elements: ElementOptions::default() };
    GearReducer::new(gear, Material::STEEL, options).unwrap()
}

/// Surface nodes of both fillets of the window's teeth, in the frame of its matrices.
fn fillet_nodes(gear: &GearReducer, window: &Window) -> Vec<u32> {
    let found = RootFillets::new(gear.gear(), &pinion());
    let fillets = window.reduced.teeth.iter().flat_map(|&t| [(t, Side::Right), (t, Side::Left)]);
    fillets.flat_map(|(tooth, side)| found.nodes(tooth, side).to_vec()).collect()
}

/// Displacements under a load that presses on the window's flanks, unlike from node to node.
fn pressed(window: &Window) -> Vec<f64> {
    let n = window.reduced.coordinates();
    let load: Vec<f64> = (0..n).map(|i| if i % 3 == 1 { -5.0 } else { 2.0 * (0.3 * i as f64).sin() }).collect();
    (0..n).map(|i| (0..n).map(|j| window.reduced.compliance()[(i, j)] * load[j]).sum()).collect()
}

/// Largest difference of the stress tensors, turned into the gear's own frame, over the largest stress.
fn difference(gear: &GearReducer, window: &Window) -> f64 {
    let nodes = fillet_nodes(gear, window);
    let u = pressed(window);
    let field = gear.expand(window, &u).unwrap();
    let mesh = gear.gear().mesh();
    let all = fem::nodal_stress(mesh, gear.material(), gear.elements(), &field).unwrap();
    let by_elements = off(gear, window, &nodes, &gear.stress_modes(window, &nodes).unwrap().stress(&u).unwrap(), &all);

    // The same from the faces of the fillets alone.
    let fillets = RootFillets::new(gear.gear(), &pinion());
    let (free, every) = (DofMap::new(mesh.nodes.len(), &[]), (0..mesh.nodes.len() as u32).collect::<Vec<_>>());
    let operator = StressOperator::on_surface(mesh, gear.material(), &free, fillets.faces(), &every).unwrap();
    let stress = operator.apply(Mat::from_fn(3 * field.len(), 1, |i, _| field[i / 3][i % 3]).as_ref()).unwrap();
    let all: Vec<[f64; 6]> = (0..every.len()).map(|i| [0, 1, 2, 3, 4, 5].map(|k| stress[(6 * i + k, 0)])).collect();
    let modes = gear.surface_stress_modes(window, &nodes, fillets.faces()).unwrap();
    by_elements.max(off(gear, window, &nodes, &modes.stress(&u).unwrap(), &all))
}

/// Largest difference of stress by modes from that of the whole mesh, over the largest stress.
fn off(gear: &GearReducer, window: &Window, nodes: &[u32], by_modes: &[[f64; 6]], all: &[[f64; 6]]) -> f64 {
    let (sin, cos) = gear.frame_angle(window).sin_cos();
    let turn = nalgebra::Matrix3::new(cos, -sin, 0.0, sin, cos, 0.0, 0.0, 0.0, 1.0);
    let tensor = |s: &[f64; 6]| nalgebra::Matrix3::new(s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2]);
    let (mut worst, mut largest) = (0.0f64, 0.0f64);
    for (&node, s) in nodes.iter().zip(by_modes) {
        let wanted = tensor(&all[gear.material_node(window, node) as usize]);
        worst = worst.max((turn * tensor(s) * turn.transpose() - wanted).amax());
        largest = largest.max(wanted.amax());
    }
    assert!(nodes.len() > 10 && largest > 0.1, "{} nodes, {largest} MPa", nodes.len());
    worst / largest
}

/// S u_B = nodal stress of the expanded field, within 1e-9: hexahedra of both orders in a cyclic gear, in the window
/// that was factored and in others, across tooth z-1 to 0.
#[test]
fn modes_give_the_stress_of_the_whole_field_in_a_cyclic_gear() {
    for order in [1, 2] {
        let gear = reducer(whole(order), 29, 2);
        assert!(gear.is_cyclic());
        for first in [29, 0, 28, 11] {
            let off = difference(&gear, &gear.window(first).unwrap());
            println!("hex, order {order}, window from tooth {first}: {off:.1e}");
            assert!(off < 1e-9, "order {order}, tooth {first}: {off:e}");
        }
    }
}

/// Modes give the stress on sectors that Gmsh made, every kind of element; windows other than the factored one go by
/// whole solves.
#[test]
fn modes_give_the_stress_of_the_whole_field_in_a_sector() {
    for kind in ["hex20", "hex27", "hex8_v41_binary", "tet10", "tet4", "wedge15", "wedge6"] {
        let gear = reducer(by_gmsh(&format!("sector3_{kind}.msh")), 0, 1);
        assert!(!gear.is_cyclic());
        for first in [0, 1, 29] {
            let off = difference(&gear, &gear.window(first).unwrap());
            println!("{kind}, window from tooth {first}: {off:.1e}");
            assert!(off < 1e-9, "{kind}, tooth {first}: {off:e}");
        }
    }
}

/// A periodic sector runs as the whole gear, and the modes of one window are those of all.
#[test]
fn a_periodic_sector_has_one_set_of_modes() {
    let gear = reducer(by_gmsh("periodic_hex20.msh").whole().unwrap(), 0, 2);
    let [here, there] = [0, 17].map(|first| gear.window(first).unwrap());
    let nodes = fillet_nodes(&gear, &here);
    let [a, b] = [&here, &there].map(|w| gear.stress_modes(w, &nodes).unwrap());
    assert_eq!(a.matrix(), b.matrix());
    let off = difference(&gear, &there);
    assert!(off < 1e-9, "{off:e}");
}

/// Made row by row of D B or column by column of T, whichever is less work: the same modes, in any window.
#[test]
fn both_ways_make_the_same_modes() {
    let gear = reducer(by_gmsh("sector3_hex20.msh"), 0, 1);
    for first in [0, 1] {
        let window = gear.window(first).unwrap();
        let nodes = fillet_nodes(&gear, &window);
        let few = &nodes[..8];
        assert!(6 * few.len() <= window.reduced.coordinates());
        // Repeated until the other way is the shorter one.
        let many: Vec<u32> = few.iter().cycle().take(window.reduced.coordinates()).copied().collect();
        let [by_rows, by_columns] = [few, &many].map(|n| gear.stress_modes(&window, n).unwrap());
        let [by_rows, by_columns] = [by_rows, by_columns].map(|modes| modes.matrix().unwrap());
        let largest = by_rows.norm_max();
        let off = (&by_rows - by_columns.subrows(0, 48)).norm_max() / largest;
        println!("window from tooth {first}: {off:.1e} of the largest mode");
        assert!(off < 1e-10, "window from tooth {first}: {off:e}");
    }
}

/// Twice the displacement, twice the stress; of two loads together, the sum.
#[test]
fn stress_is_linear_in_the_coordinates() {
    let gear = reducer(by_gmsh("sector3_hex20.msh"), 0, 1);
    let window = gear.window(0).unwrap();
    let nodes = fillet_nodes(&gear, &window);
    let modes = gear.stress_modes(&window, &nodes).unwrap();
    let (u, v): (Vec<f64>, Vec<f64>) =
        pressed(&window).iter().enumerate().map(|(i, u)| (*u, u * (i as f64).cos())).unzip();
    let both: Vec<f64> = u.iter().zip(&v).map(|(u, v)| 2.0 * u - v).collect();
    let [a, b, c] = [&u, &v, &both].map(|u| modes.stress(u).unwrap());
    let largest = a.iter().flatten().fold(0.0f64, |m, s| m.max(s.abs()));
    for ((a, b), c) in a.iter().flatten().zip(b.iter().flatten()).zip(c.iter().flatten()) {
        assert!((2.0 * a - b - c).abs() < 1e-11 * largest, "{a} {b} {c}");
    }
    // Forces move the coordinates by C f.
    let pressing: Vec<f64> = (0..u.len()).map(|i| (0.7 * i as f64).cos()).collect();
    let moved: Vec<f64> =
        (0..u.len()).map(|i| (0..u.len()).map(|j| window.reduced.compliance()[(i, j)] * pressing[j]).sum()).collect();
    let [by_force, by_motion] = [modes.stress_under(&pressing).unwrap(), modes.stress(&moved).unwrap()];
    let largest = by_motion.iter().flatten().fold(0.0f64, |m, s| m.max(s.abs()));
    for (a, b) in by_force.iter().flatten().zip(by_motion.iter().flatten()) {
        assert!((a - b).abs() < 1e-9 * largest, "{a} {b}");
    }
    assert!(matches!(modes.stress(&u[1..]), Err(ReductionError::WrongLength { .. })));
    assert!(gear.stress_modes(&window, &[u32::MAX]).is_err(), "a node that does not exist");
}

/// Fillets are found where the section has them: every node on the exact curve or on the root land (mid-side nodes on
/// chords), both sides of a tooth mirror images at mid-face, the middle of a space on both fillets.
#[test]
fn fillet_nodes_lie_on_the_fillet() {
    let gear = pinion();
    let profile = gear.profile();
    let curve: Vec<(f64, f64)> = (0..=2000).map(|i| profile.fillet(f64::from(i) / 2000.0)).collect();
    for (name, gear_mesh) in [
        ("hex8", whole(1)),
        ("hex20", whole(2)),
        ("tet10", by_gmsh("sector3_tet10.msh")),
        ("hex20 by Gmsh", by_gmsh("sector3_hex20.msh")),
    ] {
        let found = RootFillets::new(&gear_mesh, &gear);
        let nodes = &gear_mesh.mesh().nodes;
        let mut worst = 0.0f64;
        for side in [Side::Left, Side::Right] {
            let list = found.nodes(0, side);
            assert!(list.len() >= 8, "{name}, {} fillet: {} nodes", side.name(), list.len());
            for &node in list {
                let [x, y, z] = nodes[node as usize];
                let (r, angle) = (x.hypot(y), side.sign() * (y.atan2(x) - gear.twist() * z));
                let off = if angle >= profile.root_land_start() {
                    (r - gear.root_radius()).abs()
                } else {
                    curve.iter().map(|&(c, a)| (r - c).hypot(r * (angle - a))).fold(f64::INFINITY, f64::min)
                };
                worst = worst.max(off);
            }
        }
        println!("{name}: {worst:.1e} mm off the exact section at worst");
        assert!(worst < 5e-3, "{name}: a node is {worst} mm off the fillet");
        let shared: Vec<_> =
            found.nodes(0, Side::Left).iter().filter(|n| found.nodes(1, Side::Right).contains(n)).collect();
        assert!(name == "tet10" || !shared.is_empty(), "{name}: nobody is on the middle of the space");
    }
}
