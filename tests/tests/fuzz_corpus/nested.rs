//! Nesting without end: every reader has a limit of its own, and none leaves it to the stack.

use std::path::Path;

use scene::{Scene, optimum::Optimisation, plan::Plan};
use verification::readers::READERS;

use super::within_bounds;

/// A scene that runs as it is.
const SMALL: &str = "[pinion]\nteeth = 23\nhelix_angle_deg = 15.0\n[wheel]\nteeth = 41\n\
                     [pair]\nnormal_module_mm = 2.5\nface_width_mm = 18.0\n[operation]\ntorque_nm = 80.0\n";
/// A thread's stack in bytes: less than any system gives.
const STACK: usize = 512 << 10;

fn around(open: &str, inner: &str, close: &str, depth: usize) -> String {
    format!("{}{inner}{}", open.repeat(depth), close.repeat(depth))
}

fn dots(depth: usize) -> String {
    vec!["a"; depth].join(".")
}

/// TOML, JSON, XML, mesh sections, words of `--set`, and templates, nested.
fn inputs(depth: usize) -> Vec<String> {
    let key = dots(depth);
    vec![
        format!("{key} = 1\n"),
        format!("[{key}]\nx = 1\n"),
        format!("[[{key}]]\nx = 1\n"),
        format!("{SMALL}[{key}]\nx = 1\n"),
        format!("name = {}\n", around("[", "1", "]", depth)),
        format!("name = {}\n", around("{a=", "1", "}", depth)),
        format!("name = {{{key} = 1}}\n"),
        format!("{key}=1"),
        format!("pinion.teeth={}", around("[", "1", "]", depth)),
        format!("pinion.teeth={}", around("{a=", "1", "}", depth)),
        around("[", "1", "]", depth),
        around("{\"a\":", "1", "}", depth),
        format!("{{\"rows\": {}}}", around("[", "1", "]", depth)),
        format!("<?xml version=\"1.0\"?>\n<model version=\"1.4\">{}</model>", around("<a>", "", "</a>", depth)),
        "<a>".repeat(depth),
        around("$Nodes\n", "", "$EndNodes\n", depth),
        format!("<!DOCTYPE html><script>{}</script>", around("{\"a\":", "1", "}", depth)),
        format!("{{{{ {} }}}}", around("(", "1", ")", depth)),
        around("{% if true %}", "", "{% endif %}", depth),
    ]
}

/// On a small stack, which an input of this depth would break if a reader went into it.
#[test]
fn every_reader_has_a_limit_of_depth() {
    let read = || {
        for depth in [100, 5_000, 200_000] {
            for input in inputs(depth) {
                for (target, reader) in READERS {
                    let begin: String = input.chars().take(20).collect();
                    within_bounds(&format!("{target}, {depth} deep: {begin}"), reader, input.as_bytes());
                }
                let _ = Plan::parse(&input, Path::new("plan.toml")).map_err(|e| (e.to_string(), e.hint()));
                let _ = Optimisation::parse(&input, Path::new("plan.toml")).map_err(|e| (e.to_string(), e.hint()));
                let _ = Optimisation::is_one(&scene::Document::new(input.clone(), Path::new("plan.toml")));
            }
        }
    };
    std::thread::Builder::new().stack_size(STACK).spawn(read).unwrap().join().unwrap();
}

/// The complaint says what is wrong, and not where in the reader it was noticed.
#[test]
fn nesting_is_told_in_words() {
    for input in [format!("{} = 1\n{SMALL}", dots(5_000)), format!("name = {}\n{SMALL}", around("[", "1", "]", 5_000))]
    {
        let error = Scene::parse(&input, Path::new("a.toml")).expect_err("nested");
        assert!(error.to_string().contains("nested too deep"), "{error}");
        assert!(error.hint().unwrap().contains("parts"), "{:?}", error.hint());
    }
}
