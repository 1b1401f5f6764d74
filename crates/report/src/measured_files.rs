//! A measured gear: the files that a scene takes, deviations and classes, waves, pictures.

use geometry::{Gear, Side, modification::Topography};
use metrology::{GearEvaluation, MeasuredFlanks, MeasuredGear, MetrologyError, Ripple, TraceKind};

use crate::charts::{Curve, line_picture};
use answer::Table;

/// Waves that are looked for on each side, and the least amplitude, um.
const WAVES: usize = 10;
const LEAST_UM: f64 = 0.005;
/// Orders up to so many times the number of teeth.
const HARMONICS: u32 = 20;

/// What is made of a measured gear.
#[derive(Debug, Clone)]
pub struct MeasuredFiles {
    /// Names and contents.
    pub files: Vec<(String, String)>,
    /// Tables that go beside them.
    pub tables: Vec<Table>,
    /// What is said on stdout.
    pub text: String,
}

/// Files and text of a measured gear. `name`: `pinion` or `wheel`; `drive`: the side that the torque presses; `source`:
/// name of the file.
///
/// # Errors
/// [`MetrologyError`].
pub fn measured_files(
    measured: &MeasuredGear,
    gear: &Gear,
    (name, drive): (&str, Side),
    source: &str,
) -> Result<MeasuredFiles, MetrologyError> {
    let repeated = measured.repeated_traces();
    let measured = &measured.clone().last_of_each();
    let flanks = metrology::flanks(measured, gear)?;
    let evaluation = metrology::evaluate(measured, gear)?;
    let teeth = gear.teeth();
    let of_side = |side| metrology::ripple(measured, side, (1..=HARMONICS * teeth, 1), WAVES, LEAST_UM).ok();
    let ripples = [Side::Left, Side::Right].map(|side| (side, of_side(side).unwrap_or_default()));
    let mut files = Vec::new();
    let mut scene = String::new();
    if !flanks.pitch_errors.is_empty() {
        let list: Vec<String> = flanks.pitch_errors.iter().map(|mm| format!("{}\n", 1e3 * mm)).collect();
        files.push((
            format!("{name}_pitch.txt"),
            format!("# index deviation of each tooth, um; of {source}\n{}", list.concat()),
        ));
        scene += &format!("[{name}]\npitch_errors_file = \"{name}_pitch.txt\"\n");
    }
    for (topography, side) in flanks.topographies.iter().zip([Side::Left, Side::Right]) {
        let Some(topography) = topography else { continue };
        let which = if side == drive { "drive" } else { "coast" };
        files.push((format!("{name}_{which}.csv"), topography_csv(topography, source)));
        scene += &format!("[{name}.modification.{which}]\ntopography = \"{name}_{which}.csv\"\n");
    }
    let tables = vec![evaluation_table(name, &evaluation), ripple_table(name, &ripples)];
    files.extend(pictures(measured, name, &ripples));
    let text = text((measured, repeated), &flanks, &evaluation, &ripples) + "\nFor the scene:\n" + &scene;
    Ok(MeasuredFiles { files, tables, text })
}

/// A topography in its own format, by tooth.
fn topography_csv(topography: &Topography, source: &str) -> String {
    let mut out = format!("# depths in um, positive: material removed; of {source}\n");
    let teeth = topography.teeth();
    for (i, grid) in topography.grids().iter().enumerate() {
        if i == 0 {
            let heights: Vec<String> = grid.heights().iter().map(|z| format!(", {z}")).collect();
            out += &format!("tooth, roll_deg{}\n", heights.concat());
        }
        let geometry::modification::ProfileAxis::Roll(rolls) = grid.profile() else { continue };
        for (roll, depths) in rolls.iter().zip(grid.depths().chunks(grid.heights().len())) {
            let depths: Vec<String> = depths.iter().map(|mm| format!(", {:.4}", 1e3 * mm)).collect();
            out += &format!("{}, {:.9}{}\n", teeth.get(i).copied().unwrap_or(0), roll.to_degrees(), depths.concat());
        }
    }
    out
}

fn evaluation_table(name: &str, evaluation: &GearEvaluation) -> Table {
    let traces = || evaluation.traces.iter();
    let kind = |kind: &TraceKind| match kind {
        TraceKind::Profile(z) => ("profile", *z),
        TraceKind::Helix(d) => ("helix", *d),
    };
    Table::new(format!("{name}_evaluation"))
        .texts("trace", "profile at a height or helix on a diameter", traces().map(|t| kind(&t.kind).0))
        .numbers("place_mm", "height of a profile, diameter of a helix", traces().map(|t| kind(&t.kind).1))
        .numbers("tooth", "from 0", traces().map(|t| f64::from(t.tooth)))
        .texts("side", "side of the tooth", traces().map(|t| t.side.name()))
        .numbers("slope_um", "f_Halpha, f_Hbeta", traces().map(|t| t.slope_um))
        .numbers("form_um", "f_falpha, f_fbeta", traces().map(|t| t.form_um))
        .numbers("total_um", "F_alpha, F_beta", traces().map(|t| t.total_um))
        .numbers("crowning_um", "C_alpha, C_beta", traces().map(|t| t.crowning_um))
}

