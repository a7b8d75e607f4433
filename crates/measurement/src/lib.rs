//! Estimation of the parameters of the model from measured data, with intervals.
//!
//! [`tip`] fits a footprint to a measured profile, which may be noisy, tilted, off centre, and in any unit of length.
//! [`judge`] estimates the effect of the noise of a raw table on the onset of stick-slip. [`fit`] estimates α, r, the
//! width and more from ripples, lateral forces, onsets and wavelengths. The crate uses no files and no units: lengths
//! and heights are those of the data.
//!
//! ```
//! use stickslip_measurement::{Profile, Request, tip};
//!
//! // exp(-x²/2) of width 30 nm, in nm, off centre and on a slope.
//! let x: Vec<f64> = (0..81).map(|i| 4.0 * f64::from(i) - 150.0).collect();
//! let height = |x: &f64| 12.0 * (-0.5 * ((x - 5.0) / 30.0_f64).powi(2)).exp() + 0.01 * x;
//! let profile = Profile::new(x.clone(), x.iter().map(height).collect())?;
//! let found = tip(&profile, &Request { resamples: 20, ..Request::default() })?;
//! assert!((found.sigma.value - 30.0).abs() < 1e-6);
//! assert!((found.critical_alpha.value - 1.879427).abs() < 1e-5);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod fit;
mod friction_loop;
mod image;
mod interval;
mod judge;
mod least_squares;
mod profile;
mod projection;
mod ripples;
mod tip;

pub use fit::{
    Alternative, Data, DataError, Fit, FitError, FitRequest, FittedNumber, Judged, Name, Part,
    Scan, Shape, Track, Values, fit,
};
pub use friction_loop::{FrictionLoop, LoopError, LoopNumbers};
pub use image::{Across, Image, ImageError};
pub use interval::Estimate;
pub use judge::{Verdict, judge};
pub use profile::{MOST_ROWS, Profile, ProfileError};
pub use ripples::{
    Lag, Lateral, LateralFound, Retrace, RippleError, RippleProfile, RippleRequest, Ripples,
    has_lines_along_y, ripples,
};
pub use tip::{Candidate, Fitted, MeasuredTip, Request, Sides, TipError, sides, tip};
