//! The model `mapped` beside `reduced` on many pairs: root mean square of the dynamic transmission error at speeds from
//! slow to twice the resonance, and the speeds at which the motion jumps.
//!
//! `mapped_pairs [PAIRS] [FIRST]` prints a row a pair, then the worst. Pairs are spread over teeth, helix angle, width,
//! load and damping (a low-discrepancy sequence); meshes are coarse, as both models share them.
#![allow(clippy::print_stdout, reason = "the table is what it is for")]

use std::{path::Path, process::Command};

use serde_json::Value;

/// Mesh frequency over the mesh resonance.
const SPEEDS: [f64; 6] = [0.1, 0.35, 0.6, 0.8, 1.3, 2.0];
/// Mesh frequency over the mesh resonance where folds are looked for: from above the resonance down.
const FOLDS: [f64; 2] = [1.35, 0.6];

type Failure = Box<dyn std::error::Error>;

/// A pair by its number.
struct Pair {
    teeth: [u32; 2],
    helix_angle_deg: f64,
    face_width_mm: f64,
    torque_nm: f64,
    damping: f64,
}

impl Pair {
    fn of(number: u32) -> Self {
        let [a, b, c, d, e] = [2, 3, 5, 7, 11].map(|base| radical_inverse(number + 1, base));
        let pinion = 19 + (30.0 * a) as u32;
        Self {
            teeth: [pinion, pinion + (25.0 * b) as u32],
            helix_angle_deg: if number.is_multiple_of(4) { 0.0 } else { 5.0 + 25.0 * c },
            face_width_mm: 12.0 + 20.0 * b,
            torque_nm: 40.0 + 250.0 * d * d,
            damping: 0.02 + 0.06 * e,
        }
    }

    /// The scene file of the pair.
    fn scene(&self) -> String {
        let gear = |teeth: u32, helix: &str| {
            format!(
                "teeth = {teeth}\n{helix}thickness_allowance_mm = 0.03\n\
                 mesher = {{ order = 1, elements_profile = 3, elements_thickness = 4, elements_face = 6 }}\n"
            )
        };
        let helix = format!("helix_angle_deg = {}\n", self.helix_angle_deg);
        format!(
            "[pinion]\n{}[wheel]\n{}[pair]\nnormal_module_mm = 3.0\nface_width_mm = {}\n[operation]\ntorque_nm = {}\n\
             speed_rpm = 1000.0\n[contact]\nslices = 12\n[analysis]\nkind = \"dynamic\"\npositions_per_cycle = 16\n\
             [motion]\nperiodic_tolerance = 1e-5\nmesh_damping_ratio = {}\n",
            gear(self.teeth[0], &helix),
            gear(self.teeth[1], ""),
            self.face_width_mm,
            self.torque_nm,
            self.damping
        )
    }
}

/// Headline of a run of the program beside this one, whose gears come from its cache.
fn headline(folder: &Path, words: &[&str]) -> Result<Value, Failure> {
    let program = std::env::current_exe()?.with_file_name("ale-gear");
    let scene = folder.join("pair.toml");
    let out = folder.join("out");
    let mut command = Command::new(program);
    command.args([words[0].as_ref(), scene.as_os_str()]).args(&words[1..]);
    let done = command.args(["--json", "--quiet", "--out"]).arg(&out).output()?;
    if !done.status.success() {
        return Err(String::from_utf8_lossy(&done.stderr).into());
    }
    Ok(serde_json::from_slice::<Value>(&done.stdout)?["headline"].clone())
}

fn number(headline: &Value, key: &str) -> Result<f64, Failure> {
    headline[key].as_f64().ok_or_else(|| format!("no `{key}`").into())
}

/// Van der Corput's sequence.
fn radical_inverse(mut number: u32, base: u32) -> f64 {
    let (mut sum, mut share) = (0.0, 1.0);
    while number > 0 {
        share /= f64::from(base);
        sum += share * f64::from(number % base);
        number /= base;
    }
    sum
}

/// Root mean square of the DTE of both models at a speed, um.
fn both_at(folder: &Path, speed_rpm: f64) -> Result<[f64; 2], Failure> {
    let at = |model: &str| {
        let words = [format!("analysis.model={model}"), format!("operation.speed_rpm={speed_rpm}")];
        let all = ["run", "--set", &words[0], "--set", &words[1]];
        number(&headline(folder, &all)?, "rms_dte_um")
    };
    Ok([at("mapped")?, at("reduced")?])
}

