//! Rows of a gearbox at rest and in motion as tables. Meshes, bearings and outputs are numbered from 1 in the order of
//! the file.

use std::{f64::consts::TAU, sync::Arc};

use analysis::{
    gearbox::{GearboxResult, MeshResult},
    results::{MAX_PRINCIPAL, MIN_PRINCIPAL, fillet_peaks},
};
use answer::{OfRow, RowColumn, RowStore, Table, TableError, Values};
use gearbox::{
    BearingState, BoltForce, GearboxPosition, ShaftLine, line_load, load_shares,
    motion::{GearboxInstant, MeshInstant},
    rolling_bearing::RollingState,
};
use scene::gearbox::Gearbox;
use study::Columns;

const PER_MINUTE: f64 = 60.0 / TAU;
const AXES: [&str; 3] = ["x", "y", "z"];

/// `positions`: one row a position.
pub fn positions(file: &Gearbox, rows: &[GearboxPosition]) -> Table {
    let mut table = Table::new("positions");
    let mut push = |name: String, meaning: &'static str, of: &dyn Fn(&GearboxPosition) -> f64| {
        table.push_numbers(name, meaning, rows.iter().map(of));
    };
    push("input_angle_deg".into(), "angle of the input", &|p| p.input_angle.to_degrees());
    push("input_torque_nm".into(), "torque that holds the input, about +z", &|p| 1e-3 * p.input_torque);
    for i in 0..file.torques.len() {
        let meaning = "lag of the output behind its nominal rotation: the transmission error from input to output";
        push(format!("output_{}_lag_urad", i + 1), meaning, &|p| 1e6 * p.output_lags[i]);
    }
    for i in 0..file.meshes.len() {
        let name = |what: &str| format!("mesh_{}_{what}", i + 1);
        push(name("cycles"), "mesh cycles since the start: whole ones and the phase", &|p| p.meshes[i].cycles);
        let meaning = "static transmission error from the rotations of both gears, positive when the driven gear lags";
        push(name("ste_um"), meaning, &|p| 1e3 * p.meshes[i].transmission_error);
        push(name("normal_force_n"), "sum of the normal forces", &|p| p.meshes[i].normal_force);
        let meaning = "misalignment of the wheel's axis against the pinion's in the plane of action, over the common face width, by shafts, bearings and housing; positive where the gap opens as z grows";
        push(name("misalignment_in_plane_um"), meaning, &|p| 1e3 * p.meshes[i].misalignment_in_plane);
        let meaning = "misalignment of the wheel's axis against the pinion's across the plane of action, over the common face width";
        push(name("misalignment_across_um"), meaning, &|p| 1e3 * p.meshes[i].misalignment_across);
        push(name("max_pressure_mpa"), "largest contact pressure", &|p| {
            p.meshes[i].slices.iter().map(|s| s.pressure).fold(0.0, f64::max)
        });
        let gears = ["pinion", "wheel"].into_iter().enumerate().filter(|_| file.meshes[i].scene.output.root_stress);
        for (end, gear) in gears {
            let meaning = "largest first principal stress (tension) in the root fillets of this gear by this mesh; with `root_stress = true` in its scene";
            push(name(&format!("{gear}_root_stress_max_principal_mpa")), meaning, &|p| {
                MAX_PRINCIPAL.stress(&fillet_peaks(&p.meshes[i].root_stress[end]), None)
            });
            let meaning = "smallest third principal stress (compression, negative) in these fillets";
            push(name(&format!("{gear}_root_stress_min_principal_mpa")), meaning, &|p| {
                MIN_PRINCIPAL.stress(&fillet_peaks(&p.meshes[i].root_stress[end]), None)
            });
        }
    }
    for (_, mesh) in file.meshes_of_planets() {
        for (n, i) in mesh.of_planets.iter().enumerate() {
            let meaning = "share of this planet's mesh in the normal forces of those of all planets; 0 without load";
            push(format!("mesh_{}_load_share", i + 1), meaning, &|p| {
                load_shares(p, &mesh.of_planets).map_or(0.0, |shares| shares[n])
            });
            let meaning = "angle of this planet's axis from its nominal direction at its gear in this mesh";
            push(format!("mesh_{}_planet_tilt_urad", i + 1), meaning, &|p| 1e6 * p.meshes[*i].tilt(mesh.planet));
        }
    }
    for i in 0..file.bearings.len() {
        bearing(i).for_each(|(name, meaning, of)| push(name, meaning, &|p| of(&p.bearings[i])));
        if file.bearings[i].rolling.is_some() {
            let of = |p: &GearboxPosition, what: fn(&RollingState) -> f64| p.rolling[i].as_ref().map_or(0.0, what);
            let name = |what: &str| format!("bearing_{}_{what}", i + 1);
            push(name("element_force_n"), "force on the most loaded rolling element", &|p| of(p, |s| s.element_force));
            push(name("hertz_pressure_mpa"), "contact pressure of the most loaded rolling element", &|p| {
                of(p, |s| s.pressure)
            });
            push(name("loaded_elements"), "number of loaded rolling elements", &|p| of(p, |s| s.loaded as f64));
        }
    }
    push("residual".into(), "unbalanced forces at the gears over the load", &|p| p.certificate.residual);
    let meaning = "sum of the forces, or moments, on a shaft over the largest of them";
    push("body_balance".into(), meaning, &|p| p.certificate.body_balance);
    table
}

