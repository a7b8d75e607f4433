//! `stickslip/tip`.

use crate::documents::table::{Column, Named, Tabular};
use crate::{Document, GaussianDocument, Question};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use stickslip_measurement::{Across, Candidate, Estimate, MeasuredTip};

/// A footprint from a measured profile. The document is also a tip file: `gaussians` is f with f(0) = 1, lengths in
/// σ.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MeasuredTipFound {
    /// f as a sum of Gaussians, with f(0) = 1 and lengths in σ.
    pub gaussians: Vec<GaussianDocument>,
    /// σ in the unit of the positions: the width of the Gaussian with the same full width at half of f(0), unless it
    /// was given.
    pub sigma: EstimateDocument,
    /// σ in m; null if the unit of the positions is unknown.
    pub sigma_metres: Option<f64>,
    /// Height that corresponds to f(0) = 1, in the unit of the heights; negative for a pit.
    pub apex: f64,
    /// Centre of symmetry of f, in the unit of the positions.
    pub centre: f64,
    /// Height of the background at position 0, in the unit of the heights.
    pub offset: f64,
    /// Slope of the background, in units of heights over positions.
    pub tilt: f64,
    /// Coefficients of x² and x³ of a curved background; empty for a straight one.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub bend: Vec<f64>,
    /// Standard deviation of the noise from row to row, in the unit of the heights.
    pub noise: f64,
    /// Standard deviation of the residuals, in the unit of the heights.
    pub residual: f64,
    /// Correlation of the residuals of neighbouring rows.
    pub correlation: f64,
    /// Number of Gaussians, where a symmetric pair counts as one.
    pub terms: usize,
    /// Fits with other numbers of Gaussians.
    pub candidates: Vec<CandidateDocument>,
    /// αc at the r of the parameters, dimensionless.
    pub critical_alpha: EstimateDocument,
    /// ω at this critical point, in k/Γ.
    pub critical_omega: EstimateDocument,
    /// Trapping threshold αt at that r, dimensionless; null if there is none.
    pub trapping_alpha: Option<EstimateDocument>,
    /// Rows of the profile, and the fit.
    pub profile: FittedDocument,
    /// Footprints compatible with the noise, drawn at random: `fit` uses them to propagate the error of the shape.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub draws: Vec<Vec<GaussianDocument>>,
    /// Results for f(x,y) from an image, in addition to the profile through its middle.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub image: Option<AcrossDocument>,
}

/// A measured tip and the question that it answers.
pub type MeasuredTipDocument = Document<MeasuredTipParameters>;

impl Question for MeasuredTipParameters {
    const FORMAT: &'static str = "stickslip/tip";
    type Answer = MeasuredTipFound;
}

/// The parameters of a measured tip.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MeasuredTipParameters {
    /// Name of the file as given.
    pub source: String,
    /// Unit of the positions, such as "nm"; null if unknown.
    pub unit: Option<String>,
    /// Whether the profile is one half of an even one, about position 0.
    pub half: bool,
    /// Centre of symmetry of f, if given.
    pub centre: Option<f64>,
    /// σ, if given.
    pub sigma: Option<f64>,
    /// Number of Gaussians, if given.
    pub terms: Option<usize>,
    /// r at which onset and trapping threshold are computed, dimensionless.
    pub r: f64,
    /// Number of resampled profiles for the intervals.
    pub resamples: usize,
    /// Seed of the random numbers.
    pub seed: u64,
}

/// f(x,y), fitted to all pixels of an image: each Gaussian of f(x) times exp(-y²/(2v²)).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AcrossDocument {
    /// v of each of `gaussians`, in σ.
    pub widths: Vec<f64>,
    /// Centre of symmetry of f across the scan, in the unit of the positions.
    pub centre: f64,
    /// Standard deviation of the residuals of all pixels, in the unit of the heights.
    pub residual: f64,
    /// Standard deviation of the noise from pixel to pixel along the rows, in the unit of the heights.
    pub noise: f64,
}

impl From<&Across> for AcrossDocument {
    fn from(across: &Across) -> Self {
        let Across { widths, centre, residual, noise } = across;
        Self { widths: widths.clone(), centre: *centre, residual: *residual, noise: *noise }
    }
}

/// A value with its 95 % interval.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct EstimateDocument {
    /// The estimate.
    pub value: f64,
    /// Lower end; null if the data exclude no small value.
    pub low: Option<f64>,
    /// Upper end; null if the data exclude no large value.
    pub high: Option<f64>,
}

