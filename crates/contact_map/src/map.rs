//! The map and its evaluation at a state.

use serde::{Deserialize, Serialize};

use crate::{
    certificate::MapCertificate,
    damping_table::DampingTable,
    friction_table::FrictionTable,
    load_axis::{LoadAxis, LoadCurve, knot},
    pair_shares::{PairPlace, PairShares},
    spline::{Axis, Splines},
};

/// The contact of one side of the teeth as a function of the phase of the mesh cycle, the approach of the flanks along
/// their normal (mm) and their tilt in the plane of action (rad). Theory (72).
///
/// ```text
/// X(phase, tilt, F): approach under the force F;   U* = integral of X dF from 0 to F,   V = F X - U*
/// ```
/// The map stores the approach X. Forces, the moment, the energy and their tangents are all derived from it, so forces
/// are the exact derivative of the energy. Flanks whose approach is below X(F = 0) are apart, and all forces are zero.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ContactMap {
    pub(crate) phases: usize,
    pub(crate) loads: usize,
    /// Intervals over tilt; 0: no tilt.
    pub(crate) tilts: usize,
    /// Largest force, N.
    pub(crate) force: f64,
    /// Ends of the tilt, rad.
    pub(crate) tilt: [f64; 2],
    /// Coefficients of X, phase by phase, tilt by tilt, mm.
    pub(crate) approach: Vec<f64>,
    pub(crate) damping: DampingTable,
    pub(crate) pairs: PairShares,
    pub(crate) friction: Option<FrictionTable>,
    pub(crate) certificate: MapCertificate,
}

/// The contact at one state.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct MapContact {
    /// Force along the approach, N, >= 0.
    pub force: f64,
    /// Moment along the tilt, -dV/d tilt, N mm.
    pub moment: f64,
    /// Elastic energy V, N mm.
    pub energy: f64,
    /// dV/d phase at constant approach and tilt, N mm.
    pub phase_rate: f64,
    /// Second derivatives of V by approach and tilt: N/mm, N, N mm.
    pub stiffness: [[f64; 2]; 2],
    /// Place over load and d place / d approach; none where flanks are apart.
    pub(crate) load: Option<[f64; 2]>,
}

/// Quantities requested at a state in addition to the force and its stiffness.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Wanted {
    /// Whether [`MapContact::energy`] is requested.
    pub energy: bool,
    /// Whether [`MapContact::phase_rate`] is requested.
    pub phase_rate: bool,
}

/// What is added to curves beyond the tilts of a map.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Beyond {
    /// Slope of the approach at first touch over the tilt, per unit of its spacing, and how it follows the phase.
    pub edge: f64,
    pub edge_by_phase: f64,
    /// How often it is in the approach and in its first and second slope over the tilt.
    pub factors: [f64; 3],
}

/// A map at one phase and tilt, as a function of the approach alone. If several approaches are evaluated there, most of
/// the work is done once.
///
/// The default value has no position.
#[derive(Debug, Clone, PartialEq)]
pub struct CutPlace {
    /// Phase (mesh cycles) and tilt (rad) for which it was made.
    pub at: [f64; 2],
    pub(crate) phase: Splines,
    pub(crate) tilt: Splines,
    /// Beyond the tilts of the map.
    pub(crate) beyond: Option<Beyond>,
    /// Approach at which flanks touch first, mm.
    pub(crate) begin: f64,
    /// Whether the curves are those of this place: flanks that are apart need none.
    has_curves: bool,
    pub(crate) curve: LoadCurve,
    /// Slope of the curve over tilt and its second derivative, per unit of the spacing, where the map has a tilt.
    pub(crate) by_tilt: Option<Box<[LoadCurve; 2]>>,
    /// Pairs of teeth that carry, where these are asked for one by one.
    pub(crate) pairs: Vec<PairPlace>,
}

impl Default for CutPlace {
    fn default() -> Self {
        Self {
            at: [f64::NAN; 2],
            phase: Splines::NONE,
            tilt: Splines::NONE,
            beyond: None,
            begin: f64::NAN,
            has_curves: false,
            curve: LoadCurve::default(),
            by_tilt: None,
            pairs: Vec::new(),
        }
    }
}

