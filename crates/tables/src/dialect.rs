//! Dialects of tables: the separator of columns and the decimal mark.

/// Separators of columns.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Separator {
    Mark(char),
    /// Any number of blanks and tabs.
    Blanks,
}

/// Separator and decimal mark.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Dialect {
    pub(crate) separator: Separator,
    pub(crate) decimal: char,
}

const fn dialect(separator: Separator, decimal: char) -> Dialect {
    Dialect { separator, decimal }
}

/// All known dialects. A comma may separate numbers with decimal commas if these are quoted.
pub(crate) const DIALECTS: [Dialect; 8] = [
    dialect(Separator::Mark(','), '.'),
    dialect(Separator::Mark(';'), '.'),
    dialect(Separator::Mark(';'), ','),
    dialect(Separator::Mark('\t'), '.'),
    dialect(Separator::Mark('\t'), ','),
    dialect(Separator::Blanks, '.'),
    dialect(Separator::Blanks, ','),
    dialect(Separator::Mark(','), ','),
];

/// The content of a field.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Cell {
    Number(f64),
    /// Empty, or a word for a missing value.
    Missing,
    /// A number beyond the range of floating point.
    TooLarge,
    /// Anything else.
    Text,
}

/// Words for a missing value, in lower case, as written by instruments, spreadsheets, pandas and masked arrays.
const MISSING: [&str; 26] = [
    "nan",
    "+nan",
    "-nan",
    "na",
    "n/a",
    "#n/a",
    "<na>",
    "nil",
    "null",
    "none",
    "missing",
    "masked",
    "-",
    "--",
    "---",
    "–",
    "—",
    "1.#qnan",
    "1.#ind",
    "-1.#ind",
    "nan(ind)",
    "-nan(ind)",
    "#num!",
    "#value!",
    "#div/0!",
    "#nv",
];

/// Signs that can only mean minus: U+2212, hyphens, dashes, and full-width ones.
const MINUS: [char; 7] =
    ['\u{2212}', '\u{2010}', '\u{2011}', '\u{2012}', '\u{2013}', '\u{fe63}', '\u{ff0d}'];

impl Dialect {
    pub(crate) fn cell(self, field: &str) -> Cell {
        match self.number(field) {
            Some(number) if number.is_finite() => Cell::Number(number),
            Some(_) => Cell::TooLarge,
            None if is_missing(field) => Cell::Missing,
            None => Cell::Text,
        }
    }

    fn number(self, field: &str) -> Option<f64> {
        let is_plain =
            |byte: u8| byte.is_ascii_digit() || matches!(byte, b'+' | b'-' | b'.' | b'e' | b'E');
        if self.decimal == '.' && field.bytes().all(is_plain) {
            return field.parse().ok();
        }
        // Longer than any number is written.
        if field.len() > 400 || field.ends_with(self.decimal) && self.decimal == ',' {
            return None;
        }
        let plain = |c: char| match c {
            '0'..='9' | '+' | '-' | 'e' | 'E' => Some(c),
            // As Fortran writes exponents.
            'd' | 'D' => Some('e'),
            c if c == self.decimal => Some('.'),
            c if MINUS.contains(&c) => Some('-'),
            _ => None,
        };
        field.chars().map(plain).collect::<Option<String>>()?.parse().ok()
    }
}

fn is_missing(field: &str) -> bool {
    field.is_empty() || field.len() < 12 && MISSING.contains(&&*field.to_lowercase())
}

impl Separator {
    /// Splits a line into fields without surrounding blanks and quotes.
    pub(crate) fn fields<'a>(self, line: &'a str, found: &mut Vec<&'a str>) {
        found.clear();
        let mut is_quoted = false;
        let mut separates = |c: char| match (c, self) {
            ('"', _) => {
                is_quoted = !is_quoted;
                false
            }
            (c, Self::Mark(mark)) => c == mark && !is_quoted,
            (c, Self::Blanks) => matches!(c, ' ' | '\t') && !is_quoted,
        };
        let fields = line.split(&mut separates).map(bare);
        match self {
            Self::Mark(_) => found.extend(fields),
            Self::Blanks => found.extend(fields.filter(|field| !field.is_empty())),
        }
    }
}

/// A field without surrounding blanks and quotes.
fn bare(field: &str) -> &str {
    let field = field.trim();
    let quoted = field.strip_prefix('"').and_then(|field| field.strip_suffix('"'));
    quoted.map_or(field, str::trim)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_read_as_they_are_written() {
        let point = Dialect { separator: Separator::Blanks, decimal: '.' };
        let comma = Dialect { decimal: ',', ..point };
        for (field, wanted) in [
            ("1.5", 1.5),
            ("-.5e-3", -5e-4),
            ("+2", 2.0),
            ("\u{2212}3.0E\u{2212}1", -0.3),
            ("1.5D-03", 1.5e-3),
        ] {
            assert_eq!(point.cell(field), Cell::Number(wanted), "{field}");
            assert_eq!(comma.cell(&field.replace('.', ",")), Cell::Number(wanted), "{field}");
        }
        for field in ["NaN", "--", "", "#N/A", "n/a"] {
            assert_eq!(point.cell(field), Cell::Missing, "{field}");
        }
        for field in [
            "1,5",
            "1.5.2",
            "1 000",
            "1'000",
            "1\u{a0}000",
            "0x10",
            "1_000",
            "inf",
            "1e",
            "2nm",
            "٣",
            "e5",
            ".",
        ] {
            assert_eq!(point.cell(field), Cell::Text, "{field}");
        }
        for field in ["1.5", "1.234,5", "5,", ","] {
            assert_eq!(comma.cell(field), Cell::Text, "{field}");
        }
        assert_eq!(point.cell("1e999"), Cell::TooLarge);
    }

    #[test]
    fn fields_stand_between_separators() {
        let fields = |separator: Separator, line: &'static str| {
            let mut found = vec![];
            separator.fields(line, &mut found);
            found
        };
        assert_eq!(fields(Separator::Mark(','), "\"1,5\", 2 ,"), ["1,5", "2", ""]);
        assert_eq!(fields(Separator::Mark(';'), "a (b);c"), ["a (b)", "c"]);
        assert_eq!(fields(Separator::Blanks, "  1\t 2 "), ["1", "2"]);
        // A blank that does not break is none between columns.
        assert_eq!(fields(Separator::Blanks, "1\u{a0}000 2"), ["1\u{a0}000", "2"]);
    }
}
