//! The numbers of the page are those of a run, its complaints those of the command.

use analysis::{
    Context, NoCache, NoObserver, RemarksAtRest, RestRequest, SharedModels, StaticAnalysis, results::static_headline,
    solve_at_rest,
};
use scene::{Scene, gearbox::Gearbox};
use serde_json::{Value, json};

use crate::served::{ISO, Served, with_contact};

/// Through text and back: what JSON has kept of the numbers; tooth changes aside, which the page does not tell.
fn headline_of_a_run(text: &str) -> Value {
    let scene = Scene::parse(text, "a.toml".as_ref()).unwrap();
    let solved = StaticAnalysis::new(&scene).solve().unwrap();
    let settled = solve_at_rest(&scene, &SharedModels::new(&NoCache), RestRequest::to_the_end(RemarksAtRest::Skipped))
        .unwrap()
        .scene;
    let headline = static_headline(&settled, &solved.history).unwrap();
    let mut all: Value = serde_json::from_str(&serde_json::to_string(&headline).unwrap()).unwrap();
    all.as_object_mut().unwrap().retain(|key, _| !key.starts_with("tooth_change"));
    all
}

/// Bit by bit: the scene as it was, and after moves of load and micro-geometry on the same reduced gears.
#[test]
fn a_move_has_the_numbers_of_a_run_of_the_scene_that_it_hands_out() {
    let text = with_contact();
    let served = Served::new(&text);
    let moves = [
        json!({}),
        json!({ "operation.torque_nm": "210" }),
        json!({ "operation.torque_nm": "210", "pinion.modification.tip_relief_um": "12", "wheel.modification.lead_crowning_um": "4",
                "pair.misalignment.in_plane_of_action_um": "-6" }),
    ];
    let mut seen = Vec::new();
    for set in moves {
        let answer = served.answer(&text, set);
        let handed_out = answer["text"].as_str().unwrap();
        assert!(handed_out.contains("# on the wheel"), "comments are kept: {handed_out}");
        let run = headline_of_a_run(handed_out);
        assert_eq!(answer["result"]["headline"], run, "of\n{handed_out}");
        seen.push(run["peak_to_peak_ste_um"].as_f64().unwrap());
    }
    seen.dedup();
    assert_eq!(seen.len(), 3, "each move changes the transmission error: {seen:?} um");
}

/// What a run warns of, the page does too.
#[test]
fn warnings_are_those_of_a_run() {
    let text = with_contact();
    let served = Served::new(&text);
    let said: Vec<String> =
        serde_json::from_value(served.answer(&text, json!({}))["result"]["remarks"].clone()).unwrap();
    let run = StaticAnalysis::new(&Scene::parse(&text, "a.toml".as_ref()).unwrap()).solve().unwrap();
    assert!(run.history.remarks.iter().any(|w| w.code() == "few_face_elements"), "{:?}", run.history.remarks);
    assert_eq!(said, run.history.remarks.iter().map(ToString::to_string).collect::<Vec<_>>());
}

#[test]
fn all_that_is_drawn_comes_with_a_move() {
    let text = with_contact();
    let answer = Served::new(&text).answer(&text, json!({}));
    let result = &answer["result"];
    let titles: Vec<&str> = result["charts"].as_array().unwrap().iter().filter_map(|c| c["title"].as_str()).collect();
    let first = ["Static transmission error", "Spectrum of the static transmission error", "Load sharing"];
    assert_eq!(titles[..3], first);
    assert_eq!(result["charts"][0]["data"][0].as_array().unwrap().len(), 6, "a place a position");
    assert_eq!(result["maps"].as_array().unwrap().len(), 2, "the pattern on either flank");
    let frames = result["view"]["frames"].as_array().unwrap();
    assert!(frames.len() == 6 && frames.iter().all(|f| !f["bands"].as_array().unwrap().is_empty()), "loaded bands");
    assert_eq!(answer["written"]["operation.torque_nm"], "150.0");
    assert_eq!(answer["effective"]["operation.speed_rpm"], "1000.0", "defaults filled in");
}

/// A search lowers the transmission error of what is ticked within its ends, and answers with the pair that has it: the
/// same numbers as a move to the values found.
#[test]
fn a_search_answers_with_the_flatter_pair() {
    let text = with_contact();
    let served = Served::new(&text);
    let (tip, crowning) = ("pinion.modification.tip_relief_um", "wheel.modification.lead_crowning_um");
    let search = json!({ tip: [0.0, 30.0], crowning: [0.0, 20.0] });
    let reply = served
        .post(&json!({ "page": served.open(), "number": 1, "text": text, "set": {}, "search": search }).to_string());
    assert_eq!(reply.status, 200, "{}", reply.body);
    let found: Value = serde_json::from_str(&reply.body).unwrap();
    let [from, to] = [0, 1].map(|i| found["sought"]["peak_to_peak_um"][i].as_f64().unwrap());
    assert!(to < 0.9 * from, "{to} um after {from} um: {}", found["sought"]);
    let set = found["sought"]["set"].as_object().unwrap();
    let value = |key: &str| set[key].as_str().unwrap().parse::<f64>().unwrap();
    assert!((0.0..=30.0).contains(&value(tip)) && (0.0..=20.0).contains(&value(crowning)), "{set:?}");
    let headline = &found["result"]["headline"];
    assert!((headline["peak_to_peak_ste_um"].as_f64().unwrap() / to - 1.0).abs() < 1e-3, "{to} um: {headline}");
    assert_eq!(*headline, headline_of_a_run(found["text"].as_str().unwrap()));
}

