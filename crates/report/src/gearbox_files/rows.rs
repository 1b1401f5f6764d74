//! Rows of a gearbox as files with commas.

use analysis::gearbox_at_rest::GearboxResult;
use gearbox::{GearboxPosition, line_load, rolling_bearing::RollingState};
use scene::gearbox::Gearbox;

use crate::csv::{push_number, push_row, quoted};

/// A column: its name, and its value at a position.
type Column = (String, Box<dyn Fn(&GearboxPosition) -> f64>);

/// Columns of `positions.csv`. Meshes, bearings and outputs are numbered from 1 in the order of the file.
fn columns(file: &Gearbox) -> Vec<Column> {
    let mut all: Vec<Column> = vec![
        ("input_angle_deg".into(), Box::new(|p| p.input_angle.to_degrees())),
        ("input_torque_nm".into(), Box::new(|p| 1e-3 * p.input_torque)),
    ];
    let mut push = |name: String, of: Box<dyn Fn(&GearboxPosition) -> f64>| all.push((name, of));
    for i in 0..file.torques.len() {
        push(format!("output_{}_lag_urad", i + 1), Box::new(move |p| 1e6 * p.output_lags[i]));
    }
    for i in 0..file.meshes.len() {
        let name = |what: &str| format!("mesh_{}_{what}", i + 1);
        push(name("cycles"), Box::new(move |p| p.meshes[i].cycles));
        push(name("ste_um"), Box::new(move |p| 1e3 * p.meshes[i].transmission_error));
        push(name("normal_force_n"), Box::new(move |p| p.meshes[i].normal_force));
        push(name("misalignment_in_plane_um"), Box::new(move |p| 1e3 * p.meshes[i].misalignment_in_plane));
        push(name("misalignment_across_um"), Box::new(move |p| 1e3 * p.meshes[i].misalignment_across));
        push(
            name("max_pressure_mpa"),
            Box::new(move |p| p.meshes[i].slices.iter().map(|s| s.pressure).fold(0.0, f64::max)),
        );
    }
    for i in 0..file.bearings.len() {
        for (k, axis) in ["x", "y", "z"].into_iter().enumerate() {
            push(format!("bearing_{}_force_{axis}_n", i + 1), Box::new(move |p| p.bearings[i].force[k]));
        }
        for (k, axis) in ["x", "y", "z"].into_iter().enumerate() {
            push(format!("bearing_{}_moment_{axis}_nmm", i + 1), Box::new(move |p| p.bearings[i].moment[k]));
        }
        if file.bearings[i].rolling.is_some() {
            let of = move |p: &GearboxPosition, what: fn(&RollingState) -> f64| p.rolling[i].as_ref().map_or(0.0, what);
            let name = |what: &str| format!("bearing_{}_{what}", i + 1);
            push(name("element_force_n"), Box::new(move |p| of(p, |s| s.element_force)));
            push(name("hertz_pressure_mpa"), Box::new(move |p| of(p, |s| s.pressure)));
            push(name("loaded_elements"), Box::new(move |p| of(p, |s| s.loaded as f64)));
        }
    }
    push("residual".into(), Box::new(|p| p.certificate.residual));
    push("body_balance".into(), Box::new(|p| p.certificate.body_balance));
    all
}

/// `positions.csv`: one row a position.
pub(super) fn positions(file: &Gearbox, result: &GearboxResult) -> String {
    let columns = columns(file);
    let mut csv = columns.iter().map(|(name, _)| name.as_str()).collect::<Vec<_>>().join(",") + "\n";
    for position in &result.positions {
        push_row(&mut csv, columns.iter().map(|(_, of)| of(position)));
    }
    csv
}

/// `shafts.csv`: one row a node of a shaft at a position.
pub(super) fn shafts(file: &Gearbox, result: &GearboxResult) -> String {
    let mut csv = "input_angle_deg,shaft,position_mm,x_um,y_um,z_um,turn_x_urad,turn_y_urad,turn_z_urad\n".to_owned();
    for position in &result.positions {
        for (shaft, line) in file.shafts.iter().zip(&position.shafts) {
            for (z, own) in line.positions.iter().zip(&line.displacements) {
                push_number(&mut csv, position.input_angle.to_degrees());
                csv.push(',');
                csv.push_str(&quoted(&shaft.name));
                csv.push(',');
                let units = [1e3, 1e3, 1e3, 1e6, 1e6, 1e6];
                push_row(&mut csv, [*z].into_iter().chain(own.iter().zip(units).map(|(x, unit)| unit * x)));
            }
        }
    }
    csv
}

/// `line_load.csv`: the largest line load that each height of a face sees.
pub(super) fn line_loads(result: &GearboxResult) -> String {
    let mut csv = "mesh,z_mm,line_load_n_per_mm\n".to_owned();
    for (i, mesh) in result.meshes.iter().enumerate() {
        for (z, load) in line_load(&result.positions, i) {
            csv.push_str(&quoted(&mesh.name));
            csv.push(',');
            push_row(&mut csv, [z, load]);
        }
    }
    csv
}