/// Number of a bearing.
type OfBearing = OfRow<BearingState>;

/// Forces and moments of a bearing on its shaft: name, meaning, value.
fn bearing(i: usize) -> impl Iterator<Item = (String, &'static str, OfBearing)> {
    let force = move |(k, axis): (usize, &str)| {
        let of: OfBearing = Box::new(move |b| b.force[k]);
        (format!("bearing_{}_force_{axis}_n", i + 1), "force on the shaft", of)
    };
    let moment = move |(k, axis): (usize, &str)| {
        let of: OfBearing = Box::new(move |b| b.moment[k]);
        (format!("bearing_{}_moment_{axis}_nmm", i + 1), "moment on the shaft", of)
    };
    AXES.into_iter().enumerate().map(force).chain(AXES.into_iter().enumerate().map(moment))
}

/// `shafts`: one row a node of a shaft at a position.
pub fn shafts(file: &Gearbox, positions: &[GearboxPosition]) -> Table {
    let nodes = || {
        positions.iter().flat_map(|position| {
            let of_line = move |(i, line): (usize, &'_ ShaftLine)| (0..line.positions.len()).map(move |k| (i, k));
            position.shafts.iter().enumerate().flat_map(of_line).map(move |(i, k)| (position, i, k))
        })
    };
    let displacement = |axis: usize, unit: f64| {
        nodes().map(move |(p, i, k)| unit * p.shafts[i].displacements[k][axis]).collect::<Vec<f64>>()
    };
    Table::new("shafts")
        .numbers("input_angle_deg", "angle of the input", nodes().map(|(p, _, _)| p.input_angle.to_degrees()))
        .texts("shaft", "name of the shaft", nodes().map(|(_, i, _)| file.shafts[i].name.as_str()))
        .numbers("position_mm", "height of the node on its shaft", nodes().map(|(p, i, k)| p.shafts[i].positions[k]))
        .numbers("x_um", "displacement along x", displacement(0, 1e3))
        .numbers("y_um", "displacement along y", displacement(1, 1e3))
        .numbers("z_um", "displacement along z", displacement(2, 1e3))
        .numbers("turn_x_urad", "rotation about x", displacement(3, 1e6))
        .numbers("turn_y_urad", "rotation about y", displacement(4, 1e6))
        .numbers("turn_z_urad", "rotation about z", displacement(5, 1e6))
}

/// `bolts`: one row a bolt at a position.
pub fn bolts(file: &Gearbox, positions: &[GearboxPosition]) -> Table {
    let rows = || {
        positions.iter().flat_map(|position| {
            let of_gear = move |(i, bolts): (usize, &'_ Vec<BoltForce>)| (0..bolts.len()).map(move |k| (i, k));
            position.bolts.iter().enumerate().flat_map(of_gear).map(move |(i, k)| (position, i, k))
        })
    };
    let force = |of: fn(&BoltForce) -> f64| rows().map(move |(p, i, k)| of(&p.bolts[i][k])).collect::<Vec<f64>>();
    let meaning = "force that presses the gear along the radius, with `preload_n`; below 0 the bolt pulls, of bolts that open 0 where it has lifted off";
    Table::new("bolts")
        .numbers("input_angle_deg", "angle of the input", rows().map(|(p, _, _)| p.input_angle.to_degrees()))
        .texts("gear", "name of the gear", rows().map(|(_, i, _)| file.gears[i].name.as_str()))
        .numbers(
            "bolt",
            "number of the bolt, counter-clockwise from the first one, 1",
            rows().map(|row| row.2 as f64 + 1.0),
        )
        .numbers("radial_n", meaning, force(|own| own.radial))
        .numbers(
            "tangential_n",
            "force on the gear along the circumference, counter-clockwise",
            force(|own| own.tangential),
        )
        .numbers("axial_n", "force on the gear along z", force(|own| own.axial))
        .numbers(
            "is_open",
            "1 where a bolt that opens has lifted off, else 0",
            force(|own| f64::from(u8::from(own.open))),
        )
}

/// `line_load`: the largest line load that each height of a face sees.
pub fn line_loads(meshes: &[MeshResult], positions: &[GearboxPosition]) -> Table {
    let all: Vec<(&str, f64, f64)> = (meshes.iter().enumerate())
        .flat_map(|(i, mesh)| line_load(positions, i).into_iter().map(|(z, load)| (mesh.name.as_str(), z, load)))
        .collect();
    Table::new("line_load")
        .texts("mesh", "name of the mesh", all.iter().map(|row| row.0))
        .numbers("z_mm", "height on the pinion, from its mid-face", all.iter().map(|row| row.1))
        .numbers("line_load_n_per_mm", "largest line load that this height sees", all.iter().map(|row| row.2))
}

/// `motion`: one row an instant.
pub fn motion(file: &Gearbox, rows: &Arc<RowStore<GearboxInstant>>) -> Table {
    let mut columns = Vec::new();
    let mut push = |name: String, meaning: &'static str, of: OfRow<GearboxInstant>| {
        columns.push(RowColumn { name: name.into(), meaning: meaning.into(), of });
    };
    push("time_s".into(), "time since the start", Box::new(|p| p.time));
    push("input_angle_deg".into(), "angle of the input", Box::new(|p| p.input[0].to_degrees()));
    push("input_speed_rpm".into(), "speed of the input about +z", Box::new(|p| PER_MINUTE * p.input[1]));
    let meaning = "torque on the input about +z; with a given speed the torque that keeps it";
    push("input_torque_nm".into(), meaning, Box::new(|p| 1e-3 * p.input_torque));
    for i in 0..file.torques.len() {
        let of = move |p: &GearboxInstant| PER_MINUTE * p.output_speeds[i];
        push(format!("output_{}_speed_rpm", i + 1), "speed of the output", Box::new(of));
    }
    for i in 0..file.meshes.len() {
        let mut mesh = |what: &str, meaning: &'static str, of: fn(&MeshInstant) -> f64| {
            push(format!("mesh_{}_{what}", i + 1), meaning, Box::new(move |p| of(&p.meshes[i])));
        };
        mesh("cycles", "mesh cycles since the start: whole ones and the phase", |m| m.cycles);
        let meaning = "dynamic transmission error from the rotations of both gears";
        mesh("dte_um", meaning, |m| 1e3 * m.transmission_error);
        let meaning = "rate of the dynamic transmission error";
        mesh("dte_rate_um_per_s", meaning, |m| 1e3 * m.transmission_error_rate);
        let meaning = "sum of the normal forces on the driving flanks, damping included";
        mesh("normal_force_n", meaning, |m| m.normal_force);
        let meaning = "sum of the normal forces on the coast flanks, damping included";
        mesh("coast_normal_force_n", meaning, |m| m.coast_normal_force);
    }
    for i in 0..file.bearings.len() {
        bearing(i).for_each(|(name, meaning, of)| push(name, meaning, Box::new(move |p| of(&p.bearings[i]))));
    }
    Table::of_rows("motion", rows, columns)
}

/// The rows that a plan reads numbers off: of a motion, else of the positions at rest.
///
/// # Errors
/// [`TableError::Kept`] where rows cannot be read back.
pub fn history(file: &Gearbox, result: &GearboxResult) -> Result<Columns, TableError> {
    let table = match &result.motion {
        Some(own) => motion(file, &own.rows),
        None => positions(file, &result.positions),
    };
    let series = |column: answer::Column| match column.values {
        Values::Numbers(values) => Some((column.name.into_owned(), values)),
        Values::Texts(_) | Values::Kept(_) => None,
    };
    Ok(table.in_memory()?.columns.into_iter().filter_map(series).collect())
}

/// Names of the columns of [`history`], before anything is solved.
pub fn history_columns(file: &Gearbox) -> Vec<String> {
    let table = if file.motion.is_some() { motion(file, &Arc::default()) } else { positions(file, &[]) };
    table.columns.into_iter().map(|column| column.name.into_owned()).collect()
}
