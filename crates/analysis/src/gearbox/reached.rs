//! Extremes of the rows of a gearbox motion.

use answer::{RowStore, TableError};
use gearbox::motion::{GearboxInstant, MeshInstant};

use crate::{
    in_motion::BothFlanks,
    motion::{RPM, RunUpCycle},
    running::Running,
};

/// Round-off of the place of a row, mesh cycles: a row at the end of a cycle belongs to it.
const EDGE: f64 = 1e-9;

/// Smallest and largest value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Range {
    /// Smallest value.
    pub least: f64,
    /// Largest value.
    pub largest: f64,
}

impl Range {
    fn of(running: &Running) -> Self {
        Self { least: running.ends[0], largest: running.ends[1] }
    }

    /// Largest minus smallest value.
    pub fn span(self) -> f64 {
        self.largest - self.least
    }
}

/// Extremes of the rows of a motion.
#[derive(Debug, Clone, PartialEq)]
pub struct ReachedByRows {
    /// Meshes in their order.
    pub meshes: Vec<ReachedByMesh>,
    /// Radial force of each bearing in all rows, N.
    pub radial_force: Vec<Range>,
    /// Magnitude of the speed of the input in all rows, rad/s.
    pub input_speed: Range,
    /// Mean speed of the input in its initial sense, rad/s.
    pub mean_input_speed: f64,
    /// Cycles of the fastest mesh since the first row, row by row, positive in the direction of the motion.
    pub cycles: Vec<f64>,
    /// Whole cycles of each mesh, one after the other, for a speed ramp; otherwise empty.
    pub cycles_of_meshes: Vec<Vec<RunUpCycle>>,
}

/// Extremes of the rows of a motion at a mesh.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ReachedByMesh {
    /// Number of its cycles, in either direction.
    pub cycles: f64,
    /// Dynamic transmission error of all rows, um.
    pub dte_um: Range,
    /// Largest minus smallest transmission error of a mesh cycle (um), averaged over its whole cycles; for a speed ramp
    /// the largest of any cycle. If the motion has no whole cycle, it is over all rows.
    pub peak_to_peak_dte_um: f64,
    /// Normal force on the driving flanks in all rows, N.
    pub normal_force: Range,
    /// Largest normal force on the coast flanks, N.
    pub coast_normal_force: f64,
    /// Largest contact pressure, MPa; 0 for a mesh without slices.
    pub max_pressure: f64,
    /// Rows in which flanks on both sides press.
    pub(super) both: BothFlanks,
}

impl ReachedByRows {
    /// Of rows, with the frequencies of the meshes (Hz); `led`: of a speed that is led from one to another the mean normal
    /// force of each mesh at rest, N.
    pub(super) fn of(
        rows: &RowStore<GearboxInstant>,
        mesh_frequencies: &[f64],
        led: Option<&[f64]>,
    ) -> Result<Self, TableError> {
        let fastest = (0..mesh_frequencies.len()).max_by(|&a, &b| mesh_frequencies[a].total_cmp(&mesh_frequencies[b]));
        let mut cycles = Vec::with_capacity(rows.len());
        let (mut meshes, mut bearings): (Vec<MeshRows>, Vec<Running>) = Default::default();
        let [mut speed, mut signed] = [Running::default(); 2];
        rows.for_each(0..rows.len(), |row| {
            cycles.push(fastest.map_or(0.0, |mesh| row.meshes[mesh].cycles));
            speed.push(row.input[1].abs());
            signed.push(row.input[1]);
            for i in meshes.len()..row.meshes.len() {
                meshes.push(MeshRows { cycles: MeshCycles::new(led.map(|forces| forces[i])), ..MeshRows::default() });
            }
            bearings.resize(row.bearings.len(), Running::default());
            meshes.iter_mut().zip(&row.meshes).for_each(|(own, mesh)| own.push(row, mesh));
            for (radial, bearing) in bearings.iter_mut().zip(&row.bearings) {
                radial.push(bearing.force[0].hypot(bearing.force[1]));
            }
        })?;
        let (first, last) = (cycles.first().copied().unwrap_or(0.0), cycles.last().copied().unwrap_or(0.0));
        let sense = if last < first { -1.0 } else { 1.0 };
        cycles.iter_mut().for_each(|own| *own = sense * (*own - first));
        let sense = rows.get(0)?.map_or(1.0, |row| if row.input[1] < 0.0 { -1.0 } else { 1.0 });
        let (meshes, cycles_of_meshes) = meshes.into_iter().map(MeshRows::reached).unzip();
        Ok(Self {
            meshes,
            cycles_of_meshes,
            radial_force: bearings.iter().map(Range::of).collect(),
            input_speed: Range::of(&speed),
            mean_input_speed: sense * signed.mean(),
            cycles,
        })
    }
}

/// Rows of a mesh as they come.
#[derive(Default)]
struct MeshRows {
    dte: Running,
    cycles: MeshCycles,
    force: Running,
    coast: f64,
    pressure: f64,
    both: BothFlanks,
}

impl MeshRows {
    fn push(&mut self, row: &GearboxInstant, mesh: &MeshInstant) {
        self.dte.push(1e3 * mesh.transmission_error);
        self.cycles.push(row, mesh);
        self.force.push(mesh.normal_force);
        self.coast = self.coast.max(mesh.coast_normal_force);
        self.pressure = self.pressure.max(mesh.max_pressure);
        self.both.push([mesh.normal_force, mesh.coast_normal_force]);
    }

