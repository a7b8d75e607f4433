//! Tables of numbers from people and instruments: files of text, or columns that a host supplies. Each line of a text is
//! a row of numbers, a heading, a comment, or an error: none is ignored.
//!
//! Separator and decimal mark are those with which all rows contain the same number of numbers. Lines before the first
//! row are headings if they begin with a letter; other lines are errors. Rows with missing values are counted, with
//! their line numbers.

use crate::decode::lines;
use crate::dialect::{Cell, DIALECTS, Dialect, Separator};
use crate::heading::{Heading, units_of_line, units_of_row};

/// A table as it was read; without columns if the text has no rows.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Sheet {
    /// Heading of each column; may be empty.
    pub headings: Vec<Heading>,
    /// The rows without missing values, as columns.
    pub columns: Vec<Vec<f64>>,
    /// Numbers of the lines or rows with missing values, from 1.
    pub missing: Vec<usize>,
    /// The unit that these numbers count: `line` of a text, or `row` of columns.
    pub counted: &'static str,
}

/// A table before it is read.
pub enum Table<'a> {
    /// A text, in any dialect.
    Text(String),
    /// Columns with their headings; NaN where a value is missing.
    Columns(&'a [(String, Vec<f64>)]),
}

impl From<&str> for Table<'_> {
    fn from(text: &str) -> Self {
        Self::Text(text.to_owned())
    }
}

impl Table<'_> {
    /// The sheet of this table, with one of the numbers of columns in `admissible`.
    ///
    /// # Errors
    ///
    /// The reason why it is not a table of numbers, with the line or row.
    pub fn sheet(&self, admissible: &[usize]) -> Result<Sheet, String> {
        match self {
            Self::Text(text) => parse_sheet(text, admissible),
            Self::Columns(columns) => Sheet::of_columns(columns, admissible),
        }
    }
}

impl Sheet {
    /// The rows of these columns.
    fn of_columns(columns: &[(String, Vec<f64>)], admissible: &[usize]) -> Result<Self, String> {
        let rows = columns.first().map_or(0, |(_, column)| column.len());
        if rows == 0 {
            return Ok(Self::default());
        }
        if !admissible.contains(&columns.len()) {
            return Err(needed(columns.len(), admissible));
        }
        let is_infinite =
            |row: &usize| columns.iter().any(|(_, column)| column[*row].is_infinite());
        if columns.iter().any(|(_, column)| column.len() != rows) {
            return Err("the columns have different numbers of rows".into());
        }
        if let Some(row) = (0..rows).find(is_infinite) {
            return Err(format!("row {}: a number is infinite", row + 1));
        }
        let is_whole = |row: &usize| columns.iter().all(|(_, column)| !column[*row].is_nan());
        let (whole, missing): (Vec<usize>, Vec<usize>) = (0..rows).partition(is_whole);
        if whole.is_empty() {
            return Err(NO_WHOLE_ROW.into());
        }
        let kept = |column: &[f64]| whole.iter().map(|row| column[*row]).collect();
        Ok(Self {
            headings: columns.iter().map(|(heading, _)| Heading::of(heading)).collect(),
            columns: columns.iter().map(|(_, column)| kept(column)).collect(),
            missing: missing.iter().map(|row| row + 1).collect(),
            counted: "row",
        })
    }
}

const NO_WHOLE_ROW: &str = "no row has all its values";

/// The error for a table with another number of columns.
fn needed(count: usize, admissible: &[usize]) -> String {
    let needed: Vec<String> = admissible.iter().map(usize::to_string).collect();
    let columns = if count == 1 { "column" } else { "columns" };
    format!("{count} {columns} of numbers; {} are needed", needed.join(" or "))
}

