//! Laws of tables: what is written reads back to the bit, names tell the unit.

use std::sync::Arc;

use answer::{RowColumn, RowStore, Table, TableError, unit_of, write_parquet};
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::RowAccessor;

fn table() -> Table {
    Table::new("positions")
        .numbers("angle_deg", "angle", [0.1, f64::NAN, -1e-300])
        .texts("shaft", "shaft", ["fast", "a, b", "say \"so\""])
        .numbers("ste_um", "error", [1.0, 2.5e17, 0.0])
}

/// Why a block is not taken.
#[derive(Debug, PartialEq)]
struct Refused(String);

impl From<TableError> for Refused {
    fn from(e: TableError) -> Self {
        Self(e.to_string())
    }
}

fn parquet(table: &Table) -> Vec<u8> {
    let mut bytes = Vec::new();
    write_parquet(table, &mut bytes).unwrap();
    bytes
}

#[test]
fn numbers_read_back_to_the_bit_from_commas() {
    let csv = table().csv().unwrap();
    let mut lines = csv.lines();
    assert_eq!(lines.next(), Some("angle_deg,shaft,ste_um"));
    assert_eq!(lines.next(), Some("0.1,fast,1"));
    assert_eq!(lines.next(), Some("NaN,\"a, b\",2.5e17"));
    assert_eq!(lines.next(), Some("-1e-300,\"say \"\"so\"\"\",0"));
    assert_eq!(lines.next(), None);
}

/// A long file comes in blocks of whole lines, and is their sum; one that cannot be taken ends it.
#[test]
fn blocks_of_lines_are_the_file() {
    let long = Table::new("long").numbers("a", "a", (0..40_000).map(|k| 0.1 * f64::from(k)));
    let mut blocks = Vec::new();
    long.csv_in_blocks(|block| {
        blocks.push(block.to_owned());
        Ok::<_, Refused>(())
    })
    .unwrap();
    assert!(blocks.len() > 4 && blocks.iter().all(|block| block.ends_with('\n') && block.len() < 100_000));
    assert_eq!(blocks.concat(), long.csv().unwrap());
    let mut taken = 0;
    let refused = long.csv_in_blocks(|_| {
        taken += 1;
        if taken < 3 { Ok(()) } else { Err(Refused("full".to_owned())) }
    });
    assert_eq!((refused, taken), (Err(Refused("full".to_owned())), 3));
}

#[test]
fn numbers_and_texts_read_back_to_the_bit_from_parquet() {
    let table = table();
    let bytes = parquet(&table);
    let folder = tempfile_of(&bytes);
    let reader = SerializedFileReader::new(folder).unwrap();
    let columns = reader.metadata().file_metadata().schema_descr().columns().to_vec();
    let names: Vec<&str> = columns.iter().map(|c| c.name()).collect();
    assert_eq!(names, table.names().collect::<Vec<_>>());
    for (i, row) in reader.get_row_iter(None).unwrap().enumerate() {
        let row = row.unwrap();
        for (k, name) in [(0, "angle_deg"), (2, "ste_um")] {
            assert_eq!(row.get_double(k).unwrap().to_bits(), table.find(name).unwrap()[i].to_bits(), "{name} {i}");
        }
        assert_eq!(row.get_string(1).unwrap(), ["fast", "a, b", "say \"so\""][i]);
    }
    assert_eq!(reader.metadata().file_metadata().num_rows(), 3);
}

fn tempfile_of(bytes: &[u8]) -> std::fs::File {
    use std::io::{Seek, Write};
    let mut file = tempfile::tempfile().unwrap();
    file.write_all(bytes).unwrap();
    file.rewind().unwrap();
    file
}

#[test]
fn names_tell_the_unit() {
    for (name, unit) in [
        ("time_s", "s"),
        ("mean_ste_um", "um"),
        ("mesh_1_normal_force_n", "N"),
        ("torque_nm", "N m"),
        ("wheel_moment_x_nmm", "N mm"),
        ("compression_rate_um_per_s", "um/s"),
        ("line_load_n_per_mm", "N/mm"),
        ("d_ste_um_per_pinion_modification_tip_relief_um", "um/um"),
        ("lyapunov_per_s", "1/s"),
        ("iso_c_th_n_per_mm_um", "N/(mm um)"),
        ("sliding_speed_mm_s_per_rpm", "mm/s at 1/min"),
        ("stiffness_n_mm_rad", "N, mm, rad"),
        ("pinion_tilt_x_rate_urad_per_s", "urad/s"),
        ("B_minus_A_per_cent", "%"),
        ("initial_dte_rate_mm_s", "mm/s"),
        ("share_pct", "%"),
        ("steps_per_mesh_cycle", ""),
        ("mesh_cycles", ""),
        ("status", ""),
        ("residual", ""),
    ] {
        assert_eq!(unit_of(name), unit, "{name}");
    }
}

#[test]
fn a_column_that_is_not_there_is_none() {
    assert!(table().find("shaft").is_none() && table().find("nothing").is_none());
    assert_eq!((table().rows(), Table::new("empty").csv().unwrap().as_str()), (3, "\n"));
}