impl ContactMap {
    pub(crate) fn load_axis(&self) -> LoadAxis {
        LoadAxis::new(self.loads, self.force)
    }

    pub(crate) fn tilt_axis(&self) -> Axis {
        if self.tilts == 0 { Axis::Single } else { Axis::Open(self.tilts) }
    }

    /// Accuracy and cost of the map.
    pub fn certificate(&self) -> &MapCertificate {
        &self.certificate
    }

    /// Largest force of the map, N. Beyond it the approach grows linearly.
    pub fn largest_force(&self) -> f64 {
        self.force
    }

    /// Smallest and largest tilt of the map, rad; `None` if it has no tilt.
    pub fn tilts(&self) -> Option<[f64; 2]> {
        (self.tilts > 0).then_some(self.tilt)
    }

    pub(crate) fn per_tilt(&self) -> f64 {
        self.tilts as f64 / (self.tilt[1] - self.tilt[0])
    }

    /// The map at a phase (mesh cycles) and a tilt (rad).
    pub fn place(&self, phase: f64, tilt: f64) -> CutPlace {
        let mut place = CutPlace::default();
        self.move_place(&mut place, [phase, tilt]);
        self.make_curves(&mut place);
        place
    }

    /// Makes a place one for another phase (mesh cycles) and tilt (rad), in its own memory, without curves.
    pub(crate) fn move_place(&self, place: &mut CutPlace, [phase, tilt]: [f64; 2]) {
        let tilt_place = if self.tilts == 0 { 0.0 } else { (tilt - self.tilt[0]) * self.per_tilt() };
        let p = Axis::Periodic(self.phases).splines_at((phase - phase.floor()) * self.phases as f64);
        let end = tilt_place.clamp(0.0, self.tilts as f64);
        let t = self.tilt_axis().splines_at(end);
        place.at = [phase, tilt];
        (place.phase, place.tilt, place.has_curves, place.beyond) = (p, t, false, None);
        if tilt_place != end {
            self.go_beyond(place, tilt_place - end);
        }
        let [k0, k1, k2, _] = self.in_cell(&self.approach, place, 0);
        place.begin = knot([k0, k1, k2]) + place.beyond.map_or(0.0, |on| on.edge * on.factors[0]);
    }

    /// Makes the curves over load of a place, where it has none.
    pub(crate) fn make_curves(&self, place: &mut CutPlace) {
        if place.has_curves {
            return;
        }
        let CutPlace { phase: p, tilt: t, beyond, curve, by_tilt, has_curves, .. } = place;
        let [by_edge, by_edge_tilt, by_edge_bend] = beyond.map_or([0.0; 3], |on| on.factors.map(|f| f * on.edge));
        self.sum(curve, by_edge, [p, t], [&p.values, &t.values]);
        // Without a tilt nobody asks for slopes over it.
        if self.tilts > 0 {
            let [first, second] = &mut **by_tilt.get_or_insert_default();
            self.sum(first, by_edge_tilt, [p, t], [&p.values, &t.slopes]);
            self.sum(second, by_edge_bend, [p, t], [&p.values, &t.curvatures]);
        }
        *has_curves = true;
    }

    /// Coefficients of a table over load in one interval at a place: those that a curve has there.
    pub(crate) fn in_cell(&self, table: &[f64], place: &CutPlace, cell: usize) -> [f64; 4] {
        let (phase, tilt, loads, tilts) = (&place.phase, &place.tilt, self.loads + 3, self.tilt_axis().coefficients());
        let mut all = [0.0; 4];
        for (j, of_tilt) in tilt.values.iter().enumerate().take(tilt.count) {
            let [w0, w1, w2, w3] = phase.values.map(|w| w * of_tilt);
            let row = |i: usize| {
                let at = ((phase.first + i) * tilts + tilt.first + j) * loads + cell;
                &table[at..at + 4]
            };
            let [r0, r1, r2, r3] = [row(0), row(1), row(2), row(3)];
            for (k, sum) in all.iter_mut().enumerate() {
                *sum += (w0 * r0[k] + w1 * r1[k]) + (w2 * r2[k] + w3 * r3[k]);
            }
        }
        all
    }

