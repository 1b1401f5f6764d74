//! Every tutorial, run from its own text.
//!
//! A comment before a fenced block, or before a number, says what is done with it:
//!
//! ```text
//! <!-- file NAME -->                    the next block is written to the folder under this name
//! <!-- run -->                          the next block is run by the shell and must succeed
//! <!-- run status N -->                 ... and must end with this status
//! <!-- run if PROGRAM -->               ... where this program is installed; `run unless PROGRAM`: where it is not
//! <!-- prints -->                       each line of the next block is in what the last run printed, in this order; `...` stands for anything
//! <!-- value FILE KEY TOLERANCE -->     the number that follows is what the file says, within a relative tolerance
//! ```
//! KEY of a `.json` file: names joined by dots, numbers for places in a list. Of a `.csv` file: `max:COLUMN`,
//! `min:COLUMN`, or `COLUMN@max:OTHER`, the value of a column in the row where another is largest; `,NAME=NUMBER`
//! behind it: among the rows that have this.
#![cfg(unix)] // the commands are a shell's

use std::os::unix::fs::symlink;
use std::path::Path;

use crate::markdown::Page;
use crate::quantities::Documented;
use crate::util::{Run, Scratch, column, repository};
use pulldown_cmark::{Event, Tag, TagEnd};
use testing::Record;

/// What a page asks to be done, in its order.
enum Step {
    File {
        name: String,
        content: String,
    },
    Run {
        script: String,
        status: i32,
    },
    /// It needs this program, which is not installed; or stands for what one does that is.
    LeftOut(String),
    NotNeeded,
    Prints(String),
    Value {
        file: String,
        key: String,
        tolerance: f64,
        number: f64,
    },
}

impl Step {
    /// What a comment makes of the block that follows it.
    fn of_block(words: &[&str], content: String) -> Option<Self> {
        Some(match words {
            ["file", name] => Self::File { name: (*name).to_owned(), content },
            ["run"] => Self::Run { script: content, status: 0 },
            ["run", "if", program] if installed(program).is_err() => Self::LeftOut((*program).to_owned()),
            ["run", "unless", program] if installed(program).is_ok() => Self::NotNeeded,
            ["run", "if" | "unless", _] => Self::Run { script: content, status: 0 },
            ["run", "status", status] => Self::Run { script: content, status: status.parse().ok()? },
            ["prints"] => Self::Prints(content),
            _ => return None,
        })
    }

    fn of_number(words: &[&str], text: &str) -> Option<Self> {
        let ["value", file, key, tolerance] = words else { return None };
        let text = text.trim_start_matches([' ', '*', '`']);
        let end = text.find(|c: char| !(c.is_ascii_digit() || ".-+e".contains(c))).unwrap_or(text.len());
        let number = text[..end].trim_end_matches('.').parse().ok()?;
        Some(Self::Value {
            file: (*file).to_owned(),
            key: (*key).to_owned(),
            tolerance: tolerance.parse().ok()?,
            number,
        })
    }
}

fn installed(program: &str) -> Result<(), String> {
    testing::program(program, "--version")
}

/// The steps of a page, each with the place where it is asked for.
fn steps(page: &Page) -> Vec<(Step, String)> {
    let mut steps = Vec::new();
    let (mut comment, mut block): (Option<(String, String)>, Option<String>) = (None, None);
    for (event, range) in page.events() {
        match event {
            Event::Html(html) | Event::InlineHtml(html) => {
                let Some(inside) = html.trim().strip_prefix("<!--").and_then(|h| h.strip_suffix("-->")) else {
                    continue;
                };
                let (words, place) = (inside.split_whitespace().collect::<Vec<_>>(), page.place(range.start));
                assert!(comment.is_none(), "{place}: the comment before this one has no block");
                if words.first() == Some(&"value") {
                    let step = Step::of_number(&words, &page.text[range.end..]);
                    steps.push((
                        step.unwrap_or_else(|| panic!("{place}: {inside} is not a value with a number behind it")),
                        place,
                    ));
                } else {
                    comment = Some((inside.to_owned(), place));
                }
            }
            Event::Start(Tag::CodeBlock(_)) => block = Some(String::new()),
            Event::Text(text) => block.iter_mut().for_each(|b| b.push_str(&text)),
            Event::End(TagEnd::CodeBlock) => {
                let content = block.take().unwrap();
                if let Some((inside, place)) = comment.take() {
                    let words: Vec<&str> = inside.split_whitespace().collect();
                    steps.push((
                        Step::of_block(&words, content).unwrap_or_else(|| panic!("{place}: what is {inside}?")),
                        place,
                    ));
                }
            }
            _ => {}
        }
    }
    steps
}

