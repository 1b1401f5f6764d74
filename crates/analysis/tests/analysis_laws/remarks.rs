//! The table of remarks and the page that is made of it.

use std::{collections::BTreeSet, fmt::Write, fs, path::Path};

use analysis::remark;

/// Every code is there once, and is a word of lower case.
#[test]
fn codes_are_unique_words() {
    let codes: BTreeSet<&str> = remark::ALL.iter().map(|kind| kind.code).collect();
    assert_eq!(codes.len(), remark::ALL.len());
    let is_word = |code: &&str| code.chars().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_');
    assert!(codes.iter().all(is_word), "{codes:?}");
}

/// `docs/remarks.md` holds every row of the table as it is, in its order, and no other; `UPDATE_OUTPUTS=1` writes it.
#[test]
fn the_page_of_remarks_is_that_of_the_table() {
    let mut rows = "|---|---|---|\n".to_owned();
    for kind in remark::ALL {
        let plain = |text: &str| text.replace('|', "\\|");
        // Writing to a String cannot fail.
        let _ = writeln!(rows, "| `{}` | {} | {} |", kind.code, plain(kind.text), plain(kind.hint));
    }
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/remarks.md");
    let found = fs::read_to_string(&file).unwrap();
    if std::env::var_os("UPDATE_OUTPUTS").is_some() {
        let introduction = &found[..found.find("|---|").unwrap()];
        return fs::write(&file, format!("{introduction}{rows}")).unwrap();
    }
    assert!(found.ends_with(&rows), "docs/remarks.md is not that of the table; UPDATE_OUTPUTS=1 writes it");
}