/// Long tables come in groups of rows, all of them.
#[test]
fn rows_of_several_groups_read_back() {
    let values: Vec<f64> = (0..65_536 + 3).map(|i| (0.1 * f64::from(i)).sin() * 1e-300).collect();
    let bytes = parquet(&Table::new("history").numbers("dte_um", "", values.clone()));
    let reader = SerializedFileReader::new(tempfile_of(&bytes)).unwrap();
    assert_eq!(reader.num_row_groups(), 2);
    let read: Vec<u64> =
        reader.get_row_iter(None).unwrap().map(|row| row.unwrap().get_double(0).unwrap().to_bits()).collect();
    assert!(read.iter().eq(values.iter().map(|v| v.to_bits()).collect::<Vec<_>>().iter()));
}

/// A table reads back from its file to the same names, bits and words; what is no such file is refused.
#[test]
fn a_table_reads_back_from_its_file() {
    let table = Table::new("t")
        .texts("way", "", ["up", "a, \"b\"\nc", ""])
        .numbers("x_um", "", [0.1 + 0.2, -1e-300, f64::INFINITY])
        .texts("label", "", ["1", "2", "three"]);
    let read = Table::read("t", &table.csv().unwrap(), 3).unwrap();
    assert_eq!(read.columns.iter().map(|c| &c.name).collect::<Vec<_>>(), ["way", "x_um", "label"]);
    assert!(read.columns.iter().zip(&table.columns).all(|(a, b)| a.values == b.values), "{read:?}");
    let nan = Table::read("t", "x\nNaN\n", 1).unwrap();
    assert!(nan.find("x").is_some_and(|x| x.len() == 1 && x[0].is_nan()));
    for (text, most) in [("a,b\n1\n", 9), ("a,a\n1,2\n", 9), ("a,b\n1,2\n", 1)] {
        let refused = Table::read("t", text, most).unwrap_err();
        assert!(refused.to_string().starts_with("t.csv: ") && !refused.hint().is_empty(), "{refused}");
    }
}

/// Rows of which most are in a file give the bytes, numbers and rows of those that are in memory.
#[test]
fn rows_in_a_file_are_the_rows() {
    type Row = (f64, Option<f64>, Vec<u32>);
    let row = |k: u32| -> Row {
        let x = (0.1 * f64::from(k)).sin();
        (if k == 7 { f64::NAN } else { x }, k.is_multiple_of(3).then_some(-0.0 * x), (0..k % 4).collect())
    };
    let count = 70_001;
    let all: Vec<Row> = (0..count).map(row).collect();
    let rows = Arc::new(RowStore::of(all.iter().cloned()).unwrap());
    assert_eq!(rows.len(), all.len());
    let bits = |row: &Row| (row.0.to_bits(), row.1.map(f64::to_bits), row.2.clone());
    let same = |a: &[Row], b: &[Row]| a.len() == b.len() && a.iter().zip(b).all(|(a, b)| bits(a) == bits(b));
    for range in [0..all.len(), 5_000..5_001, 3_000..69_999, 65_000..65_001, 70_000..70_001, 9..9] {
        assert!(same(&rows.part(range.clone()).unwrap(), &all[range.clone()]), "{range:?}");
    }
    assert!(rows.get(all.len()).unwrap().is_none());
    assert!(same(&rows.copied().unwrap().to_vec().unwrap(), &all));
    assert!(
        rows.series(1..usize::MAX, |row| row.0)
            .unwrap()
            .iter()
            .zip(&all[1..])
            .all(|(x, row)| x.to_bits() == row.0.to_bits())
    );

    let column = |name: &'static str, of: fn(&Row) -> f64| RowColumn {
        name: name.into(),
        meaning: "m".into(),
        of: Box::new(of),
    };
    let columns = vec![
        column("a_um", |row| row.0),
        column("b", |row| row.1.unwrap_or(f64::NAN)),
        column("c", |row| row.2.len() as f64),
    ];
    let numbers = |of: fn(&Row) -> f64| all.iter().map(of).collect::<Vec<f64>>();
    let held = Table::new("history")
        .numbers("a_um", "m", numbers(|row| row.0))
        .numbers("b", "m", numbers(|row| row.1.unwrap_or(f64::NAN)))
        .numbers("c", "m", numbers(|row| row.2.len() as f64));
    let kept = Table::of_rows("history", &rows, columns);
    assert_eq!((kept.rows(), kept.columns[0].unit()), (all.len(), "um".to_owned()));
    assert!(kept.csv().unwrap() == held.csv().unwrap(), "files with commas differ");
    assert!(parquet(&kept) == parquet(&held), "Parquet files differ");
    let part = kept.part(16_000..40_000, |name| name != "b").unwrap();
    assert_eq!(part.names().collect::<Vec<_>>(), ["a_um", "c"]);
    assert!(part.find("c").unwrap() == &held.find("c").unwrap()[16_000..40_000]);
    assert!(kept.find("c").is_none() && kept.in_memory().unwrap().find("c") == held.find("c"));
}
