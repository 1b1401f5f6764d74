//! Bores that stand on springs at places of the gear.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use std::f64::consts::TAU;

use crate::common::options;
use faer::Mat;
use fem::{DofMap, ElementOptions, Material};
use geometry::{Gear, GearData, Side};
use mesh::{Bolts, BoreCoupling, Extent, Foundation, GroupNames, MeshError, MeshedGear, StructuredOptions};
use nalgebra::{DMatrix, DVector, Vector3};
use reduction::{GearReducer, ReductionError, ReductionWay, Window};

/// A ring of 40 teeth, 8 mm wide.
fn ring() -> Gear {
    let data = GearData {
        teeth: 40,
        face_width: 8.0,
        addendum_coefficient: 0.85,
        root_radius_coefficient: 0.25,
        bore_diameter: -160.0,
        ..GearData::default()
    };
    Gear::new(data.with_usual_shaper(0.0)).unwrap()
}

fn meshed(gear: &Gear, face: u32, extent: Extent) -> MeshedGear {
    let options = StructuredOptions {
        order: 1,
        elements_profile: 1,
        elements_fillet: 2,
        elements_thickness: 1,
        elements_face: face,
        elements_rim: 1,
        extent,
    };
    MeshedGear::find(mesh::generate(gear, &options).unwrap(), gear, &GroupNames::default()).unwrap().0
}

const BOLTS: Bolts = Bolts {
    count: 6,
    first_angle: 0.2,
    width: 9.0,
    heights: Some([-2.5, 3.0]),
    stiffness: [4e4, 9e4, 2e4],
    opens_beyond: None,
};

fn bolted(mesh: MeshedGear, all_around: [f64; 3], bolts: Bolts) -> MeshedGear {
    mesh.coupled(BoreCoupling::Elastic(Foundation::new(all_around, Some(bolts)).unwrap()))
}

fn reduced(mesh: MeshedGear, window: usize) -> GearReducer {
    GearReducer::new(mesh, Material::STEEL, options(&[Side::Left], window, 0)).unwrap()
}

/// K of the springs of a gear, dense, from what its bore says.
fn springs(mesh: &MeshedGear) -> DMatrix<f64> {
    let n = 3 * mesh.mesh().nodes.len();
    let mut all = DMatrix::zeros(n, n);
    let foundation = mesh.bore_coupling().foundation().unwrap();
    for spring in foundation.springs(mesh.mesh(), &mesh.bore().faces).unwrap() {
        for (i, &p) in spring.face.nodes().iter().enumerate() {
            for (j, &q) in spring.face.nodes().iter().enumerate() {
                let share = spring.shape[i] * spring.shape[j] * spring.stiffness;
                let mut block = all.view_mut((3 * p as usize, 3 * q as usize), (3, 3));
                block += share;
            }
        }
    }
    all
}

