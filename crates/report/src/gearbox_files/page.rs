//! `report.html` and closing table of a gearbox: in space, tables by stage, charts.

use std::borrow::Cow;

use analysis::gearbox::{BearingLife, BearingLoad, GearboxResult, MeshResult};
use answer::Answer;
use gearbox::{GearboxPosition, LoadSharing, PlanetShare, ShaftLine, line_load, load_shares};
use minijinja::context;
use scene::gearbox::{Gearbox, GearboxPlanets, PlanetMesh};

use super::{branch, motion, norm, space::BoxInSpace, summary, vibration};
use crate::{
    ReportError,
    charts::{Curve, LineChart, embedded},
    contact_files::pattern_figure,
    how_exact::how_exact,
    page::{Cell, Content, Grid, Line, Page, Part, again, cost_part, counted, escaped, render},
    pair_files::rating,
};

/// The page of an answer about a gearbox.
///
/// # Errors
/// [`ReportError::Page`] if it cannot be filled; that would be a fault of this program.
pub(super) fn gearbox_page(file: &Gearbox, result: &GearboxResult, answer: &Answer) -> Result<Page, ReportError> {
    let strongest = result.positions.iter().flat_map(|p| &p.bearings).map(|b| norm(b.force)).fold(0.0, f64::max);
    let view = context! {
        view => embedded("gearbox", &BoxInSpace::new(file, result)),
        strongest => format!("{strongest:.0} N"),
    };
    let mut page = Page::of(
        answer,
        format!(
            "gearbox: {}, {} {}, {}, {}",
            counted(file.shafts.len(), "shaft"),
            file.meshes.len(),
            if file.meshes.len() == 1 { "mesh" } else { "meshes" },
            counted(file.bearings.len(), "bearing"),
            counted(result.positions.len(), "position")
        ),
    );
    page.push(Part::more().with(Content::Html(render("gearbox_view.html", view)?)));
    page.push(meshes(result));
    page.push(pairs(file, result));
    page.push(roots(file, result));
    planets(file, result).into_iter().for_each(|part| page.push(part));
    let rated = result.meshes.iter().filter_map(|m| Some((m.name.as_str(), m.rating.as_ref()?)));
    rated.flat_map(|(name, own)| rating::parts(own, Some(name))).for_each(|part| page.push(part));
    page.push(shafts(file, result));
    page.push(bearings(file, result));
    page.push(load_zones(result));
    page.push(bolts(file, result));
    page.push(outputs(result));
    page.push(patterns(result));
    result.accuracy.iter().flat_map(how_exact).for_each(|part| page.push(part));
    page.push(Part::new("Over the positions").figures(charts(file, result).iter().filter_map(LineChart::figure)));
    if let Some((asked, swings)) = file.vibration.as_ref().zip(result.vibration.as_ref()) {
        vibration::parts(file, asked, swings).into_iter().for_each(|part| page.push(part));
    }
    motion::parts(file, result, answer)?.into_iter().for_each(|part| page.push(part));
    branch::parts(file, result).into_iter().for_each(|part| page.push(part));
    page.push(Page::trust(answer).note(
        "Not in it: what the meshes of the gears, round shafts, linear bearings and rigid rings leave out. Gears are rigid \
         in their bores and sit on a section of the shaft.",
    ));
    page.push(cost_part(&answer.cost));
    let run = format!("ale-gear run {} --out DIR", file.file.display());
    page.push(again(&std::iter::once(run).chain(file.set.iter().cloned()).collect::<Vec<_>>().join(" ")));
    Ok(page)
}

fn meshes(result: &GearboxResult) -> Part {
    let head = ["mesh", "force N", "STE um", "p-p um", "f_in um", "f_across um", "K_Hbeta", "MPa"];
    let rows = result.meshes.iter().map(|m| {
        vec![
            Cell::text(&m.name),
            Cell::number(m.normal_force, 0),
            Cell::number(1e3 * m.transmission_error[0], 3),
            Cell::number(1e3 * m.transmission_error[1], 3),
            Cell::number(1e3 * m.misalignment[0], 2),
            Cell::number(1e3 * m.misalignment[1], 2),
            Cell::number(m.face_load_factor, 3),
            Cell::number(m.max_pressure, 0),
        ]
    });
    Part::new("Meshes").closing().grid(Grid::new(head).rows(rows)).note(
        "Mean normal force, mean and peak to peak of the static transmission error, largest pressure. Misalignment (f, in \
         and across the plane of action) is that by shafts, bearings and housing alone, over the face width, positive where \
         the gap opens as z grows. K_Hbeta is that of the solved load distribution.",
    )
}

