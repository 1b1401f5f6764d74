//! Tables without rows and objects of summaries with their keys: what `docs/outputs.md` lists.

use analysis::{
    accuracy_chart::{Density, ResonanceCurve, ResonancePrecision, WorkPrecision},
    flank_orders::{FlankOrders, FlankWaves},
    lumped::{LumpedCampbell, LumpedQuantity, SweepOptions},
    motion::{CampbellDiagram, MotionPrecision, MotionSpectrum, OrderCut, RunUp, Waterfall},
    parameter_study::{Findings, Follower},
};
use answer::{Checks, Cost, Phase, Remark, Table};
use columns::derivative_columns;
use described::Key;
use ltca::{RootPattern, StaticHistory};
use scene::{
    Scene, SceneError, SteadyBy, SweepScene,
    gearbox::Gearbox,
    plan::SectionEvery,
    study::{Study, StudyQuantity, Take},
};
use study::{Campbell, Work};

use crate::{
    accuracy_chart,
    answer_files::{Object, Summary},
    branch_files::{self, ShownBranch},
    compare, contact_files, gearbox_files, optimum_files,
    pair_files::{key_rows, rating, rows},
    plan_files, study_files,
};

/// Every table beside the histories without rows, each with what it is of where several tables have one name.
///
/// `<key>`, `<column>` and `<output>` stand for the key that a user varies, the column and the number that a user looks at. Columns of meshes, bearings and shafts are those of `gearbox`.
///
/// # Errors
/// [`SceneError`] when `scene` is no pair.
pub fn documented_tables(scene: &Scene, gearbox: &Gearbox) -> Result<Vec<(String, Table)>, SceneError> {
    let pair = scene.gear_pair()?;
    let [orders, shares] = contact_files::flank_orders(&FlankOrders::default());
    let of_pair = of_motions().into_iter().chain([
        contact_files::contact_lines(scene, &pair, &StaticHistory::default()),
        orders,
        shares,
        contact_files::of_places("contact_pattern_pinion", &[]),
        rating::of_root("root_pattern_pinion", &RootPattern::default()),
        study_files::documented(&study(), &findings()),
        plan_files::documented(),
    ]);
    let (of_gearbox, _) = gearbox_files::documented(gearbox);
    let of_gearbox =
        of_gearbox.into_iter().map(|table| match &*table.name {
            name @ ("campbell" | "cycles" | "motion" | "spectrum" | "waterfall" | "branch" | "bifurcations"
            | "in_time") => (format!("{name}, a gearbox"), table),
            name => (name.to_owned(), table),
        });
    let named = [
        ("history, derivatives", derivative_columns()),
        ("campbell, a motion of reduced gears", rows::campbell(&campbell())),
        ("campbell, a linear model", rows::lumped_campbell(&lumped_campbell())),
    ];
    let named = named.into_iter().chain(optimum_files::documented()).map(|(name, table)| (name.to_owned(), table));
    let charts = accuracy_chart::documented(&work_precision(), &motion_precision(), &resonance_precision());
    let plain = of_pair.chain(charts).chain(compare::documented()).map(|table| (table.name.to_string(), table));
    Ok(plain.chain(named).chain(of_gearbox).collect())
}

/// Every object of a `summary.json` with its keys.
pub fn documented_objects(gearbox: &Gearbox) -> Vec<(&'static str, Vec<Key>)> {
    let common: [Object; 5] = [
        ("every summary", Summary::KEYS),
        ("a certificate", Checks::KEYS),
        ("remarks", Remark::KEYS),
        ("cost", Cost::KEYS),
        ("phases", Phase::KEYS),
    ];
    let (_, of_gearbox) = gearbox_files::documented(gearbox);
    let own = common.into_iter().chain(plan_files::OBJECTS).chain(optimum_files::OBJECTS);
    let own = own.chain(study_files::OBJECTS).chain([accuracy_chart::OBJECT, compare::OBJECT]);
    let own = own.map(|(name, keys)| (name, keys.to_vec()));
    analysis::objects().into_iter().chain(own).chain(of_gearbox).collect()
}

