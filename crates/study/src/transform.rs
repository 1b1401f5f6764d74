//! The only call of the FFT library.

use realfft::{RealFftPlanner, num_complex::Complex};

/// X_k = sum_j x_j exp(-2 pi i j k / n), k = 0 .. n/2; `None` for no samples.
pub(crate) fn real_transform(mut samples: Vec<f64>) -> Option<Vec<Complex<f64>>> {
    if samples.is_empty() {
        return None;
    }
    let plan = RealFftPlanner::<f64>::new().plan_fft_forward(samples.len());
    let mut spectrum = plan.make_output_vec();
    // The lengths come from the plan itself, the only thing that `process` can complain about.
    plan.process(&mut samples, &mut spectrum).ok().map(|()| spectrum)
}
