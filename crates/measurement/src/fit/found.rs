//! What a fit comes to.

use super::data::Scan;
use super::likelihood::Fitted as FittedNumber;
use super::parameters::Values;
use super::rivals::Alternative;
use super::verdict::Judged;

/// The best fit.
#[derive(Debug, Clone, PartialEq)]
pub struct Fit {
    /// Each number fitted.
    pub numbers: Vec<FittedNumber>,
    /// All numbers, the known ones too.
    pub values: Values,
    /// Correlations of the logarithms of those fitted.
    pub correlations: Vec<Vec<f64>>,
    /// What was fitted to each of the data.
    pub parts: Vec<Part>,
    /// Rows in all, and numbers fitted, offsets, slopes, gains and phases among them.
    pub rows: usize,
    /// The latter.
    pub parameters: usize,
    /// Other minima that the data do not exclude at 99.7 %, the likeliest first.
    pub alternatives: Vec<Alternative>,
    /// The best fit with a depth limit, where the request leaves it out and the data do not exclude it at 95 %.
    pub with_depth_limit: Option<Alternative>,
    /// Whether the model explains the data: intervals are given only where it does.
    pub explained: bool,
    /// Probability by chance of what one model leaves of several data; `None` of one.
    pub joint: Option<f64>,
    /// What should be known before it is believed.
    pub remarks: Vec<String>,
}

/// Of one of the data, in its units.
#[derive(Debug, Clone, PartialEq)]
pub struct Part {
    /// The model at every row; of a loop forwards, then backwards. Loads at onset, or wavelengths, of a series.
    pub model: Vec<f64>,
    /// Standard deviation of what is left; of a series relative.
    pub residual: f64,
    /// Offset at position 0, slope, and gain, as far as there are such.
    pub offset: Option<f64>,
    /// Per length.
    pub slope: Option<f64>,
    /// Of an unknown one, over σ² for heights and over σ for forces.
    pub gain: Option<f64>,
    /// The direction of the scan; `None` of a series.
    pub scan: Option<Scan>,
    /// Whether the model explains it.
    pub judged: Judged,
}
