//! A measured flank in two parts: a smooth part, which gives the positions and curvatures of contact, and the remaining
//! deviation. Theory (26b).

use std::sync::{Arc, Mutex, PoisonError};

use super::flank_size::FlankSize;
use super::interpolation::Bicubic;

/// Standard deviation of the Gaussian that smooths a flank, over half of a usual band of contact.
const SMOOTHED: f64 = 3.0;
/// Beyond so many standard deviations the Gaussian is cut off.
const TAIL: f64 = 4.0;
/// Samples over a standard deviation along the profile and along the face; lines of the smooth part; lines of the mean
/// over the face width of a slice.
const SAMPLES: [f64; 2] = [8.0, 4.0];
const LINES: f64 = 2.0;
const LINES_A_SLICE: f64 = 4.0;
/// Lines of any grid at the most.
const MOST: usize = 2048;

/// Smooth part f_s of a grid of depths f and the deviation f - f_s from it.
///
/// ```text
/// f_s(x, z) = value at (x, z) of the plane fitted to f with weights exp(-((x' - x)^2 + (z' - z)^2) / (2 s^2))
/// x = r_b u^2/2: arc of the profile;   s = 3 m_n/30
/// ```
/// Taken over the flank from root form circle to tip and from end face to end face, by one direction after the other.
/// Planes stay as they are up to the edges of the flank.
#[derive(Debug)]
pub(super) struct Split {
    smooth: Bicubic,
    /// Deviation as slices of the width asked for see it: its mean along the contact line.
    averaged: Option<Bicubic>,
    /// Largest deviation either way, mm.
    largest: f64,
    rolls: [f64; 2],
    half_width: f64,
}

impl Split {
    /// Splits a grid on a flank. `slice` is the axial length over which deviations are averaged, mm; 0: no averaging.
    pub fn new(grid: &Bicubic, size: &FlankSize, slice: f64) -> Self {
        let deviation = SMOOTHED * size.band();
        let [form, tip] = size.roll.map(|u| 0.5 * size.base_radius * u * u);
        let half = size.half_width;
        let [own_x, own_z] = grid.lines();
        let count = |length: f64, step: f64, least: usize| {
            // Lengths of another size give as many lines.
            ((length / step * (1.0 - 1e-9)).ceil() as usize + 1).clamp(least.clamp(2, MOST), MOST)
        };
        let x = even([form, tip], count(tip - form, deviation / SAMPLES[0], own_x));
        let z = even([-half, half], count(2.0 * half, deviation / SAMPLES[1], own_z));
        let roll = |x: f64| (2.0 * x / size.base_radius).sqrt();
        let mut left: Vec<f64> = Vec::with_capacity(x.len() * z.len());
        for &x in &x {
            left.extend(z.iter().map(|&z| grid.at(roll(x), z)[0]));
        }
        let lines_x = even([form, tip], count(tip - form, deviation / LINES, 2));
        let lines_z = even([-half, half], count(2.0 * half, deviation / LINES, 2));
        let along: Vec<(usize, Vec<f64>)> = lines_x.iter().map(|&at| weights(&x, at, deviation)).collect();
        let across: Vec<(usize, Vec<f64>)> = lines_z.iter().map(|&at| weights(&z, at, deviation)).collect();
        let mut values = Vec::with_capacity(lines_x.len() * lines_z.len());
        let mut row = vec![0.0; z.len()];
        for (first, weights) in &along {
            row.fill(0.0);
            for (k, w) in weights.iter().enumerate() {
                let of = &left[(first + k) * z.len()..(first + k + 1) * z.len()];
                row.iter_mut().zip(of).for_each(|(sum, f)| *sum += w * f);
            }
            values.extend(
                across.iter().map(|(first, w)| -> f64 { w.iter().zip(&row[*first..]).map(|(w, f)| w * f).sum() }),
            );
        }
        let smooth = Bicubic::new(lines_x.iter().map(|&x| roll(x)).collect(), lines_z, values);
        for (x, row) in x.iter().zip(left.chunks_mut(z.len())) {
            row.iter_mut().zip(&z).for_each(|(f, &z)| *f -= smooth.at(roll(*x), z)[0]);
        }
        let largest = left.iter().fold(0.0, |most: f64, f| most.max(f.abs()));
        let averaged = (slice > 0.0).then(|| {
            let lines = even([-half, half], count(2.0 * half, slice / LINES_A_SLICE, 2));
            let samples = Samples { x: &x, z: &z, values: &left, size };
            let values = x.iter().flat_map(|&x| lines.iter().map(move |&z| [x, z]));
            let values = values.map(|[x, z]| samples.mean_along_line(x, roll(x), z, slice)).collect();
            Bicubic::new(x.iter().map(|&x| roll(x)).collect(), lines, values)
        });
        Self { smooth, averaged, largest, rolls: size.roll, half_width: half }
    }

    /// Smooth part of the depth (mm) and its derivatives by roll angle and height.
    pub fn smooth(&self, u: f64, z: f64) -> [f64; 3] {
        self.smooth.at(u, z)
    }

