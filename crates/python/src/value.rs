//! Conversion of a document to Python: structs are dicts, names are strings, sequences of numbers are arrays.
//!
//! A sequence of numbers and nulls is an array of float64, with NaN for null. A sequence of rows of equal length is an array
//! with two axes. Any other sequence is a list. An empty sequence is an empty array.

use numpy::ndarray::Array2;
use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList, PyString};
use serde_json::Value;

/// The value in Python. Arrays are read-only, because the document does not change.
pub(crate) fn python(py: Python<'_>, value: Value) -> PyResult<Bound<'_, PyAny>> {
    Ok(match value {
        Value::Null => py.None().into_bound(py),
        Value::Bool(value) => value.into_pyobject(py)?.to_owned().into_any(),
        Value::Number(value) => match value.as_i64() {
            Some(integer) => integer.into_pyobject(py)?.into_any(),
            None => value.as_f64().into_pyobject(py)?.into_any(),
        },
        Value::String(text) => PyString::new(py, &text).into_any(),
        Value::Array(entries) => sequence(py, entries)?,
        Value::Object(fields) => {
            let dict = PyDict::new(py);
            for (name, value) in fields {
                dict.set_item(name, python(py, value)?)?;
            }
            dict.into_any()
        }
    })
}

/// An array that takes ownership of the numbers.
pub(crate) fn array(py: Python<'_>, numbers: Vec<f64>) -> Bound<'_, PyArray1<f64>> {
    let array = PyArray1::from_vec(py, numbers);
    drop(array.readwrite().make_nonwriteable());
    array
}

/// An array of rows of equal length that takes ownership of the numbers.
pub(crate) fn matrix(
    py: Python<'_>,
    (rows, columns): (usize, usize),
    numbers: Vec<f64>,
) -> PyResult<Bound<'_, PyArray2<f64>>> {
    let array = Array2::from_shape_vec((rows, columns), numbers);
    let array = array.map_err(|error| PyTypeError::new_err(error.to_string()))?;
    let array = PyArray2::from_owned_array(py, array);
    drop(array.readwrite().make_nonwriteable());
    Ok(array)
}

fn sequence(py: Python<'_>, entries: Vec<Value>) -> PyResult<Bound<'_, PyAny>> {
    if let Some(numbers) = numbers(&entries) {
        return Ok(array(py, numbers).into_any());
    }
    if let Some(width) = entries.first().and_then(Value::as_array).map(Vec::len) {
        let row = |entry: &Value| numbers(entry.as_array().filter(|row| row.len() == width)?);
        let rows: Option<Vec<Vec<f64>>> = entries.iter().map(row).collect();
        if let Some(rows) = rows {
            return Ok(matrix(py, (rows.len(), width), rows.concat())?.into_any());
        }
    }
    let values: PyResult<Vec<_>> = entries.into_iter().map(|entry| python(py, entry)).collect();
    Ok(PyList::new(py, values?)?.into_any())
}

/// The entries as numbers; None if an entry is not a number, or if all are null.
fn numbers(entries: &[Value]) -> Option<Vec<f64>> {
    let number = |entry: &Value| if entry.is_null() { Some(f64::NAN) } else { entry.as_f64() };
    let numbers: Vec<f64> = entries.iter().map(number).collect::<Option<_>>()?;
    (numbers.is_empty() || !numbers.iter().all(|x| x.is_nan())).then_some(numbers)
}
