//! Laws of the structured mesher, judged on the finished mesh.

use std::collections::{HashMap, HashSet};

use crate::measure::{tooth_area, volume_and_least_jacobian};
use geometry::{Gear, GearData, Side, Vec3};
use mesh::{
    Extent, GroupNames, Mesh, MeshReport, MeshedGear, MshFormat, Severity, StructuredError, StructuredOptions, generate,
};

fn default_gear() -> Gear {
    Gear::new(GearData::default()).expect("the default pinion is sound")
}

fn small(order: u32, extent: Extent) -> StructuredOptions {
    StructuredOptions {
        order,
        elements_profile: 4,
        elements_fillet: 3,
        elements_thickness: 3,
        elements_face: 4,
        elements_rim: 3,
        extent,
    }
}

/// Volume = section area times face width (a twist keeps volume); the miss falls with h^2 for hex8 and h^3 for hex20
/// (curvature jumps where the fillet runs into the root circle, inside an element).
#[test]
fn volume_converges_to_area_times_width_at_the_elements_order() {
    let gear = default_gear();
    let exact = tooth_area(&gear) * gear.face_width();
    for (order, rate) in [(1, 3.5), (2, 7.0)] {
        let miss = |n: u32| {
            let options = StructuredOptions {
                order,
                elements_profile: 3 * n,
                elements_fillet: 6 * n,
                elements_thickness: 2 * n,
                elements_face: 2 * n,
                elements_rim: 2 * n,
                extent: Extent::Periodic,
            };
            let (volume, _) = volume_and_least_jacobian(&generate(&gear, &options).expect("meshes"));
            (volume / exact - 1.0).abs()
        };
        let (coarse, fine) = (miss(1), miss(2));
        assert!(fine < coarse / rate, "order {order}: {coarse:e}, then {fine:e}");
        assert!(fine < if order == 1 { 1e-3 } else { 1e-5 }, "order {order}: {fine:e}");
    }
}

/// Every gear of the ranges is either meshed soundly or refused with a reason.
#[test]
fn jacobians_are_positive_over_the_ranges() {
    let (mut meshed, mut refused) = (0, 0);
    for teeth in [8, 10, 13, 17, 25, 60, 200] {
        for shift in [-0.5, -0.2, 0.0, 0.3, 0.6, 1.0] {
            for helix in [0.0f64, 10.0, -20.0, 30.0, 45.0] {
                for rim in [0.5, 1.5, 4.0, 20.0] {
                    let root = 3.0 * (0.5 * f64::from(teeth) / helix.to_radians().cos() + shift - 1.25);
                    let data = GearData {
                        teeth,
                        helix_angle: helix.to_radians(),
                        profile_shift: shift,
                        bore_diameter: 2.0 * (root - 3.0 * rim).max(0.3 * root),
                        ..GearData::default()
                    };
                    let Ok(gear) = Gear::new(data) else {
                        refused += 1;
                        continue;
                    };
                    for order in [1, 2] {
                        match generate(&gear, &small(order, Extent::Periodic)) {
                            Ok(mesh) => {
                                let (_, least) = volume_and_least_jacobian(&mesh);
                                assert!(least > 0.0, "z {teeth} x {shift} beta {helix} rim {rim}: det J {least}");
                                meshed += 1;
                            }
                            Err(error) => {
                                panic!("z {teeth} x {shift} beta {helix} rim {rim} m_n: {error}")
                            }
                        }
                    }
                }
            }
        }
    }
    // a pointed tooth is the only reason for which the geometry refuses any of these
    assert!(meshed > 8 * refused, "{meshed} meshed, {refused} refused");
}

#[test]
fn flank_nodes_lie_on_the_helicoid() {
    for data in [
        GearData::default(),
        GearData { teeth: 9, profile_shift: 0.4, helix_angle: -0.5, bore_diameter: 10.0, ..GearData::default() },
        GearData { teeth: 150, helix_angle: 0.3, bore_diameter: 400.0, ..GearData::default() },
    ] {
        let gear = Gear::new(data).expect("sound data");
        for order in [1, 2] {
            let mesh = generate(&gear, &small(order, Extent::Sector(3))).expect("meshes");
            for side in [Side::Left, Side::Right] {
                for tooth in -1..=1 {
                    let group = mesh.surface(&format!("flank_{}_{tooth}", side.name())).expect("group");
                    assert_eq!(group.faces.len(), 4 * 4);
                    let flank = gear.flank_of(side, tooth);
                    for node in group.nodes() {
                        let point = Vec3::from(mesh.nodes[node as usize]);
                        let foot = flank.locate(&point).expect("above the base circle");
                        assert!(foot.distance.abs() < 1e-12 * point.norm().max(1.0), "{:e} mm off", foot.distance);
                        assert!(foot.roll > flank.roll_form - 1e-6 && foot.roll < flank.roll_tip + 1e-12);
                    }
                }
            }
        }
    }
}

