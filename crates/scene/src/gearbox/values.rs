//! Values of a gearbox file: lists and matrices of given size, and required words.

use toml::Spanned;

use crate::spanned::{Numbers, Rows};
use crate::{Number, SceneError, Source, Word, table::Table};

pub(super) type Checked<T> = Result<T, SceneError>;

/// A square matrix of some size.
pub(super) fn square<R>(s: &Source<'_>, table: &Spanned<R>, rows: &Rows, size: usize) -> Checked<Vec<Vec<f64>>> {
    let Some(rows) = rows else {
        return Err(missing(s, table, "this table", "matrix_n_mm_rad", "rows of numbers"));
    };
    let found = rows.get_ref().len();
    if found != size {
        let advice =
            format!("give {size}: x, y, z and the turns about them, six a bearing in the order of the bearings");
        return Err(s.conflict(&rows.span(), format!("a matrix of {found} rows"), advice));
    }
    for row in rows.get_ref() {
        let own = row.get_ref();
        if own.len() != size || own.iter().any(|x| !x.is_finite()) {
            let said = format!("a row of {} entries, or one that is not a number", own.len());
            return Err(s.conflict(&row.span(), said, format!("give {size} numbers a row")));
        }
    }
    Ok(rows.get_ref().iter().map(|row| row.get_ref().clone()).collect())
}

/// A list of so many numbers, each up to `most` in size.
pub(super) fn numbers<const N: usize>(
    s: &Source<'_>,
    key: &str,
    list: &Numbers,
    most: f64,
) -> Checked<Option<[f64; N]>> {
    let Some(list) = list else { return Ok(None) };
    let found = list.get_ref().len();
    if found != N {
        let said = format!("`{key}` has {found} numbers");
        return Err(s.conflict(&list.span(), said, format!("give {N}")));
    }
    let mut all = [0.0; N];
    for (own, value) in all.iter_mut().zip(list.get_ref()) {
        let least = if key == "origin_mm" { -most } else { 0.0 };
        *own = s.number(key, &Some(value.clone()), 0.0, least, most)?;
    }
    Ok(Some(all))
}

/// So many numbers within a range.
pub(super) fn list(
    s: &Source<'_>,
    key: &str,
    list: &Numbers,
    wanted: usize,
    [low, high]: [f64; 2],
) -> Checked<Option<Vec<f64>>> {
    let Some(own) = list else { return Ok(None) };
    let found = own.get_ref().len();
    if found != wanted {
        let said = format!("`{key}` has {found} numbers");
        return Err(s.conflict(&own.span(), said, format!("give {wanted}")));
    }
    own.get_ref()
        .iter()
        .map(|value| s.number(key, &Some(value.clone()), 0.0, low, high))
        .collect::<Checked<_>>()
        .map(Some)
}

pub(super) fn needed_word<R>(
    s: &Source<'_>,
    table: &Spanned<R>,
    name: &str,
    key: &str,
    word: &Word,
    what: &str,
) -> Checked<String> {
    s.called(word)?.ok_or_else(|| missing(s, table, name, key, what))
}

pub(super) fn needed_number<R>(
    s: &Source<'_>,
    table: &Spanned<R>,
    name: &str,
    key: &str,
    value: &Number,
    low: f64,
    high: f64,
) -> Checked<f64> {
    if value.is_none() {
        return Err(missing(s, table, name, key, &format!("a number of {low} .. {high}")));
    }
    s.number(key, value, 0.0, low, high)
}

/// The number of a key that must be there, within the range of its row.
pub(super) fn needed_of<R>(
    s: &Source<'_>,
    (table, name): (&Spanned<R>, &str),
    of: &Table,
    key: &str,
    value: &Number,
) -> Checked<f64> {
    if value.is_none() {
        let (low, high, _) = of.number(key);
        return Err(missing(s, table, name, key, &format!("a number of {low} .. {high}")));
    }
    s.number_of(of, key, value)
}

/// The value of a key by its row, or the row's default; the names of key and field are one.
macro_rules! row {
    ($s:expr, $table:ident, $raw:ident.$key:ident) => {
        $crate::source_values::Entry::value(&$raw.$key, $s, &$crate::gearbox::schema::$table, stringify!($key))
    };
}

/// The value of a key by its row where it is written, else nothing.
macro_rules! given {
    ($s:expr, $table:ident, $raw:ident.$key:ident) => {
        $raw.$key.is_some().then(|| row!($s, $table, $raw.$key)).transpose()
    };
}

pub(super) use {given, row};

pub(super) fn missing<R>(s: &Source<'_>, table: &Spanned<R>, name: &str, key: &str, what: &str) -> SceneError {
    s.conflict(&table.span(), format!("{name} has no `{key}`"), format!("give {what}"))
}
