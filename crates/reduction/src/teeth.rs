//! Compliance between the teeth of a gear that is not cyclic: the columns of each tooth are computed once, however many
//! windows contain it.
//!
//! ```text
//! C_ts = P_t' K^-1 P_s      displacements of tooth t under unit forces on tooth s, mm/N
//! ```
//! A window's compliance consists of blocks for pairs of its teeth. The first window comes directly from the factor.
//! Any other block belongs to the columns of the tooth that is further from the first window. So a window that is one
//! tooth further needs only the columns of the oncoming tooth, and neighbouring windows have identical numbers for the
//! teeth that they share. No number depends on earlier requests.

use std::sync::Arc;

use faer::Mat;
use fem::KeptFactor;

use crate::TableKey;

/// Teeth around a gear, and the first window of them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct ToothRing {
    /// Teeth of the gear.
    pub teeth: u32,
    /// First tooth of the first window.
    pub first: u32,
    /// Teeth of a window.
    pub window: u32,
}

impl ToothRing {
    /// Teeth from one to another, the shorter way round.
    fn apart(self, a: u32, b: u32) -> u32 {
        let on = (a + self.teeth - b % self.teeth) % self.teeth;
        on.min(self.teeth - on)
    }

    /// Teeth from the first window to a tooth, the shorter way round; 0 for those in it.
    fn beyond(self, tooth: u32) -> u32 {
        let on = (tooth + self.teeth - self.first % self.teeth) % self.teeth;
        if on < self.window { 0 } else { (on + 1 - self.window).min(self.teeth - on) }
    }

    /// The tooth whose columns contain the block of two teeth: the one further from the first window, or the one with
    /// the higher number if both are equally far. `None` if the block belongs to the first window.
    pub fn owner(self, a: u32, b: u32) -> Option<u32> {
        let (beyond, tooth) = [a, b].map(|t| (self.beyond(t), t)).into_iter().max()?;
        (beyond > 0).then_some(tooth)
    }

    /// Teeth of the blocks among the columns of a tooth, ascending, including the tooth itself.
    pub fn partners(self, tooth: u32) -> Vec<u32> {
        let mine = |&t: &u32| self.apart(t, tooth) < self.window && self.owner(t, tooth) == Some(tooth);
        (0..self.teeth).filter(mine).collect()
    }
}

/// Columns of one tooth in the compliance of a gear.
#[derive(Debug, Clone, PartialEq)]
pub struct ToothColumns {
    /// Tooth on which the unit forces act.
    pub tooth: u32,
    /// Teeth of the blocks, ascending.
    pub partners: Vec<u32>,
    /// Number of coordinates of each of these teeth.
    pub sizes: Vec<u32>,
    /// Blocks, one below the other, mm/N.
    pub compliance: Mat<f64>,
}

impl ToothColumns {
    /// First row of a tooth's block.
    pub(crate) fn row(&self, partner: u32) -> Option<usize> {
        let at = self.partners.binary_search(&partner).ok()?;
        Some(self.sizes[..at].iter().map(|&size| size as usize).sum())
    }

    /// Whether they are those of these teeth, of so many coordinates each.
    pub(crate) fn fit(&self, tooth: u32, partners: &[u32], sizes: &[u32]) -> bool {
        let own = partners.iter().position(|&t| t == tooth).map(|at| sizes[at] as usize);
        let rows: usize = sizes.iter().map(|&size| size as usize).sum();
        self.tooth == tooth
            && self.partners == partners
            && self.sizes == sizes
            && (Some(self.compliance.ncols()), self.compliance.nrows()) == (own, rows)
    }
}

/// Store for parts of a gear beside its record: columns of its teeth, stored as soon as they are computed so that an
/// interrupted run does not lose them; the factor of its sector; the parts of tables that contact along the normals
/// does not need.
pub trait PartStore: std::fmt::Debug + Send + Sync {
    /// Columns of a tooth, if they are stored.
    ///
    /// # Errors
    /// [`PartFault`] if the file cannot be used.
    fn load(&self, tooth: u32) -> Result<Option<ToothColumns>, PartFault>;

    /// Stores the columns of a tooth.
    ///
    /// # Errors
    /// [`PartFault`] if they cannot be stored.
    fn save(&self, columns: &ToothColumns) -> Result<(), PartFault>;

    /// The factor of the sector, if it is stored. A store need not keep it.
    ///
    /// # Errors
    /// The errors of [`PartStore::load`].
    fn load_factor(&self) -> Result<Option<KeptFactor>, PartFault> {
        Ok(None)
    }

    /// Stores the factor of the sector.
    ///
    /// # Errors
    /// The errors of [`PartStore::save`].
    fn save_factor(&self, _: &KeptFactor) -> Result<(), PartFault> {
        Ok(())
    }

    /// The part of a table that is not for the normals, if it is stored. A store need not keep it.
    ///
    /// # Errors
    /// The errors of [`PartStore::load`].
    fn load_table(&self, _: &TableKey) -> Result<Option<Vec<f64>>, PartFault> {
        Ok(None)
    }

    /// Stores the part of a table that is not for the normals.
    ///
    /// # Errors
    /// The errors of [`PartStore::save`].
    fn save_table(&self, _: &TableKey, _: &[f64]) -> Result<(), PartFault> {
        Ok(())
    }
}

/// A fault of a part's file. No result depends on it, because the part is computed again.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{file}: {what}")]
pub struct PartFault {
    /// Name of the file.
    pub file: String,
    /// Description of the fault.
    pub what: String,
    /// Whether the fault occurred while writing.
    pub writing: bool,
}

/// Columns that are at hand.
#[derive(Debug, Default)]
pub(crate) struct KnownColumns {
    /// By tooth; whether a store has them too.
    columns: Vec<(Arc<ToothColumns>, bool)>,
    /// Faults of the store.
    pub faults: Vec<PartFault>,
    /// Teeth whose columns were made by solves.
    pub made: usize,
}

impl KnownColumns {
    /// Columns of a tooth: from memory, from the store, or computed.
    pub fn of<E>(
        &mut self,
        (tooth, partners, sizes): (u32, &[u32], &[u32]),
        store: Option<&dyn PartStore>,
        make: impl FnOnce() -> Result<Mat<f64>, E>,
    ) -> Result<Arc<ToothColumns>, E> {
        if let Some((found, _)) = self.columns.iter().find(|(c, _)| c.tooth == tooth) {
            return Ok(found.clone());
        }
        let stored = store.map(|store| store.load(tooth)).transpose();
        let stored = stored.unwrap_or_else(|fault| {
            self.faults.push(fault);
            None
        });
        if let Some(found) = stored.flatten().filter(|c| c.fit(tooth, partners, sizes)) {
            return Ok(self.keep(found, true));
        }
        let compliance = make()?;
        self.made += 1;
        let made = ToothColumns { tooth, partners: partners.to_vec(), sizes: sizes.to_vec(), compliance };
        let saved = store.map(|store| store.save(&made)).transpose();
        let saved = saved.unwrap_or_else(|fault| {
            self.faults.push(fault);
            None
        });
        Ok(self.keep(made, saved.is_some()))
    }

    fn keep(&mut self, columns: ToothColumns, stored: bool) -> Arc<ToothColumns> {
        let columns = Arc::new(columns);
        self.columns.push((columns.clone(), stored));
        columns
    }

    /// Frees the columns that a store has and none of these teeth needs.
    pub fn release(&mut self, teeth: &[u32]) {
        self.columns.retain(|(c, stored)| !stored || teeth.contains(&c.tooth));
    }
}