/// Each bolt has its stiffness, however the mesh divides it: along and about the axis of a gear its springs add up, and their
/// middle is where it stands; a height that is asymmetric gives the moment that it should.
#[test]
fn bolts_have_their_stiffness_and_place() {
    let (exact, [radial, tangential, axial]) = (ring(), BOLTS.stiffness);
    for face in [2, 3] {
        let mesh = bolted(meshed(&exact, face, Extent::Whole), [0.0; 3], BOLTS);
        let stiffness = springs(&mesh);
        let along = |field: &dyn Fn(Vector3<f64>) -> Vector3<f64>| {
            let at = |i: usize| field(Vector3::from(mesh.mesh().nodes[i / 3]))[i % 3];
            DVector::from_fn(stiffness.nrows(), |i, _| at(i))
        };
        let work = |a: &DVector<f64>, b: &DVector<f64>| a.dot(&(&stiffness * b));
        let [x, z] = [Vector3::x(), Vector3::z()].map(|e| along(&move |_| e));
        let tilt = along(&|at| Vector3::y().cross(&at));
        let turn = along(&|at| Vector3::z().cross(&at));
        // Faces are chords of the circle: a turn moves their middles less than their ends.
        let middle = BOLTS.heights.map(|[from, to]| 0.5 * (from + to)).unwrap();
        let found = [work(&x, &x), work(&z, &z), work(&x, &tilt), work(&turn, &turn)];
        let across = 3.0 * (radial + tangential);
        let wanted = [across, 6.0 * axial, across * middle, 6.0 * tangential * 80.0 * 80.0];
        println!("{face} rows: {found:?}, wanted {wanted:?}");
        for ((found, wanted), near) in found.into_iter().zip(wanted).zip([1e-9, 1e-12, 1e-9, 0.01]) {
            assert!((found / wanted - 1.0).abs() < near, "{face} rows: {found} beside {wanted}");
        }
        // Nodes with springs: six places, no more.
        let held: Vec<usize> = (0..mesh.mesh().nodes.len()).filter(|i| stiffness[(3 * i, 3 * i)] > 0.0).collect();
        for i in held {
            let [x, y, _] = mesh.mesh().nodes[i];
            let off = (y.atan2(x) - BOLTS.first_angle) / TAU * 6.0;
            let off = (off - off.round()).abs() * TAU / 6.0 * 80.0;
            // Half a bolt and a face of the mesh.
            assert!(off < 4.5 + TAU * 80.0 / 40.0, "a spring {off} mm from its bolt");
        }
    }
}

/// A ring with three windows on six bolts, and on springs beside them: C of all is that of the whole mesh with its springs, to
/// 1e-10 of its largest entry, by one sector and bolts beside it and by one factor of the whole gear.
#[test]
fn three_windows_on_six_bolts_are_those_of_the_whole_mesh() {
    let exact = ring();
    for (all_around, extent, way) in [
        ([0.0; 3], Extent::Whole, ReductionWay::SectorAndBolts),
        ([50.0, 20.0, 10.0], Extent::Periodic, ReductionWay::SectorAndBolts),
        ([50.0, 0.0, 0.0], Extent::Whole, ReductionWay::General),
    ] {
        let whole = bolted(meshed(&exact, 2, Extent::Whole), all_around, BOLTS);
        let dofs = DofMap::new(whole.mesh().nodes.len(), &[]);
        let system = fem::assemble(whole.mesh(), &Material::STEEL, &dofs, &ElementOptions::default()).unwrap();
        let own = system.stiffness.to_dense();
        let row = |node: usize, axis: usize| dofs.dof(node as u32, axis).unwrap();
        let held = springs(&whole);
        let nodes = whole.mesh().nodes.len();
        let mut stiffness = DMatrix::from_fn(own.nrows(), own.ncols(), |i, j| own[(i, j)]);
        for (p, q) in (0..nodes).flat_map(|p| (0..nodes).map(move |q| (p, q))) {
            for (a, b) in (0..3).flat_map(|a| (0..3).map(move |b| (a, b))) {
                stiffness[(row(p, a), row(q, b))] += held[(3 * p + a, 3 * q + b)];
            }
        }
        let factor = stiffness.cholesky().unwrap();
        let reducer = reduced(bolted(meshed(&exact, 2, extent), all_around, BOLTS), 2);
        assert_eq!((reducer.way(), reducer.is_cyclic()), (way, false));
        let windows: Vec<Window> = [0, 13, 27].iter().map(|&first| reducer.window(first).unwrap()).collect();
        let all: Vec<(&GearReducer, &Window)> = windows.iter().map(|window| (&reducer, window)).collect();
        let found = GearReducer::compliance_of(&all).unwrap();
        let place = |node: &u32| {
            let at = reducer.gear().mesh().nodes[*node as usize];
            let near = |m: &[f64; 3]| (0..3).all(|k| (m[k] - at[k]).abs() < 1e-9);
            whole.mesh().nodes.iter().position(near).unwrap()
        };
        let places: Vec<usize> = windows.iter().flat_map(|window| window.reduced.nodes.iter().map(place)).collect();
        let n = 3 * places.len();
        let unit = DMatrix::from_fn(factor.l().nrows(), n, |i, j| f64::from(u8::from(i == row(places[j / 3], j % 3))));
        let moved = factor.solve(&unit);
        let wanted = Mat::from_fn(n, n, |i, j| moved[(row(places[i / 3], i % 3), j)]);
        let off = (&found - &wanted).norm_max() / wanted.norm_max();
        let [a, b] = [0, 1].map(|i| windows[i].reduced.compliance().norm_max());
        println!("{all_around:?}, {extent:?}: off by {off:.1e}; windows alone {a:.3e}, {b:.3e} mm/N");
        assert!(off < 1e-10, "{off:e}");
        assert!((a / b - 1.0).abs() > 1e-3, "teeth beside bolts and between them yield alike: {a:e}, {b:e}");
    }
}

