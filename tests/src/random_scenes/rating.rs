//! Whether a pair at rest will hold: the keys of `[rating]`.

use super::{Draft, model::Asked};

/// Share of scenes at rest that are rated.
const RATED: f64 = 0.12;
const MATERIALS: &str = include_str!("../../../crates/rating/data/materials.toml");
const LUBRICANTS: &str = include_str!("../../../crates/rating/data/lubricants.toml");

/// A rating of a pair at rest, at times with tables and loads from files.
pub fn draw_rating(d: &mut Draft, asked: &Asked) {
    if asked.in_time || !d.chance(RATED) {
        return;
    }
    let life = d.mostly_log([10.0, 1e5], [0.001, 1e8]);
    d.set("rating.life_h", life);
    let class = d.whole(1, 11);
    d.set("rating.tolerance_class", i64::from(class));
    let oil = d.pick(&["mineral VG 150", "mineral VG 320"]);
    d.set("rating.lubricant", oil);
    for (key, share, usual, all) in [
        ("application_factor", 1.0, [1.0, 2.0], [0.1, 100.0]),
        // Models without slices find none.
        ("face_load_factor", if asked.sliced { 0.3 } else { 1.0 }, [1.0, 2.0], [1.0, 100.0]),
        ("dynamic_factor", 0.3, [1.0, 1.5], [0.5, 100.0]),
        ("transverse_load_factor", 0.3, [1.0, 1.5], [1.0, 100.0]),
        ("base_pitch_deviation_um", 0.3, [1.0, 30.0], [0.0, 1e4]),
        ("profile_form_deviation_um", 0.3, [1.0, 30.0], [0.0, 1e4]),
        ("tip_relief_um", 0.3, [0.0, 60.0], [0.0, 1e4]),
        ("gear_blank_factor", 0.3, [0.7, 1.0], [0.1, 1.0]),
        ("long_life_factor", 0.3, [0.85, 1.0], [0.85, 1.0]),
    ] {
        if d.chance(share) {
            let value = d.mostly(usual, all);
            d.set(&format!("rating.{key}"), value);
        }
    }
    if d.chance(0.5) {
        let edition = d.pick(&["iso-2006", "iso-2019"]);
        d.set("rating.edition", edition);
    }
    if d.chance(0.3) {
        d.set("rating.limited_pitting", true);
    }
    for (key, name, content) in
        [("materials", "materials.toml", MATERIALS), ("lubricants", "lubricants.toml", LUBRICANTS)]
    {
        if d.chance(0.2) {
            d.set(&format!("rating.{key}"), name);
            d.files.push((name.to_owned(), content.to_owned()));
        }
    }
    if d.chance(0.3) {
        let torque = d.number("operation.torque_nm").unwrap_or(0.0);
        let rows: String = (1..=4).map(|i| format!("{:?},1000,0.25\n", 0.5 * f64::from(i) * torque)).collect();
        d.set("rating.spectrum", "loads.csv");
        d.files.push(("loads.csv".to_owned(), format!("torque_nm,speed_rpm,share\n{rows}")));
    }
    for gear in ["pinion", "wheel"] {
        let material = d.pick(&["18CrNiMo7-6", "42CrMo4 300 HV", "case-hardened steel ML"]);
        d.set(&format!("rating.{gear}.material"), material);
        for key in ["flank_roughness_rz_um", "root_roughness_rz_um"] {
            let roughness = d.log(1.0, 40.0);
            d.set(&format!("rating.{gear}.{key}"), roughness);
        }
        if d.chance(0.3) {
            let reversed = d.between(0.0, 1.0);
            d.set(&format!("rating.{gear}.reversed_load_ratio"), reversed);
        }
        if d.chance(0.3) {
            let meshes = d.whole(1, 3);
            d.set(&format!("rating.{gear}.meshes_per_turn"), i64::from(meshes));
        }
    }
    draw_oil(d, asked);
}

/// What scuffing, micropitting and losses ask for.
fn draw_oil(d: &mut Draft, asked: &Asked) {
    let [scuffing, micropitting] = [d.chance(0.5), asked.sliced && d.chance(0.5)];
    if !(scuffing || asked.sliced && d.chance(0.5) || micropitting) {
        return;
    }
    let oil = d.mostly([40.0, 120.0], [-50.0, 250.0]);
    d.set("rating.oil_temperature_c", oil);
    for gear in ["pinion", "wheel"] {
        let roughness = d.mostly_log([0.2, 2.0], [0.001, 50.0]);
        d.set(&format!("rating.{gear}.flank_roughness_ra_um"), roughness);
    }
    if scuffing || micropitting {
        let method = d.pick(&["dip", "spray", "submerged"]);
        d.set("rating.lubrication", method);
    }
    if scuffing {
        d.set("rating.scuffing", true);
        let structure = d.mostly([0.8, 1.5], [0.1, 10.0]);
        d.set("rating.structural_factor", structure);
    }
    if micropitting {
        d.set("rating.micropitting", true);
        let (key, usual, all) = if d.chance(0.5) {
            // Of the drawn oils one has a test of micropitting.
            d.set("rating.lubricant", "mineral VG 220");
            ("material_factor", [0.5, 1.5], [0.1, 10.0])
        } else {
            ("permissible_specific_film_thickness", [0.1, 0.5], [1e-4, 100.0])
        };
        let value = d.mostly(usual, all);
        d.set(&format!("rating.{key}"), value);
    }
}
