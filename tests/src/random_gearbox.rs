//! Gearboxes of one random pair on two elastic shafts, the same in every run.

use std::path::Path;

use scene::gearbox::{Gearbox, gearbox_of_pair};
use testing::Random;

use crate::random_scene::random_scene;

/// Width over module up to which gears of the finest meshes are reduced in minutes.
const WIDEST: f64 = 10.0;
/// Teeth, likewise.
const MOST_TEETH: u32 = 80;

/// Gearbox number `index` of a seed: the pair of [`random_scene`] between two bearings on each shaft.
///
/// Shafts are three face widths long and as thick as the bore, gears sit at 0.3 to 0.7 of the length, bearings at 0.05 and
/// 0.95 of it with 5e4 to 1e6 N/mm, the first of each along the axis as well. `None` for a pair that is wider than ten modules
/// or has more than 80 teeth.
pub fn random_gearbox(seed: u64, index: u64) -> Option<Gearbox> {
    let scene = random_scene(seed, index);
    let width = scene.face_widths_mm()[0].max(scene.face_widths_mm()[1]);
    let most = scene.pinion.teeth.max(scene.wheel.teeth);
    if width > WIDEST * scene.pair.normal_module_mm || most > MOST_TEETH {
        return None;
    }
    let mut random = Random::new(seed ^ index.wrapping_mul(0x9e37_79b9_7f4a_7c15));
    let length = 3.0 * width;
    let middle = format!("position_mm = {:?}\nkey_deg", 0.5 * length);
    let place = format!("position_mm = {:?}\nkey_deg", length * random.between(0.3, 0.7));
    let own = gearbox_of_pair(&scene).ok()?;
    let mut text = own.text.replace("held = true\n", "").replace(&middle, &place);
    for shaft in ["pinion", "wheel"] {
        for (end, axial) in [(0.05, true), (0.95, false)] {
            let [x, y, z] = [(); 3].map(|()| random.between(5e4f64.ln(), 1e6f64.ln()).exp());
            let z = if axial { z } else { 0.0 };
            text += &format!(
                "\n[[bearing]]\nname = \"{shaft} {end}\"\nshaft = \"{shaft}\"\nposition_mm = {:?}\nstiffness_n_per_mm = \
                 [{x:?}, {y:?}, {z:?}]\n",
                end * length
            );
        }
    }
    text += "\n[vibration]\nfrom_rpm = 500.0\nto_rpm = 1000.0\nspeeds = 2\n";
    Gearbox::parse(&text, Path::new("random_gearbox.toml")).ok()
}