/// The table in a text, with one of the numbers of columns in `admissible`.
fn parse_sheet(text: &str, admissible: &[usize]) -> Result<Sheet, String> {
    // The end of a file on DOS.
    let text = text.trim_end_matches('\u{1a}');
    let mut furthest: Option<Flaw> = None;
    for dialect in DIALECTS.into_iter().filter(|dialect| dialect.may_be_of(text)) {
        match Reading::of(text, dialect, admissible).and_then(Reading::finished) {
            Ok(sheet) => return Ok(sheet),
            Err(flaw) if furthest.as_ref().is_none_or(|other| flaw.reached > other.reached) => {
                furthest = Some(flaw);
            }
            Err(_) => {}
        }
    }
    match furthest {
        Some(flaw) if flaw.reached > Reached::default() => Err(flaw.message),
        // Headings and comments alone.
        _ => Ok(Sheet::default()),
    }
}

impl Dialect {
    /// Whether a text contains the marks of this dialect.
    fn may_be_of(self, text: &str) -> bool {
        let separates = match self.separator {
            Separator::Mark(mark) => text.contains(mark),
            Separator::Blanks => true,
        };
        separates && (self.decimal == '.' || text.contains(self.decimal))
    }
}

/// Progress of reading: the line reached, and whether rows were found. The dialect that reaches furthest is that of
/// the text.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default)]
struct Reached {
    line: usize,
    has_rows: bool,
}

/// The reason why a text is not a table in a dialect.
struct Flaw {
    reached: Reached,
    message: String,
}

impl Flaw {
    /// An error in a row, or in a line that should be one.
    fn at(line: usize, message: impl std::fmt::Display) -> Self {
        let reached = Reached { line, has_rows: true };
        Self { reached, message: format!("line {line}: {message}") }
    }

    /// An error that was detected at a later line than its own.
    fn found_at(self, line: usize) -> Self {
        Self { reached: Reached { line, has_rows: true }, ..self }
    }

    /// An error before the first row.
    fn above(line: usize, message: impl std::fmt::Display) -> Self {
        let reached = Reached { line, has_rows: false };
        Self { reached, ..Self::at(line, message) }
    }

    /// An error found after all rows were read.
    fn of_all(message: String) -> Self {
        Self { reached: Reached { line: usize::MAX, has_rows: true }, message }
    }
}

/// State of reading a text in one dialect.
struct Reading<'a> {
    dialect: Dialect,
    /// Admissible numbers of columns.
    admissible: &'a [usize],
    /// Lines before the first row, except comments.
    above: Vec<(usize, &'a str)>,
    /// Comments before the first row.
    comments: Vec<&'a str>,
    headings: Vec<Heading>,
    columns: Vec<Vec<f64>>,
    /// Line number of each row.
    lines: Vec<u32>,
    /// Whether all fields of a column are empty.
    blank: Vec<bool>,
    marks: Vec<Marks>,
    commas: Commas,
}

impl<'a> Reading<'a> {
    fn of(text: &'a str, dialect: Dialect, admissible: &'a [usize]) -> Result<Self, Flaw> {
        let mut reading = Self {
            dialect,
            admissible,
            above: vec![],
            comments: vec![],
            headings: vec![],
            columns: vec![],
            lines: vec![],
            blank: vec![],
            marks: vec![],
            commas: Commas::default(),
        };
        let (mut fields, mut cells) = (vec![], vec![]);
        for (line, number) in lines(text).zip(1..) {
            if line.trim().is_empty() {
                continue;
            }
            if let Some(comment) = comment(line) {
                if reading.columns.is_empty() {
                    reading.comments.push(comment);
                }
                continue;
            }
            dialect.separator.fields(line, &mut fields);
            if fields.iter().all(|field| field.is_empty()) {
                continue;
            }
            cells.clear();
            cells.extend(fields.iter().map(|field| dialect.cell(field)));
            if is_row(&cells, !reading.columns.is_empty()) {
                reading.row(number, &fields, &cells)?;
            } else {
                reading.other(number, line, &fields, &cells)?;
            }
        }
        Ok(reading)
    }

