//! Tables of the bulk compliance that are kept with their gears.

use std::{
    collections::BTreeMap,
    sync::{Arc, Mutex},
};

use ltca::{StaticModel, StaticPosition};
use reduction::{
    ElasticGear, GearReducer, PartFault, PartStore, ReductionOptions, ReductionRecord, TableKey, ToothColumns,
    read_table, record_key, table_bytes,
};
use testing::generated;

fn positions(model: &mut StaticModel) -> Vec<StaticPosition> {
    model.run(4, 1, |_, _, _| ()).unwrap().positions
}

fn reduced(gears: &[ElasticGear; 2], i: usize) -> &GearReducer {
    let ElasticGear::Reduced(gear) = &gears[i] else { panic!("gear {i} is not reduced") };
    gear
}

/// Tables but for their part along the normals, less the disk; how often they were asked.
#[derive(Debug, Default)]
struct Files(Mutex<(BTreeMap<TableKey, Vec<f64>>, usize)>);

impl PartStore for Files {
    fn load(&self, _: u32) -> Result<Option<ToothColumns>, PartFault> {
        Ok(None)
    }

    fn save(&self, _: &ToothColumns) -> Result<(), PartFault> {
        Ok(())
    }

    fn load_table(&self, key: &TableKey) -> Result<Option<Vec<f64>>, PartFault> {
        let mut files = self.0.lock().unwrap();
        files.1 += 1;
        Ok(files.0.get(key).cloned())
    }

    fn save_table(&self, key: &TableKey, values: &[f64]) -> Result<(), PartFault> {
        self.0.lock().unwrap().0.insert(*key, values.to_vec());
        Ok(())
    }
}

/// Gears that keep their tables, and gears from files of these, give the same contact to the bit: with what contact off the
/// normals asks of them in a file beside the record, and with none, where it is made again and kept.
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
    let from_files = |files: &Arc<Files>| {
        let stored = [0, 1].map(|i| {
            let (gear, geometry) = (reduced(&gears, i), [&case.pair.pinion, &case.pair.wheel][i]);
            let (mesh, window) = (gear.gear(), options.window_teeth(&case.pair));
            let (sides, elements) = (options.contact.sides(), *gear.elements());
            let asked = ReductionOptions { sides, window, first: first_teeth[i], elements };
            let key = record_key(mesh, geometry, gear.material(), &asked, "auto");
            let record = ReductionRecord::from_bytes(&records[i].to_bytes(&key), &key).unwrap();
            for ((own, table), (other, before)) in record.tables().iter().zip(records[i].tables()) {
                assert_eq!((own, &table.normal, &table.others), (other, &before.normal, &None));
                let others = before.others.as_ref().unwrap();
                let bytes = table_bytes(own, others, &key);
                assert!(read_table(own, &bytes[..], bytes.len(), &key).unwrap() == **others, "another table");
                let damaged = [&bytes[..bytes.len() - 1], &[bytes[bytes.len() - 1] ^ 1]].concat();
                assert!(read_table(own, &damaged[..], damaged.len(), &key).is_err(), "a turned bit");
            }
            let gear = GearReducer::from_record(mesh.clone(), *gear.material(), asked, record).unwrap();
            assert!(gear.is_from_record(), "reduced anew");
            ElasticGear::Reduced(gear.with_parts(files.clone()))
        });
        positions(&mut StaticModel::new(case.pair.clone(), stored, options.clone()).unwrap())
    };
    let files = Arc::new(Files::default());
    assert!(first == from_files(&files), "tables that are made again make another contact");
    let asked = std::mem::take(&mut files.0.lock().unwrap().1);
    assert_eq!(files.0.lock().unwrap().0.len(), asked, "what was asked and not there is kept");
    assert!(first == from_files(&files), "tables from files make another contact");
    for (key, table) in records.iter().flat_map(ReductionRecord::tables) {
        let files = files.0.lock().unwrap();
        assert!(files.0.get(key).is_none_or(|kept| Some(kept) == table.others.as_deref()), "another table is kept");
    }
}
