//! The pair: teeth, sizes, materials, axes that are not parallel.

use geometry::GearPair;
use scene::Scene;

use super::Draft;

/// Draws that are tried for one pair: some have pointed teeth, jam, or lose each other.
const DRAWS: usize = 60;
/// Pairs that stand as they were drawn, though no gear can be made of them.
const UNTRIED: f64 = 0.06;

/// Numbers of the pair that the rest of the scene is measured by.
#[derive(Debug, Clone)]
pub struct Sizes {
    /// Teeth of pinion and wheel.
    pub teeth: [u32; 2],
    /// Face width, mm.
    pub width: f64,
    /// Helix angle, degrees.
    pub helix_deg: f64,
    /// Reference diameters, mm.
    pub reference: [f64; 2],
    /// The exact pair, where there is one.
    pub pair: Option<GearPair>,
}

/// Keys of the geometry: teeth, rack, shifts, tips, centre distance; up to so many teeth.
pub fn draw_pair(d: &mut Draft, most_teeth: f64) -> Sizes {
    let tried = !d.chance(UNTRIED);
    let mut sizes = one_pair(d, most_teeth);
    for _ in 0..DRAWS {
        if !tried || sizes.pair.is_some() {
            break;
        }
        ["pinion", "wheel", "pair"].iter().for_each(|table| d.unset(table));
        sizes = one_pair(d, most_teeth);
    }
    sizes
}

fn one_pair(d: &mut Draft, most_teeth: f64) -> Sizes {
    let usual = most_teeth.min(121.0);
    let teeth = [(); 2].map(|()| if d.chance(0.92) { d.log(9.0, usual) } else { d.log(5.0, most_teeth) } as u32);
    let helix_deg = if d.chance(0.2) { 0.0 } else { d.mostly([-40.0, 40.0], [-60.0, 60.0]) };
    let module = d.mostly_log([0.5, 12.0], [0.01, 200.0]);
    let width = if d.chance(0.06) { d.log(0.05, 60.0) } else { d.log(2.0, 8.0) };
    let width = (module * width).clamp(0.01, 1e4);
    for (key, value) in [("normal_module_mm", module), ("face_width_mm", width)] {
        d.set(&format!("pair.{key}"), value);
    }
    d.set("pinion.helix_angle_deg", helix_deg);
    if d.chance(0.1) {
        d.set("wheel.helix_angle_deg", 0.0 - helix_deg);
    }
    if d.chance(0.5) {
        let angle = d.mostly([14.5, 28.0], [5.0, 40.0]);
        d.set("pair.normal_pressure_angle_deg", angle);
    }
    for (key, share, usual, all) in [
        ("addendum_coefficient", 0.15, [0.8, 1.2], [0.1, 2.0]),
        ("dedendum_coefficient", 0.15, [1.15, 1.4], [0.1, 2.5]),
        ("root_radius_coefficient", 0.15, [0.1, 0.38], [0.0, 1.0]),
    ] {
        if d.chance(share) {
            let value = d.mostly(usual, all);
            d.set(&format!("pair.{key}"), value);
        }
    }
    let reference = teeth.map(|z| f64::from(z) * module / helix_deg.to_radians().cos());
    for (i, gear) in ["pinion", "wheel"].into_iter().enumerate() {
        d.set(&format!("{gear}.teeth"), i64::from(teeth[i]));
        one_gear(d, gear, module, reference[i]);
    }
    if d.chance(0.15) {
        let distance = 0.5 * (reference[0] + reference[1]) * d.mostly([1.0, 1.01], [0.97, 1.1]);
        d.set("pair.centre_distance_mm", distance.clamp(0.01, 1e5));
    }
    Sizes { teeth, width, helix_deg, reference, pair: exact(d) }
}

fn one_gear(d: &mut Draft, gear: &str, module: f64, reference: f64) {
    let mut maybe = |key: &str, share: f64, value: &mut dyn FnMut(&mut Draft) -> f64| {
        if d.chance(share) {
            let value = value(d);
            d.set(&format!("{gear}.{key}"), value);
        }
    };
    maybe("profile_shift", 0.5, &mut |d| d.mostly([-0.3, 0.6], [-1.5, 2.0]));
    maybe("bore_diameter_mm", 0.4, &mut |d| reference * d.mostly([0.3, 0.75], [0.001, 0.98]));
    maybe("tip_diameter_mm", 0.08, &mut |d| {
        let usual = reference + 2.0 * module * d.between(0.7, 1.1);
        if d.chance(0.9) { usual.min(2.0 * reference) } else { reference * d.between(0.5, 2.0) }
    });
    maybe("tip_edge_radius_mm", 0.15, &mut |d| module * d.between(0.0, 0.25));
    maybe("thickness_allowance_mm", 0.4, &mut |d| module * d.mostly([0.0, 0.05], [0.0, 0.5]));
}

/// The pair of the keys so far, if it is one.
pub(super) fn exact(d: &Draft) -> Option<GearPair> {
    let text = format!("{}\n[operation]\ntorque_nm = 1.0\n", d.text().ok()?);
    Scene::parse(&text, "drawn.toml".as_ref()).ok()?.gear_pair().ok()
}