/// Largest and least fold of the branch through the resonance, 1/min; nothing without two.
fn jumps(folder: &Path, model: &str, resonance_rpm: f64) -> Result<Option<[f64; 2]>, Failure> {
    let [from, to] = FOLDS.map(|share| share * resonance_rpm);
    let range = format!("operation.speed_rpm={from}:{to}");
    let model = format!("analysis.model={model}");
    let few = ["phases=192", "longest_step=0.1", "time_points=0"].map(|w| format!("motion.continuation.{w}"));
    let words = ["vary", "--vary", &range, "--start", "branch", "--set", &model];
    let words: Vec<&str> = words.into_iter().chain(few.iter().flat_map(|w| ["--set", w.as_str()])).collect();
    let found = headline(folder, &words)?;
    let folds: Vec<f64> = found["folds"].as_array().into_iter().flatten().filter_map(Value::as_f64).collect();
    let range = folds.iter().fold([f64::INFINITY, 0.0f64], |[low, high], &f| [low.min(f), high.max(f)]);
    Ok((folds.len() >= 2).then_some(range))
}

fn main() -> Result<(), Failure> {
    let word = |i: usize, default: u32| std::env::args().nth(i).map_or(Ok(default), |word| word.parse());
    let (count, first) = (word(1, 20)?, word(2, 0)?);
    let (mut worst_rms, mut worst_fold) = (0.0f64, 0.0f64);
    println!("pair: teeth, helix, width, torque, damping; off in rms at {SPEEDS:?} of the resonance; off in jumps");
    let scratch = tempfile::tempdir()?;
    let folder = scratch.path();
    for number in first..first + count {
        let pair = Pair::of(number);
        let Pair { teeth, helix_angle_deg, face_width_mm, torque_nm, damping } = &pair;
        print!("{number:>3}: {teeth:?} {helix_angle_deg:5.1} {face_width_mm:5.1} {torque_nm:5.0} {damping:.3} ");
        std::fs::write(folder.join("pair.toml"), pair.scene())?;
        match one(folder, teeth[0]) {
            Ok(found) => {
                found.rms.iter().for_each(|off| print!(" {off:.1e}"));
                worst_rms = found.rms.into_iter().fold(worst_rms, f64::max);
                match found.jumps {
                    [Some(a), Some(b)] => {
                        let off = [0, 1].map(|i| (a[i] / b[i] - 1.0).abs());
                        worst_fold = off.iter().fold(worst_fold, |m, x| m.max(*x));
                        let at = b.map(|rpm| rpm / found.resonance_rpm);
                        println!("  {:.1e} {:.1e}  at {:.4} {:.4}", off[0], off[1], at[0], at[1]);
                    }
                    [None, None] => println!("  no jump"),
                    [a, b] => println!("  jumps {a:?} on the map, {b:?} of the contact"),
                }
            }
            Err(error) => println!("{error}"),
        }
    }
    println!("worst: rms {worst_rms:.1e}, jumps {worst_fold:.1e}");
    Ok(())
}

/// What was found of a pair.
struct Found {
    resonance_rpm: f64,
    /// Differences over the reduced model's.
    rms: Vec<f64>,
    /// On the map, and of the contact itself.
    jumps: [Option<[f64; 2]>; 2],
}

fn one(folder: &Path, teeth: u32) -> Result<Found, Failure> {
    let slow = headline(folder, &["run", "--set", "analysis.model=mapped"])?;
    let resonance_rpm = number(&slow, "mesh_resonance_hz")? * 60.0 / f64::from(teeth);
    let off =
        |share: f64| both_at(folder, share * resonance_rpm).map(|[mapped, reduced]| (mapped / reduced - 1.0).abs());
    let rms = SPEEDS.into_iter().map(off).collect::<Result<_, _>>()?;
    let jumps = [jumps(folder, "mapped", resonance_rpm)?, jumps(folder, "reduced", resonance_rpm)?];
    Ok(Found { resonance_rpm, rms, jumps })
}
