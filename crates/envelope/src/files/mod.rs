//! Files of the envelope: every failure mode with its figures, and maps of where methods fail.

mod markdown;
mod page;
mod rows;
mod words;
mod write;

use markdown::{maps_markdown, modes_markdown};
pub use write::{documented, envelope_answer, find_envelope_tables, replace_envelope_tables, write_envelope};

use crate::{DrawnMap, EnvelopeMap, Examined, FailureMode};

/// Failure modes that were examined, and maps that were drawn, in their order.
#[derive(Debug, Default)]
pub struct EnvelopeResult {
    /// Failure modes.
    pub modes: Vec<(FailureMode, Examined)>,
    /// Maps with the seconds that they took.
    pub maps: Vec<(EnvelopeMap, DrawnMap, f64)>,
}

impl EnvelopeResult {
    /// Failure modes that do not show what they have to, and maps with a cell that is wrong without a word.
    /// `None` where all hold.
    pub fn missed(&self) -> Option<String> {
        let modes = self.modes.iter().filter(|(_, found)| !found.holds()).map(|(mode, _)| mode.label());
        let maps = self.maps.iter().filter(|(_, drawn, _)| drawn.wrong() > 0);
        let all: Vec<String> = modes.chain(maps.map(|(map, ..)| format!("map ({})", map.key))).collect();
        (!all.is_empty()).then(|| all.join(", "))
    }
}
