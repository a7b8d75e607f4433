//! Neighbouring scan lines on one surface.
//!
//! A tip scans an area line by line. On line n, at y_n, it feels its own groove and the grooves of all earlier lines,
//!
//! ```text
//!     U_n(x) = -α Σ_{m<n} ∫ f(x - x0_m(t), y_n - y_m) dt
//! ```
//!
//! so that a line is an ordinary run with U_n as its initial surface. Each line is represented by its residence density
//! ρ_m, the time that the tip spent at each x, up to the bandwidth of f. Cost and memory of a line do not depend on the
//! number of earlier lines, because lines out of reach are dropped. `docs/explanation/rasters.md` derives the threshold
//! of ripples, and `docs/findings/README.md` has the results.
//!
//! ```
//! use stickslip_raster::{Path, Plan, Scanned, Scanning};
//! use stickslip_tip::{Footprint, Model, TipFunction};
//!
//! let footprint = Footprint::separable(TipFunction::gaussian(1.0)?, 1.0)?; // exp(-(x² + y²)/2)
//! let model = Model::new(footprint.path().clone(), 0.5, 1.0)?; // α = 0.5, r = 1
//! let plan = Plan::new(footprint, model, Path::OneWay, 0.5, 8, 30.0); // 8 lines of length 30, 0.5 apart
//! let mut scanning = Scanning::new(&plan)?;
//! while let Some(line) = scanning.next_line()? {
//!     assert!(line.lag(30.0) > 0.0);
//! }
//! let lines = scanning.into_lines();
//! let u = Scanned::new(&plan, &lines).heights(&[10.0, 10.5], &[0.0, 1.75]);
//! assert!(u.iter().all(|u| *u < 0.0));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod area;
mod course;
mod earlier;
mod error;
mod free;
mod grooves;
mod line;
mod path;
mod pattern;
mod plan;
mod scan;
mod surface;
mod trace;

pub use area::Area;
pub use error::{MOST_LINES, RasterError};
pub use free::Free;
pub use line::Line;
pub use path::{AreaLine, Path, Track};
pub use pattern::{Doubt, LineRegime, Pattern, Regime, Written, line_regime, pattern};
pub use plan::Plan;
pub use scan::Scanning;
pub use surface::{Scanned, volume};
