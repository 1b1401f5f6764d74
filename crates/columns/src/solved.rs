//! The rows of a solved scene of any kind.

use analysis::{
    Solved, SolvedAtRest,
    in_time::{SolvedInTime, TimeAnswer},
};
use answer::TableError;
use study::Columns;

use super::{MOTION_HISTORY, history_rows, lumped_columns};

/// The rows of `history.csv` as columns by name; none of many motions, which have no rows over time.
///
/// # Errors
/// [`TableError::Kept`] where rows cannot be read back.
pub fn solved_rows(solved: &Solved) -> Result<Columns, TableError> {
    Ok(match solved {
        Solved::AtRest(solved) => {
            let SolvedAtRest { scene, history, derivatives } = &**solved;
            history_rows(scene, history, derivatives.as_ref())
        }
        Solved::InTime(solved) => {
            let SolvedInTime { scene, answer } = &**solved;
            match answer {
                TimeAnswer::Motion(result) => {
                    let pairs: Vec<i64> = result.layout.pairs().collect();
                    MOTION_HISTORY.sheet(&result.layout, &pairs).columns(&result.layout, &result.rows)?
                }
                TimeAnswer::Lumped(result) => lumped_columns(scene, &result.rows)?,
                TimeAnswer::Speeds(_)
                | TimeAnswer::LumpedSpeeds { .. }
                | TimeAnswer::Branch(_)
                | TimeAnswer::Basins(_) => Columns::default(),
            }
        }
    })
}
