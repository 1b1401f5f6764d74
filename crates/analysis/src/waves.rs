//! Waves on measured flanks that are shorter than the contact band. Theory (26a).

use crate::remark;
use answer::Remark;
use std::f64::consts::{PI, TAU};

use contact::Method;
use geometry::{FlankModification, Gear, GearModifications, GearPair, Side, modification::TopographyGrid};
use ltca::StaticOptions;

use crate::loaded_pair::LoadedPair;
use crate::nominal_pressure::{PointPressure, nominal_pressure};

/// k a from which on a wave is short beside a band: J_0(k a) is 0.94 there.
const RESOLVED: f64 = 0.5;
/// Change of the relative curvature by shorter waves, root mean square, up to which nobody has to hear of them.
const NOTICED: f64 = 0.01;
/// Places along the profile between two lines of a grid, and how many there are at the least and at the most.
const PER_LINE: usize = 16;
const PLACES: [usize; 2] = [256, 2048];
/// Lines along the face that are looked at.
const HEIGHTS: usize = 9;

/// What a user should hear of topographies under the load of a scene: where contact is made of slices, one remark for each
/// flank that bears waves shorter than its contact band.
pub(crate) fn short_waves(loaded: &LoadedPair<'_>, options: &StaticOptions) -> Vec<Remark> {
    if options.contact.method != Method::Slice || options.torque == 0.0 {
        return Vec::new();
    }
    let nominal = nominal_pressure(loaded);
    // p = 2 w / (pi a), at the point of the path whose band is widest.
    let of = |p: &PointPressure| 2.0 * nominal.normal_force_n / (p.line_length_mm * PI * p.pressure_mpa);
    let widest = nominal.hertz.iter().map(of).filter(|a| a.is_finite()).fold(0.0, f64::max);
    let sides = [(options.side(), true), (options.side().opposite(), options.contact.both_flanks)];
    let touching = sides.into_iter().filter(|(_, touches)| *touches).map(|(side, _)| side);
    touching.flat_map(|side| waves_on(loaded.pair, side, widest, loaded.effective_modulus())).collect()
}

/// What is said of the flanks on `side` beside a band of half-width a (mm), of materials with E* (MPa).
pub(crate) fn waves_on(pair: &GearPair, side: Side, half_width: f64, modulus: f64) -> Vec<Remark> {
    if half_width <= 0.0 {
        return Vec::new();
    }
    let radius = relative_radius(pair);
    let gears = [("pinion", &pair.pinion), ("wheel", &pair.wheel)];
    let said = gears.into_iter().filter_map(|(whose, gear)| {
        let waves = Waves::of(gear, side, RESOLVED / half_width)?;
        if waves.curvature * radius <= NOTICED {
            return None;
        }
        let (k, flank) = (waves.wave_number, side.name());
        Some(remark::short_waves(
            whose,
            flank,
            100.0 * waves.share,
            1e3 * waves.whole,
            TAU * half_width / RESOLVED,
            RESOLVED,
            half_width,
            k,
            k * half_width,
            TAU / k,
            0.5 * modulus * waves.slope,
        ))
    });
    said.collect()
}

/// rho_n at the pitch point, mm: xi (T - xi)/(T cos b_b).
fn relative_radius(pair: &GearPair) -> f64 {
    let (xi, whole) = (pair.pinion.base_radius() * pair.working_pressure_angle().tan(), pair.tangent_length());
    xi * (whole - xi) / (whole * pair.base_helix_angle().cos())
}

/// What a grid holds beyond a wave number.
struct Waves {
    /// Root mean square of the deviation without its parabola, mm.
    whole: f64,
    /// Share of that beyond the wave number, by root mean squares.
    share: f64,
    /// Wave number of the largest wave beyond it, rad/mm.
    wave_number: f64,
    /// Root mean square of slope and curvature (1/mm) beyond it.
    slope: f64,
    curvature: f64,
}

