//! Tables of the bulk compliance that are kept with their gears.

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

/// Gears that keep their tables, and gears from files of these, give the same contact to the bit.
#[test]
fn kept_tables_make_the_same_contact() {
    let case = generated(20.0, [2, 2, 2, 4, 1]);
    let options = case.slice_options();
    let mut model = case.reduced(options.clone());
    let first = positions(&mut model);
    let gears = model.into_gears();
    let again = positions(&mut StaticModel::new(case.pair.clone(), gears.clone(), options.clone()).unwrap());
    assert!(first == again, "kept tables make another contact");

    let records = [0, 1].map(|i| reduced(&gears, i).record().unwrap());
    assert!(records.iter().all(|record| !record.tables().is_empty()), "a table is not kept");

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
