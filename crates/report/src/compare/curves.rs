//! Columns that runs share, laid over each other.

use std::collections::HashSet;

use answer::{Table, Values};

use super::ResultFolder;

/// What curves are drawn over.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Axis {
    /// The last whole mesh cycle of every run, 0 .. 1: positions, steps and models of different speed fit on each
    /// other.
    Phase,
    /// Time since the first row.
    Time,
}

/// One quantity of several runs.
#[derive(Debug, Clone, PartialEq)]
pub struct Overlay {
    /// Table that it stands in; `rows` where it is the first one of answers whose tables have different names.
    pub table: String,
    /// Column of the table, with unit; `te_um` where a static transmission error stands beside a dynamic one.
    pub name: String,
    /// Abscissa, with its unit.
    pub over: String,
    /// Runs that have it.
    pub traces: Vec<Trace>,
}

/// One run's curve.
#[derive(Debug, Clone, PartialEq)]
pub struct Trace {
    /// Folder, and the way of a sweep.
    pub label: String,
    /// Abscissa and value.
    pub points: Vec<(f64, f64)>,
}

impl Overlay {
    /// Whether a run, by its label, has one of the curves.
    pub fn is_of(&self, run: &str) -> bool {
        self.traces.iter().any(|trace| trace.label == run || trace.label.starts_with(&format!("{run} (")))
    }
}

/// Columns that are places and not quantities.
const PLACES: [&str; 6] = ["case", "time_s", "pinion_angle_deg", "mesh_phase", "speed_rpm", "mesh_frequency_hz"];
/// One quantity under two names: equilibrium and motion.
const ERRORS: [&str; 2] = ["ste_um", "dte_um"];
const ERROR: &str = "te_um";
/// Kinds of row in a table, told by the words of its first column: ways of a sweep, models of a chart.
const MOST_KINDS: usize = 16;

/// What the rows of answers to several kinds of question are called together.
const ROWS: &str = "rows";

/// Every quantity that two runs at least have, in the order of the first run that has it. The first tables of all runs
/// are laid over each other, whatever they are called: the same question may be asked in several ways.
pub fn overlays(runs: &[ResultFolder], axis: Axis) -> Vec<Overlay> {
    let mut curves: Vec<Curves<'_>> = runs.iter().enumerate().flat_map(|(i, run)| Curves::of(i, run, axis)).collect();
    let first = |run: usize| runs[run].tables().first().map(|table| &*table.name);
    if (1..runs.len()).any(|run| first(run) != first(0)) {
        curves.iter_mut().filter(|c| first(c.run) == Some(&*c.table.name)).for_each(|c| c.group = ROWS);
    }
    let mixed = ERRORS.iter().all(|name| curves.iter().any(|c| c.table.find(name).is_some_and(|all| !all.is_empty())));
    let mut quantities: Vec<[String; 3]> = Vec::new();
    let mut seen: HashSet<[&str; 3]> = HashSet::new();
    for c in &curves {
        for name in c.quantities() {
            let name = if mixed && ERRORS.contains(&name) { ERROR } else { name };
            if seen.insert([c.group, name, &c.over]) {
                quantities.push([c.group, name, &c.over].map(str::to_owned));
            }
        }
    }
    let all = quantities.into_iter().map(|[table, name, over]| {
        let names: &[&str] = if name == ERROR { &ERRORS } else { &[&name] };
        let own = curves.iter().filter(|c| c.over == over && c.group == table);
        let traces: Vec<(usize, Trace)> = own.filter_map(|c| Some((c.run, c.trace(names)?))).collect();
        let shared = traces.iter().any(|(run, _)| *run != traces[0].0);
        (shared, Overlay { table, name, over, traces: traces.into_iter().map(|(_, t)| t).collect() })
    });
    all.filter(|(shared, _)| *shared).map(|(_, overlay)| overlay).collect()
}

