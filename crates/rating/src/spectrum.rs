//! Load spectra: damage of a life with many loads. ISO 6336-6.

use serde::Serialize;

use crate::{
    GearRating, GivenFactors, MeshStiffness, RatingError, RatingInput, StandardRating, StressLife, standard_rating,
};

/// A load with its share of the life.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct LoadBin {
    /// Torque on the driven gear, N m.
    pub torque_nm: f64,
    /// Speed of the driver, 1/min.
    pub speed_rpm: f64,
    /// Share of the life, 0 to 1.
    pub share: f64,
    /// K_Hbeta under this load; `None`: that of the nominal one.
    pub face_load_factor: Option<f64>,
    /// Mesh stiffness under this load; `None`: that of the nominal one.
    pub stiffness: Option<MeshStiffness>,
}

impl LoadBin {
    /// Whether it does damage: it has a torque and a speed, and lasts.
    pub fn works(&self) -> bool {
        self.torque_nm > 0.0 && self.speed_rpm > 0.0 && self.share > 0.0
    }
}

/// Loads over a life.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Spectrum {
    bins: Vec<LoadBin>,
}

/// Share of the heaviest load below which loads do no damage.
const LIGHT: f64 = 1e-3;

/// Largest torque (N m) and speed (1/min) of a load: those that an operation may have.
const LARGEST: [f64; 2] = [1e9, 1e7];

/// Columns that say how long a load lasts: shares, or times in any unit.
const DURATIONS: [&str; 3] = ["share", "duration_s", "duration_h"];

impl Spectrum {
    /// Spectrum from a table with commas and a heading: `torque_nm`, `speed_rpm`, and one of `share`, `duration_s`, `duration_h`; shares and times are divided by their sum.
    ///
    /// # Errors
    /// [`RatingError::Table`] with the line at fault.
    pub fn parse(text: &str) -> Result<Self, RatingError> {
        let refused =
            |line: usize, what: String| Err(RatingError::Table { line, what: format!("line {line}: {what}") });
        let lines = text.lines().enumerate().map(|(k, line)| (k + 1, line.split('#').next().unwrap_or("").trim()));
        let mut lines = lines.filter(|(_, line)| !line.is_empty());
        let Some((first, heading)) = lines.next() else { return refused(1, "the file is empty".into()) };
        let names: Vec<&str> = heading.split(',').map(str::trim).collect();
        let column = |name: &str| names.iter().position(|own| *own == name);
        let duration = DURATIONS.iter().find_map(|name| column(name));
        let known = || ["torque_nm", "speed_rpm"].into_iter().chain(DURATIONS);
        let times = |name: &str| names.iter().filter(|own| **own == name).count();
        if let Some(twice) = known().find(|name| times(name) > 1) {
            return refused(first, format!("two columns are `{twice}`"));
        }
        let lengths: Vec<&str> = DURATIONS.into_iter().filter(|name| times(name) > 0).collect();
        if let [one, other, ..] = lengths[..] {
            return refused(first, format!("`{one}` and `{other}` both say how long a load lasts: one of them may"));
        }
        let (Some(torque), Some(speed), Some(duration)) = (column("torque_nm"), column("speed_rpm"), duration) else {
            let what = format!(
                "the columns are {}, wanted are `torque_nm`, `speed_rpm`, and one of `share`, `duration_s`, `duration_h`",
                names.join(", ")
            );
            return refused(first, what);
        };
        let mut bins = Vec::new();
        for (line, row) in lines {
            let fields: Vec<&str> = row.split(',').map(str::trim).collect();
            if fields.len() != names.len() {
                return refused(line, format!("{} values, the heading has {}", fields.len(), names.len()));
            }
            let number = |k: usize| fields[k].parse::<f64>().ok().filter(|x| x.is_finite() && *x >= 0.0);
            let (Some(torque_nm), Some(speed_rpm), Some(share)) = (number(torque), number(speed), number(duration))
            else {
                return refused(line, format!("`{row}` has a value that is not a number of 0 or more"));
            };
            if torque_nm > LARGEST[0] || speed_rpm > LARGEST[1] {
                let [torque, speed] = LARGEST;
                return refused(line, format!("`{row}`: at most {torque:e} N m and {speed:e} 1/min are taken"));
            }
            bins.push(LoadBin { torque_nm, speed_rpm, share, face_load_factor: None, stiffness: None });
        }
        let sum: f64 = bins.iter().map(|bin| bin.share).sum();
        if !(sum.is_finite() && bins.iter().any(LoadBin::works)) {
            return refused(first, "no load with a torque and a speed lasts any time".into());
        }
        bins.iter_mut().for_each(|bin| bin.share /= sum);
        Ok(Self { bins })
    }

