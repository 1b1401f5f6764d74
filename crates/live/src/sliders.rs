//! What is moved by hand, and within which ends.

use std::{borrow::Cow, collections::BTreeMap};

use geometry::{Gear, GearPair};
use scene::{
    Scene,
    gearbox::{Gearbox, GearboxTorque},
};
use serde::Serialize;

/// A number of the scene that is moved by hand.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(crate) struct Slider {
    /// Part of the pair to which the slider belongs, in words.
    pub group: Cow<'static, str>,
    /// Key of the document with dots.
    pub key: String,
    /// In words.
    pub label: Cow<'static, str>,
    /// Unit of the number.
    pub unit: &'static str,
    /// Ends, which stay while the text of the scene does.
    pub ends: [f64; 2],
    /// From one notch to the next.
    pub step: f64,
    /// Where it stands where the scene has no number of it.
    pub rest: f64,
}

/// Keys as they are written, with dots.
type Written = BTreeMap<String, String>;

/// The sliders of a scene: load, micro-geometry of both gears, misalignment.
pub(crate) fn sliders(scene: &Scene, pair: &GearPair, written: &Written) -> Vec<Slider> {
    let mut all = Vec::from(load(scene));
    for (group, gear) in [("pinion", &pair.pinion), ("wheel", &pair.wheel)] {
        all.extend(flank(group, gear, scene.pair.normal_module_mm, written));
    }
    all.extend(misalignment(scene, written));
    all
}

/// The sliders of a gearbox: its torques, and the micro-geometry of every mesh.
pub(crate) fn sliders_of_gearbox(file: &Gearbox, written: &Written) -> Vec<Slider> {
    let torque = |(i, own): (usize, &GearboxTorque)| {
        let most = round_up(if own.torque > 0.0 { 2e-3 * own.torque } else { 100.0 });
        let label = format!("torque on {}", file.shafts[own.shaft].name).into();
        let (key, step) = (format!("torque.{i}.torque_nm"), most / NOTCHES);
        Slider { group: "load".into(), key, label, unit: "N·m", ends: [0.0, most], step, rest: 0.0 }
    };
    let mut all: Vec<Slider> = file.torques.iter().enumerate().map(torque).collect();
    for (i, mesh) in file.meshes.iter().enumerate() {
        let Ok(pair) = mesh.scene.gear_pair() else { continue };
        let before = format!("mesh.{i}.scene.");
        let of_mesh =
            written.iter().filter_map(|(key, value)| Some((key.strip_prefix(&before)?.to_owned(), value.clone())));
        let own = sliders(&mesh.scene, &pair, &of_mesh.collect()).into_iter();
        all.extend(own.filter(|slider| slider.key.contains(".modification.")).map(|slider| {
            let (key, group) = (format!("{before}{}", slider.key), format!("{}: {}", mesh.name, slider.group).into());
            Slider { key, group, ..slider }
        }));
    }
    all
}

fn load(scene: &Scene) -> [Slider; 2] {
    let of = |key: &str, label: &'static str, unit, most| {
        let step = most / NOTCHES;
        Slider {
            group: "load".into(),
            key: key.into(),
            label: label.into(),
            unit,
            ends: [step, most],
            step,
            rest: step,
        }
    };
    let (torque, speed) = (scene.operation.torque_nm, scene.operation.speed_rpm);
    let torque = of("operation.torque_nm", "torque", "N·m", round_up(if torque > 0.0 { 2.0 * torque } else { 100.0 }));
    let speed = of("operation.speed_rpm", "speed", "rpm", round_up(2.0 * speed));
    [Slider { ends: [0.0, torque.ends[1]], rest: 0.0, ..torque }, speed]
}

/// Micro-geometry of the flanks of a gear. Amounts end where they are large for the module: 15 um a mm of it of
/// relief, 10 of crowning and slope.
fn flank(group: &'static str, gear: &Gear, module: f64, written: &Written) -> Vec<Slider> {
    let table = format!("{group}.modification");
    // The flanks that the torque presses may have a key of their own, which holds instead of that of both.
    let key = |name: &str| {
        let own = format!("{table}.drive.{name}");
        if written.contains_key(&own) { own } else { format!("{table}.{name}") }
    };
    let amount = |name: &str, label: &'static str, ends: [f64; 2]| {
        let step = (ends[1] / NOTCHES).min(0.5);
        Slider { group: group.into(), key: key(name), label: label.into(), unit: "µm", ends, step, rest: 0.0 }
    };
    let (relief, small) = (round_up(15.0 * module), round_up(10.0 * module));
    let start = |what: &str, label, shares: [f64; 3]| start(gear, &key, what, (group, label), shares, written);
    vec![
        amount("tip_relief_um", "tip relief", [0.0, relief]),
        start("tip_relief", "tip relief from", [0.4, 0.9, TIP_START]),
        amount("root_relief_um", "root relief", [0.0, relief]),
        start("root_relief", "root relief from", [0.05, 0.6, ROOT_START]),
        amount("profile_crowning_um", "profile crowning", [0.0, small]),
        amount("lead_crowning_um", "lead crowning", [0.0, small]),
        amount("lead_slope_um", "lead slope", [-small, small]),
    ]
}

