//! Tables of a branch.

use analysis::branch::{BranchPoint, LossName};
use answer::Table;

use super::{MeshOnBranch, ShownBranch};

/// `branch`: one row a motion, in the order of the branch; `bifurcations`: one row a fold, period doubling or torus
/// bifurcation; `in_time`: one row a motion that was integrated in time.
pub(crate) fn tables(branch: &ShownBranch<'_>) -> [Table; 3] {
    let motions = of_branch(Table::new("branch"), branch, |mesh| mesh.points.clone());
    [motions, bifurcations(branch), in_time(branch)]
}

/// Columns of motions along a branch: of the whole, then of each mesh, then of the solution.
fn of_branch<'a>(
    mut table: Table,
    branch: &ShownBranch<'a>,
    points: impl Fn(&MeshOnBranch<'a>) -> Vec<&'a BranchPoint>,
) -> Table {
    let whole = branch.meshes.first().map(&points).unwrap_or_default();
    let push = |table: &mut Table, name: String, meaning: &'static str, of: &dyn Fn(&BranchPoint) -> f64| {
        table.push_numbers(name, meaning, whole.iter().map(|p| of(p)));
    };
    push(&mut table, branch.key.into(), "value of the key", &|p| p.value);
    let meaning = "stability: 1 disturbances fade; 0 they grow, and no run in time shows this motion";
    push(&mut table, "stable".into(), meaning, &|p| f64::from(u8::from(p.is_stable)));
    let meaning = "size of the largest Floquet multiplier, the growth of a disturbance in a period; the free rotation of the gears is left out";
    push(&mut table, "largest_multiplier".into(), meaning, &|p| p.largest_multiplier);
    for mesh in &branch.meshes {
        let own = points(mesh);
        let mut push = |name: &str, meaning: &'static str, of: &dyn Fn(&BranchPoint) -> f64| {
            table.push_numbers(format!("{}{name}", mesh.names[0]), meaning, own.iter().map(|p| of(p)));
        };
        push("mean_dte_um", "mean dynamic transmission error of the period", &|p| p.mean_dte_um);
        push("peak_to_peak_dte_um", "peak to peak of the dynamic transmission error of the period", &|p| {
            p.peak_to_peak_dte_um
        });
        push("rms_dte_um", "root mean square of the dynamic transmission error about its mean", &|p| p.rms_dte_um);
        for k in 0..5 {
            let meaning = "amplitude of a mesh harmonic of the dynamic transmission error, 1 to 5";
            push(&format!("dte_harmonic_{}_um", k + 1), meaning, &|p| p.dte_harmonics_um[k]);
        }
        push("min_normal_force_n", "smallest normal force on the driving flanks", &|p| p.min_normal_force_n);
        push("max_normal_force_n", "largest normal force on the driving flanks", &|p| p.max_normal_force_n);
        push("share_apart", "share of the period in which the driving flanks do not press", &|p| p.share_apart);
    }
    push(&mut table, "harmonics".into(), "harmonics of the period that the motion is made of", &|p| p.harmonics as f64);
    push(&mut table, "newton_steps".into(), "Newton steps of the motion", &|p| p.newton_steps as f64);
    push(&mut table, "residual".into(), "residual of the balance of forces, over the forces", &|p| p.residual);
    let meaning = "estimate of the vibration that further harmonics would add, over the vibration";
    push(&mut table, "tail".into(), meaning, &|p| p.tail);
    table
}

fn bifurcations(branch: &ShownBranch<'_>) -> Table {
    let name = |loss: LossName| match loss {
        LossName::Fold => "fold",
        LossName::PeriodDoubling => "period-doubling",
        LossName::Torus => "torus",
    };
    let turns = branch.meshes.first().map(|mesh| &mesh.turns[..]).unwrap_or_default();
    let kinds = turns.iter().map(|turn| name(turn.loss));
    let table = Table::new("bifurcations").texts(
        "bifurcation",
        "kind of bifurcation: `fold`, `period-doubling` or `torus`",
        kinds,
    );
    of_branch(table, branch, |mesh| mesh.turns.iter().map(|turn| &turn.point).collect())
}

fn in_time(branch: &ShownBranch<'_>) -> Table {
    let first = branch.meshes.first().map(|mesh| &mesh.in_time[..]).unwrap_or_default();
    let mut table = Table::new("in_time").numbers(branch.key, "value of the key", first.iter().map(|p| p.value));
    for mesh in &branch.meshes {
        let meaning = "peak to peak of the dynamic transmission error, integrated in time";
        let values = mesh.in_time.iter().map(|p| p.peak_to_peak_dte_um);
        table.push_numbers(format!("{}peak_to_peak_dte_um", mesh.names[0]), meaning, values);
        let meaning = "peak to peak of the dynamic transmission error of the motion of the branch";
        let values = mesh.in_time.iter().map(|p| p.branch_peak_to_peak_dte_um);
        table.push_numbers(format!("{}branch_peak_to_peak_dte_um", mesh.names[0]), meaning, values);
    }
    table
}