    /// Spectrum of the same shares with other loads: those that a mesh of a gearbox has.
    pub fn with_loads(&self, load: impl FnMut(&LoadBin) -> LoadBin) -> Self {
        Self { bins: self.bins.iter().map(load).collect() }
    }

    /// Torque, N m, down to which loads do no damage beside the heaviest one or a nominal torque: a thousandth of the larger
    /// of both. Damage goes with the 5th power of the load or a higher one.
    fn light(&self, nominal_torque_nm: f64) -> f64 {
        let works = self.bins.iter().filter(|bin| bin.works());
        LIGHT * works.map(|bin| bin.torque_nm).fold(nominal_torque_nm, f64::max)
    }

    /// Loads that do damage beside a nominal torque, N m: those above a thousandth of it, and of the heaviest load.
    pub fn harmful(&self, nominal_torque_nm: f64) -> impl Iterator<Item = &LoadBin> {
        let light = self.light(nominal_torque_nm);
        self.bins.iter().filter(move |bin| bin.works() && bin.torque_nm > light)
    }

    /// The spectrum, its loads that are no harm ([`Spectrum::harmful`]) without a torque.
    pub fn without_light(&self, nominal_torque_nm: f64) -> Self {
        let light = self.light(nominal_torque_nm);
        self.with_loads(|bin| LoadBin { torque_nm: if bin.torque_nm > light { bin.torque_nm } else { 0.0 }, ..*bin })
    }

    /// Loads in the order of the table, their shares 1 in sum.
    pub fn bins(&self) -> &[LoadBin] {
        &self.bins
    }
}

described::described! {
    /// Miner's sums of one gear.
    #[derive(Debug, Clone, Copy, PartialEq, Serialize)]
    pub struct GearDamage {
        /// Miner's sum for pitting over `life_h`
        pub pitting_damage: f64,
        /// Miner's sum for tooth root breakage over `life_h`
        pub bending_damage: f64,
        /// factor on all contact stresses that makes the sum 1
        pub pitting_safety: f64,
        /// factor on all root stresses that makes the sum 1
        pub bending_safety: f64,
    }
}

described::described! {
    /// Damage of a pair over its life.
    #[derive(Debug, Clone, PartialEq, Serialize)]
    pub struct SpectrumRating {
        /// number of loads of the spectrum
        pub loads: usize,
        /// damage of the pinion
        pub pinion: GearDamage,
        /// damage of the wheel
        pub wheel: GearDamage,
    }
}

/// Load cycles with the stress, MPa, that they put on a place.
pub type Cycles = (f64, f64);

/// Miner's sum.
///
/// ```text
/// U = sum n_i/N_i(sigma_i)
/// ```
/// Source: ISO 6336-6 (Palmgren-Miner).
pub fn miner_sum(curve: &StressLife, loads: &[Cycles]) -> f64 {
    loads.iter().map(|(cycles, stress)| curve.damage(*cycles, *stress)).sum()
}

/// Factor on all stresses that makes Miner's sum 1; infinite where no load does damage.
///
/// ```text
/// sum n_i/N_i(S sigma_i) = 1
/// ```
/// Source: ISO 6336-6 (safety by iteration).
pub fn miner_safety(curve: &StressLife, loads: &[Cycles]) -> f64 {
    let at = |factor: f64| loads.iter().map(|(cycles, stress)| curve.damage(*cycles, factor * stress)).sum::<f64>();
    let (mut low, mut high) = (1e-3_f64, 1e3_f64);
    if at(high) <= 1.0 {
        return f64::INFINITY;
    }
    for _ in 0..100 {
        let middle = (low * high).sqrt();
        if at(middle) > 1.0 { high = middle } else { low = middle }
    }
    low
}

