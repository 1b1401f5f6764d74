//! Pages from templates, with all that their scripts need.

use std::sync::LazyLock;

use minijinja::{Environment, Value};

use super::{markdown::markdown, scripts};
use crate::ReportError;

/// The template of this name, filled in; the parts that all pages share are at hand in it, and scripts are put in where
/// the page has work for them.
///
/// # Errors
/// [`ReportError::Page`] if it cannot be filled; that would be a fault of this program.
pub fn render(name: &str, context: Value) -> Result<String, ReportError> {
    filled(|parts| parts.get_template(name)?.render(context)).map(with_scripts)
}

/// A template of a caller, filled in, with the same parts at hand; its scripts are the caller's business.
///
/// # Errors
/// As [`render`].
pub fn render_own(template: &str, context: Value) -> Result<String, ReportError> {
    filled(|parts| parts.render_named_str("own.html", template, context))
}

fn filled(fill: impl FnOnce(&Environment<'static>) -> Result<String, minijinja::Error>) -> Result<String, ReportError> {
    static PARTS: LazyLock<Result<Environment<'static>, String>> =
        LazyLock::new(|| environment().map_err(|e| e.to_string()));
    let failed = |cause: String| ReportError::Page { file: "report.html", cause };
    let parts = PARTS.as_ref().map_err(|e| failed(e.clone()))?;
    fill(parts).map_err(|e| failed(e.to_string()))
}

/// All templates, and what they call.
fn environment() -> Result<Environment<'static>, minijinja::Error> {
    let mut environment = Environment::new();
    environment.set_undefined_behavior(minijinja::UndefinedBehavior::Strict);
    environment.add_filter("markdown", markdown);
    environment.add_filter("code", code);
    environment.add_filter("breaks", breaks);
    environment.add_function("number", number);
    environment.add_function("science", science);
    let parts = [
        ("gearbox_view.html", include_str!("gearbox_view.html")),
        ("head.html", include_str!("head.html")),
        ("style.html", include_str!("style.html")),
        ("style.css", scripts::STYLE),
        ("remarks.html", include_str!("remarks.html")),
        ("parts.html", include_str!("parts.html")),
        ("view.html", include_str!("view.html")),
    ];
    for (part, text) in parts {
        environment.add_template(part, text)?;
    }
    Ok(environment)
}

/// The page with the scripts that its parts ask for: charts and maps, gears or a gearbox in space.
fn with_scripts(mut page: String) -> String {
    let has = |class: &str| page.contains(&format!("class=\"{class}\">"));
    let mut scripts = String::new();
    // The part that holds the picture is a `view` on both pages.
    let in_space = [("gearbox", scripts::GEARBOX), ("view", scripts::VIEW)].into_iter().find(|(class, _)| has(class));
    if in_space.is_some() || has("plot") || has("map") || has("chart") {
        let [style, uplot, charts] = [scripts::UPLOT_STYLE, scripts::UPLOT, scripts::CHARTS];
        scripts += &format!("<style>{style}</style>\n");
        scripts += &format!("<script>{uplot}</script>\n<script>{charts}</script>\n");
    }
    if has("sortable") {
        scripts += &format!("<script>{}</script>\n", scripts::SORT);
    }
    if let Some((_, view)) = in_space {
        scripts += &format!("<script>{}</script>\n<script>{view}</script>\n", scripts::THREE);
    }
    if let Some(end) = page.rfind("</body>") {
        page.insert_str(end, &scripts);
    }
    page
}

/// A text as a page has it: nothing in it is a tag.
pub fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

/// A text whose parts between backticks are code.
fn code(text: &str) -> Value {
    let mut html = String::new();
    for (i, part) in escaped(text).split('`').enumerate() {
        let is_code = i % 2 == 1;
        html += if is_code { "<code>" } else { "" };
        html += part;
        html += if is_code { "</code>" } else { "" };
    }
    Value::from_safe_string(html)
}

/// A text whose keys may go on in the next line behind a dot or an underscore; text without a key stays.
fn breaks(text: &str) -> Value {
    let text = escaped(text);
    let is_key = text.contains('_');
    Value::from_safe_string(if is_key { text.replace('_', "_<wbr>").replace('.', ".<wbr>") } else { text })
}

/// A number with so many decimals, `-` when there is none.
fn number(value: Option<f64>, decimals: usize) -> String {
    value.filter(|v| v.is_finite()).map_or_else(|| "-".to_owned(), |v| format!("{v:.decimals$}"))
}

/// A small number as power of ten, `-` when there is none.
fn science(value: Option<f64>) -> String {
    value.filter(|v| v.is_finite()).map_or_else(|| "-".to_owned(), |v| format!("{v:.1e}"))
}
