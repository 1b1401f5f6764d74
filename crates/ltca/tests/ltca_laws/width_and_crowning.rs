//! Slices and face elements that wide, crowned and misaligned pairs ask for: the counts that the program chooses
//! against much finer ones.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]
//!
//! Pairs of 30/30 teeth, module 3 mm, helix angle 20 degrees, at the line load of the default pair.

use std::sync::Arc;

use contact::Misalignment;
use geometry::{FlankModification, Gear, GearData, GearModifications, GearPair};
use ltca::{NominalLines, SpringErrors, StaticModel, StaticOptions, slice_errors, slices_needed, slices_needed_on};
use mesh::Extent;
use reduction::ElasticGear;
use testing::{Case, default_data, mean_and_peak_to_peak, modified, of_order, quadratic};

/// Face width in modules.
const WIDTHS: [f64; 3] = [5.0, 15.0, 40.0];
/// Lead crowning and misalignment in the plane of action, um.
const FLANKS: [[f64; 2]; 6] = [[0.0, 0.0], [30.0, 0.0], [200.0, 0.0], [0.0, 100.0], [30.0, 100.0], [200.0, 100.0]];
const MODULE: f64 = 3.0;

/// What is compared: mean and peak to peak of the elastic transmission error and of the whole one, contact-line length,
/// largest pressure.
#[derive(Debug, Clone, Copy)]
struct Answer {
    mean_um: f64,
    swing_um: f64,
    length_mm: f64,
    pressure_mpa: f64,
}

impl Answer {
    /// Differences from a finer answer, per cent.
    fn off(&self, finest: &Self) -> [f64; 4] {
        let part = |a: f64, b: f64| 100.0 * (a / b - 1.0);
        [
            part(self.mean_um, finest.mean_um),
            part(self.swing_um, finest.swing_um),
            part(self.length_mm, finest.length_mm),
            part(self.pressure_mpa, finest.pressure_mpa),
        ]
    }
}

fn case(width: f64, counts: [u32; 5]) -> Case {
    let data = default_data(20.0).map(|d| GearData { face_width: width * MODULE, ..d });
    quadratic(data, None, 7500.0 * width * MODULE, counts, Extent::Periodic)
}

fn flank_case(plain: &GearPair, base: &StaticOptions, [crowning, misaligned]: [f64; 2]) -> (GearPair, StaticOptions) {
    let crowned = GearModifications::both(FlankModification { lead_crowning: 1e-3 * crowning, ..Default::default() });
    let pair = modified(plain, [crowned, Default::default()]);
    let tilt = Misalignment { in_plane_of_action: 1e-3 * misaligned, ..Default::default() };
    let mut options = base.clone();
    options.contact.offsets[1] = tilt.wheel_offset(&pair, options.side());
    (pair, options)
}

/// A mesh cycle of 16 positions with a window wide enough for all widths; the gears back.
fn answer(pair: &GearPair, gears: Arc<[ElasticGear; 2]>, options: &StaticOptions) -> (Answer, Arc<[ElasticGear; 2]>) {
    let mut model = StaticModel::new(pair.clone(), gears, options.clone()).unwrap_or_else(|e| panic!("{e}"));
    let positions = model.run(16, 1, |_, _, _| ()).unwrap_or_else(|e| panic!("{e}")).positions;
    let elastic = positions.iter().map(|p| 1e3 * (p.transmission_error - p.kinematic_transmission_error));
    let (mean_um, _) = mean_and_peak_to_peak(elastic);
    let (_, swing_um) = mean_and_peak_to_peak(positions.iter().map(|p| 1e3 * p.transmission_error));
    let (length_mm, _) = mean_and_peak_to_peak(positions.iter().map(|p| p.contact_line_length));
    let pressure_mpa = positions.iter().map(|p| p.max_pressure).fold(0.0, f64::max);
    (Answer { mean_um, swing_um, length_mm, pressure_mpa }, model.into_gears())
}

fn options(case: &Case) -> StaticOptions {
    let options = case.slice_options();
    let window = options.window_teeth(&case.pair) + 1;
    StaticOptions { window: Some(window), ..options }
}

fn row(name: &str, [mean, swing, length, pressure]: [f64; 4]) {
    println!("{name}: mean {mean:+.2}, peak to peak {swing:+.1}, length {length:+.2}, pressure {pressure:+.2} %");
}

