//! Parts of a gear: by group names, by fit, and what the checks say about them.

use std::path::PathBuf;

use geometry::{Gear, GearData, Side};
use mesh::{
    FindingKind, FlankFit, GroupNames, Mesh, MeshError, MeshInfo, MeshReport, MeshedGear, Severity, SurfaceGroup,
};

/// Meshes that the repository's own script makes with Gmsh.
fn repository_mesh(name: &str) -> Mesh {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../meshes").join(name);
    Mesh::read(path).unwrap_or_else(|e| panic!("{e}"))
}

fn gear(change: impl FnOnce(&mut GearData)) -> Gear {
    let mut data = GearData { bore_diameter: 60.0, ..GearData::default() };
    change(&mut data);
    Gear::new(data).unwrap()
}

/// The pinion of `meshes/`: the default pair.
fn pinion() -> Gear {
    gear(|d| d.thickness_allowance = 0.05)
}

fn tolerance(gear: &Gear) -> f64 {
    mesh::DEFAULT_TOLERANCE_MODULES * gear.data().normal_module
}

#[test]
fn a_sector_by_its_groups() {
    for name in ["sector3_hex20.msh", "sector3_hex27.msh", "sector3_tet10.msh", "sector3_wedge15.msh"] {
        let found = MeshedGear::from_groups(repository_mesh(name), &GroupNames::default(), 30).unwrap();
        assert_eq!(found.teeth(), [0, 1, 29], "{name}");
        assert!(!found.is_whole_gear(), "{name}");
        assert!(found.cuts().is_some(), "{name}");
        for &node in found.bore_nodes() {
            let x = found.mesh().nodes[node as usize];
            assert!((x[0].hypot(x[1]) - 30.0).abs() < 1e-6, "{name}: bore");
        }
    }
}

/// Faces of flanks lie on the helicoid of their tooth and look out of it.
#[test]
fn named_flanks_lie_on_the_exact_flanks() {
    let gear = pinion();
    for name in ["sector3_hex8_v22_binary.msh", "sector3_hex20.msh", "sector3_tet4.msh", "periodic_hex20.msh"] {
        let found = MeshedGear::from_groups(repository_mesh(name), &GroupNames::default(), 30).unwrap();
        for tooth in found.teeth() {
            for side in [Side::Left, Side::Right] {
                let exact = gear.flank_of(side, i64::from(tooth));
                for face in found.flank(tooth, side).unwrap() {
                    let at: Vec<_> =
                        face.corners().iter().map(|&n| geometry::Vec3::from(found.mesh().nodes[n as usize])).collect();
                    let foot = exact.locate(&at[0]).unwrap();
                    assert!(foot.distance.abs() < 1e-3, "{name} tooth {tooth} {side:?}: {} mm off", foot.distance);
                    let normal = (at[1] - at[0]).cross(&(at[2] - at[0]));
                    assert!(normal.dot(&exact.normal(foot.roll, foot.z)) > 0.0, "{name} tooth {tooth} {side:?}");
                }
            }
        }
    }
}

/// Names are taken where there are any, the fit where there are none.
#[test]
fn names_first_then_the_fit() {
    let gear = pinion();
    let mesh = repository_mesh("sector3_hex20.msh");
    assert!(MeshedGear::find(mesh.clone(), &gear, &GroupNames::default()).unwrap().1.is_none());
    let mut bare = mesh;
    bare.surfaces.retain(|s| !s.name.starts_with("flank"));
    let (found, fit) = MeshedGear::find(bare, &gear, &GroupNames::default()).unwrap();
    assert_eq!(found.teeth(), [0, 1, 29]);
    assert_eq!(fit.unwrap().flanks.len(), 6);
    assert!(found.cuts().is_some());
}

