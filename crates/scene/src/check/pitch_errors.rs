//! Pitch errors of a gear.

use super::Checked;
use crate::data_file::DataFile;
use crate::inputs::named;
use crate::schema::RawGear;
use crate::source::Source;

/// Largest pitch error, um: a millimetre is another gear.
const LARGEST: f64 = 1000.0;

/// Values that stand in the scene, um, or the file that has them.
type PitchErrors = (Vec<f64>, Option<DataFile<Vec<f64>>>);

/// Pitch errors: a list, or a file.
pub(super) fn pitch_errors(s: &Source<'_>, raw: &RawGear, teeth: u32) -> Checked<PitchErrors> {
    let in_file = raw.pitch_errors_file.as_ref();
    let in_file = in_file.map(|word| named(s, "pitch_errors_file", word)).transpose()?;
    let Some(list) = &raw.pitch_errors_um else { return Ok((Vec::new(), in_file)) };
    if in_file.is_some() {
        let what = "a gear has both `pitch_errors_um` and `pitch_errors_file`";
        return Err(s.conflict(&list.span(), what, "keep the one or the other"));
    }
    let given = list.get_ref().len();
    if given != teeth as usize {
        let what = format!("`pitch_errors_um` has {given} values, but the gear has {teeth} teeth");
        return Err(s.conflict(&list.span(), what, "give one value a tooth, tooth 0 first"));
    }
    let values = list.get_ref().iter().map(|v| s.number("pitch_errors_um", &Some(v.clone()), 0.0, -LARGEST, LARGEST));
    Ok((values.collect::<Checked<_>>()?, None))
}
