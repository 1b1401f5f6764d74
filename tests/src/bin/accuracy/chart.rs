//! One page of speed against accuracy of everything: pairs at rest by every model and mesh, pairs in motion by model and steps,
//! gearboxes and planetary stages by mesh and positions; the bound that a run gives beside its error.

use std::{fmt::Write, fs, path::Path, time::Instant};

use analysis::{
    Context, GearCache, NoCache, NoObserver,
    accuracy::{
        Bound, GearMemo, Quantity, Rung,
        motion::{MotionAnswer, MotionModel, PairAtRest},
    },
    accuracy_chart::{AccuracyChart, ChartOptions, Outcome},
    gearbox::GearboxResult,
};
use report::charts::{Captions, Labelled, log_panels};
use scene::{AccuracyScene, Scene, Tolerance, gearbox::Gearbox};

use super::Failure;

/// Longest time of a point at rest, s, and positions that slow ways run: the time of a cycle is scaled from them.
const LIMIT_S: f64 = 150.0;
const PART: u32 = 2;
/// Steps in a mesh cycle of a motion, and those of its reference.
const STEPS: [u32; 4] = [32, 64, 128, 256];
const FINE_STEPS: u32 = 1024;
/// Mesh frequencies over the mesh resonance: between orders, on both sides of the second one, near the first.
const SPEEDS: [f64; 4] = [0.30, 0.47, 0.52, 0.85];
/// Elements along the profile and positions of gearboxes, and those of their reference.
const SETTINGS: [[u32; 2]; 4] = [[2, 8], [2, 16], [3, 16], [3, 32]];
const FINE_SETTINGS: [u32; 2] = [4, 64];

/// Errors below this are drawn there: round-off and luck are no accuracy.
const LEAST: f64 = 1e-5;

/// A number's error against the reference, and its own bound, over the reference.
type Cell = (Option<f64>, Option<f64>);

/// A run: which model it was with which mesh or steps, what it took, how exact it is.
struct Row {
    model: String,
    settings: String,
    seconds: f64,
    cells: Vec<Cell>,
}

/// A table of the page.
struct Section {
    title: String,
    /// What was run, and against what.
    words: String,
    numbers: Vec<&'static str>,
    rows: Vec<Row>,
}

/// `words`: the page, and the folder of the shipped scenes.
pub(super) fn run(words: &[String]) -> Result<(), Failure> {
    let [out, scenes] = words else { return Err("chart OUT.md SCENES are wanted".into()) };
    let mut page = String::from(INTRODUCTION);
    let gearbox = |name: &str| Gearbox::read(&Path::new(scenes).join("gearbox").join(name));
    let mut sections = vec![at_rest(&pair(24, 15.0, 31)?)?, at_rest(&pair(30, 0.0, 42)?)?];
    for speed in SPEEDS {
        sections.push(in_motion(speed)?);
    }
    sections.push(of_gearbox("A gearbox of two stages", gearbox("two_stages.toml")?)?);
    sections.push(of_gearbox("A planetary stage", gearbox("planetary_stage.toml")?)?);
    for section in &sections {
        section.write(&mut page)?;
    }
    fs::write(out, page)?;
    let picture = Path::new(out).with_extension("svg");
    fs::write(picture, drawn(&sections)?)?;
    Ok(())
}

/// One chart of everything: a panel a section, with the error of its first number.
fn drawn(sections: &[Section]) -> Result<String, Failure> {
    let mut models: Vec<&str> = sections.iter().flat_map(|s| s.rows.iter().map(|row| &row.model[..])).collect();
    let mut seen = Vec::new();
    models.retain(|model| {
        !seen.contains(model) && {
            seen.push(*model);
            true
        }
    });
    let titles: Vec<String> = sections.iter().map(|s| format!("{}: {}", s.title, s.numbers[0])).collect();
    let panels = sections.iter().zip(&titles).map(|(section, title)| {
        let of_model =
            |model: &&str| section.rows.iter().filter(|row| row.model == *model).filter_map(Row::point).collect();
        let captions = Captions { title, x: "wall time [s]", y: "error, and its bound [%]" };
        (captions, models.iter().map(of_model).collect())
    });
    Ok(log_panels("Accuracy against cost", &models, &panels.collect::<Vec<_>>())?)
}

impl Row {
    /// Error of the first number over the time; errors below [`LEAST`] are drawn there.
    fn point(&self) -> Option<Labelled> {
        let &(error, bound) = self.cells.first()?;
        let percent = |share: f64| 100.0 * share.max(LEAST);
        let (y, bound) = (percent(error?), bound.map(percent));
        (self.seconds > 0.0).then_some(Labelled { at: (self.seconds, y), label: None, bound })
    }
}