/// Faces found without names are those found with them.
#[test]
fn the_fit_finds_what_the_names_say() {
    let gear = pinion();
    for name in ["sector3_hex8_v41_ascii.msh", "sector3_hex20.msh", "sector3_tet10.msh", "sector3_wedge6.msh"] {
        let named = MeshedGear::from_groups(repository_mesh(name), &GroupNames::default(), 30).unwrap();
        let mut bare = repository_mesh(name);
        bare.surfaces.clear();
        let fit = FlankFit::new(bare, &gear, &GroupNames::default(), tolerance(&gear)).unwrap();
        assert_eq!(fit.phase, 0.0, "{name}");
        assert!(fit.largest_deviation() < 2e-3, "{name}: {} mm", fit.largest_deviation());
        assert_eq!(fit.gear.teeth(), named.teeth(), "{name}");
        assert_eq!(fit.gear.bore_nodes(), named.bore_nodes(), "{name}");
        for tooth in named.teeth() {
            for side in [Side::Left, Side::Right] {
                let keys = |faces: &[mesh::Face]| {
                    let mut keys: Vec<_> = faces.iter().map(mesh::Face::corner_key).collect();
                    keys.sort_unstable();
                    keys
                };
                let (a, b) = (fit.gear.flank(tooth, side).unwrap(), named.flank(tooth, side).unwrap());
                assert_eq!(keys(a), keys(b), "{name} tooth {tooth} {side:?}");
            }
        }
    }
}

fn turned(mesh: &Mesh, angle: f64) -> Mesh {
    let mut mesh = mesh.clone();
    mesh.surfaces.clear();
    let (sin, cos) = f64::sin_cos(angle);
    for x in &mut mesh.nodes {
        [x[0], x[1]] = [cos * x[0] - sin * x[1], sin * x[0] + cos * x[1]];
    }
    mesh
}

/// A mesh turned by any angle is found and turned back; by a pitch, its teeth are counted on.
#[test]
fn a_turned_mesh_is_turned_back() {
    let gear = pinion();
    let mesh = repository_mesh("sector3_hex20.msh");
    for part in [-0.49, -0.3, -0.01, 0.02, 0.25, 0.45] {
        let angle = part * gear.pitch_angle();
        let fit = FlankFit::new(turned(&mesh, angle), &gear, &GroupNames::default(), tolerance(&gear)).unwrap();
        assert!((fit.phase - angle).abs() < 1e-6, "{part}: {} rad, not {angle}", fit.phase);
        assert_eq!(fit.gear.teeth(), [0, 1, 29]);
        let back = fit.gear.mesh().nodes[77];
        assert!((0..3).all(|k| (back[k] - mesh.nodes[77][k]).abs() < 1e-4));
    }
    let on = turned(&mesh, 2.0 * gear.pitch_angle());
    let fit = FlankFit::new(on, &gear, &GroupNames::default(), tolerance(&gear)).unwrap();
    assert_eq!((fit.phase, fit.gear.teeth()), (0.0, vec![1, 2, 3]));
}

/// Wrong data are told apart and refused.
#[test]
fn another_gear_is_refused() {
    let bare = turned(&repository_mesh("sector3_hex20.msh"), 0.0);
    let error = |gear: &Gear, mesh: &Mesh| {
        let error = FlankFit::new(mesh.clone(), gear, &GroupNames::default(), tolerance(gear)).unwrap_err();
        assert!(error.hint().is_some());
        error
    };
    for wrong in [
        gear(|d| (d.thickness_allowance, d.helix_angle) = (0.05, -d.helix_angle)),
        gear(|d| (d.thickness_allowance, d.helix_angle) = (0.05, 0.9 * d.helix_angle)),
        gear(|d| (d.thickness_allowance, d.teeth) = (0.05, 31)),
        gear(|d| d.normal_module = 2.9),
    ] {
        let found = error(&wrong, &bare);
        assert!(matches!(found, MeshError::NoFlanks { .. } | MeshError::ToothThickness { .. }), "{found}");
    }
    let thick = error(&gear(|d| d.thickness_allowance = 0.25), &bare);
    assert!(matches!(thick, MeshError::ToothThickness { thicker_mm } if (thicker_mm - 0.2).abs() < 0.02), "{thick}");
    let found = error(&gear(|d| (d.thickness_allowance, d.bore_diameter) = (0.05, 40.0)), &bare);
    assert!(matches!(found, MeshError::NoBore { .. }), "{found}");
    let mut shifted = bare.clone();
    shifted.nodes.iter_mut().for_each(|x| x[2] += 10.0);
    let found = error(&pinion(), &shifted);
    assert!(matches!(found, MeshError::MidFace { z_mm } if (z_mm - 10.0).abs() < 1e-9), "{found}");
    let mut metres = bare;
    metres.nodes.iter_mut().flatten().for_each(|x| *x *= 1e-3);
    assert!(matches!(error(&pinion(), &metres), MeshError::NoFlanks { .. }));
}

