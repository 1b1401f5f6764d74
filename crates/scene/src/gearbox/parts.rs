//! Parts of a gearbox file: their number, names, and positions on shafts.

use toml::Spanned;

use super::{
    schema::RawMesh,
    values::{Checked, missing, needed_number},
};
use crate::{Number, Source, Word};

/// Parts of a kind at the most: the matrices are dense.
const PARTS: usize = 100;

/// What every table of a list says.
pub(super) fn all<R, T>(tables: &[Spanned<R>], of: impl Fn(&Spanned<R>) -> Checked<T>) -> Checked<Vec<T>> {
    tables.iter().map(of).collect()
}

/// Refuses more parts of a kind than matrices are made for.
pub(super) fn few<R>(s: &Source<'_>, what: &str, tables: &[Spanned<R>]) -> Checked<()> {
    match tables.get(PARTS) {
        Some(table) => {
            let said = format!("a gearbox of {} {what}", tables.len());
            Err(s.conflict(&table.span(), said, format!("list {PARTS} at the most")))
        }
        None => Ok(()),
    }
}

/// What a mesh is called.
pub(super) fn mesh_name(raw: &RawMesh) -> String {
    let word = |word: &Word| word.as_ref().map_or("", |w| w.get_ref().as_str()).to_owned();
    match &raw.name {
        Some(own) => own.get_ref().clone(),
        None => format!("{}/{}", word(&raw.pinion), word(&raw.wheel)),
    }
}

/// No two of a kind with one name.
pub(super) fn distinct<'a, R>(
    s: &Source<'_>,
    what: &str,
    tables: &[Spanned<R>],
    names: impl Iterator<Item = &'a str>,
) -> Checked<()> {
    let mut seen: Vec<&str> = Vec::new();
    for (name, table) in names.zip(tables) {
        if seen.contains(&name) {
            let said = format!("there are two {what} with the name \"{name}\"");
            return Err(s.conflict(&table.span(), said, "give each a `name` of its own"));
        }
        seen.push(name);
    }
    Ok(())
}

/// Shaft and place of a part on it.
pub(super) fn place<R>(
    s: &Source<'_>,
    table: &Spanned<R>,
    name: &str,
    (shaft, position): (&Word, &Number),
    shafts: &[(String, f64)],
) -> Checked<(usize, f64)> {
    let on = shaft_of(s, table, name, shaft, shafts)?;
    let end = shafts[on].1;
    // Lengths add up to the last digit but a few, as those of a cone's steps: its end is still on the shaft.
    let said = (1e9 * end).round() / 1e9;
    Ok((on, needed_number(s, table, name, "position_mm", position, 0.0, said)?.min(end)))
}

/// Place on a shaft of a gear whose mid-plane may be beyond an end.
pub(super) fn place_of_gear<R>(
    s: &Source<'_>,
    table: &Spanned<R>,
    name: &str,
    (shaft, position): (&Word, &Number),
    shafts: &[(String, f64)],
) -> Checked<(usize, f64)> {
    let on = shaft_of(s, table, name, shaft, shafts)?;
    Ok((on, needed_number(s, table, name, "position_mm", position, -1e6, 1e6)?))
}

fn shaft_of<R>(
    s: &Source<'_>,
    table: &Spanned<R>,
    name: &str,
    shaft: &Word,
    shafts: &[(String, f64)],
) -> Checked<usize> {
    let Some(word) = shaft else { return Err(missing(s, table, name, "shaft", "the name of a shaft")) };
    shaft_called(s, "shaft", word, shafts)
}

/// Number of the shaft that a word names.
pub(super) fn shaft_called(
    s: &Source<'_>,
    key: &str,
    word: &Spanned<String>,
    shafts: &[(String, f64)],
) -> Checked<usize> {
    let known: Vec<(&str, usize)> = shafts.iter().enumerate().map(|(i, x)| (x.0.as_str(), i)).collect();
    s.one_of(key, word, &known)
}