/// The default pair keeps its 32 slices; wider pairs and crowned ones under a light load ask for more.
#[test]
fn counts_follow_width_and_load() {
    let said = |e: &SpringErrors| format!("{:.2}, {:.2}, {:.2} %", 100.0 * e.mean, 100.0 * e.swing, 100.0 * e.peak);
    let count = |width: f64, [crowning, misaligned]: [f64; 2], line_load: f64| {
        let data = default_data(20.0).map(|d| GearData { face_width: width * MODULE, ..d });
        let [pinion, wheel] = data.map(|d| Gear::new(d).unwrap());
        let plain = GearPair::new(pinion, wheel, None).unwrap();
        let base = StaticOptions::new(line_load * width * MODULE, &plain);
        let (pair, options) = flank_case(&plain, &base, [crowning, misaligned]);
        let need = slices_needed(&pair, &options);
        let of_32 = slice_errors(&pair, &options, 32);
        println!(
            "b/m {width:.2}, crowning {crowning} um, misalignment {misaligned} um, {line_load} N mm/mm: {} slices ({}), 32: {}",
            need.count,
            said(&need.errors),
            said(&of_32)
        );
        need.count
    };
    let usual = 7500.0;
    assert_eq!(count(20.0 / MODULE, [0.0, 0.0], usual), 32);
    WIDTHS.into_iter().flat_map(|w| FLANKS.map(|f| (w, f))).for_each(|(w, f)| {
        count(w, f, usual);
    });
    let by_width = WIDTHS.map(|w| count(w, [0.0, 0.0], usual));
    let by_load = [1.0, 0.1, 0.01].map(|part| count(15.0, [30.0, 0.0], part * usual));
    assert!(by_width.windows(2).all(|w| w[0] < w[1]), "{by_width:?}");
    assert!(by_load[2] > by_load[0] && by_load[2] > 32, "{by_load:?}");
}

/// Nominal contact lines of a pair serve it with any micro-geometry, and say the same as its own; those of a pair that
/// stands otherwise do not.
#[test]
fn nominal_lines_serve_all_micro_geometry() {
    let [pinion, wheel] = default_data(20.0).map(|d| Gear::new(d).unwrap());
    let plain = GearPair::new(pinion, wheel, None).unwrap();
    let base = StaticOptions::new(150e3, &plain);
    let lines = NominalLines::new(&plain, &base);
    for (crowning, part) in [(0.0, 1.0), (10.0, 1.0), (30.0, 0.1), (40.0, 0.01)] {
        let (pair, options) =
            flank_case(&plain, &StaticOptions { torque: part * base.torque, ..base.clone() }, [crowning, 0.0]);
        assert!(lines.serves(&pair, &options), "crowning {crowning} um");
        assert_eq!(slices_needed_on(&lines, &pair, &options), slices_needed(&pair, &options), "crowning {crowning} um");
    }
    let (pair, tilted) = flank_case(&plain, &base, [10.0, 20.0]);
    let apart = GearPair::new(plain.pinion.clone(), plain.wheel.clone(), Some(plain.centre_distance() + 0.1)).unwrap();
    assert!(!lines.serves(&pair, &tilted) && !lines.serves(&apart, &base));
}

/// A pair and its mirror image, of the other hand and with lead slope and misalignment turned round, take as many slices:
/// random pairs under random loads.
#[test]
fn mirrored_pairs_take_as_many_slices() {
    let mut random = testing::Random::new(1045);
    let (mut counts, mut pairs) = (std::collections::BTreeSet::new(), 0);
    while pairs < 60 {
        let teeth = [(); 2].map(|()| random.between(11.0, 60.0) as u32);
        let [helix, slope, tilt] = [(5.0, 30.0), (-10.0, 10.0), (-30.0, 30.0)].map(|(a, b)| random.between(a, b));
        let [width, line_load] = [random.between(3.0, 15.0), random.between(500.0, 10_000.0)];
        let of = |sign: f64| {
            let base = GearData {
                helix_angle: sign * helix.to_radians(),
                face_width: width * MODULE,
                ..default_data(20.0)[0].clone()
            };
            let data = [
                GearData { teeth: teeth[0], ..base.clone() },
                GearData { teeth: teeth[1], helix_angle: -base.helix_angle, ..base },
            ];
            let [pinion, wheel] = data.map(|d| Gear::new(GearData { bore_diameter: 5.0, ..d }).ok());
            let plain = GearPair::new(pinion?, wheel?, None).ok()?;
            let sloped =
                GearModifications::both(FlankModification { lead_slope: sign * 1e-3 * slope, ..Default::default() });
            let pair = modified(&plain, [sloped, Default::default()]);
            let mut options = StaticOptions::new(line_load * width * MODULE, &pair);
            let tilt = Misalignment { in_plane_of_action: sign * 1e-3 * tilt, ..Default::default() };
            options.contact.offsets[1] = tilt.wheel_offset(&pair, options.side());
            Some(slices_needed(&pair, &options).count)
        };
        let (Some(here), Some(there)) = (of(1.0), of(-1.0)) else { continue };
        assert_eq!(here, there, "{teeth:?} teeth, {helix} deg, slope {slope} um, tilt {tilt} um, b/m {width}");
        counts.insert(here);
        pairs += 1;
    }
    assert!(counts.len() > 3, "the choice is one: {counts:?}");
}

