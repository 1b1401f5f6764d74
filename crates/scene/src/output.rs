//! Output files to be written.

use crate::Scene;
use crate::schema::{Model, OutputScene, Run};

impl OutputScene {
    /// Whether Parquet files are asked for, as a scene file states it: nothing where they are not.
    pub(crate) fn written_parquet(&self) -> Option<bool> {
        self.parquet.then_some(true)
    }
}

impl Scene {
    /// Whether an analysis can write fields for ParaView. In statics it needs meshes. In time it must be one
    /// uninterrupted motion of quasi-static reduced gears, because then the forces on the flanks determine the
    /// deflection of the teeth.
    pub fn can_write_fields(&self) -> bool {
        let Some(motion) = &self.motion else { return self.analysis.model != Model::Iso };
        let one = matches!(motion.run, Run::Steady | Run::Shooting | Run::Span | Run::Ramp);
        let whole = motion.checkpoint_every_cycles.unwrap_or(0) == 0 && self.accuracy.is_none();
        self.analysis.model == Model::Reduced && one && whole
    }
}
