//! Commands of cargo that documents and comments name: their programs exist, and their filters match tests.

use std::fs;
use std::path::{Path, PathBuf};

use crate::program::{Kind, Program, files_below, package_name, packages, programs, repository};

/// Where readers find commands.
const PAGES: [&str; 4] = ["md", "rs", "sh", "toml"];

/// Options that name a program, with its kind.
const NAMING: [(&str, Kind); 4] =
    [("--test", Kind::Test), ("--bench", Kind::Bench), ("--example", Kind::Example), ("--bin", Kind::Binary)];

/// Words of each command of cargo in a text: in code font up to the closing mark, over the end of a line if need be,
/// else up to the end of the line.
fn commands(text: &str) -> Vec<Vec<&str>> {
    let ends = |at: usize| if text[..at].ends_with('`') { '`' } else { '\n' };
    let starts = ["cargo test ", "cargo bench ", "cargo run "].into_iter().flat_map(|c| text.match_indices(c));
    starts
        .map(|(at, _)| text[at..].split([ends(at), '#']).next().unwrap_or_default())
        .map(|command| command.split_whitespace().filter(|w| !w.starts_with("//")).collect())
        .collect()
}

/// The word after an option.
fn after<'a>(words: &[&'a str], options: &[&str]) -> Option<&'a str> {
    words.windows(2).find(|w| options.contains(&w[0])).map(|w| w[1])
}

/// A word in capitals stands for any.
fn stands_for_any(word: &str) -> bool {
    word.chars().all(|c| c.is_ascii_uppercase() || c == '_')
}

/// What is wrong with a command, given the programs of all packages.
fn fault(words: &[&str], all: &[(String, Vec<Program>)]) -> Option<String> {
    let split = words.iter().position(|w| *w == "--").unwrap_or(words.len());
    let (options, rest) = words.split_at(split);
    let package = after(options, &["-p", "--package"]).filter(|p| !stands_for_any(p));
    if let Some(package) = package.filter(|p| all.iter().all(|(name, _)| name != p)) {
        return Some(format!("there is no package `{package}`"));
    }
    let within = || all.iter().filter(|(name, _)| package.is_none_or(|p| p == name)).flat_map(|(_, programs)| programs);
    for (option, kind) in NAMING {
        let Some(name) = after(options, &[option]).filter(|n| !stands_for_any(n)) else { continue };
        let Some(program) = within().find(|p| p.kind == kind && p.name == name) else {
            return Some(format!("there is no `{option} {name}`"));
        };
        let tests = if kind == Kind::Test { program.tests() } else { continue };
        let filters = rest.iter().skip(1).filter(|w| !w.starts_with('-'));
        for filter in filters {
            if !tests.iter().any(|test| test.contains(filter)) {
                return Some(format!("no test of `{name}` has `{filter}` in its name"));
            }
        }
    }
    None
}

fn all_programs() -> Vec<(String, Vec<Program>)> {
    packages().iter().map(|p| (package_name(p), programs(p))).collect()
}

#[test]
fn commands_in_documents_run_something() {
    let all = all_programs();
    let own = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests");
    let mut pages: Vec<PathBuf> = files_below(repository(), &PAGES);
    pages.retain(|page| !page.starts_with(&own));
    pages.push(repository().join(".ci/run"));
    let (mut seen, mut faults) = (0, Vec::new());
    for page in pages {
        let text = fs::read_to_string(&page).unwrap();
        for words in commands(&text) {
            seen += 1;
            if let Some(fault) = fault(&words, &all) {
                faults.push(format!("{}: `{}`: {fault}", page.display(), words.join(" ")));
            }
        }
    }
    assert!(seen > 20, "{seen} commands only");
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn a_command_that_runs_nothing_is_found() {
    let all = all_programs();
    let said = |text: &str| fault(&commands(text)[0], &all).unwrap_or_default();
    let command = "cargo test --workspace --test testing_laws --";
    assert_eq!(said(&format!("`{command}\n//! commands:: --ignored`")), "");
    assert_eq!(said(&format!("{command} every_test_is_run::a_file # one")), "");
    assert_eq!(
        said(&format!("`{command} comands:: --ignored`")),
        "no test of `testing_laws` has `comands::` in its name"
    );
    assert_eq!(said("cargo test -p testing --test left_off"), "there is no `--test left_off`");
    assert_eq!(said("cargo test -p mesh --test testing_laws"), "there is no `--test testing_laws`");
    assert_eq!(said("`cargo bench -p bench`"), "there is no package `bench`");
    assert_eq!(said("`cargo bench -p CRATE --bench NAME`"), "");
}