#[test]
fn foreign_names_are_mapped() {
    let mut mesh = repository_mesh("sector3_hex20.msh");
    for group in &mut mesh.surfaces {
        group.name = group
            .name
            .replace("flank_left_", "Zahn ")
            .replace("flank_right_", "Flanke rechts (")
            .replace("bore", "Hub");
        if group.name.starts_with("Flanke") {
            group.name += ")";
        }
    }
    let names = GroupNames {
        bore: "Hub".into(),
        flank_left: "Zahn {k}".into(),
        flank_right: "Flanke rechts ({k})".into(),
        ..GroupNames::default()
    };
    let found = MeshedGear::from_groups(mesh.clone(), &names, 30).unwrap();
    assert_eq!(found.teeth(), [0, 1, 29]);

    let error = MeshedGear::from_groups(mesh.clone(), &GroupNames::default(), 30).unwrap_err();
    assert!(
        error.to_string().starts_with(
            "no physical group `bore`; the mesh has `Hub`, `cut_{k}` with k from 0 to 1, `Zahn {k}` with k from -1 to 1"
        ),
        "{error}"
    );
    let without = GroupNames { flank_left: "left".into(), ..names.clone() };
    assert!(matches!(MeshedGear::from_groups(mesh.clone(), &without, 30), Err(MeshError::NoToothNumber { .. })));
    // With two teeth -1 and 1 are the same tooth.
    let error = MeshedGear::from_groups(mesh, &names, 2).unwrap_err();
    assert!(matches!(error, MeshError::SameTooth { tooth: 1, teeth: 2, .. }), "{error}");
}

#[test]
fn faces_inside_the_body_are_refused() {
    let mut mesh = repository_mesh("sector3_hex20.msh");
    let kind = mesh.blocks[0].kind;
    let element: Vec<u32> = mesh.blocks[0].elements().nth(40).unwrap().to_vec();
    let inside = kind.faces().iter().map(|(kind, order)| {
        let nodes: Vec<u32> = order.iter().map(|&l| element[l]).collect();
        mesh::Face::new(*kind, &nodes)
    });
    let table = mesh::FaceTable::new(&mesh);
    let inside = inside.into_iter().find(|f| table.owners(f.corner_key()).len() == 2).unwrap();
    let bore = mesh.surfaces.iter_mut().find(|s| s.name == "bore").unwrap();
    bore.faces.push(inside);
    let error = MeshedGear::from_groups(mesh.clone(), &GroupNames::default(), 30).unwrap_err();
    assert!(
        error.to_string().contains("group `bore`") && error.to_string().contains("lies inside the body"),
        "{error}"
    );
    let report = MeshReport::new(&mesh);
    assert_eq!(report.of(FindingKind::NotOnBoundary).count(), 1);
}

/// Orientation in the file does not matter.
#[test]
fn turned_faces_are_turned_back() {
    let mesh = repository_mesh("sector3_hex20.msh");
    let mut other = mesh.clone();
    for group in &mut other.surfaces {
        group.faces.iter_mut().for_each(|f| *f = f.reversed());
    }
    let [a, b] = [mesh, other].map(|m| MeshedGear::from_groups(m, &GroupNames::default(), 30).unwrap());
    assert_eq!(a.bore(), b.bore());
    assert_eq!(a.flank(29, Side::Right), b.flank(29, Side::Right));
}

