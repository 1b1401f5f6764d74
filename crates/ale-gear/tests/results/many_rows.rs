//! Motions of many rows: memory, files, and what happens where there is no room for them.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use std::{fs, path::Path, process::Stdio, time::Duration};

use parquet::{
    file::reader::{FileReader, SerializedFileReader},
    record::RowAccessor,
};

use super::util::{ISO_SCENE, Scratch};

/// Rows in a mesh cycle.
const PER_CYCLE: usize = 50;

/// A motion of a model that is quickly solved, from its start on.
fn scene(rows: usize) -> String {
    let motion =
        "[output]\nparquet = true\n[motion]\nrun = \"span\"\nsteps_per_mesh_cycle = 50\nsteps_per_resonance = 0\n";
    let bearing = ["pinion", "wheel"].map(|gear| {
        let springs = ["x", "y", "z"].map(|axis| format!("stiffness_{axis}_n_per_mm = 2e5\n"));
        format!("[{gear}.bearing]\n{}", springs.concat())
    });
    let cycles = rows / PER_CYCLE;
    let model = format!("kind = \"dynamic\"\nmodel = \"lumped8\"\ncycles = {cycles}\n");
    ISO_SCENE.replace("model = \"iso\"\n", &model) + &bearing.concat() + motion
}

/// Runs the scene of so many rows into a folder of that name; the largest resident set of the process, MB.
fn run(scratch: &Scratch, rows: usize) -> f64 {
    let (file, folder) = (format!("{rows}.toml"), rows.to_string());
    fs::write(scratch.path().join(&file), scene(rows)).unwrap();
    let mut program = scratch.program();
    program.args(["run", &file, "--out", &folder, "-q"]).stdout(Stdio::null());
    let mut child = program.spawn().unwrap();
    let status = format!("/proc/{}/status", child.id());
    let mut highest: f64 = 0.0;
    while child.try_wait().unwrap().is_none() {
        let text = fs::read_to_string(&status).unwrap_or_default();
        // Before it is the program it is a copy of this one.
        let mut own = text.lines().filter(|_| text.starts_with("Name:\tale-gear\n"));
        let line = own.find_map(|line| line.strip_prefix("VmHWM:"));
        let kib = line.and_then(|line| line.trim().strip_suffix("kB")?.trim().parse::<f64>().ok());
        highest = highest.max(kib.map_or(0.0, |kib| kib * 1024e-6));
        std::thread::sleep(Duration::from_millis(2));
    }
    assert!(child.wait().unwrap().success(), "{rows} rows");
    highest
}

/// A row of a motion takes memory for the few columns that its spectra and charts are made of, not for all that it has in
/// each form: before, 1.4 GB for 10^6 rows. Its files hold all rows in both forms, the first of them as a shorter motion has
/// them.
fn memory_of(few: usize, many: usize, most_each_bytes: f64, most_mb: f64) {
    let scratch = Scratch::new();
    // The gears go into the cache.
    run(&scratch, few);
    let [small, large] = [few, many].map(|rows| run(&scratch, rows));
    let each = 1e6 * (large - small) / (many - few) as f64;
    println!("{few} rows: {small:.0} MB, {many} rows: {large:.0} MB, {each:.0} bytes a row");
    if cfg!(target_os = "linux") {
        assert!(small > 0.0, "no peak was seen");
        assert!(each < most_each_bytes && large < most_mb, "{small} MB, {large} MB, {each} bytes a row");
    }
    let [short, long] = [few, many].map(|rows| scratch.read(&format!("{rows}/history.csv")));
    assert!(long.starts_with(&short), "the first rows differ");
    assert_eq!((short.lines().count(), long.lines().count()), (few + 1, many + 1));
    let energy = scratch.read(&format!("{many}/energy.csv"));
    assert_eq!(energy.lines().count(), many + 1);
    let time = |line: &str| line.split(',').next().unwrap().to_owned();
    assert!(energy.lines().map(time).eq(long.lines().map(time)), "energies are of other rows");
    same_numbers(&scratch.path().join(many.to_string()), &long);
}

/// `history.parquet` has the numbers of the rows of `history.csv`, bit for bit.
fn same_numbers(folder: &Path, csv: &str) {
    let reader = SerializedFileReader::new(fs::File::open(folder.join("history.parquet")).unwrap()).unwrap();
    assert!(reader.num_row_groups() > 1);
    let mut lines = csv.lines().skip(1);
    for (k, (row, line)) in reader.get_row_iter(None).unwrap().zip(lines.by_ref()).enumerate() {
        let row = row.unwrap();
        let same =
            |(i, text): (usize, &str)| row.get_double(i).unwrap().to_bits() == text.parse::<f64>().unwrap().to_bits();
        // Every row has to be there, and some are read as a whole.
        let read = if k % 97 == 0 { usize::MAX } else { 1 };
        assert!(line.split(',').enumerate().take(read).all(same), "row {k}: {line}");
    }
    assert!(lines.next().is_none(), "rows are missing in the Parquet file");
}

#[test]
fn memory_does_not_grow_with_what_rows_hold() {
    memory_of(20_000, 160_000, 300.0, 200.0);
}

#[test]
#[ignore = "a million rows of a build for tests take a minute"]
fn a_million_rows_take_200_mb() {
    memory_of(100_000, 1_000_000, 200.0, 200.0);
}

/// Where rows find no room the run ends with a hint, and leaves nothing.
#[test]
fn rows_without_room_end_the_run_with_a_hint() {
    let scratch = Scratch::new().file("long.toml", scene(40_000));
    let run = scratch.shell("trap '' XFSZ; ulimit -f 4000; exec ale-gear run long.toml --out o -q");
    assert_eq!(run.code, Some(1), "{}", run.stderr);
    assert!(run.stderr.contains("rows cannot be kept in the folder for temporary files"), "{}", run.stderr);
    assert!(run.stderr.contains("hint: is the disk full? `TMPDIR` names another folder"), "{}", run.stderr);
    assert_eq!(scratch.names(), ["long.toml"]);
    let elsewhere = scratch.shell("TMPDIR=/nowhere exec ale-gear run long.toml --out o -q");
    assert!(elsewhere.code == Some(1) && elsewhere.stderr.contains("/nowhere"), "{}", elsewhere.stderr);
}
