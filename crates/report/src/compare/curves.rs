//! Columns that runs share, laid over each other.

use std::collections::HashSet;

use super::ResultFolder;
use study::Columns;

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
    /// Column of the files, with unit; `te_um` where a static transmission error stands beside a dynamic one.
    pub name: String,
    /// What it is over, with unit.
    pub over: &'static str,
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

/// Columns that are places and not quantities.
const PLACES: [&str; 5] = ["time_s", "pinion_angle_deg", "mesh_phase", "speed_rpm", "mesh_frequency_hz"];
/// One quantity under two names: equilibrium and motion.
const ERRORS: [&str; 2] = ["ste_um", "dte_um"];
const ERROR: &str = "te_um";

/// Every quantity that two runs at least have, in the order of the first run that has it.
pub fn overlays(runs: &[ResultFolder], axis: Axis) -> Vec<Overlay> {
    let curves: Vec<Curves<'_>> = runs.iter().enumerate().flat_map(|(i, run)| Curves::of(i, run, axis)).collect();
    let mixed = ERRORS.iter().all(|name| curves.iter().any(|c| c.rows.find(name).is_some_and(|all| !all.is_empty())));
    let mut quantities: Vec<(String, &'static str)> = Vec::new();
    let mut seen: HashSet<(&str, &'static str)> = HashSet::new();
    for c in &curves {
        for name in c.rows.names_from("").into_iter().filter(|n| !PLACES.contains(n)) {
            let name = if mixed && ERRORS.contains(&name) { ERROR } else { name };
            if seen.insert((name, c.over)) {
                quantities.push((name.to_owned(), c.over));
            }
        }
    }
    let all = quantities.into_iter().map(|(name, over)| {
        let names: &[&str] = if name == ERROR { &ERRORS } else { &[&name] };
        let of_axis = curves.iter().filter(|c| c.over == over);
        let traces: Vec<(usize, Trace)> = of_axis.filter_map(|c| Some((c.run, c.trace(names)?))).collect();
        let shared = traces.iter().any(|(run, _)| *run != traces[0].0);
        (shared, Overlay { name, over, traces: traces.into_iter().map(|(_, t)| t).collect() })
    });
    all.filter(|(shared, _)| *shared).map(|(_, overlay)| overlay).collect()
}

/// Rows of a run with the rows' places.
struct Curves<'a> {
    /// Number of the run.
    run: usize,
    label: String,
    over: &'static str,
    rows: &'a Columns,
    /// Abscissa and number of each row that is drawn.
    places: Vec<(f64, usize)>,
}

impl<'a> Curves<'a> {
    fn of(number: usize, run: &'a ResultFolder, axis: Axis) -> Vec<Self> {
        let one = |(way, rows): &'a (String, Columns)| {
            let label = if way.is_empty() { run.label() } else { format!("{} ({way})", run.label()) };
            let of = |name: &str| rows.find(name).unwrap_or_default();
            let speeds = of("speed_rpm");
            let (over, places) = match axis {
                _ if !speeds.is_empty() => ("speed_rpm", plain(speeds)),
                Axis::Time => ("time_s", plain(of("time_s"))),
                Axis::Phase => ("mesh_phase", last_cycle(of("mesh_phase"))),
            };
            Self { run: number, label, over, rows, places }
        };
        run.parts().iter().map(one).collect()
    }

    fn trace(&self, names: &[&str]) -> Option<Trace> {
        let values = names.iter().filter_map(|n| self.rows.find(n)).find(|v| !v.is_empty())?;
        let points = self.places.iter().filter_map(|&(x, i)| Some((x, *values.get(i)?))).collect();
        Some(Trace { label: self.label.clone(), points })
    }
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
}
