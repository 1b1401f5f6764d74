//! One sector condensed and joined with itself against one factor of the whole gear.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use std::collections::BTreeMap;
use std::path::Path;

use crate::common::{gear, options};
use faer::Mat;
use fem::Material;
use geometry::{Gear, GearData, Side};
use mesh::{Extent, GroupNames, Mesh, MeshedGear, RootFillets};
use reduction::{FlankGrid, FlankGrids, GearReducer, ReducedGear, ReductionError, ReductionOptions, ReductionWay};

/// Two elements along every edge of the tooth.
fn meshed(gear: &Gear, order: u32, extent: Extent) -> MeshedGear {
    crate::common::meshed(gear, order, 2, extent)
}

/// Largest difference over the largest entry.
fn off(a: &Mat<f64>, b: &Mat<f64>) -> f64 {
    assert_eq!((a.nrows(), a.ncols()), (b.nrows(), b.ncols()));
    (a - b).norm_max() / b.norm_max()
}

/// Load on the window that is unlike from node to node.
fn loads(n: usize) -> Vec<f64> {
    (0..n).map(|i| if i % 3 == 1 { -5.0 } else { 2.0 * (0.3 * i as f64).sin() }).collect()
}

fn pressed(compliance: &Mat<f64>) -> Vec<f64> {
    let f = loads(compliance.nrows());
    (0..f.len()).map(|i| (0..f.len()).map(|j| compliance[(i, j)] * f[j]).sum()).collect()
}

/// Forces that hold the coordinates of a window at `u`.
fn holding(window: &ReducedGear, u: &[f64]) -> Vec<f64> {
    let (k, u) = (window.stiffness().unwrap(), Mat::from_fn(u.len(), 1, |i, _| u[i]));
    let f = k * &u;
    let f = &f + k * (&u - window.compliance() * &f);
    f.col_as_slice(0).to_vec()
}

fn field_off(a: &[[f64; 3]], b: &[[f64; 3]]) -> f64 {
    let largest = b.iter().flatten().fold(0.0f64, |m, x| m.max(x.abs()));
    a.iter().flatten().zip(b.iter().flatten()).fold(0.0f64, |m, (a, b)| m.max((a - b).abs())) / largest
}

/// Surface nodes of the fillets of a window and of those that share a space with it.
fn fillet_nodes(reducer: &GearReducer, exact: &Gear, first: u32, count: u32) -> Vec<u32> {
    let (found, z) = (RootFillets::new(reducer.gear(), exact), exact.teeth());
    let mut nodes = Vec::new();
    for tooth in first + z - 1..=first + z + count {
        for side in [Side::Right, Side::Left] {
            nodes.extend_from_slice(found.nodes(tooth % z, side));
        }
    }
    nodes
}

