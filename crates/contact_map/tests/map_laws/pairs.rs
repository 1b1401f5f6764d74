//! Pairs of teeth that do not feel each other: springs that come and go, each known in closed form.

use std::{convert::Infallible, f64::consts::PI};

use contact_map::{ContactMap, ContactSample, LoadedSlice, MapPlan, OffsetMap, PairOffsets, PhaseContact, Wanted};

const WIDTH: f64 = 20.0;
const SLICES: usize = 10;

/// The contact at a place in the mesh cycles, with an offset of every pair.
struct Pairs<'a> {
    cycles: f64,
    offsets: &'a PairOffsets,
}

impl Pairs<'_> {
    /// Stiffness of a pair as it goes through the mesh, N/mm: from half a cycle before its own to half a cycle after.
    fn stiffness(&self, pair: i64) -> f64 {
        let u = self.cycles - pair as f64;
        if (-0.5..1.5).contains(&u) { 3e5 * (PI * (u + 0.5) / 2.0).sin().powi(4) } else { 0.0 }
    }

    fn slices(&self, approach: f64, tilt: f64) -> Vec<LoadedSlice> {
        let cycle = self.cycles.floor() as i64;
        let of = |pair: i64| {
            let (k, e) = (self.stiffness(pair), self.offsets.of(pair));
            (0..SLICES).map(move |i| {
                let lever = WIDTH * ((i as f64 + 0.5) / SLICES as f64 - 0.5);
                let force = k / SLICES as f64 * (approach + e + lever * tilt);
                LoadedSlice { force, length: WIDTH / SLICES as f64, lever, pair, friction: [0.0; 3] }
            })
        };
        (cycle - 1..=cycle + 1).flat_map(of).filter(|slice| slice.force > 0.0).collect()
    }
}

impl PhaseContact for Pairs<'_> {
    type Error = Infallible;

    fn overlap(&mut self, approach: f64, tilt: f64) -> f64 {
        approach + 0.5 * WIDTH * tilt.abs()
    }

    fn sample(&mut self, approach: f64, tilt: f64) -> Result<ContactSample, Infallible> {
        let slices = self.slices(approach, tilt);
        let stiffness = slices.iter().map(|s| self.stiffness(s.pair) / SLICES as f64).sum();
        Ok(ContactSample { force: slices.iter().map(|s| s.force).sum(), stiffness, slices })
    }
}

const MEAN_FORCE: f64 = 3000.0;

/// Each pair presses at its own approach, also where the other one has parted: exactly, but for the error of the map. The
/// same pairs come back after as many cycles as both gears need for whole turns.
#[test]
fn pairs_that_do_not_feel_each_other_are_exact() {
    let none = PairOffsets::default();
    let plan = MapPlan {
        mean_force: MEAN_FORCE,
        largest_force: 4.0 * MEAN_FORCE,
        tilt: None,
        width: WIDTH,
        half_path: None,
        tolerance: 1e-4,
        worst: 1e-4,
    };
    let at = |phase: f64| Ok::<_, Infallible>(Pairs { cycles: phase, offsets: &none });
    let map = ContactMap::build(&plan, &|_| {}, at).unwrap_or_else(|e| panic!("{e}"));
    let deflection = map.certificate().deflection_mm;
    let offsets = PairOffsets::new([vec![0.0, 5e-3, -9e-3], vec![4e-3, -3e-3, 6e-3, -12e-3, 0.0]]);
    assert_eq!(offsets.period(), 15);
    let own = OffsetMap::new(map.into(), offsets.clone());
    let mut parted = 0;
    for i in 0..300 {
        let cycles = 0.0517 * f64::from(i) - 4.0;
        let place = own.place(cycles, 0.0);
        let wrong = Pairs { cycles, offsets: &offsets };
        let x = own.approach(&place, MEAN_FORCE);
        let slices = wrong.slices(x, 0.0);
        let force: f64 = slices.iter().map(|s| s.force).sum();
        let stiffness: f64 = slices.iter().map(|s| wrong.stiffness(s.pair) / SLICES as f64).sum();
        let off = (force - MEAN_FORCE) / stiffness / deflection;
        assert!(off.abs() < 2e-3, "{cycles}: off by {off:e} of the deflection");
        let touching = |pair: i64| slices.iter().any(|s| s.pair == pair);
        let cycle = cycles.floor() as i64;
        parted += usize::from((cycle - 1..=cycle + 1).any(|m| wrong.stiffness(m) > 1e4 && !touching(m)));
        let later = own.place(cycles + 15.0, 0.0);
        let again = own.contact(&later, x, Wanted::default()).force;
        assert!((again - MEAN_FORCE).abs() < 1e-6 * MEAN_FORCE, "{cycles}: {again} N a period later");
    }
    assert!(parted > 10, "pairs hardly part: {parted} times");
    let told = own.error(MEAN_FORCE, |cycles| Ok::<_, Infallible>(Pairs { cycles, offsets: &offsets }));
    let told = told.unwrap_or_else(|e| panic!("{e}")).expect("there are offsets");
    assert!(told.rms_mm < 1e-3 * deflection, "{told:?}");
}

/// Offsets that are the same for all teeth bring the gears nearer by as much; without any the map is what it was, bit by
/// bit.
#[test]
fn a_common_offset_is_an_approach() {
    let none = PairOffsets::default();
    let (tolerance, worst) = (1e-3, 1e-2);
    let tilt = Some([-1e-4, 1e-4]);
    let plan =
        MapPlan { mean_force: MEAN_FORCE, largest_force: 9e3, tilt, width: WIDTH, half_path: None, tolerance, worst };
    let at = |phase: f64| Ok::<_, Infallible>(Pairs { cycles: phase, offsets: &none });
    let map = std::sync::Arc::new(ContactMap::build(&plan, &|_| {}, at).unwrap_or_else(|e| panic!("{e}")));
    let alike = OffsetMap::new(map.clone(), none.clone());
    let moved = OffsetMap::new(map.clone(), PairOffsets::new([vec![3e-3; 4], vec![-1e-3; 7]]));
    let all = Wanted { energy: true, phase_rate: true };
    for i in 0..50 {
        let (cycles, tilt) = (0.37 * f64::from(i), 4e-6 * f64::from(i - 25));
        let x = map.approach(cycles, tilt, MEAN_FORCE * (0.2 + 0.08 * f64::from(i)));
        let wanted = map.at(cycles, x, tilt, all);
        assert_eq!(alike.contact(&alike.place(cycles, tilt), x, all), wanted);
        let found = moved.contact(&moved.place(cycles, tilt), x - 2e-3, all);
        let near = |a: f64, b: f64, size: f64, what: &str| {
            assert!((a - b).abs() < 1e-9 * size, "{cycles}: {what} {a}, not {b}");
        };
        near(found.force, wanted.force, wanted.force, "force");
        near(found.energy, wanted.energy, wanted.energy, "energy");
        near(found.moment, wanted.moment, WIDTH * wanted.force, "moment");
        near(found.phase_rate, wanted.phase_rate, 10.0 * wanted.energy, "rate");
        for (i, j) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
            let size = wanted.stiffness[0][0] * WIDTH.powi(i32::try_from(i + j).unwrap());
            near(found.stiffness[i][j], wanted.stiffness[i][j], size, "stiffness");
        }
    }
}
