//! Oscillations slightly beyond onset, as limit cycles; the paper simulates until transients decay.

use super::parts::{failed, line_of_best_fit};
use super::tips::Tip;
use crate::failed::Failed;
use stickslip_cycles::{Cycle, DEFAULT_TOLERANCE, cycle};
use stickslip_tip::Model;

/// Number of points of the lines of best fit.
pub(super) const FITTED: usize = 4;

/// Amplitudes and wavelengths along a line of parameters that begins at a critical point.
#[derive(Debug, Default)]
pub(super) struct Onset {
    /// Distance from the critical point.
    pub(super) distance: Vec<f64>,
    /// Half peak-to-peak of the surface far behind the tip, squared.
    pub(super) u_squared: Vec<f64>,
    /// Half peak-to-peak of the oscillation of x0 about its steady advance, squared.
    pub(super) x0_squared: Vec<f64>,
    pub(super) wavelength: Vec<f64>,
}

impl Onset {
    /// The oscillations at these distances; `model` varies α or r.
    pub(super) fn along(
        distances: &[f64],
        model: impl Fn(f64) -> Result<Model, Failed>,
    ) -> Result<Self, Failed> {
        let mut onset = Self::default();
        for distance in distances {
            let found = solved(&model(*distance)?)?;
            onset.distance.push(*distance);
            onset.u_squared.push(found.amplitude_u().powi(2));
            onset.x0_squared.push(found.amplitude_x0().powi(2));
            onset.wavelength.push(found.wavelength());
        }
        Ok(onset)
    }

    /// The oscillations above αc at r = 1.
    pub(super) fn above(tip: &Tip, distances: &[f64]) -> Result<Self, Failed> {
        let critical = tip.critical(1.0)?;
        Self::along(distances, |distance| tip.model(critical.alpha + distance, 1.0))
    }

    /// Intercept and slope of the fit to the points next to the critical one.
    pub(super) fn fit(&self, values: &[f64]) -> (f64, f64) {
        line_of_best_fit(&self.distance[..FITTED], &values[..FITTED])
    }
}

/// The limit cycle.
pub(super) fn solved(model: &Model) -> Result<Cycle, Failed> {
    cycle(model, DEFAULT_TOLERANCE).map_err(|error| failed("the limit cycle", &error))
}
