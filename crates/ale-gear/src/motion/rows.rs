//! Rows of `history.csv` and `energy.csv`, written as the motion goes on.

use std::{
    f64::consts::TAU,
    fs::{File, OpenOptions},
    io::{BufWriter, Read, Write},
    path::{Path, PathBuf},
};

use serde::{Deserialize, Serialize};

use dynamics::{COORDINATES, Instant, PairMechanism};
use integrate::Ledger;

use study::FlankPattern;

use crate::{
    error::CommandError,
    output::{PLACE_COLUMNS, base_radius_mm, place_values, push_row, root_stress_columns, root_stress_row},
    scene::{Axis, MotionScene, Scene},
};

use super::{no_statistics, pattern::PatternRecord};

/// What a row of turning gears with flanks begins with.
pub(crate) const TURNING: [&str; 6] =
    ["time_s", "pinion_angle_deg", "mesh_phase", "pinion_speed_rpm", "wheel_speed_rpm", "dte_um"];
const LEADING: [&str; 3] = ["dte_rate_um_per_s", "contact_line_length_mm", "pairs_in_contact"];
/// Names of a wrench's components.
pub(crate) const WRENCH: [&str; COORDINATES] =
    ["force_x_n", "force_y_n", "force_z_n", "moment_x_nmm", "moment_y_nmm", "moment_z_nmm"];
const BEARING: [&str; 5] =
    ["bearing_force_x_n", "bearing_force_y_n", "bearing_force_z_n", "bearing_moment_x_nmm", "bearing_moment_y_nmm"];
const DISPLACEMENT: [&str; 5] = ["x_um", "y_um", "z_um", "tilt_x_urad", "tilt_y_urad"];
const TRAILING: [&str; 9] = [
    "normal_force_n",
    "coast_normal_force_n",
    "drive_torque_nm",
    "load_torque_nm",
    "max_pressure_mpa",
    PLACE_COLUMNS[0],
    PLACE_COLUMNS[1],
    PLACE_COLUMNS[2],
    "tooth_changes",
];
/// Columns of the ledger.
pub(crate) const ENERGY: &str = "time_s,kinetic_mj,elastic_mj,supplied_mj,parametric_mj,dissipated_mj,residual_mj\n";
/// The gears, as columns begin.
pub(crate) const GEARS: [&str; 2] = ["pinion", "wheel"];

/// Names of the files.
pub(crate) const HISTORY: &str = "history.csv";
pub(crate) const ENERGY_FILE: &str = "energy.csv";

/// What the columns are.
#[derive(Debug, Clone)]
struct Layout {
    pinion_pitch: f64,
    /// Of the pinion, mm.
    base_radius: f64,
    sense: i64,
    /// Columns of pairs run from -reach to reach.
    reach: i64,
    /// Free coordinates of each gear: columns of displacement and bearing.
    free: [[bool; 5]; 2],
    root_stress: bool,
}

impl Layout {
    fn new(scene: &Scene, system: &PairMechanism, window: usize) -> Self {
        let free = system.options().free.map(|f| [f[0], f[1], f[2], f[3], f[4]]);
        Self {
            pinion_pitch: TAU / f64::from(scene.pinion.teeth),
            base_radius: base_radius_mm(scene, 0),
            sense: scene.operation.rotation.sign() as i64,
            reach: window as i64 / 2 + 1,
            free,
            root_stress: scene.output.root_stress,
        }
    }

    fn header(&self) -> String {
        let pairs = (-self.reach..=self.reach).map(|k| format!("normal_force_pair_{k}_n"));
        names(&self.free, pairs, self.root_stress).join(",") + "\n"
    }