    /// Place over load of an approach (mm) at a place of this map with its curves; none where flanks are apart.
    pub(crate) fn load(&self, place: &CutPlace, approach: f64) -> Option<f64> {
        let apart = approach <= place.begin;
        (!apart).then(|| place.curve.solve(approach))
    }

    /// Makes a curve over load the sum of the approaches over phases and tilts with weights, and of a constant.
    fn sum(
        &self,
        curve: &mut LoadCurve,
        constant: f64,
        [phase, tilt]: [&Splines; 2],
        [of_phase, of_tilt]: [&[f64; 4]; 2],
    ) {
        let (loads, tilts) = (self.loads + 3, self.tilt_axis().coefficients());
        curve.clear(self.load_axis());
        for (j, of_tilt) in of_tilt.iter().enumerate().take(tilt.count) {
            let row = |i: usize| {
                let at = ((phase.first + i) * tilts + tilt.first + j) * loads;
                &self.approach[at..at + loads]
            };
            curve.add(&of_phase.map(|w| w * of_tilt), [row(0), row(1), row(2), row(3)]);
        }
        if constant != 0.0 {
            curve.raise(constant);
        }
        curve.close();
    }

    /// Slope of the curve over the phase, per unit of the spacing.
    pub(crate) fn by_phase(&self, place: &CutPlace) -> LoadCurve {
        let mut by_phase = LoadCurve::default();
        let weights = [&place.phase.slopes, &place.tilt.values];
        let by_edge = place.beyond.map_or(0.0, |on| on.factors[0] * on.edge_by_phase);
        self.sum(&mut by_phase, by_edge, [&place.phase, &place.tilt], weights);
        by_phase
    }

    /// Approach (mm) under a force (N) at a phase (mesh cycles) and tilt (rad).
    pub fn approach(&self, phase: f64, tilt: f64, force: f64) -> f64 {
        self.place(phase, tilt).curve.value(self.load_axis().place(force))[0]
    }

    /// The contact at a phase (mesh cycles), an approach (mm) and a tilt (rad).
    pub fn at(&self, phase: f64, approach: f64, tilt: f64, wanted: Wanted) -> MapContact {
        self.contact(&self.place(phase, tilt), approach, wanted)
    }

    /// Approach (mm) at which the flanks first touch, at a position of this map.
    pub fn first_touch(&self, place: &CutPlace) -> f64 {
        place.begin
    }

    /// Elastic energy V at a position of this map and an approach (mm), N mm.
    pub fn energy(&self, place: &CutPlace, approach: f64) -> f64 {
        let found = self.load(place, approach);
        found.map_or(0.0, |load| self.load_axis().force(load) * approach - place.curve.integral(load))
    }

    /// Force along the approach at a position of this map and an approach (mm), N.
    pub fn force(&self, place: &CutPlace, approach: f64) -> f64 {
        self.load(place, approach).map_or(0.0, |load| self.load_axis().force(load))
    }

    /// The contact at a position of this map and an approach (mm).
    pub fn contact(&self, place: &CutPlace, approach: f64, wanted: Wanted) -> MapContact {
        let axis = self.load_axis();
        let curve = &place.curve;
        let Some(load) = self.load(place, approach) else { return MapContact::default() };
        let (force, by_load) = (axis.force(load), curve.value(load)[1]);
        let stiff = axis.force_slope(load) / by_load;
        let mut contact = MapContact { force, ..MapContact::default() };
        contact.stiffness[0][0] = stiff;
        contact.load = Some([load, 1.0 / by_load]);
        let integral = |curve: &LoadCurve| curve.integral(load);
        if wanted.energy {
            contact.energy = force * approach - curve.integral(load);
        }
        if wanted.phase_rate {
            contact.phase_rate = -(self.phases as f64) * integral(&self.by_phase(place));
        }
        if let Some(by_tilt) = &place.by_tilt {
            let per_tilt = self.per_tilt();
            let [first, second] = &**by_tilt;
            contact.moment = per_tilt * integral(first);
            // F at held approach falls as the tilt adds to the approach that it needs.
            let shift = per_tilt * first.value(load)[0];
            contact.stiffness[0][1] = -shift * stiff;
            contact.stiffness[1][0] = -shift * stiff;
            contact.stiffness[1][1] = shift * shift * stiff - per_tilt * per_tilt * integral(second);
        }
        contact
    }
}