#[test]
fn information_about_a_gear() {
    let info = MeshInfo::new(&repository_mesh("sector3_hex20.msh"));
    assert_eq!(info.gear.teeth, Some(30));
    assert_eq!(info.gear.named_teeth, 3);
    assert!((info.gear.bore_radius.unwrap() - 30.0).abs() < 1e-6);
    assert!((info.gear.face_width - 20.0).abs() < 1e-9);
    assert!((info.gear.tip_radius - pinion().tip_radius()).abs() < 1e-6);
    assert!(info.gear.angle_deg > 36.0 && info.gear.angle_deg < 60.0, "{}", info.gear.angle_deg);
    assert_eq!(MeshInfo::new(&repository_mesh("periodic_hex8.msh")).gear.teeth, Some(30));
    let bore = info.surfaces.iter().find(|s| s.name == "bore").unwrap();
    let expected = 30.0 * 36.0_f64.to_radians() * 20.0;
    assert!((bore.area - expected).abs() < 2e-3 * expected, "{} mm^2, not {expected}", bore.area);
}

/// Flanks that nobody has named: tips tell how many teeth there are, of a whole gear and of a sector, and the rim of a
/// ring has none.
#[test]
fn tips_tell_how_many_teeth_there_are() {
    for (name, teeth) in [("tutorial_pinion.msh", 23), ("sector3_hex20.msh", 30), ("coarse_hex8_pinion.msh", 30)] {
        let mut mesh = repository_mesh(name);
        mesh.surfaces.clear();
        assert_eq!(MeshInfo::new(&mesh).gear.teeth, Some(teeth), "{name}");
        // Its outside in, as that of a ring: the bore, now outside, is smooth.
        mesh.nodes.iter_mut().for_each(|x| {
            let scale = 1e3 / (x[0] * x[0] + x[1] * x[1]);
            [x[0], x[1]] = [scale * x[0], scale * x[1]];
        });
        assert_eq!(MeshInfo::new(&mesh).gear.teeth, None, "{name}");
    }
}

#[test]
fn a_sound_mesh_has_no_findings() {
    for name in ["sector3_hex8_v22_ascii.msh", "sector3_hex20.msh", "periodic_hex8.msh", "periodic_hex20.msh"] {
        let report = MeshReport::of_gear(&repository_mesh(name), &GroupNames::default(), Some(30));
        assert!(report.findings.is_empty(), "{name}: {report:#?}");
    }
}

/// Exactly the fault put in is found, with the tag of the element or node.
#[test]
fn each_fault_is_found() {
    let sound = repository_mesh("periodic_hex8.msh");
    let check = |mesh: &Mesh| MeshReport::of_gear(mesh, &GroupNames::default(), Some(30));
    let one = |mesh: &Mesh, kind: FindingKind, severity: Severity| {
        let report = check(mesh);
        let found: Vec<_> = report.of(kind).cloned().collect();
        assert_eq!(found.len(), 1, "{kind:?}: {report:#?}");
        assert_eq!(found[0].severity, severity, "{kind:?}");
        found[0].clone()
    };

    let mut mesh = sound.clone();
    mesh.blocks[0].connectivity[8 * 17..8 * 18].swap(0, 6);
    let found = one(&mesh, FindingKind::Inverted, Severity::Error);
    assert!(found.elements.contains(&mesh.blocks[0].tags[17]), "{found:?}");

    let mut mesh = sound.clone();
    mesh.nodes.push([40.0, 0.0, 0.0]);
    mesh.node_tags.push(4711);
    assert_eq!(one(&mesh, FindingKind::OrphanNodes, Severity::Error).nodes, [4711]);

    // A second copy of everything: every node double, two bodies.
    let mut mesh = sound.clone();
    let count = mesh.nodes.len() as u32;
    mesh.nodes.extend_from_within(..);
    mesh.node_tags.extend((1_u64..).take(count as usize).map(|t| t + 100_000));
    let copy: Vec<u32> = mesh.blocks[0].connectivity.iter().map(|n| n + count).collect();
    mesh.blocks[0].connectivity.extend(copy);
    mesh.blocks[0].tags.extend_from_within(..);
    assert_eq!(one(&mesh, FindingKind::DoubleNodes, Severity::Warning).count, count as usize);
    assert_eq!(one(&mesh, FindingKind::Disconnected, Severity::Error).count, 2);

    // The same element thrice.
    let mut mesh = sound.clone();
    for _ in 0..2 {
        mesh.blocks[0].connectivity.extend_from_within(..8);
        mesh.blocks[0].tags.extend_from_within(..1);
    }
    assert_eq!(one(&mesh, FindingKind::CrowdedFaces, Severity::Error).elements[0], mesh.blocks[0].tags[0]);

    let mut mesh = sound.clone();
    mesh.surfaces.retain(|s: &SurfaceGroup| s.name != "bore" && s.name != "cut_1");
    assert_eq!(check(&mesh).of(FindingKind::MissingGroup).count(), 2);

    for (factor, unit) in [(1e-3, "metres"), (1.0 / 25.4, "inches"), (1e3, "micrometres")] {
        let mut mesh = sound.clone();
        mesh.nodes.iter_mut().flatten().for_each(|x| *x *= factor);
        assert!(one(&mesh, FindingKind::Units, Severity::Warning).text.contains(unit), "{unit}");
    }

    let mut mesh = sound.clone();
    let node = mesh.surface("cut_1").unwrap().nodes()[5];
    mesh.nodes[node as usize][2] += 1e-5;
    let found = one(&mesh, FindingKind::CutsDiffer, Severity::Error);
    assert!(found.count == 1 && found.text.contains("1.000e-5 mm apart"), "{found:?}");

    let mut mesh = sound;
    mesh.nodes.iter_mut().for_each(|x| x[1] += 3.0);
    one(&mesh, FindingKind::BoreNotRound, Severity::Warning);
}