/// Bolts beside one sector and bolts in K of the whole gear: windows, fields, what bolts open and carry are alike to 1e-10, of a
/// straight and a helical ring and of a gear with teeth outside, of bolts that open and of others.
#[test]
fn bolts_beside_a_sector_are_those_of_the_whole_gear() {
    let ring_of = |beta: f64| {
        let data = GearData {
            teeth: 40,
            helix_angle: beta.to_radians(),
            face_width: 8.0,
            addendum_coefficient: 0.85,
            root_radius_coefficient: 0.25,
            bore_diameter: -160.0 / beta.to_radians().cos(),
            ..GearData::default()
        };
        Gear::new(data.with_usual_shaper(0.0)).unwrap()
    };
    let outer = Gear::new(GearData { teeth: 23, face_width: 8.0, bore_diameter: 40.0, ..GearData::default() }).unwrap();
    for (name, exact, all_around, opens_beyond) in [
        ("ring", ring_of(0.0), [0.0; 3], None),
        ("helical ring, opens", ring_of(20.0), [0.0; 3], Some(50.0)),
        ("gear, springs beside", outer, [0.0, 30.0, 10.0], Some(0.0)),
    ] {
        let mesh = bolted(meshed(&exact, 2, Extent::Whole), all_around, Bolts { opens_beyond, ..BOLTS });
        let own = reduced(mesh.clone(), 2);
        let whole = GearReducer::general(mesh, Material::STEEL, options(&[Side::Left], 2, 0)).unwrap();
        assert_eq!((own.way(), whole.way()), (ReductionWay::SectorAndBolts, ReductionWay::General));
        let off = |a: &Mat<f64>, b: &Mat<f64>| (a - b).norm_max() / b.norm_max().max(1e-300);
        let mut all = Vec::new();
        for first in [0, 9] {
            let [a, b] = [&own, &whole].map(|gear| gear.window(first).unwrap());
            assert_eq!((&a.reduced.nodes, &a.reduced.teeth), (&b.reduced.nodes, &b.reduced.teeth));
            all.push(("C", off(a.reduced.compliance(), b.reduced.compliance())));
            let n = a.reduced.coordinates();
            let forces: Vec<f64> = (0..n).map(|i| (0.7 * i as f64).sin()).collect();
            let every: Vec<u32> = (0..own.gear().mesh().nodes.len() as u32).collect();
            let fields = [(&own, &a), (&whole, &b)].map(|(gear, window)| {
                let field = gear.expand_under(window, &[&forces], &every).unwrap().remove(0);
                Mat::from_fn(3, field.len(), |i, j| field[j][i])
            });
            all.push(("field", off(&fields[0], &fields[1])));
            let [a, b] = [(&own, &a), (&whole, &b)].map(|(gear, window)| gear.bolts_and_flanks(window).unwrap());
            all.push(("flanks", off(&a.flanks, &b.flanks)));
            all.push(("springs", off(&a.springs, &b.springs)));
        }
        let [a, b] = [&own, &whole].map(|gear| gear.bolt_compliance().unwrap());
        all.push(("openings", off(&a.openings, &b.openings)));
        all.push(("springs by bolts", off(&a.springs, &b.springs)));
        println!("{name}: {all:?}");
        // Forces that change their sign from node to node leave a field that is small beside what each of them makes.
        let most = |of: &str| if of == "field" { 1e-9 } else { 1e-10 };
        assert!(all.iter().all(|own| own.1 < most(own.0)), "{name}: {all:?}");
    }
}