    /// With its whole cycles.
    fn reached(mut self) -> (ReachedByMesh, Vec<RunUpCycle>) {
        self.cycles.end();
        let dte_um = Range::of(&self.dte);
        let is_led = self.cycles.force_at_rest.is_some();
        let of_cycles = self.cycles.all.known().map(|of| if is_led { of.ends[1] } else { of.mean() });
        let reached = ReachedByMesh {
            cycles: self.cycles.gone,
            dte_um,
            peak_to_peak_dte_um: of_cycles.unwrap_or_else(|| dte_um.span()),
            normal_force: Range::of(&self.force),
            coast_normal_force: self.coast,
            max_pressure: self.pressure,
            both: self.both,
        };
        (reached, self.cycles.whole)
    }
}

/// A mesh cycle by cycle from the first row on, which is in none of them; a mesh that turns back goes on.
#[derive(Default)]
struct MeshCycles {
    /// Mean normal force at rest, N, where whole cycles are kept.
    force_at_rest: Option<f64>,
    /// Angle of the input and place of the mesh at the last row.
    at: Option<[f64; 2]>,
    /// Cycles gone through, and the angle by which the input has turned on the way.
    gone: f64,
    turned: f64,
    /// Number of the cycle that the last row is in.
    number: u64,
    now: CycleRows,
    /// Largest less least transmission error of whole cycles, um.
    all: Running,
    whole: Vec<RunUpCycle>,
}

/// Rows of one cycle: times, size of the speed of the input (rad/s), transmission error (um), normal forces on the driving
/// flanks and the largest on either side (N).
#[derive(Default)]
struct CycleRows {
    time: Running,
    speed: Running,
    dte: Running,
    force: Running,
    largest: f64,
}

impl MeshCycles {
    fn new(force_at_rest: Option<f64>) -> Self {
        Self { force_at_rest, ..Self::default() }
    }

    fn push(&mut self, row: &GearboxInstant, mesh: &MeshInstant) {
        let [angle, speed] = row.input;
        let Some([before, last]) = self.at.replace([angle, mesh.cycles]) else { return };
        self.gone += (mesh.cycles - last).abs();
        self.turned += (angle - before).abs();
        let number = (self.gone - EDGE).max(0.0) as u64;
        if number != self.number {
            self.close();
            self.number = number;
        }
        let now = &mut self.now;
        now.time.push(row.time);
        now.speed.push(speed.abs());
        now.dte.push(1e3 * mesh.transmission_error);
        now.force.push(mesh.normal_force);
        now.largest = now.largest.max(mesh.normal_force).max(mesh.coast_normal_force);
    }

    fn close(&mut self) {
        let CycleRows { time, speed, dte, force, largest } = std::mem::take(&mut self.now);
        let Some(dte) = dte.known() else { return };
        let peak_to_peak_dte_um = dte.ends[1] - dte.ends[0];
        self.all.push(peak_to_peak_dte_um);
        let Some(force_at_rest) = self.force_at_rest else { return };
        self.whole.push(RunUpCycle {
            time_s: 0.5 * (time.ends[0] + time.ends[1]),
            driver_speed_rpm: speed.mean() / RPM,
            mesh_frequency_hz: speed.mean() * self.gone / self.turned,
            mean_dte_um: dte.mean(),
            peak_to_peak_dte_um,
            min_normal_force_n: force.ends[0],
            max_normal_force_n: force.ends[1],
            max_pair_normal_force_n: None,
            dynamic_factor: largest / force_at_rest,
        });
    }

    /// The last cycle counts where it is whole.
    fn end(&mut self) {
        if self.gone + EDGE >= (self.number + 1) as f64 {
            self.close();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Peaks to peaks of cycles: the first row belongs to none, one at the end of a cycle to this one, a part of a cycle does
    /// not count, and a mesh that turns back goes on.
    #[test]
    fn peaks_to_peaks_are_those_of_whole_cycles() {
        let through = |rows: &[(f64, f64)]| {
            let mut all = MeshCycles::new(Some(50.0));
            for (i, &(cycles, dte)) in rows.iter().enumerate() {
                let mesh = MeshInstant {
                    cycles,
                    transmission_error: 1e-3 * dte,
                    transmission_error_rate: 0.0,
                    normal_force: 10.0 * dte,
                    coast_normal_force: 0.0,
                    max_pressure: 0.0,
                    wrench: [0.0; 12],
                };
                let input = [0.5 * cycles, 4.0];
                let (meshes, bearings, output_speeds) = (vec![mesh], Vec::new(), Vec::new());
                let time = 0.01 * i as f64;
                all.push(&GearboxInstant { time, input, input_torque: 0.0, output_speeds, meshes, bearings }, &mesh);
            }
            all.end();
            all
        };
        let round = |x: f64| (1e9 * x).round() * 1e-9;
        let of = |rows: &[(f64, f64)]| through(rows).all.known().map(|of| (round(of.mean()), round(of.ends[1])));
        let whole = [(0.25, 99.0), (0.75, 1.0), (1.25, 3.0), (1.75, 0.0), (2.25 + 1e-13, 6.0)];
        assert_eq!(of(&whole), Some((4.0, 6.0)));
        assert_eq!(of(&[&whole[..], &[(2.75, -50.0)]].concat()), Some((4.0, 6.0)), "half a cycle");
        assert_eq!(of(&whole[..2]), None, "no whole cycle");
        let back = [(0.0, 0.0), (0.5, 1.0), (0.0, 4.0), (-0.5, 2.0), (-1.0, 7.0)];
        assert_eq!(of(&back), Some((4.0, 5.0)));
        let found = through(&whole).whole;
        let last = found.last().unwrap();
        assert!(found.len() == 2 && (last.mesh_frequency_hz - 8.0).abs() < 1e-9, "{found:?}");
        assert!((last.time_s - 0.035).abs() < 1e-12 && (last.dynamic_factor - 1.2).abs() < 1e-12, "{found:?}");
    }
}