    fn row(&mut self, line: usize, fields: &[&str], cells: &[Cell]) -> Result<(), Flaw> {
        if self.columns.is_empty() {
            self.headings = self.headings_of(line, fields.len())?;
            self.columns = vec![vec![]; fields.len()];
            self.blank = vec![true; fields.len()];
            self.marks = vec![Marks::default(); fields.len()];
        }
        if fields.len() != self.columns.len() {
            let (found, wanted) = (fields.len(), self.columns.len());
            if self.admissible.contains(&found) && !self.admissible.contains(&wanted) {
                let message = format!("{wanted} values, where the rows below have {found}");
                return Err(Flaw::at(self.lines[0] as usize, message).found_at(line));
            }
            let message = format!("{found} values, where the rows before have {wanted}");
            return Err(Flaw::at(line, message));
        }
        for (i, (field, cell)) in fields.iter().zip(cells).enumerate() {
            self.columns[i].push(match cell {
                Cell::Number(number) => *number,
                _ => f64::NAN,
            });
            self.blank[i] &= field.is_empty();
            self.marks[i].see(field, self.dialect.decimal, line);
        }
        if self.dialect.separator == Separator::Mark(',') {
            self.commas.see(line, fields);
        }
        self.lines.push(u32::try_from(line).unwrap_or(u32::MAX));
        Ok(())
    }

    /// Handles a line that is not a row of numbers.
    fn other(
        &mut self,
        line: usize,
        text: &'a str,
        fields: &[&str],
        cells: &[Cell],
    ) -> Result<(), Flaw> {
        if !cells.contains(&Cell::Text) {
            return Err(Flaw::at(line, "a number is too large"));
        }
        if self.columns.is_empty() && (begins_with_a_letter(text) || is_rule(text)) {
            self.above.push((line, text));
            return Ok(());
        }
        let odd = fields.iter().zip(cells).find(|(_, cell)| **cell == Cell::Text);
        let odd = odd.map(|(field, _)| short(field)).unwrap_or_default();
        let message = format!("`{odd}` is not a number");
        let has_rows = self.admissible.contains(&self.columns.len());
        Err(if has_rows { Flaw::at(line, message) } else { Flaw::above(line, message) })
    }

    /// The headings of `count` columns, whose first row is on this line.
    ///
    /// No other line is allowed between the last line of words and the first row, because it might be a damaged row.
    fn headings_of(&self, first: usize, count: usize) -> Result<Vec<Heading>, Flaw> {
        let has_numbers = |text: &str| {
            let mut fields = vec![];
            self.dialect.separator.fields(text, &mut fields);
            fields.iter().any(|field| self.is_like_a_number(field))
        };
        let words = self.above.iter().rposition(|(_, text)| !has_numbers(text));
        let below = &self.above[words.map_or(0, |words| words + 1)..];
        if let Some((line, text)) = below.iter().find(|(_, text)| !is_remark_with_value(text)) {
            let message = format!("`{}` is neither a heading nor a row of numbers", short(text));
            return Err(Flaw::at(*line, message).found_at(first));
        }
        let rows = self.above.iter().filter(|(_, text)| !has_numbers(text));
        let rows: Vec<Vec<&str>> = rows.filter_map(|(_, text)| self.names(text, count)).collect();
        let comments = self.comments.iter().filter(|text| !has_numbers(text));
        let mut comments: Vec<Vec<&str>> =
            comments.filter_map(|text| self.names(text, count)).collect();
        let has_units = |row: &Vec<&str>| {
            units_of_row(row).is_some()
                || row.iter().any(|name| Heading::of(name).written_unit().is_some())
        };
        // Others are prose of as many words.
        if comments.iter().any(has_units) {
            comments.retain(has_units);
        }
        let headings = headings(&rows, count).and_then(|found| {
            let mut all = found.into_iter().zip(headings(&comments, count)?);
            let merged = all.try_fold(vec![], |mut merged, (heading, comment)| {
                merged.push(match comment.written_unit() {
                    _ if heading == Heading::default() => comment,
                    Some(unit) => heading.with_unit(unit)?,
                    None => heading,
                });
                Ok::<_, String>(merged)
            });
            self.with_units_of_lines(merged?)
        });
        headings.map_err(|message| Flaw::at(first, message))
    }

