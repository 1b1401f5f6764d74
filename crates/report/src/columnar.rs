//! `history.parquet`: the rows of `history.csv` column by column, for long runs.

use std::fs::File;
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::sync::Arc;

use answer::{properties, schema};
use parquet::data_type::DoubleType;
use parquet::errors::ParquetError;
use parquet::file::writer::SerializedFileWriter;

use crate::ReportError;

const ROWS: &str = "history.csv";
const FILE: &str = "history.parquet";
/// Rows of a group: as many as are held in memory at a time.
const GROUP: usize = 65_536;

/// Writes `history.parquet` beside `history.csv` of a folder: the same columns in the same order, each of doubles, bit
/// for bit. Rows are taken from the file, so that a run of any kind and length has them.
///
/// # Errors
/// When a file cannot be read or written.
pub fn write_parquet(folder: &Path) -> Result<(), ReportError> {
    convert(&folder.join(ROWS), &folder.join(FILE)).map_err(|cause| ReportError::Parquet { file: FILE, cause })
}

fn convert(from: &Path, to: &Path) -> Result<(), ParquetError> {
    let mut lines = BufReader::new(File::open(from)?).lines();
    let header = lines.next().transpose()?.unwrap_or_default();
    let names: Vec<(&str, bool)> = header.split(',').map(|name| (name, false)).collect();
    let mut writer =
        SerializedFileWriter::new(File::create(to)?, schema("history", &names)?, Arc::new(properties(&names)))?;
    let mut columns = vec![Vec::new(); names.len()];
    for line in lines {
        push(&mut columns, &line?)?;
        if columns[0].len() == GROUP {
            write_group(&mut writer, &mut columns)?;
        }
    }
    if !columns[0].is_empty() {
        write_group(&mut writer, &mut columns)?;
    }
    writer.close()?;
    Ok(())
}

fn push(columns: &mut [Vec<f64>], line: &str) -> Result<(), ParquetError> {
    let mut row = line.split(',');
    for column in columns {
        let value = row.next().and_then(|v| v.parse().ok());
        column.push(value.ok_or_else(|| ParquetError::General(format!("{ROWS}: no row of numbers: {line}")))?);
    }
    Ok(())
}

fn write_group(writer: &mut SerializedFileWriter<File>, columns: &mut [Vec<f64>]) -> Result<(), ParquetError> {
    let mut group = writer.next_row_group()?;
    for column in columns {
        let Some(mut to) = group.next_column()? else { break };
        to.typed::<DoubleType>().write_batch(column, None, None)?;
        to.close()?;
        column.clear();
    }
    group.close()?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use parquet::file::reader::{FileReader, SerializedFileReader};
    use parquet::record::RowAccessor;

    use super::*;

    /// Every number comes back to the bit, in the same order, over more than one group of rows.
    #[test]
    fn columns_read_back_to_the_bit() {
        let folder = tempfile::tempdir().unwrap();
        let (csv, file) = (folder.path().join(ROWS), folder.path().join(FILE));
        let rows: Vec<[f64; 3]> =
            (0..GROUP + 3).map(|i| [0.1 * i as f64, (i as f64).sin() * 1e-300, f64::NAN]).collect();
        let text: String = rows.iter().map(|r| format!("{},{:e},{}\n", r[0], r[1], r[2])).collect();
        std::fs::write(&csv, format!("time_s,dte_um,max_pressure_mpa\n{text}")).unwrap();
        convert(&csv, &file).unwrap();
        let reader = SerializedFileReader::new(File::open(&file).unwrap()).unwrap();
        let columns = reader.metadata().file_metadata().schema_descr().columns().to_vec();
        let names: Vec<&str> = columns.iter().map(|c| c.name()).collect();
        assert_eq!(names, ["time_s", "dte_um", "max_pressure_mpa"]);
        assert_eq!(reader.num_row_groups(), 2);
        let mut seen = 0;
        for (row, wanted) in reader.get_row_iter(None).unwrap().zip(&rows) {
            let row = row.unwrap();
            for (i, value) in wanted.iter().enumerate() {
                assert_eq!(row.get_double(i).unwrap().to_bits(), value.to_bits(), "row {seen}, column {i}");
            }
            seen += 1;
        }
        assert_eq!(seen, rows.len());
    }

    #[test]
    fn a_damaged_row_is_told() {
        let folder = tempfile::tempdir().unwrap();
        let csv = folder.path().join(ROWS);
        std::fs::write(&csv, "a,b\n1,2\n3\n").unwrap();
        let error = convert(&csv, &folder.path().join(FILE)).unwrap_err().to_string();
        assert!(error.contains("no row of numbers: 3"), "{error}");
    }
}