/// The fit with a given number of Gaussians.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CandidateDocument {
    /// Number of Gaussians, where a symmetric pair counts as one.
    pub terms: usize,
    /// Number of fitted parameters.
    pub parameters: usize,
    /// Standard deviation of the residuals, in the unit of the heights.
    pub residual: f64,
    /// Schwarz' criterion, n ln(S/n) + p ln n, minus that of the chosen sum.
    pub criterion: f64,
    /// αc of this sum; null if it has none.
    pub critical_alpha: Option<f64>,
}

/// Columns of equal length, by ascending position, in the units of the data.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FittedDocument {
    /// Position.
    pub x: Vec<f64>,
    /// Measured heights.
    pub f: Vec<f64>,
    /// Fitted heights, including the background.
    pub fit: Vec<f64>,
}

impl From<Estimate> for EstimateDocument {
    fn from(estimate: Estimate) -> Self {
        let finite = |v: f64| v.is_finite().then_some(v);
        let Estimate { value, low, high } = estimate;
        Self { value, low: finite(low), high: finite(high) }
    }
}

impl MeasuredTipFound {
    /// The document of a measured tip; `metres` is the unit of the positions in m, if known.
    pub fn of(found: &MeasuredTip, metres: Option<f64>) -> Self {
        let least = found.candidates[found.chosen].criterion;
        let candidate = |c: &Candidate| CandidateDocument {
            terms: c.terms,
            parameters: c.parameters,
            residual: c.residual,
            criterion: c.criterion - least,
            critical_alpha: c.critical_alpha.is_finite().then_some(c.critical_alpha),
        };
        let trapping = found.trapping_alpha;
        Self {
            gaussians: found.gaussians.iter().map(GaussianDocument::from).collect(),
            sigma: found.sigma.into(),
            sigma_metres: metres.map(|metres| found.sigma.value * metres),
            apex: found.apex,
            centre: found.centre,
            offset: found.ground[0],
            tilt: found.ground[1],
            bend: found.ground[2..].to_vec(),
            noise: found.noise,
            residual: found.residual,
            correlation: found.correlation,
            terms: found.candidates[found.chosen].terms,
            candidates: found.candidates.iter().map(candidate).collect(),
            critical_alpha: found.critical_alpha.into(),
            critical_omega: found.critical_omega.into(),
            trapping_alpha: trapping.value.is_finite().then(|| trapping.into()),
            profile: FittedDocument {
                x: found.fitted.x.clone(),
                f: found.fitted.f.clone(),
                fit: found.fitted.fit.clone(),
            },
            draws: found
                .draws
                .iter()
                .map(|draw| draw.iter().map(GaussianDocument::from).collect())
                .collect(),
            image: None,
        }
    }
}

impl MeasuredTipDocument {
    /// Adds the results of the image to which the profile belongs.
    #[must_use]
    pub fn with_image(mut self, across: &Across) -> Self {
        if across.residual > ABOVE_NOISE * across.noise {
            self.remarks.push(format!(
                "what the fit leaves of the image, {:.2e}, is more than its noise, {:.2e}: the ground is no plane, or f(x,y) is no sum \
                 of Gaussians across, even about its path",
                across.residual, across.noise
            ));
        }
        self.answer.image = Some(across.into());
        self
    }
}

/// Ratio of residual to noise above which a warning is given.
const ABOVE_NOISE: f64 = 1.3;

impl MeasuredTipFound {
    /// Height of the background at a position.
    pub fn ground(&self, x: f64) -> f64 {
        let curved = self.bend.iter().rev().fold(0.0, |sum, c| sum * x + c);
        self.offset + (self.tilt + curved * x) * x
    }
}

impl FittedDocument {
    /// The residuals of the fit.
    pub fn residuals(&self) -> Vec<f64> {
        self.f.iter().zip(&self.fit).map(|(f, fit)| f - fit).collect()
    }
}

impl Tabular for MeasuredTipFound {
    /// The profile, the fit and the residuals, as a table.
    fn columns(&self) -> Vec<Named<'_>> {
        let FittedDocument { x, f, fit } = &self.profile;
        vec![
            ("x", Column::of(x)),
            ("f", Column::of(f)),
            ("fit", Column::of(fit)),
            ("residual", self.profile.residuals().into()),
        ]
    }
}
