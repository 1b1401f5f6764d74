//! From a sector of one tooth to the whole gear.

use std::collections::HashMap;
use std::f64::consts::TAU;
use std::path::PathBuf;

use geometry::{Gear, GearData, Side};
use mesh::{
    Extent, FaceTable, GroupNames, Mesh, MeshError, MeshInfo, MeshReport, MeshedGear, Severity, StructuredOptions,
    generate,
};

fn gear() -> Gear {
    Gear::new(GearData { bore_diameter: 60.0, ..GearData::default() }).expect("default gear")
}

fn options(order: u32, extent: Extent) -> StructuredOptions {
    StructuredOptions {
        order,
        elements_profile: 4,
        elements_fillet: 3,
        elements_thickness: 3,
        elements_face: 2,
        elements_rim: 2,
        extent,
    }
}

fn generated(order: u32, extent: Extent) -> MeshedGear {
    parts(generate(&gear(), &options(order, extent)).expect("meshes"))
}

fn parts(mesh: Mesh) -> MeshedGear {
    MeshedGear::from_groups(mesh, &GroupNames::default(), 30).expect("groups are found")
}

fn file(name: &str) -> Mesh {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../meshes").join(name);
    Mesh::read(path).unwrap_or_else(|e| panic!("{e}"))
}

fn key(x: &[f64; 3]) -> [i64; 3] {
    x.map(|c| (c * 1e8).round() as i64)
}

/// Numbers in `b` of the nodes of `a`, by position; at most the few that round to another cell are searched for.
fn by_position(a: &Mesh, b: &Mesh) -> Vec<u32> {
    let places: HashMap<_, u32> = b.nodes.iter().map(key).zip(0..).collect();
    let search = |x: &[f64; 3]| {
        let near = |y: &[f64; 3]| (0..3).all(|k| (x[k] - y[k]).abs() < 1e-9 * 48.0);
        b.nodes.iter().position(near).unwrap_or_else(|| panic!("no node at {x:?}")) as u32
    };
    a.nodes.iter().map(|x| places.get(&key(x)).copied().unwrap_or_else(|| search(x))).collect()
}

/// Elements and faces of `group` in the numbers `numbers`, sorted.
fn sorted<'a>(items: impl Iterator<Item = &'a [u32]>, numbers: &[u32]) -> Vec<Vec<u32>> {
    let mut all: Vec<Vec<u32>> = items.map(|nodes| nodes.iter().map(|&n| numbers[n as usize]).collect()).collect();
    all.sort_unstable();
    all
}

/// `made` and `expected` have the same nodes, elements and groups up to order.
fn assert_same(made: &MeshedGear, expected: &MeshedGear) {
    let (m, e) = (made.mesh(), expected.mesh());
    assert_eq!(m.nodes.len(), e.nodes.len());
    let numbers = by_position(m, e);
    let mut each = numbers.clone();
    each.sort_unstable();
    each.dedup();
    assert_eq!(each.len(), e.nodes.len(), "every node once");
    let own: Vec<u32> = (0..e.nodes.len() as u32).collect();
    assert_eq!(m.blocks.len(), e.blocks.len());
    for (a, b) in m.blocks.iter().zip(&e.blocks) {
        assert_eq!(sorted(a.elements(), &numbers), sorted(b.elements(), &own));
    }
    let names = |mesh: &Mesh| mesh.surfaces.iter().map(|s| s.name.clone()).collect::<Vec<_>>();
    assert_eq!(names(m), names(e));
    for (a, b) in m.surfaces.iter().zip(&e.surfaces) {
        let faces = |of: &mesh::SurfaceGroup, numbers: &[u32]| {
            let mut all = sorted(of.faces.iter().map(mesh::Face::nodes), numbers);
            all.iter_mut().for_each(|face| face.sort_unstable());
            all.sort_unstable();
            all
        };
        assert_eq!(faces(a, &numbers), faces(b, &own), "{}", a.name);
    }
    let (volume, wanted) = (MeshInfo::new(m).volume, MeshInfo::new(e).volume);
    assert!((volume / wanted - 1.0).abs() < 1e-12, "{volume} {wanted}");
}

/// A turn by one pitch maps nodes on nodes, node n of copy k on node n of copy k + 1.
fn assert_cyclic(mesh: &Mesh, teeth: usize) {
    let (sin, cos) = (TAU / teeth as f64).sin_cos();
    let own = mesh.nodes.len() / teeth;
    let radius = mesh.nodes.iter().map(|x| x[0].hypot(x[1])).fold(0.0, f64::max);
    for (n, [x, y, z]) in mesh.nodes.iter().enumerate() {
        let next = mesh.nodes[(n + own) % mesh.nodes.len()];
        let turned = [cos * x - sin * y, sin * x + cos * y, *z];
        let off = (0..3).map(|k| (turned[k] - next[k]).abs()).fold(0.0, f64::max);
        assert!(off < 1e-14 * radius, "node {n}: {off:e} mm");
    }
}