impl Section {
    fn write(&self, page: &mut String) -> Result<(), std::fmt::Error> {
        let heads: String = self.numbers.iter().map(|name| format!(" {name}: error, % | bound, % |")).collect();
        let rule = "---|".repeat(2 * self.numbers.len());
        write!(page, "\n## {}\n\n{}\n\n| way | s |{heads}\n|---|---|{rule}\n", self.title, self.words)?;
        for row in &self.rows {
            let percent = |x: Option<f64>| x.map_or_else(|| "-".to_owned(), |x| format!("{:.2}", 100.0 * x));
            let cells: String = row
                .cells
                .iter()
                .map(|(error, bound)| format!(" {} | {} |", percent(*error), percent(*bound)))
                .collect();
            let settings = if row.settings.is_empty() { String::new() } else { format!(", {}", row.settings) };
            writeln!(page, "| {}{settings} | {} |{cells}", row.model, shown(row.seconds))?;
        }
        Ok(())
    }
}

/// Seconds with two digits that count.
fn shown(seconds: f64) -> String {
    let digits = (1.0 - seconds.max(1e-5).log10().floor()).clamp(0.0, 6.0) as usize;
    format!("{seconds:.digits$}")
}

fn pair(pinion: u32, helix_angle_deg: f64, wheel: u32) -> Result<Scene, Failure> {
    let scene = Scene::builder().pinion(pinion, helix_angle_deg).wheel(wheel).normal_module_mm(3.0);
    let scene = scene.face_width_mm(15.0).torque_nm(200.0).set("operation.speed_rpm", 1500.0);
    Ok(scene.set("analysis.positions_per_cycle", 16).set("contact.slices", 24).build()?)
}

/// Every model and mesh of a pair at rest.
fn at_rest(scene: &Scene) -> Result<Section, Failure> {
    let options = ChartOptions { part: PART, ..ChartOptions::quick(LIMIT_S) };
    let chart = AccuracyChart::new(scene, &options).run(&mut NoObserver)?;
    let mut rows = Vec::new();
    for point in &chart.rows {
        let Outcome::Measured { work, error, bounds, .. } = &point.outcome else { continue };
        let settings = point.density.map_or_else(String::new, |d| format!("{} elements along the profile", d.profile));
        let most = |least: f64, most: f64| least.abs().max(most.abs());
        let own = bounds.as_ref().ok();
        let mean = own.map(|b| most(b.mean_ste.least, b.mean_ste.most));
        let peak = own.and_then(|b| b.peak_to_peak_ste.as_ref()).map(|b| most(b.least, b.most));
        let cells = vec![(Some(error.mean_ste.abs()), mean), (error.peak_to_peak_ste.map(f64::abs), peak)];
        rows.push(Row { model: point.way.to_owned(), settings, seconds: work.first_cycle_s(), cells });
    }
    let [pinion, wheel] = scene.gears().map(|gear| gear.teeth);
    Ok(Section {
        title: format!("A pair at rest, {pinion}/{wheel} teeth, {} degrees", scene.pinion.helix_angle_deg),
        words: format!(
            "Module 3 mm, 15 mm wide, 200 N m, 16 positions. Against slices, twice as many, on {} elements along the profile; \
             bounds are against the exact pair. `full` ran 2 positions, the time of a cycle scaled from them; CalculiX \
             beside it: [performance](performance.md).",
            chart.reference_density.profile
        ),
        numbers: vec!["mean STE", "peak to peak"],
        rows,
    })
}

/// Models and steps of a spur pair in motion.
fn in_motion(speed: f64) -> Result<Section, Failure> {
    let kept = GearMemo::new(&NoCache);
    let still = Rung::ALL[0].scene(&moving(&pair(30, 0.0, 42)?)?);
    let rest = PairAtRest::solve(&still, &kept)?;
    let rest = PairAtRest { mesh_hz: speed * rest.resonance.hz, ..rest };
    let mut scene = still;
    scene.operation.speed_rpm = 60.0 * rest.mesh_hz / f64::from(scene.driver_teeth());
    let exact = moved(&scene, (MotionModel::ReducedModes, FINE_STEPS), &rest, &kept)?.1;
    let mut rows = Vec::new();
    for model in MotionModel::ALL {
        for steps in STEPS {
            let (seconds, found, step) = moved(&scene, (model, steps), &rest, &kept)?;
            let error = |i: usize| Some((found[i] / exact[i] - 1.0).abs());
            let cells = vec![(error(0), None), (error(1), step)];
            let (model, settings) = (model.name().to_owned(), format!("{steps} steps"));
            rows.push(Row { model, settings, seconds, cells });
        }
    }
    Ok(Section {
        title: format!("A spur pair in motion at {speed} of its mesh resonance"),
        words: format!(
            "The spur pair above, damping ratio {:.2}, steps a mesh cycle. Against `reduced+modes` with {FINE_STEPS} steps. \
             The bound is `step_error_percent`: of the steps alone, not of the model.",
            rest.resonance.damping
        ),
        numbers: vec!["rms of the DTE", "peak to peak"],
        rows,
    })
}

/// The pair in steady motion, steps as many as rows.
fn moving(scene: &Scene) -> Result<Scene, Failure> {
    let more =
        "\n[motion]\nrun = \"steady\"\nsteps_per_resonance = 0\nwarm_up_cycles = 400\nperiodic_tolerance = 1e-4\n";
    let text = scene.to_toml().replace("kind = \"static\"", "kind = \"dynamic\"");
    Ok(Scene::parse(&(text + more), Path::new("chart.toml"))?)
}

