//! Columns and arrays of a document, declared in one place for CSV and NumPy archives.

use crate::InUnits;
use std::borrow::Cow;
use std::fmt;
use std::sync::Arc;

/// A column of a table.
#[derive(Debug, Clone)]
pub enum Column<'a> {
    /// A number in each row.
    Numbers(Cow<'a, [f64]>),
    /// A number or nothing: an empty cell, or NaN in an array.
    Optional(Rows<'a, Option<f64>>),
    /// Each of `values` repeated for `each` rows, and the whole repeated to the end of the table.
    Repeated {
        /// Values, from the first row on.
        values: Cow<'a, [f64]>,
        /// Number of consecutive rows with the same value.
        each: usize,
    },
    /// Words, and if defined the numbers that represent them in an array.
    Words(Rows<'a, String>, Option<Rows<'a, f64>>),
}

/// Values computed row by row, so that a long table need not hold all of its columns at once.
#[derive(Clone)]
pub struct Rows<'a, T> {
    count: usize,
    at: Arc<dyn Fn(usize) -> T + 'a>,
}

impl<'a, T> Rows<'a, T> {
    /// The values of `at` for the rows from 0 to `count` - 1.
    pub fn new(count: usize, at: impl Fn(usize) -> T + 'a) -> Self {
        Self { count, at: Arc::new(at) }
    }

    /// Number of rows.
    pub fn count(&self) -> usize {
        self.count
    }

    /// The value in a row.
    pub fn at(&self, row: usize) -> T {
        (self.at)(row)
    }

    /// All values.
    pub fn iter(&self) -> impl Iterator<Item = T> {
        (0..self.count).map(|row| self.at(row))
    }
}

impl<T: Clone + 'static> From<Vec<T>> for Rows<'_, T> {
    fn from(values: Vec<T>) -> Self {
        Self::new(values.len(), move |row| values[row].clone())
    }
}

impl<T> fmt::Debug for Rows<'_, T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} rows", self.count)
    }
}

/// A name and the column below it.
pub type Named<'a> = (&'static str, Column<'a>);

/// An array in row-major order.
#[derive(Debug, Clone, PartialEq)]
pub struct Array<'a> {
    /// Lengths of the axes.
    pub shape: Vec<usize>,
    /// Values; their number is the product of the lengths in `shape`.
    pub values: Cow<'a, [f64]>,
}

/// A document that can be written as a table (CSV) or as arrays (NPZ).
pub trait Tabular {
    /// The columns of the table; empty if the document has no table.
    fn columns(&self) -> Vec<Named<'_>> {
        vec![]
    }

    /// A comment below the table, for information that no column contains.
    fn note(&self) -> Option<String> {
        None
    }

    /// The numbers in physical units, if requested.
    fn physical(&self) -> Option<&InUnits> {
        None
    }

    /// The unit of the numbers in a column or array of measured data, if it is known.
    fn unit_of(&self, _column: &str) -> Option<&str> {
        None
    }

    /// The arrays; by default the columns.
    fn arrays(&self) -> Vec<(&'static str, Array<'_>)> {
        as_arrays(self.columns()).collect()
    }

    /// The same arrays, one at a time: a document with many rows computes each when it is needed.
    fn each_array(&self) -> Box<dyn Iterator<Item = (&'static str, Array<'_>)> + '_> {
        Box::new(self.arrays().into_iter())
    }
}

/// Columns of numbers from variables, each named after its variable.
macro_rules! columns {
    ($($column:ident),+) => {
        vec![$((stringify!($column), $crate::Column::from($column))),+]
    };
}

pub(crate) use columns;

/// The columns as arrays, except columns of words without numbers.
pub(crate) fn as_arrays(
    columns: Vec<Named<'_>>,
) -> impl Iterator<Item = (&'static str, Array<'_>)> {
    columns.into_iter().filter_map(|(name, column)| Some((name, column.array()?)))
}

impl<'a> Column<'a> {
    /// A column of words that no array contains.
    pub fn words(words: impl IntoIterator<Item = String>) -> Self {
        Self::Words(words.into_iter().collect::<Vec<_>>().into(), None)
    }

