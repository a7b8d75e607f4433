//! From a document to Python: structs are dicts, names are strings, sequences of numbers are arrays.
//!
//! A sequence whose entries are all numbers, or null, is an array of float64, NaN where it is null; one of rows of
//! equal length is an array of two axes; any other is a list. An empty one is an empty array.

use numpy::ndarray::Array2;
use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList, PyString};
use serde_json::Value;

/// The value in Python; arrays cannot be written to, as the document that they are of does not change.
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

/// Numbers in Rust's memory as an array, which then has it.
pub(crate) fn array(py: Python<'_>, numbers: Vec<f64>) -> Bound<'_, PyArray1<f64>> {
    let array = PyArray1::from_vec(py, numbers);
    drop(array.readwrite().make_nonwriteable());
    array
}

/// The same of rows of equal length.
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

/// The entries as numbers, if they are; nulls alone are none.
fn numbers(entries: &[Value]) -> Option<Vec<f64>> {
    let number = |entry: &Value| if entry.is_null() { Some(f64::NAN) } else { entry.as_f64() };
    let numbers: Vec<f64> = entries.iter().map(number).collect::<Option<_>>()?;
    (numbers.is_empty() || !numbers.iter().all(|x| x.is_nan())).then_some(numbers)
}
