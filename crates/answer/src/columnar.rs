//! A table as a Parquet file: the same columns in the same order, numbers bit for bit.

use std::{
    io::{self, Write},
    sync::Arc,
};

use parquet::basic::{Compression, ConvertedType, Encoding, Repetition, Type as Physical};
use parquet::data_type::{ByteArray, ByteArrayType, DoubleType};
use parquet::errors::ParquetError;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::{ColumnPath, Type};

use crate::{Table, TableError, Values, table::Part};

/// Rows of a group.
pub(crate) const GROUP: usize = 65_536;

/// The Parquet file of a table on its way, group by group.
pub(crate) struct ParquetFile<'a> {
    table: &'a Table,
    writer: SerializedFileWriter<&'a mut (dyn Write + Send)>,
}

impl<'a> ParquetFile<'a> {
    /// File of a table without rows.
    ///
    /// # Errors
    /// [`TableError::Parquet`] when the format refuses, [`TableError::Write`] when the system does.
    pub fn new(table: &'a Table, to: &'a mut (dyn Write + Send)) -> Result<Self, TableError> {
        let refused = |cause| refused(&table.name, cause);
        let columns: Vec<(&str, bool)> =
            table.columns.iter().map(|c| (&*c.name, matches!(c.values, Values::Texts(_)))).collect();
        let schema = schema(&table.name, &columns).map_err(refused)?;
        let writer = SerializedFileWriter::new(to, schema, Arc::new(properties(&columns))).map_err(refused)?;
        Ok(Self { table, writer })
    }

    /// Writes rows as a group.
    ///
    /// # Errors
    /// [`TableError::Parquet`] when the format refuses, [`TableError::Write`] when the system does.
    pub fn add(&mut self, parts: &[Part<'_>]) -> Result<(), TableError> {
        write_group(&mut self.writer, parts).map_err(|cause| refused(&self.table.name, cause))
    }

    /// Ends the file.
    ///
    /// # Errors
    /// [`TableError::Parquet`] when the format refuses, [`TableError::Write`] when the system does.
    pub fn end(self) -> Result<(), TableError> {
        self.writer.close().map(|_| ()).map_err(|cause| refused(&self.table.name, cause))
    }
}

/// What the library says, or the system through it.
fn refused(table: &str, cause: ParquetError) -> TableError {
    let table = table.to_owned();
    match cause {
        ParquetError::External(cause) => match cause.downcast::<io::Error>() {
            Ok(cause) => TableError::Write { table, cause: *cause },
            Err(cause) => TableError::Parquet { table, cause: ParquetError::External(cause) },
        },
        cause => TableError::Parquet { table, cause },
    }
}

fn write_group<W: Write + Send>(writer: &mut SerializedFileWriter<W>, parts: &[Part<'_>]) -> Result<(), ParquetError> {
    let mut group = writer.next_row_group()?;
    for part in parts {
        let Some(mut to) = group.next_column()? else { break };
        match part {
            Part::Numbers(list) => to.typed::<DoubleType>().write_batch(list, None, None)?,
            Part::Texts(list) => {
                let texts: Vec<ByteArray> = list.iter().map(|t| ByteArray::from(t.as_str())).collect();
                to.typed::<ByteArrayType>().write_batch(&texts, None, None)?
            }
        };
        to.close()?;
    }
    group.close().map(|_| ())
}

/// How all Parquet files of this program are written; columns as [`schema`] takes them.
fn properties(columns: &[(&str, bool)]) -> WriterProperties {
    let properties = WriterProperties::builder()
        .set_compression(Compression::SNAPPY)
        .set_dictionary_enabled(false)
        // Bytes of like weight beside each other: neighbours of a curve share the leading ones.
        .set_encoding(Encoding::BYTE_STREAM_SPLIT);
    let texts = columns.iter().filter(|(_, is_text)| *is_text);
    texts.fold(properties, |all, (name, _)| all.set_column_encoding(ColumnPath::from(*name), Encoding::PLAIN)).build()
}

/// Schema of rows with these columns: a name, and whether it holds texts.
///
/// # Errors
/// When a name is none that the format takes.
fn schema(rows: &str, columns: &[(&str, bool)]) -> Result<Arc<Type>, ParquetError> {
    let column = |(name, is_text): &(&str, bool)| {
        let physical = if *is_text { Physical::BYTE_ARRAY } else { Physical::DOUBLE };
        let of = Type::primitive_type_builder(name, physical).with_repetition(Repetition::REQUIRED);
        let of = if *is_text { of.with_converted_type(ConvertedType::UTF8) } else { of };
        of.build().map(Arc::new)
    };
    let fields = columns.iter().map(column).collect::<Result<Vec<_>, _>>()?;
    Ok(Arc::new(Type::group_type_builder(rows).with_fields(fields).build()?))
}
