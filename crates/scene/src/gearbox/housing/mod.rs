//! The housing of a gearbox file: a matrix in the file, or one from another program.
//!
//! | module | what it reads |
//! |---|---|
//! | `punch` | matrices of Nastran as bulk data: `DMIG` of a punch file |
//! | `calculix` | the substructure matrix of CalculiX: `.mtx` |

mod calculix;
mod punch;

use std::collections::BTreeMap;
use std::path::Path;

use toml::Spanned;

use super::{
    schema::RawHousing,
    values::{Checked, missing, square},
};
use crate::{Source, read_text};

/// A node and a direction of it, 1 .. 6 for x, y, z and the turns about them.
type Place = (i64, i64);

/// Entries of a symmetric matrix, the place of the row first; both triangles.
#[derive(Debug, Default)]
struct Entries {
    values: BTreeMap<(Place, Place), f64>,
}

/// What is wrong with a file, and in which of its lines.
#[derive(Debug)]
struct Wrong {
    line: usize,
    what: String,
}

impl Entries {
    /// Puts in an entry and its mirror image; one that is told twice stands as it was told last.
    fn put(&mut self, row: Place, column: Place, value: f64) {
        self.values.insert((row, column), value);
        self.values.insert((column, row), value);
    }

    fn at(&self, row: Place, column: Place) -> f64 {
        self.values.get(&(row, column)).copied().unwrap_or(0.0)
    }

    fn knows(&self, place: Place) -> bool {
        self.values.range((place, (i64::MIN, i64::MIN))..).next().is_some_and(|((row, _), _)| *row == place)
    }
}

/// Rows of the stiffness between the seats of so many bearings, N, mm, rad.
pub(super) fn housing(s: &Source<'_>, table: &Spanned<RawHousing>, bearings: usize) -> Checked<Vec<Vec<f64>>> {
    let raw = table.get_ref();
    let Some(word) = &raw.file else {
        if raw.nodes.is_some() || raw.turn_nodes.is_some() || raw.matrix.is_some() {
            return Err(missing(s, table, "[housing]", "file", "the file that the nodes are in"));
        }
        return square(s, table, &raw.matrix_n_mm_rad, 6 * bearings);
    };
    if let Some(rows) = &raw.matrix_n_mm_rad {
        return Err(s.conflict(&rows.span(), "the housing is given twice", "give the matrix or the file, not both"));
    }
    let path = s.file.parent().unwrap_or(Path::new("")).join(word.get_ref());
    let unread = |e: std::io::Error| format!("\"{}\" cannot be read: {e}", path.display());
    let text =
        read_text(&path).map_err(|e| s.conflict(&word.span(), unread(e), "paths are relative to the gearbox file"))?;
    let name = raw.matrix.as_ref().map(|w| w.get_ref().as_str());
    let is_calculix = path.extension().is_some_and(|e| e.eq_ignore_ascii_case("mtx"));
    let read = if is_calculix { calculix::read(&text) } else { punch::read(&text, name) };
    let entries = read.map_err(|Wrong { line, what }| {
        let said = format!("{}:{line}: {what}", path.display());
        s.conflict(&word.span(), said, "a punch file has `DMIG` entries; a `.mtx` is CalculiX's substructure matrix")
    })?;
    let nodes = numbers(s, table, "nodes", raw.nodes.as_ref(), bearings)?;
    let turns = match &raw.turn_nodes {
        None => None,
        some => Some(numbers(s, table, "turn_nodes", some.as_ref(), bearings)?),
    };
    let places: Vec<Place> = (0..6 * bearings)
        .map(|i| match (&turns, i % 6) {
            (Some(turns), k @ 3..) => (turns[i / 6], k as i64 - 2),
            (_, k) => (nodes[i / 6], k as i64 + 1),
        })
        .collect();
    let here = |what: String, advice: &str| Err(s.conflict(&word.span(), what, advice));
    if let Some((node, direction)) = entries.values.keys().map(|(row, _)| *row).find(|row| !places.contains(row)) {
        return here(
            format!("{} has direction {direction} of node {node}, which is no seat of a bearing", path.display()),
            "condense the housing to the seats alone: six directions of a node for each bearing, in their order",
        );
    }
    for seat in places.chunks(6) {
        if let Some((node, _)) = [0, 3].map(|k| seat[k]).into_iter().find(|place| {
            let (node, first) = *place;
            !(first..first + 3).any(|direction| entries.knows((node, direction)))
        }) {
            return here(
                format!("{} has nothing of node {node}", path.display()),
                "does `nodes` count as the file does?",
            );
        }
    }
    Ok(places.iter().map(|row| places.iter().map(|column| entries.at(*row, *column)).collect()).collect())
}

/// Numbers of nodes, one a bearing, no two alike.
fn numbers(
    s: &Source<'_>,
    table: &Spanned<RawHousing>,
    key: &str,
    list: Option<&Spanned<Vec<i64>>>,
    bearings: usize,
) -> Checked<Vec<i64>> {
    let Some(list) = list else {
        return Err(missing(s, table, "[housing]", key, "the numbers of the nodes at the bearings, in their order"));
    };
    let own = list.get_ref();
    if own.len() != bearings {
        let said = format!("`{key}` has {} nodes, and there are {bearings} bearings", own.len());
        return Err(s.conflict(&list.span(), said, "give one a bearing, in their order"));
    }
    match own.iter().enumerate().find(|(i, n)| own[..*i].contains(n)) {
        Some((_, twice)) => Err(s.conflict(
            &list.span(),
            format!("`{key}` has node {twice} twice"),
            "each bearing has a node of its own",
        )),
        None => Ok(own.clone()),
    }
}

/// A finite number as programs write it, an exponent of Fortran among them: `1.5D+05`, `1.5+5`.
fn number(text: &str) -> Option<f64> {
    let plain = text.trim().replace(['D', 'd'], "E");
    let value = plain.parse().ok().or_else(|| {
        // The sign of an exponent without its letter.
        let at = plain.rfind(['+', '-']).filter(|at| *at > 0)?;
        format!("{}E{}", &plain[..at], &plain[at..]).parse().ok()
    });
    value.filter(|x: &f64| x.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exponents_of_fortran_are_read() {
        assert_eq!(number(" 1.5D+05"), Some(1.5e5));
        assert_eq!(number("-1.5-3"), Some(-1.5e-3));
        assert_eq!(number("-2"), Some(-2.0));
        assert_eq!((number("x"), number("1e999"), number("")), (None, None, None));
    }
}