/// Contact-line length of the default pair at every position, with 16 and 32 slices against 256: within 0.1 %, where it
/// went up and down by 0.5 mm of 34 with the slices that came and went. The mean within 0.02 %.
#[test]
fn lengths_do_not_ripple_with_the_slices() {
    let case = quadratic(default_data(20.0), None, 150e3, [3, 2, 2, 4, 1], Extent::Periodic);
    let base = case.slice_options();
    let mut gears = Some(Arc::new(case.reduced_gears(&base)));
    let mut lengths = |slices: usize| {
        let options = base.clone().with_contact(|c| c.slices = slices);
        let mut model = StaticModel::new(case.pair.clone(), gears.take().unwrap(), options).unwrap();
        let positions = model.run(32, 1, |_, _, _| ()).unwrap().positions;
        gears = Some(model.into_gears());
        positions.iter().map(|p| p.contact_line_length).collect::<Vec<_>>()
    };
    let finest = lengths(256);
    let mean = |all: &[f64]| all.iter().sum::<f64>() / all.len() as f64;
    for slices in [16, 32, 64] {
        let found = lengths(slices);
        let off = found.iter().zip(&finest).map(|(a, b)| a / b - 1.0);
        let (low, high) = off.fold((0.0f64, 0.0f64), |(l, h), x| (l.min(x), h.max(x)));
        let of_mean = mean(&found) / mean(&finest) - 1.0;
        println!(
            "{slices} slices: mean {:.4} mm of {:.4} ({:+.4} %), at single positions {:+.4} .. {:+.4} %",
            mean(&found),
            mean(&finest),
            100.0 * of_mean,
            100.0 * low,
            100.0 * high
        );
        if slices >= 32 {
            assert!(of_mean.abs() < 2e-4, "{slices} slices: mean length off by {of_mean:e}");
            assert!(high - low < 1e-3, "{slices} slices: lengths ripple by {:e}", high - low);
        }
    }
}

/// Flanks that touch next to a point: length within 2 % of what 512 slices have, with as many as the program chooses.
#[test]
fn short_lines_have_their_length() {
    let case = quadratic(default_data(20.0), None, 150e3, [3, 2, 2, 4, 1], Extent::Periodic);
    let base = case.slice_options();
    let mut gears = Some(Arc::new(case.reduced_gears(&base)));
    for crowning in [200.0, 500.0, 1000.0] {
        let (pair, options) = flank_case(&case.pair, &base, [crowning, 0.0]);
        let chosen = slices_needed(&pair, &options).count;
        let [finest, found, few] = [512, chosen, 32].map(|slices| {
            let options = options.clone().with_contact(|c| c.slices = slices);
            let mut model = StaticModel::new(pair.clone(), gears.take().unwrap(), options).unwrap();
            let positions = model.run(8, 1, |_, _, _| ()).unwrap().positions;
            gears = Some(model.into_gears());
            positions.iter().map(|p| p.contact_line_length).sum::<f64>() / positions.len() as f64
        });
        let off = |length: f64| 100.0 * (length / finest - 1.0);
        println!(
            "crowning {crowning} um: {chosen} slices {found:.4} mm of {finest:.4} ({:+.2} %), 32: {:+.2} %",
            off(found),
            off(few)
        );
        assert!(off(found).abs() < 2.0, "crowning {crowning} um: {found} mm with {chosen} slices, {finest} mm");
    }
}

