//! `ale-gear schema`: files of keys for editors.

use clap::ValueEnum;
use scene::{gearbox::Gearbox, json_schema};

/// Words of `ale-gear schema`.
#[derive(Debug, clap::Args)]
pub(super) struct SchemaArgs {
    /// Which kind of file
    #[arg(value_enum, default_value_t = Document::Scene)]
    document: Document,
}

/// Kinds of file that have a schema.
#[derive(Debug, Clone, Copy, ValueEnum)]
enum Document {
    /// The scene of a pair
    Scene,
    /// Shafts, bearings and meshes
    Gearbox,
}

impl SchemaArgs {
    /// JSON Schema of the file.
    pub(super) fn execute(self) -> String {
        let schema = match self.document {
            Document::Scene => json_schema(),
            Document::Gearbox => Gearbox::json_schema(),
        };
        format!("{schema:#}\n")
    }
}
