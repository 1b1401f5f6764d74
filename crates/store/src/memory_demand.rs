//! Whether memory holds the rows that a scene asks for: told before any work, with the keys that ask for them.
//!
//! Each count is within its range; products of counts need not be. Rows of a motion are kept in a file; statistics, spectra
//! and charts take some columns of them at a time.

use std::mem::size_of;

use analysis::lumped::is_lumped;
use contact::SliceResult;
use ltca::{PairResult, StaticPosition};
use scene::{MesherScene, MotionScene, Place, Scene};

use columns::history_columns;

/// A number in memory, and as text.
const NUMBER: usize = size_of::<f64>();
const TEXT: usize = 20;
/// What a row of a motion takes in memory, about: its numbers in the columns that a spectrum or a chart is made of at a
/// time, with their copies on the way.
const ROW: usize = 20 * NUMBER;
/// Teeth of a window, about, where the contact ratio says.
const WINDOW: usize = 3;
/// Square matrices of all slices of a window that contact holds at a time.
const MATRICES: f64 = 4.0;

/// Square matrices of all flank nodes of a window that a reduction holds at a time: compliance, stiffness, and a copy
/// on its way.
const FLANK_MATRICES: f64 = 3.0;

/// Numbers of something, and what each takes.
#[derive(Debug, Clone, PartialEq)]
struct Demand {
    /// What needs the memory.
    what: &'static str,
    /// Keys or words of a command line, and the count that each stands for.
    factors: Vec<(String, f64)>,
    bytes_each: f64,
}

/// A scene that asks for more rows than memory holds.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error(
    "{at}: {} {what} ({product}) take about {} GB; {:.1} GB of memory are free",
    plain(*count), plain((1e-9 * count * bytes_each).ceil()), 1e-9 * free
)]
pub struct MemoryDemandError {
    at: String,
    what: &'static str,
    count: f64,
    product: String,
    bytes_each: f64,
    free: f64,
    keys: String,
    /// The line of the scene that is meant, with a mark below it.
    pub excerpt: Option<String>,
}

impl MemoryDemandError {
    /// What to do next.
    pub fn hint(&self) -> String {
        let fit = (self.free / self.bytes_each).floor();
        format!("lower {}: about {} {} fit", self.keys, plain(fit), self.what)
    }
}

/// Refuses a scene whose rows memory cannot hold, of which `free_bytes` are free.
///
/// # Errors
/// [`MemoryDemandError`] with rows, bytes and keys.
pub fn check_memory(scene: &Scene, free_bytes: f64) -> Result<(), Box<MemoryDemandError>> {
    demands(scene).iter().try_for_each(|demand| demand.within(scene, free_bytes))
}

/// Checks the memory of a scene that is run at many values of a key: `points` of a section each, with a point `every`
/// so many mesh cycles.
///
/// # Errors
/// As [`check_memory`].
pub fn check_sweep_memory(
    scene: &Scene,
    (values, ways): (usize, usize),
    (points, every): (u32, u32),
    free_bytes: f64,
) -> Result<(), Box<MemoryDemandError>> {
    let cycles = ("--cycles".to_owned(), f64::from(points));
    let steps = scene.motion.as_ref().map_or(1.0, |m| f64::from(m.steps_per_mesh_cycle));
    let mut rows = vec![cycles.clone(), ("motion.steps_per_mesh_cycle".to_owned(), steps)];
    if every > 1 {
        rows.push(("mesh cycles of a turn".to_owned(), f64::from(every)));
    }
    // Ways are run side by side.
    let bytes_each = (ways.max(1) * ROW) as f64;
    let along = vec![("--points".to_owned(), values as f64), cycles, ("ways".to_owned(), ways as f64)];
    let sections = Demand { what: "points of sections", factors: along, bytes_each: (NUMBER + 3 * TEXT) as f64 };
    let both = [Demand { what: "rows", factors: rows, bytes_each }, sections];
    both.iter().try_for_each(|demand| demand.within(scene, free_bytes))
}

/// What a scene asks for.
fn demands(scene: &Scene) -> Vec<Demand> {
    let count = |key: &str, n: u32| (key.to_owned(), f64::from(n));
    let mut all = Vec::new();
    match &scene.motion {
        None => {
            let analysis = scene.analysis;
            all.push(Demand {
                what: "positions",
                factors: vec![
                    count("analysis.cycles", analysis.cycles),
                    count("analysis.positions_per_cycle", analysis.positions_per_cycle),
                ],
                bytes_each: position_bytes(scene) as f64,
            });
        }
        Some(words) => {
            let mut factors =
                vec![cycles(scene, words), count("motion.steps_per_mesh_cycle", words.steps_per_mesh_cycle)];
            let mut bytes_each = ROW;
            if let Some(sweep) = &words.sweep {
                if is_lumped(scene) {
                    // Rows of a speed are let go before the next one; ways are run side by side.
                    bytes_each = ROW * sweep.ways.len();
                } else {
                    factors.push(count("motion.sweep.speeds", sweep.speeds));
                    bytes_each = 2 * NUMBER * sweep.ways.len();
                }
            }
            all.push(Demand { what: "rows", factors, bytes_each: bytes_each as f64 });
        }
    }
    if let (Some(slices), true) = (scene.contact.slices, scene.analysis.model.is_reduced()) {
        let window = scene.analysis.window_teeth.unwrap_or(WINDOW as u32);
        let side = [count("contact.slices", slices), count("analysis.window_teeth", window)];
        all.push(Demand {
            what: "numbers of the compliance between all slices",
            factors: [&side[..], &side[..]].concat(),
            bytes_each: MATRICES * NUMBER as f64,
        });
    }
    if scene.analysis.model.has_reduced_gears() {
        all.extend(flanks(scene));
    }
    all
}

