//! Contact maps between runs: their keys in the store, and the progress of their computation.

use std::{fmt::Debug, path::PathBuf, time::Instant};

use answer::Remark;
use contact_map::{ContactMap, MapWork, OffsetError};
use geometry::GearPair;
use scene::{Operation, Scene};

use crate::{Progress, remark};

/// The scene as far as its gears and contact depend on it: all but the speed.
pub(crate) fn without_speed(scene: &Scene) -> Scene {
    let operation = Operation { speed_rpm: 1000.0, ..scene.operation };
    Scene { operation, set: Vec::new(), ..scene.clone() }
}

/// All but the gears that a map depends on, in words: the scene without what it does in time, the flanks with what
/// stands in files of their own, and what the map must hold.
pub(crate) fn map_words(scene: &Scene, pair: &GearPair, request: &impl Debug) -> String {
    let at_rest = Scene { name: String::new(), file: PathBuf::new(), motion: None, ..without_speed(scene) };
    // What stands in the file: not how it was written.
    let at_rest = serde_json::to_string(&at_rest).expect("a scene is written as JSON");
    format!("{request:?} {pair:?} {at_rest}")
}

/// Says beside the bar how far a map is made, after what it is of: contacts solved, about how many it takes, and how
/// long the rest is going to last at the pace so far.
pub(crate) fn map_teller<'a>(progress: &'a dyn Progress, of: &'a str) -> impl Fn(MapWork) + Sync + 'a {
    let began = Instant::now();
    move |MapWork { contacts, of_contacts }| {
        let left = began.elapsed().as_secs_f64() * (of_contacts as f64 / contacts.max(1) as f64 - 1.0);
        progress.say(format!("{of}{contacts} of about {of_contacts} contacts, {left:.0} s left"));
    }
}

/// Says how far pitch errors as offsets of the pairs of a map are off.
pub(crate) fn pitch_errors_told(error: &OffsetError, map: &ContactMap) -> Remark {
    let OffsetError { checks, rms_mm, largest_mm } = *error;
    let percent = 100.0 * rms_mm / map.certificate().deflection_mm;
    remark::pitch_errors_on_map(checks, 1e3 * rms_mm, 1e3 * largest_mm, percent)
}
