//! `stickslip/fit`.

use crate::table::{Column, Named, Tabular};
use crate::{EstimateDocument, FORMAT_VERSION, Software, TipDocument};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use stickslip_measurement::{Data, Fit, FittedNumber, Part};

/// Numbers of the law as measured data have them, with 95 % intervals by profile likelihood.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FitDocument {
    /// "stickslip/fit"
    pub format: String,
    /// 1
    pub format_version: u32,
    /// The program that wrote it.
    pub software: Software,
    /// What was given.
    pub parameters: FitParameters,
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
    /// What should be known before it is believed.
    pub remarks: Vec<String>,
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
    /// By how many standard deviations what is left repeats itself with the wavelength; above 4 the model is wrong.
    pub misfit: Option<f64>,
}

impl FitDocument {
    /// Its `format`.
    pub const FORMAT: &'static str = "stickslip/fit";

    /// Of a fit to these data, each from the file named.
    pub fn of(
        found: &Fit,
        parameters: FitParameters,
        data: &[(String, Data)],
        critical_alpha: Option<f64>,
    ) -> Self {
        let each = data.iter().zip(&found.parts);
        Self {
            format: Self::FORMAT.into(),
            format_version: FORMAT_VERSION,
            software: Software::this(),
            parameters,
            numbers: found.numbers.iter().map(NumberFitted::from).collect(),
            correlations: found.correlations.clone(),
            critical_alpha,
            data: each.map(|((source, data), part)| DataFitted::of(source, data, part)).collect(),
            rows: found.rows,
            parameters_fitted: found.parameters,
            remarks: found.remarks.clone(),
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
            misfit: part.misfit,
        }
    }
}

impl Tabular for FitDocument {
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
