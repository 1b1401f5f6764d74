//! File with the columns of one tooth.

use super::{
    COLUMNS, RecordError, RecordKey,
    read::opened,
    write::{list, matrix, sealed},
};
use crate::ToothColumns;

impl ToothColumns {
    /// The content of a file: header as for [`crate::ReductionRecord`], then tooth, teeth of the blocks, coordinates of
    /// each, matrix.
    pub fn to_bytes(&self, key: &RecordKey) -> Vec<u8> {
        let size = 8 * self.compliance.nrows() * self.compliance.ncols() + 8 * self.partners.len() + 64;
        sealed(COLUMNS, key, size, |bytes| {
            bytes.extend(self.tooth.to_le_bytes());
            list(bytes, &self.partners);
            list(bytes, &self.sizes);
            matrix(bytes, &self.compliance);
        })
    }

    /// Reads the columns from the bytes of a file, if they belong to the gear of `key`.
    ///
    /// # Errors
    /// [`RecordError`]: any changed, missing or added byte is detected.
    pub fn from_bytes(bytes: &[u8], key: &RecordKey) -> Result<Self, RecordError> {
        Self::read(bytes, bytes.len(), key)
    }

    /// Reads the columns from a file of `length` bytes, if they belong to the gear of `key`.
    ///
    /// # Errors
    /// Those of [`ToothColumns::from_bytes`]; [`RecordError::Unreadable`].
    pub fn read(from: impl std::io::Read, length: usize, key: &RecordKey) -> Result<Self, RecordError> {
        opened(from, length, (COLUMNS, key), |cursor| {
            let tooth = cursor.count()? as u32;
            let (partners, sizes) = (cursor.list()?, cursor.list()?);
            let own = partners.binary_search(&tooth).ok().and_then(|at| sizes.get(at));
            let Some(own) = own.filter(|_| partners.len() == sizes.len() && partners.is_sorted_by(|a, b| a < b)) else {
                return Err(cursor.wrong("teeth that do not fit together"));
            };
            let rows = sizes.iter().map(|&size| size as usize).sum();
            let compliance = cursor.matrix((rows, *own as usize))?;
            Ok(Self { tooth, partners, sizes, compliance })
        })
    }
}
