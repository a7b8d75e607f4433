//! Functions of the libraries for the web page `crates/web/page`, which calls them in its workers.
//!
//! Parameters and results are JSON texts, columns of numbers are arrays. Documents are those of the program
//! (`stickslip`), and each comes with the command line that computes it.

mod declared;
mod limits;
mod line;
mod linear;
mod map;
mod motion;
mod parameters;
mod refusal;
mod scan;
mod walk;

use motion::Motion;
use parameters::Parameters;
use refusal::Refusal;
use serde::Serialize;
use stickslip::{Ask, Context, RunFound, Samples};
use wasm_bindgen::prelude::*;

fn json(result: &impl Serialize) -> Result<String, JsError> {
    Ok(serde_json::to_string(result)?)
}

/// The result of a run without its samples and history.
#[derive(Serialize)]
struct Summary {
    #[serde(flatten)]
    found: RunFound,
    remarks: Vec<String>,
}

/// A run with its history.
#[wasm_bindgen]
pub struct Tip(Motion);

#[wasm_bindgen]
impl Tip {
    /// Integrates the motion.
    ///
    /// # Errors
    /// A parameter out of range, or a run that fails.
    #[wasm_bindgen(constructor)]
    pub fn new(parameters: &str) -> Result<Self, JsError> {
        Ok(Self(Motion::of(&Parameters::read(parameters)?, js_sys::Date::now)?))
    }

    /// Columns t, l, x0', lag R - x0, x0 and y0 at the default times of the program, one column after the other.
    pub fn samples(&self) -> Vec<f64> {
        self.0.columns()
    }

    /// Heights u at `count` points from `from` to `to` along the scan, at the y of the tip, at time t; at the nearer
    /// end of the run for a time outside of it.
    ///
    /// # Errors
    /// An x that is not finite.
    pub fn heights(&self, t: f64, from: f64, to: f64, count: usize) -> Result<Vec<f64>, JsError> {
        Ok(self.0.heights(t, (from, to), count)?)
    }

    /// The position x0 of the tip, the position of the support, and y0, at time t.
    pub fn positions(&self, t: f64) -> Vec<f64> {
        self.0.positions(t).to_vec()
    }

    /// The time at which a run was cut off because it took too long; `None` for a complete run.
    pub fn cut_off(&self) -> Option<f64> {
        self.0.cut_off()
    }

    /// The classification of the run with its numbers, as in its document.
    ///
    /// # Errors
    /// A value that is not representable in JSON.
    pub fn summary(&self) -> Result<String, JsError> {
        let document = self.0.document();
        let mut found = document.answer.clone();
        (found.history, found.samples) = (None, Samples::default());
        json(&Summary { found, remarks: document.remarks.clone() })
    }

    /// The document of the run, as the program writes it.
    ///
    /// # Errors
    /// A value that is not representable in JSON.
    pub fn document(&self) -> Result<String, JsError> {
        json(self.0.document())
    }
}

/// Linear theory: αc, growth exponents and steady motion.
///
/// # Errors
/// A parameter out of range.
#[wasm_bindgen]
pub fn linear(parameters: &str) -> Result<String, JsError> {
    json(&linear::linear(&Parameters::read(parameters)?)?)
}

/// The document of the limit cycle.
///
/// # Errors
/// A parameter out of range, or no cycle at these parameters.
#[wasm_bindgen]
pub fn cycle(parameters: &str) -> Result<String, JsError> {
    let found = Parameters::read(parameters)?.cycle()?.ask(&Context::default());
    json(&found.map_err(Refusal::Question)?)
}

/// The command line that computes the same run.
///
/// # Errors
/// Text that is not a set of parameters.
#[wasm_bindgen]
pub fn command(parameters: &str) -> Result<String, JsError> {
    Ok(line::run(&Parameters::read(parameters)?))
}

/// The classes (see `map`) of the motions at one r and several α.
///
/// # Errors
/// A parameter out of range.
#[wasm_bindgen]
pub fn settled(parameters: &str, r: f64, alphas: &[f64]) -> Result<Vec<u8>, JsError> {
    Ok(map::row(&Parameters::read(parameters)?, r, alphas)?)
}

/// The critical α at each r, NaN where steady motion has no onset.
///
/// # Errors
/// A tip out of range.
#[wasm_bindgen]
pub fn boundary(parameters: &str, velocities: &[f64]) -> Result<Vec<f64>, JsError> {
    Ok(map::boundary(&Parameters::read(parameters)?, velocities)?)
}

/// Scans line by line and returns the pattern.
///
/// After each line, `on_line(line, row, columns, heights)` receives the rows of the surface that the line has changed.
/// The first of them has the number `row`; each has `columns` heights.
///
/// # Errors
/// A parameter out of range, or a line that fails.
#[wasm_bindgen]
pub fn raster(parameters: &str, scan: &str, on_line: &js_sys::Function) -> Result<String, JsError> {
    let (parameters, scan) = (Parameters::read(parameters)?, scan::Scan::read(scan)?);
    json(&scan::raster(&parameters, &scan, |line, row, columns, heights| {
        let heights = js_sys::Float64Array::from(heights);
        let [line, row, columns] = [line, row, columns].map(|n| JsValue::from(n as f64));
        // An error in the page does not end the scan.
        let _ =
            on_line.apply(&JsValue::NULL, &[line, row, columns, heights.into()].iter().collect());
    })?)
}

/// The command line that computes the same raster.
///
/// # Errors
/// Text that is not a set of parameters.
#[wasm_bindgen]
pub fn raster_command(parameters: &str, scan: &str) -> Result<String, JsError> {
    Ok(line::raster(&Parameters::read(parameters)?, &scan::Scan::read(scan)?))
}

/// The document of a walker.
///
/// # Errors
/// A parameter out of range, or a run that fails.
#[wasm_bindgen]
pub fn walker(parameters: &str) -> Result<String, JsError> {
    json(&walk::walker(parameters, js_sys::Date::now)?)
}

/// The command line that computes the same walker.
///
/// # Errors
/// Text that is not a set of parameters.
#[wasm_bindgen]
pub fn walker_command(parameters: &str) -> Result<String, JsError> {
    Ok(line::walker(&serde_json::from_str(parameters).map_err(Refusal::Json)?))
}

/// The parameters of the questions `run`, `raster` and `walker`, as JSON.
///
/// `examples/declared.rs` calls this when the page is built. It is not exported to the module, which would be 70 kB larger.
///
/// # Errors
/// A value that is not representable in JSON.
pub fn declared() -> Result<String, serde_json::Error> {
    serde_json::to_string(&declared::questions())
}