/// Slices alone, on a coarse mesh.
#[test]
#[ignore = "minutes: a table for docs/validation.md"]
fn slices_alone() {
    for (width, face) in WIDTHS.into_iter().zip([6, 10, 16]).rev() {
        let case = case(width, [3, 2, 2, face, 2]);
        let base = options(&case);
        let mut gears = Some(Arc::new(case.reduced_gears(&base)));
        for flank in FLANKS {
            let (pair, options) = flank_case(&case.pair, &base, flank);
            let mut of = |slices: usize| {
                let (found, back) =
                    answer(&pair, gears.take().unwrap(), &options.clone().with_contact(|c| c.slices = slices));
                gears = Some(back);
                found
            };
            let finest = of(384);
            println!("b/m {width}, crowning {} um, misalignment {} um: {finest:.4?}", flank[0], flank[1]);
            println!("  chosen: {:?}", slices_needed(&pair, &options));
            for slices in [32, 48, 64, 96, 128, 192] {
                row(&format!("  {slices:4} slices"), of(slices).off(&finest));
            }
        }
    }
}

/// Face elements alone, with slices that are fine enough.
#[test]
#[ignore = "minutes: a table for docs/validation.md"]
fn face_elements_alone() {
    for (width, counts, slices) in
        [(5.0, [3, 4, 6, 8, 24], 64), (15.0, [4, 6, 9, 12, 36], 96), (40.0, [6, 10, 16, 24, 64], 160)]
    {
        let mut finest = Vec::new();
        for face in counts.into_iter().rev() {
            let case = case(width, [3, 2, 2, face, 2]);
            let base = options(&case);
            let mut gears = Some(Arc::new(case.reduced_gears(&base)));
            for (k, flank) in FLANKS.into_iter().enumerate() {
                let (pair, options) = flank_case(&case.pair, &base, flank);
                let (found, back) =
                    answer(&pair, gears.take().unwrap(), &options.clone().with_contact(|c| c.slices = slices));
                gears = Some(back);
                if face == counts[4] {
                    println!("b/m {width}, {flank:?}, {face} face elements: {found:.4?}");
                    finest.push(found);
                } else {
                    row(&format!("b/m {width}, {flank:?}, {face:3} face elements"), found.off(&finest[k]));
                }
            }
        }
    }
}

/// Section of the meshes on which the defaults are judged: elements along the profile, the fillet, across the tooth, in
/// the rim. What elements along the face lose hardly depends on it.
const SECTION: [u32; 4] = [3, 2, 2, 1];

/// A pair reduced once: crowning and misalignment leave the reduction as it is.
struct Reduced {
    pair: GearPair,
    base: StaticOptions,
    gears: Option<Arc<[ElasticGear; 2]>>,
}

impl Reduced {
    fn new(order: u32, width: f64, [profile, fillet, thickness, rim]: [u32; 4], face: u32) -> Self {
        let data = default_data(20.0).map(|d| GearData { face_width: width * MODULE, ..d });
        let counts = [profile, fillet, thickness, face, rim];
        let case = of_order(order, data, None, 7500.0 * width * MODULE, counts, Extent::Periodic);
        let base = options(&case);
        let gears = Some(Arc::new(case.reduced_gears(&base)));
        Self { pair: case.pair, base, gears }
    }

    fn chosen(&self, flank: [f64; 2]) -> usize {
        let (pair, options) = flank_case(&self.pair, &self.base, flank);
        slices_needed(&pair, &options).count
    }

    fn answer(&mut self, flank: [f64; 2], slices: usize) -> Answer {
        let (pair, options) = flank_case(&self.pair, &self.base, flank);
        let (found, back) =
            answer(&pair, self.gears.take().unwrap(), &options.clone().with_contact(|c| c.slices = slices));
        self.gears = Some(back);
        found
    }
}

/// Slices of the finest answers.
const FINEST_SLICES: usize = 384;
/// Elements along the face of the finest answers, for [`WIDTHS`]: three times as many as the program chooses, twice as
/// many for the widest pair.
const FINEST_FACE: [u32; 3] = [18, 27, 48];
/// Most that mean, peak to peak, length and pressure may be off by, per cent.
const MOST: [f64; 4] = [1.0, 3.0, 2.0, 3.0];