/// How planets share the load, where there are some.
fn planets(file: &Gearbox, result: &GearboxResult) -> Option<Part> {
    let of_mesh = |((own, mesh), (sharing, tilts)): ((&GearboxPlanets, &PlanetMesh), (&LoadSharing, &Vec<f64>))| {
        let mean = |share: &PlanetShare| 100.0 * share.mean;
        let means = sharing.planets.iter().map(|share| crate::tables::fixed(mean(share), 2));
        vec![
            Cell::text(&mesh.name),
            Cell::count(own.angles.len()),
            Cell::count(means.collect::<Vec<_>>().join(", ")),
            Cell::number(sharing.factor, 4),
            Cell::number(Some(1e6 * tilts.iter().copied().fold(0.0, f64::max)), 1),
        ]
    };
    let rows = file.meshes_of_planets().zip(result.planets.iter().zip(&result.planet_tilts)).map(of_mesh);
    let head = ["mesh", "planets", "mean shares %", "K_gamma", "tilt µrad"];
    (!result.planets.is_empty()).then(|| {
        Part::new("Planets").closing().grid(Grid::new(head).rows(rows)).note(
            "Share of each planet in the normal forces of all. K_gamma: the largest share at any position over that of an \
             even load. Tilt: the largest angle of a planet's axis from its nominal direction.",
        )
    })
}

/// Root stress of every gear that a mesh knows it of, in all its meshes.
fn roots(file: &Gearbox, result: &GearboxResult) -> Part {
    let known = file.gears.iter().zip(&result.root_bending).filter_map(|(gear, own)| Some((gear, own.as_ref()?)));
    let rows: Vec<_> = known
        .flat_map(|(gear, both)| both.iter().map(move |own| (gear, own)))
        .map(|(gear, own)| {
            vec![
                Cell::text(&gear.name),
                Cell::text(own.side.name()),
                Cell::number(own.largest, 1),
                Cell::number(own.least, 1),
                Cell::number(own.range(), 1),
                Cell::number(own.ratio(), 3),
                Cell::number(own.error_percent, 1),
            ]
        })
        .collect();
    if rows.is_empty() {
        return Part::more();
    }
    let head = ["gear", "side", "largest MPa", "smallest MPa", "range MPa", "R", "error %"];
    Part::new("Tooth root stress").closing().grid(Grid::new(head).rows(rows)).note(
        "Largest tension in the fillets on each side of the teeth, and the smallest stress at its place, over all positions \
         and all meshes of the gear. R: smallest over largest stress.",
    )
}

fn pairs(file: &Gearbox, result: &GearboxResult) -> Part {
    let rows = result.meshes.iter().enumerate().map(|(i, m)| {
        let shaft = |gear: usize| file.shafts[file.gears[gear].shaft].name.as_str();
        let pair = &result.pairs[i];
        vec![
            Cell::text(&m.name),
            Cell::text(file.meshes[i].gears.map(shaft).join(", ")),
            Cell::text(format!("{} / {}", pair.pinion.teeth(), pair.wheel.teeth())),
            Cell::number(pair.total_contact_ratio(), 3),
            Cell::number(pair.centre_distance(), 3),
            Cell::count(m.slices),
        ]
    });
    Part::more()
        .grid(Grid::new(["mesh", "shafts", "teeth", "contact ratio", "centre distance mm", "slices"]).rows(rows))
}

fn shafts(file: &Gearbox, result: &GearboxResult) -> Part {
    let rows = file.shafts.iter().enumerate().map(|(i, s)| {
        let lines = || result.positions.iter().map(move |p| &p.shafts[i]);
        let bending = lines().flat_map(|line| &line.displacements).map(|u| u[0].hypot(u[1])).fold(0.0, f64::max);
        vec![
            Cell::text(&s.name),
            Cell::number(result.ratios_in_space[i], 5),
            Cell::number(1e3 * bending, 2),
            Cell::number(1e6 * lines().map(twist).fold(0.0, f64::max), 1),
        ]
    });
    let head = ["shaft", "rotations per input rotation", "largest bending um", "largest twist urad"];
    Part::new("Shafts").grid(Grid::new(head).rows(rows))
}

