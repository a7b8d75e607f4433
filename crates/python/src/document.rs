//! A document in Rust's memory, with methods for Python.

use crate::failed::unusable;
use crate::fields;
use crate::motion;
use crate::samples::{self, Taken};
use crate::value::{array, matrix, python};
use numpy::{PyArray2, PyReadonlyArray1};
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};
use std::any::Any;
use std::path::Path;
use std::sync::{Mutex, MutexGuard, OnceLock, PoisonError};
use stickslip::RunDocument;
use stickslip_cli::hosted::{self, Made};
use stickslip_figures::{
    self as figures, AnimationFormat, FigureFormat, Film, Shot, Size, View, Width,
};
use stickslip_tip::Trajectory;

/// The result of a command, or the content of a file.
#[pyclass(frozen, module = "stickslip._native")]
pub(crate) struct Document {
    document: Mutex<Box<dyn hosted::Document>>,
    /// The samples of a run, which Python owns.
    samples: Option<Taken>,
    trajectory: OnceLock<Trajectory>,
    /// The result in one line.
    #[pyo3(get)]
    headline: String,
    /// The result in aligned lines.
    #[pyo3(get)]
    text: String,
}

impl Document {
    pub(crate) fn new(py: Python<'_>, mut made: Made) -> Self {
        Self {
            samples: Taken::from(py, &mut *made.document),
            document: Mutex::new(made.document),
            trajectory: OnceLock::new(),
            headline: made.headline,
            text: made.text,
        }
    }

    fn locked(&self) -> MutexGuard<'_, Box<dyn hosted::Document>> {
        self.document.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Applies `work` to the whole document, while other threads of Python run.
    pub(crate) fn whole<T: Send>(
        &self,
        py: Python<'_>,
        work: impl FnOnce(&dyn hosted::Document) -> T + Send,
    ) -> PyResult<T> {
        let copies = self.samples.as_ref().map(|samples| samples.copies(py)).transpose()?;
        Ok(py.detach(|| {
            let mut document = self.locked();
            let Some(copies) = copies else { return work(&**document) };
            samples::restore(&mut **document, copies);
            let done = work(&**document);
            samples::forget(&mut **document);
            done
        }))
    }

    /// Applies `work` to a run and its trajectory; the samples are not needed.
    fn of_run<T: Send>(
        &self,
        py: Python<'_>,
        work: impl FnOnce(&RunDocument, &Trajectory) -> PyResult<T> + Send,
    ) -> PyResult<T> {
        py.detach(|| {
            let document = self.locked();
            let run = (&**document as &dyn Any).downcast_ref::<RunDocument>();
            let run = run.ok_or_else(|| unusable("only a run has a motion"))?;
            if self.trajectory.get().is_none() {
                self.trajectory.set(run.trajectory().map_err(unusable)?).ok();
            }
            let trajectory = self.trajectory.get();
            let trajectory = trajectory.ok_or_else(|| PyRuntimeError::new_err("no trajectory"))?;
            work(run, trajectory)
        })
    }
}

#[pymethods]
impl Document {
    /// The names of the fields of the document.
    fn names(&self, py: Python<'_>) -> PyResult<Vec<String>> {
        let names = py.detach(|| fields::names(self.locked().serialized()));
        names.map_err(unusable)
    }

