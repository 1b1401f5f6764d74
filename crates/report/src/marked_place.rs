//! Tables in a document of the user's: between two marks, and nothing else of it changes.

use std::path::{Path, PathBuf};

use files::{most, read_regular_text, write_file};

use store::StoreError;

use crate::ReportError;

/// A file and the bytes of it between its marks.
#[derive(Debug)]
pub struct MarkedPlace {
    file: PathBuf,
    text: String,
    start: usize,
    end: usize,
}

impl MarkedPlace {
    /// The place between `<!-- chart NAME -->` and `<!-- end -->`.
    ///
    /// # Errors
    /// [`ReportError::NoMarks`] when the file or its marks are not there.
    pub fn find(file: &Path, name: &str) -> Result<Self, ReportError> {
        let (open, close) = (format!("<!-- chart {name} -->"), "<!-- end -->");
        let complain = |what: String| ReportError::NoMarks {
            file: file.to_owned(),
            what,
            marks: format!("`{open}` and `{close}`"),
        };
        let text = read_regular_text(file, most::DOCUMENT).map_err(|e| complain(e.to_string()))?;
        let line = format!("{open}\n");
        let start = text.find(&line).map(|at| at + line.len()).ok_or_else(|| complain(format!("no `{open}`")))?;
        let end = text[start..].find(close).map(|at| start + at).ok_or_else(|| complain(format!("no `{close}`")))?;
        Ok(Self { file: file.to_owned(), text, start, end })
    }

    /// Puts other tables there.
    ///
    /// # Errors
    /// [`ReportError::Store`] when the system refuses.
    pub fn replace(self, tables: &str) -> Result<(), ReportError> {
        let Self { file, text, start, end } = self;
        let whole = format!("{}\n{tables}\n{}", &text[..start], &text[end..]);
        write_file(&file, whole.as_bytes()).map_err(|cause| StoreError::Write { file, cause }.into())
    }
}

#[cfg(all(test, unix))]
mod tests {
    use std::os::unix::fs::{PermissionsExt, symlink};

    use super::*;

    /// Through a link to a file, and through one to its folder; a file that stands beside it under a like name is
    /// nobody's.
    #[test]
    fn tables_go_where_a_link_leads_to() {
        let scratch = tempfile::tempdir().unwrap();
        let (book, page) = (scratch.path().join("book"), scratch.path().join("book/page.md"));
        std::fs::create_dir(&book).unwrap();
        std::fs::write(&page, "# A\n<!-- chart a -->\nold\n<!-- end -->\nrest\n").unwrap();
        std::fs::set_permissions(&page, std::fs::Permissions::from_mode(0o640)).unwrap();
        std::fs::write(book.join("page.new"), "mine").unwrap();
        let (link, folder) = (scratch.path().join("link.md"), scratch.path().join("docs"));
        symlink("book/page.md", &link).unwrap();
        symlink("book", &folder).unwrap();
        for (file, table) in [(link.clone(), "first"), (folder.join("page.md"), "second")] {
            MarkedPlace::find(&file, "a").unwrap().replace(table).unwrap();
            let wanted = format!("# A\n<!-- chart a -->\n\n{table}\n<!-- end -->\nrest\n");
            assert_eq!(std::fs::read_to_string(&page).unwrap(), wanted);
        }
        for path in [&link, &folder] {
            assert!(std::fs::symlink_metadata(path).unwrap().is_symlink(), "{} is a link no more", path.display());
        }
        assert_eq!(std::fs::metadata(&page).unwrap().permissions().mode() & 0o777, 0o640);
        assert_eq!(std::fs::read_to_string(book.join("page.new")).unwrap(), "mine");
        assert_eq!(std::fs::read_dir(&book).unwrap().count(), 2);
    }
}
