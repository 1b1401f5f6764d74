//! The meshes that Gmsh made from an independent script: they agree with this program's own geometry.

use std::path::PathBuf;

use crate::measure::{tooth_area, volume_and_least_jacobian};
use geometry::{Gear, GearData, Side, Vec3};
use mesh::Mesh;

fn read(name: &str) -> Mesh {
    let path: PathBuf = [env!("CARGO_MANIFEST_DIR"), "../../meshes", name].iter().collect();
    Mesh::read(&path).unwrap_or_else(|error| panic!("{error}"))
}

/// The default gear in either hand.
fn gear(left_hand: bool) -> Gear {
    let right = GearData::default();
    let helix_angle = if left_hand { -right.helix_angle } else { right.helix_angle };
    Gear::new(GearData { helix_angle, ..right }).expect("sound data")
}

/// Every flank node, mid-side nodes included, lies on the exact helicoid; elements are sound; the volume is that of
/// the exact section within what the element sizes leave.
#[test]
fn flanks_and_volume_are_those_of_the_exact_gear() {
    let files: [(&str, bool, usize, f64); 11] = [
        ("coarse_hex8_pinion.msh", false, 30, 5e-3),
        ("coarse_hex8_wheel.msh", true, 30, 5e-3),
        ("medium_hex8_pinion.msh", false, 30, 5e-3),
        ("medium_hex8_wheel.msh", true, 30, 5e-3),
        ("coarse_hex20_pinion.msh", false, 30, 1e-4),
        ("coarse_hex20_wheel.msh", true, 30, 1e-4),
        ("periodic_hex20.msh", false, 1, 1e-4),
        ("free_tet10_pinion.msh", false, 30, 5e-4),
        ("sector3_hex27.msh", false, 3, 5e-4),
        ("sector3_wedge15.msh", false, 3, 5e-4),
        ("sector3_tet4.msh", false, 3, 2e-2),
    ];
    for (name, left_hand, teeth, tolerance) in files {
        is_exact(name, &gear(left_hand), teeth, tolerance);
    }
}

/// Gears of the pairs of seed 000, which differ in the helix angle alone, have the flanks of their helix angles.
#[test]
fn gears_of_the_seed_have_the_flanks_of_their_helix_angles() {
    for (degrees, hand) in [10.0, 15.0, 20.0, 25.0].into_iter().flat_map(|d| [(d, 1.0), (d, -1.0)]) {
        let helix_angle = hand * f64::to_radians(degrees);
        let gear = Gear::new(GearData { helix_angle, face_width: 22.0, ..GearData::default() }).expect("sound data");
        let name = format!("seed000_beta{degrees}_{}.msh", if hand > 0.0 { "pinion" } else { "wheel" });
        is_exact(&name, &gear, 1, 1e-4);
    }
}

/// What a mesh of so many teeth of a gear must keep to.
fn is_exact(name: &str, gear: &Gear, teeth: usize, tolerance: f64) {
    let mesh = read(name);
    let (volume, least) = volume_and_least_jacobian(&mesh);
    assert!(least > 0.0, "{name}: det J = {least:e}");
    let exact = teeth as f64 * tooth_area(gear) * gear.face_width();
    assert!((volume / exact - 1.0).abs() < tolerance, "{name}: {volume} mm^3, exactly {exact}");
    let mut flanks = 0;
    for group in &mesh.surfaces {
        let Some((side, tooth)) = group.name.strip_prefix("flank_").and_then(|rest| rest.split_once('_')) else {
            continue;
        };
        flanks += 1;
        let side = if side == "left" { Side::Left } else { Side::Right };
        let flank = gear.flank_of(side, tooth.parse().expect("a tooth number"));
        for node in group.nodes() {
            let foot = flank.locate(&Vec3::from(mesh.nodes[node as usize])).expect("above the base circle");
            assert!(foot.distance.abs() < 1e-10, "{name}, {}: {:e} mm off", group.name, foot.distance);
            assert!(foot.roll > flank.roll_form - 1e-6 && foot.roll < flank.roll_tip + 1e-9, "{name}");
        }
    }
    assert_eq!(flanks, 2 * teeth, "{name}");
}