fn bearings(file: &Gearbox, result: &GearboxResult) -> Part {
    let rolls = result.bearings.iter().any(|b| b.rolling.is_some());
    let mut head = vec!["bearing", "shaft", "radial N", "F_x N", "F_y N", "F_z N", "tilt mrad"];
    if rolls {
        head.extend(["element N", "Hertz MPa", "S_0", "loaded", "k_x, k_y, k_z N/um"]);
    }
    let loses = result.bearings.iter().any(|b| loss(b).is_some());
    if loses {
        head.push("loss W");
    }
    let lasts = result.bearings.iter().any(|b| life(b).is_some());
    if lasts {
        head.extend(["P/C", "L10 h"]);
    }
    let is_modified = result.bearings.iter().any(|b| life(b).and_then(|own| own.modified_hours()).is_some());
    if is_modified {
        head.push("L10 modified h");
    }
    let under_spectrum = result.rates.spectrum && lasts;
    if under_spectrum {
        head.push("life under the load spectrum h");
    }
    let rows = result.bearings.iter().enumerate().map(|(i, b)| {
        let mut row = vec![
            Cell::text(&b.name),
            Cell::text(&file.shafts[file.bearings[i].shaft].name),
            Cell::number(b.force[0].hypot(b.force[1]), 0),
            Cell::number(b.force[0], 0),
            Cell::number(b.force[1], 0),
            Cell::number(b.force[2], 0),
            Cell::number(1e3 * b.tilt, 3),
        ];
        if rolls {
            let own = b.rolling.as_ref();
            let stiffness = own.map(|r| [0, 1, 2].map(|k| format!("{:.0}", 1e-3 * r.stiffness[k][k])).join(", "));
            row.extend([
                Cell::number(own.map(|r| r.element_force), 0),
                Cell::number(own.map(|r| r.pressure), 0),
                Cell::number(own.and_then(|r| r.static_safety), 1),
                Cell::count(own.map_or_else(|| "-".to_owned(), |r| format!("{}/{}", r.loaded[1], r.count))),
                Cell::count(stiffness.unwrap_or_else(|| "-".to_owned())),
            ]);
        }
        if loses {
            row.push(Cell::number(loss(b), 1));
        }
        if lasts {
            let own = life(b);
            row.extend([Cell::number(own.map(|own| own.over_rating), 3), Cell::number(own.map(|own| own.hours), 0)]);
        }
        if is_modified {
            row.push(Cell::number(life(b).and_then(|own| own.modified_hours()), 0));
        }
        if under_spectrum {
            row.push(Cell::number(b.rolling.as_ref().and_then(|own| own.spectrum_life_h), 0));
        }
        row
    });
    let notes = [
        (true, "Mean forces on the shafts, common axes."),
        (rolls, "S_0: static safety of ISO 76 from the pressure of the most loaded element."),
        (rolls && !lasts, "Lives need `[rating]` with `speed_rpm`."),
        (
            lasts,
            "L10: life after ISO/TS 16281 from the force of every rolling element, at 90 % reliability; P: radial load of the \
             same life, C: dynamic rating.",
        ),
        (is_modified, "Modified: with oil and dirt, ISO 281."),
    ];
    let note = notes.into_iter().filter_map(|(is_told, words)| is_told.then_some(words)).collect::<Vec<_>>().join(" ");
    Part::new("Bearings").closing().grid(Grid::new(head).rows(rows)).note(note)
}

