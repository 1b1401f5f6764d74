//! A run-up or run-down, mesh cycle by mesh cycle: the largest values and their speeds.

use answer::Remark;
use dynamics::Speed;
use serde::Serialize;
use study::{StudyError, cut_peak, cycle_statistics};

use super::{MotionSeries, Waterfall};
use crate::{motion::RPM, run_up::coarse_cut};

/// Mesh orders that are followed.
const ORDERS: usize = 8;

/// One mesh cycle of a ramp; units are in the names.
#[derive(Debug, Clone, PartialEq)]
pub struct RunUpCycle {
    /// Time at the middle of the mesh cycle, s.
    pub time_s: f64,
    /// Speed of the driver, 1/min.
    pub driver_speed_rpm: f64,
    /// Mesh frequency, Hz.
    pub mesh_frequency_hz: f64,
    /// Mean dynamic transmission error, um.
    pub mean_dte_um: f64,
    /// Peak to peak of the dynamic transmission error, um.
    pub peak_to_peak_dte_um: f64,
    /// Smallest sum of the normal forces on the driving flanks, N.
    pub min_normal_force_n: f64,
    /// Largest sum of the normal forces on the driving flanks, N.
    pub max_normal_force_n: f64,
    /// Largest normal force of one tooth pair, N.
    pub max_pair_normal_force_n: Option<f64>,
    /// Largest sum of normal forces divided by the mean quasi-static one.
    pub dynamic_factor: f64,
}

/// Amplitudes of the mesh orders over a section of a ramp.
#[derive(Debug, Clone, PartialEq)]
pub struct OrderCut {
    /// Time at the middle of the section, s.
    pub time_s: f64,
    /// Mean speed of the driver, 1/min.
    pub driver_speed_rpm: f64,
    /// Mean mesh frequency, Hz.
    pub mesh_frequency_hz: f64,
    /// Amplitudes of orders 1, 2, ..., um.
    pub amplitudes_um: Vec<f64>,
}

/// Results of a ramp over speed.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct RunUp {
    /// Results per mesh cycle.
    pub cycles: Vec<RunUpCycle>,
    /// Order cuts, per section of the waterfall.
    pub cuts: Vec<OrderCut>,
}

described::described! {
    /// The largest of a ramp, and where.
    #[derive(Debug, Clone, Copy, PartialEq, Serialize)]
    pub struct PeakOverSpeed {
        /// largest value, in the unit of the key
        pub value: f64,
        /// speed of the driver there, of a gearbox of its input
        pub driver_speed_rpm: f64,
        /// mesh frequency there
        pub mesh_frequency_hz: f64,
        /// time there
        pub time_s: f64,
    }
}

impl PeakOverSpeed {
    /// Text with speed and mesh frequency.
    pub fn place(&self) -> String {
        format!("at {:.1} rpm, {:.1} Hz", self.driver_speed_rpm, self.mesh_frequency_hz)
    }
}

described::described! {
    /// What a ramp is made for; units are in the names.
    #[derive(Debug, Clone, PartialEq, Serialize)]
    pub struct RunUpHeadline {
        /// largest peak to peak of the DTE of a mesh cycle
        pub peak_to_peak_dte_um: PeakOverSpeed,
        /// largest amplitude of each mesh harmonic of the DTE, of all stretches of the waterfall
        pub dte_harmonics_um: Vec<PeakOverSpeed>,
        /// largest sum of the normal forces on the driving flanks
        pub normal_force_n: PeakOverSpeed,
        /// largest normal force of one tooth pair; `null` where the model has no pairs
        pub pair_normal_force_n: Option<PeakOverSpeed>,
        /// largest dynamic factor of a mesh cycle
        pub dynamic_factor: Option<PeakOverSpeed>,
        /// mean over all mesh cycles of the peak to peak of the DTE
        pub mean_peak_to_peak_dte_um: f64,
    }
}

