//! Branches of periodic motions as tables, charts and lines: of a pair, and of each mesh of a gearbox.

mod charts;
mod lines;
mod tables;

use analysis::branch::{BranchPoint, BranchTurn, TimePoint};

pub(crate) use charts::{charts, picture};
pub(crate) use lines::{lines, six_digits};
pub(crate) use tables::tables;

/// A branch as files and pages show it.
#[derive(Debug, Clone)]
pub(crate) struct ShownBranch<'a> {
    /// Key that is varied: the name of its column.
    pub key: &'static str,
    /// Meshes.
    pub meshes: Vec<MeshOnBranch<'a>>,
}

/// A mesh along a branch.
#[derive(Debug, Clone, Default)]
pub(crate) struct MeshOnBranch<'a> {
    /// What its columns begin with, and its charts end with; empty where there is one mesh.
    pub names: [String; 2],
    /// Motions in the order of the branch.
    pub points: Vec<&'a BranchPoint>,
    /// Bifurcations.
    pub turns: Vec<&'a BranchTurn>,
    /// Motions integrated in time.
    pub in_time: Vec<&'a TimePoint>,
}

impl<'a> ShownBranch<'a> {
    /// The branch of a pair.
    pub fn of_pair(
        key: &'static str,
        points: &'a [BranchPoint],
        turns: &'a [BranchTurn],
        in_time: &'a [TimePoint],
    ) -> Self {
        let mesh = MeshOnBranch {
            names: Default::default(),
            points: points.iter().collect(),
            turns: turns.iter().collect(),
            in_time: in_time.iter().collect(),
        };
        Self { key, meshes: vec![mesh] }
    }
}
