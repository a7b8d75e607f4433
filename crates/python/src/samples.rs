//! The samples of a run, which are moved to Python without a copy.
//!
//! The arrays of Python own the memory in which the run was recorded. The document receives copies while it is written or
//! drawn.

use crate::value::array;
use numpy::{PyArray1, PyArrayMethods};
use pyo3::prelude::*;
use std::any::Any;
use stickslip::{RunDocument, Samples};
use stickslip_cli::hosted::Document;

/// The columns of a run that Python owns.
pub(crate) struct Taken(Vec<(&'static str, Py<PyArray1<f64>>)>);

impl Taken {
    /// Moves the samples out of a document, if it is a run.
    pub(crate) fn from(py: Python<'_>, document: &mut dyn Document) -> Option<Self> {
        let samples = samples(document)?;
        let mut taken = vec![];
        for (name, column) in columns(samples) {
            if let Some(numbers) = column {
                taken.push((name, array(py, numbers).unbind()));
            }
        }
        Some(Self(taken))
    }

    /// The columns with their names.
    pub(crate) fn columns(&self) -> impl Iterator<Item = (&'static str, &Py<PyArray1<f64>>)> {
        self.0.iter().map(|(name, array)| (*name, array))
    }

    /// Copies of the columns, for the document.
    pub(crate) fn copies(&self, py: Python<'_>) -> PyResult<Vec<(&'static str, Vec<f64>)>> {
        let copy = |(name, column): (_, &Py<PyArray1<f64>>)| Ok((name, column.bind(py).to_vec()?));
        self.columns().map(copy).collect()
    }
}

/// Moves copies into the document.
pub(crate) fn restore(document: &mut dyn Document, copies: Vec<(&'static str, Vec<f64>)>) {
    let Some(samples) = samples(document) else { return };
    for (name, numbers) in copies {
        match name {
            "t" => samples.t = numbers,
            "x0" => samples.x0 = numbers,
            "velocity" => samples.velocity = numbers,
            "l" => samples.l = Some(numbers),
            "lag" => samples.lag = Some(numbers),
            "height" => samples.height = Some(numbers),
            "weight" => samples.weight = Some(numbers),
            "y0" => samples.y0 = Some(numbers),
            _ => samples.velocity_y = Some(numbers),
        }
    }
}

/// Removes the copies from the document.
pub(crate) fn forget(document: &mut dyn Document) {
    if let Some(samples) = samples(document) {
        drop(columns(samples));
    }
}

fn samples(document: &mut dyn Any) -> Option<&mut Samples> {
    document.downcast_mut::<RunDocument>().map(|run| &mut run.samples)
}

/// The existing columns, moved out.
fn columns(samples: &mut Samples) -> [(&'static str, Option<Vec<f64>>); 9] {
    let Samples { t, l, lag, x0, velocity, height, weight, y0, velocity_y } = samples;
    [
        ("t", Some(std::mem::take(t))),
        ("l", l.take()),
        ("lag", lag.take()),
        ("x0", Some(std::mem::take(x0))),
        ("velocity", Some(std::mem::take(velocity))),
        ("height", height.take()),
        ("weight", weight.take()),
        ("y0", y0.take()),
        ("velocity_y", velocity_y.take()),
    ]
}
