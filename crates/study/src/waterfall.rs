//! Spectra of a record, and a waterfall of spectra of a record with changing speed.

use crate::{StudyError, Window, spectrum as record_spectrum};

/// Spectral lines of a record; line 0 is the mean.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct MotionSpectrum {
    /// Orders relative to the mesh frequency.
    pub orders: Vec<f64>,
    /// Frequencies, Hz.
    pub frequencies: Vec<f64>,
    /// Amplitudes, one list per quantity.
    pub amplitudes: Vec<Vec<f64>>,
}

impl MotionSpectrum {
    /// Spectra of a whole record of `cycles` mesh cycles. A quantity is a list of components; its amplitude is the norm
    /// of their amplitudes.
    ///
    /// # Errors
    /// [`StudyError`] for a record with a value that is not a finite number.
    pub fn of(
        quantities: &[Vec<&[f64]>],
        (cycles, mesh_frequency_hz): (f64, f64),
        window: Window,
    ) -> Result<Self, StudyError> {
        let amplitudes = quantities.iter().map(|own| of_vector(own, window)).collect::<Result<Vec<_>, _>>()?;
        let lines = amplitudes.first().map_or(0, Vec::len);
        let orders: Vec<f64> = (0..lines).map(|k| k as f64 / cycles).collect();
        Ok(Self { frequencies: orders.iter().map(|o| o * mesh_frequency_hz).collect(), orders, amplitudes })
    }
}

/// Amplitudes of a vector by those of its components.
fn of_vector(components: &[&[f64]], window: Window) -> Result<Vec<f64>, StudyError> {
    let mut all = components.iter().map(|own| amplitudes(own, window));
    let first = all.next().unwrap_or_else(|| Ok(Vec::new()))?;
    all.try_fold(first, |sum, own| Ok(sum.iter().zip(own?).map(|(a, b)| a.hypot(b)).collect()))
}

/// Amplitudes at 0 (the mean), 1, 2, ... periods a record.
fn amplitudes(samples: &[f64], window: Window) -> Result<Vec<f64>, StudyError> {
    let mut of = record_spectrum(samples, samples.len() as f64, window)?;
    if let Some(first) = of.amplitudes.first_mut() {
        *first = of.mean.abs();
    }
    Ok(of.amplitudes)
}

/// Order spectra of a motion with changing speed.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Waterfall {
    /// Distance between spectral lines, in mesh orders.
    pub order_step: f64,
    /// Spectra, one per section of the record.
    pub lines: Vec<WaterfallLine>,
}

/// One spectrum of a waterfall.
#[derive(Debug, Clone, PartialEq)]
pub struct WaterfallLine {
    /// Time at the middle of the section, s.
    pub time: f64,
    /// Mean speed of the reference shaft of the record, 1/min.
    pub speed_rpm: f64,
    /// Mean mesh frequency, Hz.
    pub mesh_frequency_hz: f64,
    /// Amplitudes, one list per quantity, at multiples of the order step, starting with 0.
    pub amplitudes: Vec<Vec<f64>>,
}

impl WaterfallLine {
    /// Amplitude of the first quantity at a mesh order, if the spectrum contains this order.
    pub fn first_at(&self, order: usize, order_step: f64) -> Option<f64> {
        self.amplitudes.first()?.get((order as f64 / order_step).round() as usize).copied()
    }
}

/// Sections of a record, each with its own spectrum, measured in values.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stretches {
    /// Number of values in a section.
    pub length: usize,
    /// Number of values from the beginning of a section to that of the next.
    pub hop: usize,
    /// Number of values per mesh cycle.
    pub per_cycle: f64,
    /// Mesh cycles per rotation of the reference shaft.
    pub cycles_per_turn: f64,
}

impl Stretches {
    /// Sections of a number of whole mesh cycles in a record of `values`; each overlaps the preceding one by half.
    pub fn of_cycles(values: usize, (per_cycle, cycles): (usize, usize), teeth: u32) -> Self {
        let length = per_cycle * cycles.max(1).min((values / per_cycle.max(1)).max(1));
        let hop = (length / 2 / per_cycle.max(1)).max(1) * per_cycle;
        Self { length, hop, per_cycle: per_cycle as f64, cycles_per_turn: f64::from(teeth) }
    }
}

/// Order spectra with a Hann window over sections of a record. The values are evenly spaced in each mesh cycle or over
/// the rotation, so orders stay in their bins while the speed changes.
///
/// A quantity is a list of components; its amplitude is the norm of their amplitudes. `at` has the times (s) and speeds
/// (1/min) of the values.
///
/// # Errors
/// [`StudyError`] for a record with a value that is not a finite number, for lists of different lengths, and for
/// sections without values.
pub fn waterfall(
    quantities: &[Vec<&[f64]>],
    (time, speed): (&[f64], &[f64]),
    stretches: Stretches,
) -> Result<Waterfall, StudyError> {
    let Stretches { length, hop, per_cycle, cycles_per_turn } = stretches;
    let wanted = time.len();
    let lists = quantities.iter().flatten().map(|list| list.len()).chain([speed.len()]);
    if let Some(found) = lists.into_iter().find(|found| *found != wanted) {
        return Err(StudyError::Lengths { found, wanted });
    }
    if length == 0 || hop == 0 {
        return Err(StudyError::NotPositive { quantity: "values in a mesh cycle", value: per_cycle });
    }
    let line = |from: usize| {
        let part = from..from + length;
        let speed_rpm = speed[part.clone()].iter().sum::<f64>().abs() / length as f64;
        let of_quantity = |components: &Vec<&[f64]>| {
            let own: Vec<&[f64]> = components.iter().map(|own| &own[part.clone()]).collect();
            of_vector(&own, Window::Hann)
        };
        Ok(WaterfallLine {
            time: 0.5 * (time[from] + time[from + length - 1]),
            speed_rpm,
            mesh_frequency_hz: speed_rpm * cycles_per_turn / 60.0,
            amplitudes: quantities.iter().map(of_quantity).collect::<Result<_, _>>()?,
        })
    };
    let starts = (0..).map(|k| k * hop).take_while(|from| from + length <= wanted);
    Ok(Waterfall { order_step: per_cycle / length as f64, lines: starts.map(line).collect::<Result<_, StudyError>>()? })
}