/// Compliance between all nodes of the flanks of a window, of the gears that the built-in mesher makes.
///
/// ```text
/// nodes of a flank = 3 p f with elements of order 2, p f with those of order 1;   three numbers a node
/// ```
fn flanks(scene: &Scene) -> impl Iterator<Item = Demand> {
    let window = scene.analysis.window_teeth.map_or(WINDOW as f64, f64::from);
    let of = move |(table, mesher): (&str, &MesherScene)| {
        let nodes = if mesher.order == 2 { 3.0 } else { 1.0 };
        let side = [
            (format!("{table}.mesher.elements_profile"), f64::from(mesher.elements_profile)),
            (format!("{table}.mesher.elements_face"), f64::from(mesher.elements_face)),
        ];
        Demand {
            what: "pairs of flank elements",
            factors: [&side[..], &side[..]].concat(),
            bytes_each: FLANK_MATRICES * NUMBER as f64 * (3.0 * nodes * window).powi(2),
        }
    };
    let meshers = [("pinion", &scene.pinion.mesher), ("wheel", &scene.wheel.mesher)];
    let found: Vec<Demand> = meshers.into_iter().filter_map(|(table, own)| Some(of((table, own.as_ref()?)))).collect();
    found.into_iter()
}

/// A solved position with its line of `history.csv`, bytes.
fn position_bytes(scene: &Scene) -> usize {
    let pairs = scene.analysis.window_teeth.map_or(WINDOW, |w| w as usize);
    let slices = if scene.analysis.model.is_reduced() { scene.contact.slices.unwrap_or(0) as usize } else { 0 };
    let pair = size_of::<PairResult>() + slices / WINDOW * size_of::<SliceResult>();
    size_of::<StaticPosition>() + pairs * pair + history_columns(scene, &[]).len() * TEXT
}

/// Mesh cycles of a motion, and the key that says how many.
fn cycles(scene: &Scene, words: &MotionScene) -> (String, f64) {
    let driver_hz = |rpm: f64| rpm / 60.0 * f64::from(scene.driver_teeth());
    if let Some(ramp) = words.ramp {
        let mean = 0.5 * (ramp.from_rpm + ramp.to_rpm);
        let parts = [
            ("motion.ramp.before_s", ramp.before_s * driver_hz(ramp.from_rpm)),
            ("motion.ramp.duration_s", ramp.duration_s * driver_hz(mean)),
            ("motion.ramp.after_s", ramp.after_s * driver_hz(ramp.to_rpm)),
        ];
        let longest = parts.iter().max_by(|a, b| a.1.total_cmp(&b.1)).map_or("motion.ramp.duration_s", |p| p.0);
        return (longest.to_owned(), parts.iter().map(|p| p.1).sum());
    }
    match words.duration_s {
        Some(seconds) => ("motion.duration_s".to_owned(), seconds * driver_hz(scene.operation.speed_rpm)),
        None => ("analysis.cycles".to_owned(), f64::from(scene.analysis.cycles)),
    }
}

impl Demand {
    fn count(&self) -> f64 {
        self.factors.iter().map(|(_, n)| n).product()
    }

    fn within(&self, scene: &Scene, free: f64) -> Result<(), Box<MemoryDemandError>> {
        let bytes = self.count() * self.bytes_each;
        if bytes <= free {
            return Ok(());
        }
        let mut by_size: Vec<&(String, f64)> = self.factors.iter().collect();
        by_size.sort_by(|a, b| b.1.total_cmp(&a.1));
        by_size.dedup();
        let keys: Vec<&str> = by_size.iter().map(|(key, _)| key.as_str()).collect();
        let place = scene.place_of(&keys);
        let at = place.as_ref().map_or_else(|| scene.file.display().to_string(), ToString::to_string);
        let short = |key: &str| key.rsplit('.').next().unwrap_or(key).to_owned();
        let product: Vec<String> =
            self.factors.iter().map(|(key, n)| format!("`{}` {}", short(key), plain(*n))).collect();
        let names: Vec<String> = keys.iter().map(|key| format!("`{}`", short(key))).collect();
        Err(Box::new(MemoryDemandError {
            at,
            what: self.what,
            count: self.count(),
            product: product.join(" x "),
            bytes_each: self.bytes_each,
            free,
            keys: names.join(" or "),
            excerpt: place.as_ref().and_then(Place::excerpt).map(str::to_owned),
        }))
    }
}

/// A count as people read it.
fn plain(n: f64) -> String {
    if n < 1e6 { format!("{n:.0}") } else { format!("{n:.1e}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What fits is let through, and one row more is not: the law is the product of counts times what a row takes.
    #[test]
    fn a_demand_is_refused_where_it_begins_to_be_too_large() {
        let scene = analysis::resolution::with_slices(Scene::default_scene().unwrap());
        let factors = vec![("analysis.cycles".to_owned(), 10.0), ("analysis.positions_per_cycle".to_owned(), 32.0)];
        let demand = Demand { what: "positions", factors, bytes_each: 1e6 };
        assert!(demand.within(&scene, 320e6).is_ok());
        let refused = demand.within(&scene, 319e6).unwrap_err();
        assert_eq!(
            refused.to_string(),
            "default scene:32: 320 positions (`cycles` 10 x `positions_per_cycle` 32) take about 1 GB; 0.3 GB of memory are free"
        );
        assert_eq!(refused.hint(), "lower `positions_per_cycle` or `cycles`: about 319 positions fit");
    }
}
