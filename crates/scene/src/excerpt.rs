//! A line of a file with a mark below the wrong part.

use std::ops::Range;

/// Characters of a line that are shown; of a longer one the part about the mark.
const WIDTH: usize = 100;
/// Characters before the mark that are shown of a longer line.
const BEFORE: usize = 40;

/// The line of `text` in which `span` (bytes) begins, and a mark below the part of the span that lies in it.
///
/// ```text
///   7 | face_widht_mm = 25.0
///     | ^^^^^^^^^^^^^
/// ```
pub(super) fn excerpt(text: &str, span: &Range<usize>, number: usize) -> String {
    let start = floor(text, span.start.min(text.len()));
    let begin = text[..start].rfind('\n').map_or(0, |at| at + 1);
    let end = text[start..].find('\n').map_or(text.len(), |at| start + at);
    let stop = floor(text, span.end.clamp(start, end));
    let line: Vec<char> = text[begin..end].trim_end().chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
    let column = text[begin..start].chars().count().min(line.len());
    let marked = text[start..stop].trim_end().chars().count().clamp(1, line.len().saturating_sub(column).max(1));
    let from = if line.len() > WIDTH { column.saturating_sub(BEFORE) } else { 0 };
    let shown: String = line.iter().skip(from).take(WIDTH).collect();
    let mark = "^".repeat(marked.min(WIDTH.saturating_sub(column - from).max(1)));
    let digits = number.to_string();
    let blank = " ".repeat(digits.len());
    format!("  {digits} | {shown}\n  {blank} | {}{mark}", " ".repeat(column - from))
}

/// The next character boundary downwards.
fn floor(text: &str, at: usize) -> usize {
    (0..=at).rev().find(|&i| text.is_char_boundary(i)).unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_mark_stands_below_what_is_meant() {
        let text = "a = 1\n\tbö = \"x\" # y\nlast";
        let at = |word: &str| {
            let start = text.find(word).unwrap();
            start..start + word.len()
        };
        assert_eq!(excerpt(text, &at("\"x\""), 2), "  2 |  bö = \"x\" # y\n    |       ^^^");
        assert_eq!(excerpt(text, &at("last"), 13), "  13 | last\n     | ^^^^");
        assert_eq!(excerpt(text, &(0..text.len()), 1), "  1 | a = 1\n    | ^^^^^");
        assert_eq!(excerpt("", &(7..9), 1), "  1 | \n    | ^");
        // Within a character, past the end: no panic.
        for start in 0..text.len() + 3 {
            for end in start..text.len() + 3 {
                let _ = excerpt(text, &(start..end), 1);
            }
        }
    }

    #[test]
    fn of_a_long_line_the_part_about_the_mark_is_shown() {
        let text = format!("list = [{}9{}]", "1, ".repeat(100), ", 1".repeat(100));
        let at = text.find('9').unwrap();
        let shown = excerpt(&text, &(at..at + 1), 1);
        let (line, mark) = shown.split_once('\n').unwrap();
        assert_eq!(line.chars().count(), WIDTH + 6);
        assert_eq!(line.find('9'), mark.find('^'));
    }
}
