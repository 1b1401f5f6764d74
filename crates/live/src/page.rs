//! The page itself.

use std::path::Path;

use minijinja::{Value, context, value::Serde};
use report::{
    ReportError,
    page::{render_own, scripts},
};

use scene::{Document, DocumentKind};

use crate::form::form;

/// What draws answers and sends moves.
pub const SCRIPT: &str = include_str!("page/page.js");
/// What answers moves in the browser itself.
const SOLVER: &str = include_str!("page/solver.js");

/// Who answers the moves of a page.
#[derive(Debug, Clone, Copy)]
pub enum Answers<'a> {
    /// What serves it; the number of the page is told with every move, scripts and style are files beside it.
    Server(u64),
    /// The page itself, which is one file.
    Page(Program<'a>),
}

/// The program that answers in a browser: crate `browser`.
#[derive(Debug, Clone, Copy)]
pub struct Program<'a> {
    /// Script that calls it: `wasm_bindgen({ module_or_path })` loads it, `wasm_bindgen.answer(text)` answers a move.
    pub calls: &'a str,
    /// WebAssembly, gzip, base64.
    pub code: &'a str,
}

/// The page of a scene's text.
///
/// # Errors
/// [`ReportError`] if the template cannot be filled; that would be a fault of this program.
pub fn html((text, file): (&str, &Path), answers: Answers<'_>) -> Result<String, ReportError> {
    let file = file.file_name().map_or_else(|| "scene.toml".into(), |name| name.to_string_lossy());
    let is_gearbox = Document::new(text.to_owned(), Path::new("")).base_kind() == Some(DocumentKind::Gearbox);
    let (number, inline) = match answers {
        Answers::Server(number) => (number, Value::from(())),
        Answers::Page(Program { calls, code }) => {
            let scripts = [scripts::UPLOT, scripts::CHARTS, scripts::THREE, scripts::VIEW, SOLVER, SCRIPT];
            (0, context! { style => style(), scripts => scripts, calls => calls, code => code })
        }
    };
    let context = context! {
        inline => inline,
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
pub fn style() -> String {
    format!("{}\n{}\n{}", scripts::STYLE, scripts::UPLOT_STYLE, include_str!("page/page.css"))
}
