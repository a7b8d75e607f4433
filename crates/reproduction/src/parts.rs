//! Building blocks of figures.

use std::fmt::Display;
use stickslip::{CurveDocument, FigureDocument, ModelParameters, StyleName};
use stickslip_surface::Surface;
use stickslip_tip::{Model, Run, Scenario, run};
use thiserror::Error;

/// A figure without panels.
pub(super) fn figure(name: &str, title: &str, models: &[Model]) -> FigureDocument {
    let models = models.iter().map(|model| ModelParameters::of(model, None)).collect();
    FigureDocument::new(name, title, models, vec![])
}

/// A curve; an empty name keeps it out of the legend.
pub(super) fn curve(style: StyleName, name: &str, x: &[f64], y: &[f64]) -> CurveDocument {
    CurveDocument::new(style, name, x, y)
}

/// Puts the name of the computation before an error of a library.
pub(super) fn failed<E: Display>(what: &str) -> impl Fn(E) -> Failed {
    move |error| Failed::new(format!("{what}: {error}"))
}

pub(super) fn finished(scenario: &Scenario) -> Result<Run, Failed> {
    run(scenario).map_err(failed("the run"))
}

/// u(x,t) of a run.
pub(super) fn heights(
    scenario: &Scenario,
    run: &Run,
    t: f64,
    x: &[f64],
) -> Result<Vec<f64>, Failed> {
    let surface = Surface::new(&scenario.model, &run.initial_surface, &run.trajectory);
    let u = surface.heights(t, x).map_err(failed("the surface"))?;
    Ok(u.to_vec())
}

/// low, low + spacing, … to high.
pub(super) fn spaced(low: f64, high: f64, spacing: f64) -> Vec<f64> {
    let intervals = ((high - low) / spacing + 1e-9).floor() as usize;
    (0..=intervals).map(|i| low + spacing * i as f64).collect()
}

/// Intercept and slope of the line of best fit.
pub(super) fn line_of_best_fit(x: &[f64], y: &[f64]) -> (f64, f64) {
    let n = x.len() as f64;
    let (mean_x, mean_y) = (x.iter().sum::<f64>() / n, y.iter().sum::<f64>() / n);
    let covariance: f64 = x.iter().zip(y).map(|(x, y)| (x - mean_x) * (y - mean_y)).sum();
    let variance: f64 = x.iter().map(|x| (x - mean_x).powi(2)).sum();
    let slope = covariance / variance;
    (mean_y - slope * mean_x, slope)
}

/// Something that could not be computed.
#[derive(Debug, Error)]
#[error("{0}")]
pub struct Failed(String);

impl Failed {
    pub(crate) fn new(what: String) -> Self {
        Self(what)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_line_of_best_fit_through_a_line_is_that_line() {
        let x = [1.0, 2.0, 4.0, 7.0];
        let (intercept, slope) = line_of_best_fit(&x, &x.map(|x| 3.0 - 2.0 * x));
        assert!((intercept - 3.0).abs() < 1e-12 && (slope + 2.0).abs() < 1e-12);
    }

    #[test]
    fn a_range_that_the_spacing_divides_has_both_ends() {
        assert_eq!(spaced(0.0, 0.3, 0.1).len(), 4);
        assert_eq!(spaced(400.0, 450.0, 0.05).len(), 1001);
    }
}
