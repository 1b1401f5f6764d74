//! `ale-gear envelope`: files, tables of a document, and exit status.

use crate::util::Scratch;

/// A case and a map leave a row a figure and a row a cell, a page, and their tables where the marks are.
#[test]
fn cases_leave_rows_a_page_and_tables() {
    let marks = "a\n<!-- chart failure modes -->\nof before\n<!-- end -->\nb\n<!-- chart maps -->\n<!-- end -->\n";
    let scratch = Scratch::new().file("page.md", marks);
    let run = scratch.ale_gear(["envelope", "--only", "F14,f8", "--out", "out", "--into", "page.md"]);
    assert_eq!(run.code, Some(0), "{}{}", run.stdout, run.stderr);
    assert!(run.stdout.contains("dependence on units") && run.stdout.contains("passes"), "{}", run.stdout);
    let rows = scratch.read("out/envelope.csv");
    let (mut lines, columns) = (rows.lines(), 12);
    assert_eq!(lines.next().map(|l| l.split(',').count()), Some(columns));
    assert!(rows.contains("\nF8,") && rows.contains("\nF14,") && !rows.contains("\nF1,"), "{rows}");
    assert!(scratch.read("out/report.html").contains("F14 dependence on units"));
    let page = scratch.read("page.md");
    assert!(page.contains("| [F14](#f14) dependence on units |") && !page.contains("of before"), "{page}");
    assert!(page.starts_with("a\n") && page.contains("\nb\n<!-- chart maps -->\n<!-- end -->"), "{page}");
}

/// A word that names no case is wrong input; a place that is not there is told.
#[test]
fn words_of_the_envelope_are_checked() {
    let scratch = Scratch::new();
    let run = scratch.ale_gear(["envelope", "--only", "F36", "--out", "out"]);
    assert_eq!(run.code, Some(2), "{}", run.stderr);
    assert!(run.stderr.contains("`--only F36`: there is no such case"), "{}", run.stderr);
    assert!(run.stderr.contains("F1 .. F46, or a map: a .. g"), "{}", run.stderr);
    assert_eq!(scratch.names(), [""; 0]);
    // Before any case is looked at.
    let scratch = scratch.file("page.md", "no marks\n");
    let run = scratch.ale_gear(["envelope", "--only", "F14", "--out", "out", "--into", "page.md"]);
    assert_eq!((run.code, run.stdout.as_str()), (Some(2), ""), "{}", run.stderr);
    assert!(run.stderr.contains("no `<!-- chart failure modes -->`"), "{}", run.stderr);
    assert_eq!(scratch.names(), ["page.md"]);
}