/// Where reliefs begin of which the scene says nothing: shares of the profile's roll angle from the form circle to the
/// tip, that of the tip as an optimisation begins with.
const TIP_START: f64 = 0.6;
const ROOT_START: f64 = 0.25;
/// Steps of a slider, about.
const NOTCHES: f64 = 200.0;

/// Where a relief starts: as a diameter where the scene says it so, else as a roll angle.
fn start(
    gear: &Gear,
    key: &dyn Fn(&str) -> String,
    what: &str,
    (group, label): (&'static str, &'static str),
    shares: [f64; 3],
    written: &Written,
) -> Slider {
    let (profile, base) = (gear.profile(), gear.base_radius());
    let rolls = shares.map(|share| profile.roll_form() + share * (profile.roll_tip() - profile.roll_form()));
    let as_diameter = key(&format!("{what}_start_diameter_mm"));
    let (key, unit, [low, high, rest], step) = if written.contains_key(&as_diameter) {
        (as_diameter, "mm", rolls.map(|u| 2.0 * base * u.hypot(1.0)), 0.01)
    } else {
        (key(&format!("{what}_start_roll_deg")), "deg", rolls.map(f64::to_degrees), 0.1)
    };
    // A division leaves no digits behind the step.
    let notches: f64 = 1.0 / step;
    let whole = |v: f64| (v * notches).round() / notches.round();
    let ends = [whole(low), whole(high)];
    Slider { group: group.into(), key, label: label.into(), unit, ends, step, rest: whole(rest) }
}

/// In the plane of action or, where the scene has them so, along and across the plane of axes; the ends are 2 um a mm
/// of face width.
fn misalignment(scene: &Scene, written: &Written) -> Vec<Slider> {
    let most = round_up(2.0 * scene.common_face_width_mm()).max(20.0);
    let by_axes = ["deviation_um", "inclination_um"].iter().any(|name| written.contains_key(&misaligned(name)));
    let names = if by_axes {
        [("deviation_um", "deviation of axes"), ("inclination_um", "inclination of axes")]
    } else {
        [("in_plane_of_action_um", "in the plane of action"), ("across_plane_of_action_um", "perpendicular to it")]
    };
    let step = (most / NOTCHES).clamp(0.1, 1.0);
    let of = |(name, label): (&str, &'static str)| {
        let (key, ends) = (misaligned(name), [-most, most]);
        Slider { group: "misalignment".into(), key, label: label.into(), unit: "µm", ends, step, rest: 0.0 }
    };
    names.map(of).into()
}

fn misaligned(name: &str) -> String {
    format!("pair.misalignment.{name}")
}

/// What goes with a change so that it means something: a relief that is moved from nothing gets its start, a start its
/// relief of nothing.
pub(crate) fn completed(changes: &BTreeMap<String, String>, all: &[Slider], written: &Written) -> Written {
    let mut complete = changes.clone();
    for (key, value) in changes.iter().filter(|(_, value)| !value.trim().is_empty()) {
        let table = key.rsplit_once('.').map_or("", |(table, _)| table);
        for what in ["tip_relief", "root_relief"] {
            let (amount, start) = (format!("{table}.{what}_um"), format!("{table}.{what}_start_"));
            let there = |begin: &str| {
                let all = written.keys().chain(complete.iter().filter(|(_, v)| !v.trim().is_empty()).map(|(k, _)| k));
                all.into_iter().any(|key| key.starts_with(begin))
            };
            if *key == amount && !there(&start) && value.parse::<f64>() != Ok(0.0) {
                let rest = all.iter().find(|slider| slider.key.starts_with(&start));
                complete.extend(rest.map(|slider| (slider.key.clone(), short(slider.rest))));
            } else if key.starts_with(&start) && !there(&amount) {
                complete.insert(amount, "0.0".into());
            }
        }
    }
    // An amount of nothing that has no start says nothing.
    let starts: Vec<String> =
        complete.keys().chain(written.keys()).filter(|k| k.contains("_start_")).cloned().collect();
    complete.retain(|key, value| {
        let relief = key.strip_suffix("_um").filter(|k| k.ends_with("_relief"));
        relief.is_none_or(|begin| value.parse::<f64>() != Ok(0.0) || starts.iter().any(|k| k.starts_with(begin)))
    });
    complete
}

