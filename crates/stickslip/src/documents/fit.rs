//! `stickslip/fit`.

use crate::documents::table::{Column, Named, Tabular};
use crate::{Document, EstimateDocument, Question, TipDocument};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use stickslip_measurement::{Alternative, Data, Fit, FittedNumber, Name, Part, Scan};

/// Numbers of the law as measured data have them, with 95 % intervals by profile likelihood.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FitFound {
    /// Each number fitted.
    pub numbers: Vec<NumberFitted>,
    /// Correlations of the logarithms of these, a row each.
    pub correlations: Vec<Vec<f64>>,
    /// αc at the r fitted, dimensionless; null for a series, or where r is unknown.
    pub critical_alpha: Option<f64>,
    /// Each of the data beside the model.
    pub data: Vec<DataFitted>,
    /// Rows in all.
    pub rows: usize,
    /// Numbers fitted, offsets, slopes, gains and phases among them.
    pub parameters_fitted: usize,
    /// Whether the model explains the data; where it does not, no number has an interval.
    #[serde(default = "yes")]
    pub explained: bool,
    /// Of several data, the probability of as large a deviation from one common model by chance.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub joint_misfit: Option<f64>,
    /// Other minima that the data do not exclude at 99.7 %, the likeliest first.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub alternatives: Vec<AlternativeDocument>,
    /// The best fit with a depth limit, where the request leaves that out, the data do not exclude it at 95 %, and it changes
    /// the numbers.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub with_depth_limit: Option<AlternativeDocument>,
}

/// The document of that.
pub type FitDocument = Document<FitParameters>;

impl Question for FitParameters {
    const FORMAT: &'static str = "stickslip/fit";
    type Answer = FitFound;
}

/// Of documents written before this was judged.
fn yes() -> bool {
    true
}

/// Another motion.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AlternativeDocument {
    /// The numbers there, the held ones too.
    pub numbers: Vec<NumberHeld>,
    /// "right" or "left", for each of the data.
    pub scans: Vec<String>,
    /// By how much χ² is higher than at the best fit.
    pub behind: f64,
}

/// What was given.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FitParameters {
    /// Footprint f in its own σ; with the β fitted where that is free.
    pub tip: TipDocument,
    /// Numbers that were held, by their names.
    pub known: Vec<NumberHeld>,
    /// Whether rows far off count less.
    pub robust: bool,
    /// Unit of lengths, such as "nm"; null for one that is not known.
    pub unit: Option<String>,
    /// "right" or "left" if the direction of the scan was given; null where both were tried.
    #[serde(default)]
    pub scan: Option<String>,
    /// Footprints by which the error of a measured one was carried along.
    #[serde(default)]
    pub footprints: usize,
}

/// A number that was held.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct NumberHeld {
    /// Such as "alpha".
    pub name: String,
    /// Its value.
    pub value: f64,
}

/// A number with its interval.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct NumberFitted {
    /// "alpha" and "r", dimensionless; "width", σ in the unit of lengths; "beta"; "depth_limit" in kσ²/a, "healing_time"
    /// in Γ/k, "inertia" in Γ²/k; "alpha_per_load" and "r_per_velocity" of a series.
    pub name: String,
    /// With its interval.
    pub estimate: EstimateDocument,
    /// Values at which it was held, ascending.
    pub profile_values: Vec<f64>,
    /// Of each the signed root of what that leaves over the least: ±1.96 or so are the ends of the interval.
    pub profile_roots: Vec<f64>,
}

/// What was measured, in its own units, and what the model makes of it.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DataFitted {
    /// "ripple", "friction", "loop", "onsets" or "wavelengths".
    pub kind: String,
    /// The file as it was named.
    pub source: String,
    /// Positions, or the velocities of a series.
    pub x: Vec<f64>,
    /// Heights, forces (of a loop forwards, then backwards), loads at onset or wavelengths.
    pub y: Vec<f64>,
    /// The model at each of these.
    pub model: Vec<f64>,
    /// Standard deviation of what is left, relative for a series.
    pub residual: f64,
    /// Of the ground at position 0.
    pub offset: Option<f64>,
    /// Of the ground, per length.
    pub slope: Option<f64>,
    /// Of an unknown one: k/a for heights, k for forces.
    pub gain: Option<f64>,
    /// Probability of so large a periodic residual by chance; below 0.005 the model does not explain the data. Null where
    /// too few rows say.
    pub misfit: Option<f64>,
    /// Probability by chance of the part that repeats with twice the wavelength; below 0.001 the ripples are period-doubled.
    #[serde(default)]
    pub doubling: Option<f64>,
    /// Probability by chance of a change of the ripples along the track; below 0.001 the motion has not settled.
    #[serde(default)]
    pub drift: Option<f64>,
    /// Standard deviation of the noise, from the scatter between wavelengths, in the unit of `y`.
    #[serde(default)]
    pub noise: Option<f64>,
    /// Independent rows that contain as much as these.
    #[serde(default)]
    pub effective_rows: Option<f64>,
    /// Direction of the scan over `x`: "right" or "left"; null for a series.
    #[serde(default)]
    pub scan: Option<String>,
    /// Rows of the file of which each of these is the mean.
    #[serde(default = "one")]
    pub averaged: usize,
}

/// Of documents written before rows were averaged.
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
    /// Of a fit to these data, [reduced](Data::reduced), each from the file named.
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
    /// The numbers, a row each.
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
