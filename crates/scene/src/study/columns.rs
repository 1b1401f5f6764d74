//! Columns that the rows of a scene will have. A misspelt column is reported before hours of work and not after.

use toml::Spanned;

use super::StudyCase;
use crate::{Scene, SceneError, Source, nearest};

/// Columns that a scene's rows will have; `None` if only a run can tell.
pub type ColumnsOf<'a> = &'a dyn Fn(&Scene) -> Option<Vec<String>>;

/// Columns of single pairs go with the window, which is known when the motion begins.
const BY_PAIR: &str = "_pair_";

/// A column as written, when every case may have it.
pub(super) fn known(
    s: &Source<'_>,
    key: &str,
    word: &Spanned<String>,
    (cases, columns): (&[StudyCase], ColumnsOf<'_>),
) -> Result<String, SceneError> {
    let name = word.get_ref();
    for case in cases {
        let Some(all) = columns(&case.scene) else { continue };
        if all.contains(name) || name.contains(BY_PAIR) {
            continue;
        }
        let all: Vec<&str> = all.iter().map(String::as_str).collect();
        return Err(SceneError::OutOfRange {
            place: s.place(&word.span()),
            key: key.to_owned(),
            value: format!("\"{name}\""),
            allowed: format!("a column of history.csv of the case \"{}\"", case.label).into(),
            advice: column_advice(name, &all),
        });
    }
    Ok(name.clone())
}

/// Hint about a column that does not exist: the column that was probably intended.
pub fn column_advice(name: &str, all: &[&str]) -> Option<String> {
    Some(match nearest(name, all) {
        Some(near) => format!("did you mean \"{near}\"?"),
        None => "docs/outputs.md lists the columns of every kind of analysis".into(),
    })
}
