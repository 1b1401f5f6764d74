//! Helix angle over total contact ratio.

use super::{
    Cell, EnvelopeMap, Outcome, judge,
    torque_misalignment::{FILE, FINER, PAIR},
};

pub(super) const MAP: EnvelopeMap = EnvelopeMap {
    key: "b",
    name: "helix angle over total contact ratio",
    file: FILE,
    judged: "Mean static transmission error at 5 %, against the same at 1 %: solved where both bounds meet. The face width makes the contact ratio; where none does, there is no such pair.",
    columns: ("total contact ratio", &["1.7", "2.0", "2.4", "3.0", "4.0", "5.0"]),
    rows: ("helix angle, degrees", &["0", "5", "10", "20", "30", "40"]),
    layers: &[""],
    cell,
};

/// Face widths of gears, modules.
const WIDTHS: [f64; 2] = [2.0, 25.0];

fn cell(_: &str, helix: &str, ratio: &str) -> Cell {
    let settings = |width: f64| {
        [
            format!("pinion.helix_angle_deg={helix}"),
            format!("pair.face_width_mm={width:.3}"),
            format!("operation.torque_nm={:.1}", 12.0 * width),
        ]
    };
    let none = |why: String| Cell::new(Outcome::None, &settings(24.0)).saying(why);
    let module = 3.0;
    let pair = match judge::scene(FILE, PAIR, &settings(24.0)).and_then(|s| s.gear_pair()) {
        Ok(pair) => pair,
        Err(error) => return Cell::new(Outcome::Refused, &settings(24.0)).saying(error),
    };
    let (Ok(ratio), Ok(helix)) = (ratio.parse::<f64>(), helix.parse::<f64>()) else {
        return none("no number".to_owned());
    };
    let overlap = ratio - pair.transverse_contact_ratio();
    let width = overlap * std::f64::consts::PI * module / helix.to_radians().sin();
    if !(WIDTHS[0] * module..=WIDTHS[1] * module).contains(&width) {
        return none(format!("transverse contact ratio {:.2} alone", pair.transverse_contact_ratio()));
    }
    judge::at_rest(FILE, PAIR, &settings(width), &FINER)
}
