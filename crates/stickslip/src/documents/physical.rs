//! Documents with results in nm, s and nN, and their tables.

use crate::documents::table::{Array, Column, Named, Tabular};
use crate::{Dimension, InUnits, KnownScales, dimension};
use serde::Serialize;
use serde_json::Value;
use std::borrow::Cow;

/// A document that may contain its numbers in physical units too.
pub trait Physical: Serialize + Sized {
    /// The field with the numbers in physical units.
    fn physical_mut(&mut self) -> &mut Option<InUnits>;

    /// The document as JSON, without large parts that are not converted to physical units.
    fn lean(&mut self) -> serde_json::Result<Value> {
        // Through a pointer: the code that makes values of documents is compiled once.
        serde_json::to_value(self as &dyn erased_serde::Serialize)
    }

    /// Adds the numbers in physical units, as far as the scales are known.
    #[must_use]
    fn in_units(mut self, scales: Option<&KnownScales>) -> Self {
        *self.physical_mut() = None;
        // A failure here does not keep the document from being written.
        let lean = scales.map(|scales| (scales, self.lean()));
        let values = lean.and_then(|(scales, lean)| Some(InUnits::of(&lean.ok()?, scales)));
        *self.physical_mut() = values;
        self
    }
}

/// A column with its name, which contains the unit of the numbers if it is known.
pub type InUnit<'a> = (Cow<'static, str>, Column<'a>);

/// The columns of a table. Those with a dimension are converted to nm, s and nN and named accordingly, if the document
/// contains the scales. The names of measured columns contain their unit.
pub fn columns<'a>(table: &'a dyn Tabular) -> Vec<InUnit<'a>> {
    let columns = table.columns();
    let Some(physical) = table.physical() else {
        return columns.into_iter().map(|(name, column)| (measured(table, name), column)).collect();
    };
    let scales = &physical.scales;
    let force = columns.iter().find(|(name, _)| *name == "lag").and_then(|(_, lag)| {
        let factor = Dimension::FORCE.factor(scales)?;
        Some(("lateral_force_nN".into(), lag.clone().times(factor)))
    });
    columns.into_iter().map(|column| in_unit(column, scales)).chain(force).collect()
}

fn in_unit<'a>((name, column): Named<'a>, scales: &KnownScales) -> InUnit<'a> {
    match scaled(name, scales) {
        Some((factor, name)) => (name.into(), column.times(factor)),
        None => (name.into(), column),
    }
}

/// The arrays of a document, converted as in [`columns`], each computed only when it is needed.
pub fn arrays<'a>(table: &'a dyn Tabular) -> impl Iterator<Item = (Cow<'static, str>, Array<'a>)> {
    let scales = table.physical().map(|physical| physical.scales).unwrap_or_default();
    let in_unit = move |(name, array): (&'static str, Array<'a>)| match scaled(name, &scales) {
        Some((factor, name)) => (name.into(), array.times(factor)),
        None => (measured(table, name), array),
    };
    table.each_array().map(in_unit)
}

/// The name of a column with the unit of its measured numbers, such as `x_nm`; a unit that is no word is left out.
fn measured(table: &dyn Tabular, name: &'static str) -> Cow<'static, str> {
    let is_word = |unit: &&str| unit.chars().all(|c| c.is_alphanumeric() || "/%°".contains(c));
    match table.unit_of(name).filter(is_word) {
        Some(unit) => format!("{name}_{}", unit.replace('/', "_per_")).into(),
        None => name.into(),
    }
}

fn scaled(name: &str, scales: &KnownScales) -> Option<(f64, String)> {
    let dimension = dimension("", name)?;
    Some((dimension.factor(scales)?, format!("{name}_{}", dimension.suffix())))
}
