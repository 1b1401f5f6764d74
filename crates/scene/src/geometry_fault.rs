//! The keys of a scene that an error of the geometry concerns.

use geometry::GeometryError;

use crate::{Scene, SceneError};

impl Scene {
    /// The complaint of the geometry at the line of the key at fault; `table` is `pinion`, `wheel` or `pair`.
    pub(crate) fn geometry_fault(&self, table: &'static str, source: GeometryError) -> SceneError {
        let keys = keys(table, &source);
        // A gear's heading says less than a key, but more than the file.
        let names: Vec<&str> = keys.iter().map(String::as_str).chain([table]).collect();
        SceneError::Geometry { place: self.place_of(&names), file: self.file.clone(), table, source: Box::new(source) }
    }
}

/// Keys that the complaint may be about, the likeliest first.
fn keys(table: &str, error: &GeometryError) -> Vec<String> {
    let own = |key: &str| format!("{table}.{key}");
    let of = |gear: &str, key: &str| format!("{gear}.{key}");
    let pair = |key: &str| format!("pair.{key}");
    let both = |key: &str| [of("pinion", key), of("wheel", key)];
    match error {
        GeometryError::OutOfRange { name, .. } => named(table, name),
        GeometryError::Thickness { .. } => vec![own("profile_shift"), own("thickness_allowance_mm")],
        GeometryError::PointedTooth { .. } => {
            vec![
                own("tip_diameter_mm"),
                own("profile_shift"),
                pair("addendum_coefficient"),
                pair("normal_pressure_angle_deg"),
                own("thickness_allowance_mm"),
                own("teeth"),
            ]
        }
        GeometryError::RootRadius { .. } => {
            vec![
                own("shaper.tip_rounding_coefficient"),
                pair("root_radius_coefficient"),
                pair("dedendum_coefficient"),
                own("thickness_allowance_mm"),
            ]
        }
        GeometryError::Bore { .. } => vec![own("bore_diameter_mm"), pair("dedendum_coefficient"), own("profile_shift")],
        GeometryError::Mismatch { .. } => both("helix_angle_deg").into(),
        GeometryError::CentreDistance { .. } => vec![pair("centre_distance_mm")],
        GeometryError::Jammed { .. } => [vec![pair("centre_distance_mm")], both("profile_shift").into()].concat(),
        GeometryError::TipClearance { gear, .. } => {
            vec![
                pair("centre_distance_mm"),
                of(gear, "tip_diameter_mm"),
                pair("dedendum_coefficient"),
                pair("addendum_coefficient"),
            ]
        }
        GeometryError::Interference { tip, root, .. } => vec![
            of(tip, "tip_diameter_mm"),
            pair("addendum_coefficient"),
            pair("centre_distance_mm"),
            pair("root_radius_coefficient"),
            pair("dedendum_coefficient"),
            of(root, "profile_shift"),
        ],
        GeometryError::InternalPinion => vec![of("pinion", "teeth")],
        GeometryError::Trochoid { .. } => {
            [vec![of("pinion", "tip_diameter_mm")], both("teeth").into(), vec![pair("addendum_coefficient")]].concat()
        }
        GeometryError::Involute { .. } => {
            vec![of("wheel", "tip_diameter_mm"), pair("addendum_coefficient"), of("pinion", "teeth")]
        }
        GeometryError::ShaperInterference { .. } => {
            vec![own("shaper.teeth"), own("shaper"), own("tip_diameter_mm"), own("teeth")]
        }
        GeometryError::ContactRatio { undercut: Some(own), .. } => {
            vec![of(own.gear, "profile_shift"), of(own.gear, "teeth")]
        }
        GeometryError::NoContact { .. } | GeometryError::ContactRatio { .. } => {
            let tips = both("tip_diameter_mm");
            let widths = both("face_width_mm");
            let of_pair = ["addendum_coefficient", "mid_face_offset_mm", "face_width_mm"].map(pair);
            [vec![pair("centre_distance_mm")], tips.into(), of_pair.into(), widths.into()].concat()
        }
        GeometryError::FacesApart { .. } => {
            [vec![pair("mid_face_offset_mm")], both("face_width_mm").into(), vec![pair("face_width_mm")]].concat()
        }
        GeometryError::OffFlank { name, .. } => on_flank(table, name),
        GeometryError::GridOffFlank { .. } | GeometryError::NoSuchTooth { .. } => flank_keys(table, &["topography"]),
        GeometryError::PitchErrors { .. } => vec![own("pitch_errors_file"), own("pitch_errors_um")],
        _ => Vec::new(),
    }
}

/// A quantity that the geometry calls by its name.
fn named(table: &str, name: &str) -> Vec<String> {
    const NAMES: [(&str, &[&str]); 15] = [
        ("normal module", &["pair.normal_module_mm"]),
        ("face width", &["face_width_mm", "pair.face_width_mm"]),
        ("offset of the mid-faces", &["pair.mid_face_offset_mm"]),
        ("bore diameter", &["bore_diameter_mm"]),
        ("addendum", &["pair.addendum_coefficient"]),
        ("dedendum", &["pair.dedendum_coefficient", "profile_shift", "teeth"]),
        ("root radius", &["pair.root_radius_coefficient"]),
        ("normal pressure angle", &["pair.normal_pressure_angle_deg"]),
        ("tip diameter", &["tip_diameter_mm", "pair.addendum_coefficient", "profile_shift"]),
        ("pitch error", &["pitch_errors_file", "pitch_errors_um"]),
        ("teeth of the shaper", &["shaper.teeth", "teeth"]),
        ("profile shift of the shaper", &["shaper.profile_shift"]),
        ("profile shifts of ring and shaper", &["profile_shift", "shaper.profile_shift"]),
        ("teeth of the pinion", &["teeth"]),
        ("length of ", &[]),
    ];
    let found = NAMES.iter().find(|(start, _)| name.starts_with(start)).map(|(_, keys)| *keys);
    match found {
        Some(keys) if !keys.is_empty() => {
            keys.iter().map(|k| if k.starts_with("pair.") { (*k).to_owned() } else { format!("{table}.{k}") }).collect()
        }
        _ => on_flank(table, name),
    }
}

/// Starts and lengths of micro-geometry.
fn on_flank(table: &str, name: &str) -> Vec<String> {
    let what = ["tip_relief", "root_relief", "end_relief"].into_iter().find(|w| name.contains(&w.replace('_', " ")));
    match what {
        Some("end_relief") => flank_keys(table, &["end_relief_lower_length_mm", "end_relief_upper_length_mm"]),
        Some(what) => flank_keys(
            table,
            &[&format!("{what}_start_diameter_mm"), &format!("{what}_start_roll_deg"), &format!("{what}_um")],
        ),
        None => flank_keys(table, &["evaluation_start_diameter_mm"]),
    }
}

/// Keys of either flank, then of both.
fn flank_keys(table: &str, keys: &[&str]) -> Vec<String> {
    let places = ["modification.drive", "modification.coast", "modification"];
    places.iter().flat_map(|place| keys.iter().map(move |key| format!("{table}.{place}.{key}"))).collect()
}
