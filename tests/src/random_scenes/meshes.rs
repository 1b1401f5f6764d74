//! Where the meshes come from: the built-in mesher, small, or files of other programs.

use super::{Draft, gears::Sizes};

/// Files of `meshes/` that are read within a second or two, all of the default pair; open sectors of three teeth,
/// whole gears, one tooth that stands for all.
const FOREIGN: [&str; 14] = [
    "sector3_hex8_v22_ascii",
    "sector3_hex8_v22_binary",
    "sector3_hex8_v41_ascii",
    "sector3_hex8_v41_binary",
    "sector3_hex20",
    "sector3_hex27",
    "sector3_tet4",
    "sector3_wedge6",
    "sector3_wedge15",
    "periodic_hex8",
    "periodic_hex20",
    "periodic_hex8",
    "periodic_hex20",
    "coarse_hex8_pinion",
];
/// Turn of one layer of elements that the mesher takes as usual, degrees.
const TURN_DEG: f64 = 8.0;

/// Numbers of elements of the built-in mesher; now and then its sectors.
pub fn draw_mesher(d: &mut Draft, sizes: &Sizes, rich: bool) {
    for (i, gear) in ["pinion", "wheel"].into_iter().enumerate() {
        let turn = (2.0 * sizes.width * sizes.helix_deg.to_radians().tan() / sizes.reference[i]).abs().to_degrees();
        let layers = (turn / TURN_DEG).ceil().clamp(2.0, 60.0) as u32;
        let small = if d.chance(0.75) || !rich { 2 } else { 3 };
        let counts = [
            ("order", if rich && d.chance(0.3) { 2 } else { 1 }),
            ("elements_profile", d.whole(1, small)),
            ("elements_fillet", d.whole(2, small)),
            ("elements_thickness", d.whole(1, small)),
            ("elements_face", layers + d.whole(0, 1)),
            ("elements_rim", d.whole(1, 2)),
        ];
        for (key, count) in counts {
            d.set(&format!("{gear}.mesher.{key}"), i64::from(count));
        }
        if d.chance(0.15) {
            let most = sizes.teeth[i] - 1;
            let teeth = if d.chance(0.4) { 1 } else { d.whole(2, 9.min(most)) };
            d.set(&format!("{gear}.mesher.sector_teeth"), i64::from(teeth));
        }
    }
}

/// The default pair on meshes that Gmsh wrote, which have names of their own now and then.
pub fn draw_foreign(d: &mut Draft) -> Sizes {
    let teeth = [30, 30];
    for gear in ["pinion", "wheel"] {
        d.set(&format!("{gear}.teeth"), 30);
        d.set(&format!("{gear}.thickness_allowance_mm"), 0.05);
    }
    d.set("pinion.helix_angle_deg", 20.0);
    d.set("pair.normal_module_mm", 3.0);
    d.set("pair.face_width_mm", 20.0);
    // Single files are right-handed: only the pinion can be one of them.
    let name = d.pick(&FOREIGN);
    d.set("pinion.mesh", format!("meshes/{name}.msh"));
    if d.chance(0.3) {
        d.set("pinion.bore_diameter_mm", 60.0);
    }
    if name.starts_with("coarse") && d.chance(0.5) {
        d.set("wheel.mesh", "meshes/coarse_hex8_wheel.msh");
    }
    if d.chance(0.15) {
        for (key, group) in [
            ("bore", "bore"),
            ("flank_left", "flank_left_{k}"),
            ("flank_right", "flank_right_{k}"),
            ("cut_0", "cut_0"),
            ("cut_1", "cut_1"),
        ] {
            let other = d.chance(0.05);
            let gear = if d.chance(0.8) { "pinion" } else { "wheel" };
            d.set(&format!("{gear}.groups.{key}"), if other { "Hub_{k}" } else { group });
        }
    }
    let sizes = Sizes { teeth, width: 20.0, helix_deg: 20.0, reference: [95.78; 2], pair: None };
    if d.get("wheel.mesh").is_none() {
        draw_mesher(d, &sizes, true);
        d.unset("pinion.mesher");
        d.set("wheel.bore_diameter_mm", 60.0);
    }
    sizes
}
