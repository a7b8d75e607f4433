//! The result of a fit.

use super::data::Scan;
use super::likelihood::Fitted as FittedNumber;
use super::parameters::Values;
use super::rivals::Alternative;
use super::verdict::Judged;

/// The best fit.
#[derive(Debug, Clone, PartialEq)]
pub struct Fit {
    /// The fitted parameters.
    pub numbers: Vec<FittedNumber>,
    /// All parameters, including the known ones.
    pub values: Values,
    /// Correlations of the logarithms of the fitted parameters.
    pub correlations: Vec<Vec<f64>>,
    /// The fit of each data set.
    pub parts: Vec<Part>,
    /// Total number of rows.
    pub rows: usize,
    /// Number of fitted parameters, including offsets, slopes, gains and phases.
    pub parameters: usize,
    /// Other minima that the data do not exclude at 99.7 %, the likeliest first.
    pub alternatives: Vec<Alternative>,
    /// The best fit with a depth limit, if the request has none and the data do not exclude one at 95 %.
    pub with_depth_limit: Option<Alternative>,
    /// Whether the model explains the data: intervals are given only if it does.
    pub explained: bool,
    /// Probability that the joint residual of several data sets is as large by chance; `None` for a single data set.
    pub joint: Option<f64>,
    /// Warnings about the result.
    pub remarks: Vec<String>,
}

/// The fit of one data set, in its units.
#[derive(Debug, Clone, PartialEq)]
pub struct Part {
    /// The model at every row; for a loop, the trace and then the retrace; for a series, loads at onset or wavelengths.
    pub model: Vec<f64>,
    /// Standard deviation of the residuals; relative for a series.
    pub residual: f64,
    /// Offset at position 0, if fitted.
    pub offset: Option<f64>,
    /// Slope per length, if fitted.
    pub slope: Option<f64>,
    /// Fitted gain, defined as in [`Track::gain`](super::Track::gain).
    pub gain: Option<f64>,
    /// The direction of the scan; `None` for a series.
    pub scan: Option<Scan>,
    /// Tests of the model against these data.
    pub judged: Judged,
}