/// Changes with what a search may move: a relief that the scene lacks begins as one of nothing, from where it starts as
/// well as one that is moved by hand.
pub(crate) fn with_starts(
    changes: &BTreeMap<String, String>,
    search: &BTreeMap<String, [f64; 2]>,
    written: &Written,
) -> Written {
    let mut all = changes.clone();
    let is_new = |key: &&String| !written.contains_key(*key) && !changes.contains_key(*key) && !key.contains("_start_");
    for key in search.keys().filter(is_new) {
        let relief = key.ends_with("_relief_um");
        // Anything but nothing brings its start with it.
        all.insert(key.clone(), if relief { "0.001" } else { "0.0" }.to_owned());
    }
    all
}

/// A number without the digits that sums leave.
pub(crate) fn short(value: f64) -> String {
    let rounded: f64 = format!("{value:.6}").parse().unwrap_or(value);
    format!("{rounded:?}")
}

/// The next of 1, 2, 3, 5 and their tens.
fn round_up(value: f64) -> f64 {
    let ten = 10f64.powf(value.max(1e-9).log10().floor());
    [1.0, 2.0, 3.0, 5.0, 10.0].into_iter().map(|n| n * ten).find(|n| *n >= value * (1.0 - 1e-9)).unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(more: &str) -> (Vec<Slider>, Written) {
        let text = format!(
            "[pinion]\nteeth = 30\nhelix_angle_deg = 20.0\n[wheel]\nteeth = 30\n[pair]\nnormal_module_mm = 3.0\nface_width_mm = 20.0\n\
             [operation]\ntorque_nm = 150.0\n{more}"
        );
        let scene = Scene::parse(&text, "a.toml".as_ref()).unwrap();
        let written = crate::scene_text::flat(&text);
        (sliders(&scene, &scene.gear_pair().unwrap(), &written), written)
    }

    fn changes(pairs: &[(&str, &str)]) -> Written {
        pairs.iter().map(|(k, v)| ((*k).to_owned(), (*v).to_owned())).collect()
    }

    #[test]
    fn every_slider_moves_a_key_of_the_scene_within_its_ends() {
        let (all, _) = of("");
        let keys = scene::all_keys();
        for slider in &all {
            assert!(keys.contains(&slider.key), "{}", slider.key);
            let [low, high] = slider.ends;
            assert!(low < high && slider.step > 0.0 && (low..=high).contains(&slider.rest), "{slider:?}");
        }
        assert_eq!(all.len(), 18);
        assert_eq!((all[0].ends, all[1].ends), ([0.0, 300.0], [10.0, 2000.0]));
    }

    #[test]
    fn sliders_move_the_keys_that_hold() {
        let (all, _) = of("[pinion.modification.drive]\ntip_relief_um = 5.0\ntip_relief_start_diameter_mm = 98.0\n\
            [pair.misalignment]\ndeviation_um = 3.0\n");
        let keys: Vec<&str> = all.iter().map(|s| s.key.as_str()).collect();
        assert!(keys.contains(&"pinion.modification.drive.tip_relief_um"), "{keys:?}");
        assert!(keys.contains(&"pinion.modification.drive.tip_relief_start_diameter_mm"), "{keys:?}");
        assert!(keys.contains(&"pair.misalignment.inclination_um"), "{keys:?}");
    }

    #[test]
    fn a_relief_gets_its_start_and_a_start_its_relief() {
        let (all, written) = of("");
        let moved = completed(&changes(&[("wheel.modification.tip_relief_um", "20")]), &all, &written);
        let start: f64 = moved["wheel.modification.tip_relief_start_roll_deg"].parse().unwrap();
        assert!((20.0..30.0).contains(&start), "{start}");
        let only_start = changes(&[("wheel.modification.root_relief_start_roll_deg", "15")]);
        assert_eq!(completed(&only_start, &all, &written)["wheel.modification.root_relief_um"], "0.0");
        assert!(completed(&changes(&[("wheel.modification.tip_relief_um", "0")]), &all, &written).is_empty());
        let other = changes(&[("operation.torque_nm", "0")]);
        assert_eq!(completed(&other, &all, &written), other);
    }
}
