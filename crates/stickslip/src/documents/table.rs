//! What a document holds as columns and arrays, declared once: for CSV, for NumPy archives, for whoever wants numbers.

use crate::InUnits;
use std::borrow::Cow;

/// A column of a table.
#[derive(Debug, Clone, PartialEq)]
pub enum Column<'a> {
    /// A number in each row.
    Numbers(Cow<'a, [f64]>),
    /// A number, or none: an empty cell, NaN in an array.
    Optional(Cow<'a, [Option<f64>]>),
    /// Each of `values` for `each` rows, and over again to the end of the table.
    Repeated {
        /// From the first row on.
        values: Cow<'a, [f64]>,
        /// Rows that have the same.
        each: usize,
    },
    /// Words, and the numbers that stand for them in an array if there are any.
    Words(Vec<String>, Option<Vec<f64>>),
}

/// A name and the column below it.
pub type Named<'a> = (&'static str, Column<'a>);

/// An array in row-major order.
#[derive(Debug, Clone, PartialEq)]
pub struct Array<'a> {
    /// Lengths of its axes.
    pub shape: Vec<usize>,
    /// As many values as the product of these.
    pub values: Cow<'a, [f64]>,
}

/// What can be had as a table, and as arrays.
pub trait Tabular {
    /// The columns of its table; none where it is no table.
    fn columns(&self) -> Vec<Named<'_>>;

    /// What a reader of the table should know and no column says; a comment below it.
    fn note(&self) -> Option<String> {
        None
    }

    /// Its numbers in physical units, where it was asked for these.
    fn physical(&self) -> Option<&InUnits> {
        None
    }

    /// Its arrays: the columns, unless it has more, or others.
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

    /// A column of numbers that need not be there.
    pub fn optional(values: &'a [Option<f64>]) -> Self {
        Self::Optional(values.into())
    }

    /// Every number of it times a factor.
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

    /// The column as an array, if words do not stand in the way; a repeated one without its repetitions.
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
    /// Every number of it times a factor.
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
