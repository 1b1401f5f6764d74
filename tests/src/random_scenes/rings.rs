//! Internal pairs: a pinion in a ring.

use super::{Draft, gears::exact, model::Asked};

/// Share of reduced pairs at rest that get a ring.
const RINGS: f64 = 0.08;
/// Pairs that are drawn until one of them can be.
const DRAWS: usize = 20;

/// Puts a pinion and a ring in place of some pairs, half of them with root stress.
pub fn draw_ring(d: &mut Draft, asked: &Asked) {
    if asked.model != "reduced" || asked.in_time || !d.chance(RINGS) {
        return;
    }
    // What goes with the gears before.
    d.files.clear();
    for table in ["rating", "accuracy", "derivatives", "output"] {
        d.unset(table);
    }
    let mesher =
        [("order", 1), ("elements_profile", 2), ("elements_thickness", 2), ("elements_face", 2), ("elements_rim", 1)];
    for _ in 0..DRAWS {
        ["pinion", "wheel", "pair"].iter().for_each(|table| d.unset(table));
        let teeth = [d.whole(14, 40), d.whole(15, 80)];
        let module = d.mostly_log([0.5, 12.0], [0.01, 200.0]);
        let [helix, width] = [if d.chance(0.4) { 0.0 } else { d.between(-30.0, 30.0) }, d.log(2.0, 8.0)];
        d.set("pair.normal_module_mm", module);
        d.set("pair.face_width_mm", module * width);
        d.set("pinion.helix_angle_deg", helix);
        d.set("pinion.teeth", i64::from(teeth[0]));
        d.set("wheel.teeth", -i64::from(teeth[0] + teeth[1]));
        let addendum = d.between(0.7, 1.0);
        d.set("pair.addendum_coefficient", addendum);
        for gear in ["pinion", "wheel"] {
            mesher.iter().for_each(|(key, value)| d.set(&format!("{gear}.mesher.{key}"), *value));
        }
        if d.chance(0.5) {
            let shift = d.between(0.0, 0.5);
            d.set("pinion.profile_shift", shift);
        }
        if d.chance(0.5) {
            let cutter = d.whole(14, 30);
            d.set("wheel.shaper.teeth", i64::from(cutter));
        }
        if d.chance(0.5) {
            let shift = d.between(-0.1, 0.3);
            d.set("wheel.shaper.profile_shift", shift);
        }
        if d.chance(0.5) {
            let rounding = d.between(0.0, 0.2);
            d.set("wheel.shaper.tip_rounding_coefficient", rounding);
        }
        if exact(d).is_some() {
            break;
        }
    }
    if d.chance(0.5) {
        d.set("output.root_stress", true);
    }
}
