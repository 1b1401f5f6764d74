//! What may go to a terminal: names, keys, values and paths of files of others are in every message and table.

use std::borrow::Cow;

/// A text without what a terminal takes for commands or shows in another order than it stands: control characters but
/// new lines and tabs (C0, DEL, C1), and overrides, embeddings and isolates of writing directions. Each becomes one
/// character that is seen, so that marks below a line stay below what they mean.
pub fn plain(text: &str) -> Cow<'_, str> {
    if text.chars().any(|c| seen(c) != c) { text.chars().map(seen).collect::<String>().into() } else { text.into() }
}

/// The character itself, or what is shown for it.
fn seen(c: char) -> char {
    match c {
        '\n' | '\t' => c,
        // Pictures of control characters stand in their order from U+2400 on.
        '\0'..='\u{1f}' => char::from_u32(0x2400 + u32::from(c)).unwrap_or(char::REPLACEMENT_CHARACTER),
        '\u{7f}' => '\u{2421}',
        '\u{80}'..='\u{9f}' | '\u{2028}' | '\u{2029}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}' => {
            char::REPLACEMENT_CHARACTER
        }
        _ => c,
    }
}

/// Characters of a word at most, and those that are shown of the beginning and of the end of a longer one.
const WORD: [usize; 3] = [400, 200, 40];
/// Characters of a line at most.
const LINE: usize = 4000;

/// A message as it is printed: [`plain`], numbers of very many digits as they are read, long words and lines cut.
pub fn message(text: &str) -> String {
    let shown: Vec<String> = plain(text).split('\n').map(|line| cut_line(&short_numbers(line))).collect();
    shown.join("\n")
}

/// A message with its units as SI writes them, [`answer::shown_units`]; what is quoted stays as it is typed.
pub fn units(text: &str) -> String {
    let mut shown = String::with_capacity(text.len());
    for part in text.split_inclusive(['`', '"']) {
        // What stands before a closing mark is behind an odd number of them.
        let quoted = shown.matches(['`', '"']).count() % 2 == 1;
        shown.push_str(&if quoted { part.to_owned() } else { answer::shown_units(part) });
    }
    shown
}

fn cut_line(line: &str) -> String {
    let words = line.split(' ').map(|word| {
        let [most, first, last] = WORD;
        let count = word.chars().count();
        if count <= most {
            return Cow::from(word);
        }
        let (head, tail): (String, String) =
            (word.chars().take(first).collect(), word.chars().skip(count - last).collect());
        format!("{head}...{tail} ({count} characters)").into()
    });
    let line = words.collect::<Vec<_>>().join(" ");
    if line.chars().count() <= LINE { line } else { line.chars().take(LINE).collect::<String>() + " ..." }
}

/// Digits before the point at most: those of the largest whole number that is ever written as such.
const DIGITS: usize = 20;
/// Characters of a number with a point at most.
const DECIMALS: usize = 17;

/// Numbers with four digits where they have more than anybody reads: `1000...000` of 301 digits is `1.000e300`. Digits
/// of names stay.
fn short_numbers(line: &str) -> String {
    let (mut short, mut rest, mut before) = (String::with_capacity(line.len()), line, ' ');
    while let Some(c) = rest.chars().next() {
        let length = if c.is_ascii_digit() { number_length(rest) } else { c.len_utf8() };
        let (token, behind) = rest.split_at(length);
        let is_name = |c: char| c.is_alphanumeric() || matches!(c, '_' | '/' | '\\' | '.');
        let alone = !is_name(before) && !behind.starts_with(|c: char| is_name(c) && c != '.');
        let alone = alone && !behind.strip_prefix('.').is_some_and(|b| b.starts_with(char::is_alphanumeric));
        let whole = token.find('.').unwrap_or(token.len());
        let long = whole > DIGITS || (token.contains('.') && token.len() > DECIMALS);
        match token.parse::<f64>() {
            Ok(value) if c.is_ascii_digit() && alone && long => short.push_str(&four_digits(value)),
            _ => short.push_str(token),
        }
        before = token.chars().next_back().unwrap_or(c);
        rest = behind;
    }
    short
}

/// Bytes of the digits at the beginning, with those behind one point.
fn number_length(text: &str) -> usize {
    let digits = |text: &str| text.bytes().take_while(u8::is_ascii_digit).count();
    let whole = digits(text);
    match text[whole..].strip_prefix('.').map(digits) {
        Some(decimals) if decimals > 0 => whole + 1 + decimals,
        _ => whole,
    }
}

fn four_digits(value: f64) -> String {
    let decimals = 3 - value.abs().max(f64::MIN_POSITIVE).log10().floor() as i32;
    if value == 0.0 {
        "0".into()
    } else if (0..=7).contains(&decimals) {
        format!("{value:.*}", decimals as usize)
    } else {
        format!("{value:.3e}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_that_a_terminal_obeys_is_left() {
        for (raw, shown) in [
            ("\x1b]0;title\x07", "\u{241b}]0;title\u{2407}"),
            ("a\u{9b}31mred\u{7f}\r", "a\u{fffd}31mred\u{2421}\u{240d}"),
            ("abc\u{202e}fed\u{2066}", "abc\u{fffd}fed\u{fffd}"),
            ("  2 | teeth\n\t^^^ µm ±1 °", "  2 | teeth\n\t^^^ µm ±1 °"),
        ] {
            assert_eq!(plain(raw), shown);
            assert_eq!(plain(raw).chars().count(), raw.chars().count());
        }
        let all: String = (0..=0x2fff).filter_map(char::from_u32).collect();
        let left: Vec<char> = plain(&all).chars().filter(|c| c.is_control() && !"\n\t".contains(*c)).collect();
        assert!(left.is_empty(), "{left:?}");
    }

    #[test]
    fn numbers_have_the_digits_that_are_read() {
        for (long, short) in [
            (format!("torque is {}, allowed", 1e300), "torque is 1.000e300, allowed"),
            (format!("({} mm)", -1.5e-300), "(-1.500e-300 mm)"),
            ("0.30000000000000004 um".into(), "0.3000 um"),
            ("31234.567890123456789".into(), "3.123e4"),
            ("18446744073709551615 bytes".into(), "18446744073709551615 bytes"),
            ("20.5 and 1e300 of 3".into(), "20.5 and 1e300 of 3"),
        ] {
            assert_eq!(message(&long), short);
        }
        let name = format!("a/{0}.toml run-{1} {0}x v{0}", "1".repeat(40), "a1");
        assert_eq!(message(&name), name, "digits of names");
    }

    #[test]
    fn units_are_those_of_si_where_nothing_is_quoted() {
        let said = "mean_ste_um is 9.3 um at 200 N m, not \"1 um\"; `5 um 2 N m` of 3 um";
        assert_eq!(units(said), "mean_ste_um is 9.3 µm at 200 N·m, not \"1 um\"; `5 um 2 N m` of 3 µm");
    }

    #[test]
    fn long_words_and_lines_are_cut() {
        let key = vec!["a"; 5000].join(".");
        let shown = message(&format!("--set {key}: unknown"));
        assert!(shown.len() < 400 && shown.ends_with("a: (10000 characters) unknown"), "{shown}");
        assert!(message(&"so many words ".repeat(10_000)).len() < 4100);
        assert_eq!(message("one\ntwo\n"), "one\ntwo\n");
    }
}
