//! Messages on standard error: harmless for a terminal, short, and never a cause of failure.
//!
//! Messages quote file names and contents of files, which may contain control sequences that move a cursor or rename
//! a window, and megabytes of text.

use crate::sign_of_life::aside;
use std::borrow::Cow;
use std::fmt::Display;
use std::io::{Write, stderr};
use stickslip::is_harmful;

/// Largest number of characters of a line; of longer lines the beginning and the end are printed.
const LONGEST: usize = 2000;
/// Number of characters printed from the end.
const END: usize = 400;

/// Prints a line on standard error, whose own errors are ignored.
pub(crate) fn say(line: impl Display) {
    let mut line = harmless(&short(&line.to_string())).into_owned();
    line.push('\n');
    // In one piece: lines of several processes do not mix.
    aside(|| stderr().lock().write_all(line.as_bytes()).ok());
}

/// Prints each line of a text.
pub(crate) fn say_lines(text: &str) {
    text.lines().for_each(say);
}

/// The text with invisible characters and changes of direction escaped: `\u{1b}`.
pub(crate) fn harmless(text: &str) -> Cow<'_, str> {
    if !text.contains(is_harmful) {
        return text.into();
    }
    let mut escaped = String::with_capacity(2 * text.len());
    for c in text.chars() {
        if is_harmful(c) {
            escaped.extend(c.escape_unicode());
        } else {
            escaped.push(c);
        }
    }
    escaped.into()
}

/// The text, shortened to its beginning and its end if it is long.
pub(crate) fn short(text: &str) -> Cow<'_, str> {
    // A character has one byte at least.
    if text.len() <= LONGEST {
        return text.into();
    }
    let count = text.chars().count();
    if count <= LONGEST {
        return text.into();
    }
    let at = |n: usize| text.char_indices().nth(n).map_or(text.len(), |(at, _)| at);
    let (left, right) = (at(LONGEST - END), at(count - END));
    format!("{} … ({} characters) … {}", &text[..left], count - LONGEST, &text[right..]).into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_moves_a_cursor_is_escaped() {
        assert_eq!(harmless("αc(r) = 1.069 …"), "αc(r) = 1.069 …");
        let cases = [
            ("\x1b[31mred", "\\u{1b}[31mred"),
            ("a\rb\nc\td", "a\\u{d}b\\u{a}c\\u{9}d"),
            ("\u{9b}2J\u{7f}", "\\u{9b}2J\\u{7f}"),
            ("gpj.\u{202e}svg", "gpj.\\u{202e}svg"),
        ];
        for (raw, escaped) in cases {
            assert_eq!(harmless(raw), escaped);
        }
    }

    #[test]
    fn a_long_text_is_told_by_its_ends() {
        let text = format!("--from c.json: {}: rename it", "µ".repeat(10_000_000));
        let told = short(&text);
        assert!(told.chars().count() < LONGEST + 50);
        assert!(told.starts_with("--from c.json: µ") && told.ends_with("µ: rename it"));
        assert_eq!(short("short"), "short");
    }
}
