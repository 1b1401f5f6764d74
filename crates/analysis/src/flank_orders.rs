//! Which waves and which teeth of measured flanks make which orders of the transmission error.

use std::f64::consts::{PI, TAU};

use answer::Remark;
use contact::SliceResult;
use geometry::{
    FlankModification, Gear, GearModifications, GearPair, ModifiedFlank, Side,
    modification::{ProfileAxis, Topography},
};
use ltca::{PairResult, StaticHistory, StaticPosition};
use metrology::{GearHeader, MeasuredGear, Ripple, Trace, TraceKind};
use scene::Scene;
use study::{Harmonic, StudyError, mesh_harmonics};

use crate::remark;

/// Waves that are looked for on the flanks of a gear, and the least amplitude over the largest depth of the deviation.
const WAVES: usize = 10;
const LEAST: f64 = 1e-3;
/// Waves are looked for up to so many times the number of teeth.
const HARMONICS: u32 = 20;
/// Heights at which waves are fitted: by how far their phase goes from one to the next at the most, rad, and how many at least
/// and at the most.
const PHASE_STEP: f64 = 0.3;
const HEIGHTS: [f64; 2] = [33.0, 257.0];
/// Places of a profile at which its topography is read.
const PLACES: usize = 400;
/// Places over the band of a slice.
const BAND: usize = 16;
/// Lines of the transmission error whose shares are told, and the least share that is.
const LINES: usize = 12;
const LEAST_SHARE: f64 = 0.01;

/// A line of the transmission error over all positions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TeLine {
    /// Order of the mesh frequency.
    pub mesh_order: f64,
    /// Order of one turn of pinion and wheel.
    pub order: [f64; 2],
    /// Single-sided amplitude under load, um.
    pub ste_um: f64,
    /// Single-sided amplitude without load, um.
    pub kinematic_te_um: f64,
    /// What the deviations of all flanks make of it, to first order, um.
    pub flanks_um: f64,
    /// Amplitude of the wave of this order on the driving flanks of pinion and wheel, um; 0 without one.
    pub wave_um: [f64; 2],
}

/// What of a gear makes a part of the transmission error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum FlankPart {
    /// A wave on all driving flanks, by its order.
    Wave(u32),
    /// Topography and pitch error of a tooth.
    Tooth(u32),
}

/// Part of a line of the transmission error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FlankShare {
    /// Order of the mesh frequency.
    pub mesh_order: f64,
    /// Order of one turn of pinion and wheel.
    pub order: [f64; 2],
    /// Gear: 0 pinion, 1 wheel.
    pub gear: usize,
    /// What of it.
    pub part: FlankPart,
    /// Its single-sided amplitude at this line, um.
    pub amplitude_um: f64,
    /// Its component along the line over the amplitude of the line: parts that make up the line add up to 1.
    pub share: f64,
}

/// Waves on the driving flanks of pinion and wheel, beside orders of the mesh frequency.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct FlankWaves {
    teeth: [u32; 2],
    waves: [Vec<Ripple>; 2],
}

impl FlankWaves {
    /// Waves of a pair; none where it has no topographies.
    pub fn of(scene: &Scene, pair: &GearPair) -> Self {
        let slice = scene.contact.slices.map_or(0.0, |n| pair.face_width() / f64::from(n.max(1)));
        let gears = [&pair.pinion, &pair.wheel];
        let waves = gears.map(|gear| Deviations::of(gear, scene.side(), slice).map(|own| own.waves()));
        Self { teeth: gears.map(Gear::teeth), waves: waves.map(Option::unwrap_or_default) }
    }

    /// Order of one turn of pinion and wheel.
    pub fn orders(&self, mesh_order: f64) -> [f64; 2] {
        self.teeth.map(|teeth| mesh_order * f64::from(teeth))
    }

    /// Amplitude of the wave of an order of the mesh on pinion and wheel, um; 0 without one.
    pub fn amplitudes_um(&self, mesh_order: f64) -> [f64; 2] {
        let orders = self.orders(mesh_order);
        [0, 1].map(|gear| {
            let own = self.waves[gear].iter().find(|w| (f64::from(w.order) - orders[gear]).abs() < 1e-6);
            own.map_or(0.0, |w| w.amplitude_um)
        })
    }
}

/// Orders of the transmission error with their causes on the flanks.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct FlankOrders {
    /// Lines, ascending from the first above 0.
    pub lines: Vec<TeLine>,
    /// Parts of the lines to which flanks contribute most, the largest line first.
    pub shares: Vec<FlankShare>,
}

