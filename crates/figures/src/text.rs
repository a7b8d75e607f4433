//! Labels: `_` makes the next character, or the content of braces, a subscript, and `^` a superscript.
//!
//! `α_c` is α with a subscript c, `10^{-3}` ten to the minus three; `\_` and `\^` are the characters themselves. A
//! hyphen between digits and in a superscript is set as a minus.

/// Vertical level of a piece of a label.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Level {
    Line,
    Below,
    Above,
}

/// A piece of a label.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Span {
    pub(crate) text: String,
    pub(crate) level: Level,
}

/// Size of subscripts and superscripts, relative to the text.
pub(crate) const SMALL: f64 = 0.72;

/// Downward shift of a level from the base line.
pub(crate) fn offset(level: Level, size: f64) -> f64 {
    match level {
        Level::Line => 0.0,
        Level::Below => 0.22 * size,
        Level::Above => -0.34 * size,
    }
}

/// The pieces of a label.
pub(crate) fn spans(label: &str) -> Vec<Span> {
    let mut spans: Vec<Span> = vec![];
    let mut push = |text: &str, level| match spans.last_mut() {
        Some(last) if last.level == level => last.text.push_str(text),
        _ => spans.push(Span { text: text.to_owned(), level }),
    };
    let mut letters = label.chars().peekable();
    while let Some(letter) = letters.next() {
        let level = match letter {
            '\\' => {
                let escaped = letters.next_if(|c| ['_', '^', '\\', '{', '}'].contains(c));
                push(&escaped.unwrap_or('\\').to_string(), Level::Line);
                continue;
            }
            '_' => Level::Below,
            '^' => Level::Above,
            _ => {
                push(&letter.to_string(), Level::Line);
                continue;
            }
        };
        let text: String = if letters.next_if_eq(&'{').is_some() {
            letters.by_ref().take_while(|c| *c != '}').collect()
        } else {
            letters.next().into_iter().collect()
        };
        push(&text.replace('-', "−"), level);
    }
    spans
}

/// The label that shows a text as it is, such as the name of a file.
pub(crate) fn literal(text: &str) -> String {
    let escaped = |letter: char| match letter {
        '_' | '^' | '\\' | '{' | '}' => format!("\\{letter}"),
        _ => letter.to_string(),
    };
    text.chars().map(escaped).collect()
}

/// Width of a label set in DejaVu Sans, in the unit of `size`. Other fonts are narrower.
pub(crate) fn width(label: &str, size: f64) -> f64 {
    let of = |span: &Span| {
        let size = if span.level == Level::Line { size } else { SMALL * size };
        span.text.chars().map(advance).sum::<f64>() * size
    };
    spans(label).iter().map(of).sum()
}

/// Width of a character relative to the font size; each class has the width of its widest member.
fn advance(letter: char) -> f64 {
    match letter {
        'i' | 'j' | 'l' | '\'' | '|' | 'ι' => 0.34,
        ' ' | '.' | ',' | ':' | ';' | '!' | 'I' => 0.34,
        '(' | ')' | '[' | ']' | 't' | 'f' | 'r' | '/' | '-' => 0.42,
        '₀'..='₉' | '⁰' | '¹' | '²' | '³' | '⁴'..='⁻' => 0.42,
        's' | 'c' | 'z' | 'v' | 'x' | 'y' | 'k' => 0.6,
        'm' | 'w' | 'M' | 'W' | '@' | '%' | 'ω' | '→' | '…' => 1.0,
        '+' | '=' | '<' | '>' | '−' | '±' | '×' | '≤' | '≥' => 0.84,
        'A'..='Z' | 'Α'..='Ω' => 0.78,
        '\u{300}'..='\u{36f}' => 0.0,
        '\u{1100}'.. if !('\u{1e00}'..'\u{2300}').contains(&letter) => 1.0,
        _ => 0.65,
    }
}

/// Breaks a label between words into lines of at most that width.
pub(crate) fn wrapped(label: &str, size: f64, most: f64) -> Vec<String> {
    let mut lines: Vec<String> = vec![];
    // A space that does not break is none here.
    for word in label.split(' ').filter(|word| !word.is_empty()) {
        match lines.last_mut() {
            Some(line) if width(line, size) + width(word, size) + 0.4 * size <= most => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    fn levels(label: &str) -> Vec<(String, Level)> {
        spans(label).into_iter().map(|s| (s.text, s.level)).collect()
    }

    #[test]
    fn subscripts_and_superscripts_are_one_character_or_what_is_in_braces() {
        use Level::{Above, Below, Line};
        let of = |parts: &[(&str, Level)]| -> Vec<(String, Level)> {
            parts.iter().map(|(text, level)| ((*text).to_owned(), *level)).collect()
        };
        assert_eq!(levels("α − α_c"), of(&[("α − α", Line), ("c", Below)]));
        assert_eq!(levels("10^{-3} σ"), of(&[("10", Line), ("−3", Above), (" σ", Line)]));
        assert_eq!(levels(r"my\_tip"), of(&[("my_tip", Line)]));
        assert_eq!(levels(&literal(r"a_1^{2}\3")), of(&[(r"a_1^{2}\3", Line)]));
        assert_eq!(levels("a_"), of(&[("a", Line), ("", Below)]));
        assert_eq!(levels("a_{b"), of(&[("a", Line), ("b", Below)]));
    }

    #[test]
    fn lines_are_broken_between_words() {
        assert_eq!(wrapped("one two three", 10.0, 60.0), ["one two", "three"]);
        assert!(wrapped("", 10.0, 60.0).is_empty());
    }
}
