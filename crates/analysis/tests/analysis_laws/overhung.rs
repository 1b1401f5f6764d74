//! A pinion outside of its bearings beside CalculiX, where pinion and shaft are one solid.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use std::path::Path;

use analysis::{Context, Ending, NoObserver, solve};
use scene::gearbox::Gearbox;
use serde_json::Value;

/// What CalculiX found: `tests/scripts/overhung_pinion_ccx.py`.
struct Reference(Value);

impl Reference {
    fn read(name: &str) -> Self {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data").join(name);
        Self(serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap())
    }

    fn numbers(&self, pointer: &str) -> Vec<f64> {
        self.0.pointer(pointer).unwrap().as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect()
    }

    /// Torque of the pinion, N mm.
    fn torque(&self) -> f64 {
        1e3 * self.0["torque_nm"].as_f64().unwrap()
    }

    /// Normal force of each strip of the face, all teeth together, N.
    fn strips(&self) -> Vec<f64> {
        let teeth: Vec<&String> = self.0["strip_forces_n"].as_object().unwrap().keys().collect();
        let of = |tooth: &&String| self.numbers(&format!("/strip_forces_n/{tooth}"));
        let mut sum = of(&teeth[0]);
        teeth[1..].iter().for_each(|t| sum.iter_mut().zip(of(t)).for_each(|(a, b)| *a += b));
        sum
    }

    /// f_in by the turn of a section of the pinion, um over the face: lean of the wheel's axis against the pinion's in
    /// the plane of action of left flanks, the wheel held.
    fn misalignment(&self, section: &str, [width, pressure_angle]: [f64; 2]) -> f64 {
        let turn = self.numbers(&format!("/{section}/turn_rad"));
        1e3 * width * (-turn[1] * pressure_angle.sin() + turn[0] * pressure_angle.cos())
    }
}

/// What the gearbox has for the same.
struct Found {
    misalignment: f64,
    strips: Vec<f64>,
}

fn solved(text: &str, reference: &Reference) -> (Found, [f64; 2]) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/gearbox");
    let file = Gearbox::parse(text, &folder.join("overhung_pinion.toml")).unwrap_or_else(|e| panic!("{e}"));
    let found =
        solve(&file, Context::new(&mut NoObserver)).and_then(Ending::finished).unwrap_or_else(|e| panic!("{e}"));
    let torque = found.input_torque.abs();
    assert!((torque / reference.torque() - 1.0).abs() < 1e-3, "{torque} N mm beside {}", reference.torque());
    assert!(found.certificate.iter().all(|share| *share < 1e-8), "{:?}", found.certificate);
    let mesh = &found.positions[0].meshes[0];
    let pair = &found.pairs[0];
    let width = pair.face_width();
    let mut strips = vec![0.0; reference.strips().len()];
    let count = strips.len();
    // dF = F' dz / cos(beta_b), slices of one height.
    let length = width / found.meshes[0].slices as f64 / pair.pinion.base_helix_angle().cos();
    for slice in &mesh.slices {
        let at = ((slice.z / width + 0.5) * count as f64).floor();
        strips[(at.max(0.0) as usize).min(count - 1)] += slice.line_load * length;
    }
    let force = strips.iter().sum::<f64>() / mesh.normal_force;
    assert!((force - 1.0).abs() < 1e-9, "strips have {force} of the normal force");
    (Found { misalignment: 1e3 * mesh.misalignment_in_plane, strips }, [width, pair.working_pressure_angle()])
}

fn largest_over_mean(strips: &[f64]) -> f64 {
    strips.iter().copied().fold(0.0, f64::max) * strips.len() as f64 / strips.iter().sum::<f64>()
}

/// Deviations of misalignment and of largest over mean line load from CalculiX, told and handed on.
fn off(name: &str, section: &str, text: &str, reference: &Reference) -> [f64; 2] {
    let (found, shape) = solved(text, reference);
    let (wanted, own) = (reference.misalignment(section, shape), found.misalignment);
    let [load, theirs] = [&found.strips, &reference.strips()].map(|s| largest_over_mean(s));
    let parts = found.strips.iter().zip(reference.strips()).map(|(a, b)| (a - b).abs() / reference.strips()[0]);
    println!(
        "{name}: f_in {own:.3} beside {wanted:.3} um ({:+.2} %), largest over mean {load:.4} beside {theirs:.4} \
         ({:+.2} %), strips within {:.2} % of the largest",
        100.0 * (own / wanted - 1.0),
        100.0 * (load / theirs - 1.0),
        100.0 * parts.fold(0.0, f64::max)
    );
    println!("  strips, N: {:.0?}\n  CalculiX:  {:.0?}", found.strips, reference.strips());
    [own / wanted - 1.0, load / theirs - 1.0]
}

