//! What the documents say exists: pages, anchors, files, equations.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use crate::markdown::Page;
use crate::util::repository;

/// Every Markdown file that a reader is sent to.
fn pages() -> Vec<Page> {
    let top = repository();
    let mut pages = Page::all_in(&top, false);
    for (folder, below) in [("docs", true), ("meshes", true), ("benches", true), ("fuzz", false), ("mutants", false)] {
        pages.extend(Page::all_in(&top.join(folder), below));
    }
    pages
}

/// `a/b/../c` as `a/c`, without a look at the disk.
fn plain(path: &Path) -> PathBuf {
    let mut parts = PathBuf::new();
    for part in path.components() {
        if part.as_os_str() == ".." {
            parts.pop();
        } else {
            parts.push(part);
        }
    }
    parts
}

#[test]
fn links_lead_somewhere() {
    let pages = pages();
    let docs = repository().join("docs");
    let anchors: BTreeMap<&Path, Vec<String>> = pages.iter().map(|p| (p.path.as_path(), p.anchors())).collect();
    let mut faults = Vec::new();
    for page in &pages {
        for (link, byte) in page.links() {
            if link.starts_with("https://") {
                continue; // the world outside is not this test's business
            }
            let (file, heading) = link.split_once('#').unwrap_or((&link, ""));
            let target =
                if file.is_empty() { page.path.clone() } else { plain(&page.path.parent().unwrap().join(file)) };
            let fault = if !target.exists() {
                "there is no such file"
            } else if page.path.starts_with(&docs) && !target.starts_with(&docs) {
                "a page of the book may only link to what is in the book: name the file in code font"
            } else if !heading.is_empty()
                && !anchors.get(target.as_path()).is_some_and(|a| a.iter().any(|a| a == heading))
            {
                "there is no such heading"
            } else {
                continue;
            };
            faults.push(format!("{}: {link}: {fault}", page.place(byte)));
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// Files named in code font, `crates/contact/src/local/mod.rs`, are there. Names with placeholders are not looked at.
#[test]
fn named_files_exist() {
    let top = repository();
    let mut faults = Vec::new();
    for page in pages() {
        for (code, byte) in page.code() {
            let is_path =
                ["crates/", "tests/", "docs/", "scenes/", "meshes/", "benches/"].iter().any(|f| code.starts_with(f));
            if is_path && !code.contains([' ', '*', '<', '{']) && !top.join(&code).exists() {
                faults.push(format!("{}: `{code}` is not in the repository", page.place(byte)));
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn every_page_is_in_the_book_once() {
    let docs = repository().join("docs");
    let summary = Page::read(docs.join("SUMMARY.md"));
    let mut listed: Vec<PathBuf> = summary.links().into_iter().map(|(link, _)| docs.join(link)).collect();
    listed.sort();
    let mut there: Vec<PathBuf> =
        Page::all_in(&docs, true).into_iter().map(|p| p.path).filter(|p| *p != summary.path).collect();
    there.sort();
    assert_eq!(listed, there, "left: docs/SUMMARY.md; right: the folder");
}

/// Rust files below a folder.
fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            sources(&path, found);
        } else if path.extension().is_some_and(|e| e == "rs") {
            found.push(path);
        }
    }
}

/// `12` or `19a` where a text begins with `(12)` or `(19a)`, and what follows.
fn equation_number(text: &str) -> Option<(&str, &str)> {
    let (number, rest) = text.strip_prefix('(')?.split_once(')')?;
    (number.starts_with(|c: char| c.is_ascii_digit()) && number.len() <= 3).then_some((number, rest))
}

/// Numbers of `Theory (1), (2), (3).` wherever it stands in a text.
fn cited(text: &str) -> BTreeSet<String> {
    // A line of a comment may end anywhere.
    let words = |line: &str| line.trim_start().trim_start_matches(['/', '!']).trim().to_owned();
    let text = text.lines().map(words).collect::<Vec<_>>().join(" ");
    let mut numbers = BTreeSet::new();
    for (at, word) in text.match_indices("Theory ") {
        let mut rest = &text[at + word.len()..];
        while let Some((number, after)) = equation_number(rest) {
            numbers.insert(number.to_owned());
            rest = after.strip_prefix(", ").unwrap_or("");
        }
    }
    numbers
}

/// Docstrings cite equations as `Theory (12).`; each is in the theory once, and each of the theory's is cited where it
/// is computed.
#[test]
fn theory_and_docstrings_number_equations_alike() {
    let theory = Page::read(repository().join("docs/theory.md"));
    let (mut numbered, mut in_block) = (BTreeSet::new(), false);
    for line in theory.text.lines() {
        in_block ^= line.starts_with("```");
        if let (true, Some((number, _))) = (in_block, equation_number(line)) {
            assert!(numbered.insert(number.to_owned()), "docs/theory.md numbers two equations ({number})");
        }
    }
    let mut files = Vec::new();
    sources(&repository().join("crates"), &mut files);
    let mut all_cited = BTreeSet::new();
    for file in files.iter().filter(|f| f.components().any(|c| c.as_os_str() == "src")) {
        let here = cited(&std::fs::read_to_string(file).unwrap());
        let unknown: Vec<&String> = here.difference(&numbered).collect();
        assert!(unknown.is_empty(), "{} cites equations that the theory does not have: {unknown:?}", file.display());
        all_cited.extend(here);
    }
    let silent: Vec<&String> = numbered.difference(&all_cited).collect();
    assert!(silent.is_empty(), "no docstring cites the equations {silent:?} of the theory");
}

/// Pages that the program writes as a whole.
const WRITTEN: [&str; 3] = ["docs/remarks.md", "docs/speed_and_accuracy.md", "docs/which_model.md"];

/// Words of README and book at most, without the lists that tests write.
const MOST_WORDS: usize = 45_000;

/// A reader has five minutes: what is written by hand stays short.
#[test]
fn documents_by_hand_stay_short() {
    let top = repository();
    let is_counted = |page: &Page| {
        let name = page.path.strip_prefix(&top).unwrap();
        (name == Path::new("README.md") || name.starts_with("docs"))
            && !WRITTEN.iter().any(|own| name == Path::new(own))
    };
    let words = |page: &Page| {
        let text = std::fs::read_to_string(&page.path).unwrap();
        let mut own = String::new();
        let mut is_list = false;
        for line in text.lines() {
            // A list of the program begins with a comment that no tutorial has, and ends with `<!-- end -->`.
            let begins = line.starts_with("<!-- ") && line.ends_with("-->");
            let of_tutorial = ["run", "file", "prints", "value"].iter().any(|w| line.starts_with(&format!("<!-- {w}")));
            match (begins, line == "<!-- end -->") {
                (_, true) => is_list = false,
                (true, _) if !of_tutorial => is_list = true,
                _ if !is_list => own += &format!("{line}\n"),
                _ => {}
            }
        }
        own.split_whitespace().filter(|word| word.chars().any(|c| c.is_ascii_alphanumeric())).count()
    };
    let all: usize = pages().iter().filter(|page| is_counted(page)).map(words).sum();
    assert!(all <= MOST_WORDS, "{all} words by hand; {MOST_WORDS} at most: say it shorter, or once");
}
