//! Checks of a gear's pitch errors.

use super::Checked;
use crate::schema::RawGear;
use crate::source::Source;

/// Largest pitch error, um: a millimetre is another gear.
const LARGEST: f64 = 1000.0;

/// Pitch errors that stand in the scene, um: one of each tooth, or none.
pub(super) fn pitch_errors(s: &Source<'_>, raw: &RawGear, teeth: u32) -> Checked<Vec<f64>> {
    let Some(list) = &raw.pitch_errors_um else { return Ok(Vec::new()) };
    if raw.pitch_errors_file.is_some() {
        let what = "a gear has both `pitch_errors_um` and `pitch_errors_file`";
        return Err(s.conflict(&list.span(), what, "keep the one or the other"));
    }
    let given = list.get_ref().len();
    if given != teeth as usize {
        let what = format!("`pitch_errors_um` has {given} values, but the gear has {teeth} teeth");
        return Err(s.conflict(&list.span(), what, "give one value a tooth, tooth 0 first"));
    }
    let values = list.get_ref().iter().map(|v| s.number("pitch_errors_um", &Some(v.clone()), 0.0, -LARGEST, LARGEST));
    values.collect()
}