impl FlankOrders {
    /// Orders of a run with rates by the gaps of its slices ([`ltca::StaticOptions::gap_rates`]).
    ///
    /// ```text
    /// dTE(theta) = sum_i (dTE/dg_i) m_i,   m_i = (1/n) sum_j f(x_i + a_i cos((2 j - 1) pi/(2 n)))
    /// ```
    /// over the slices i of a gear's tooth (or of all teeth, of a wave): linear in the deviation f, at the load, the contact
    /// and the half-widths a_i of the solution. Theory (26a), (77).
    ///
    /// # Errors
    /// The errors of [`mesh_harmonics`]. Without topographies and pitch errors there is nothing to tell: scenes that ask for
    /// it are refused.
    pub fn of(scene: &Scene, pair: &GearPair, history: &StaticHistory) -> Result<Self, StudyError> {
        let side = scene.side();
        let slice = scene.contact.slices.map_or(0.0, |n| pair.face_width() / f64::from(n.max(1)));
        let mut parts: Vec<(usize, FlankPart, Vec<f64>)> = Vec::new();
        let waves = FlankWaves::of(scene, pair);
        for (gear, own) in [&pair.pinion, &pair.wheel].into_iter().enumerate() {
            let Some(deviations) = Deviations::of(own, side, slice) else { continue };
            for wave in &waves.waves[gear] {
                let wave_of = deviations.over_face(wave);
                let depth = |tooth: u32, at: [f64; 2]| deviations.wave_um(&wave_of, tooth, at);
                parts.push((gear, FlankPart::Wave(wave.order), over(history, (gear, side, own.base_radius()), &depth)));
            }
            for tooth in 0..own.teeth() {
                let depth = |of: u32, at: [f64; 2]| if of == tooth { deviations.tooth_um(tooth, at) } else { 0.0 };
                parts.push((gear, FlankPart::Tooth(tooth), over(history, (gear, side, own.base_radius()), &depth)));
            }
        }
        if parts.is_empty() {
            return Ok(Self::default());
        }
        Self::of_parts(scene, history, &parts, &waves)
    }

    fn of_parts(
        scene: &Scene,
        history: &StaticHistory,
        parts: &[(usize, FlankPart, Vec<f64>)],
        waves: &FlankWaves,
    ) -> Result<Self, StudyError> {
        let all = |of: fn(&StaticPosition) -> f64| -> Vec<f64> { history.positions.iter().map(of).collect() };
        let lines = |samples: &[f64]| mesh_harmonics(samples, 1, samples.len() / 2);
        let ste = lines(&all(|p| 1e3 * p.transmission_error))?;
        let kinematic = lines(&all(|p| 1e3 * p.kinematic_transmission_error))?;
        let mut sum = vec![0.0; history.positions.len()];
        let teeth = parts.iter().filter(|(_, part, _)| matches!(part, FlankPart::Tooth(_)));
        teeth.for_each(|(_, _, own)| sum.iter_mut().zip(own).for_each(|(sum, own)| *sum += own));
        let flanks = lines(&sum)?;
        let cycles = f64::from(scene.analysis.cycles);
        let place = |line: &Harmonic| {
            let mesh_order = line.order as f64 / cycles;
            (mesh_order, waves.orders(mesh_order))
        };
        let told = ste.iter().zip(&kinematic).zip(&flanks).map(|((ste, kinematic), flanks)| {
            let (mesh_order, order) = place(ste);
            TeLine {
                mesh_order,
                order,
                ste_um: ste.amplitude,
                kinematic_te_um: kinematic.amplitude,
                flanks_um: flanks.amplitude,
                wave_um: waves.amplitudes_um(mesh_order),
            }
        });
        let told: Vec<TeLine> = told.collect();
        let mut strongest: Vec<usize> = (0..flanks.len()).collect();
        strongest.sort_by(|&a, &b| flanks[b].amplitude.total_cmp(&flanks[a].amplitude).then(a.cmp(&b)));
        strongest.truncate(LINES);
        let of_parts: Vec<Vec<Harmonic>> = parts.iter().map(|(_, _, own)| lines(own)).collect::<Result<_, _>>()?;
        let mut shares = Vec::new();
        for line in strongest {
            let whole = &ste[line];
            let (mesh_order, order) = place(whole);
            let one = |((gear, part, _), own): (&(usize, FlankPart, Vec<f64>), &Vec<Harmonic>)| {
                let own = &own[line];
                let along = own.amplitude * (own.phase_rad - whole.phase_rad).cos();
                let share = if whole.amplitude > 0.0 { along / whole.amplitude } else { 0.0 };
                FlankShare { mesh_order, order, gear: *gear, part: *part, amplitude_um: own.amplitude, share }
            };
            let mut all: Vec<FlankShare> = parts.iter().zip(&of_parts).map(one).collect();
            all.retain(|own| own.share.abs() >= LEAST_SHARE);
            all.sort_by(|a, b| b.share.abs().total_cmp(&a.share.abs()));
            shares.extend(all);
        }
        Ok(Self { lines: told, shares })
    }
}