fn ripple_table(name: &str, ripples: &[(Side, Vec<Ripple>); 2]) -> Table {
    let all = || ripples.iter().flat_map(|(side, waves)| waves.iter().map(move |wave| (side, wave)));
    Table::new(format!("{name}_ripple"))
        .texts("side", "side of the teeth", all().map(|(side, _)| side.name()))
        .numbers("order", "waves a turn of the gear", all().map(|(_, w)| f64::from(w.order)))
        .numbers("amplitude_um", "of the wave", all().map(|(_, w)| w.amplitude_um))
        .numbers("phase_rad", "at rotation 0 of tooth 0", all().map(|(_, w)| w.phase_rad))
}

/// Traces one above the other as a measuring report has them, and the orders.
fn pictures(measured: &MeasuredGear, name: &str, ripples: &[(Side, Vec<Ripple>); 2]) -> Vec<(String, String)> {
    let mut all = Vec::new();
    for (side, waves) in ripples {
        for (what, is_profile, x) in [("profiles", true, "roll length [mm]"), ("helices", false, "height z [mm]")] {
            let own = measured
                .traces
                .iter()
                .filter(|t| t.side == *side && matches!(t.kind, TraceKind::Profile(_)) == is_profile);
            let curve = |t: &metrology::Trace| {
                let points = t.points(&measured.header)?.iter().map(|[x, y]| (*x, *y)).collect();
                Some(Curve { label: format!("tooth {}", t.tooth), points })
            };
            // Few enough to be told apart.
            let curves: Vec<Curve> = own.filter_map(curve).take(6).collect();
            let title = format!("{name}, {what} of the {} flanks", side.name());
            if let Some(svg) = line_picture(&title, x, "deviation, positive proud [um]", &curves) {
                all.push((format!("{name}_{what}_{}.svg", side.name()), svg));
            }
        }
        let sticks = waves.iter().map(|w| Curve {
            label: format!("order {}", w.order),
            points: vec![(f64::from(w.order), 0.0), (f64::from(w.order), w.amplitude_um)],
        });
        let sticks: Vec<Curve> = sticks.collect();
        let title = format!("{name}, waves of the {} flanks", side.name());
        if let Some(svg) = line_picture(&title, "order, waves a turn", "amplitude [um]", &sticks) {
            all.push((format!("{name}_ripple_{}.svg", side.name()), svg));
        }
    }
    all
}

fn text(
    (of, repeated): (&MeasuredGear, usize),
    flanks: &MeasuredFlanks,
    evaluation: &GearEvaluation,
    ripples: &[(Side, Vec<Ripple>); 2],
) -> String {
    let teeth = of.header.teeth;
    let mut out = String::from("ISO 1328-1:2013, largest deviation of each kind\n");
    for (name, value, class) in &evaluation.classes {
        let class = class.map_or("beyond 11".to_owned(), |c| c.to_string());
        out += &format!("  {name:<9}{value:>8.2} um   class {class}\n");
    }
    if evaluation.classes.is_empty() {
        out += "  nothing: the evaluation ranges (d1, d2; b1, b2) do not ascend, or hold fewer than three values\n";
    }
    if let Some(varies) = evaluation.thickness_variation_um {
        out += &format!("  {:<9}{varies:>8.2} um\n", "R_s");
    }
    for (side, waves) in ripples.iter().filter(|(_, waves)| !waves.is_empty()) {
        out += &format!("\nWaves of the {} flanks, orders of the gear's turn ({teeth} teeth)\n", side.name());
        for wave in waves {
            let alike = wave.order.is_multiple_of(teeth);
            let ghost = if alike { "   the same on all teeth" } else { "   no multiple of the teeth" };
            out += &format!("  order {:>4}{:>9.3} um{ghost}\n", wave.order, wave.amplitude_um);
        }
    }
    out.push('\n');
    for (measured, side) in flanks.measured_teeth.iter().zip([Side::Left, Side::Right]).filter(|(m, _)| !m.is_empty()) {
        let copies = teeth as usize - measured.len();
        let told = if copies == 0 { String::new() } else { format!("; the other {copies} are copies of the nearest") };
        let waves = if copies == 0 { "" } else { "; waves around the gear need profiles of all teeth" };
        let teeth = if measured.len() == 1 { "tooth" } else { "teeth" };
        out += &format!("{} flanks of {} {teeth} were measured{told}{waves}\n", side.name(), measured.len());
    }
    let same: usize = flanks.same_along_face.iter().sum();
    if same > 0 {
        out += &format!("{same} flanks have one profile, which stands for the whole face\n");
    }
    let unused = |is_profile: bool| {
        let of_kind = |t: &&metrology::Trace| matches!(t.kind, TraceKind::Profile(_)) == is_profile;
        of.traces.iter().filter(of_kind).filter(|t| t.places(&of.header).is_none()).count()
    };
    for (name, count) in [("profiles", unused(true)), ("helices", unused(false))].into_iter().filter(|(_, n)| *n > 0) {
        out += &format!("{count} {name} have no measuring range in the header, or fewer than two values: left out\n");
    }
    if repeated > 0 {
        out += &format!("{repeated} traces were measured again at the same place: the last one counts\n");
    }
    let [below, above, lower, upper] = flanks.extrapolated_mm;
    if flanks.extrapolated_mm.iter().any(|mm| *mm > 0.0) {
        out += &format!(
            "beyond the traces flanks go on along their tangents: {below:.2} mm of roll length at the root and {above:.2} mm at the \
             tip, {lower:.2} and {upper:.2} mm at the end faces\n"
        );
    }
    if flanks.left_out_mm > 0.0 {
        out += &format!(
            "pitch errors are the mean of both sides: up to {:.2} um of a side's own are left out\n",
            1e3 * flanks.left_out_mm
        );
    }
    out
}
