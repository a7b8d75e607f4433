//! `stickslip/fit`.

use crate::documents::table::{Column, Named, Tabular};
use crate::{Document, EstimateDocument, Question, TipDocument};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use stickslip_measurement::{Alternative, Data, Fit, FittedNumber, Name, Part, Scan};

/// Parameters of the model estimated from measured data, with 95 % intervals by profile likelihood.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FitFound {
    /// The fitted parameters.
    pub numbers: Vec<NumberFitted>,
    /// Correlation matrix of the logarithms of the fitted parameters.
    pub correlations: Vec<Vec<f64>>,
    /// αc at the fitted r, dimensionless; null for a series, or if r is unknown.
    pub critical_alpha: Option<f64>,
    /// Each data set with its fit.
    pub data: Vec<DataFitted>,
    /// Total number of rows.
    pub rows: usize,
    /// Number of fitted parameters, including offsets, slopes, gains and phases.
    pub parameters_fitted: usize,
    /// Whether the model explains the data; if it does not, no parameter has an interval.
    #[serde(default = "yes")]
    pub explained: bool,
    /// For several data sets, the probability of an equally large deviation from one common model by chance.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub joint_misfit: Option<f64>,
    /// Other minima that the data do not exclude at 99.7 %, the likeliest first.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub alternatives: Vec<AlternativeDocument>,
    /// The best fit with a depth limit; present if the request has no depth limit, the data do not exclude one at 95
    /// %, and it changes the parameters.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub with_depth_limit: Option<AlternativeDocument>,
}

/// A fit and the question that it answers.
pub type FitDocument = Document<FitParameters>;

impl Question for FitParameters {
    const FORMAT: &'static str = "stickslip/fit";
    type Answer = FitFound;
}

/// Default of `explained` in documents of older versions.
fn yes() -> bool {
    true
}

/// Another minimum of χ².
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AlternativeDocument {
    /// The parameters at this minimum, including the fixed ones.
    pub numbers: Vec<NumberHeld>,
    /// Direction of the scan, "right" or "left", for each data set.
    pub scans: Vec<String>,
    /// Excess of χ² over the best fit.
    pub behind: f64,
}

/// The parameters of a fit.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FitParameters {
    /// Footprint f in its own σ; with the fitted β if β is free.
    pub tip: TipDocument,
    /// Fixed parameters, by name.
    pub known: Vec<NumberHeld>,
    /// Whether outliers have a reduced weight.
    pub robust: bool,
    /// Unit of lengths, such as "nm"; null if unknown.
    pub unit: Option<String>,
    /// Direction of the scan, "right" or "left", if given; null if both were tried.
    #[serde(default)]
    pub scan: Option<String>,
    /// Number of footprints used to propagate the error of a measured footprint.
    #[serde(default)]
    pub footprints: usize,
}

/// A parameter at a fixed value.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct NumberHeld {
    /// Name, such as "alpha".
    pub name: String,
    /// Value of the parameter.
    pub value: f64,
}

/// A fitted parameter with its interval.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct NumberFitted {
    /// "alpha" and "r", dimensionless; "width", σ in the unit of lengths; "beta"; "depth_limit" in kσ²/a, "healing_time"
    /// in Γ/k, "inertia" in Γ²/k; "alpha_per_load" and "r_per_velocity" of a series.
    pub name: String,
    /// Estimate and interval.
    pub estimate: EstimateDocument,
    /// Values at which the parameter was held in the profile likelihood, ascending.
    pub profile_values: Vec<f64>,
    /// Signed root of the excess of χ² over its minimum at each of these values: the interval ends at about ±1.96.
    pub profile_roots: Vec<f64>,
}

/// Measured data, in their own units, with the fitted model.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DataFitted {
    /// "ripple", "friction", "loop", "onsets" or "wavelengths".
    pub kind: String,
    /// Name of the file as given.
    pub source: String,
    /// Positions, or velocities for a series.
    pub x: Vec<f64>,
    /// Heights, forces (trace of a loop, then retrace), loads at onset or wavelengths.
    pub y: Vec<f64>,
    /// The model at each of these positions.
    pub model: Vec<f64>,
    /// Standard deviation of the residuals, relative for a series.
    pub residual: f64,
    /// Height of the background at position 0.
    pub offset: Option<f64>,
    /// Slope of the background.
    pub slope: Option<f64>,
    /// Fitted scale factor, if the scale is unknown: k/a for heights, k for forces.
    pub gain: Option<f64>,
    /// Probability of an equally large periodic residual by chance; below 0.005 the model does not explain the data.
    /// Null if there are too few rows.
    pub misfit: Option<f64>,
    /// Probability by chance of the component of twice the wavelength; below 0.001 the ripples are period-doubled.
    #[serde(default)]
    pub doubling: Option<f64>,
    /// Probability by chance of a change of the ripples along the track; below 0.001 the motion has not settled.
    #[serde(default)]
    pub drift: Option<f64>,
    /// Standard deviation of the noise, from the scatter between wavelengths, in the unit of `y`.
    #[serde(default)]
    pub noise: Option<f64>,
    /// Number of independent rows with the same information as these rows.
    #[serde(default)]
    pub effective_rows: Option<f64>,
    /// Direction of the scan along `x`: "right" or "left"; null for a series.
    #[serde(default)]
    pub scan: Option<String>,
    /// Number of rows of the file averaged into each of these.
    #[serde(default = "one")]
    pub averaged: usize,
}

