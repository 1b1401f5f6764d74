//! Editions of the standard.

use serde::Serialize;

/// Edition of ISO 6336.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub enum Edition {
    /// ISO 6336:2019.
    #[serde(rename = "iso-2019")]
    Iso2019,
    /// ISO 6336:2006.
    #[serde(rename = "iso-2006")]
    Iso2006,
}