/// A load of a spectrum that works, with its rating.
#[derive(Debug, Clone, PartialEq)]
pub struct RatedLoad {
    /// The load.
    pub load: LoadBin,
    /// The pair under it for the whole life.
    pub rating: StandardRating,
}

impl RatedLoad {
    /// Load cycles of a gear under this load, over the life.
    fn share_of_cycles(&self, gear: usize) -> f64 {
        self.load.share * self.rating.gears()[gear].load_cycles
    }
}

/// A pair under every load of a spectrum: each has its own dynamic and transverse load factors, and its own K_Hbeta and mesh stiffness where it states them; the curves of bearable stress, Z_V with them, are those of the nominal load.
#[derive(Debug, Clone, PartialEq)]
pub struct RatedSpectrum {
    count: usize,
    nominal: StandardRating,
    loads: Vec<RatedLoad>,
}

impl RatedSpectrum {
    /// Rates a pair under a spectrum. `nominal_torque_nm` and `nominal_speed_rpm`: torque on the driven gear and speed of the driver that `input` is for. Loads without torque or speed do no damage.
    ///
    /// # Errors
    /// [`RatingError`] as [`standard_rating`].
    pub fn new(
        input: &RatingInput<'_>,
        spectrum: &Spectrum,
        [nominal_torque_nm, nominal_speed_rpm]: [f64; 2],
    ) -> Result<Self, RatingError> {
        let one = |load: &LoadBin| {
            let own = RatingInput {
                tangential_force: input.tangential_force * load.torque_nm / nominal_torque_nm,
                pinion_speed_rpm: input.pinion_speed_rpm * load.speed_rpm / nominal_speed_rpm,
                stiffness: load.stiffness.unwrap_or(input.stiffness),
                factors: GivenFactors {
                    face_load: load.face_load_factor.unwrap_or(input.factors.face_load),
                    ..input.factors
                },
                ..*input
            };
            Ok(RatedLoad { load: *load, rating: standard_rating(&own)? })
        };
        let loads = spectrum.bins.iter().filter(|bin| bin.works()).map(one).collect::<Result<_, RatingError>>()?;
        Ok(Self { count: spectrum.bins.len(), nominal: standard_rating(input)?, loads })
    }

    /// Loads that work, in the order of the spectrum.
    pub fn loads(&self) -> &[RatedLoad] {
        &self.loads
    }

    /// Damage by the stresses of the standard.
    pub fn rating(&self) -> SpectrumRating {
        let gear = |k: usize| {
            let of_loads = |stress: fn(&GearRating) -> f64| {
                self.cycles(k, self.loads.iter().map(|load| stress(load.rating.gears()[k])))
            };
            let (pitting, bending) = (of_loads(|g| g.contact_stress_mpa), of_loads(|g| g.root_stress_mpa));
            let own = self.nominal.gears()[k];
            GearDamage {
                pitting_damage: miner_sum(&own.pitting_curve, &pitting),
                bending_damage: miner_sum(&own.bending_curve, &bending),
                pitting_safety: miner_safety(&own.pitting_curve, &pitting),
                bending_safety: miner_safety(&own.bending_curve, &bending),
            }
        };
        SpectrumRating { loads: self.count, pinion: gear(0), wheel: gear(1) }
    }

    /// Load cycles of a gear under each load that works, with the stresses (MPa) that these loads put on some place of it.
    pub fn cycles(&self, gear: usize, stresses: impl Iterator<Item = f64>) -> Vec<Cycles> {
        self.loads.iter().map(|load| load.share_of_cycles(gear)).zip(stresses).collect()
    }

    /// The pair under its nominal load.
    pub fn nominal(&self) -> &StandardRating {
        &self.nominal
    }
}
