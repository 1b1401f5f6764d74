//! Which columns the rows of a scene will have: a misspelt one is told before hours of work, not after.

use toml::Spanned;

use super::StudyCase;
use crate::{Scene, SceneError, Source, nearest};

/// Columns that a scene's rows will have; `None` where only a run can tell.
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

/// What may have been meant by a column that is not there.
pub fn column_advice(name: &str, all: &[&str]) -> Option<String> {
    Some(match nearest(name, all) {
        Some(near) => format!("did you mean \"{near}\"?"),
        None => "docs/outputs.md lists the columns of every kind of analysis".into(),
    })
}