/// Rows of one kind of a table with the rows' places.
struct Curves<'a> {
    /// Number of the run.
    run: usize,
    label: String,
    over: String,
    /// What the table is called beside those of other runs.
    group: &'a str,
    table: &'a Table,
    /// Abscissa and number of each row that is drawn.
    places: Vec<(f64, usize)>,
}

impl<'a> Curves<'a> {
    fn of(number: usize, run: &'a ResultFolder, axis: Axis) -> Vec<Self> {
        let of_table = |table: &'a Table| {
            let (over, places) = places(table, axis)?;
            let (kinds, of_row) = kinds(table)?;
            let curves = kinds.into_iter().enumerate().map(|(k, kind)| {
                let label = if kind.is_empty() { run.label() } else { format!("{} ({kind})", run.label()) };
                let places = places.iter().copied().filter(|(_, row)| of_row[*row] == k).collect();
                // A key is varied with its table before it.
                let over = over.rsplit('.').next().unwrap_or(over).to_owned();
                Self { run: number, label, over, group: &table.name, table, places }
            });
            Some(curves.collect::<Vec<_>>())
        };
        run.tables().iter().filter_map(of_table).flatten().collect()
    }

    /// Columns of numbers that are no places.
    fn quantities(&self) -> impl Iterator<Item = &'a str> {
        let over = self.over.clone();
        let numbers = self.table.columns.iter().filter(|c| matches!(c.values, Values::Numbers(_)));
        let short = |name: &'a str| name.rsplit('.').next().unwrap_or(name);
        numbers.map(|c| &*c.name).filter(move |name| short(name) != over && !PLACES.contains(name))
    }

    fn trace(&self, names: &[&str]) -> Option<Trace> {
        let values = names.iter().filter_map(|n| self.table.find(n)).find(|v| !v.is_empty())?;
        let points = self.places.iter().filter_map(|&(x, i)| Some((x, *values.get(i)?))).collect();
        Some(Trace { label: self.label.clone(), points })
    }
}

/// What the rows of a table are drawn over: mesh phase or time where it has them, else its first column of numbers; cases
/// over what tells each from all others, where one key does.
fn places<'a>(table: &'a Table, axis: Axis) -> Option<(&'a str, Vec<(f64, usize)>)> {
    let of = |name: &'static str| table.find(name).filter(|values| !values.is_empty()).map(|values| (name, values));
    match (of("speed_rpm"), of("mesh_phase"), of("time_s"), axis) {
        (_, Some((name, phases)), _, Axis::Phase) => Some((name, last_cycle(phases))),
        (_, Some(_), Some((name, times)), Axis::Time) => Some((name, plain(times))),
        (Some((name, speeds)), None, ..) => Some((name, plain(speeds))),
        _ => {
            let number = |c: &'a answer::Column| match &c.values {
                Values::Numbers(list) => Some((&*c.name, list)),
                Values::Texts(_) | Values::Kept(_) => None,
            };
            let mut all = table.columns.iter().filter_map(number);
            let first = all.next()?;
            let own = all.next().filter(|(_, list)| first.0 == "case" && tells_apart(list)).unwrap_or(first);
            Some((own.0, plain(own.1)))
        }
    }
}

/// Kinds of row by the words of the first column, and the kind of each row; one without a name where that has numbers,
/// or in each row another word, which tells no kinds apart. `None` where kinds are too many.
fn kinds(table: &Table) -> Option<(Vec<&str>, Vec<usize>)> {
    let Some(Values::Texts(words)) = table.columns.first().map(|c| &c.values) else {
        return Some((vec![""], vec![0; table.rows()]));
    };
    if words.iter().collect::<HashSet<_>>().len() == words.len() {
        return Some((vec![""], vec![0; words.len()]));
    }
    let mut kinds: Vec<&str> = Vec::new();
    let mut of_row = Vec::with_capacity(words.len());
    for word in words {
        let known = kinds.iter().position(|known| known == word);
        of_row.push(known.unwrap_or(kinds.len()));
        if known.is_none() {
            kinds.push(word);
        }
        if kinds.len() > MOST_KINDS {
            return None;
        }
    }
    Some((kinds, of_row))
}