/// A sector repeated is the gear meshed whole.
#[test]
fn a_repeated_sector_is_the_whole_gear() {
    for order in [1, 2] {
        let whole = generated(order, Extent::Periodic).whole().expect("cuts match");
        assert!(whole.is_whole_gear());
        assert_same(&whole, &generated(order, Extent::Whole));
        assert_cyclic(whole.mesh(), 30);
    }
}

/// Periodic meshes by Gmsh become the coarse gears: each periodic file is one tooth of a coarse one.
#[test]
fn periodic_files_become_the_coarse_gears() {
    for (sector, gear) in
        [("periodic_hex8.msh", "coarse_hex8_pinion.msh"), ("periodic_hex20.msh", "coarse_hex20_pinion.msh")]
    {
        let whole = parts(file(sector)).whole().expect("cuts match");
        assert!(whole.is_whole_gear(), "{sector}");
        assert_same(&whole, &parts(file(gear)));
        assert_cyclic(whole.mesh(), 30);
    }
}

/// Some of the copies: every node is its origin's place turned, cuts are where they were, and their nodes belong to the
/// next copy.
#[test]
fn some_copies_are_part_of_the_whole_gear() {
    let sector = generated(2, Extent::Periodic);
    let copies = sector.copies(28, 4).expect("cuts match");
    assert_eq!(copies.gear.teeth(), [0, 1, 28, 29]);
    assert!(!copies.gear.is_whole_gear() && copies.gear.cuts().is_some() && !copies.on_axis);
    let body = copies.gear.mesh();
    for (n, ([x, y, z], from)) in body.nodes.iter().zip(&copies.origins).enumerate() {
        let (sin, cos) = (std::f64::consts::TAU * f64::from(from.copy) / 30.0).sin_cos();
        let [a, b, c] = sector.mesh().nodes[from.node as usize];
        let off = (cos * a - sin * b - x).hypot(sin * a + cos * b - y).hypot(c - z);
        assert!(off < 1e-12, "node {n}: {off:e} mm");
        assert!(copies.cuts.iter().all(|pair| pair[1] != from.node), "node {n} is one of the second cut");
    }
    let own = sector.mesh().nodes.len() - copies.cuts.len();
    assert_eq!(body.nodes.len(), 4 * own + copies.cuts.len());
    // Nothing but cuts is new on the boundary.
    let report = MeshReport::of_gear(body, &GroupNames::default(), None);
    assert!(report.worst().is_none_or(|worst| worst < Severity::Error), "{report:?}");
}

/// No seam is left, and the file of the whole gear is read back as it was.
#[test]
fn a_repeated_sector_is_a_sound_mesh() {
    let whole = parts(file("periodic_hex20.msh")).whole().expect("cuts match");
    let report = MeshReport::of_gear(whole.mesh(), &GroupNames::default(), Some(30));
    assert!(report.worst().is_none_or(|worst| worst < Severity::Warning), "{report:?}");
    let sector = file("periodic_hex20.msh");
    let seams: usize = ["cut_0", "cut_1"].iter().map(|cut| sector.surface(cut).expect("cut").faces.len()).sum();
    let boundary = |mesh: &Mesh| FaceTable::new(mesh).boundary().len();
    assert_eq!(boundary(whole.mesh()), 30 * (boundary(&sector) - seams));
    let bytes = whole.mesh().to_msh(mesh::MshFormat::Binary41).expect("writes");
    assert_eq!(&Mesh::parse(&bytes, "whole.msh").expect("reads"), whole.mesh());
}

/// Whole gears and sectors of several teeth stay as they are; a sector with its cuts through the teeth becomes whole.
#[test]
fn only_sectors_of_one_tooth_are_repeated() {
    for extent in [Extent::Whole, Extent::Sector(3)] {
        let mesh = generated(1, extent);
        assert_eq!(mesh.clone().whole().expect("as it is"), mesh);
    }
    assert!(matches!(generated(1, Extent::Whole).replicate(), Err(MeshError::NoCuts)));

    // the right flank of the next tooth in place of the sector's own
    let mut mesh = generate(&gear(), &options(1, Extent::Periodic)).expect("meshes");
    for group in &mut mesh.surfaces {
        group.name = group.name.replace("right_0", "right_7").replace("left_0", "left_6");
    }
    let whole = parts(mesh).whole().expect("cuts match");
    assert!(whole.is_whole_gear());
    let sector = generated(1, Extent::Periodic);
    for (tooth, side) in [(6, Side::Left), (7, Side::Right)] {
        let (here, there) = (whole.flank(tooth, side).expect("flank"), sector.flank(0, side).expect("flank"));
        for (a, b) in here.iter().zip(there) {
            for (&a, &b) in a.nodes().iter().zip(b.nodes()) {
                assert_eq!(whole.mesh().nodes[a as usize], sector.mesh().nodes[b as usize]);
            }
        }
    }
}

