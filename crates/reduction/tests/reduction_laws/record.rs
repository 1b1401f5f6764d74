//! The file of a reduced gear: what goes in comes out to the bit, and nothing else is ever taken for it.

use fem::Material;
use geometry::{Gear, GearData, Side};
use mesh::{Extent, GroupNames, MeshedGear};
use std::sync::{Arc, Mutex};

use reduction::{
    GearReducer, KeptFactor, PartFault, PartStore, RECORD_VERSION, RecordError, RecordKey, ReductionOptions,
    ReductionRecord, ToothColumns, factor_bytes, read_factor, record_key,
};

struct Sample {
    geometry: Gear,
    mesh: MeshedGear,
    options: ReductionOptions,
    material: Material,
}

impl Sample {
    fn new() -> Self {
        Self::meshed(Extent::Whole)
    }

    fn meshed(extent: Extent) -> Self {
        let geometry = Gear::new(GearData { teeth: 12, bore_diameter: 16.0, ..GearData::default() }).unwrap();
        let mesh = crate::common::meshed(&geometry, 1, 2, extent);
        let options = crate::common::options(&[Side::Left], 3, 11);
        Self { geometry, mesh, options, material: Material::STEEL }
    }

    fn key(&self) -> RecordKey {
        record_key(&self.mesh, &self.geometry, &self.material, &self.options, "general")
    }

    fn stored(&self, record: ReductionRecord) -> GearReducer {
        GearReducer::from_record(self.mesh.clone(), self.material, self.options.clone(), record).unwrap()
    }

    fn reducer(&self) -> GearReducer {
        self.with_halves(GearReducer::new(self.mesh.clone(), self.material, self.options.clone()).unwrap())
    }

    fn with_halves(&self, reducer: GearReducer) -> GearReducer {
        for tooth in [11, 0, 1] {
            reducer.local_compliance(&self.geometry, tooth, Side::Left).unwrap();
        }
        reducer
    }
}

/// Record of the sample: version, digest of its code without comments, and what it holds: count, sum of sizes and sum
/// weighted by place of the numbers of a window and of a half tooth.
const RECORD: (u32, &str, usize, f64, f64) = (8, "732204def615826a", 7290, 0.0032079394506089438, 11.442760429138692);

/// A record of before must not be taken for one of today: its version goes up with what its code does.
#[test]
fn a_record_of_another_code_has_another_version() {
    let sources = [
        include_str!("../../src/record/columns.rs"),
        include_str!("../../src/record/factor.rs"),
        include_str!("../../src/record/table.rs"),
        include_str!("../../src/cyclic/blocks.rs"),
        include_str!("../../src/record/mod.rs"),
        include_str!("../../src/record/key.rs"),
        include_str!("../../src/record/read.rs"),
        include_str!("../../src/record/write.rs"),
    ];
    let mut hasher = blake3::Hasher::new();
    let lines = sources.into_iter().flat_map(str::lines).map(|line| line.split("//").next().unwrap_or_default().trim());
    // The number of the version itself is not what it is about.
    lines.filter(|line| !line.starts_with("pub const RECORD_VERSION")).for_each(|line| {
        hasher.update(line.as_bytes());
    });
    let code = hasher.finalize().to_hex()[..16].to_owned();
    let sample = Sample::new();
    let reducer = sample.reducer();
    let window = reducer.window(11).unwrap().reduced;
    let half = reducer.local_compliance(&sample.geometry, 11, Side::Left).unwrap();
    let matrices = [window.compliance(), &half.compliance];
    let numbers: Vec<f64> = matrices.iter().flat_map(|m| m.col_iter().flat_map(|c| c.iter().copied())).collect();
    let sum: f64 = numbers.iter().map(|v| v.abs()).sum();
    let weighted: f64 = numbers.iter().enumerate().map(|(i, v)| (i + 1) as f64 * v.abs()).sum();
    let found = (RECORD_VERSION, code.as_str(), numbers.len(), sum, weighted);
    // Other machines have other last bits.
    let same = |a: f64, b: f64| (a - b).abs() <= 1e-9 * b.abs();
    assert!(
        (found.0, found.1, found.2) == (RECORD.0, RECORD.1, RECORD.2)
            && same(sum, RECORD.3)
            && same(weighted, RECORD.4),
        "records are others: raise RECORD_VERSION, and write here {found:?}"
    );
}

