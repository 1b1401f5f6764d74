//! Tables of a document as a part of a page.

use minijinja::Value;
use pulldown_cmark::{Event, Options, Parser, html::push_html};

/// Markdown as a part of a page; what looks like a tag, as in the name of a scene, is text.
pub(super) fn markdown(text: &str) -> Value {
    Value::from_safe_string(html(&answer::shown_units(text)))
}

fn html(markdown: &str) -> String {
    let plain = |event| match event {
        Event::Html(text) | Event::InlineHtml(text) => Event::Text(text),
        other => other,
    };
    let mut html = String::new();
    push_html(&mut html, Parser::new_ext(markdown, Options::ENABLE_TABLES).map(plain));
    // A wide table scrolls by itself, as all tables of a page do. Text has no such tags: it is escaped.
    html.replace("<table>", "<div class=\"scroll\"><table>").replace("</table>", "</table></div>")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_become_tables_and_tags_stay_text() {
        let page = html("| a | b |\n|---|---:|\n| 1 | <b>2</b> |\n\n<script>alert(1)</script>\n");
        assert!(page.contains("<td>1</td>") && page.contains("&lt;b&gt;2&lt;/b&gt;"), "{page}");
        assert!(!page.contains("<script>"), "{page}");
        assert!(page.starts_with("<div class=\"scroll\"><table>") && page.contains("</table></div>"), "{page}");
    }
}
