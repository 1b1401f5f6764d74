//! Gear data as a REXS file (version 1.4, XML), in the form that [`crate::read_pair`] reads, for use in other programs.

use std::fmt::Write;

use geometry::{Gear, GearPair};

/// Identifiers of the components.
const STAGE: u32 = 1;
const GEARS: [u32; 2] = [2, 3];
const FLANKS: [u32; 2] = [4, 5];

/// The pair as a `cylindrical_stage` with two gears and their flanks. The axes are along x, the wheel is beside the
/// pinion along z, and each gear is at its mid-face. A ring is a `ring_gear` with negative number of teeth and centre
/// distance, as in ISO 21771, and with positive diameters. Numbers are read back with the same bits.
pub fn rexs_of(pair: &GearPair) -> String {
    let mut t = String::from("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
    let version = env!("CARGO_PKG_VERSION");
    // Writing to a String cannot fail.
    let _ = writeln!(t, "<model version=\"1.4\" applicationId=\"ale-gear\" applicationVersion=\"{version}\">");
    let (stage, [pinion, wheel]) = (STAGE, GEARS);
    t.push_str(" <relations>\n");
    let _ = writeln!(
        t,
        "  <relation id=\"1\" type=\"stage\"><ref id=\"{stage}\" role=\"stage\" hint=\"cylindrical_stage\"/>\
         <ref id=\"{pinion}\" role=\"gear_1\" hint=\"cylindrical_gear\"/>\
         <ref id=\"{wheel}\" role=\"gear_2\" hint=\"{}\"/></relation>",
        kind(&pair.wheel)
    );
    for (i, own) in [&pair.pinion, &pair.wheel].into_iter().enumerate() {
        let (gear, flank, id, kind) = (GEARS[i], FLANKS[i], 2 + i, kind(own));
        let _ = writeln!(
            t,
            "  <relation id=\"{id}\" type=\"flank\"><ref id=\"{gear}\" role=\"gear\" hint=\"{kind}\"/>\
             <ref id=\"{flank}\" role=\"left\" hint=\"cylindrical_gear_flank\"/>\
             <ref id=\"{flank}\" role=\"right\" hint=\"cylindrical_gear_flank\"/></relation>"
        );
    }
    t.push_str(" </relations>\n <components>\n");
    let width = pair.face_width();
    let _ = writeln!(
        t,
        "  <component id=\"{stage}\" type=\"cylindrical_stage\">\
         <attribute id=\"center_distance\" unit=\"mm\">{}</attribute>\
         <attribute id=\"common_face_width\" unit=\"mm\">{width}</attribute></component>",
        pair.centre_distance()
    );
    for (i, gear) in [&pair.pinion, &pair.wheel].into_iter().enumerate() {
        component(&mut t, gear, i, [[0.0, 0.0], [pair.centre_distance(), pair.mid_face_offset()]][i]);
    }
    t.push_str(" </components>\n</model>\n");
    t
}

/// Type of the component of a gear.
fn kind(gear: &Gear) -> &'static str {
    if gear.is_internal() { "ring_gear" } else { "cylindrical_gear" }
}

fn component(t: &mut String, gear: &Gear, i: usize, [beside, along]: [f64; 2]) {
    let data = gear.data();
    let vector = |x: f64, z: f64| format!("<array><c>{x}</c><c>0</c><c>{z}</c></array>");
    let of_gear: [(&str, &str, String); 8] = [
        ("number_of_teeth", "none", gear.signed_teeth().to_string()),
        ("normal_module", "mm", data.normal_module.to_string()),
        ("face_width", "mm", data.face_width.to_string()),
        ("helix_angle_reference_diameter", "deg", data.helix_angle.to_degrees().to_string()),
        ("tip_diameter", "mm", (2.0 * gear.tip_radius().abs()).to_string()),
        ("root_diameter", "mm", (2.0 * gear.root_radius().abs()).to_string()),
        ("u_axis_vector", "mm", vector(1.0, 0.0)),
        ("support_vector", "mm", vector(along, beside)),
    ];
    let of_flank: [(&str, &str, String); 2] = [
        ("normal_pressure_angle", "deg", data.normal_pressure_angle.to_degrees().to_string()),
        ("addendum_modification_coefficient", "none", data.profile_shift.to_string()),
    ];
    let lists = [(GEARS[i], kind(gear), &of_gear[..]), (FLANKS[i], "cylindrical_gear_flank", &of_flank[..])];
    for (id, kind, attributes) in lists {
        let _ = writeln!(t, "  <component id=\"{id}\" type=\"{kind}\">");
        for (name, unit, value) in attributes {
            let _ = writeln!(t, "   <attribute id=\"{name}\" unit=\"{unit}\">{value}</attribute>");
        }
        t.push_str("  </component>\n");
    }
}

