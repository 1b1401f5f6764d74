//! The model `mapped` beside `reduced` on many pairs: root mean square of the dynamic transmission error at speeds from
//! slow to twice the resonance, and the speeds at which the motion jumps.
//!
//! `mapped_pairs [PAIRS] [FIRST]` prints a row a pair, then the worst. Pairs are spread over teeth, helix angle, width,
//! load and damping (a low-discrepancy sequence); meshes are coarse, as both models share them.
#![allow(clippy::print_stdout, reason = "the table is what it is for")]

use analysis::{
    lumped::{ContinuationAnalysis, ContinuationResult, LumpedAnalysis},
    motion::MotionAnalysis,
};
use scene::{Scene, SceneBuilder};

/// Mesh frequency over the mesh resonance.
const SPEEDS: [f64; 6] = [0.1, 0.35, 0.6, 0.8, 1.3, 2.0];
/// The same, where folds are looked for: from above the resonance down.
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

    fn scene(&self, model: &str) -> SceneBuilder {
        let base = Scene::builder().pinion(self.teeth[0], self.helix_angle_deg).wheel(self.teeth[1]);
        let base = base.normal_module_mm(3.0).face_width_mm(self.face_width_mm).torque_nm(self.torque_nm);
        let meshed = ["pinion.mesher", "wheel.mesher"].iter().fold(base, |scene, gear| {
            let keys = [("order", 1), ("elements_profile", 3), ("elements_thickness", 4), ("elements_face", 6)];
            keys.iter().fold(scene, |scene, (key, value)| scene.set(&format!("{gear}.{key}"), *value))
        });
        meshed
            .set("pinion.thickness_allowance_mm", 0.03)
            .set("wheel.thickness_allowance_mm", 0.03)
            .set("contact.slices", 12)
            .set("operation.speed_rpm", 1000.0)
            .set("analysis.kind", "dynamic")
            .set("analysis.model", model)
            .set("analysis.positions_per_cycle", 16)
            .set("motion.mesh_damping_ratio", self.damping)
    }
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
fn both_at(pair: &Pair, speed_rpm: f64) -> Result<[f64; 2], Failure> {
    let steady = |model: &str| {
        let scene = pair.scene(model).set("operation.speed_rpm", speed_rpm);
        scene.set("motion.periodic_tolerance", 1e-5).build()
    };
    let mapped = LumpedAnalysis::new(&steady("mapped")?).solve()?;
    let reduced = MotionAnalysis::new(&steady("reduced")?).solve()?;
    Ok([mapped.headline.rms_dte_um, reduced.headline.rms_dte_um])
}

/// The branch through the resonance.
fn branch(pair: &Pair, model: &str, resonance_rpm: f64) -> Result<ContinuationResult, Failure> {
    let scene = pair
        .scene(model)
        .set("motion.run", "continuation")
        .set("motion.continuation.from", FOLDS[0] * resonance_rpm)
        .set("motion.continuation.to", FOLDS[1] * resonance_rpm)
        .set("motion.continuation.phases", 192)
        .set("motion.continuation.longest_step", 0.1)
        .set("motion.continuation.time_points", 0);
    Ok(ContinuationAnalysis::new(&scene.build()?).solve()?)
}

/// Largest and least fold, 1/min.
fn jumps(found: &ContinuationResult) -> Option<[f64; 2]> {
    let folds = &found.headline.folds;
    let range = folds.iter().fold([f64::INFINITY, 0.0f64], |[low, high], &f| [low.min(f), high.max(f)]);
    (folds.len() >= 2).then_some(range)
}

fn main() -> Result<(), Failure> {
    let word = |i: usize, default: u32| std::env::args().nth(i).map_or(Ok(default), |word| word.parse());
    let (count, first) = (word(1, 20)?, word(2, 0)?);
    let (mut worst_rms, mut worst_fold) = (0.0f64, 0.0f64);
    println!("pair: teeth, helix, width, torque, damping; off in rms at {SPEEDS:?} of the resonance; off in jumps");
    for number in first..first + count {
        let pair = Pair::of(number);
        let Pair { teeth, helix_angle_deg, face_width_mm, torque_nm, damping } = &pair;
        print!("{number:>3}: {teeth:?} {helix_angle_deg:5.1} {face_width_mm:5.1} {torque_nm:5.0} {damping:.3} ");
        let resonance = LumpedAnalysis::new(&pair.scene("mapped").build()?).solve();
        let hz = match resonance {
            Ok(found) => found.headline.mesh_resonance_hz.ok_or("no resonance")?,
            Err(error) => {
                println!("{error}");
                continue;
            }
        };
        let rpm = hz * 60.0 / f64::from(teeth[0]);
        for share in SPEEDS {
            let [mapped, reduced] = both_at(&pair, share * rpm)?;
            let off = (mapped / reduced - 1.0).abs();
            worst_rms = worst_rms.max(off);
            print!(" {off:.1e}");
        }
        let [mapped, reduced] = [branch(&pair, "mapped", rpm)?, branch(&pair, "reduced", rpm)?];
        match (jumps(&mapped), jumps(&reduced)) {
            (Some(a), Some(b)) => {
                let off = [0, 1].map(|i| (a[i] / b[i] - 1.0).abs());
                worst_fold = off.iter().fold(worst_fold, |m, x| m.max(*x));
                println!("  {:.1e} {:.1e}  at {:.4} {:.4}", off[0], off[1], b[0] / rpm, b[1] / rpm);
            }
            (None, None) => println!("  no jump"),
            (a, b) => println!("  jumps {a:?} on the map, {b:?} of the contact"),
        }
    }
    println!("worst: rms {worst_rms:.1e}, jumps {worst_fold:.1e}");
    Ok(())
}
