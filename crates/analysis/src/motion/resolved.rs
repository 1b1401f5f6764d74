//! Whether the rows of a motion show what moves.

use study::unresolved_share;

/// Share of the vibration in the upper half of what rows can tell apart from which on a user should hear of it. Of
/// motions with steps as long as their rows (maps (c) and (g) of `docs/envelope.md`) all whose peak to peak is off by
/// more than a tenth lie above it.
const UNRESOLVED: f64 = 0.05;

/// Rows, or steps as long, that are too few for what moves; `samples`: the transmission error row by row over so many
/// whole mesh cycles.
pub(crate) fn unresolved(samples: &[f64], cycles: u64) -> Option<String> {
    let share = unresolved_share(samples, cycles as usize).ok().filter(|share| *share > UNRESOLVED)?;
    let rows = samples.len() as u64 / cycles.max(1);
    Some(format!(
        "{rows} rows a mesh cycle do not show all that moves: {:.0} % of the vibration lies between the mesh orders {} and {}, \
         and more may lie beyond (told from {:.0} % on); peaks fall between the rows: take more `steps_per_mesh_cycle`",
        100.0 * share,
        rows / 4,
        rows / 2,
        100.0 * UNRESOLVED
    ))
}
