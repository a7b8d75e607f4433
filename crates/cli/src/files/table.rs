//! Output of tables: CSV and NumPy archives of documents with columns and arrays.

use super::output::Output;
use crate::failure::Failure;
use crate::message::harmless;
use std::io::{self, Write};
use stickslip::{Column, Tabular, arrays_in_units, columns_in_units};
use stickslip_tables::{NamedArray, write_npz};

/// Writes the columns as CSV, with their names and a line for each row.
pub(crate) fn write_csv(table: &dyn Tabular, output: Output) -> Result<(), Failure> {
    let columns = columns_in_units(table);
    let names: Vec<&str> = columns.iter().map(|(name, _)| &**name).collect();
    let rows = columns.iter().filter_map(|(_, column)| rows(column)).min().unwrap_or(0);
    let columns: Vec<Cells> = columns.iter().map(|(_, column)| cells(column)).collect();
    output.write_with(|out| {
        writeln!(out, "{}", names.join(","))?;
        let mut line = String::new();
        (0..rows).try_for_each(|row| write_row(out, &mut line, &columns, row))?;
        table.note().iter().try_for_each(|note| writeln!(out, "# {}", harmless(note)))
    })
}

fn write_row(
    out: &mut dyn Write,
    line: &mut String,
    columns: &[Cells],
    row: usize,
) -> io::Result<()> {
    line.clear();
    for (i, column) in columns.iter().enumerate() {
        if i > 0 {
            line.push(',');
        }
        column(row, line);
    }
    line.push('\n');
    out.write_all(line.as_bytes())
}

/// Number of rows of a column; `None` for one that repeats to the end of the table.
fn rows(column: &Column) -> Option<usize> {
    match column {
        Column::Numbers(values) => Some(values.len()),
        Column::Optional(values) => Some(values.count()),
        Column::Words(words, _) => Some(words.count()),
        Column::Repeated { .. } => None,
    }
}

/// A function that appends the text of a row of a column to a line.
type Cells<'a> = Box<dyn Fn(usize, &mut String) + 'a>;

fn cells<'a>(column: &'a Column) -> Cells<'a> {
    match column {
        Column::Numbers(values) => Box::new(|row, line| line.push_str(&values[row].to_string())),
        Column::Optional(values) => Box::new(|row, line| {
            line.push_str(&values.at(row).map(|value| value.to_string()).unwrap_or_default());
        }),
        Column::Words(words, _) => Box::new(|row, line| line.push_str(&harmless(&words.at(row)))),
        Column::Repeated { values, each } => {
            // Formatted once, because shortest digits are expensive.
            let texts: Vec<String> = values.iter().map(f64::to_string).collect();
            Box::new(move |row, line| line.push_str(&texts[row / each % texts.len()]))
        }
    }
}

/// Writes the arrays as a NumPy archive.
pub(crate) fn write_arrays(table: &dyn Tabular, output: Output) -> Result<(), Failure> {
    output.write_with(|out| {
        let mut arrays = arrays_in_units(table).map(|(name, array)| NamedArray {
            name,
            shape: array.shape,
            values: array.values,
        });
        write_npz(&mut arrays, out)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;
    use stickslip::Named;

    struct Kinds;

    impl Tabular for Kinds {
        fn columns(&self) -> Vec<Named<'_>> {
            let words = |words: [&str; 3]| words.map(String::from).to_vec();
            vec![
                ("a", vec![0.1, -2.0, 1e300].into()),
                ("b", vec![Some(1.0), None, Some(3.5)].into()),
                ("c", Column::Words(words(["x", "", "z"]).into(), Some(vec![0.0; 3].into()))),
                ("d", Column::words(words(["p", "q", "r"]))),
                ("e", Column::Repeated { values: vec![1.0, 2.0].into(), each: 2 }),
            ]
        }
    }

    #[test]
    fn every_kind_of_column_is_written() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("kinds.csv");
        write_csv(&Kinds, Output::open("--output", &path).unwrap()).unwrap();
        let text = std::fs::read_to_string(Path::new(&path)).unwrap();
        assert_eq!(text.lines().next(), Some("a,b,c,d,e"));
        assert_eq!(text.lines().nth(1), Some("0.1,1,x,p,1"));
        assert_eq!(text.lines().nth(2), Some("-2,,,q,1"));
        assert!(text.lines().nth(3).unwrap().ends_with(",3.5,z,r,2"), "{text}");
        let names: Vec<&str> = Kinds.arrays().into_iter().map(|(name, _)| name).collect();
        assert_eq!(names, ["a", "b", "c", "e"]);
    }
}