#[test]
fn what_is_wrong_stands_beside_its_key_with_the_hint_of_the_command() {
    let served = Served::new(ISO);
    for (key, value) in [
        ("operation.torque_nm", "-1"),
        ("pair.face_width_mm", "wide"),
        ("analysis.model", "redused"),
        ("pinion.teeth", ""),
        ("contact.method", "nodall"),
    ] {
        let answer = served.answer(ISO, json!({ key: value }));
        let (text, fault) = (answer["text"].as_str().unwrap(), &answer["fault"]);
        let error = Scene::parse(text, "a.toml".as_ref()).expect_err("a complaint");
        assert_eq!(fault["message"], error.to_string());
        assert_eq!(fault["hint"].as_str(), error.hint().as_deref(), "{key}");
        assert_eq!(fault["excerpt"].as_str(), error.excerpt(), "{key}");
        assert_eq!(fault["keys"], json!([key]), "{fault}");
        assert!(answer["result"].is_null());
    }
    assert!(served.answer("no toml", json!({}))["fault"]["message"].as_str().unwrap().starts_with("a.toml:1: "));
}

#[test]
fn what_the_page_cannot_show_is_refused_beside_its_key() {
    let served = Served::new(ISO);
    for (set, key) in [
        (json!({ "analysis.model": "reduced", "analysis.kind": "dynamic" }), "analysis.kind"),
        (json!({ "analysis.model": "full" }), "analysis.model"),
    ] {
        let fault = &served.answer(ISO, set)["fault"];
        assert_eq!(fault["keys"], json!([key]), "{fault}");
        assert!(fault["hint"].as_str().unwrap().contains("model = \"reduced\""), "{fault}");
    }
    let lumped = served.answer(include_str!("../../../../scenes/seeds/004.toml"), json!({}));
    assert_eq!(lumped["fault"]["keys"], json!(["analysis.model"]), "{lumped}");
    let huge = served.answer(ISO, json!({ "analysis.positions_per_cycle": "100000", "analysis.cycles": "100000000" }));
    assert!(huge["fault"]["message"].as_str().unwrap().contains("GB"), "{huge}");
}

/// Each page counts its own moves.
#[test]
fn a_move_that_was_overtaken_is_dropped() {
    let served = Served::new(ISO);
    let (page, other) = (served.open(), served.open());
    let status = |page, number| served.moved(page, number, ISO, json!({})).status;
    assert_eq!([status(page, 5), status(page, 3), status(page, 6), status(other, 1)], [200, 409, 200, 200]);
}

/// The numbers of a gearbox are those of a run of the document that is handed out, of which motions are left out.
#[test]
fn a_gearbox_has_the_numbers_of_a_run() {
    let text = include_str!("../../../../scenes/gearbox/engine.toml");
    let served = Served::new(text);
    let slope = "mesh.0.scene.pinion.modification.lead_slope_um";
    let mut seen = Vec::new();
    for set in [json!({}), json!({ slope: "15" }), json!({ slope: "15", "torque.0.torque_nm": "120.0" })] {
        let answer = served.answer(text, set);
        let mut file = Gearbox::parse(answer["text"].as_str().unwrap(), "a.toml".as_ref()).unwrap();
        (file.motion, file.vibration, file.modes, file.branch) = (None, None, None, None);
        let run = analysis::solve(&file, Context::new(&mut NoObserver)).unwrap().finished().unwrap();
        assert_eq!(answer["result"]["headline"], run.headline(), "of\n{}", answer["text"]);
        assert!(
            answer["result"]["remarks"][0].as_str().unwrap().contains("[motion]"),
            "{}",
            answer["result"]["remarks"]
        );
        assert_eq!(answer["result"]["maps"].as_array().unwrap().len(), 2, "the pattern on either flank");
        let has = |key: &str| answer["sliders"].as_array().unwrap().iter().any(|slider| slider["key"] == key);
        assert!(has(slope) && has("torque.0.torque_nm") && !has("mesh.0.scene.operation.torque_nm"));
        seen.push(run.headline()["face_load_factor"][0].as_f64().unwrap());
    }
    seen.dedup();
    assert_eq!(seen.len(), 3, "each move changes K_Hbeta: {seen:?}");
    let fault = served.answer(text, json!({ "torque.3.torque_nm": "1" }))["fault"].clone();
    assert_eq!(fault["keys"], json!(["torque.3.torque_nm"]), "{fault}");
}