/// Fails where a difference (per cent) is beyond `share` of [`MOST`].
fn assert_within(off: [f64; 4], share: f64, what: &str) {
    let within = off.iter().zip(MOST).all(|(off, most)| off.abs() < share * most);
    assert!(within, "{what}: mean, peak to peak, length, pressure off by {off:.2?} %, at most {share} of {MOST:?} %");
}

/// The counts that the program chooses, on a coarse section, against the finest: mean within 1 %, peak to peak and
/// pressure within 3 %, length within 2 %.
fn defaults_against_the_finest(number: usize) {
    let (width, finest_face) = (WIDTHS[number], FINEST_FACE[number]);
    let mut fine = Reduced::new(2, width, SECTION, finest_face);
    let finest = FLANKS.map(|flank| fine.answer(flank, FINEST_SLICES));
    drop(fine);
    let face = mesh::face_elements(width * MODULE, MODULE, 2, mesh::FaceResolution::Contact);
    let mut usual = Reduced::new(2, width, SECTION, face);
    let mut all = Vec::new();
    for (flank, finest) in FLANKS.into_iter().zip(&finest) {
        let slices = usual.chosen(flank);
        let off = usual.answer(flank, slices).off(finest);
        let [crowning, misaligned] = flank;
        let what = format!(
            "b/m {width}, crowning {crowning} um, misalignment {misaligned} um, {slices} slices, {face} face elements"
        );
        println!("{finest:.4?}");
        row(&what, off);
        all.push((off, what));
    }
    all.iter().for_each(|(off, what)| assert_within(*off, 1.0, what));
}

#[test]
#[ignore = "two minutes: a table for docs/validation.md"]
fn defaults_of_narrow_pairs() {
    defaults_against_the_finest(0);
}

#[test]
#[ignore = "four minutes: a table for docs/validation.md"]
fn defaults_of_medium_pairs() {
    defaults_against_the_finest(1);
}

#[test]
#[ignore = "ten minutes: a table for docs/validation.md"]
fn defaults_of_wide_pairs() {
    defaults_against_the_finest(2);
}

/// The finest answers have settled: more slices, and more elements along the face, move them by less than a third of
/// what the defaults may be off by.
#[test]
#[ignore = "twenty minutes: the proof of the tables in docs/validation.md"]
fn the_finest_have_settled() {
    let of = |width: f64, flank: [f64; 2], faces: [u32; 2], slices: [usize; 2]| {
        let mut fine = Reduced::new(2, width, SECTION, faces[0]);
        let finest = fine.answer(flank, slices[0]);
        let more_slices = fine.answer(flank, slices[1]).off(&finest);
        drop(fine);
        let more_elements = Reduced::new(2, width, SECTION, faces[1]).answer(flank, slices[0]).off(&finest);
        for (off, what) in [
            (more_slices, format!("b/m {width}, {flank:?}, {} slices against {}", slices[1], slices[0])),
            (more_elements, format!("b/m {width}, {flank:?}, {} face elements against {}", faces[1], faces[0])),
        ] {
            row(&what, off);
            assert_within(off, 1.0 / 3.0, &what);
        }
    };
    of(WIDTHS[1], [30.0, 100.0], [FINEST_FACE[1], 36], [FINEST_SLICES, 576]);
    of(WIDTHS[2], [30.0, 0.0], [FINEST_FACE[2], 60], [FINEST_SLICES, 512]);
}

/// Linear elements, twice as many along the face, against three times as many of them: as good along the face as
/// quadratic ones.
#[test]
#[ignore = "minutes: a line of docs/validation.md"]
fn linear_elements_are_twice_as_many() {
    const SECTION: [u32; 4] = [6, 3, 4, 2];
    let width = WIDTHS[1];
    let chosen = mesh::face_elements(width * MODULE, MODULE, 1, mesh::FaceResolution::Contact);
    let flanks = [[30.0, 0.0], [30.0, 100.0]];
    let mut fine = Reduced::new(1, width, SECTION, 3 * chosen);
    let finest = flanks.map(|flank| fine.answer(flank, 128));
    drop(fine);
    for face in [chosen / 2, chosen] {
        let mut usual = Reduced::new(1, width, SECTION, face);
        for (flank, finest) in flanks.into_iter().zip(&finest) {
            let off = usual.answer(flank, 128).off(finest);
            let what = format!("b/m {width}, {flank:?}, {face} linear face elements");
            row(&what, off);
            if face == chosen {
                assert_within(off, 1.0, &what);
            }
        }
    }
}
