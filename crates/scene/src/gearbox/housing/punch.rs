//! `DMIG` entries of Nastran's bulk data, as in its punch files.

use super::{Entries, Wrong, number};

/// A field of the format with its text trimmed.
fn fields(line: &str, wide: bool) -> Vec<&str> {
    if line.contains(',') {
        return line.split(',').skip(1).map(str::trim).collect();
    }
    let width = if wide { 16 } else { 8 };
    let body = line.get(8..).unwrap_or("");
    let count = if wide { 4 } else { 8 };
    (0..count).map(|i| body.get(i * width..((i + 1) * width).min(body.len())).unwrap_or("").trim()).collect()
}

/// The matrix of a name, or the first one.
///
/// ```text
/// DMIG    NAME    0       IFO     TIN     TOUT                    the head: IFO 1 square, 6 symmetric; TIN 1, 2 real
/// DMIG*   NAME            GJ              CJ                      a column: node and direction
/// *       GI              CI              A                       an entry of it: row and value
/// ```
/// Fields of 8 or 16 columns, or with commas. Of a square matrix both triangles are there and the last one told counts;
/// whether it is symmetric, who takes it asks.
pub(super) fn read(text: &str, wanted: Option<&str>) -> Result<Entries, Wrong> {
    let mut entries = Entries::default();
    let mut name = wanted.map(str::to_uppercase);
    let mut column = None;
    let mut headed = false;
    for (i, line) in text.lines().enumerate() {
        let wrong = |what: String| Wrong { line: i + 1, what };
        let Some(head) = line.split([' ', ',', '\t']).next().filter(|h| !h.starts_with('$')) else { continue };
        let wide = head.ends_with('*') || line.starts_with('*');
        let own = fields(line, wide);
        let field = |k: usize| own.get(k).copied().unwrap_or("");
        let whole = |k: usize| -> Result<i64, Wrong> {
            field(k).parse().map_err(|_| wrong(format!("\"{}\" is not a whole number", field(k))))
        };
        if head.trim_end_matches('*').eq_ignore_ascii_case("DMIG") {
            column = None;
            let this = field(0).to_uppercase();
            if *name.get_or_insert_with(|| this.clone()) != this {
                continue;
            }
            if field(1) == "0" {
                headed = true;
                if !matches!(field(2), "1" | "6") {
                    return Err(wrong(format!(
                        "form {} of {this}: a square (1) or symmetric (6) one is wanted",
                        field(2)
                    )));
                }
                if !matches!(field(3), "1" | "2") {
                    return Err(wrong(format!("type {} of {this}: a real one (1, 2) is wanted", field(3))));
                }
                continue;
            }
            let here = (whole(1)?, whole(2)?);
            column = Some(here);
            // The short form has two entries in the line of the column.
            if !wide {
                row(&mut entries, here, (&own[..], 4), &wrong)?;
            }
        } else if line.starts_with(['*', ' ', '+']) || line.starts_with(',') {
            let Some(here) = column else { continue };
            row(&mut entries, here, (&own[..], 0), &wrong)?;
            if !wide {
                row(&mut entries, here, (&own[..], 4), &wrong)?;
            }
        } else {
            column = None;
        }
    }
    let lines = text.lines().count();
    match name {
        Some(_) if headed && !entries.values.is_empty() => Ok(entries),
        Some(name) => Err(Wrong { line: lines, what: format!("ends without a matrix {name}") }),
        None => Err(Wrong { line: lines, what: "ends without a DMIG entry".into() }),
    }
}

/// An entry of a column whose fields begin at `from`: node, direction, value. Nothing where they are empty.
fn row(
    entries: &mut Entries,
    column: (i64, i64),
    (fields, from): (&[&str], usize),
    wrong: &dyn Fn(String) -> Wrong,
) -> Result<(), Wrong> {
    let field = |k: usize| fields.get(from + k).copied().unwrap_or("");
    if field(0).is_empty() {
        return Ok(());
    }
    let whole =
        |k: usize| field(k).parse::<i64>().map_err(|_| wrong(format!("\"{}\" is not a whole number", field(k))));
    let value = number(field(2)).ok_or_else(|| wrong(format!("\"{}\" is not a number", field(2))))?;
    entries.put((whole(0)?, whole(1)?), column, value);
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    const WIDE: &str = "\
$ comment
DMIG    KAAX    0       6       1       0                       12
DMIG*   KAAX                           7               1
*                      7               1 1.000000000D+05
*                      9               2-2.500000000D+04
DMIG*   KAAX                           9               2
*                      9               2 3.000000000D+05
";

    #[test]
    fn wide_and_short_fields_tell_one_matrix() {
        let found = read(WIDE, None).unwrap();
        assert_eq!((found.at((7, 1), (7, 1)), found.at((9, 2), (9, 2))), (1e5, 3e5));
        assert_eq!(
            (found.at((7, 1), (9, 2)), found.at((9, 2), (7, 1)), found.at((7, 2), (9, 2))),
            (-2.5e4, -2.5e4, 0.0)
        );
        let short = "\
DMIG    K2      0       6       1       0
DMIG    K2      7       1               7       1       1.0+5
        9       2       -2.5+4
DMIG,K2,9,2,,9,2,3.0E5
";
        let again = read(short, Some("k2")).unwrap();
        assert_eq!(found.values, again.values);
    }

    #[test]
    fn other_matrices_are_told_by_their_line() {
        let said = |text: &str, name: Option<&str>| {
            let wrong = read(text, name).unwrap_err();
            format!("{}: {}", wrong.line, wrong.what)
        };
        assert!(said(WIDE, Some("MAAX")).contains("without a matrix MAAX"));
        assert!(said("", None).contains("without a DMIG"));
        assert!(said(&WIDE.replace("       6       1", "       2       1"), None).starts_with("2: form 2"));
        assert!(said(&WIDE.replace("       6       1", "       6       3"), None).starts_with("2: type 3"));
        assert!(said(&WIDE.replace("-2.500000000D+04", "-2.5000x0000D+04"), None).starts_with("5: "));
        for cut in 0..WIDE.len() {
            let _ = read(&WIDE[..cut], None);
        }
    }
}