/// What the sector does not give comes from the whole gear: its lowest frequency and stress are those of a gear in one factor.
#[test]
fn what_a_sector_on_bolts_does_not_give_is_the_whole_gears() {
    let mesh = bolted(meshed(&ring(), 2, Extent::Whole), [0.0; 3], BOLTS);
    let whole = GearReducer::general(mesh.clone(), Material::STEEL, options(&[Side::Left], 2, 0)).unwrap();
    let own = reduced(mesh, 2);
    assert_eq!(own.way(), ReductionWay::SectorAndBolts);
    let [a, b] = [&own, &whole].map(|gear| gear.lowest_elastic_hz().unwrap());
    assert!((a / b - 1.0).abs() < 1e-9, "{a} and {b} Hz");
    for first in [0, 11] {
        let stress = [&own, &whole].map(|gear| {
            let window = gear.window(first).unwrap();
            let node = window.reduced.nodes[3];
            let forces: Vec<f64> = (0..window.reduced.coordinates()).map(|i| (0.7 * i as f64).sin()).collect();
            gear.stress_modes(&window, &[node]).unwrap().stress_under(&forces).unwrap()[0]
        });
        let most = stress[1].iter().fold(0.0, |most: f64, s| most.max(s.abs()));
        let off = (0..6).map(|k| (stress[0][k] - stress[1][k]).abs()).fold(0.0, f64::max) / most;
        println!("{a} Hz, {b} Hz; {stress:?} MPa");
        assert!(off < 1e-8, "stress off by {off:e}");
    }
}

/// Bolts hold a gear against what loads it: their forces and those on its flanks are in balance.
#[test]
fn forces_of_bolts_balance_those_on_the_flanks() {
    let mesh = bolted(meshed(&ring(), 2, Extent::Whole), [0.0; 3], BOLTS);
    let reducer = reduced(mesh, 2);
    let window = reducer.window(5).unwrap();
    let found = reducer.bolts_and_flanks(&window).unwrap();
    let nodes = &reducer.gear().mesh().nodes;
    for (at, &node) in window.reduced.nodes.iter().enumerate().step_by(7) {
        let [x, y, _] = nodes[node as usize];
        for axis in 0..3 {
            let forces = found.springs.col(3 * at + axis);
            // The ring is pressed inwards: the radial force of a bolt is along -e_r.
            let of = |bolt: usize| {
                let angle = BOLTS.first_angle + TAU * bolt as f64 / 6.0;
                let [radial, along, axial] = [0, 1, 2].map(|k| forces[3 * bolt + k]);
                let (sin, cos) = angle.sin_cos();
                [-radial * cos - along * sin, -radial * sin + along * cos, axial, along * 80.0]
            };
            let sums: [f64; 4] = std::array::from_fn(|k| (0..6).map(|bolt| of(bolt)[k]).sum());
            let unit = |k: usize| f64::from(u8::from(k == axis));
            let moment = x * unit(1) - y * unit(0);
            println!("{node} along {axis}: {sums:?}, moment {moment}");
            assert!((sums[2] + unit(2)).abs() < 1e-9, "{sums:?}");
            // A bolt's forces are along the circle, not along its chord, over its width.
            assert!((sums[0] + unit(0)).abs() < 0.02 && (sums[1] + unit(1)).abs() < 0.02, "{sums:?}");
            assert!((sums[3] + moment).abs() < 0.02 * 80.0, "{sums:?} beside {moment}");
        }
    }
}