impl Waves {
    /// Waves of the topography alone of the flanks on one side, along their profiles at some heights; of the teeth with flanks
    /// of their own the one with the largest curvature. `None` without one.
    fn of(gear: &Gear, side: Side, beyond: f64) -> Option<Self> {
        let topography = gear.modifications().on(side).topography.as_ref()?;
        let all = topography.grids().iter().filter_map(|grid| Self::of_grid(gear, side, grid, beyond));
        all.max_by(|a, b| a.curvature.total_cmp(&b.curvature))
    }

    /// Waves of one grid.
    ///
    /// ```text
    /// x = r_b u^2/2,   f(x) - parabola, Hann window,   F_j,   k_j = 2 pi j/l
    /// ```
    /// A sinusoid of slope k A pressed flat adds E* k A/2 to the pressure (Westergaard).
    fn of_grid(gear: &Gear, side: Side, grid: &TopographyGrid, beyond: f64) -> Option<Self> {
        let lines = grid.depths().len() / grid.heights().len().max(1);
        let places = (PER_LINE * lines).clamp(PLACES[0], PLACES[1]);
        let alone = FlankModification { topography: Some(grid.clone().into()), ..FlankModification::default() };
        let bare = gear.clone().with_modifications(GearModifications::both(alone)).ok()?;
        let (base, profile) = (gear.base_radius(), gear.profile());
        let [from, to] = [profile.roll_form(), profile.roll_tip()].map(|u| 0.5 * base * u * u);
        let step = (to - from) / places as f64;
        let [mut whole, mut high, mut steep, mut bent] = [0.0; 4];
        let mut powers = vec![0.0; places / 2];
        for line in 0..HEIGHTS {
            let z = gear.face_width() * ((line as f64 + 0.5) / HEIGHTS as f64 - 0.5);
            let depth = |i: usize| {
                let u = (2.0 * (from + step * (i as f64 + 0.5)) / base).sqrt();
                bare.depth(side, 0, u, z).value
            };
            let mut values: Vec<f64> = (0..places).map(depth).collect();
            take_parabola_off(&mut values);
            // A window whose mean square is 1.
            let window = |i: usize| (2.0f64 / 3.0).sqrt() * (1.0 - (TAU * i as f64 / places as f64).cos());
            values.iter_mut().enumerate().for_each(|(i, x)| *x *= window(i));
            let lines = study::mesh_harmonics(&values, 1, places / 2 - 1).ok()?;
            powers.iter_mut().skip(1).zip(lines).for_each(|(power, line)| *power += 0.5 * line.amplitude.powi(2));
        }
        let wave_number = |j: usize| TAU * j as f64 / (to - from);
        let mut largest = (0.0, 0);
        for (j, power) in powers.iter().enumerate() {
            whole += power;
            let k = wave_number(j);
            if k > beyond {
                high += power;
                steep += power * k * k;
                bent += power * k.powi(4);
                if power * k.powi(4) > largest.0 {
                    largest = (power * k.powi(4), j);
                }
            }
        }
        let mean = |sum: f64| (sum / HEIGHTS as f64).sqrt();
        let share = if whole > 0.0 { (high / whole).sqrt() } else { 0.0 };
        Some(Self {
            whole: mean(whole),
            share,
            wave_number: wave_number(largest.1),
            slope: mean(steep),
            curvature: mean(bent),
        })
    }
}

/// Least squares by the first three Legendre polynomials of the places; the rest is left.
fn take_parabola_off(values: &mut [f64]) {
    let count = values.len() as f64;
    let at = |i: usize| (2.0 * i as f64 + 1.0) / count - 1.0;
    for shape in [|_: f64| 1.0, |t: f64| t, |t: f64| 1.5 * t * t - 0.5] {
        let (mut above, mut below) = (0.0, 0.0);
        for (i, value) in values.iter().enumerate() {
            let p = shape(at(i));
            (above, below) = (above + p * value, below + p * p);
        }
        values.iter_mut().enumerate().for_each(|(i, value)| *value -= above / below * shape(at(i)));
    }
}
