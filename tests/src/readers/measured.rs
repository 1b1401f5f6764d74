//! What was measured on a gear.

use std::path::Path;

use geometry::{
    FlankModification, Gear, GearData, GearModifications,
    modification::{Topography, parse_pitch_errors},
};
use metrology::{GdeNames, MeasuredGear, MetrologyError};

/// A topography, and the gear that is ground so.
pub fn topography(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    match Topography::parse(text, Path::new("fuzz.csv")) {
        Ok(topography) => {
            let flank = FlankModification { topography: Some(topography), ..FlankModification::default() };
            modified(GearModifications::both(flank));
        }
        Err(e) => drop((e.to_string(), e.hint())),
    }
}

/// Pitch errors, and the gear that has them.
pub fn pitch_errors(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    match parse_pitch_errors(text, Path::new("fuzz.txt")) {
        Ok(pitch_errors) => modified(GearModifications { pitch_errors, ..GearModifications::default() }),
        Err(e) => drop((e.to_string(), e.hint())),
    }
}

/// A curve file: what it says, its flanks, and the file that is written of it.
pub fn mka(bytes: &[u8]) {
    used(metrology::read_mka(bytes, Path::new("fuzz.mka")));
}

/// Gear data exchange, by names that the seeds have.
pub fn gde(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    let name = str::to_owned;
    let names = GdeNames {
        teeth: name("gear/@z"),
        normal_module: name("gear/mn"),
        helix_angle: name("gear/beta"),
        pressure_angle: name("gear/alpha"),
        profiles: name("measurement/profile"),
        helices: name("measurement/lead"),
        tooth: name("@tooth"),
        first_tooth: 1,
        side: name("@datum_face"),
        left: name("A"),
        right: name("B"),
        place: name("at"),
        from: name("range/@from"),
        to: name("range/@to"),
        values: name("points/v"),
        undefined: Some(-9999.0),
    };
    used(metrology::read_gde(text, &names, Path::new("fuzz.xml")));
}

fn used(read: Result<MeasuredGear, MetrologyError>) {
    let Ok(gear) = Gear::new(GearData::default()) else { return };
    match read {
        Ok(measured) => {
            let written = metrology::write_mka(&measured);
            let _ = metrology::read_mka(written.as_bytes(), Path::new("again.mka"));
            let _ = metrology::evaluate(&measured, &gear).map_err(|e| e.to_string());
            if let Ok(flanks) = metrology::flanks(&measured, &gear) {
                let [left, right] = flanks
                    .topographies
                    .map(|topography| FlankModification { topography, ..FlankModification::default() });
                modified(GearModifications { left, right, pitch_errors: flanks.pitch_errors });
            }
        }
        Err(e) => drop((e.to_string(), e.hint())),
    }
}

fn modified(modifications: GearModifications) {
    let Ok(nominal) = Gear::new(GearData::default()) else { return };
    let _ = nominal.with_modifications(modifications).map_err(|e| e.to_string());
}