/// Faces of every group look outwards: the flank's along its normal, the bore's towards the axis, the sides' along z.
#[test]
fn boundary_faces_look_outwards() {
    let gear = default_gear();
    let mesh = generate(&gear, &small(2, Extent::Periodic)).expect("meshes");
    for group in &mesh.surfaces {
        for face in &group.faces {
            let corner = |i: usize| Vec3::from(mesh.nodes[face.nodes()[i] as usize]);
            let normal = (corner(2) - corner(0)).cross(&(corner(3) - corner(1)));
            let middle = 0.25 * (corner(0) + corner(1) + corner(2) + corner(3));
            let around = Vec3::new(-middle.y, middle.x, 0.0);
            let outwards = match group.name.as_str() {
                "bore" => Vec3::new(-middle.x, -middle.y, 0.0),
                "side_front" => Vec3::z(),
                "side_back" => -Vec3::z(),
                "cut_1" | "flank_left_0" => around,
                "cut_0" | "flank_right_0" => -around,
                other => panic!("unexpected group {other}"),
            };
            assert!(normal.dot(&outwards) > 0.0, "{}: {normal:?}", group.name);
        }
    }
}

#[test]
fn periodic_cuts_match_by_rotation() {
    let gear = default_gear();
    for order in [1, 2] {
        let mesh = generate(&gear, &small(order, Extent::Periodic)).expect("meshes");
        let points = |name: &str| -> Vec<Vec3> {
            mesh.surface(name).expect("cut").nodes().iter().map(|&n| mesh.nodes[n as usize].into()).collect()
        };
        let turn = nalgebra::Rotation3::from_axis_angle(&Vec3::z_axis(), gear.pitch_angle());
        let (from, to) = (points("cut_0"), points("cut_1"));
        assert_eq!(from.len(), to.len());
        for p in from {
            let nearest = to.iter().map(|q| (turn * p - q).norm()).fold(f64::INFINITY, f64::min);
            assert!(nearest < 1e-12 * gear.tip_radius(), "{nearest:e}");
        }
    }
}

/// Whole gear: z teeth of l layers of sections; a section has (t+1)(p+f_1) + (r+1)(t+2 f_2) nodes, f_1 + f_2 = f.
#[test]
fn node_and_element_counts_follow_the_formula() {
    let gear = default_gear();
    let options = small(1, Extent::Whole);
    let mesh = generate(&gear, &options).expect("meshes");
    let [p, f, t, n, r] = [4, 3, 3, 4, 3];
    let fits = |f1: usize| {
        let (nodes, cells) = ((t + 1) * (p + f1) + (r + 1) * (t + 2 * (f - f1)), t * (p + f1) + r * (t + 2 * (f - f1)));
        mesh.nodes.len() == 30 * (n + 1) * nodes && mesh.element_count() == 30 * n * cells
    };
    assert!((1..f).any(fits), "{} nodes, {} elements", mesh.nodes.len(), mesh.element_count());
    assert_eq!(mesh.surfaces.len(), 2 * 30 + 3);

    // hex20 by Euler: nodes = corners + edges of the hex8 mesh with the same counts
    let mut edges = HashSet::new();
    for element in mesh.blocks[0].elements() {
        for &[a, b] in mesh.blocks[0].kind.edges() {
            edges.insert((element[a].min(element[b]), element[a].max(element[b])));
        }
    }
    let quadratic = generate(&gear, &small(2, Extent::Whole)).expect("meshes");
    assert_eq!(quadratic.nodes.len(), mesh.nodes.len() + edges.len());
    assert_eq!(quadratic.element_count(), mesh.element_count());
}

/// Every node is used, and no two lie in one place.
#[test]
fn nodes_are_used_and_distinct() {
    for extent in [Extent::Whole, Extent::Periodic, Extent::Sector(4)] {
        for order in [1, 2] {
            let mesh = generate(&default_gear(), &small(order, extent)).expect("meshes");
            let mut used = vec![false; mesh.nodes.len()];
            mesh.blocks[0].connectivity.iter().for_each(|&n| used[n as usize] = true);
            assert!(used.iter().all(|&u| u), "{extent:?}, order {order}");
            let mut places = HashSet::new();
            for p in &mesh.nodes {
                assert!(places.insert(p.map(|c| (c * 1e6).round() as i64)), "{extent:?}, order {order}: two at {p:?}");
            }
        }
    }
}

/// Each tooth of the whole gear is the periodic sector turned; the sector's nodes are found in it bit for bit.
#[test]
fn periodic_sector_is_part_of_the_whole() {
    let gear = default_gear();
    let key = |p: &[f64; 3]| p.map(|c| (c * 1e9).round() as i64);
    for order in [1, 2] {
        let whole = generate(&gear, &small(order, Extent::Whole)).expect("meshes");
        let sector = generate(&gear, &small(order, Extent::Periodic)).expect("meshes");
        let places: HashMap<_, u32> = whole.nodes.iter().zip(0..).map(|(p, i)| (key(p), i)).collect();
        let elements: HashSet<&[u32]> = whole.blocks[0].elements().collect();
        for element in sector.blocks[0].elements() {
            let there: Vec<u32> = element.iter().map(|&n| places[&key(&sector.nodes[n as usize])]).collect();
            assert!(elements.contains(there.as_slice()));
        }
        let (one, all) = (volume_and_least_jacobian(&sector).0, volume_and_least_jacobian(&whole).0);
        assert!((all / (30.0 * one) - 1.0).abs() < 1e-12);
    }
}

