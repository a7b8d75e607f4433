//! Measured columns as instruments write them: any separator, a heading with units or none.

use super::text::{LARGEST_TABLE, read_text};
use crate::failure::Failure;
use std::path::Path;

/// Columns of equal length, each under its heading, if it has one.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Measured {
    pub(crate) headings: Vec<String>,
    pub(crate) columns: Vec<Vec<f64>>,
}

/// The columns of a file.
pub(crate) fn read_measured(option: &str, path: &Path) -> Result<Measured, Failure> {
    let text = read_text(option, path, LARGEST_TABLE)?;
    parse_measured(&text)
        .map_err(|message| Failure::input(format!("{option} {}", path.display()), message))
}

/// Numbers in columns, separated by commas, semicolons, tabs or blanks; `#` comments and lines before the first row
/// of numbers are skipped, and the last of them is the heading where it has as many words.
pub(crate) fn parse_measured(text: &str) -> Result<Measured, String> {
    let mut found = Measured::default();
    let mut before: Option<&str> = None;
    for (number, line) in text.trim_start_matches('\u{feff}').lines().enumerate() {
        let line = line.trim();
        if line.is_empty() || line.starts_with('#') {
            continue;
        }
        match row(line) {
            Some(row) if found.columns.is_empty() => {
                found.headings = headings(before, row.len());
                found.columns = row.into_iter().map(|value| vec![value]).collect();
            }
            Some(row) if row.len() == found.columns.len() => {
                found.columns.iter_mut().zip(row).for_each(|(column, value)| column.push(value));
            }
            Some(row) => {
                let (numbers, wanted) = (row.len(), found.columns.len());
                return Err(format!(
                    "line {}: {numbers} numbers, where there are {wanted} in the lines before",
                    number + 1
                ));
            }
            None if found.columns.is_empty() => before = Some(line),
            None => return Err(format!("line {} is not a row of numbers", number + 1)),
        }
    }
    if found.columns.is_empty() {
        Err("there is no row of numbers in it".into())
    } else {
        Ok(found)
    }
}

fn words(line: &str) -> Vec<&str> {
    for separator in [';', '\t', ','] {
        if line.contains(separator) {
            return line.split(separator).map(str::trim).collect();
        }
    }
    line.split_whitespace().collect()
}

fn row(line: &str) -> Option<Vec<f64>> {
    let numbers: Option<Vec<f64>> = words(line).into_iter().map(|word| word.parse().ok()).collect();
    numbers.filter(|numbers| !numbers.is_empty())
}

fn headings(line: Option<&str>, count: usize) -> Vec<String> {
    let words = line.map(words).unwrap_or_default();
    let words = if words.len() == count { words } else { vec![""; count] };
    words.into_iter().map(|word| word.trim_matches('"').to_owned()).collect()
}

/// The unit in a heading: x_nm, x (nm), x [nm], x/nm.
pub(crate) fn unit_of(heading: &str) -> Option<&str> {
    let inside = |open: char, close: char| {
        let (_, rest) = heading.split_once(open)?;
        rest.split_once(close).map(|(unit, _)| unit)
    };
    let after = |mark: char| heading.rsplit_once(mark).map(|(_, unit)| unit);
    let found = inside('(', ')').or_else(|| inside('[', ']')).or_else(|| after('_'));
    let found = found.or_else(|| heading.split_once('/').map(|(_, unit)| unit));
    found.map(str::trim).filter(|unit| !unit.is_empty())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_read_as_instruments_write_them() {
        for text in [
            "x_nm,z_nm\n0,1\n2,3e-1\n",
            "# a comment\n\u{20}\nx_nm; z_nm\r\n0; 1\r\n2;0.3\r\n",
            "Profile 1\nx_nm\tz_nm\n0\t1\n2\t0.3",
            "x_nm z_nm\n 0  1\n 2  0.3\n",
        ] {
            let found = parse_measured(text).unwrap();
            assert_eq!(found.columns, [[0.0, 2.0], [1.0, 0.3]], "{text}");
            assert_eq!(found.headings, ["x_nm", "z_nm"], "{text}");
        }
        assert_eq!(parse_measured("1,2,3\n").unwrap().headings, ["", "", ""]);
        for text in ["", "x,f\n", "0,1\n2\n", "0,1\nx,f\n"] {
            assert!(parse_measured(text).is_err(), "{text}");
        }
    }

    #[test]
    fn units_are_found_in_headings() {
        for heading in ["x_nm", "x (nm)", "x [nm]", "x/nm", "scan distance (nm)"] {
            assert_eq!(unit_of(heading), Some("nm"), "{heading}");
        }
        for heading in ["x", "", "x_", "x ()"] {
            assert_eq!(unit_of(heading), None, "{heading}");
        }
    }
}