/// All that a whole mesh shows, both ways: C, K^, M^, fields in several windows, stress modes, carried coordinates.
fn compare(name: &str, mesh: MeshedGear, exact: &Gear, options: &ReductionOptions) {
    let z = exact.teeth();
    let cyclic = GearReducer::new(mesh.clone(), Material::STEEL, options.clone()).unwrap();
    let general = GearReducer::general(mesh, Material::STEEL, options.clone()).unwrap();
    assert_eq!(cyclic.way(), ReductionWay::CyclicSector, "{name}");
    assert_eq!(general.way(), ReductionWay::General, "{name}");
    assert_eq!(cyclic.free_count(), general.free_count(), "{name}");
    let [a, b] = [&cyclic, &general].map(|r| r.window(options.first).unwrap().reduced);
    assert_eq!((&a.teeth, &a.nodes), (&b.teeth, &b.nodes), "{name}");
    let c = off(a.compliance(), b.compliance());
    let k = off(a.stiffness().unwrap(), b.stiffness().unwrap());
    let m = off(&cyclic.condensed_mass().unwrap(), &general.condensed_mass().unwrap());
    let u = pressed(b.compliance());
    let mut field = 0.0f64;
    let mut carried = 0.0f64;
    for first in [options.first, options.first + 1, options.first + z - 1, options.first + z / 2] {
        let [v, w] = [&cyclic, &general].map(|r| r.window(first).unwrap());
        assert_eq!(v.shift, w.shift, "{name}, tooth {first}");
        let fields = [cyclic.expand(&v, &u).unwrap(), general.expand(&w, &u).unwrap()];
        field = field.max(field_off(&fields[0], &fields[1]));
        // Some nodes alone, in any order, under several forces at once, are those of the whole field that these hold.
        let some: Vec<u32> = (0..fields[0].len() as u32).rev().step_by(17).collect();
        for (all, (gear, window)) in fields.iter().zip([(&cyclic, &v), (&general, &w)]) {
            let f = holding(&window.reduced, &u);
            let twice: Vec<f64> = f.iter().map(|x| 2.0 * x).collect();
            let several = [&f[..], &twice];
            let found = gear.expand_under(window, &several, &some);
            let beyond = gear.expand_under(window, &several, &[u32::MAX]);
            assert!(beyond.is_err(), "{name}: a node that the mesh does not have");
            for (factor, found) in [1.0, 2.0].into_iter().zip(found.unwrap()) {
                let wanted: Vec<[f64; 3]> = some.iter().map(|&n| all[n as usize].map(|x| factor * x)).collect();
                // Over the largest of all: some nodes may be held.
                let largest = all.iter().flatten().fold(0.0f64, |m, x| m.max(x.abs()));
                let pairs = found.iter().flatten().zip(wanted.iter().flatten());
                let off = pairs.fold(0.0f64, |m, (a, b)| m.max((a - b).abs())) / largest;
                assert_eq!(found.len(), wanted.len(), "{name}, tooth {first}");
                assert!(off < 1e-11, "{name}, tooth {first}: some nodes differ from all by {off:e}");
            }
        }
        let from = [&cyclic, &general].map(|r| r.window(options.first + 2).unwrap());
        let x = cyclic.carry(&from[0], &v, &u).unwrap();
        let y = general.carry(&from[1], &w, &u).unwrap();
        let largest = u.iter().fold(0.0f64, |m, x| m.max(x.abs()));
        carried = x.iter().zip(&y).fold(carried, |m, (x, y)| m.max((x - y).abs() / largest));
    }
    let nodes = fillet_nodes(&cyclic, exact, options.first, options.window as u32);
    assert!(nodes.len() > 20, "{name}: {} fillet nodes", nodes.len());
    let modes = [&cyclic, &general].map(|r| r.stress_modes(&r.window(options.first).unwrap(), &nodes).unwrap());
    let s = off(&modes[0].matrix().unwrap(), &modes[1].matrix().unwrap());
    println!("{name}: C {c:.1e}, K {k:.1e}, M {m:.1e}, field {field:.1e}, carried {carried:.1e}, stress {s:.1e}");
    for (what, off) in [("C", c), ("K", k), ("M", m), ("field", field), ("carried", carried), ("stress", s)] {
        assert!(off < 1e-9, "{name}: {what} differs by {off:e} of its largest entry");
    }
}

/// Whole gears by the built-in mesher: from 11 to 30 teeth, spur and helical, both orders, one flank and both, windows
/// of one tooth, wider than half of the gear, and of all teeth; first teeth that reach across z - 1 to 0.
#[test]
fn a_sector_gives_what_the_whole_gear_gives() {
    use Side::{Left, Right};
    for (teeth, beta, order, sides, window, first) in [
        (11, 0.0, 1, &[Left][..], 3, 0),
        (11, 25.0, 1, &[Right, Left], 8, 9),
        (11, 25.0, 2, &[Left], 11, 4),
        (13, -20.0, 2, &[Right], 1, 12),
        (14, 15.0, 1, &[Left], 10, 3),
        (17, 30.0, 1, &[Left, Right], 3, 15),
        (30, 20.0, 1, &[Left], 3, 28),
        (30, 20.0, 2, &[Left], 2, 29),
    ] {
        let exact = gear(teeth, beta);
        let name = format!("z {teeth}, {beta} deg, order {order}, {sides:?}, {window} teeth from {first}");
        compare(&name, meshed(&exact, order, Extent::Whole), &exact, &options(sides, window, first));
    }
}

/// Whole gears that Gmsh made of turned copies of one tooth are recognised.
#[test]
fn whole_gears_by_gmsh_go_the_cyclic_way() {
    let exact = Gear::new(GearData::default()).unwrap();
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../meshes/coarse_hex8_pinion.msh");
    let mesh = MeshedGear::from_groups(Mesh::read(&path).unwrap(), &GroupNames::default(), 30).unwrap();
    compare("coarse_hex8_pinion", mesh, &exact, &options(&[Side::Left], 3, 29));
}