    fn with_units_of_lines(&self, mut headings: Vec<Heading>) -> Result<Vec<Heading>, String> {
        let above = self.above.iter().map(|(_, text)| *text);
        for text in self.comments.iter().copied().chain(above) {
            for (column, unit) in units_of_line(text, headings.len()) {
                headings[column] = std::mem::take(&mut headings[column]).with_unit(&unit)?;
            }
        }
        Ok(headings)
    }

    /// A line of words as headings of `count` columns, with any separator.
    fn names<'b>(&self, text: &'b str, count: usize) -> Option<Vec<&'b str>> {
        let marks = [',', ';', '\t'].map(Separator::Mark);
        let mut fields = vec![];
        for separator in
            [self.dialect.separator].into_iter().chain(marks).chain([Separator::Blanks])
        {
            separator.fields(text, &mut fields);
            if fields.len() == count {
                return Some(fields);
            }
            // Names with single blanks in them.
            if separator == Separator::Blanks {
                let wide = text.trim().split("  ").map(str::trim).filter(|field| !field.is_empty());
                fields = wide.collect();
            }
            if fields.len() == count {
                return Some(fields);
            }
        }
        // `scan distance (nm) height (nm)`
        let bracketed: Vec<&str> = text.split_inclusive([')', ']']).map(str::trim).collect();
        (bracketed.len() == count && bracketed.iter().all(|name| name.ends_with([')', ']'])))
            .then_some(bracketed)
    }

    /// Whether a field is a number, or a number with one wrong character.
    fn is_like_a_number(&self, field: &str) -> bool {
        let digits = field.chars().filter(|c| c.is_ascii_digit() || matches!(c, '.' | ',')).count();
        let is_damaged = 2 * digits > field.chars().count() && field.contains(['.', ',']);
        matches!(self.dialect.cell(field), Cell::Number(_) | Cell::TooLarge) || is_damaged
    }

    fn finished(mut self) -> Result<Sheet, Flaw> {
        if self.columns.is_empty() {
            return Err(Flaw { reached: Reached::default(), message: String::new() });
        }
        // Separators at the ends of lines make columns of nothing.
        let columns = self.blank.iter().zip(&self.headings);
        let is_kept: Vec<bool> =
            columns.map(|(blank, heading)| !blank || !heading.text().is_empty()).collect();
        retain(&mut self.columns, &is_kept);
        retain(&mut self.headings, &is_kept);
        let count = self.columns.len();
        if !self.admissible.contains(&count) {
            let flaw = Flaw::of_all(self.of_other_width());
            // Any text without a separator is one column in several dialects.
            return Err(if count > 1 { flaw } else { flaw.found_at(1) });
        }
        self.judge_marks()?;
        let is_whole = |row: &usize| self.columns.iter().all(|column| !column[*row].is_nan());
        let (whole, missing): (Vec<usize>, Vec<usize>) = (0..self.lines.len()).partition(is_whole);
        let missing: Vec<usize> = missing.iter().map(|row| self.lines[*row] as usize).collect();
        if whole.is_empty() {
            return Err(Flaw::at(self.lines[0] as usize, NO_WHOLE_ROW));
        }
        if !missing.is_empty() {
            for column in &mut self.columns {
                *column = whole.iter().map(|row| column[*row]).collect();
            }
        }
        Ok(Sheet { headings: self.headings, columns: self.columns, missing, counted: "line" })
    }

    fn of_other_width(&self) -> String {
        let message =
            format!("line {}: {}", self.lines[0], needed(self.columns.len(), self.admissible));
        if self.commas.are_between_integers() { format!("{message}; {AMBIGUOUS}") } else { message }
    }

    /// Rejects commas that may be decimal marks, and points or commas that may group thousands.
    fn judge_marks(&self) -> Result<(), Flaw> {
        let groups =
            |marks: &Marks| marks.thousands.filter(|_| marks.has_small && !marks.is_decimal);
        let is_usual =
            self.dialect.separator == Separator::Mark(',') && self.dialect.decimal == '.';
        if let Some(line) = self.marks.iter().find_map(groups).filter(|_| !is_usual) {
            let message = format!(
                "line {line}: a `{}` may be a decimal mark or group thousands: write numbers without groups",
                self.dialect.decimal
            );
            return Err(Flaw::of_all(message));
        }
        if !self.commas.are_between_integers() {
            return Ok(());
        }
        let count = self.columns.len();
        let named = self.above.last().map(|(_, text)| {
            let mut names = vec![];
            self.dialect.separator.fields(text, &mut names);
            names.len() == count
        });
        let is_open =
            named.is_none() && (count > 2 && self.admissible.len() > 1 || self.commas.repeats > 1);
        if self.commas.has_zeros || named == Some(false) || is_open {
            let line = self.commas.odd.unwrap_or(self.lines[0] as usize);
            return Err(Flaw::of_all(format!("line {line}: {AMBIGUOUS}")));
        }
        Ok(())
    }
}

