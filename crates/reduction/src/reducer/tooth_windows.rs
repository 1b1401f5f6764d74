//! Windows of a gear that is not cyclic; each selects the columns of its teeth.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError, Weak};

use faer::Mat;
use geometry::Side;

use super::{GearReducer, Method, ReductionOptions, condense::Opened};
use crate::{
    ReducedGear, ReductionError,
    general::{GeneralGear, symmetric},
    load::{Coordinates, missing},
    teeth::{KnownColumns, PartFault, ToothColumns, ToothRing},
    window::Compliance,
};

/// Windows that are kept though nobody holds them: one that slides back finds its own again.
const KEPT: usize = 3;

/// Windows but the first one, and the columns that they are made of.
#[derive(Debug, Default)]
pub(super) struct ToothWindows {
    known: Mutex<Known>,
}

#[derive(Debug, Default)]
struct Known {
    columns: KnownColumns,
    /// Windows that somebody holds, by first tooth.
    held: Vec<(u32, Weak<ReducedGear>)>,
    /// The last ones.
    last: Vec<Arc<ReducedGear>>,
}

impl ToothWindows {
    fn known(&self) -> MutexGuard<'_, Known> {
        self.known.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Known {
    fn window(&self, first: u32) -> Option<Arc<ReducedGear>> {
        self.held.iter().find(|(own, _)| *own == first)?.1.upgrade()
    }

    fn keep(&mut self, first: u32, window: &Arc<ReducedGear>) {
        self.held.retain(|(own, held)| *own != first && held.strong_count() > 0);
        self.held.push((first, Arc::downgrade(window)));
        if self.last.len() == KEPT {
            self.last.remove(0);
        }
        self.last.push(window.clone());
        self.columns.release(&window.teeth);
    }
}

impl GearReducer {
    /// Number of teeth whose columns have been solved so far, in addition to those of the first window; 0 for a cyclic
    /// gear.
    pub fn teeth_solved(&self) -> usize {
        self.asked.others.known().columns.made
    }

    /// What was wrong with files of columns since the last call.
    pub(super) fn column_faults(&self) -> Vec<PartFault> {
        std::mem::take(&mut self.asked.others.known().columns.faults)
    }

    /// The window from tooth `first` on of a gear that is not cyclic.
    pub(super) fn window_of_teeth(&self, first: u32) -> Result<Arc<ReducedGear>, ReductionError> {
        let others = &self.asked.others;
        let mut known = others.known();
        if let Some(window) = known.window(first) {
            return Ok(window);
        }
        let options = ReductionOptions { first, ..self.options.clone() };
        if let Some(bolted) = self.bolted()? {
            let opened = Opened::new(&self.gear, &self.coordinates, &options)?;
            let compliance = Compliance::Whole(bolted.compliance(&opened.loads)?);
            let window = Arc::new(opened.reduced(&options, compliance));
            known.keep(first, &window);
            return Ok(window);
        }
        let (teeth, window) = (self.gear.tooth_count(), options.window as u32);
        let ring = ToothRing { teeth, first: self.options.first % teeth, window };
        let opened = Opened::new(&self.gear, &self.coordinates, &options)?;
        let places = self.places(opened.teeth(), opened.nodes())?;
        let base = self.places(&self.base.teeth, &self.base.nodes)?;
        let (size, base_compliance) = (3 * opened.nodes().len(), self.base.compliance());
        let mut compliance = Mat::<f64>::zeros(size, size);
        for (a, b) in (0..window as usize).flat_map(|a| (a..window as usize).map(move |b| (a, b))) {
            let pair = [opened.teeth()[a], opened.teeth()[b]];
            match ring.owner(pair[0], pair[1]) {
                None => {
                    let of = pair.map(|tooth| self.base.teeth.iter().position(|&t| t == tooth));
                    let [Some(i), Some(j)] = of else { return Err(self.no_flank(pair[0])) };
                    let value = |i: usize, j: usize| base_compliance[(i, j)];
                    put(&mut compliance, [&places[a], &places[b]], |r, c| value(base[i][r], base[j][c]));
                }
                Some(owner) => {
                    let columns = self.columns(&mut known.columns, ring, owner)?;
                    let (other, ways) = if pair[1] == owner { (pair[0], [a, b]) } else { (pair[1], [b, a]) };
                    let Some(row) = columns.row(other) else { return Err(self.no_flank(other)) };
                    let to = ways.map(|w| &places[w][..]);
                    put(&mut compliance, to, |r, c| columns.compliance[(row + r, c)]);
                }
            }
        }
        let window = Arc::new(opened.reduced(&options, Compliance::Whole(compliance)));
        known.keep(first, &window);
        Ok(window)
    }

    /// Coordinates of each tooth among those of a window.
    fn places(&self, teeth: &[u32], nodes: &[u32]) -> Result<Vec<Vec<usize>>, ReductionError> {
        let mut before = 0;
        let of_tooth = |&tooth: &u32| {
            let own = self.coordinates.nodes(&self.gear, &[tooth], &self.options.sides)?;
            let at: Vec<usize> = match &self.coordinates {
                Coordinates::FlankNodes => own.iter().filter_map(|n| nodes.binary_search(n).ok()).collect(),
                Coordinates::Grids(_) => (before..before + own.len()).collect(),
            };
            before += own.len();
            Ok(at.into_iter().flat_map(|p| 3 * p..3 * p + 3).collect())
        };
        teeth.iter().map(of_tooth).collect()
    }

    /// Columns of a tooth.
    fn columns(
        &self,
        known: &mut KnownColumns,
        ring: ToothRing,
        tooth: u32,
    ) -> Result<Arc<ToothColumns>, ReductionError> {
        let loads = |t: u32| self.coordinates.loads(&self.gear, &[t], &self.options.sides);
        // A part of a gear does not have all its teeth.
        let partners: Vec<u32> = ring.partners(tooth).into_iter().filter(|&t| loads(t).is_ok()).collect();
        let of: Vec<_> = partners.iter().map(|&t| loads(t)).collect::<Result<_, _>>()?;
        let sizes: Vec<u32> = of.iter().map(|own| 3 * own.len() as u32).collect();
        let store = self.asked.parts.store();
        known.of((tooth, &partners, &sizes), store, || {
            let general = self.general_factor()?;
            let mut made = general.compliance_between(&of.concat(), &loads(tooth)?, &|| true)?;
            // The tooth's own block is symmetric but for round-off.
            let at = partners.iter().position(|&t| t == tooth).unwrap_or(0);
            let row = sizes[..at].iter().map(|&size| size as usize).sum();
            let own = symmetric(&made.as_ref().subrows(row, sizes[at] as usize).to_owned());
            made.as_mut().subrows_mut(row, own.nrows()).copy_from(&own);
            Ok(made)
        })
    }

    fn no_flank(&self, tooth: u32) -> ReductionError {
        missing(&self.gear, (tooth, self.options.sides.first().copied().unwrap_or(Side::Left)))
    }

    fn general_factor(&self) -> Result<&GeneralGear, ReductionError> {
        match self.method()? {
            Method::General(general, _) => Ok(general),
            Method::Cyclic(_) => Err(ReductionError::OtherGear),
        }
    }
}

/// A block and its mirror image, at places of rows and columns.
fn put(matrix: &mut Mat<f64>, [rows, columns]: [&[usize]; 2], value: impl Fn(usize, usize) -> f64) {
    for (c, &column) in columns.iter().enumerate() {
        for (r, &row) in rows.iter().enumerate() {
            let value = value(r, c);
            matrix[(row, column)] = value;
            matrix[(column, row)] = value;
        }
    }
}
