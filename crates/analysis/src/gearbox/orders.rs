//! Orders of every mesh along a motion of a gearbox: what a run-up passes through.

use gearbox::motion::GearboxInstant;
use study::{StudyError, order_amplitude};

/// Orders of each mesh.
const ORDERS: usize = 5;
/// Cycles of the slowest mesh that a stretch is long, and least that there must be.
const STRETCH: f64 = 16.0;
const LEAST: f64 = 4.0;

/// Amplitudes at one order of one mesh over a stretch of the motion.
#[derive(Debug, Clone, PartialEq)]
pub struct MotionOrder {
    /// Middle of the stretch, s.
    pub time: f64,
    /// Mean speed of the input, rad/s about +z.
    pub speed: f64,
    /// Mesh whose order it is.
    pub mesh: usize,
    /// Order of its mesh frequency, from 1.
    pub order: usize,
    /// Frequency at the mean speed, Hz.
    pub frequency: f64,
    /// Dynamic transmission error of every mesh, mm.
    pub transmission_errors: Vec<f64>,
    /// Normal force of every mesh, N.
    pub mesh_forces: Vec<f64>,
    /// Force of every bearing, N: length of the amplitudes along x, y and z.
    pub bearing_forces: Vec<f64>,
}

/// Orders of all meshes, stretch by stretch, each half over the one before; none where the slowest mesh has gone through
/// fewer than four cycles.
///
/// Stretches are as long as sixteen cycles of the slowest mesh, or as the motion: lines that are less than two over a
/// stretch apart, counted in cycles of the same mesh, are not told from each other.
///
/// # Errors
/// [`StudyError`] for rows that hold what is no number.
pub(super) fn orders(rows: &[GearboxInstant]) -> Result<Vec<MotionOrder>, StudyError> {
    let (Some(first), Some(last)) = (rows.first(), rows.last()) else { return Ok(Vec::new()) };
    let gone = first.meshes.iter().zip(&last.meshes).map(|(a, b)| (b.cycles - a.cycles).abs());
    let slowest = gone.fold(f64::INFINITY, f64::min);
    if !(slowest >= LEAST && slowest.is_finite()) {
        return Ok(Vec::new());
    }
    // Rows of a ramp are as many a turn everywhere; those of a motion that a torque drives nearly so.
    let length = ((rows.len() as f64 * STRETCH / slowest).round() as usize).clamp(8, rows.len().max(8));
    let mut all = Vec::new();
    let mut from = 0;
    while from + length <= rows.len() {
        stretch(&rows[from..from + length], &mut all)?;
        from += (length / 2).max(1);
    }
    Ok(all)
}

fn stretch(rows: &[GearboxInstant], all: &mut Vec<MotionOrder>) -> Result<(), StudyError> {
    let (first, last) = (&rows[0], &rows[rows.len() - 1]);
    let span = last.time - first.time;
    let speed = (last.input[0] - first.input[0]) / span;
    let samples = |of: &dyn Fn(&GearboxInstant) -> f64| rows.iter().map(of).collect::<Vec<f64>>();
    for mesh in 0..first.meshes.len() {
        let places = samples(&|p| p.meshes[mesh].cycles);
        let cycles = (last.meshes[mesh].cycles - first.meshes[mesh].cycles).abs();
        for order in 1..=ORDERS {
            // Fewer than four rows a period show another line.
            if cycles * order as f64 * 4.0 > rows.len() as f64 {
                break;
            }
            let at = |of: &dyn Fn(&GearboxInstant) -> f64| order_amplitude(&samples(of), &places, order as f64);
            let meshes = 0..first.meshes.len();
            let errors = meshes.clone().map(|m| at(&|p| p.meshes[m].transmission_error));
            let forces = meshes.clone().map(|m| at(&|p| p.meshes[m].normal_force));
            let bearing = |b: usize| {
                let along = |axis: usize| at(&move |p| p.bearings[b].force[axis]);
                Ok(along(0)?.hypot(along(1)?).hypot(along(2)?))
            };
            all.push(MotionOrder {
                time: 0.5 * (first.time + last.time),
                speed,
                mesh,
                order,
                frequency: order as f64 * cycles / span,
                transmission_errors: errors.collect::<Result<_, _>>()?,
                mesh_forces: forces.collect::<Result<_, _>>()?,
                bearing_forces: (0..first.bearings.len()).map(bearing).collect::<Result<_, StudyError>>()?,
            });
        }
    }
    Ok(())
}
