//! NumPy archives.

use crate::failure::Failure;
use ndarray::{Array1, Array2, Array3};
use ndarray_npy::NpzWriter;
use std::io::Cursor;

/// Named arrays on their way into a `.npz`.
pub(crate) struct Npz(NpzWriter<Cursor<Vec<u8>>>);

impl Npz {
    pub(crate) fn new() -> Self {
        Self(NpzWriter::new(Cursor::new(vec![])))
    }

    /// A vector.
    pub(crate) fn vector(&mut self, name: &str, values: &[f64]) -> Result<(), Failure> {
        self.0.add_array(name, &Array1::from(values.to_vec())).map_err(failed).map(drop)
    }

    /// Rows of equal length.
    pub(crate) fn matrix(&mut self, name: &str, rows: &[Vec<f64>]) -> Result<(), Failure> {
        let width = rows.first().map_or(0, Vec::len);
        let array = Array2::from_shape_vec((rows.len(), width), rows.concat());
        let array = array.map_err(|error| Failure::Run(format!("{name}: {error}")))?;
        self.0.add_array(name, &array).map_err(failed).map(drop)
    }

    /// An array of three axes, its values in row-major order.
    pub(crate) fn cube(
        &mut self,
        name: &str,
        shape: [usize; 3],
        values: Vec<f64>,
    ) -> Result<(), Failure> {
        let array = Array3::from_shape_vec(shape, values);
        let array = array.map_err(|error| Failure::Run(format!("{name}: {error}")))?;
        self.0.add_array(name, &array).map_err(failed).map(drop)
    }

    /// The finished archive.
    pub(crate) fn bytes(self) -> Result<Vec<u8>, Failure> {
        Ok(self.0.finish().map_err(failed)?.into_inner())
    }
}

fn failed(error: ndarray_npy::WriteNpzError) -> Failure {
    Failure::Run(format!("cannot make the .npz archive: {error}"))
}