const AMBIGUOUS: &str = "commas may be decimal marks here: write `;` between the columns, or a decimal point, or a heading with a \
                         name for each column";

/// Evidence for groups of thousands in a column: 1,234 together with 999.
#[derive(Debug, Clone, Default)]
struct Marks {
    /// The line of the first number that may be grouped.
    thousands: Option<usize>,
    /// Whether there are numbers below 1000 without a mark.
    has_small: bool,
    /// Whether the mark of some number cannot group thousands.
    is_decimal: bool,
}

impl Marks {
    fn see(&mut self, field: &str, mark: char, line: usize) {
        if self.is_decimal || field.is_empty() {
            return;
        }
        let digits = field.trim_start_matches(['+', '-', '\u{2212}']);
        match digits.split_once(mark) {
            Some((above, below)) => {
                let is_group =
                    (1..=3).contains(&above.len()) && !above.starts_with('0') && below.len() == 3;
                if is_group && digits.bytes().filter(u8::is_ascii_digit).count() + 1 == digits.len()
                {
                    self.thousands.get_or_insert(line);
                } else {
                    self.is_decimal = true;
                }
            }
            None => self.has_small |= digits.len() <= 3,
        }
    }
}

/// Evidence for decimal commas between integers, such as 0,05 and -0,5, or 0,1 after 0,0.
#[derive(Debug, Default)]
struct Commas {
    has_others: bool,
    /// The line of the first zero in `has_zeros`.
    odd: Option<usize>,
    /// Whether there is a zero before other digits, or a negative one.
    has_zeros: bool,
    /// Number of rows with the same integer before the first comma as the row before.
    repeats: usize,
    last: String,
}

impl Commas {
    fn see(&mut self, line: usize, fields: &[&str]) {
        if self.has_others {
            return;
        }
        let digits = |field: &str| field.trim_start_matches(['+', '-', '\u{2212}']).to_owned();
        let is_integer = |field: &&str| digits(field).bytes().all(|byte| byte.is_ascii_digit());
        self.has_others = !fields.iter().all(is_integer);
        let is_decimals = |(i, field): (usize, &&str)| {
            let digits = digits(field);
            let is_padded = i > 0 && digits.len() > 1 && digits.starts_with('0');
            is_padded || digits == "0" && digits.len() < field.len()
        };
        if fields.iter().enumerate().any(is_decimals) {
            self.has_zeros = true;
            self.odd.get_or_insert(line);
        }
        if fields.first().is_some_and(|first| !first.is_empty() && *first == self.last) {
            self.repeats += 1;
        }
        self.last = fields.first().map(|&first| first.to_owned()).unwrap_or_default();
    }

    fn are_between_integers(&self) -> bool {
        !self.has_others && !self.last.is_empty()
    }
}

