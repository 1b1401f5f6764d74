//! A map whose tooth pairs are closer together or farther apart because of pitch errors. Theory (74a).

use std::sync::Arc;

use rayon::prelude::*;

use crate::{
    ContactMap, CutPlace, MapContact, MapError, PhaseContact, Wanted,
    errors::halton,
    pair_shares::{PairPlace, PartsWanted},
    pair_sums::PairSums,
};

/// Offsets of the teeth of two gears, mm along the normal; positive if a tooth is nearer to its mate.
///
/// ```text
/// e(m) = e_1[m mod z_1] + e_2[-m mod z_2]        m: number of the pair of teeth
/// ```
/// Gear 2 rotates in the opposite sense, so its teeth come in descending order.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct PairOffsets {
    teeth: [Vec<f64>; 2],
}

impl PairOffsets {
    /// Offsets of the teeth of gear 1 and gear 2, one entry per tooth; an empty list for a gear without offsets.
    pub fn new(teeth: [Vec<f64>; 2]) -> Self {
        Self { teeth }
    }

    /// Offset of a pair, mm.
    pub fn of(&self, pair: i64) -> f64 {
        let of = |own: &[f64], k: i64| {
            let place = k.rem_euclid(own.len().max(1) as i64) as usize;
            own.get(place).copied().unwrap_or(0.0)
        };
        of(&self.teeth[0], pair) + of(&self.teeth[1], -pair)
    }

    /// Whether no tooth has an offset.
    pub fn is_none(&self) -> bool {
        self.teeth.iter().flatten().all(|e| *e == 0.0)
    }

    /// Number of mesh cycles after which the same teeth meet again.
    pub fn period(&self) -> u64 {
        Self::cycles([0, 1].map(|g| self.teeth[g].len().max(1) as u64))
    }

    /// Least common multiple of the two numbers of mesh cycles after which the teeth of either gear repeat.
    pub fn cycles([a, b]: [u64; 2]) -> u64 {
        let (mut x, mut y) = (a, b);
        while y > 0 {
            (x, y) = (y, x % y);
        }
        a / x * b
    }
}

/// A map of identical teeth, and offsets of these teeth.
///
/// ```text
/// V(c, x, gamma) = sum over m of U_m(c, x + e_m, gamma),   U_m = integral of s(c - m, gamma, F) F dy,   F: of the map at the approach y
/// ```
/// Each pair has the force that it has in the map at its own approach. This is exact if gears are linear and all pairs
/// touch, and if pairs do not influence each other. Otherwise the error is the missing influence of a separated pair on
/// its neighbours. Without offsets it is the map itself.
#[derive(Debug, Clone)]
pub struct OffsetMap {
    map: Arc<ContactMap>,
    offsets: Option<Arc<PairOffsets>>,
}

/// Error of a map with offsets, compared with the contact of the teeth themselves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OffsetError {
    /// Number of positions of the comparison.
    pub checks: usize,
    /// Root mean square error of the approach there, mm.
    pub rms_mm: f64,
    /// Largest error of the approach there, mm.
    pub largest_mm: f64,
}

/// Places at which offsets are held against the contact.
const CHECKS: usize = 64;
/// Parts of pairs alone, without their slopes.
const PART: PartsWanted = PartsWanted { phase: false, tilt: false };
/// Newton steps and halvings to an approach.
const STEPS: usize = 60;
/// Part of the force at the least load from which on a pair counts as touching first.
const TOUCHES: f64 = 1e-2;
impl OffsetMap {
    /// A map with offsets; the map alone if there are none.
    pub fn new(map: Arc<ContactMap>, offsets: PairOffsets) -> Self {
        Self { map, offsets: (!offsets.is_none()).then(|| Arc::new(offsets)) }
    }

    /// The map of identical teeth.
    pub fn map(&self) -> &ContactMap {
        &self.map
    }

    /// The map of identical teeth, shared.
    pub fn shared(&self) -> Arc<ContactMap> {
        Arc::clone(&self.map)
    }

    /// Offsets of the teeth, if any.
    pub fn offsets(&self) -> Option<&PairOffsets> {
        self.offsets.as_deref()
    }