/// Default of `averaged` in documents of older versions.
fn one() -> usize {
    1
}

fn words(scan: Scan) -> String {
    scan.word().into()
}

impl From<&Alternative> for AlternativeDocument {
    fn from(other: &Alternative) -> Self {
        let number = |name: Name| {
            Some(NumberHeld { name: name.word().into(), value: other.values.get(name)? })
        };
        Self {
            numbers: Name::ALL.into_iter().filter_map(number).collect(),
            scans: other.scans.iter().copied().map(words).collect(),
            behind: other.behind,
        }
    }
}

impl FitFound {
    /// The document of a fit to these data, [reduced](Data::reduced), each with the name of its file.
    pub fn of(found: &Fit, data: &[(String, Data)], critical_alpha: Option<f64>) -> Self {
        let each = data.iter().zip(&found.parts);
        Self {
            numbers: found.numbers.iter().map(NumberFitted::from).collect(),
            correlations: found.correlations.clone(),
            critical_alpha,
            data: each.map(|((source, data), part)| DataFitted::of(source, data, part)).collect(),
            rows: found.rows,
            parameters_fitted: found.parameters,
            explained: found.explained,
            joint_misfit: found.joint,
            alternatives: found.alternatives.iter().map(AlternativeDocument::from).collect(),
            with_depth_limit: found.with_depth_limit.as_ref().map(AlternativeDocument::from),
        }
    }
}

impl From<&FittedNumber> for NumberFitted {
    fn from(number: &FittedNumber) -> Self {
        let (profile_values, profile_roots) = number.profile.iter().copied().unzip();
        let mut estimate = EstimateDocument::from(number.estimate);
        // All are above 0: to exclude nothing below is to exclude nothing above 0.
        estimate.low = estimate.low.filter(|low| *low > 0.0);
        Self { name: number.name.word().into(), estimate, profile_values, profile_roots }
    }
}

impl DataFitted {
    fn of(source: &str, data: &Data, part: &Part) -> Self {
        let (kind, x, y) = match data {
            Data::Ripple(track) => ("ripple", track.x.clone(), track.y.clone()),
            Data::Friction(track) => ("friction", track.x.clone(), track.y.clone()),
            Data::Loop(track, back) => {
                ("loop", [&*track.x, &track.x].concat(), [&*track.y, back].concat())
            }
            Data::Onsets { velocity, load } => ("onsets", velocity.clone(), load.clone()),
            Data::Wavelengths { velocity, wavelength, .. } => {
                ("wavelengths", velocity.clone(), wavelength.clone())
            }
        };
        let averaged = match data {
            Data::Ripple(track) | Data::Friction(track) | Data::Loop(track, _) => track.averaged,
            Data::Onsets { .. } | Data::Wavelengths { .. } => 1,
        };
        Self {
            kind: kind.into(),
            source: source.into(),
            x,
            y,
            model: part.model.clone(),
            residual: part.residual,
            offset: part.offset,
            slope: part.slope,
            gain: part.gain,
            misfit: part.judged.misfit,
            doubling: part.judged.doubling,
            drift: part.judged.drift,
            noise: part.judged.noise,
            effective_rows: part.judged.effective,
            scan: part.scan.map(words),
            averaged,
        }
    }
}

impl Tabular for FitFound {
    /// The parameters as a table, with a row for each.
    fn columns(&self) -> Vec<Named<'_>> {
        let names = self.numbers.iter().map(|n| n.name.clone()).collect();
        let of = |of: fn(&EstimateDocument) -> Option<f64>| -> Vec<Option<f64>> {
            self.numbers.iter().map(|n| of(&n.estimate)).collect()
        };
        vec![
            ("number", Column::Words(names, None)),
            ("value", of(|e| Some(e.value)).into()),
            ("low", of(|e| e.low).into()),
            ("high", of(|e| e.high).into()),
        ]
    }
}
