//! `report.html` of a chart: its pictures and its tables, which are Markdown for documents as well.

use minijinja::context;
use pulldown_cmark::{Event, Options, Parser, html::push_html};

use super::render;
use crate::{ReportError, ResultFiles};

/// Writes the page of a chart.
///
/// # Errors
/// When the system refuses, or the template cannot be filled.
pub(crate) fn write_chart_page(
    name: &str,
    pictures: &[String],
    tables: &str,
    results: &dyn ResultFiles,
) -> Result<(), ReportError> {
    let (version, pictures) = (env!("CARGO_PKG_VERSION"), pictures.to_vec());
    let context = context! { name, version, pictures, tables => html(tables) };
    results.write("report.html", render("chart.html", context)?.as_bytes())
}

/// Markdown as a part of a page; what looks like a tag, as in the name of a scene, is text.
fn html(markdown: &str) -> String {
    let plain = |event| match event {
        Event::Html(text) | Event::InlineHtml(text) => Event::Text(text),
        other => other,
    };
    let mut html = String::new();
    push_html(&mut html, Parser::new_ext(markdown, Options::ENABLE_TABLES).map(plain));
    html
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_become_tables_and_tags_stay_text() {
        let page = html("| a | b |\n|---|---:|\n| 1 | <b>2</b> |\n\n<script>alert(1)</script>\n");
        assert!(page.contains("<td>1</td>") && page.contains("&lt;b&gt;2&lt;/b&gt;"), "{page}");
        assert!(!page.contains("<script>"), "{page}");
    }
}
