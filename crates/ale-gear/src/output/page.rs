//! Pages from templates.

use minijinja::{Environment, Value};

use crate::error::CommandError;

/// A template, filled in; the parts that all pages share are at hand in it.
///
/// # Errors
/// Exit status 1 if it cannot be filled; that would be a fault of this program.
pub(super) fn render(name: &str, template: &str, context: Value) -> Result<String, CommandError> {
    let failed = |e: minijinja::Error| CommandError::failed(format_args!("report.html: {e}"), None);
    let mut environment = Environment::new();
    environment.set_undefined_behavior(minijinja::UndefinedBehavior::Strict);
    environment.add_function("number", number);
    environment.add_function("science", science);
    let parts = [
        ("head.html", include_str!("head.html")),
        ("style.html", include_str!("style.html")),
        ("warnings.html", include_str!("warnings.html")),
        ("tail.html", include_str!("tail.html")),
    ];
    for (part, text) in parts {
        environment.add_template(part, text).map_err(failed)?;
    }
    environment.add_template(name, template).map_err(failed)?;
    environment.get_template(name).and_then(|page| page.render(context)).map_err(failed)
}

/// A number with so many decimals, `-` when there is none.
fn number(value: Option<f64>, decimals: usize) -> String {
    value.filter(|v| v.is_finite()).map_or_else(|| "-".to_owned(), |v| format!("{v:.decimals$}"))
}

/// A small number as power of ten, `-` when there is none.
fn science(value: Option<f64>) -> String {
    value.filter(|v| v.is_finite()).map_or_else(|| "-".to_owned(), |v| format!("{v:.1e}"))
}
