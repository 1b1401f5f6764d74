//! Which files are written.

use serde::Serialize;

use crate::Scene;
use crate::schema::{FieldName, Model, Run};

fn is_false(value: &bool) -> bool {
    !value
}

/// What is computed on request, and which files are written beside `summary.json`, `history.csv` and `report.html`.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct OutputScene {
    /// Stress in the root fillets at every position.
    pub root_stress: bool,
    /// The contact lines slice by slice.
    pub contact_lines: bool,
    /// Every table column by column as well: `history.parquet` beside `history.csv`.
    #[serde(skip_serializing_if = "is_false")]
    pub parquet: bool,
    /// ParaView files.
    pub vtu: bool,
    /// Fields in them.
    pub fields: Vec<FieldName>,
    /// One ParaView file every so many positions.
    pub vtu_every: u32,
    /// Keys by which the history of a pair at rest is differentiated.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub derivatives: Vec<String>,
}

impl Scene {
    /// Whether an analysis can write fields for ParaView: at rest where there are meshes; in time one motion of
    /// quasi-static reduced gears, whole from beginning to end, whose forces on the flanks tell how the teeth bend.
    pub fn can_write_fields(&self) -> bool {
        let Some(motion) = &self.motion else { return self.analysis.model != Model::Iso };
        let one = matches!(motion.run, Run::Steady | Run::Shooting | Run::Span | Run::Ramp);
        let whole = motion.checkpoint_every_cycles.unwrap_or(0) == 0 && self.accuracy.is_none();
        self.analysis.model == Model::Reduced && one && whole
    }
}
