//! A gearbox beside pairs: its one mesh by the names of a pair.

use std::borrow::Cow;

use answer::{Column, Table, Values};
use serde_json::{Value, json};

use super::ResultFolder;

/// Kinds of answers, as summaries have them.
const GEARBOX: &str = "gearbox";
const PAIR: &str = "pair";
/// What the columns of the first mesh begin with.
const MESH: &str = "mesh_1_";

/// Answers by names that they share. A gearbox of one mesh beside pairs has the numbers of this mesh as a pair has them, not
/// as lists of one, and its rows as `history`: columns of the mesh without their number, over its phase.
pub fn by_shared_names(runs: Vec<ResultFolder>) -> Vec<ResultFolder> {
    let has = |kind: &str| runs.iter().any(|run| run.kind() == kind);
    if !(has(GEARBOX) && has(PAIR)) {
        return runs;
    }
    runs.into_iter().map(|run| if run.kind() == GEARBOX { as_pair(run) } else { run }).collect()
}

fn as_pair(mut run: ResultFolder) -> ResultFolder {
    let Some([mesh]) = run.summary["meshes"].as_array().map(Vec::as_slice) else { return run };
    let mesh = mesh.clone();
    if let Some(headline) = run.summary["headline"].as_object_mut() {
        for value in headline.values_mut() {
            if let Some([one]) = value.as_array().map(Vec::as_slice) {
                *value = one.clone();
            }
        }
        for (key, value) in mesh.as_object().into_iter().flatten().filter(|(_, value)| value.is_number()) {
            headline.entry(key.clone()).or_insert_with(|| value.clone());
        }
        headline.remove("eps_gamma");
    }
    run.summary["geometry"] = json!({ "eps_gamma": mesh.get("eps_gamma").unwrap_or(&Value::Null) });
    let rows = |name: &str| run.tables.iter().position(|table| table.name == name);
    if let Some(at) = rows("motion").or_else(|| rows("positions")) {
        let history = of_mesh(&run.tables[at]);
        run.tables.remove(at);
        run.tables.insert(0, history);
    }
    run
}

/// Rows of a gearbox of one mesh as those of a pair.
fn of_mesh(rows: &Table) -> Table {
    let mut history = Table::new("history");
    let phase = |cycles: &f64| cycles.rem_euclid(1.0);
    if let Some(cycles) = rows.find(&format!("{MESH}cycles")) {
        history.push_numbers("mesh_phase".to_owned(), "", cycles.iter().map(phase));
    }
    let own = rows.columns.iter().filter(|column| matches!(column.values, Values::Numbers(_)));
    history.columns.extend(own.map(|column| {
        let name = column.name.strip_prefix(MESH).unwrap_or(&column.name).to_owned();
        Column { name: Cow::Owned(name), ..column.clone() }
    }));
    history
}