/// Forces of the rolling elements of every bearing that has some.
fn load_zones(result: &GearboxResult) -> Part {
    let of_bearing = |b: &BearingLoad| -> Vec<Curve> {
        let zone = b.rolling.as_ref().map_or(&[][..], |own| &own.zone);
        let rows = zone.iter().map(|own| own.row + 1).max().unwrap_or(0);
        let of_row = |row: usize| {
            let label = if rows == 1 { b.name.clone() } else { format!("{}, row {}", b.name, row + 1) };
            let own = zone.iter().filter(|own| own.row == row).map(|own| (own.angle.to_degrees(), own.force));
            let points: Vec<(f64, f64)> = own.collect();
            // Element 0 stands at both ends.
            let end = points.first().map(|first| (first.0 + 360.0, first.1));
            Curve { label, points: points.into_iter().chain(end).collect() }
        };
        (0..rows).map(of_row).collect()
    };
    let curves: Vec<Curve> = result.bearings.iter().flat_map(of_bearing).collect();
    let angle = "angle from +x towards +y in deg";
    let chart = LineChart::new("Load zones", [angle, "mean force of a rolling element in N"], &curves, true);
    chart.and_then(|own| own.figure()).map_or_else(Part::more, |own| Part::more().figures([own]))
}

/// Forces of the bolts of every gear that has some.
fn bolts(file: &Gearbox, result: &GearboxResult) -> Part {
    let all = summary::bolts(file, result);
    if all.is_empty() {
        return Part::more();
    }
    let head = ["bolts of", "radial N from", "to", "tangential N", "axial N", "open"];
    let rows = all.iter().map(|own| {
        let force = |n: f64| Cell::text(format!("{n:.0}"));
        let forces =
            [own.min_radial_force_n, own.max_radial_force_n, own.max_tangential_force_n, own.max_axial_force_n];
        let [from, to, along, axial] = forces.map(force);
        let (open, of) = (own.max_open_bolts, own.mean_radial_forces_n.len());
        vec![Cell::text(own.gear), from, to, along, axial, Cell::text(format!("{open} of {of}"))]
    });
    let curve = |own: &summary::BoltsSummary<'_>| {
        let points = own.mean_radial_forces_n.iter().enumerate().map(|(i, force)| (i as f64 + 1.0, *force));
        Curve { label: own.gear.to_owned(), points: points.collect() }
    };
    let curves: Vec<Curve> = all.iter().map(curve).collect();
    let axes = ["number of the bolt, counter-clockwise", "mean force along the radius in N"];
    let chart = LineChart::new("Bolts", axes, &curves, true).and_then(|own| own.figure());
    let part = Part::new("Bolts").closing().grid(Grid::new(head).rows(rows));
    let part = part.note(
        "Radial: how hard a bolt presses the gear, preload included; below 0 it pulls. Open: lifted off at once.",
    );
    chart.map_or_else(|| part.clone(), |own| part.clone().figures([own]))
}

fn loss(bearing: &BearingLoad) -> Option<f64> {
    bearing.rolling.as_ref().and_then(|rolling| rolling.loss_w)
}

fn life(bearing: &BearingLoad) -> Option<BearingLife> {
    bearing.rolling.as_ref().and_then(|rolling| rolling.life)
}

/// Contact pattern of every mesh.
fn patterns(result: &GearboxResult) -> Part {
    let of = |mesh: &MeshResult| {
        let figure = pattern_figure(mesh.patterns.as_ref()?)?;
        Some([Content::Html(format!("<h3>{}</h3>", escaped(&mesh.name))), Content::Figures(vec![figure])])
    };
    let all = result.meshes.iter().filter_map(of).flatten();
    let part = all.fold(Part::new("Contact patterns"), Part::with);
    if part.contents.is_empty() {
        return part;
    }
    part.note(
        "Largest pressure over all positions on the driving flank of one tooth; grey: no contact line came there. Positions \
         are those of the first mesh: of a slower mesh they show a part of the engagement.",
    )
}

fn outputs(result: &GearboxResult) -> Part {
    let input = Line::number("mean torque on the input", 1e-3 * result.input_torque, 2, "N m");
    let outputs = result.outputs.iter().enumerate().map(|(i, o)| {
        let range = format!("urad, {} urad peak to peak", crate::tables::fixed(1e6 * o.peak_to_peak, 2));
        Line::number(format!("output {} lags by", i + 1), 1e6 * o.mean, 1, range)
    });
    let silent = result.bearings.iter().filter(|b| loss(b).is_none()).count();
    let without =
        if silent > 0 { format!(", without {silent} of {} bearings", result.bearings.len()) } else { String::new() };
    let unit = format!("% (sliding teeth, rolling bearings{without})");
    let efficiency = result.efficiency().map(|own| Line::number("efficiency", 100.0 * own, 3, unit));
    Part::new("Input and outputs").closing().lines(std::iter::once(input).chain(outputs).chain(efficiency))
}

