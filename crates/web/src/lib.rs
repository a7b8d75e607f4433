//! The libraries in a browser: what the page of `crates/web/page` calls, from its workers.
//!
//! Parameters come, and what is found goes, as JSON; columns of numbers go as arrays. Documents are those that the
//! program writes (`stickslip`), and each has the command line that makes the same.

mod asked;
mod declared;
mod limits;
mod line;
mod linear;
mod map;
mod motion;
mod periodic;
mod refusal;
mod scan;
mod walk;

use asked::Asked;
use motion::Motion;
use refusal::Refusal;
use serde::Serialize;
use stickslip::{RunFound, Samples};
use wasm_bindgen::prelude::*;

fn told(refusal: &Refusal) -> JsError {
    JsError::new(&refusal.to_string())
}

fn json<T: Serialize>(found: Result<T, Refusal>) -> Result<String, JsError> {
    let text = found.and_then(|found| serde_json::to_string(&found).map_err(Refusal::Json));
    text.map_err(|refusal| told(&refusal))
}

fn read(asked: &str) -> Result<Asked, JsError> {
    Asked::read(asked).map_err(|refusal| told(&refusal))
}

/// What became of a run, without its motion.
#[derive(Serialize)]
struct Judged {
    #[serde(flatten)]
    found: RunFound,
    remarks: Vec<String>,
}

/// A run that has been made.
#[wasm_bindgen]
pub struct Tip(Motion);

#[wasm_bindgen]
impl Tip {
    /// Makes the run.
    ///
    /// # Errors
    /// A parameter out of range, or a run that fails.
    #[wasm_bindgen(constructor)]
    pub fn new(asked: &str) -> Result<Self, JsError> {
        let motion = Motion::of(&read(asked)?, js_sys::Date::now);
        motion.map(Self).map_err(|refusal| told(&refusal))
    }

    /// t, l, x0', the lag R - x0, x0 and y0 at the times that the program takes by default: six columns, one after
    /// the other.
    #[must_use]
    pub fn samples(&self) -> Vec<f64> {
        self.0.columns()
    }

    /// u at time t at `count` points from `from` to `to` along the scan, at the y of the tip.
    ///
    /// # Errors
    /// t outside of the run, an x that is no number.
    pub fn heights(&self, t: f64, from: f64, to: f64, count: usize) -> Result<Vec<f64>, JsError> {
        self.0.heights(t, (from, to), count).map_err(|refusal| told(&refusal))
    }

    /// x0, the position of the support, and y0 at t.
    #[must_use]
    pub fn positions(&self, t: f64) -> Vec<f64> {
        self.0.positions(t).to_vec()
    }

    /// The time that a run reached which took too long and was cut off; nothing of one that came to its end.
    #[must_use]
    pub fn cut_off(&self) -> Option<f64> {
        self.0.cut_off()
    }

    /// What became of the run, as in its document.
    ///
    /// # Errors
    /// A run without steps.
    pub fn judged(&self) -> Result<String, JsError> {
        let document = self.0.document();
        let mut found = document.answer.clone();
        (found.history, found.samples) = (None, Samples::default());
        json(Ok(Judged { found, remarks: document.remarks.clone() }))
    }

    /// The document of the run, as the program writes it.
    ///
    /// # Errors
    /// As [`judged`](Self::judged).
    pub fn document(&self) -> Result<String, JsError> {
        json(Ok(self.0.document()))
    }
}

/// αc, growth exponents and steady motion.
///
/// # Errors
/// A parameter out of range.
#[wasm_bindgen]
pub fn linear(asked: &str) -> Result<String, JsError> {
    json(linear::linear(&read(asked)?))
}

/// The document of the cycle.
///
/// # Errors
/// A parameter out of range; that there is no cycle.
#[wasm_bindgen]
pub fn cycle(asked: &str) -> Result<String, JsError> {
    json(periodic::cycle_document(&read(asked)?))
}

/// The command line that makes the same run.
///
/// # Errors
/// What is no set of parameters.
#[wasm_bindgen]
pub fn command(asked: &str) -> Result<String, JsError> {
    Ok(line::run(&read(asked)?))
}

/// What the tip settles into at each α, at one r: the classes of `map`.
///
/// # Errors
/// A parameter out of range.
#[wasm_bindgen]
pub fn settled(asked: &str, r: f64, alphas: &[f64]) -> Result<Vec<u8>, JsError> {
    map::row(&read(asked)?, r, alphas).map_err(|refusal| told(&refusal))
}

/// αc at each r, NaN where there is none.
///
/// # Errors
/// A tip that there is not.
#[wasm_bindgen]
pub fn boundary(asked: &str, velocities: &[f64]) -> Result<Vec<f64>, JsError> {
    map::boundary(&read(asked)?, velocities).map_err(|refusal| told(&refusal))
}

/// Scans line by line. After each, `on_line(line, row, columns, heights)` is handed all rows of the surface from number
/// `row` on, of `columns` heights each, that it changed. What pattern came of it is returned.
///
/// # Errors
/// A parameter out of range, or a line that fails.
#[wasm_bindgen]
pub fn raster(asked: &str, scan: &str, on_line: &js_sys::Function) -> Result<String, JsError> {
    let scan = scan::Scan::read(scan).map_err(|refusal| told(&refusal))?;
    json(scan::raster(&read(asked)?, &scan, |line, row, columns, heights| {
        let heights = js_sys::Float64Array::from(heights);
        let [line, row, columns] = [line, row, columns].map(|n| JsValue::from(n as f64));
        // What the page does with it is its own affair.
        let _ =
            on_line.apply(&JsValue::NULL, &[line, row, columns, heights.into()].iter().collect());
    }))
}

/// The command line that makes the same raster.
///
/// # Errors
/// What is no set of parameters.
#[wasm_bindgen]
pub fn raster_command(asked: &str, scan: &str) -> Result<String, JsError> {
    let scan = scan::Scan::read(scan).map_err(|refusal| told(&refusal))?;
    Ok(line::raster(&read(asked)?, &scan))
}

/// The document of a walker, whose parameters are those of the question, with its command line.
///
/// # Errors
/// A parameter out of range, or a run that fails.
#[wasm_bindgen]
pub fn walker(asked: &str) -> Result<String, JsError> {
    json(walk::walker(asked, js_sys::Date::now))
}

/// The command line that makes the same walker.
///
/// # Errors
/// What is no set of parameters.
#[wasm_bindgen]
pub fn walker_command(asked: &str) -> Result<String, JsError> {
    let given = serde_json::from_str(asked).map_err(|error| told(&Refusal::Json(error)))?;
    Ok(line::walker(&given))
}

/// The parameters that the questions `run`, `raster` and `walker` declare, as JSON. Called by `examples/declared.rs` when
/// the page is built, and not exported to it: the module would be 70 kB larger.
///
/// # Errors
/// None that is known.
pub fn declared() -> Result<String, serde_json::Error> {
    serde_json::to_string(&declared::questions())
}