/// Whether no two values are the same.
fn tells_apart(values: &[f64]) -> bool {
    let mut all = values.to_vec();
    all.sort_by(f64::total_cmp);
    all.windows(2).all(|pair| pair[0] != pair[1])
}

fn plain(values: &[f64]) -> Vec<(f64, usize)> {
    values.iter().enumerate().map(|(i, &x)| (x, i)).collect()
}

/// Rows of the last whole cycle, ascending in phase. A cycle ends where the phase jumps by more than half; one that was
/// cut short has fewer rows than the longest.
fn last_cycle(phase: &[f64]) -> Vec<(f64, usize)> {
    // What falls short of a whole cycle by round-off begins the next one.
    let phase: Vec<f64> = phase.iter().map(|&p| if p > 1.0 - 1e-6 { 0.0 } else { p }).collect();
    let mut starts = vec![0];
    starts.extend((1..phase.len()).filter(|&i| (phase[i] - phase[i - 1]).abs() > 0.5));
    starts.push(phase.len());
    let cycles: Vec<_> = starts.windows(2).map(|w| w[0]..w[1]).collect();
    let longest = cycles.iter().map(ExactSizeIterator::len).max().unwrap_or(0);
    let Some(last) = cycles.into_iter().rev().find(|c| 10 * c.len() >= 9 * longest) else { return Vec::new() };
    let mut places: Vec<(f64, usize)> = last.map(|i| (phase[i], i)).collect();
    places.sort_by(|a, b| a.0.total_cmp(&b.0));
    places
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The last cycle is whole, also where the file ends within one, and in either sense of rotation.
    #[test]
    fn the_last_whole_cycle_is_taken() {
        let up = [0.5, 0.75, 0.0, 0.25, 0.5, 0.75, 0.0, 0.25, 0.5, 0.75, 0.0, 0.25];
        let rows = |phase: &[f64]| last_cycle(phase).iter().map(|p| p.1).collect::<Vec<_>>();
        assert_eq!(rows(&up), [6, 7, 8, 9]);
        let down: Vec<f64> = up.iter().rev().copied().collect();
        assert_eq!(rows(&down), [9, 8, 7, 6]);
        assert_eq!(rows(&[0.0, 0.25, 0.5, 0.75, 1.0 - 1e-12, 0.25, 0.5, 0.75]), [4, 5, 6, 7]);
        assert_eq!(rows(&[0.0, 0.5]), [0, 1]);
        assert!(rows(&[]).is_empty());
    }

    /// Ways of a sweep are curves of their own; a table without words is one curve, one of many words none.
    #[test]
    fn rows_are_told_apart_by_the_words_of_the_first_column() {
        let sweep = "way,speed_rpm,a,status\nup,1,10,solved\ndown,2,21,solved\nup,2,NaN,failed\n";
        let table = Table::read("resonance", sweep, 9).unwrap();
        assert_eq!(kinds(&table), Some((vec!["up", "down"], vec![0, 1, 0])));
        assert_eq!(places(&table, Axis::Phase), Some(("speed_rpm", vec![(1.0, 0), (2.0, 1), (2.0, 2)])));
        assert_eq!(kinds(&Table::read("x", "a,b\n1,2\n", 9).unwrap()), Some((vec![""], vec![0])));
        let many: String = (0..=MOST_KINDS).map(|i| format!("w{i},1\n")).collect();
        assert_eq!(
            kinds(&Table::read("x", &format!("way,a\n{many}"), 9).unwrap()),
            Some((vec![""], vec![0; 1 + MOST_KINDS]))
        );
        let many = many.repeat(2);
        assert_eq!(kinds(&Table::read("x", &format!("way,a\n{many}"), 9).unwrap()), None);
    }
}