impl RunUp {
    /// Results from the series of a ramp with `per_cycle` values in each mesh cycle. `law` is the speed of the driver
    /// over time, `teeth` its number of teeth, `static_force` the reference of the dynamic factor, N.
    ///
    /// # Errors
    /// [`StudyError`] for series with entries that are not finite, and for series of different lengths.
    pub fn of(
        series: &MotionSeries,
        per_cycle: usize,
        (law, teeth): (Speed, u32),
        static_force: f64,
        waterfall: &Waterfall,
    ) -> Result<Self, StudyError> {
        let MotionSeries { time_s: time, dte_um: dte, normal_force_n: driving, .. } = series;
        series.check(&[time, driving], per_cycle)?;
        let teeth = f64::from(teeth);
        let one = |k: usize| {
            let part = k * per_cycle..(k + 1) * per_cycle;
            let highest = |of: &[f64]| of.get(part.clone()).unwrap_or_default().iter().fold(0.0, |m: f64, f| m.max(*f));
            let time_s = 0.5 * (time[part.start] + time[part.end - 1]);
            let driver_speed_rpm = law.at(time_s) / RPM;
            let of_dte = cycle_statistics(&dte[part.clone()], 1)?;
            let largest = highest(driving);
            Ok(RunUpCycle {
                time_s,
                driver_speed_rpm,
                mesh_frequency_hz: driver_speed_rpm * teeth / 60.0,
                mean_dte_um: of_dte.mean,
                peak_to_peak_dte_um: of_dte.peak_to_peak,
                min_normal_force_n: driving[part.clone()].iter().copied().fold(f64::INFINITY, f64::min),
                max_normal_force_n: largest,
                max_pair_normal_force_n: series.pair_normal_force_n.as_deref().map(highest),
                dynamic_factor: largest.max(highest(&series.coast_normal_force_n)) / static_force,
            })
        };
        let cycles = (0..dte.len() / per_cycle).map(one).collect::<Result<_, StudyError>>()?;
        let cuts = waterfall.lines.iter().map(|line| OrderCut {
            time_s: line.time,
            driver_speed_rpm: 60.0 * line.mesh_frequency_hz / teeth,
            mesh_frequency_hz: line.mesh_frequency_hz,
            amplitudes_um: (1..=ORDERS).filter_map(|n| line.first_at(n, waterfall.order_step)).collect(),
        });
        Ok(Self { cycles, cuts: cuts.collect() })
    }

    /// Remark on the order whose peak is largest, where few points of the waterfall lie across it; `cure`: what shows it
    /// better.
    pub(crate) fn coarse_cut(&self, cure: &str) -> Option<Remark> {
        let orders = self.cuts.iter().map(|c| c.amplitudes_um.len()).min().unwrap_or(0);
        let peak = |n: usize| {
            let cut: Vec<f64> = self.cuts.iter().map(|c| c.amplitudes_um[n]).collect();
            let peak = cut_peak(&cut)?;
            Some((n, peak, cut[peak.at]))
        };
        let (n, peak, _) = (0..orders).filter_map(peak).max_by(|a, b| a.2.total_cmp(&b.2))?;
        coarse_cut(peak, n + 1, self.cuts[peak.at].driver_speed_rpm, cure)
    }

    /// The largest values of all; `None` without a whole cycle.
    pub fn headline(&self) -> Option<RunUpHeadline> {
        let largest = |value: &dyn Fn(&RunUpCycle) -> f64| {
            self.cycles.iter().max_by(|a, b| value(a).total_cmp(&value(b))).map(|c| PeakOverSpeed {
                value: value(c),
                driver_speed_rpm: c.driver_speed_rpm,
                mesh_frequency_hz: c.mesh_frequency_hz,
                time_s: c.time_s,
            })
        };
        let orders = self.cuts.iter().map(|c| c.amplitudes_um.len()).min().unwrap_or(0);
        let of_order = |n: usize| {
            self.cuts.iter().max_by(|a, b| a.amplitudes_um[n].total_cmp(&b.amplitudes_um[n])).map(|c| PeakOverSpeed {
                value: c.amplitudes_um[n],
                driver_speed_rpm: c.driver_speed_rpm,
                mesh_frequency_hz: c.mesh_frequency_hz,
                time_s: c.time_s,
            })
        };
        let pairs = self.cycles.iter().all(|c| c.max_pair_normal_force_n.is_some());
        let sum: f64 = self.cycles.iter().map(|c| c.peak_to_peak_dte_um).sum();
        Some(RunUpHeadline {
            peak_to_peak_dte_um: largest(&|c| c.peak_to_peak_dte_um)?,
            dte_harmonics_um: (0..orders).filter_map(of_order).collect(),
            normal_force_n: largest(&|c| c.max_normal_force_n)?,
            pair_normal_force_n: largest(&|c| c.max_pair_normal_force_n.unwrap_or(0.0)).filter(|_| pairs),
            dynamic_factor: largest(&|c| c.dynamic_factor).filter(|l| l.value.is_finite()),
            mean_peak_to_peak_dte_um: sum / self.cycles.len() as f64,
        })
    }
}
