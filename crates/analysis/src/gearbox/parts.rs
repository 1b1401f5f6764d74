//! Shafts, discs and bearings of a gearbox file in the form that the solver needs.

use fem::{
    Material,
    beam::{BeamPiece, BeamSection},
};
use gearbox::{Disc, GearboxError, Operation, Shaft, Structure, Torque, Train, motion::TorqueOverTime};
use geometry::Sense;
use nalgebra::DMatrix;
use scene::gearbox::Gearbox;

use super::bearings::bearings;
use crate::motion::torque;

/// All parts. Discs are the gears, the input and the torques, in this order.
pub(super) fn structure(file: &Gearbox) -> Result<Structure, GearboxError> {
    let mut shafts = Vec::with_capacity(file.shafts.len());
    for own in &file.shafts {
        let named = |source| GearboxError::Shaft { shaft: own.name.clone(), source };
        let material = Material::new(own.young_mpa, own.poisson, own.density).map_err(named)?;
        let mut pieces = Vec::with_capacity(own.sections.len());
        for section in &own.sections {
            let round = BeamSection::new(section.outer, section.inner, material).map_err(named)?;
            pieces.push(BeamPiece { length: section.length, section: round });
        }
        // Elements are exact at rest; shorter ones draw the line of the shaft, and its inertia.
        let length: f64 = own.sections.iter().map(|s| s.length).sum();
        let longest_element = length / f64::from(file.shaft_elements);
        shafts.push(Shaft { name: own.name.clone(), origin: own.origin, pieces, longest_element });
    }
    let mut discs: Vec<Disc> =
        file.gears.iter().map(|g| Disc::seat(&g.name, g.shaft, g.position).seated_at(g.seat)).collect();
    discs.push(Disc::seat("the input", file.input.shaft, file.input.position));
    let torque =
        |(i, t): (usize, &scene::gearbox::GearboxTorque)| Disc::seat(format!("torque {}", i + 1), t.shaft, t.position);
    discs.extend(file.torques.iter().enumerate().map(torque));
    let bearings = bearings(file)?;
    // Bearings in other shafts have no seat in the housing.
    let housed = || (0..bearings.len()).filter(|i| bearings[*i].outer.is_none()).enumerate();
    let housing = file.housing.as_ref().map(|rows| {
        let mut all = DMatrix::zeros(6 * bearings.len(), 6 * bearings.len());
        for ((i, a), (j, b)) in housed().flat_map(|x| housed().map(move |y| (x, y))) {
            let own = nalgebra::Matrix6::from_fn(|k, m| rows[6 * i + k][6 * j + m]);
            all.fixed_view_mut::<6, 6>(6 * a, 6 * b).copy_from(&own);
        }
        all
    });
    let standing = file.shafts.iter().enumerate().filter(|(_, s)| s.stands).map(|(i, _)| i).collect();
    let fixed = file.fixed_shaft();
    Ok(Structure { shafts, discs, bearings, housing, standing, fixed, ..Structure::default() })
}

/// Disc of the input, its sense, and the keys of all discs.
pub(super) fn input(file: &Gearbox) -> (usize, Sense, Vec<f64>) {
    let sense = file.input.rotation;
    let mut keys: Vec<f64> = file.gears.iter().map(|g| g.key).collect();
    keys.resize(file.gears.len() + 1 + file.torques.len(), 0.0);
    (file.gears.len(), sense, keys)
}

/// Torques that change with time: number among those of the operation, and law, N mm about +z.
pub(super) fn over_time(file: &Gearbox, operation: &Operation) -> Vec<(usize, TorqueOverTime)> {
    let all = file.torques.iter().zip(&operation.torques).enumerate();
    let law = |(i, (own, about)): (usize, (&scene::gearbox::GearboxTorque, &Torque))| {
        let stated = own.over_time.as_ref()?;
        Some((i, torque(stated, own.torque).scaled(about.torque.signum())))
    };
    all.filter_map(law).collect()
}

/// Torque on the input over time, N mm about +z, beside a mean (N mm in the sense of the input); `None` where it is constant.
pub(super) fn input_over_time(file: &Gearbox, mean: f64) -> Option<TorqueOverTime> {
    let stated = file.input.over_time.as_ref()?;
    Some(torque(stated, mean).scaled(file.input.rotation.sign() as f64))
}

/// Loads against the rotation of their shafts.
pub(super) fn operation(file: &Gearbox, train: &Train) -> Operation {
    let (input, sense, keys) = input(file);
    let load = |(i, t): (usize, &scene::gearbox::GearboxTorque)| {
        let turns = train.ratios_in_space()[t.shaft] * sense.sign() as f64;
        // 0.0 first: no torque is +0 and not -0.
        Torque { disc: input + 1 + i, torque: 0.0 - turns.signum() * t.torque }
    };
    let torques = file.torques.iter().enumerate().map(load).collect();
    let held = file.shafts.iter().enumerate().filter(|(_, s)| s.held).map(|(i, _)| i).collect();
    Operation { input, sense, torques, keys, held }
}
