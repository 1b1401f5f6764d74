//! Nodes that carry the rows. They are found on request, because tables of compliance do not need them.

use crate::{
    ContactSet, FlankPair, Pose,
    nodal::ContactRow,
    slice::{Slice, SliceHint},
};

impl ContactSet {
    /// Rows of slices with the gears' frames at `poses`; those with a force (N) have their nodes and weights.
    pub fn supported_rows(
        &self,
        poses: &[Pose; 2],
        rows: &[ContactRow],
        slices: &[Slice],
        forces: &[f64],
    ) -> Vec<ContactRow> {
        let mut rows = rows.to_vec();
        let Some(slice_set) = self.slices() else { return rows };
        let patches = [&self.patches()[0][..], &self.patches()[1][..]];
        for ((row, slice), &force) in rows.iter_mut().zip(slices).zip(forces) {
            if force != 0.0 && !row.is_supported() {
                let pair = FlankPair::new(slice_set.flanks(patches, row.patches), poses);
                pair.support(row, slice, &mut SliceHint::default());
            }
        }
        rows
    }
}