#[test]
fn a_record_comes_back_to_the_bit() {
    let sample = Sample::new();
    let (key, reducer) = (sample.key(), sample.reducer());
    let bytes = reducer.record().unwrap().to_bytes(&key);
    let back = ReductionRecord::from_bytes(&bytes, &key).unwrap();
    assert_eq!(back.to_bytes(&key), bytes, "written again");
    let stored = sample.stored(back);
    assert!(stored.is_from_record() && !reducer.is_from_record());
    assert!(stored.record().is_none(), "nothing new to write");
    assert_eq!((stored.way(), stored.is_cyclic()), (reducer.way(), reducer.is_cyclic()));
    assert_eq!(stored.free_count(), reducer.free_count());
    let (a, b) = (stored.window(11).unwrap().reduced, reducer.window(11).unwrap().reduced);
    assert_eq!((&a.teeth, &a.sides, &a.nodes), (&b.teeth, &b.sides, &b.nodes));
    assert_eq!(a.compliance().ncols(), 3 * a.nodes.len());
    for (x, y) in a.compliance().col_iter().zip(b.compliance().col_iter()) {
        assert!(x.iter().zip(y.iter()).all(|(x, y)| x.to_bits() == y.to_bits()));
    }
    for tooth in [11, 0, 1] {
        let half = |gear: &GearReducer| gear.local_compliance(&sample.geometry, tooth, Side::Left).unwrap();
        let (a, b) = (half(&stored), half(&reducer));
        assert_eq!((&a.nodes, &a.compliance, a.overshoot), (&b.nodes, &b.compliance, b.overshoot), "tooth {tooth}");
        assert_eq!(a.layer, b.layer, "tooth {tooth}");
    }
    // A half tooth that the record does not have is condensed, and is something new to write.
    stored.local_compliance(&sample.geometry, 11, Side::Right).unwrap();
    assert!(stored.record().is_some());
}

/// The file of a factor, less the disk; it counts how often it was asked.
#[derive(Debug, Default)]
struct FactorFile(Mutex<(Option<KeptFactor>, usize)>);

impl PartStore for FactorFile {
    fn load(&self, _: u32) -> Result<Option<ToothColumns>, PartFault> {
        Ok(None)
    }

    fn save(&self, _: &ToothColumns) -> Result<(), PartFault> {
        Ok(())
    }

    fn load_factor(&self) -> Result<Option<KeptFactor>, PartFault> {
        let mut file = self.0.lock().unwrap();
        file.1 += 1;
        Ok(file.0.clone())
    }

    fn save_factor(&self, factor: &KeptFactor) -> Result<(), PartFault> {
        self.0.lock().unwrap().0 = Some(factor.clone());
        Ok(())
    }
}

/// A gear from its record recovers fields with the factor that was kept beside it, to the bit; without it, or with that of
/// another mesh, it makes its own. A file of the factor is believed after checks alone.
#[test]
fn fields_come_from_the_factor_that_was_kept() {
    let sample = Sample::new();
    let (key, reducer) = (sample.key(), sample.reducer());
    let file = Arc::new(FactorFile::default());
    let reducer = reducer.with_parts(file.clone());
    reducer.keep_parts();
    let factor = file.0.lock().unwrap().0.clone().unwrap();
    let field = |gear: &GearReducer| {
        let window = gear.window(11).unwrap();
        let u: Vec<f64> = (0..window.reduced.coordinates()).map(|i| 1e-3 * (i as f64).sin()).collect();
        gear.expand(&window, &u).unwrap()
    };
    let wanted = field(&reducer);
    let record = ReductionRecord::from_bytes(&reducer.record().unwrap().to_bytes(&key), &key).unwrap();
    let stored = sample.stored(record.clone()).with_parts(file.clone());
    assert!(field(&stored) == wanted, "fields of a kept factor");
    stored.keep_parts();
    assert_eq!(file.0.lock().unwrap().1, 1, "the factor is read once");

    let bytes = factor_bytes(&factor, &key);
    assert_eq!(read_factor(&bytes[..], bytes.len(), &key).unwrap(), factor);
    let mut damaged = bytes.clone();
    damaged[200] ^= 4;
    assert!(matches!(read_factor(&damaged[..], damaged.len(), &key), Err(RecordError::Damaged)));
    let other = Sample::meshed(Extent::Periodic).key();
    assert!(matches!(read_factor(&bytes[..], bytes.len(), &other), Err(RecordError::OtherGear)));

    for wrong in
        [KeptFactor { values: Vec::new(), ..factor.clone() }, KeptFactor { interior: factor.interior - 3, ..factor }]
    {
        let file = Arc::new(FactorFile::default());
        file.save_factor(&wrong).unwrap();
        assert!(
            field(&sample.stored(record.clone()).with_parts(file)) == wanted,
            "a factor of something else was taken"
        );
    }
}

/// The lowest frequency that a run has asked for is in the record: a later run knows it, and has nothing new to write.
#[test]
fn the_lowest_frequency_is_kept() {
    let sample = Sample::new();
    let reducer = sample.reducer();
    let hz = reducer.lowest_elastic_hz().unwrap();
    assert!((1e3..1e5).contains(&hz), "{hz} Hz");
    let bytes = reducer.record().unwrap().to_bytes(&sample.key());
    let stored = sample.stored(ReductionRecord::from_bytes(&bytes, &sample.key()).unwrap());
    assert_eq!(stored.lowest_elastic_hz().unwrap().to_bits(), hz.to_bits());
    assert!(stored.record().is_none(), "nothing new to write");
    // Of a gear that was never asked it is something new.
    let plain = sample.stored(sample.reducer().record().unwrap());
    plain.lowest_elastic_hz().unwrap();
    assert!(plain.record().is_some());
}