/// Bolts are fixed to the gear: turned on by a pitch they hold the next tooth as they held this one.
#[test]
fn bolts_are_fixed_to_the_gear() {
    let exact = ring();
    let of = |pitches: u32, tooth: u32| {
        let turn = TAU / 40.0 * f64::from(pitches);
        // Teeth of a ring count clockwise.
        let bolts = Bolts { first_angle: BOLTS.first_angle - turn, ..BOLTS };
        let reducer = reduced(bolted(meshed(&exact, 2, Extent::Whole), [0.0; 3], bolts), 1);
        let window = reducer.window(tooth).unwrap();
        let nodes = &reducer.gear().mesh().nodes;
        let frame = TAU / 40.0 * f64::from(tooth);
        let at = |n: &u32| {
            let [x, y, z] = nodes[*n as usize];
            [frame.cos() * x - frame.sin() * y, frame.sin() * x + frame.cos() * y, z]
        };
        // A force along the tooth's own axis at every node of its flank, and how far its nodes go.
        let places: Vec<[f64; 3]> = window.reduced.nodes.iter().map(at).collect();
        let along = [frame.cos(), -frame.sin(), 0.0];
        let c = window.reduced.compliance();
        let n = c.nrows();
        (places, (0..n).map(|i| (0..n).map(|j| along[i % 3] * c[(i, j)] * along[j % 3]).sum::<f64>()).sum::<f64>())
    };
    let [(a, first), (b, same), (_, other)] = [of(0, 3), of(1, 4), of(0, 4)];
    assert_eq!(a.len(), b.len());
    println!("{first:.6e}, turned on {same:.6e}, the tooth beside {other:.6e} mm/N");
    assert!((same / first - 1.0).abs() < 1e-9, "{first:e}, {same:e}");
    assert!((other / first - 1.0).abs() > 1e-4, "{first:e}, {other:e}");
}

/// Bolts side by side all around are springs all around.
#[test]
fn bolts_side_by_side_are_springs_all_around() {
    let exact = ring();
    let stiffness = [3e3, 1e3, 5e2];
    let (width, height) = (TAU * 80.0 / 60.0, 8.0);
    let stiffnesses = stiffness.map(|k| k * width * height);
    let bolts = Bolts { count: 60, first_angle: 0.1, width, heights: None, stiffness: stiffnesses, opens_beyond: None };
    let c = |foundation: Foundation| {
        let mesh = meshed(&exact, 2, Extent::Whole).coupled(BoreCoupling::Elastic(foundation));
        reduced(mesh, 2).window(0).unwrap().reduced.compliance().clone()
    };
    let all_around = c(Foundation::new(stiffness, None).unwrap());
    let off = (&c(Foundation::new([0.0; 3], Some(bolts)).unwrap()) - &all_around).norm_max() / all_around.norm_max();
    println!("off by {off:.1e}");
    // Chords are shorter than the circle by a thousandth.
    assert!(off < 3e-3, "{off:e}");
}

/// What bolts cannot hold, or have no bore for, is refused.
#[test]
fn bolts_that_hold_nothing_are_refused() {
    let error = Foundation::new([0.0; 3], Some(Bolts { count: 2, ..BOLTS })).unwrap_err();
    assert!(matches!(error, MeshError::FewBolts { count: 2, .. }) && error.hint().is_some(), "{error}");
    assert!(Foundation::new([0.0, 1.0, 1.0], Some(Bolts { count: 1, ..BOLTS })).is_ok());
    let error = Foundation::new([0.0; 3], Some(Bolts { stiffness: [1.0, 1.0, 0.0], ..BOLTS })).unwrap_err();
    assert!(matches!(error, MeshError::FreeBore { .. }), "{error}");
    // Sixty of a sixtieth of the bore have room, sixty-one have none.
    let crowd = Bolts { count: 61, width: TAU * 80.0 / 60.0, ..BOLTS };
    let high = Bolts { heights: Some([2.0, 9.0]), ..BOLTS };
    for (extent, bolts) in [(Extent::Whole, high), (Extent::Whole, crowd), (Extent::Sector(5), BOLTS)] {
        let mesh = bolted(meshed(&ring(), 2, extent), [0.0; 3], bolts);
        let error = GearReducer::new(mesh, Material::STEEL, options(&[Side::Left], 1, 0)).unwrap_err();
        assert!(matches!(&error, ReductionError::Bore { .. }) && error.hint().is_some(), "{error}");
    }
}