/// A periodic sector shows the sectors about its window only; its matrices are those of the gear that it unrolls to.
#[test]
fn a_periodic_sector_is_not_unrolled() {
    for (teeth, beta, order, window, first, cut_through_teeth) in [
        (11, 25.0, 1, 2, 10, false),
        (11, 25.0, 1, 3, 9, true),
        (30, 20.0, 1, 3, 28, false),
        (17, -15.0, 2, 1, 4, false),
    ] {
        let exact = gear(teeth, beta);
        let mut sector = meshed(&exact, order, Extent::Periodic);
        if cut_through_teeth {
            // The right flank of the next tooth in place of the sector's own: half of a window's flanks are in other
            // copies.
            let mut mesh = sector.mesh().clone();
            mesh.surfaces.iter_mut().for_each(|g| g.name = g.name.replace("right_0", "right_1"));
            sector = MeshedGear::from_groups(mesh, &GroupNames::default(), teeth).unwrap();
        }
        let options = options(&[Side::Right, Side::Left], window, first);
        let cyclic = GearReducer::new(sector.clone(), Material::STEEL, options.clone()).unwrap();
        let general = GearReducer::general(sector, Material::STEEL, options).unwrap();
        // One more sector on either side; a tooth that is cut has its flanks in two.
        assert_eq!(cyclic.gear().teeth().len(), window + 2 + 2 * usize::from(cut_through_teeth), "z {teeth}");
        assert_eq!(cyclic.way(), ReductionWay::CyclicSector, "z {teeth}");
        assert_eq!(cyclic.free_count(), general.free_count(), "z {teeth}");
        let windows = [&cyclic, &general].map(|r| r.window(first).unwrap());
        // The whole gear has other numbers: nodes meet by place.
        let [here, there] = [&cyclic, &general].map(|r| &r.gear().mesh().nodes);
        let place = |x: &[f64; 3]| x.map(|x| (x * 1e7).round() as i64);
        let by_place: BTreeMap<[i64; 3], usize> = there.iter().enumerate().map(|(n, x)| (place(x), n)).collect();
        let partner = |n: u32| {
            let [x, y, z] = place(&here[n as usize]);
            let near = (0..27).map(|s| [x + s % 3 - 1, y + s / 3 % 3 - 1, z + s / 9 - 1]);
            near.filter_map(|p| by_place.get(&p)).copied().next().unwrap()
        };
        let number = |n: u32| windows[1].reduced.position(partner(n) as u32).unwrap();
        let order: Vec<usize> = windows[0].reduced.nodes.iter().map(|&n| number(n)).collect();
        let n = windows[0].reduced.coordinates();
        let there = windows[1].reduced.compliance();
        let sorted = Mat::from_fn(n, n, |i, j| there[(3 * order[i / 3] + i % 3, 3 * order[j / 3] + j % 3)]);
        let c = off(windows[0].reduced.compliance(), &sorted);
        // A field and the stress in the fillets under the same load.
        let u = pressed(&sorted);
        let mut v = vec![0.0; n];
        (0..n).for_each(|i| v[3 * order[i / 3] + i % 3] = u[i]);
        let mut field = 0.0f64;
        for shift in [0, 1, teeth - 1, 5] {
            let w = [&cyclic, &general].map(|r| r.window(first + shift).unwrap());
            let [a, b] = [cyclic.expand(&w[0], &u).unwrap(), general.expand(&w[1], &v).unwrap()];
            let b: Vec<[f64; 3]> = (0..a.len() as u32).map(|n| b[partner(n)]).collect();
            field = field.max(field_off(&a, &b));
        }
        let nodes = fillet_nodes(&cyclic, &exact, first, window as u32);
        let stress = cyclic.stress_modes(&windows[0], &nodes).unwrap().stress(&u).unwrap();
        let partners: Vec<u32> = nodes.iter().map(|&n| partner(n) as u32).collect();
        let wanted = general.stress_modes(&windows[1], &partners).unwrap().stress(&v).unwrap();
        let largest = wanted.iter().flatten().fold(0.0f64, |m, s| m.max(s.abs()));
        let s = stress.iter().flatten().zip(wanted.iter().flatten()).fold(0.0f64, |m, (a, b)| m.max((a - b).abs()));
        println!("z {teeth}: C {c:.1e}, field {field:.1e}, stress {:.1e}", s / largest);
        assert!(c < 1e-9 && field < 1e-9 && s < 1e-9 * largest, "z {teeth}: C {c:e}, field {field:e}, stress {s:e}");
    }
}

