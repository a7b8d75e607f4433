//! Columns and arrays of a document, declared in one place for CSV and NumPy archives.

use crate::InUnits;
use std::borrow::Cow;

/// A column of a table.
#[derive(Debug, Clone, PartialEq)]
pub enum Column<'a> {
    /// A number in each row.
    Numbers(Cow<'a, [f64]>),
    /// A number or nothing: an empty cell, or NaN in an array.
    Optional(Cow<'a, [Option<f64>]>),
    /// Each of `values` repeated for `each` rows, and the whole repeated to the end of the table.
    Repeated {
        /// Values, from the first row on.
        values: Cow<'a, [f64]>,
        /// Number of consecutive rows with the same value.
        each: usize,
    },
    /// Words, and if defined the numbers that represent them in an array.
    Words(Vec<String>, Option<Vec<f64>>),
}

/// A name and the column below it.
pub type Named<'a> = (&'static str, Column<'a>);

/// An array in row-major order.
#[derive(Debug, Clone, PartialEq)]
pub struct Array<'a> {
    /// Lengths of its axes.
    pub shape: Vec<usize>,
    /// Values; their number is the product of these lengths.
    pub values: Cow<'a, [f64]>,
}

/// A document that can be written as a table (CSV) or as arrays (NPZ).
pub trait Tabular {
    /// The columns of the table; empty if the document has no table.
    fn columns(&self) -> Vec<Named<'_>>;

    /// A comment below the table, for information that no column contains.
    fn note(&self) -> Option<String> {
        None
    }

    /// The numbers in physical units, if requested.
    fn physical(&self) -> Option<&InUnits> {
        None
    }

    /// The arrays; by default the columns.
    fn arrays(&self) -> Vec<(&'static str, Array<'_>)> {
        let columns = self.columns();
        columns.into_iter().filter_map(|(name, column)| Some((name, column.array()?))).collect()
    }
}

impl<'a> Column<'a> {
    /// A column of these numbers.
    pub fn of(values: &'a [f64]) -> Self {
        Self::Numbers(values.into())
    }

    /// A column of numbers, some of which may be missing.
    pub fn optional(values: &'a [Option<f64>]) -> Self {
        Self::Optional(values.into())
    }

    /// The column multiplied by a factor.
    pub(crate) fn times(self, factor: f64) -> Column<'static> {
        let times = |values: &[f64]| values.iter().map(|v| v * factor).collect::<Vec<_>>();
        match self {
            Self::Numbers(values) => times(&values).into(),
            Self::Optional(values) => {
                values.iter().map(|v| v.map(|v| v * factor)).collect::<Vec<_>>().into()
            }
            Self::Repeated { values, each } => {
                Column::Repeated { values: times(&values).into(), each }
            }
            Self::Words(words, numbers) => Column::Words(words, numbers),
        }
    }

    /// The column as an array, without repetitions; `None` for words without numbers.
    pub fn array(self) -> Option<Array<'a>> {
        let values = match self {
            Self::Numbers(values) | Self::Repeated { values, .. } => values,
            Self::Optional(values) => values.iter().map(|v| v.unwrap_or(f64::NAN)).collect(),
            Self::Words(_, numbers) => numbers?.into(),
        };
        Some(Array { shape: vec![values.len()], values })
    }
}

impl From<Vec<f64>> for Column<'_> {
    fn from(values: Vec<f64>) -> Self {
        Self::Numbers(values.into())
    }
}

impl From<Vec<Option<f64>>> for Column<'_> {
    fn from(values: Vec<Option<f64>>) -> Self {
        Self::Optional(values.into())
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

    /// A matrix of rows of equal length.
    pub fn matrix(rows: &[Vec<f64>]) -> Self {
        let shape = vec![rows.len(), rows.first().map_or(0, Vec::len)];
        Self { shape, values: rows.concat().into() }
    }
}
