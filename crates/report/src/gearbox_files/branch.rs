//! Periodic motions of a gearbox over its speed, as tables, numbers of the summary and a part of its page.

use analysis::{
    branch::{BranchFigures, BranchPoint},
    gearbox::{GearboxBranchResult, GearboxResult},
};
use described::Key;
use scene::gearbox::Gearbox;
use serde::Serialize;

use super::motion::{ShaftReductionSummary, reduction_summary};
use crate::{
    branch_files::{MeshOnBranch, ShownBranch, charts, lines},
    page::{Cell, Grid, Part},
};

/// The key of a branch: the speed of the input.
const KEY: &str = "input_rpm";

described::described! {
    /// Periodic motions of a gearbox over its speed, as `summary.json` has them.
    #[derive(Serialize)]
    pub(super) struct BranchSummary<'a> {
        /// figures of the branch
        #[serde(flatten)]
        figures: &'a BranchFigures,
        /// coordinates that the meshes see: the unknowns of each harmonic, all others are eliminated
        seen_coordinates: usize,
        /// meshes, in the order of the file
        meshes: Vec<MeshBranch<'a>>,
        /// shafts in motion
        reduction: ShaftReductionSummary,
    }

    /// A mesh along the branch.
    #[derive(Serialize)]
    struct MeshBranch<'a> {
        /// name of the mesh
        name: &'a str,
        /// cycles of this mesh in a period
        period_cycles: u64,
        /// mean stiffness along the normal
        mean_mesh_stiffness_n_per_um: f64,
        /// damping along the normal
        mesh_damping_n_s_per_mm: f64,
        /// largest share of the map's forces and tilts, or of the half by which a tilt may change a spring; beyond 1 the rows are not valid
        map_excess: f64,
        /// motion with the largest peak to peak of its transmission error
        largest: Option<&'a BranchPoint>,
    }
}

impl<'a> BranchSummary<'a> {
    /// Summary of a branch.
    pub fn new(result: &'a GearboxResult, branch: &'a GearboxBranchResult) -> Self {
        let mesh = |i: usize| MeshBranch {
            name: &result.meshes[i].name,
            period_cycles: branch.mesh_cycles[i],
            mean_mesh_stiffness_n_per_um: 1e-3 * branch.stiffness[i],
            mesh_damping_n_s_per_mm: branch.damping[i],
            map_excess: branch.reach[i],
            largest: branch.largest(i),
        };
        Self {
            figures: &branch.figures,
            seen_coordinates: branch.seen,
            meshes: (0..result.meshes.len()).map(mesh).collect(),
            reduction: reduction_summary(&branch.reduction),
        }
    }
}

/// Objects of the summary with their keys; the motions are those of a continuation.
pub(super) fn objects() -> [(&'static str, Vec<Key>); 2] {
    [("branch", [BranchSummary::KEYS, BranchFigures::KEYS].concat()), ("meshes, branch", MeshBranch::KEYS.to_vec())]
}

/// The branch as tables and charts take it.
pub(super) fn shown<'a>(file: &Gearbox, branch: &'a GearboxBranchResult) -> ShownBranch<'a> {
    let mesh = |(i, own): (usize, MeshOnBranch<'a>)| MeshOnBranch {
        points: branch.points.iter().map(|all| &all[i]).collect(),
        turns: branch.turns.iter().map(|all| &all[i]).collect(),
        in_time: branch.in_time.iter().map(|all| &all[i]).collect(),
        ..own
    };
    let ShownBranch { key, meshes } = without_rows(file);
    ShownBranch { key, meshes: meshes.into_iter().enumerate().map(mesh).collect() }
}

/// A branch without motions.
pub(super) fn without_rows<'a>(file: &Gearbox) -> ShownBranch<'a> {
    let mesh = |(i, own): (usize, &scene::gearbox::GearboxMesh)| MeshOnBranch {
        names: [format!("mesh_{}_", i + 1), own.name.clone()],
        ..MeshOnBranch::default()
    };
    ShownBranch { key: KEY, meshes: file.meshes.iter().enumerate().map(mesh).collect() }
}

/// Figures, meshes and charts.
pub(super) fn parts(file: &Gearbox, result: &GearboxResult) -> Vec<Part> {
    let Some(branch) = &result.branch else { return Vec::new() };
    let largest: Vec<(&str, &BranchPoint)> =
        file.meshes.iter().enumerate().filter_map(|(i, mesh)| Some((mesh.name.as_str(), branch.largest(i)?))).collect();
    let meshes = file.meshes.iter().enumerate().map(|(i, mesh)| {
        vec![
            Cell::text(&mesh.name),
            Cell::count(branch.mesh_cycles[i]),
            Cell::number(1e-3 * branch.stiffness[i], 1),
            Cell::number(branch.largest(i).map(|p| p.max_normal_force_n), 0),
            Cell::number(branch.reach[i], 2),
        ]
    });
    let head = ["mesh", "cycles a period", "mean stiffness N/um", "N at the largest DTE", "map use"];
    let note = format!(
        "By harmonic balance: {} of {} coordinates are unknowns, the others follow. Unstable motions are not seen in time.",
        branch.seen, branch.figures.coordinates
    );
    vec![
        Part::new("Periodic motions over the speed")
            .closing()
            .lines(lines(KEY, &branch.figures, &largest))
            .grid(Grid::new(head).rows(meshes))
            .note(note),
        Part::more().figures(charts(&shown(file, branch))),
    ]
}