/// Grids over the flanks whose loads are shared between the nodes of a face.
fn grids(mesh: &MeshedGear, sides: &[Side]) -> Result<FlankGrids, ReductionError> {
    let mut grids = BTreeMap::new();
    for tooth in mesh.teeth() {
        for &side in sides {
            let faces = mesh.flank(tooth, side).unwrap();
            let share = |f: &mesh::Face| f.corners().iter().zip([0.4, 0.3, 0.2, 0.1]).map(|(&n, w)| (n, w)).collect();
            let loads: Vec<Vec<(u32, f64)>> = faces.iter().map(share).collect();
            let positions = faces.iter().map(|f| mesh.mesh().nodes[f.corners()[0] as usize]).collect();
            grids.insert((tooth, side), FlankGrid { faces: Vec::new(), positions, loads });
        }
    }
    Ok(grids)
}

/// Means over the flanks instead of nodes: the same of all that follows.
#[test]
fn grids_go_both_ways() {
    for (teeth, beta, order, sides, window, first) in
        [(11, 25.0, 1, &[Side::Left][..], 9, 7), (30, 20.0, 2, &[Side::Right, Side::Left], 3, 28)]
    {
        let exact = gear(teeth, beta);
        let mesh = meshed(&exact, order, Extent::Whole);
        let options = options(sides, window, first);
        let [cyclic, general] = [false, true].map(|general| {
            GearReducer::on_grids(mesh.clone(), Material::STEEL, options.clone(), general, |m| grids(m, sides)).unwrap()
        });
        assert_eq!([cyclic.way(), general.way()], [ReductionWay::CyclicSector, ReductionWay::General]);
        let [a, b] = [&cyclic, &general].map(|r| r.window(first).unwrap());
        let c = off(a.reduced.compliance(), b.reduced.compliance());
        let k = off(a.reduced.stiffness().unwrap(), b.reduced.stiffness().unwrap());
        let m = off(&cyclic.condensed_mass().unwrap(), &general.condensed_mass().unwrap());
        let u = pressed(b.reduced.compliance());
        let field = field_off(&cyclic.expand(&a, &u).unwrap(), &general.expand(&b, &u).unwrap());
        let nodes = fillet_nodes(&cyclic, &exact, first, window as u32);
        let [x, y] = [(&cyclic, &a), (&general, &b)].map(|(r, w)| r.stress_modes(w, &nodes).unwrap().matrix().unwrap());
        let s = off(&x, &y);
        println!("grids, z {teeth}: C {c:.1e}, K {k:.1e}, M {m:.1e}, field {field:.1e}, stress {s:.1e}");
        assert!(
            c < 1e-9 && k < 1e-9 && m < 1e-9 && field < 1e-9 && s < 1e-9,
            "z {teeth}: {c:e} {k:e} {m:e} {field:e} {s:e}"
        );
    }
}

/// A gear with one node moved, and one held at another place, is not cyclic: it goes the general way by itself.
#[test]
fn what_is_not_cyclic_goes_the_general_way() {
    let exact = gear(13, 20.0);
    let whole = meshed(&exact, 1, Extent::Whole);
    let mut moved = whole.mesh().clone();
    moved.nodes[whole.bore_nodes()[7] as usize][2] += 1e-4;
    let mut held = whole.mesh().clone();
    let bore = held.surfaces.iter_mut().find(|s| s.name == "bore").unwrap();
    bore.faces.truncate(bore.faces.len() - 2);
    for (what, mesh) in [("a node moved", moved), ("a bore in part", held)] {
        let gear = MeshedGear::from_groups(mesh, &GroupNames::default(), 13).unwrap();
        let reducer = GearReducer::new(gear, Material::STEEL, options(&[Side::Left], 2, 0)).unwrap();
        assert_eq!(reducer.way(), ReductionWay::General, "{what}");
        assert!(!reducer.is_cyclic(), "{what}");
    }
}

/// One thread or two, the same bits.
#[test]
fn threads_change_nothing() {
    let exact = gear(17, 20.0);
    let sector = meshed(&exact, 2, Extent::Periodic);
    let compliance = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let reducer =
                GearReducer::new(sector.clone(), Material::STEEL, options(&[Side::Left, Side::Right], 3, 5)).unwrap();
            (reducer.window(5).unwrap().reduced.compliance().clone(), reducer.condensed_mass().unwrap())
        })
    };
    assert!(compliance(1) == compliance(2), "the matrices depend on the number of threads");
}
