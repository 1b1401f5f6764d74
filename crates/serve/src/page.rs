//! The page itself.

use std::path::Path;

use minijinja::{context, value::Serde};
use report::{
    ReportError,
    page::{render_own, scripts},
};

use scene::{Document, DocumentKind};

use crate::form::form;

/// What draws answers and sends moves.
pub(crate) const SCRIPT: &str = include_str!("page/page.js");

/// The page of a scene's text; `number` is told with every move.
///
/// # Errors
/// [`ReportError`] if the template cannot be filled; that would be a fault of this program.
pub(crate) fn html((text, file): (&str, &Path), number: u64) -> Result<String, ReportError> {
    let file = file.file_name().map_or_else(|| "scene.toml".into(), |name| name.to_string_lossy());
    let is_gearbox = Document::new(text.to_owned(), Path::new("")).base_kind() == Some(DocumentKind::Gearbox);
    let context = context! {
        is_gearbox => is_gearbox,
        version => env!("CARGO_PKG_VERSION"),
        text => text,
        file => file,
        number => number,
        form => Serde(form()),
        view => "",
    };
    render_own(include_str!("page/page.html"), context)
}

/// How it looks.
pub(crate) fn style() -> String {
    format!("{}\n{}\n{}", scripts::STYLE, scripts::UPLOT_STYLE, include_str!("page/page.css"))
}
