//! Keys on which neither meshes nor matrices depend, and scenes that differ in one of them.

use std::sync::Arc;

use crate::{Document, OutputScene, Scene, SceneError, Setting};

impl Scene {
    /// Whether a key belongs to micro-geometry or misalignment.
    pub fn is_design_key(key: &str) -> bool {
        key.contains(".modification.") || key.starts_with("pair.misalignment.")
    }

    /// A step of such a key that moves flanks by about 1e-5 mm, for differences; in the unit of the key.
    pub fn design_step(key: &str) -> f64 {
        if key.ends_with("_um") { 0.01 } else { 1e-3 }
    }

    /// This scene with another value of a key; for a modification of both flanks, on the driving ones. The new scene
    /// requests no derivatives.
    ///
    /// # Errors
    /// [`SceneError`] if the scene does not permit the value.
    pub fn with_number(&self, key: &str, value: f64) -> Result<Self, SceneError> {
        let mut parts: Vec<&str> = key.split('.').collect();
        let of_flank = parts.get(1) == Some(&"modification");
        if of_flank && !parts.get(2).is_some_and(|part| *part == "drive" || *part == "coast") {
            parts.insert(2, "drive");
        }
        let own = Self { output: OutputScene { derivatives: Vec::new(), ..self.output.clone() }, ..self.clone() };
        let setting = Setting::number(&parts.join("."), value)?;
        let (origin, files) = (self.written.origin(), Arc::clone(self.written.files()));
        let scene = Document::made(own.to_toml(), &self.file, origin, files).scene(&[setting])?;
        Ok(Self { set: self.set.clone(), ..scene })
    }
}