/// The shipped box at rest.
fn shipped() -> String {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/gearbox");
    let text = std::fs::read_to_string(folder.join("overhung_pinion.toml")).unwrap();
    text.split_once("[motion]").unwrap().0.to_owned()
}

/// The shipped box, the shaft a beam up to a stub that is meshed with its pinion: misalignment of the section where the
/// two meet and largest over mean line load within 3 % of pinion and shaft as one solid in CalculiX.
#[test]
fn hub_and_shaft_in_one_are_those_of_calculix() {
    let reference = Reference::read("overhung_pinion.json");
    let [misalignment, load] = off("hub and shaft in one", "stub", &shipped(), &reference);
    assert!(misalignment.abs() < 0.03, "misalignment off by {:.2} %", 100.0 * misalignment);
    assert!(load.abs() < 0.03, "largest over mean line load off by {:.2} %", 100.0 * load);
}

/// The pinion with a helix of 15 degrees: three pairs share the load, an axial force tilts the shaft.
#[test]
fn a_helical_pinion_in_one_with_its_shaft_is_that_of_calculix() {
    let reference = Reference::read("overhung_helical_pinion.json");
    let distance = 0.5 * 3.0 / 15f64.to_radians().cos() * 53.0;
    let text = shipped()
        .replace("origin_mm = [79.5, ", &format!("origin_mm = [{distance:?}, "))
        .replace("overhung_pair.toml", "overhung_helical_pair.toml")
        .replace("torque_nm = 574.67", &format!("torque_nm = {:?}", 1e-3 * reference.torque() * 32.0 / 21.0));
    let [misalignment, load] = off("helical, hub and shaft in one", "stub", &text, &reference);
    assert!(misalignment.abs() < 0.03, "misalignment off by {:.2} %", 100.0 * misalignment);
    assert!(load.abs() < 0.03, "largest over mean line load off by {:.2} %", 100.0 * load);
}

/// The end of the stub held by its means, not node by node: the same, as plane sections stay nearly plane there.
#[test]
fn the_coupling_at_a_stubs_end_does_not_matter() {
    let reference = Reference::read("overhung_pinion.json");
    let set = "scene = \"overhung_pair.toml\"\nset = [\"pinion.bore.coupling=distributing\"]";
    let text = shipped().replace("scene = \"overhung_pair.toml\"", set);
    let [misalignment, load] = off("the same, distributing", "stub", &text, &reference);
    assert!(misalignment.abs() < 0.03, "misalignment off by {:.2} %", 100.0 * misalignment);
    assert!(load.abs() < 0.03, "largest over mean line load off by {:.2} %", 100.0 * load);
}

/// A ring of teeth on a rigid bore of the shaft's diameter, the shaft a beam to its end: within 3 % as well, of the
/// hub's own turn. Held by the means of its bore the ring lacks the shaft inside of it, and the load is too even.
#[test]
fn a_ring_on_the_shaft_beside_calculix() {
    let reference = Reference::read("overhung_pinion.json");
    let ring = |more: &str| {
        let sections = "outer_diameter_mm = 45.0\ninner_diameter_mm = 16.0\n";
        let longer = format!("{sections}[[shaft.section]]\nlength_mm = 45.0\n{sections}");
        let set = format!("scene = \"ring_pair.toml\"\n{more}");
        shipped()
            .replacen(sections, &longer, 1)
            .replace("seat_mm = 155.0\n", "")
            .replace("scene = \"overhung_pair.toml\"\n", &set)
    };
    let [misalignment, load] = off("ring on a rigid bore", "hub", &ring(""), &reference);
    assert!(misalignment.abs() < 0.03, "misalignment off by {:.2} %", 100.0 * misalignment);
    assert!(load.abs() < 0.03, "largest over mean line load off by {:.2} %", 100.0 * load);
    let [_, load] =
        off("ring held by its means", "hub", &ring("set = [\"pinion.bore.coupling=distributing\"]\n"), &reference);
    assert!((-0.12..-0.05).contains(&load), "a ring without a shaft in it: {:.2} %", 100.0 * load);
}