/// Every byte of the header and a thousand others, each with one bit turned; every length; other files.
#[test]
fn no_damage_goes_unnoticed() {
    let sample = Sample::new();
    let (key, bytes) = (sample.key(), sample.reducer().record().unwrap().to_bytes(&sample.key()));
    let mut state = 7_u64;
    let random: Vec<usize> = (0..1000)
        .map(|_| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (state >> 33) as usize % bytes.len()
        })
        .collect();
    let mut damaged = bytes.clone();
    for at in (0..92).chain(random) {
        for bit in [0, 7] {
            damaged[at] ^= 1 << bit;
            assert!(ReductionRecord::from_bytes(&damaged, &key).is_err(), "bit {bit} of byte {at} turned");
            damaged[at] = bytes[at];
        }
    }
    for length in (0..100).chain([bytes.len() / 2, bytes.len() - 1]) {
        assert!(ReductionRecord::from_bytes(&bytes[..length], &key).is_err(), "{length} bytes");
    }
    let longer = [&bytes[..], &[0]].concat();
    assert!(matches!(ReductionRecord::from_bytes(&longer, &key), Err(RecordError::WrongLength { .. })));
    assert_eq!(ReductionRecord::from_bytes(b"", &key).unwrap_err(), RecordError::Foreign);
    assert_eq!(ReductionRecord::from_bytes(&[0x7f; 4096], &key).unwrap_err(), RecordError::Foreign);
    let mut other = bytes;
    other[16] = 99;
    assert_eq!(ReductionRecord::from_bytes(&other, &key).unwrap_err(), RecordError::OtherVersion { found: 99 });
}

/// Anything that the numbers depend on makes another key, and a record of another key is refused.
#[test]
fn a_key_stands_for_one_gear() {
    let sample = Sample::new();
    let key = sample.key();
    assert_eq!(key, Sample::new().key(), "the same twice");
    let bytes = sample.reducer().record().unwrap().to_bytes(&key);
    let mut others = Vec::new();
    others.push(Sample { material: Material::new(2.06e5, 0.29, 7.85e-9).unwrap(), ..Sample::new() }.key());
    let options = ReductionOptions { window: 4, ..sample.options.clone() };
    others.push(Sample { options, ..Sample::new() }.key());
    let options = ReductionOptions { sides: vec![Side::Right], ..sample.options.clone() };
    others.push(Sample { options, ..Sample::new() }.key());
    let data = GearData { profile_shift: 1e-12, ..sample.geometry.data().clone() };
    others.push(Sample { geometry: Gear::new(data).unwrap(), ..Sample::new() }.key());
    let mut mesh = sample.mesh.mesh().clone();
    mesh.nodes[100][1] += 1e-15;
    let moved = MeshedGear::from_groups(mesh, &GroupNames::default(), 12).unwrap();
    others.push(Sample { mesh: moved, ..Sample::new() }.key());
    others.push(record_key(&sample.mesh, &sample.geometry, &sample.material, &sample.options, "cyclic"));
    for (i, other) in others.iter().enumerate() {
        assert_ne!(*other, key, "variant {i}");
        assert_eq!(ReductionRecord::from_bytes(&bytes, other).unwrap_err(), RecordError::OtherGear, "variant {i}");
    }
}

/// What is not in the record comes of condensing again, when first asked for: the same field, the same stress modes. On
/// a whole gear, on a periodic sector, and on a whole gear taken the general way.
#[test]
fn a_gear_from_a_record_answers_as_the_reduced_one() {
    let sector = Sample::meshed(Extent::Periodic);
    let whole = Sample::new();
    let general = GearReducer::general(whole.mesh.clone(), whole.material, whole.options.clone()).unwrap();
    let cases = [(&whole, whole.reducer()), (&sector, sector.reducer()), (&whole, whole.with_halves(general))];
    for (sample, reducer) in cases {
        let stored = sample.stored(reducer.record().unwrap());
        let name = format!("{}, periodic sector: {}", reducer.way().name(), sample.mesh.is_periodic_sector());
        assert_eq!(stored.gear(), reducer.gear(), "{name}");
        for first in [11, 0, 5] {
            let (mine, theirs) = (stored.window(first).unwrap(), reducer.window(first).unwrap());
            assert_eq!(
                (mine.shift, &mine.reduced.nodes),
                (theirs.shift, &theirs.reduced.nodes),
                "{name}, window {first}"
            );
            let u: Vec<f64> = (0..mine.reduced.coordinates()).map(|i| 1e-3 * (i as f64).sin()).collect();
            let fields = [stored.expand(&mine, &u), reducer.expand(&theirs, &u)].map(Result::unwrap);
            assert_eq!(fields[0], fields[1], "{name}, field of window {first}");
            assert_eq!(stored.material_nodes(&mine), reducer.material_nodes(&theirs), "{name}");
            let nodes = [3, 40, 41];
            let modes = [stored.stress_modes(&mine, &nodes), reducer.stress_modes(&theirs, &nodes)].map(Result::unwrap);
            assert_eq!(modes[0].matrix(), modes[1].matrix(), "{name}, stress modes of window {first}");
        }
    }
}