/// Time, root mean square and peak to peak of a model, and its step error.
fn moved(
    scene: &Scene,
    (model, steps): (MotionModel, u32),
    rest: &PairAtRest,
    cache: &dyn GearCache,
) -> Result<(f64, [f64; 2], Option<f64>), Failure> {
    let mut scene = scene.clone();
    if let Some(motion) = &mut scene.motion {
        motion.steps_per_mesh_cycle = steps;
    }
    let start = Instant::now();
    let answer = MotionAnswer::quietly(&model.scene(&scene, rest, 0), cache, &mut NoObserver)?;
    let sample = answer.sample();
    let step = answer.step_error_percent().map(|percent| 1e-2 * percent);
    Ok((start.elapsed().as_secs_f64(), [sample.rms_um, sample.peak_to_peak_um], step))
}

/// Meshes and positions of a gearbox at rest.
fn of_gearbox(title: &str, mut file: Gearbox) -> Result<Section, Failure> {
    (file.vibration, file.motion) = (None, None);
    let exact = numbers(&solved(&mut file, FINE_SETTINGS, false)?.1);
    let mut rows = Vec::new();
    for [elements, positions] in SETTINGS {
        let (seconds, result) = solved(&mut file, [elements, positions], true)?;
        let found = numbers(&result);
        let bounds = result.accuracy.as_ref().map(|a| &a.bounds[..]).unwrap_or_default();
        let cells = NUMBERS.iter().enumerate().map(|(i, (_, quantity))| {
            let worst = found[i].iter().zip(&exact[i]).map(|(a, b)| (a / b - 1.0).abs()).reduce(f64::max);
            let of = |b: &Bound| (b.quantity == *quantity).then(|| b.largest() / b.value.abs());
            (worst, bounds.iter().filter_map(of).reduce(f64::max))
        });
        let (model, settings) =
            ("gearbox".to_owned(), format!("{elements} elements along the profile, {positions} positions"));
        rows.push(Row { model, settings, seconds, cells: cells.collect() });
    }
    let [elements, positions] = FINE_SETTINGS;
    Ok(Section {
        title: format!("{title} at rest"),
        words: format!(
            "`scenes/gearbox`; the worst of all meshes. Against {elements} elements along the profile and {positions} \
             positions. Times are with bounds."
        ),
        numbers: NUMBERS.iter().map(|(name, _)| *name).collect(),
        rows,
    })
}

/// Numbers of a gearbox.
const NUMBERS: [(&str, Quantity); 4] = [
    ("mean TE", Quantity::MeanSte),
    ("misalignment", Quantity::MisalignmentInPlane),
    ("K_Hbeta", Quantity::FaceLoadFactor),
    ("bearing force", Quantity::BearingForce),
];

/// [`NUMBERS`] of all meshes, and of the bearings of some force.
fn numbers(result: &GearboxResult) -> [Vec<f64>; 4] {
    let of = |number: fn(&analysis::gearbox::MeshResult) -> f64| result.meshes.iter().map(number).collect::<Vec<f64>>();
    let forces: Vec<f64> = result.bearings.iter().map(|b| b.force.iter().map(|f| f * f).sum::<f64>().sqrt()).collect();
    let largest = forces.iter().copied().fold(0.0, f64::max);
    [
        of(|mesh| mesh.transmission_error[0]),
        of(|mesh| mesh.misalignment[0]),
        of(|mesh| mesh.face_load_factor.unwrap_or(1.0)),
        forces.into_iter().filter(|force| *force > 0.01 * largest).collect(),
    ]
}

/// Time and result of a gearbox on so many elements along the profile and positions.
fn solved(
    file: &mut Gearbox,
    [elements, positions]: [u32; 2],
    with_bounds: bool,
) -> Result<(f64, GearboxResult), Failure> {
    let rung = Rung::ALL.into_iter().find(|rung| rung.elements_profile == elements).ok_or("no such rung")?;
    for mesh in &mut file.meshes {
        mesh.scene = rung.scene(&mesh.scene);
    }
    file.positions_per_cycle = positions;
    let whole = |(_, quantity): (&str, Quantity)| (quantity, Tolerance::Relative(1.0));
    file.accuracy = if with_bounds { AccuracyScene::new(NUMBERS.map(whole)) } else { AccuracyScene::default() };
    let start = Instant::now();
    let result = analysis::solve(&*file, Context::new(&mut NoObserver))?.finished()?;
    Ok((start.elapsed().as_secs_f64(), result))
}

const INTRODUCTION: &str = "\
# Speed against accuracy

What every model, mesh, number of positions and number of steps takes and how exact it is: pairs at rest, pairs in motion,
gearboxes, planetary stages. Seconds are of one run without the cache on two cores that others use as well: they compare the
rows of a table. A bound is what the run itself says. Made by

```bash
cargo run --release -p verification --bin accuracy -- chart docs/speed_and_accuracy.md scenes
```

![error against wall time](speed_and_accuracy.svg)
";