/// What shows orders at the wrong place: a wave with fewer than two positions a period, and mesh cycles that are no whole turn
/// of a gear whose teeth differ.
pub(crate) fn misplaced_orders(scene: &Scene, pair: &GearPair) -> Vec<Remark> {
    let waves = FlankWaves::of(scene, pair);
    let positions = scene.analysis.positions_per_cycle;
    let gears = [("pinion", &pair.pinion), ("wheel", &pair.wheel)].into_iter().zip(&waves.waves);
    let short = gears.filter_map(|((name, gear), waves)| {
        let short = waves.iter().filter(|wave| 2 * wave.order > positions * gear.teeth());
        let most = short.max_by(|a, b| a.amplitude_um.total_cmp(&b.amplitude_um))?;
        let enough = 2 * most.order / gear.teeth() + 1;
        Some(remark::aliased_wave(name, most.order, most.amplitude_um, positions, enough))
    });
    short.chain(orders_of_no_turn(pair, u64::from(scene.analysis.cycles))).collect()
}

/// One remark for each gear whose teeth differ and that so many mesh cycles do not turn whole times: its orders fall between the
/// lines of a spectrum over them.
pub(crate) fn orders_of_no_turn(pair: &GearPair, cycles: u64) -> impl Iterator<Item = Remark> {
    let gears = [("pinion", &pair.pinion), ("wheel", &pair.wheel)].into_iter();
    let broken = gears.filter(move |(_, gear)| gear.has_own_teeth() && !cycles.is_multiple_of(u64::from(gear.teeth())));
    broken.map(move |(name, gear)| remark::orders_of_no_turn(name, cycles, gear.teeth()))
}

/// What a depth (um) on the driving flanks of a gear adds to the transmission error at each position, um.
fn over(
    history: &StaticHistory,
    (gear, side, base_radius): (usize, Side, f64),
    depth_um: &dyn Fn(u32, [f64; 2]) -> f64,
) -> Vec<f64> {
    let of_slice = |tooth: u32, slice: &SliceResult| {
        let (u, z) = (slice.roll[gear], [slice.z, slice.wheel_z][gear]);
        // The mean over the band; x = r_b u^2/2 along the profile.
        let place = |j: usize| slice.half_width * ((2 * j + 1) as f64 * PI / (2 * BAND) as f64).cos();
        let beside = |distance: f64| (u * u + 2.0 * distance / base_radius).max(0.0).sqrt();
        (0..BAND).map(|j| depth_um(tooth, [beside(place(j)), z])).sum::<f64>() / BAND as f64
    };
    let of_pair = |pair: &PairResult| {
        let tooth = [pair.pinion_tooth, pair.wheel_tooth][gear];
        let own = pair.slices.iter().zip(&pair.gap_rates).filter(|(slice, _)| slice.side == side);
        own.map(|(slice, rate)| rate * of_slice(tooth, slice)).sum::<f64>()
    };
    history.positions.iter().map(|position| position.pairs.iter().map(of_pair).sum()).collect()
}

/// Topographies and pitch errors alone of the flanks on one side of a gear.
struct Deviations<'a> {
    gear: &'a Gear,
    side: Side,
    /// The flank of each tooth.
    flanks: Vec<ModifiedFlank>,
    topography: Option<&'a Topography>,
}

impl<'a> Deviations<'a> {
    /// `slice`: axial length over which a topography counts by its mean, mm; `None` where nothing deviates.
    fn of(gear: &'a Gear, side: Side, slice: f64) -> Option<Self> {
        let topography = gear.modifications().on(side).topography.as_ref();
        if topography.is_none() && gear.modifications().pitch_errors.is_empty() {
            return None;
        }
        let alone = FlankModification { topography: topography.cloned(), ..FlankModification::default() };
        let bare = gear.clone().with_modifications(GearModifications::both(alone)).ok()?;
        let flank = |tooth: u32| bare.modified_flank(side, i64::from(tooth)).split(slice);
        Some(Self { gear, side, flanks: (0..gear.teeth()).map(flank).collect(), topography })
    }

    /// Depth of a tooth, um.
    fn tooth_um(&self, tooth: u32, [u, z]: [f64; 2]) -> f64 {
        let flank = &self.flanks[tooth as usize];
        1e3 * (flank.depth(u, z).value + flank.deviation(u, z) + self.gear.pitch_depth(self.side, i64::from(tooth)))
    }

