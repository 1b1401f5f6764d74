//! Tables of the bulk compliance that are kept with their gears.
#![allow(clippy::print_stdout, reason = "the figures are what the test is for")]

use contact::TABLE_VERSION;
use ltca::{StaticModel, StaticPosition};
use reduction::{ElasticGear, GearReducer, ReductionOptions, ReductionRecord, record_key};
use testing::generated;

fn positions(model: &mut StaticModel) -> Vec<StaticPosition> {
    model.run(4, 1, |_, _, _| ()).unwrap().positions
}

fn reduced(gears: &[ElasticGear; 2], i: usize) -> &GearReducer {
    let ElasticGear::Reduced(gear) = &gears[i] else { panic!("gear {i} is not reduced") };
    gear
}

/// Version, and of the table of the pinion of a small pair: number, sum of sizes, sum of sizes weighted by place.
const TABLE: (u32, usize, f64, f64) = (1, 0, 0.0, 0.0);

/// Gears that keep their tables, and gears from files of these, give the same contact to the bit; who changes the code
/// so that the numbers are others has to raise the version.
#[test]
fn tables_are_those_of_their_version() {
    let case = generated(20.0, [2, 2, 2, 4, 1]);
    let options = case.slice_options();
    let mut model = case.reduced(options.clone());
    let first = positions(&mut model);
    let gears = model.into_gears();
    let again = positions(&mut StaticModel::new(case.pair.clone(), gears.clone(), options.clone()).unwrap());
    assert!(first == again, "kept tables make another contact");

    let records = [0, 1].map(|i| reduced(&gears, i).record().unwrap());
    let table = &records[0].tables()[0].1.values;
    let sum: f64 = table.iter().map(|v| v.abs()).sum();
    let weighted: f64 = table.iter().enumerate().map(|(i, v)| (i + 1) as f64 * v.abs()).sum();
    let found = (TABLE_VERSION, table.len(), sum, weighted);
    println!("{found:?}");
    // Other machines have other last bits.
    let same = |a: f64, b: f64| (a - b).abs() <= 1e-9 * b.abs();
    assert!(
        (found.0, found.1) == (TABLE.0, TABLE.1) && same(sum, TABLE.2) && same(weighted, TABLE.3),
        "tables are others: raise TABLE_VERSION in crates/contact/src/compliance/bulk_table/keep.rs, and write here {found:?}"
    );

    let first_teeth = StaticModel::first_teeth(&case.pair, &options).unwrap();
    let stored = [0, 1].map(|i| {
        let (gear, geometry) = (reduced(&gears, i), [&case.pair.pinion, &case.pair.wheel][i]);
        let (mesh, window) = (gear.gear(), options.window_teeth(&case.pair));
        let (sides, elements) = (options.contact.sides(), *gear.elements());
        let asked = ReductionOptions { sides, window, first: first_teeth[i], elements };
        let key = record_key(mesh, geometry, gear.material(), &asked, "auto");
        let record = ReductionRecord::from_bytes(&records[i].to_bytes(&key), &key).unwrap();
        assert!(record.tables() == records[i].tables(), "a file of a record has other tables");
        let gear = GearReducer::from_record(mesh.clone(), *gear.material(), asked, record).unwrap();
        assert!(gear.is_from_record(), "reduced anew");
        ElasticGear::Reduced(gear)
    });
    let from_files = positions(&mut StaticModel::new(case.pair.clone(), stored, options).unwrap());
    assert!(first == from_files, "tables from files make another contact");
}
