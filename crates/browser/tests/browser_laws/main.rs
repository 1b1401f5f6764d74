//! Laws of the page that solves by itself: its numbers are those of a run, its complaints those of the command, and it is one file.

use std::path::Path;

use analysis::{
    NoCache, RemarksAtRest, RestRequest, SharedModels, StaticAnalysis, results::static_headline, solve_at_rest,
};
use live::page::{Answers, Program, html};
use scene::Scene;
use serde_json::{Value, json};

/// The smallest meshes that have contact.
const TEXT: &str = "[pinion]\nteeth = 30\nhelix_angle_deg = 20.0\nmesher = { order = 1, elements_profile = 2, \
    elements_thickness = 2, elements_face = 2, elements_rim = 1 }\n[wheel]\nteeth = 30\nmesher = { order = 1, \
    elements_profile = 2, elements_thickness = 2, elements_face = 2, elements_rim = 1 }\n[pair]\nnormal_module_mm = 3.0\n\
    face_width_mm = 20.0\n[operation]\ntorque_nm = 150.0\n[analysis]\npositions_per_cycle = 6\n";

fn answered(text: &str, set: Value) -> Value {
    let asked = json!({ "page": 0, "number": 1, "text": text, "set": set }).to_string();
    serde_json::from_str(&browser::answer(&asked)).unwrap()
}

/// Through text and back, but for tooth changes, which the page does not tell.
fn headline_of_a_run(text: &str) -> Value {
    let scene = Scene::parse(text, "a.toml".as_ref()).unwrap();
    let solved = StaticAnalysis::new(&scene).solve().unwrap();
    let request = RestRequest::to_the_end(RemarksAtRest::Skipped);
    let settled = solve_at_rest(&scene, &SharedModels::new(&NoCache), request).unwrap().scene;
    let headline = static_headline(&settled, &solved.history).unwrap();
    let mut all: Value = serde_json::from_str(&serde_json::to_string(&headline).unwrap()).unwrap();
    all.as_object_mut().unwrap().retain(|key, _| !key.starts_with("tooth_change"));
    all
}

/// Bit by bit.
#[test]
fn a_move_has_the_numbers_of_a_run() {
    for set in [json!({}), json!({ "operation.torque_nm": "210", "pinion.modification.tip_relief_um": "12" })] {
        let answer = answered(TEXT, set);
        assert_eq!(answer["fault"], Value::Null);
        let handed_out = answer["text"].as_str().unwrap();
        assert_eq!(answer["result"]["headline"], headline_of_a_run(handed_out), "of\n{handed_out}");
        assert!(answer["result"]["solve_ms"].as_f64().unwrap() > 0.0);
    }
}

#[test]
fn what_cannot_be_solved_is_told() {
    let wrong = answered(TEXT, json!({ "pinion.teeth": "-3" }));
    assert!(wrong["fault"]["keys"].as_array().unwrap().contains(&json!("pinion.teeth")), "{wrong}");
    let lost = answered(&TEXT.replace("[pinion]\n", "[pinion]\nmesh_file = \"gear.msh\"\n"), json!({}));
    assert!(lost["fault"]["hint"].is_string(), "{lost}");
    let none: Value = serde_json::from_str(&browser::answer("{")).unwrap();
    assert!(none["fault"]["message"].as_str().unwrap().starts_with("the move is not readable"), "{none}");
}

/// Style, scripts and program stand in the page; nothing is loaded beside it.
#[test]
fn the_page_is_one_file() {
    let program = Program { calls: "let wasm_bindgen;", code: "H4sIAAAA" };
    let page = html((TEXT, Path::new("a.toml")), Answers::Page(program)).unwrap();
    for own in [program.calls, program.code, "window.solver", "new uPlot"] {
        assert!(page.contains(own), "{own}");
    }
    let served = html((TEXT, Path::new("a.toml")), Answers::Server(3)).unwrap();
    for beside in ["src=\"", "href=\"style.css\""] {
        assert!(!page.contains(beside) && served.contains(beside), "{beside}");
    }
}