    fn row(&self, now: &Instant) -> Vec<f64> {
        // A row at the end of a cycle belongs to the next one, whatever the last bits say.
        let cycle = (now.cycles + 1e-9).floor();
        let mut row = vec![
            now.time,
            ((now.cycles - 0.5) * self.pinion_pitch).to_degrees(),
            (now.cycles - cycle).max(0.0),
            now.speeds[0] * 60.0 / TAU,
            now.speeds[1] * 60.0 / TAU,
            1e3 * now.transmission_error,
            1e3 * now.transmission_error_rate,
            now.contact_line_length,
            now.pair_forces.iter().filter(|f| **f > 0.0).count() as f64,
        ];
        row.extend(now.mesh.iter());
        let running = |k: i64| self.sense * (k - cycle as i64);
        row.extend((-self.reach..=self.reach).map(|k| {
            let place = usize::try_from(running(k) - now.first_pair).ok();
            place.and_then(|i| now.pair_forces.get(i)).copied().unwrap_or(0.0)
        }));
        for (g, free) in self.free.iter().enumerate().filter(|(_, free)| free.contains(&true)) {
            let at = COORDINATES * g;
            row.extend((0..5).map(|i| now.bearing[at + i]));
            let micro = |i: usize| now.displacement[at + i] * if i < 3 { 1e3 } else { 1e6 };
            row.extend((0..5).filter(|&i| free[i]).map(micro));
        }
        row.extend([
            now.normal_forces[0],
            now.normal_forces[1],
            1e-3 * now.drive_torque,
            1e-3 * now.load_torque,
            now.max_pressure,
        ]);
        row.extend(place_values(self.base_radius, now.slices.iter().map(|s| &s.slice)));
        row.push(now.tooth_changes as f64);
        if self.root_stress {
            // The stress is that of the driving flanks: no number where coast flanks press as well.
            let known = now.normal_forces[1] == 0.0;
            row.extend(
                now.root_stress.iter().flat_map(|of| root_stress_row(of)).map(|s| if known { s } else { f64::NAN }),
            );
        }
        row
    }
}

/// Names of the columns, the given ones of the pairs among them.
fn names(free: &[[bool; 5]; 2], pairs: impl Iterator<Item = String>, root_stress: bool) -> Vec<String> {
    let mut names: Vec<String> = TURNING.iter().chain(&LEADING).map(|&n| n.to_owned()).collect();
    for gear in GEARS {
        names.extend(WRENCH.iter().map(|n| format!("{gear}_{n}")));
    }
    names.extend(pairs);
    for (gear, free) in GEARS.iter().zip(free).filter(|(_, free)| free.contains(&true)) {
        names.extend(BEARING.iter().map(|n| format!("{gear}_{n}")));
        let moves = DISPLACEMENT.iter().zip(free).filter(|(_, free)| **free);
        names.extend(moves.map(|(n, _)| format!("{gear}_{n}")));
    }
    names.extend(TRAILING.iter().map(|&n| n.to_owned()));
    if root_stress {
        names.extend(GEARS.iter().flat_map(|gear| root_stress_columns(gear)));
    }
    names
}

/// Columns that `history.csv` of a scene's motion will have, but for those of single pairs, which go with the window.
pub(crate) fn column_names(scene: &Scene) -> Vec<String> {
    let free = scene.gears().map(|g| {
        let axes = g.body.as_ref().map_or(&[][..], |b| &b.free);
        Axis::ALL.map(|axis| axes.contains(&axis))
    });
    names(&free, std::iter::empty(), scene.output.root_stress)
}

/// What a checkpoint keeps of a file of rows.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct Kept {
    /// Length.
    bytes: u64,
    /// BLAKE3 of so many bytes, hexadecimal.
    blake3: String,
}

/// The digest so far of a file of rows, when it begins with what was kept of it.
///
/// # Errors
/// Exit status 2 when it does not.
fn digested(path: &Path, kept: &Kept) -> Result<blake3::Hasher, CommandError> {
    let mut digest = blake3::Hasher::new();
    let read = File::open(path).and_then(|file| digest.update_reader(file.take(kept.bytes)).map(|_| ()));
    let what = match read {
        Err(e) => format!("cannot be read: {e}"),
        Ok(()) if digest.count() < kept.bytes => "is shorter than its checkpoint says".into(),
        Ok(()) if digest.finalize().to_hex().as_str() != kept.blake3 => {
            "is not as its checkpoint left it: changed or damaged".into()
        }
        Ok(()) => return Ok(digest),
    };
    let hint = "run without `--resume` to start from the beginning".to_owned();
    Err(CommandError::input(format_args!("{}: {what}", path.display()), Some(hint)))
}

/// A file that grows and can be taken up again.
#[derive(Debug)]
struct Growing {
    path: PathBuf,
    file: BufWriter<File>,
    bytes: u64,
    digest: blake3::Hasher,
    failed: Option<std::io::Error>,
}

impl Growing {
    fn new(path: PathBuf, header: &str) -> Result<Self, CommandError> {
        let file = File::create(&path).map_err(|e| CommandError::write(&path, &e))?;
        let mut new = Self { file: BufWriter::new(file), path, bytes: 0, digest: blake3::Hasher::new(), failed: None };
        new.push(header);
        Ok(new)
    }

