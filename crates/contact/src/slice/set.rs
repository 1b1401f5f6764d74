//! The slices of a window: stations, and the half teeth behind them.

use std::sync::Arc;

use faer::Mat;
use geometry::GearPair;

use crate::{
    BulkTable, ContactOptions, Pose,
    flank::FlankPatch,
    nodal::ContactRow,
    slice::{HalfTeeth, Slice, SliceFlank},
};

/// Data of slice contact in addition to the flank patches, patch by patch of both gears.
#[derive(Debug)]
pub struct SliceSet {
    stations: Vec<f64>,
    /// Length of contact line of one slice, mm.
    length: f64,
    behind: Arc<HalfTeeth>,
}

impl SliceSet {
    /// As many slices of the common face of `pair` as the options say, with the half teeth behind them.
    pub(crate) fn new(pair: &GearPair, behind: Arc<HalfTeeth>, options: &ContactOptions) -> Self {
        let count = options.slices.max(1);
        let (width, [middle, _]) = (pair.face_width(), pair.common_middle());
        let stations = (0..count).map(|i| middle + width * ((i as f64 + 0.5) / count as f64 - 0.5)).collect();
        let length = width / count as f64 / pair.base_helix_angle().cos();
        Self { stations, length, behind }
    }

    /// Other slices with the same half teeth behind them.
    pub(crate) fn cut_anew(&self, pair: &GearPair, options: &ContactOptions) -> Self {
        Self::new(pair, Arc::clone(&self.behind), options)
    }

    /// Bulk compliance of both gears in tables; `None` if it is exact.
    pub fn bulk(&self) -> Option<&[BulkTable; 2]> {
        self.behind.bulk()
    }

    /// Length of contact line of one slice, mm.
    pub(crate) fn length(&self) -> f64 {
        self.length
    }

    /// Whether edges may press off the line of action.
    pub(crate) fn has_corner_contact(&self) -> bool {
        self.behind.has_corner_contact()
    }

    /// Whether a slice may press.
    pub(crate) fn may_touch(&self, slice: &Slice) -> bool {
        self.has_corner_contact() || slice.local.off_line == 0.0
    }

    /// Heights of the stations on the pinion, mm, ascending: those of the slices of the common face.
    pub fn stations(&self) -> &[f64] {
        &self.stations
    }

    /// One patch of each gear as slices see them.
    pub(crate) fn flanks<'a>(&'a self, patches: [&'a [FlankPatch]; 2], pair: (usize, usize)) -> [SliceFlank<'a>; 2] {
        let number = [pair.0, pair.1];
        [0, 1].map(|i| SliceFlank { patch: &patches[i][number[i]], layer: self.behind.layer(i, number[i]) })
    }

    /// Rows of the given pairs of patches, with the gears at `poses`, whose gap is at most `reach` (mm), in order of
    /// pair and height.
    pub fn rows(
        &self,
        patches: [&[FlankPatch]; 2],
        pairs: &[(usize, usize)],
        poses: &[Pose; 2],
        reach: f64,
    ) -> (Vec<ContactRow>, Vec<Slice>) {
        let of_pair = |&pair: &(usize, usize)| {
            let flanks = self.flanks(patches, pair);
            let stations = self.stations.iter().enumerate();
            stations.filter_map(move |(i, &z)| super::slice(flanks, poses, pair, i, z, self.length))
        };
        pairs.iter().flat_map(of_pair).filter(|(row, s)| row.gap <= reach && self.may_touch(s)).unzip()
    }

    /// X = - sum over both bodies of A W_c A' between rows on the same tooth, mm/N.
    pub(crate) fn correction(&self, rows: &[ContactRow]) -> Mat<f64> {
        self.behind.correction(rows)
    }
}
