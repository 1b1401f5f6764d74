//! A file of rows, written from columns and read back.

use std::path::Path;

use answer::csv::push_row;
use study::Columns;

use crate::ColumnsError;

/// The file of these rows.
pub fn columns_to_csv(columns: &Columns) -> String {
    let mut text = columns.names().join(",") + "\n";
    columns.rows().for_each(|row| push_row(&mut text, row));
    text
}

/// Reads a file that this program has written.
///
/// # Errors
/// When it is not what it was.
pub fn read_columns(path: &Path) -> Result<Columns, ColumnsError> {
    let text = files::read_regular_text(path, files::most::ROWS)
        .map_err(|cause| ColumnsError::Read { file: path.to_owned(), cause })?;
    parse_columns(&text).ok_or_else(|| ColumnsError::NoNumber { file: path.to_owned() })
}

/// The columns of a file's text; `None` where it contains a value that is not a number, or two columns of one name.
pub fn parse_columns(text: &str) -> Option<Columns> {
    let mut lines = text.lines();
    let names = lines.next()?.split(',');
    let count = names.clone().count();
    let mut columns = Columns::named(names);
    if columns.names().len() < count {
        return None;
    }
    for line in lines {
        let row = line.split(',').take(count).map(str::parse).collect::<Result<Vec<f64>, _>>().ok()?;
        if row.len() < count {
            return None;
        }
        columns.push(row);
    }
    Some(columns)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A second column of one name was once looked for beyond the last one.
    #[test]
    fn columns_of_one_name_are_no_table() {
        assert!(parse_columns("a,b,a\n1,2,3\n").is_none());
        assert_eq!(parse_columns("a,b\n1,2\n").unwrap().find("b"), Some(&[2.0][..]));
    }
}