/// What is generated survives the file: the reader's own checks find nothing to complain of.
#[test]
fn generated_mesh_survives_a_msh_file() {
    let mesh = generate(&default_gear(), &small(2, Extent::Sector(2))).expect("meshes");
    for format in MshFormat::ALL {
        let bytes = mesh.to_msh(format).expect("writes");
        assert_eq!(Mesh::parse(&bytes, "generated.msh").expect("reads"), mesh);
    }
}

/// The mesh checker knows the groups and has nothing worse than a remark to make.
#[test]
fn generated_mesh_passes_the_mesh_checks() {
    for extent in [Extent::Whole, Extent::Periodic, Extent::Sector(3)] {
        let mesh = generate(&default_gear(), &small(2, extent)).expect("meshes");
        let report = MeshReport::of_gear(&mesh, &GroupNames::default(), Some(30));
        assert!(report.worst().is_none_or(|worst| worst < Severity::Warning), "{report:?}");
        let gear = MeshedGear::from_groups(mesh, &GroupNames::default(), 30).expect("groups are found");
        assert_eq!(gear.is_whole_gear(), extent == Extent::Whole);
        assert_eq!(gear.cuts().is_some(), extent != Extent::Whole);
    }
}

#[test]
fn senseless_requests_are_refused_with_a_hint() {
    let gear = default_gear();
    let fine = small(1, Extent::Whole);
    let thin = Gear::new(GearData { bore_diameter: 88.2, ..GearData::default() }).expect("bore below the root circle");
    let cases = [
        (&gear, StructuredOptions { order: 3, ..fine }, "order"),
        (&gear, StructuredOptions { elements_fillet: 1, ..fine }, "elements_fillet"),
        (&gear, StructuredOptions { elements_face: 0, ..fine }, "elements_face"),
        (&gear, StructuredOptions { extent: Extent::Sector(0), ..fine }, "sector"),
        (&gear, StructuredOptions { extent: Extent::Sector(30), ..fine }, "sector"),
        (&gear, StructuredOptions { elements_face: 10_000, elements_profile: 10_000, ..fine }, "nodes"),
        (&thin, fine, "rim"),
    ];
    for (gear, options, word) in cases {
        let error: StructuredError = generate(gear, &options).map(|m| m.nodes.len()).expect_err(word);
        assert!(error.to_string().contains(word), "{error}");
        assert!(error.hint().is_some());
    }
    // one layer over a steep helix of 300 mm would be wrung out; the error says how many suffice
    let long = Gear::new(GearData { face_width: 300.0, helix_angle: 0.7, ..GearData::default() }).expect("sound");
    match generate(&long, &StructuredOptions { elements_face: 1, ..fine }) {
        Err(StructuredError::Twist { least, .. }) => {
            let enough = StructuredOptions { elements_face: least, extent: Extent::Periodic, ..fine };
            assert!(generate(&long, &enough).is_ok());
        }
        other => panic!("{:?}", other.map(|m| m.nodes.len())),
    }
}

proptest::proptest! {
    #![proptest_config(proptest::test_runner::Config::with_cases(400))]

    /// Whatever the gear and the counts: sound elements or an error, never a panic.
    #[test]
    fn any_gear_is_meshed_soundly_or_refused(
        teeth in 5u32..300, helix in -1.04f64..1.04, pressure in 0.1f64..0.7, shift in -2.0f64..2.5,
        addendum in 0.3f64..2.0, dedendum in 0.5f64..2.5, rounding in 0.05f64..0.6, bore in 0.05f64..1.0,
        width in 1.0f64..80.0, counts in [1u32..5, 2u32..5, 1u32..5, 1u32..5, 1u32..5], order in 1u32..3,
    ) {
        let data = GearData {
            teeth, helix_angle: helix, normal_pressure_angle: pressure, profile_shift: shift, face_width: width,
            addendum_coefficient: addendum, dedendum_coefficient: dedendum, root_radius_coefficient: rounding,
            bore_diameter: bore * 3.0 * f64::from(teeth) / helix.cos(), ..GearData::default()
        };
        let [elements_profile, elements_fillet, elements_thickness, elements_face, elements_rim] = counts;
        let options = StructuredOptions {
            order, elements_profile, elements_fillet, elements_thickness, elements_face, elements_rim,
            extent: Extent::Periodic,
        };
        if let Ok(gear) = Gear::new(data) {
            match generate(&gear, &options) {
                Ok(mesh) => proptest::prop_assert!(volume_and_least_jacobian(&mesh).1 > 0.0),
                Err(error) => proptest::prop_assert!(error.hint().is_some()),
            }
        }
    }
}