    /// A wave at heights over the face: found at mid-face, fitted anew at each of them.
    fn over_face(&self, wave: &Ripple) -> WaveOverFace {
        let width = self.gear.face_width();
        let count =
            (f64::from(wave.order) * self.gear.twist().abs() * width / PHASE_STEP).clamp(HEIGHTS[0], HEIGHTS[1]);
        let step = width / (count.ceil() - 1.0);
        let at = |i: usize| {
            let found = metrology::ripple(
                &self.measured(-0.5 * width + i as f64 * step),
                self.side,
                (wave.order..=wave.order, 1),
                1,
                0.0,
            );
            let own = found.ok().and_then(|all| all.first().copied());
            own.map_or([0.0; 2], |own| [f64::cos, f64::sin].map(|f| own.amplitude_um * f(own.phase_rad)))
        };
        let amplitudes = (0..count.ceil() as usize).map(at).collect();
        WaveOverFace { order: wave.order, from: -0.5 * width, step, amplitudes }
    }

    /// Depth of a wave on a tooth, um.
    fn wave_um(&self, wave: &WaveOverFace, tooth: u32, [u, z]: [f64; 2]) -> f64 {
        let turn = TAU * f64::from(tooth) / f64::from(self.gear.teeth()) + self.gear.twist() * z;
        let (sin, cos) = (f64::from(wave.order) * (u - self.side.sign() * turn)).sin_cos();
        let [a, b] = wave.at(z);
        b * sin - a * cos
    }

    /// Waves of all teeth along their profiles at mid-face, where a topography has lines.
    fn waves(&self) -> Vec<Ripple> {
        if self.topography.is_none() {
            return Vec::new();
        }
        let measured = self.measured(0.0);
        let depths = measured.traces.iter().flat_map(|own| &own.deviations_um).flatten();
        let least_um = LEAST * depths.fold(0.0, |most: f64, depth| most.max(depth.abs()));
        // Teeth that are alike have waves of multiples of their number alone.
        let teeth = self.gear.teeth();
        let step = if self.gear.has_own_flanks() { 1 } else { teeth };
        let orders = (step..=HARMONICS * teeth, step);
        // A topography beside the flank has none.
        metrology::ripple(&measured, self.side, orders, WAVES, least_um).unwrap_or_default()
    }

    /// Profiles of all teeth at a height (mm), as a machine would have measured them.
    fn measured(&self, height: f64) -> MeasuredGear {
        let (gear, base) = (self.gear, self.gear.base_radius());
        let profile = gear.profile();
        let mut range = [profile.roll_form(), profile.roll_tip()];
        for grid in self.topography.iter().flat_map(|own| own.grids()) {
            let (first, last) = match grid.profile() {
                ProfileAxis::Roll(rolls) => (rolls.first().copied(), rolls.last().copied()),
                ProfileAxis::Diameter(all) => {
                    let roll = |d: &f64| ((0.5 * d / base).powi(2) - 1.0).max(0.0).sqrt();
                    (all.first().map(roll), all.last().map(roll))
                }
            };
            range = [range[0].max(first.unwrap_or(range[0])), range[1].min(last.unwrap_or(range[1]))];
        }
        let data = gear.data();
        let header = GearHeader {
            teeth: gear.teeth(),
            normal_module: data.normal_module,
            helix_angle: data.helix_angle,
            pressure_angle: data.normal_pressure_angle,
            profile_shift: None,
            face_width: None,
            profile_evaluation: None,
            profile_measured: Some(range.map(|u| 2.0 * base * u.hypot(1.0))),
            helix_evaluation: None,
            helix_measured: None,
        };
        let place = |i: usize| range[0] + (range[1] - range[0]) * i as f64 / (PLACES - 1) as f64;
        let trace = |tooth: u32| {
            let flank = &self.flanks[tooth as usize];
            let proud = |u: f64| Some(-1e3 * (flank.depth(u, height).value + flank.deviation(u, height)));
            let deviations_um = (0..PLACES).map(|i| proud(place(i))).collect();
            Trace { kind: TraceKind::Profile(height), tooth, side: self.side, deviations_um }
        };
        let traces: Vec<Trace> = (0..gear.teeth()).map(trace).collect();
        MeasuredGear { header, traces, pitch: Vec::new() }
    }
}

/// A wave whose amplitude and phase change over the face: a cos(O theta) - b sin(O theta), theta along the twist of the gear.
struct WaveOverFace {
    order: u32,
    from: f64,
    step: f64,
    /// a and b at even heights, um proud of the flank.
    amplitudes: Vec<[f64; 2]>,
}

impl WaveOverFace {
    /// a and b at a height, straight between those that are known.
    fn at(&self, z: f64) -> [f64; 2] {
        let last = self.amplitudes.len() - 1;
        let t = ((z - self.from) / self.step).clamp(0.0, last as f64);
        let i = (t as usize).min(last - 1);
        let [one, other] = [self.amplitudes[i], self.amplitudes[i + 1]];
        [0, 1].map(|k| one[k] + (t - i as f64) * (other[k] - one[k]))
    }
}