/// A number of a result file.
fn value(folder: &Path, file: &str, key: &str) -> Option<f64> {
    let text = std::fs::read_to_string(folder.join(file)).ok()?;
    if file.ends_with(".json") {
        let root: serde_json::Value = serde_json::from_str(&text).ok()?;
        return root.pointer(&format!("/{}", key.replace('.', "/")))?.as_f64();
    }
    let (key, only) = key.split_once(',').unwrap_or((key, ""));
    let (wanted, rule) = key.split_once('@').unwrap_or(("", key));
    let (rule, name) = rule.split_once(':')?;
    let judged = column(&text, name);
    let sign = match rule {
        "max" => 1.0,
        "min" => -1.0,
        _ => return None,
    };
    let among: Vec<usize> = match only.split_once('=') {
        Some((name, number)) => {
            let (values, number) = (column(&text, name), number.parse::<f64>().ok()?);
            (0..judged.len()).filter(|&row| values[row] == number).collect()
        }
        None => (0..judged.len()).collect(),
    };
    let row = among.into_iter().max_by(|&a, &b| (sign * judged[a]).total_cmp(&(sign * judged[b])))?;
    Some(if wanted.is_empty() { judged[row] } else { column(&text, wanted)[row] })
}

/// Whether `line` is `pattern`, in which `...` stands for anything; blanks count once.
fn alike(line: &str, pattern: &str) -> bool {
    let squeeze = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
    let (line, pattern) = (squeeze(line), squeeze(pattern));
    let mut parts = pattern.split("...");
    let Some(mut rest) = line.strip_prefix(parts.next().unwrap_or("")) else { return false };
    let mut open = false;
    for part in parts {
        open = true;
        let Some(at) = rest.find(part.trim()) else { return false };
        rest = &rest[at + part.trim().len()..];
    }
    open || rest.is_empty()
}

/// Keeps a record of the steps that were left out, for the end of all tests; there the page counts as one test more.
fn tell_left_out(page: &Page, steps: Vec<(String, String)>) {
    let name = page.path.file_stem().unwrap().to_string_lossy().into_owned();
    let conditional = page.text.contains("<!-- run if ");
    let mut records: Vec<Record> =
        steps.into_iter().map(|(place, program)| Record { test: place, reason: installed(&program).err() }).collect();
    if conditional && records.is_empty() {
        records.push(Record { test: name.clone(), reason: None });
    }
    testing::note(&testing::folder(), file!(), &name, &records).unwrap();
}

/// Does what a page says in a folder that looks like the top of the repository, and looks up every quantity that came
/// out in the documents.
fn follow(page: &str) {
    let page = Page::read(repository().join("docs/tutorials").join(page));
    let scratch = Scratch::new();
    for part in ["meshes", "scenes", "docs"] {
        symlink(repository().join(part), scratch.path().join(part)).unwrap();
    }
    let mut last: Option<Run> = None;
    let mut values = 0;
    let mut left_out = Vec::new();
    for (step, place) in steps(&page) {
        match step {
            Step::File { name, content } => std::fs::write(scratch.path().join(name), content).unwrap(),
            Step::Run { script, status } => {
                let run = scratch.shell(&script);
                assert_eq!(run.code, Some(status), "{place}: {script}{}{}", run.stdout, run.stderr);
                last = Some(run);
            }
            Step::LeftOut(program) => left_out.push((place, program)),
            Step::NotNeeded => {}
            Step::Prints(text) => {
                let run = last.as_ref().unwrap_or_else(|| panic!("{place}: nothing was run before"));
                let printed = run.stdout.clone() + &run.stderr;
                let mut lines = printed.lines();
                for pattern in text.lines().filter(|l| !l.trim().is_empty() && l.trim() != "...") {
                    assert!(
                        lines.any(|line| alike(line, pattern)),
                        "{place}: no line `{pattern}` (in this order) in\n{printed}"
                    );
                }
            }
            Step::Value { file, key, tolerance, number } => {
                let found = value(scratch.path(), &file, &key).unwrap_or_else(|| panic!("{place}: no {key} in {file}"));
                let off = (found - number).abs();
                assert!(off <= tolerance * number.abs(), "{place}: {key} of {file} is {found}, the text says {number}");
                values += 1;
            }
        }
    }
    tell_left_out(&page, left_out);
    let outputs = Documented::by(&Page::read(repository().join("docs/outputs.md")));
    for folder in
        std::fs::read_dir(scratch.path().join("out")).unwrap().map(|e| e.unwrap().path()).filter(|p| p.is_dir())
    {
        let missing = outputs.missing(&folder);
        assert!(missing.is_empty(), "not in docs/outputs.md: {}", missing.join("\n"));
    }
    assert!(values > 0, "{}: no number of the text is compared with a result", page.path.display());
}

/// One test a tutorial, and none without.
macro_rules! tutorials {
    ($($name:ident),*) => {
        $(#[test] fn $name() { follow(concat!(stringify!($name), ".md")); })*

        #[test]
        fn every_tutorial_has_a_test() {
            let pages = Page::all_in(&repository().join("docs/tutorials"), true);
            let names: Vec<_> = pages.iter().map(|p| p.path.file_stem().unwrap().to_str().unwrap()).collect();
            assert_eq!(names, [$(stringify!($name)),*], "left: docs/tutorials; right: tests");
        }
    };
}

tutorials!(cluster, first_pair, gear_whine, gearbox, harris_map, own_mesh, quiet_over_torque, run_up);
