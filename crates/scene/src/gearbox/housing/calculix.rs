//! The substructure matrix of CalculiX (`*SUBSTRUCTURE MATRIX OUTPUT`, a `.mtx` file).

use super::{Entries, Wrong, number};

/// The stiffness of the file.
///
/// ```text
/// *USER ELEMENT,NODES= n,LINEAR
/// ** ELEMENT NODES
/// ** node of each coordinate, with commas
/// direction of the first, then: number, direction       directions 1 .. 3; turns are those of a node of their own
/// *MATRIX,TYPE=STIFFNESS
/// lower triangle, row by row
/// ```
pub(super) fn read(text: &str) -> Result<Entries, Wrong> {
    let (mut nodes, mut directions, mut values): (Vec<i64>, Vec<i64>, Vec<f64>) = (Vec::new(), Vec::new(), Vec::new());
    let (mut in_nodes, mut in_directions, mut in_matrix) = (false, false, false);
    let mut last = 0;
    for (i, line) in text.lines().enumerate() {
        let wrong = |what: String| Wrong { line: i + 1, what };
        last = i + 1;
        let words = || line.trim_start_matches('*').split(',').map(str::trim).filter(|w| !w.is_empty());
        let whole = |w: &str| w.parse::<i64>().map_err(|_| wrong(format!("\"{w}\" is not a whole number")));
        if let Some(comment) = line.strip_prefix("**") {
            if comment.trim().eq_ignore_ascii_case("ELEMENT NODES") {
                in_nodes = true;
            } else if in_nodes && !comment.trim().is_empty() {
                nodes.extend(words().map(whole).collect::<Result<Vec<_>, _>>()?);
            }
        } else if let Some(keyword) = line.strip_prefix('*') {
            let keyword = keyword.to_uppercase().replace(' ', "");
            in_directions = keyword.starts_with("USERELEMENT");
            in_matrix = keyword.starts_with("MATRIX") && keyword.contains("TYPE=STIFFNESS");
            in_nodes = false;
        } else if in_matrix {
            let number = |w| number(w).ok_or_else(|| wrong(format!("\"{w}\" is not a number")));
            values.extend(words().map(number).collect::<Result<Vec<_>, _>>()?);
        } else if in_directions {
            in_nodes = false;
            directions.extend(words().next_back().map(whole).transpose()?);
        }
    }
    let count = nodes.len();
    let wrong = |what: String| Wrong { line: last, what };
    if count == 0 {
        return Err(wrong("ends without element nodes".into()));
    }
    if directions.len() != count {
        return Err(wrong(format!("has {} directions for {count} coordinates", directions.len())));
    }
    if values.len() != count * (count + 1) / 2 {
        return Err(wrong(format!("has {} entries of a lower triangle of {count} rows", values.len())));
    }
    let mut entries = Entries::default();
    let mut each = values.into_iter();
    for i in 0..count {
        for (j, value) in (0..=i).zip(each.by_ref()) {
            entries.put((nodes[i], directions[i]), (nodes[j], directions[j]), value);
        }
    }
    Ok(entries)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// As CalculiX 2.20 writes it.
    const FILE: &str = "\
**
** GENERATION OF SUBSTRUCTURE
*USER ELEMENT,NODES=          3,LINEAR
** ELEMENT NODES
**       101,       101,       102
         1
         2,         2
         3,         1
*MATRIX,TYPE=STIFFNESS
 0.8076923076923E+06,
 0.0000000000000E+00, 0.8076923076923E+06,
-0.4038461538462E+07,
-0.5820766091347E-10, 0.2826923076923E+07,
";

    #[test]
    fn a_lower_triangle_is_a_symmetric_matrix() {
        let found = read(FILE).unwrap_or_else(|e| panic!("{}: {}", e.line, e.what));
        assert_eq!(
            (found.at((101, 2), (101, 2)), found.at((102, 1), (102, 1))),
            (0.8076923076923e6, 0.2826923076923e7)
        );
        assert_eq!(
            (found.at((102, 1), (101, 1)), found.at((101, 1), (102, 1))),
            (-0.4038461538462e7, -0.4038461538462e7)
        );
    }

    #[test]
    fn what_is_missing_is_told() {
        let said = |text: &str| read(text).unwrap_err().what;
        assert!(said("").contains("without element nodes"));
        assert!(said(&FILE.replace("         3,         1\n", "")).contains("2 directions for 3"));
        assert!(said(&FILE.replace("-0.4038461538462E+07,\n", "")).contains("5 entries"));
        assert!(said(&FILE.replace("0.2826923076923E+07", "x")).contains("not a number"));
        for cut in 0..FILE.len() {
            let _ = read(&FILE[..cut]);
        }
    }
}
