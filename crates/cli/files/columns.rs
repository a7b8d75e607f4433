//! Tables of two or three columns that users give: CSV, a heading allowed, `#` comments skipped.

use super::in_model_units::in_model_units;
use super::text::{LARGEST_TABLE, read_text};
use crate::failure::Failure;
use std::path::Path;
use stickslip_documents::KnownScales;
use stickslip_raster::AreaLine;

/// Two columns read from a CSV file.
pub(crate) type Columns = (Vec<f64>, Vec<f64>);

/// Two columns of numbers from CSV, a heading allowed, `#` comments skipped.
pub(crate) fn read_columns(
    option: &str,
    path: &Path,
    heading: &str,
    scales: Option<&KnownScales>,
) -> Result<Columns, Failure> {
    let text = read_text(option, path, LARGEST_TABLE)?;
    parse_columns(&text, heading, scales)
        .map_err(|message| Failure::input(format!("{option} {}", path.display()), message))
}

/// Lines of an area, y,start,length.
pub(crate) fn read_area(
    option: &str,
    path: &Path,
    scales: Option<&KnownScales>,
) -> Result<Vec<AreaLine>, Failure> {
    let text = read_text(option, path, LARGEST_TABLE)?;
    let [y, start, length] = parse_table(&text, "y,start,length", scales)
        .map_err(|message| Failure::input(format!("{option} {}", path.display()), message))?;
    let columns = y.into_iter().zip(start).zip(length);
    Ok(columns.map(|((y, start), length)| AreaLine { y, start, length }).collect())
}

/// A profile x,u; or one surface t,x,u, as `surface` writes it.
pub(crate) fn read_profile(
    option: &str,
    path: &Path,
    scales: Option<&KnownScales>,
) -> Result<Columns, Failure> {
    let text = read_text(option, path, LARGEST_TABLE)?;
    parse_profile(&text, scales)
        .map_err(|message| Failure::input(format!("{option} {}", path.display()), message))
}

pub(crate) fn parse_profile(text: &str, scales: Option<&KnownScales>) -> Result<Columns, String> {
    if width_of(text) != 3 {
        return parse_columns(text, "x,u", scales);
    }
    let (mut columns, headings) = numbers_of::<3>(text, "t,x,u")?;
    // The time only tells surfaces apart, in whatever unit.
    in_model_units(&mut columns[1..], "x,u", headings.get(1..).unwrap_or_default(), scales)?;
    let [t, x, u] = columns;
    match t.iter().position(|time| time.to_bits() != t[0].to_bits()) {
        None => Ok((x, u)),
        Some(row) => Err(format!(
            "holds surfaces at several times, {} and {}: write one with `surface --at T`",
            t[0], t[row]
        )),
    }
}

fn parse_columns(
    text: &str,
    heading: &str,
    scales: Option<&KnownScales>,
) -> Result<Columns, String> {
    parse_table::<2>(text, heading, scales).map(|[first, second]| (first, second))
}

/// N columns of numbers, in the model's units where their heading has others.
fn parse_table<const N: usize>(
    text: &str,
    heading: &str,
    scales: Option<&KnownScales>,
) -> Result<[Vec<f64>; N], String> {
    let (mut columns, headings) = numbers_of(text, heading)?;
    in_model_units(&mut columns, heading, &headings, scales)?;
    Ok(columns)
}

/// N columns of numbers, and what stands above them.
pub(super) fn numbers_of<const N: usize>(
    text: &str,
    heading: &str,
) -> Result<([Vec<f64>; N], Vec<String>), String> {
    let mut columns = std::array::from_fn(|_| vec![]);
    let mut headings = vec![];
    for (index, record) in csv_reader(text).records().enumerate() {
        let record = record.map_err(|error| format!("not CSV: {error}"))?;
        let line = record.position().map_or(0, csv::Position::line);
        let numbers: Result<Vec<f64>, _> = record.iter().map(str::parse).collect();
        match numbers {
            Ok(row) if row.len() == N => {
                columns.iter_mut().zip(row).for_each(|(column, value)| column.push(value));
            }
            Err(_) if index == 0 && is_heading(&record) => {
                headings = record.iter().map(str::to_owned).collect();
            }
            _ => {
                let count = ["no", "one", "two", "three"].get(N).unwrap_or(&"too many");
                return Err(format!(
                    "line {line} is not {count} numbers `{heading}` separated by commas"
                ));
            }
        }
    }
    Ok((columns, headings))
}

fn csv_reader(text: &str) -> csv::Reader<&[u8]> {
    csv::ReaderBuilder::new()
        .has_headers(false)
        .flexible(true)
        .trim(csv::Trim::All)
        .comment(Some(b'#'))
        .from_reader(text.as_bytes())
}

/// Fields of the first line.
pub(super) fn width_of(text: &str) -> usize {
    csv_reader(text).records().next().and_then(Result::ok).map_or(0, |record| record.len())
}

/// A first line without any number; a mistyped row is none.
fn is_heading(record: &csv::StringRecord) -> bool {
    record.iter().all(|field| field.parse::<f64>().is_err())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_heading_and_comments_are_skipped() {
        let (x, u) = parse_columns("# measured\nx,u\n0, 1\n2,3e-1\n", "x,u", None).unwrap();
        assert_eq!(x.len(), 2);
        assert!((u[1] - 0.3).abs() < 1e-16);
    }

    #[test]
    fn a_line_that_is_not_two_numbers_is_named() {
        for (text, line) in
            [("1,2\n3\n", 2), ("1,2\n3,4,5\n", 2), ("x,u\n1,2\nfoo,3\n", 3), ("1,2e\n3,4\n", 1)]
        {
            let message = parse_columns(text, "x,u", None).unwrap_err();
            assert!(message.contains(&format!("line {line}")), "{message}");
        }
    }
}