/// Foreign names: flanks get ours, other groups keep theirs, and faces of the cuts do not come to lie inside.
#[test]
fn groups_of_a_repeated_sector() {
    let names = GroupNames { flank_left: "L{k}".into(), flank_right: "R{k}".into(), ..GroupNames::default() };
    let mut mesh = generate(&gear(), &options(2, Extent::Periodic)).expect("meshes");
    let mut skin = mesh.surface("side_front").expect("group").clone();
    skin.name = "skin".into();
    skin.faces.extend(mesh.surface("cut_1").expect("group").faces.iter().map(|f| f.reversed()));
    mesh.surfaces.push(skin);
    for group in &mut mesh.surfaces {
        group.name = group.name.replace("flank_left_", "L").replace("flank_right_", "R");
    }
    let whole = MeshedGear::from_groups(mesh, &names, 30).expect("groups").whole().expect("cuts match");
    let again = MeshedGear::from_groups(whole.mesh().clone(), &GroupNames::default(), 30).expect("our names");
    assert_eq!(again, whole);
    assert_eq!(whole.mesh().surfaces.len(), 60 + 4);
    let faces = |name: &str| whole.mesh().surface(name).expect("group").faces.len();
    assert_eq!(faces("skin"), faces("side_front"));
}

/// Cuts that do not fit are refused, with the node and how far it is off.
#[test]
fn cuts_that_differ_are_refused() {
    let sector = generate(&gear(), &options(2, Extent::Periodic)).expect("meshes");
    let replicate =
        |mesh: Mesh, teeth| MeshedGear::from_groups(mesh, &GroupNames::default(), teeth).expect("groups").whole();
    let cut = |name: &str| sector.surface(name).expect("cut").nodes();

    let mut moved = sector.clone();
    let node = *cut("cut_0").last().expect("nodes");
    moved.nodes[node as usize][2] += 1e-3;
    match replicate(moved, 30) {
        Err(MeshError::CutsApart { node: tag, distance_mm, .. }) => {
            assert_eq!(tag, u64::from(node) + 1);
            assert!((distance_mm - 1e-3).abs() < 1e-9, "{distance_mm}");
        }
        other => panic!("{other:?}"),
    }
    let wrong_teeth = replicate(sector.clone(), 31).expect_err("31 teeth");
    assert!(matches!(wrong_teeth, MeshError::CutsApart { .. }) && wrong_teeth.hint().is_some());

    let mut exchanged = sector.clone();
    for group in &mut exchanged.surfaces {
        group.name = match group.name.as_str() {
            "cut_0" => "cut_1".into(),
            "cut_1" => "cut_0".into(),
            other => other.into(),
        };
    }
    assert!(matches!(replicate(exchanged, 30), Err(MeshError::CutsApart { .. })));

    let rename = |change: &dyn Fn(&str, &mut Vec<mesh::Face>)| {
        let mut mesh = sector.clone();
        mesh.surfaces.iter_mut().for_each(|group| change(&group.name, &mut group.faces));
        mesh
    };
    // a face fewer, of which the neighbours still hold all nodes but one or none
    let fewer = rename(&|name, faces| {
        if name == "cut_1" {
            faces.truncate(faces.len() - 1);
        }
    });
    assert!(matches!(replicate(fewer, 30), Err(MeshError::CutsApart { .. } | MeshError::CutFaces { .. })));
    let in_part = rename(&|name, faces| {
        if name.starts_with("cut") {
            faces.truncate(faces.len() - 1);
        }
    });
    assert!(matches!(replicate(in_part, 30), Err(MeshError::CutInPart { .. })));
}

/// A number of teeth out of all reason is refused before anything is allocated.
#[test]
fn senseless_numbers_of_teeth() {
    let sector = generate(&gear(), &options(1, Extent::Periodic)).expect("meshes");
    for teeth in [0, 1, 2, u32::MAX] {
        let found = MeshedGear::from_groups(sector.clone(), &GroupNames::default(), teeth).expect("groups");
        assert!(found.whole().is_err(), "{teeth}");
    }
}