    /// The column multiplied by a factor.
    pub(crate) fn times(self, factor: f64) -> Self {
        let times = |values: &[f64]| values.iter().map(|v| v * factor).collect::<Vec<_>>();
        match self {
            Self::Numbers(values) => times(&values).into(),
            Self::Optional(values) => {
                let count = values.count();
                Self::Optional(Rows::new(count, move |row| values.at(row).map(|v| v * factor)))
            }
            Self::Repeated { values, each } => {
                Self::Repeated { values: times(&values).into(), each }
            }
            words @ Self::Words(..) => words,
        }
    }

    /// The column as an array, without repetitions; `None` for words without numbers.
    pub fn array(self) -> Option<Array<'a>> {
        let values = match self {
            Self::Numbers(values) | Self::Repeated { values, .. } => values,
            Self::Optional(values) => values.iter().map(|v| v.unwrap_or(f64::NAN)).collect(),
            Self::Words(_, numbers) => numbers?.iter().collect(),
        };
        Some(Array { shape: vec![values.len()], values })
    }
}

impl<'a> From<&'a Vec<f64>> for Column<'a> {
    fn from(values: &'a Vec<f64>) -> Self {
        Self::Numbers(values.into())
    }
}

impl<'a> From<&'a Vec<Option<f64>>> for Column<'a> {
    /// A column of numbers, some of which may be missing.
    fn from(values: &'a Vec<Option<f64>>) -> Self {
        Self::Optional(Rows::new(values.len(), |row| values[row]))
    }
}

impl From<Vec<f64>> for Column<'_> {
    fn from(values: Vec<f64>) -> Self {
        Self::Numbers(values.into())
    }
}

impl<'v> FromIterator<&'v Vec<f64>> for Column<'_> {
    /// Lists of numbers, one after the other.
    fn from_iter<I: IntoIterator<Item = &'v Vec<f64>>>(lists: I) -> Self {
        joined(lists).into()
    }
}

/// Lists, one after the other.
pub(crate) fn joined<'v, T: Copy + 'v>(lists: impl IntoIterator<Item = &'v Vec<T>>) -> Vec<T> {
    lists.into_iter().map(Vec::as_slice).collect::<Vec<_>>().concat()
}

impl From<Vec<Option<f64>>> for Column<'_> {
    fn from(values: Vec<Option<f64>>) -> Self {
        Self::Optional(values.into())
    }
}

impl FromIterator<f64> for Column<'_> {
    fn from_iter<I: IntoIterator<Item = f64>>(values: I) -> Self {
        values.into_iter().collect::<Vec<_>>().into()
    }
}

impl FromIterator<Option<f64>> for Column<'_> {
    fn from_iter<I: IntoIterator<Item = Option<f64>>>(values: I) -> Self {
        values.into_iter().collect::<Vec<_>>().into()
    }
}

impl<'a> Array<'a> {
    /// The array multiplied by a factor.
    pub(crate) fn times(self, factor: f64) -> Array<'static> {
        let values: Vec<f64> = self.values.iter().map(|v| v * factor).collect();
        Array { shape: self.shape, values: values.into() }
    }

    /// A vector.
    pub fn vector(values: impl Into<Cow<'a, [f64]>>) -> Self {
        let values = values.into();
        Self { shape: vec![values.len()], values }
    }

    /// A matrix of rows of a length that their type fixes.
    pub(crate) fn of_rows<const N: usize>(rows: impl Into<Cow<'a, [[f64; N]]>>) -> Self {
        let rows = rows.into();
        let shape = vec![rows.len(), N];
        let values = match rows {
            Cow::Borrowed(rows) => rows.as_flattened().into(),
            Cow::Owned(rows) => rows.into_flattened().into(),
        };
        Self { shape, values }
    }

    /// A matrix of rows of equal length.
    pub fn matrix(rows: &[Vec<f64>]) -> Self {
        let shape = vec![rows.len(), rows.first().map_or(0, Vec::len)];
        Self { shape, values: rows.concat().into() }
    }
}
