//! Which columns the rows of a scene will have: a misspelt one is told before hours of work, not after.

use analysis::lumped::is_lumped;
use toml::Spanned;

use super::Case;
use crate::{
    motion,
    output::history_columns,
    scene::{Scene, SceneError, Source, nearest},
};

/// Columns of single pairs go with the window, which is known when the motion begins.
const BY_PAIR: &str = "_pair_";

/// Columns that a scene's `history.csv` will have; `None` where only a run can tell.
fn of(scene: &Scene) -> Option<Vec<String>> {
    match &scene.motion {
        Some(_) if is_lumped(scene) => None,
        Some(_) => Some(motion::column_names(scene)),
        None => Some(history_columns(scene, &[])),
    }
}

/// A column as written, when every case may have it.
pub(super) fn known(s: &Source<'_>, key: &str, word: &Spanned<String>, cases: &[Case]) -> Result<String, SceneError> {
    let name = word.get_ref();
    for case in cases {
        let Some(all) = of(&case.scene) else { continue };
        if all.contains(name) || name.contains(BY_PAIR) {
            continue;
        }
        let all: Vec<&str> = all.iter().map(String::as_str).collect();
        return Err(SceneError::OutOfRange {
            place: s.place(&word.span()),
            key: key.to_owned(),
            value: format!("\"{name}\""),
            allowed: format!("a column of history.csv of the case \"{}\"", case.label),
            advice: advice(name, &all),
        });
    }
    Ok(name.clone())
}

/// What may have been meant.
pub(super) fn advice(name: &str, all: &[&str]) -> Option<String> {
    Some(match nearest(name, all) {
        Some(near) => format!("did you mean \"{near}\"?"),
        None => "docs/outputs.md lists the columns of every kind of analysis".into(),
    })
}