    /// A field by its name; None if it is null or absent.
    fn field<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Option<Bound<'py, PyAny>>> {
        if let ("samples", Some(samples)) = (name, &self.samples) {
            let dict = PyDict::new(py);
            for (name, column) in samples.columns() {
                dict.set_item(name, column)?;
            }
            return Ok(Some(dict.into_any()));
        }
        let found = py.detach(|| fields::field(self.locked().serialized(), name));
        found.map_err(unusable)?.map(|value| python(py, value)).transpose()
    }

    /// The table: columns by name, in order; columns of words are lists.
    fn columns<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        use stickslip::Column;
        let own = |column: Column<'_>| match column {
            Column::Words(words, _) => Err(words.iter().collect::<Vec<_>>()),
            // A column of missing numbers is an array of NaN.
            numbers => Ok(numbers.array().map_or_else(Vec::new, |array| array.values.into_owned())),
        };
        let columns = self.whole(py, |document| {
            let columns = document.drawn().columns().into_iter();
            columns.map(|(name, column)| (name, own(column))).collect::<Vec<_>>()
        })?;
        let dict = PyDict::new(py);
        for (name, values) in columns {
            match values {
                Ok(numbers) => dict.set_item(name, array(py, numbers))?,
                Err(words) => dict.set_item(name, words)?,
            }
        }
        Ok(dict)
    }

    /// The JSON text, as the program writes it.
    fn json(&self, py: Python<'_>) -> PyResult<String> {
        let text = self.whole(py, |document| serde_json::to_string(document.serialized()))?;
        text.map_err(unusable)
    }

    /// A picture of the document, as `stickslip plot` draws it: "svg", "png" or "pdf".
    #[pyo3(signature = (format, width=None, dpi=None, x_range=None, y_range=None))]
    fn picture<'py>(
        &self,
        py: Python<'py>,
        format: &str,
        width: Option<&str>,
        dpi: Option<f64>,
        x_range: Option<[f64; 2]>,
        y_range: Option<[f64; 2]>,
    ) -> PyResult<Bound<'py, PyBytes>> {
        let format = FigureFormat::of(Path::new(&format!("picture.{format}"))).map_err(unusable)?;
        let width = width.map(str::parse::<Width>).transpose().map_err(unusable)?;
        let size = Size::new(width, dpi).map_err(unusable)?;
        let view = View { x_range, y_range, ..View::default() };
        let bytes = self.whole(py, |document| {
            let figure = figures::of(document.drawn(), &view).map_err(unusable)?;
            figures::draw(&figure, format, &size).map_err(unusable)
        })??;
        Ok(PyBytes::new(py, &bytes))
    }

    /// An animation of the document, as `stickslip plot` makes it: "gif", "webp" or "apng".
    #[pyo3(signature = (format, times=None, seconds=None, fps=None, width=None))]
    fn animation<'py>(
        &self,
        py: Python<'py>,
        format: &str,
        times: Option<[f64; 2]>,
        seconds: Option<f64>,
        fps: Option<f64>,
        width: Option<&str>,
    ) -> PyResult<Bound<'py, PyBytes>> {
        let name = format!("animation.{format}");
        let format = AnimationFormat::of(Path::new(&name))
            .ok_or_else(|| unusable("an animation is a .gif, .webp or .apng"))?;
        let width = width.map(str::parse::<Width>).transpose().map_err(unusable)?;
        let film = Film::new(seconds, fps, width).map_err(unusable)?;
        let shot = Shot { times, scales: None };
        let bytes = self.whole(py, |document| {
            let mut scene = figures::scene_of(document.drawn(), &shot).map_err(unusable)?;
            figures::animate(&mut *scene, format, &film).map_err(unusable)
        })??;
        Ok(PyBytes::new(py, &bytes))
    }

    /// First and last time in the history of a run.
    fn span(&self, py: Python<'_>) -> PyResult<(f64, f64)> {
        self.of_run(py, |_, trajectory| Ok((trajectory.start(), trajectory.end())))
    }

    /// Rows l, x0, velocity and lag of a run at times t; NaN if a quantity is not defined.
    fn motion<'py>(
        &self,
        py: Python<'py>,
        t: PyReadonlyArray1<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let t = t.as_array().to_vec();
        let rows = self.of_run(py, |_, trajectory| motion::at(trajectory, &t))?;
        matrix(py, (4, rows.len() / 4), rows)
    }

    /// Heights u(x,t) of a run, one row for each t.
    fn heights<'py>(
        &self,
        py: Python<'py>,
        x: PyReadonlyArray1<'py, f64>,
        t: PyReadonlyArray1<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let (x, t) = (x.as_array().to_vec(), t.as_array().to_vec());
        let rows = self.of_run(py, |run, trajectory| motion::heights(run, trajectory, &x, &t))?;
        matrix(py, (t.len(), x.len()), rows)
    }
}