    /// Cut to what its digest is of, what came after a checkpoint being written anew.
    fn resume(path: PathBuf, digest: blake3::Hasher) -> Result<Self, CommandError> {
        let bytes = digest.count();
        let open = || -> std::io::Result<File> {
            let file = OpenOptions::new().append(true).open(&path)?;
            file.set_len(bytes)?;
            Ok(file)
        };
        let file = open().map_err(|e| CommandError::write(&path, &e))?;
        Ok(Self { file: BufWriter::new(file), path, bytes, digest, failed: None })
    }

    /// A failure is kept for the next flush: rows come from the midst of a computation.
    fn push(&mut self, text: &str) {
        self.bytes += text.len() as u64;
        self.digest.update(text.as_bytes());
        if let Err(e) = self.file.write_all(text.as_bytes()) {
            self.failed.get_or_insert(e);
        }
    }

    fn flush(&mut self) -> Result<Kept, CommandError> {
        match self.failed.take().or_else(|| self.file.flush().err()) {
            None => Ok(Kept { bytes: self.bytes, blake3: self.digest.finalize().to_hex().to_string() }),
            Some(e) => Err(CommandError::write(&self.path, &e)),
        }
    }
}

/// A row of the ledger.
pub(crate) fn energy_row(time: f64, ledger: &Ledger) -> [f64; 7] {
    let Ledger { kinetic, potential, supplied, parametric, dissipated, .. } = *ledger;
    [time, kinetic, potential, supplied, parametric, dissipated, ledger.residual()]
}

/// Both files of rows.
#[derive(Debug)]
pub(super) struct Rows {
    layout: Layout,
    history: Growing,
    energy: Growing,
    line: String,
    pattern: PatternRecord,
}

impl Rows {
    /// Fresh files in a folder.
    pub fn new(
        scene: &Scene,
        words: &MotionScene,
        system: &PairMechanism,
        window: usize,
        folder: &Path,
    ) -> Result<Self, CommandError> {
        let layout = Layout::new(scene, system, window);
        let history = Growing::new(folder.join(HISTORY), &layout.header())?;
        let energy = Growing::new(folder.join(ENERGY_FILE), ENERGY)?;
        let pattern = PatternRecord::new(scene, words, system.pair(), None).map_err(no_statistics)?;
        Ok(Self { history, energy, layout, line: String::new(), pattern })
    }

    /// Whether both files in a folder begin with what was kept of them.
    ///
    /// # Errors
    /// Exit status 2, naming the file that does not.
    pub fn check(folder: &Path, [history, energy]: &[Kept; 2]) -> Result<(), CommandError> {
        digested(&folder.join(HISTORY), history)?;
        digested(&folder.join(ENERGY_FILE), energy).map(|_| ())
    }

    /// Files of before, cut to what was kept of them.
    pub fn resume(
        scene: &Scene,
        words: &MotionScene,
        system: &PairMechanism,
        window: usize,
        folder: &Path,
        (kept, patterns): ([Kept; 2], [FlankPattern; 2]),
    ) -> Result<Self, CommandError> {
        let [history, energy] = [folder.join(HISTORY), folder.join(ENERGY_FILE)];
        // Both are looked at before either is cut.
        let digests = (digested(&history, &kept[0])?, digested(&energy, &kept[1])?);
        Ok(Self {
            layout: Layout::new(scene, system, window),
            pattern: PatternRecord::new(scene, words, system.pair(), Some(patterns)).map_err(no_statistics)?,
            history: Growing::resume(history, digests.0)?,
            energy: Growing::resume(energy, digests.1)?,
            line: String::new(),
        })
    }

    /// One row of each file.
    pub fn push(&mut self, now: &Instant, ledger: &Ledger) {
        self.line.clear();
        push_row(&mut self.line, self.layout.row(now));
        self.history.push(&self.line);
        self.line.clear();
        push_row(&mut self.line, energy_row(now.time, ledger));
        self.energy.push(&self.line);
        self.pattern.push(now);
    }

    /// A mesh cycle of rows is over.
    pub fn end_cycle(&mut self) -> Result<(), CommandError> {
        self.pattern.end_cycle().map_err(no_statistics)
    }

    /// What the flanks were pressed by in the cycles of rows.
    pub fn pattern(&self) -> &PatternRecord {
        &self.pattern
    }

    /// Writes out what is held back; what a checkpoint keeps of both files.
    pub fn flush(&mut self) -> Result<[Kept; 2], CommandError> {
        Ok([self.history.flush()?, self.energy.flush()?])
    }
}
