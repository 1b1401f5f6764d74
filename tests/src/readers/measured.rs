//! What was measured on a gear.

use std::path::Path;

use geometry::{
    Gear, GearData, GearModifications,
    modification::{FlankModification, Topography, parse_pitch_errors},
};

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

fn modified(modifications: GearModifications) {
    let Ok(nominal) = Gear::new(GearData::default()) else { return };
    let _ = nominal.with_modifications(modifications).map_err(|e| e.to_string());
}