/// Turn about its axis of one end of a shaft against the other, at most over all nodes, rad.
fn twist(line: &ShaftLine) -> f64 {
    let turns = || line.displacements.iter().map(|u| u[5]);
    turns().fold(f64::NEG_INFINITY, f64::max) - turns().fold(f64::INFINITY, f64::min)
}

/// Charts of a gearbox at rest: transmission errors, shares of planets, lags and bearing forces over the input's angle,
/// line loads over the width, bending of the shafts.
pub fn charts(file: &Gearbox, result: &GearboxResult) -> Vec<LineChart> {
    let over = |label: &str, of: &dyn Fn(&GearboxPosition) -> f64| Curve {
        label: label.to_owned(),
        points: result.positions.iter().map(|p| (p.input_angle.to_degrees(), of(p))).collect(),
    };
    let angle = "angle of the input [deg]";
    let ste = (result.meshes.iter().enumerate())
        .map(|(i, m)| over(&m.name, &|p| 1e3 * (p.meshes[i].transmission_error - m.transmission_error[0])));
    let force = |i: usize| move |p: &GearboxPosition| norm(p.bearings[i].force);
    let forces = (result.bearings.iter().enumerate()).map(|(i, b)| over(&b.name, &force(i)));
    let count = result.positions.len().max(1) as f64;
    let swings = (result.bearings.iter().enumerate()).map(|(i, b)| {
        let mean = result.positions.iter().map(force(i)).sum::<f64>() / count;
        over(&b.name, &|p| force(i)(p) - mean)
    });
    let lags = (result.outputs.iter().enumerate())
        .map(|(i, o)| over(&output(file, i), &|p| 1e6 * (p.output_lags[i] - o.mean)));
    let loads = (result.meshes.iter().enumerate())
        .map(|(i, m)| Curve { label: m.name.clone(), points: line_load(&result.positions, i) });
    let shares = file.meshes_of_planets().flat_map(|(own, mesh)| {
        let curve = move |n: usize| {
            let share = |p: &GearboxPosition| load_shares(p, &mesh.of_planets).map_or(0.0, |all| all[n]);
            let even = own.angles.len() as f64;
            over(&format!("{} {}", mesh.name, n + 1), &|p| even * share(p))
        };
        (0..own.angles.len()).map(curve)
    });
    let lines = (file.shafts.iter().enumerate()).map(|(i, s)| Curve { label: s.name.clone(), points: bent(result, i) });
    let all = [
        (
            "Transmission error of each mesh less its mean",
            angle,
            "STE less its mean [um]",
            ste.collect::<Vec<_>>(),
            false,
        ),
        (
            "Load of each planet over that of an even load",
            angle,
            "share times number of planets",
            shares.collect(),
            false,
        ),
        ("From input to output", angle, "lag less its mean [urad]", lags.collect(), false),
        ("Line load over the width", "height on gear 1 [mm]", "largest line load [N/mm]", loads.collect(), true),
        ("Forces of the bearings", angle, "force [N]", forces.collect(), true),
        ("Forces of the bearings less their means", angle, "force less its mean [N]", swings.collect(), false),
        ("Bending of the shafts, first position", "along the shaft [mm]", "off its axis [um]", lines.collect(), true),
    ];
    all.into_iter().filter_map(|(title, x, y, curves, zero)| LineChart::new(title, [x, y], &curves, zero)).collect()
}

fn output<'a>(file: &'a Gearbox, i: usize) -> Cow<'a, str> {
    let shaft = &file.shafts[file.torques[i].shaft].name;
    if file.torques.len() == 1 { Cow::Borrowed(shaft) } else { format!("{}: {shaft}", i + 1).into() }
}

fn bent(result: &GearboxResult, shaft: usize) -> Vec<(f64, f64)> {
    let Some(first) = result.positions.first() else { return Vec::new() };
    let line = &first.shafts[shaft];
    line.positions.iter().zip(&line.displacements).map(|(z, u)| (*z, 1e3 * u[0].hypot(u[1]))).collect()
}
