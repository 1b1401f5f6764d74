//! `report.html` and closing table of the envelope.

use crate::{Cell as MapCell, DrawnMap, EnvelopeMap, Examined, FailureMode, Outcome};
use answer::Answer;

use super::{
    EnvelopeResult,
    words::{outcome, short, shown},
};
use report::page::{Cell, Content, Grid, Page, Part, again, cost_part, counted};

pub(super) fn page(of: &EnvelopeResult, answer: &Answer, command: &str) -> Page {
    let mut page =
        Page::of(answer, format!("{}, {}", counted(of.modes.len(), "failure mode"), counted(of.maps.len(), "map")));
    page.push(verdicts(of));
    page.push(Part::more().closing().with(Content::Items(of.modes.iter().flat_map(missed).collect())));
    page.push(outcomes(of));
    for (mode, found) in &of.modes {
        page.push(mode_part(mode, found));
    }
    for (map, drawn, seconds) in &of.maps {
        map_parts(map, drawn, *seconds).into_iter().for_each(|part| page.push(part));
    }
    page.push(cost_part(&answer.cost));
    page.push(again(command));
    page
}

/// Whether something holds, as a cell.
fn verdict(holds: bool) -> Cell {
    Cell::text(if holds { "passes" } else { "FAILS" }).toned(if holds { "solved" } else { "wrong" })
}

fn verdicts(of: &EnvelopeResult) -> Part {
    let rows = of.modes.iter().map(|(mode, found)| {
        vec![Cell::text(mode.label()), Cell::text(mode.name), verdict(found.holds()), Cell::number(found.seconds, 1)]
    });
    Part::new("Failure modes").closing().grid(Grid::new(["case", "name", "", "s"]).rows(rows))
}

/// What of a mode is not as it has to be.
fn missed((mode, found): &(FailureMode, Examined)) -> Vec<String> {
    match &found.figures {
        Err(error) => vec![format!("{}: {error}", mode.label())],
        Ok(figures) => {
            let missed = figures.iter().filter(|f| !f.holds()).map(|figure| {
                let (value, asked) = shown(&figure.robust);
                let naive = figure.naive.as_ref().filter(|n| !n.holds()).map(shown);
                let naive = naive.map_or(String::new(), |(v, a)| format!("; naive {v}, has to be {a}"));
                format!("{}: {}: {value}, has to be {asked}{naive}", mode.label(), figure.what)
            });
            missed.collect()
        }
    }
}

fn outcomes(of: &EnvelopeResult) -> Part {
    let rows = of.maps.iter().map(|(map, drawn, seconds)| {
        let count = |which: Outcome| Cell::count(drawn.cells().filter(|c| c.outcome == which).count());
        vec![
            Cell::text(format!("({}) {}", map.key, map.name)),
            count(Outcome::Solved),
            count(Outcome::Warned),
            count(Outcome::Refused),
            count(Outcome::Failed),
            Cell::count(drawn.wrong()),
            Cell::number(*seconds, 0),
        ]
    });
    let head = ["map", "solved", "warned", "refused", "failed", "wrong", "s"];
    Part::new("Maps").closing().grid(Grid::new(head).rows(rows)).note("Wrong: without a word.")
}

fn mode_part(mode: &FailureMode, found: &Examined) -> Part {
    let rows: Vec<Vec<Cell>> = match &found.figures {
        Err(error) => {
            vec![vec![Cell::text(error.to_string()), Cell::default(), Cell::default(), Cell::default(), verdict(false)]]
        }
        Ok(figures) => figures
            .iter()
            .map(|figure| {
                let (robust, asked) = shown(&figure.robust);
                let naive = figure.naive.as_ref().map_or(String::new(), |n| shown(n).0);
                let [what, naive, robust, asked] = [figure.what.clone(), naive, robust, asked].map(Cell::text);
                vec![what, naive, robust, asked, verdict(figure.holds())]
            })
            .collect(),
    };
    let naive = mode.naive_command().map_or(String::new(), |command| format!("\nto see it fail: {command}"));
    Part::new(format!("{} {}", mode.label(), mode.name))
        .words(format!("{} Here: {}", mode.fails, mode.does))
        .grid(Grid::new(["figure", "naive", "robust", "has to be", ""]).rows(rows))
        .with(Content::Plain(mode.command() + &naive))
}

fn map_parts(map: &EnvelopeMap, drawn: &DrawnMap, seconds: f64) -> Vec<Part> {
    let cell = |c: &MapCell| {
        if c.outcome == Outcome::None {
            return Cell::default();
        }
        let off = c.off_percent.filter(|_| c.outcome != Outcome::Refused).map_or(String::new(), short);
        let said = c.said.as_ref().map_or(String::new(), |said| format!(": {said}"));
        let word = outcome(c);
        Cell::text(format!("{word} {off}").trim_end()).toned(word).told(c.settings.join(" ") + &said)
    };
    let layers = map.layers.iter().zip(&drawn.layers).enumerate();
    layers
        .map(|(k, (layer, rows))| {
            let name = if layer.is_empty() { String::new() } else { format!("{layer}: ") };
            let first = format!("{name}{}, over {}", map.rows.0, map.columns.0);
            let head = std::iter::once(first).chain(map.columns.1.iter().map(|column| (*column).to_owned()));
            let rows = rows
                .iter()
                .zip(map.rows.1)
                .map(|(cells, value)| std::iter::once(Cell::text(*value)).chain(cells.iter().map(cell)).collect());
            let part = if k > 0 {
                Part::more()
            } else {
                let more = "Numbers are differences in percent; a cell says on a pointer what the program said.";
                Part::new(format!("({}) {}", map.key, map.name))
                    .words(format!("{} {more} ({seconds:.0} s)", map.judged))
            };
            part.grid(Grid::new(head).rows(rows))
        })
        .collect()
}