    /// Deviation of the grid from its smooth part, mm. Beyond an edge of the flank it is the deviation at that edge.
    pub fn deviation(&self, grid: &Bicubic, u: f64, z: f64) -> f64 {
        let (u, z) = (u.clamp(self.rolls[0], self.rolls[1]), z.clamp(-self.half_width, self.half_width));
        match &self.averaged {
            Some(averaged) => averaged.at(u, z)[0],
            None => grid.at(u, z)[0] - self.smooth.at(u, z)[0],
        }
    }

    /// Largest magnitude of the deviation, mm, as sampled.
    pub fn largest(&self) -> f64 {
        self.largest
    }
}

/// `count` evenly spaced values from one end to the other.
fn even([from, to]: [f64; 2], count: usize) -> Vec<f64> {
    (0..count).map(|i| from + (to - from) * i as f64 / (count - 1) as f64).collect()
}

/// First sample, and weights of the samples from it on, whose sum is the value at `at` of the straight line fitted with
/// Gaussian weights.
fn weights(samples: &[f64], at: f64, deviation: f64) -> (usize, Vec<f64>) {
    let reach = TAIL * deviation;
    let first = samples.partition_point(|s| *s < at - reach);
    let last = samples.partition_point(|s| *s <= at + reach);
    // A flank that is shorter than any smoothing still has two samples.
    let (first, last) = if last < first + 2 { (0, samples.len()) } else { (first, last) };
    let gauss = |s: f64| (-0.5 * ((s - at) / deviation).powi(2)).exp();
    let mut moments = [0.0; 3];
    for &s in &samples[first..last] {
        let (w, d) = (gauss(s), s - at);
        (moments[0], moments[1], moments[2]) = (moments[0] + w, moments[1] + w * d, moments[2] + w * d * d);
    }
    let [m0, m1, m2] = moments;
    let scale = 1.0 / (m0 * m2 - m1 * m1);
    let of = |&s: &f64| gauss(s) * (m2 - m1 * (s - at)) * scale;
    (first, samples[first..last].iter().map(of).collect())
}

/// Samples of the deviation over arc and height.
struct Samples<'a> {
    x: &'a [f64],
    z: &'a [f64],
    values: &'a [f64],
    size: &'a FlankSize,
}

impl Samples<'_> {
    /// Mean over an axial length about `z` along the contact line through (`u`, `z`): du = s k dz.
    fn mean_along_line(&self, x: f64, u: f64, z: f64, length: f64) -> f64 {
        let step = self.z[1] - self.z[0];
        let count = ((length / step * (1.0 - 1e-9)).ceil() as usize).max(1);
        let half = self.size.half_width;
        let mean = (0..count).map(|i| {
            let along = ((i as f64 + 0.5) / count as f64 - 0.5) * length;
            let at = (z + along).clamp(-half, half);
            let roll = u + self.size.roll_by_height * (at - z);
            let arc = if roll == u { x } else { 0.5 * self.size.base_radius * roll * roll.abs() };
            self.at(arc, at)
        });
        mean.sum::<f64>() / count as f64
    }

    /// Cubic along the profile, straight along the face.
    fn at(&self, x: f64, z: f64) -> f64 {
        let place = |axis: &[f64], at: f64| {
            let last = axis.len() - 1;
            let t = ((at - axis[0]) / (axis[last] - axis[0]) * last as f64).clamp(0.0, last as f64);
            let cell = (t as usize).min(last - 1);
            (cell, t - cell as f64)
        };
        let ((i, p), (j, q)) = (place(self.x, x), place(self.z, z));
        let last = self.x.len() - 1;
        let line = |k: usize| {
            let row = &self.values[k.min(last) * self.z.len()..];
            row[j] + q * (row[j + 1] - row[j])
        };
        let [a, b, c, d] = [line(i.saturating_sub(1)), line(i), line(i + 1), line(i + 2)];
        // Catmull and Rom.
        b + 0.5 * p * (c - a + p * (2.0 * a - 5.0 * b + 4.0 * c - d + p * (3.0 * (b - c) + d - a)))
    }
}

/// Splits of one grid by the length of a slice, made when they are first asked for.
#[derive(Debug, Default)]
pub(super) struct Splits(Mutex<Vec<(f64, Arc<Split>)>>);

impl Splits {
    /// The split for slices of axial length `slice`, mm.
    pub fn of(&self, grid: &Bicubic, size: &FlankSize, slice: f64) -> Arc<Split> {
        // An entry is whole or missing, whatever became of the thread that held the lock.
        let mut known = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, split)) = known.iter().find(|(length, _)| *length == slice) {
            return Arc::clone(split);
        }
        let split = Arc::new(Split::new(grid, size, slice));
        known.push((slice, Arc::clone(&split)));
        split
    }
}

/// They follow from the grid: equal grids have equal ones.
impl PartialEq for Splits {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl Clone for Splits {
    fn clone(&self) -> Self {
        Self::default()
    }
}