#[cfg(test)]
mod tests {
    use geometry::{Gear, GearData, GearPair};

    use super::rexs_of;
    use crate::{Starter, read_pair};

    /// What is written is read as it was.
    #[test]
    fn a_pair_comes_back() {
        let data = GearData {
            teeth: 17,
            profile_shift: 0.145,
            helix_angle: 15.8f64.to_radians(),
            bore_diameter: 20.0,
            ..GearData::default()
        };
        let wheel = GearData { teeth: 103, profile_shift: 0.0, helix_angle: -data.helix_angle, ..data.clone() };
        let pair = GearPair::new(Gear::new(data).unwrap(), Gear::new(wheel).unwrap(), Some(187.5)).unwrap();
        let read = read_pair(&rexs_of(&pair), 1, 1, &Starter::default()).unwrap().starter;
        assert_eq!((read.teeth, read.module_mm, read.face_width_mm), ([17, 103], 3.0, 20.0));
        assert!((read.helix_deg - 15.8).abs() < 1e-12 && read.profile_shift == [0.145, 0.0]);
        assert_eq!(read.centre_distance_mm, Some(187.5));
        let tips = [&pair.pinion, &pair.wheel].map(|gear| Some(2.0 * gear.tip_radius()));
        assert_eq!(read.tip_diameter_mm, tips);
        assert_eq!((read.own_face_width_mm, read.mid_face_offset_mm), ([None, None], None));
    }

    /// A ring comes back as a ring.
    #[test]
    fn a_ring_comes_back() {
        let data = GearData { teeth: 20, bore_diameter: 20.0, ..GearData::default() };
        let ring = GearData { teeth: 52, addendum_coefficient: 0.85, bore_diameter: -200.0, ..data.clone() };
        let gears = [Gear::new(data).unwrap(), Gear::new(ring.with_usual_shaper(0.0)).unwrap()];
        let [pinion, wheel] = gears;
        let pair = GearPair::new(pinion, wheel, None).unwrap();
        let read = read_pair(&rexs_of(&pair), 1, 1, &Starter::default()).unwrap().starter;
        assert_eq!(read.teeth, [20, -52]);
        assert_eq!(read.centre_distance_mm, Some(-pair.centre_distance()));
        assert_eq!(read.tip_diameter_mm[1], Some(-2.0 * pair.wheel.tip_radius()));
        let text = read.text("a.toml");
        let scene = crate::Scene::parse(&text, "a.toml".as_ref()).unwrap_or_else(|e| panic!("{e}\n{text}"));
        assert!((scene.gear_pair().unwrap().centre_distance() - pair.centre_distance()).abs() < 1e-9);
    }

    /// Faces of two widths and at two heights come back as well.
    #[test]
    fn widths_and_offset_come_back() {
        let data = GearData { face_width: 26.0, ..GearData::default() };
        let wheel = GearData { face_width: 24.0, helix_angle: -data.helix_angle, ..data.clone() };
        let pair = GearPair::new(Gear::new(data).unwrap(), Gear::new(wheel).unwrap(), None).unwrap();
        let pair = pair.with_mid_face_offset(-0.75).unwrap();
        let read = read_pair(&rexs_of(&pair), 1, 1, &Starter::default()).unwrap().starter;
        assert_eq!((read.own_face_width_mm, read.mid_face_offset_mm), ([Some(26.0), Some(24.0)], Some(-0.75)));
        let text = read.text("a.toml");
        let scene = crate::Scene::parse(&text, "a.toml".as_ref()).unwrap_or_else(|e| panic!("{e}\n{text}"));
        let again = scene.gear_pair().unwrap();
        assert_eq!((again.common_face(), again.faces()), (pair.common_face(), pair.faces()));
    }
}