/// A pinion in one with its part of the shaft: the end of the stub is its bore, mid-face is where the flanks have it,
/// and nothing is to be remarked on. Held area and means are those of the annulus.
#[test]
fn a_gear_in_one_with_its_shaft() {
    let mesh = repository_mesh("hub_and_shaft_hex20.msh");
    let report = MeshReport::of_gear(&mesh, &GroupNames::default(), Some(21));
    assert!(report.findings.is_empty(), "{:?}", report.findings);
    let mut moved = mesh.clone();
    moved.nodes.iter_mut().for_each(|x| x[2] += 15.0);
    let findings = MeshReport::of_gear(&moved, &GroupNames::default(), Some(21)).findings;
    assert!(matches!(&findings[..], [f] if f.kind == FindingKind::MidFace && f.text.contains("15.0")), "{findings:?}");
    let found = MeshedGear::from_groups(mesh, &GroupNames::default(), 21).unwrap().whole().unwrap();
    let weights = found.bore_weights();
    let area: f64 = weights.iter().map(|w| w.1).sum();
    let exact = std::f64::consts::PI * (22.5f64.powi(2) - 8.0f64.powi(2));
    // Quadratic edges on a circle of 126 elements.
    assert!((area / exact - 1.0).abs() < 1e-6, "{area} beside {exact} mm^2");
    let mean = |axis: usize| weights.iter().map(|&(n, w)| w * found.mesh().nodes[n as usize][axis]).sum::<f64>() / area;
    assert!(mean(0).abs() < 1e-9 && mean(1).abs() < 1e-9 && (mean(2) + 30.0).abs() < 1e-9, "centroid");
}

/// A part of the bore: the faces between two heights, of copies of a sector as well.
#[test]
fn a_bore_held_on_a_part_of_its_width() {
    let sector = || MeshedGear::from_groups(repository_mesh("periodic_hex20.msh"), &GroupNames::default(), 30).unwrap();
    let area = |gear: &MeshedGear| gear.bore_weights().iter().map(|w| w.1).sum::<f64>();
    let all = area(&sector().whole().unwrap());
    let part = sector().held_between([-10.0, 0.0]).unwrap();
    let (share, nodes) = (area(&part.clone().whole().unwrap()) / all, part.bore_nodes());
    assert!(share > 0.2 && share < 0.8, "{share} of the bore");
    assert!(nodes.iter().all(|&n| part.mesh().nodes[n as usize][2] <= 1e-6), "held above z = 0");
    assert_eq!(sector(), sector().held_between([-10.0, 10.0]).unwrap(), "all of it");
    let error = sector().held_between([20.0, 30.0]).unwrap_err();
    assert!(matches!(error, MeshError::NotHeld { .. }) && error.to_string().contains("-10.0000"), "{error}");
}