    /// Makes a place one for another phase (mesh cycles) and tilt (rad), in its own memory, without curves.
    pub(crate) fn move_place(&self, place: &mut CutPlace, at: [f64; 2]) {
        self.map.move_place(place, at);
        if self.offsets.is_some() || self.map.friction.is_some() {
            self.map.pairs.places(self.map.phases, at[0], &mut place.pairs);
        }
    }

    /// The map at a phase (mesh cycles) and a tilt (rad).
    pub fn place(&self, phase: f64, tilt: f64) -> CutPlace {
        let mut place = CutPlace::default();
        self.move_place(&mut place, [phase, if self.map.tilts().is_some() { tilt } else { 0.0 }]);
        self.map.make_curves(&mut place);
        place
    }

    /// Makes the curves of a place, where it has none, if flanks may touch at an approach (mm).
    pub(crate) fn make_curves(&self, place: &mut CutPlace, approach: f64) {
        let apart = approach <= place.begin;
        if !apart || self.offsets.is_some() {
            self.map.make_curves(place);
        }
    }

    /// Pairs with their offsets, mm.
    pub(crate) fn pairs<'a>(&'a self, place: &'a CutPlace) -> impl Iterator<Item = (&'a PairPlace, f64)> {
        let cycle = place.at[0].floor() as i64;
        let all = self.offsets.iter().flat_map(move |o| place.pairs.iter().map(move |own| (own, o)));
        all.map(move |(own, offsets)| (own, offsets.of(cycle + own.pair)))
    }

    /// Overlap of the flanks that touch first, at a position of this map and an approach (mm), mm; negative if they are
    /// apart.
    pub fn overlap(&self, place: &CutPlace, approach: f64) -> f64 {
        let own = approach - self.map.first_touch(place);
        let part = |own: &PairPlace| self.map.held(own, &place.tilt, 0.0, PART).0[0];
        let touching = self.pairs(place).filter(|(own, _)| part(own) > TOUCHES).map(|(_, e)| e);
        touching.reduce(f64::max).map_or(own, |e| own + e)
    }

    /// Elastic energy at a position of this map and an approach (mm), N mm.
    pub fn energy(&self, place: &CutPlace, approach: f64) -> f64 {
        if self.offsets.is_none() {
            return self.map.energy(place, approach);
        }
        self.contact(place, approach, Wanted { energy: true, phase_rate: false }).energy
    }

    /// Force along the approach at a position of this map and an approach (mm), N.
    pub fn force(&self, place: &CutPlace, approach: f64) -> f64 {
        if self.offsets.is_none() {
            return self.map.force(place, approach);
        }
        let of = |(own, e): (&PairPlace, f64)| {
            let load = self.map.load(place, approach + e)?;
            Some(self.map.held(own, &place.tilt, load, PART).0[0] * self.map.load_axis().force(load))
        };
        self.pairs(place).filter_map(of).sum()
    }

    /// The contact at a position of this map and an approach (mm).
    ///
    /// ```text
    /// dg/dx = (s' F + s F') / X',   g = s F
    /// ```
    /// The prime ' is the derivative by the position nu on the load axis; X(nu) is the approach.
    pub fn contact(&self, place: &CutPlace, approach: f64, wanted: Wanted) -> MapContact {
        if self.offsets.is_none() {
            return self.map.contact(place, approach, wanted);
        }
        let axis = self.map.load_axis();
        let mut all = MapContact::default();
        let (mut touching, mut parted) = (Vec::with_capacity(place.pairs.len()), false);
        for (own, e) in self.pairs(place) {
            match self.map.load(place, approach + e) {
                Some(load) => touching.push((own, load)),
                None => parted = true,
            }
        }
        if wanted.energy || wanted.phase_rate || place.by_tilt.is_some() {
            let by_phase = wanted.phase_rate.then(|| self.map.by_phase(place));
            let sums = PairSums::new(&self.map, place, by_phase.as_ref(), (&touching, parted));
            let per_tilt = self.map.per_tilt();
            all.energy = if wanted.energy { sums.energy } else { 0.0 };
            all.phase_rate = self.map.phases as f64 * sums.phase_rate;
            all.moment = per_tilt * sums.moment;
            all.stiffness[1][1] = -per_tilt * per_tilt * sums.tilting;
        }
        for (own, load) in touching {
            let ([s, _, s1, _], ds) = self.map.held(own, &place.tilt, load, PartsWanted { tilt: true, ..PART });
            let [f, df] = [axis.force(load), axis.force_slope(load)];
            let (slope, grows) = (place.curve.value(load)[1], ds * f + s * df);
            all.force += s * f;
            all.stiffness[0][0] += grows / slope;
            if let Some(by_tilt) = &place.by_tilt {
                let per_tilt = self.map.per_tilt();
                let x1 = by_tilt[0].value(load)[0];
                let mixed = per_tilt * (s1 * f - grows * x1 / slope);
                all.stiffness[0][1] += mixed;
                all.stiffness[1][0] += mixed;
                all.stiffness[1][1] += per_tilt * per_tilt * x1 / slope * (grows * x1 - s1 * f * slope);
            }
        }
        if all.force > 0.0 {
            let load = axis.place(all.force);
            all.load = Some([load, all.stiffness[0][0] / axis.force_slope(load)]);
        }
        all
    }

    /// Approach (mm) under a force (N) at a position of this map.
    pub fn approach(&self, place: &CutPlace, force: f64) -> f64 {
        let under = place.curve.value(self.map.load_axis().place(force))[0];
        let ends = self.pairs(place).fold([0.0f64; 2], |[a, b], (_, e)| [a.min(e), b.max(e)]);
        let [mut low, mut high] = [self.map.first_touch(place) - ends[1], under - ends[0]];
        let mut approach = under;
        for _ in 0..STEPS {
            let found = self.contact(place, approach, Wanted::default());
            let off = force - found.force;
            if off > 0.0 {
                low = low.max(approach)
            } else {
                high = high.min(approach)
            }
            let next = approach + off / found.stiffness[0][0];
            let next = if next >= low && next <= high { next } else { 0.5 * (low + high) };
            if (next - approach).abs() <= 4.0 * f64::EPSILON * next.abs() {
                return next;
            }
            approach = next;
        }
        approach
    }

    /// Error of the approach, compared with the contact of the teeth with their offsets, which `at` gives at a position
    /// in the mesh cycles. It is sampled under forces around `mean_force` (N), over the whole period of the teeth.
    /// `None` without offsets.
    ///
    /// # Errors
    /// [`MapError::Contact`] if the contact cannot be solved.
    pub fn error<C, E>(
        &self,
        mean_force: f64,
        at: impl Fn(f64) -> Result<C, E> + Sync,
    ) -> Result<Option<OffsetError>, MapError<E>>
    where
        C: PhaseContact<Error = E>,
        E: Send,
    {
        let Some(offsets) = &self.offsets else { return Ok(None) };
        let one = |i: usize| {
            let [c, l, t] = [2, 3, 5].map(|base| halton(i + 1, base));
            let (cycles, force) = (c * offsets.period() as f64, (0.5 + l) * mean_force);
            let tilt = self.map.tilts().map_or(0.0, |[low, high]| low + t * (high - low));
            let place = self.place(cycles, tilt);
            let approach = self.approach(&place, force);
            let fail = |source| MapError::Contact { phase: cycles, approach_um: 1e3 * approach, source };
            let sample = at(cycles).and_then(|mut contact| contact.sample(approach, tilt)).map_err(fail)?;
            let own = self.contact(&place, approach, Wanted::default()).stiffness[0][0];
            let stiffness = if sample.stiffness > 0.0 { sample.stiffness } else { own };
            Ok((sample.force - force) / stiffness)
        };
        let off: Vec<f64> = (0..CHECKS).into_par_iter().map(one).collect::<Result<_, _>>()?;
        let squares = off.iter().map(|e| e * e).sum::<f64>();
        Ok(Some(OffsetError {
            checks: CHECKS,
            rms_mm: (squares / CHECKS as f64).sqrt(),
            largest_mm: off.iter().fold(0.0, |m: f64, e| m.max(e.abs())),
        }))
    }
}