/// Names from rows of words, and units from a row of units.
fn headings(rows: &[Vec<&str>], count: usize) -> Result<Vec<Heading>, String> {
    let units = rows.iter().rev().take(4).find_map(|row| Some((row, units_of_row(row)?)));
    let is_units = |row: &Vec<&str>| units.as_ref().is_some_and(|(of_units, _)| *of_units == row);
    // The one above the row of units, where there is one: below it there are comments.
    let before = rows.iter().position(is_units).and_then(|at| rows[..at].last());
    let names = before.or_else(|| rows.iter().rev().find(|row| !is_units(row)));
    let names: Vec<Heading> = match names {
        Some(names) => names.iter().map(|name| Heading::of(name)).collect(),
        None => vec![Heading::default(); count],
    };
    match units {
        Some((_, units)) => {
            names.into_iter().zip(&units).map(|(name, unit)| name.with_unit(unit)).collect()
        }
        None => Ok(names),
    }
}

/// The text after the mark of a comment; `None` for any other line.
fn comment(line: &str) -> Option<&str> {
    const ERRORS: [&str; 5] = ["#n/a", "#nv", "#num!", "#value!", "#div/0!"];
    let line = line.trim();
    let lower = || line.get(..8.min(line.len())).unwrap_or_default().to_ascii_lowercase();
    if line.starts_with('#') && ERRORS.iter().any(|error| lower().starts_with(error)) {
        return None;
    }
    let marked = ["#", "%", "//"].into_iter().find_map(|mark| line.strip_prefix(mark));
    // A row separated by semicolons may lack its first value.
    let is_row = |rest: &str| {
        let fields = rest.split(';').map(str::trim).filter(|field| !field.is_empty());
        fields
            .flat_map(|field| DIALECTS.map(|dialect| dialect.cell(field)))
            .any(|cell| cell != Cell::Text)
    };
    let marked = marked.or_else(|| line.strip_prefix(';').filter(|rest| !is_row(rest)));
    marked.map(|rest| rest.trim_start_matches(['#', '%', ';', '/']).trim())
}

/// Whether a line contains only numbers and missing values; a first row needs at least one number or several missing
/// values.
fn is_row(cells: &[Cell], has_rows: bool) -> bool {
    let is_value = |cell: &Cell| matches!(cell, Cell::Number(_) | Cell::Missing);
    cells.iter().all(is_value)
        && (has_rows || cells.len() > 1 || cells.iter().any(|cell| matches!(cell, Cell::Number(_))))
}

/// Whether a line begins with a letter, possibly after a bracket, like titles, names and units.
fn begins_with_a_letter(line: &str) -> bool {
    let marks = |c: char| c.is_whitespace() || "\"'[({<*\\@!:,;_".contains(c);
    let first = line.trim_start_matches(marks).chars().next();
    first.is_some_and(|c| c.is_alphabetic() || "µ°%".contains(c))
}

/// Whether a line is a rule below a heading.
fn is_rule(line: &str) -> bool {
    let line = line.trim();
    line.len() > 2 && line.chars().all(|c| "-=_*+|~ \t".contains(c))
}

/// Whether a line is a name followed by one value, such as `Samples: 500`.
fn is_remark_with_value(line: &str) -> bool {
    let Some((name, value)) = line.split_once([':', '=']) else { return false };
    let is_name = name.chars().filter(|c| c.is_alphabetic()).count() > 1;
    is_name && !value.trim().contains([',', ';', '\t', ' '])
}

/// The beginning of a text that may be long.
fn short(text: &str) -> String {
    let text = text.trim();
    let beginning: String = text.chars().take(40).collect();
    if beginning.len() < text.len() { format!("{beginning}…") } else { beginning }
}

fn retain<T>(entries: &mut Vec<T>, is_kept: &[bool]) {
    let mut kept = is_kept.iter();
    entries.retain(|_| kept.next().is_none_or(|kept| *kept));
}