fn of_motions() -> Vec<Table> {
    let cut = OrderCut { time_s: 0.0, driver_speed_rpm: 0.0, mesh_frequency_hz: 0.0, amplitudes_um: vec![0.0] };
    let options = SweepOptions {
        key: "<key>".into(),
        ways: Vec::new(),
        every: SectionEvery::MeshCycle,
        quantity: LumpedQuantity::new("<column>", |row| row.transmission_error_um),
        points: 1,
        stretches: 0,
    };
    vec![
        rows::spectrum(&MotionSpectrum::default(), &FlankWaves::default()),
        rows::waterfall(&Waterfall::default()),
        rows::cycles(&RunUp::default()),
        rows::order_cuts(&RunUp { cuts: vec![cut], ..RunUp::default() }),
        rows::resonance(&[]),
        key_rows::sweep(&options, &[]),
        key_rows::bifurcation(&options, &[]),
        key_rows::basins(&[]),
        key_rows::attractors(&[]),
    ]
    .into_iter()
    .chain(branch_files::tables(&ShownBranch::of_pair("<key>", &[], &[], &[])))
    .collect()
}

/// A diagram of so many frequencies and orders, without speeds.
fn diagram(frequencies: usize, orders: usize) -> Campbell {
    Campbell {
        speeds: Vec::new(),
        frequencies: vec![Vec::new(); frequencies],
        orders: vec![1.0; orders],
        resonances: Vec::new(),
    }
}

fn campbell() -> CampbellDiagram {
    let names = ["mesh resonance", "pinion elastic", "wheel elastic", "pinion mode 1", "wheel mode 1"];
    CampbellDiagram {
        diagram: diagram(names.len(), 1),
        orders: vec!["mesh order 1".to_owned()],
        names: names.map(str::to_owned).to_vec(),
    }
}

fn lumped_campbell() -> LumpedCampbell {
    let names = ["mesh order 1", "driver's turn", "driven gear's turn"];
    LumpedCampbell {
        diagram: diagram(1, names.len()),
        names: names.map(str::to_owned).to_vec(),
        at_rest_hz: Vec::new(),
        continuum_hz: None,
    }
}

fn study() -> Study {
    let takes = [Take::Mean, Take::PeakToPeak, Take::Least, Take::Largest];
    Study {
        name: String::new(),
        file: "study.toml".into(),
        parameter: String::new(),
        cases: Vec::new(),
        quantities: takes.map(|take| StudyQuantity { column: "<column>".to_owned(), take }).to_vec(),
        over_time: Vec::new(),
        follow: Vec::new(),
        full: None,
    }
}

fn findings() -> Findings {
    let (column, beside) = ("<column>".to_owned(), "<beside>".to_owned());
    let followers = vec![Follower { column, beside, correlation: Vec::new() }];
    Findings { cases: Vec::new(), followers, remarks: Vec::new() }
}

fn work_precision() -> WorkPrecision {
    let none = Work {
        offline_s: 0.0,
        cycle_s: 0.0,
        further_cycle_s: None,
        positions_run: 0,
        positions_asked: 0,
        peak_memory_mb: None,
        dof_before: 0,
        dof_after: 0,
    };
    WorkPrecision {
        reference_density: Density { profile: 0 },
        reference_work: none,
        reference: study::Answer { ste_um: Vec::new(), line_length_mm: Vec::new() },
        reference_bounds: Err(String::new()),
        reference_note: String::new(),
        rows: Vec::new(),
        motion: Vec::new(),
    }
}

fn motion_precision() -> MotionPrecision {
    MotionPrecision { points: Vec::new(), reference: String::new(), mesh_over_resonance: 0.0, cycles: 0 }
}

fn resonance_precision() -> ResonancePrecision {
    let reference = ResonanceCurve { offline_s: 0.0, sweep_s: 0.0, speeds: Vec::new(), error: None };
    let sweep = SweepScene { from_rpm: 0.0, to_rpm: 0.0, speeds: 0, ways: Vec::new(), steady_by: SteadyBy::Shooting };
    ResonancePrecision { points: Vec::new(), reference, reference_steps: 0, sweep }
}