/// Gears that are wider than the common face, at two heights, held by a part of their bores or by its means.
pub fn draw_faces_and_bores(d: &mut Draft, sizes: &Sizes) {
    let half = 0.5 * sizes.width;
    for gear in ["pinion", "wheel"] {
        if d.chance(0.04) {
            let width = sizes.width * d.mostly([1.0, 1.3], [0.5, 3.0]);
            d.set(&format!("{gear}.face_width_mm"), width.clamp(0.1, 1e4));
        }
        if d.chance(0.04) {
            let held = vec![-half * d.mostly([0.6, 1.0], [-1.0, 1.0]), half * d.between(0.6, 1.0)];
            d.set(&format!("{gear}.bore.held_mm"), held);
        }
        if d.chance(0.02) {
            let coupling = d.pick(&["kinematic", "distributing"]);
            d.set(&format!("{gear}.bore.coupling"), coupling);
        } else if d.chance(0.02) {
            draw_springs(d, gear, half);
        }
    }
    if d.chance(0.03) {
        let offset = half * d.mostly([-0.2, 0.2], [-2.0, 2.0]);
        d.set("pair.mid_face_offset_mm", offset);
    }
}

/// A bore on springs all around, at bolts, or both.
fn draw_springs(d: &mut Draft, gear: &str, half: f64) {
    d.set(&format!("{gear}.bore.coupling"), "elastic");
    let bolts = d.chance(0.5);
    if !bolts || d.chance(0.5) {
        for key in ["radial", "tangential", "axial"] {
            let stiffness = 10f64.powf(d.mostly([2.0, 5.0], [-3.0, 8.0]));
            d.set(&format!("{gear}.bore.{key}_n_per_mm3"), stiffness);
        }
    }
    if bolts {
        let table = format!("{gear}.bore.bolts");
        let count = d.whole(3, 24);
        d.set(&format!("{table}.count"), i64::from(count));
        let width = half * d.between(0.02, 0.5);
        d.set(&format!("{table}.width_mm"), width);
        for key in ["radial", "tangential", "axial"] {
            let stiffness = 10f64.powf(d.mostly([4.0, 7.0], [0.0, 10.0]));
            d.set(&format!("{table}.{key}_n_per_mm"), stiffness);
        }
        if d.chance(0.3) {
            let angle = d.between(-360.0, 360.0);
            d.set(&format!("{table}.first_angle_deg"), angle);
        }
        if d.chance(0.3) {
            let over = vec![-half * d.between(0.1, 1.0), half * d.between(0.1, 1.0)];
            d.set(&format!("{table}.over_mm"), over);
        }
    }
}

/// Materials of both gears, or of one.
pub fn draw_materials(d: &mut Draft) {
    for (table, share) in [("material", 0.25), ("pinion.material", 0.08), ("wheel.material", 0.08)] {
        if !d.chance(share) {
            continue;
        }
        if d.chance(0.6) {
            let young = d.mostly_log([1e3, 4e5], [1.0, 1e7]);
            d.set(&format!("{table}.young_mpa"), young);
        }
        if d.chance(0.6) {
            let ends = [-0.9, -0.5, 0.0, 0.49, 0.499];
            let poisson = if d.chance(0.4) { d.pick(&ends) } else { d.between(-0.9, 0.499) };
            d.set(&format!("{table}.poisson"), poisson);
        }
        if d.chance(0.6) {
            let density = d.mostly_log([1000.0, 20_000.0], [1.0, 1e5]);
            d.set(&format!("{table}.density_kg_m3"), density);
        }
    }
}

/// The wheel's axis against the pinion's.
pub fn draw_misalignment(d: &mut Draft, sizes: &Sizes) {
    for key in ["deviation_um", "inclination_um", "in_plane_of_action_um", "across_plane_of_action_um"] {
        if d.chance(0.4) {
            let most = 10.0 * sizes.width;
            let usual = most.min(30.0);
            let amount = d.mostly([-usual, usual], [-most, most]);
            d.set(&format!("pair.misalignment.{key}"), amount);
        }
    }
}

/// Pitch errors of every tooth, in the scene or in a file.
pub fn draw_pitch_errors(d: &mut Draft, sizes: &Sizes) {
    for (gear, teeth) in ["pinion", "wheel"].into_iter().zip(sizes.teeth) {
        if !d.chance(0.5) {
            continue;
        }
        let size = d.mostly_log([1.0, 30.0], [1.0, 1000.0]);
        let errors: Vec<f64> = (0..teeth).map(|_| d.between(-size, size)).collect();
        if d.chance(0.5) {
            d.set(&format!("{gear}.pitch_errors_um"), errors);
        } else {
            let name = format!("{gear}_pitch.csv");
            let lines: String = errors.iter().map(|e| format!("{e}\n")).collect();
            d.files.push((name.clone(), lines));
            d.set(&format!("{gear}.pitch_errors_file"), name);
        }
    }
}
