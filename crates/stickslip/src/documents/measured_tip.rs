//! `stickslip/tip`.

use crate::documents::table::{Column, Named, Tabular};
use crate::{Document, GaussianDocument, Question};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use stickslip_measurement::{Across, Candidate, Estimate, MeasuredTip};

/// A footprint from a measured profile, which is a tip file too: `gaussians` is f with f(0) = 1, lengths in σ.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MeasuredTipFound {
    /// f, with f(0) = 1 and lengths in σ.
    pub gaussians: Vec<GaussianDocument>,
    /// σ in the unit of the positions: the width of the Gaussian that is as wide at half of f(0), unless it was given.
    pub sigma: EstimateDocument,
    /// σ in m; null where the unit of the positions is not known.
    pub sigma_metres: Option<f64>,
    /// What f(0) = 1 is, in the unit of the heights; negative for a pit.
    pub apex: f64,
    /// Where f is even about, in the unit of the positions.
    pub centre: f64,
    /// Of the ground at position 0, in the unit of the heights.
    pub offset: f64,
    /// Of the ground, in units of heights over positions.
    pub tilt: f64,
    /// Of a curved ground, the coefficients of x² and x³; empty for a straight one.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub bend: Vec<f64>,
    /// Standard deviation of what is not smooth from row to row, in the unit of the heights.
    pub noise: f64,
    /// Standard deviation of what the fit leaves, in the unit of the heights.
    pub residual: f64,
    /// Correlation of what it leaves in neighbouring rows.
    pub correlation: f64,
    /// Gaussians, a pair of twins counted once.
    pub terms: usize,
    /// Sums of other numbers of Gaussians.
    pub candidates: Vec<CandidateDocument>,
    /// αc at the r of the parameters, dimensionless.
    pub critical_alpha: EstimateDocument,
    /// ω there, in k/Γ.
    pub critical_omega: EstimateDocument,
    /// The least α of trapping at that r, dimensionless; null where there is none.
    pub trapping_alpha: Option<EstimateDocument>,
    /// Rows of the profile, and the fit.
    pub profile: FittedDocument,
    /// Footprints like `gaussians`, drawn from what the noise leaves possible: `fit` carries the error of the shape by them.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub draws: Vec<Vec<GaussianDocument>>,
    /// What an image tells beside the profile through its middle: f(x,y).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub image: Option<AcrossDocument>,
}

/// The document of that.
pub type MeasuredTipDocument = Document<MeasuredTipParameters>;

impl Question for MeasuredTipParameters {
    const FORMAT: &'static str = "stickslip/tip";
    type Answer = MeasuredTipFound;
}

/// What a tip was made of.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MeasuredTipParameters {
    /// The file as it was named.
    pub source: String,
    /// Unit of the positions, such as "nm"; null for one that is not known.
    pub unit: Option<String>,
    /// Whether the profile is one half of an even one, about position 0.
    pub half: bool,
    /// Where f is even about, if that was given.
    pub centre: Option<f64>,
    /// σ, if that was given.
    pub sigma: Option<f64>,
    /// Gaussians, if their number was given.
    pub terms: Option<usize>,
    /// r at which onset and trapping are told, dimensionless.
    pub r: f64,
    /// Profiles drawn anew for the intervals.
    pub resamples: usize,
    /// Of the draws.
    pub seed: u64,
}

/// f(x,y): each Gaussian of f(x) times exp(-y²/(2v²)), as all pixels of an image have it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AcrossDocument {
    /// v of each of `gaussians`, in σ.
    pub widths: Vec<f64>,
    /// Where f is even about across, in the unit of the positions.
    pub centre: f64,
    /// Standard deviation of what the fit leaves of all pixels, in the unit of the heights.
    pub residual: f64,
    /// Standard deviation of what is not smooth from pixel to pixel along the rows, in the unit of the heights.
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
    /// As estimated.
    pub value: f64,
    /// Lower end; null where nothing is excluded below.
    pub low: Option<f64>,
    /// Upper end; null where nothing is excluded above.
    pub high: Option<f64>,
}

/// A sum of so many Gaussians.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CandidateDocument {
    /// Gaussians, a pair of twins counted once.
    pub terms: usize,
    /// Numbers fitted.
    pub parameters: usize,
    /// Standard deviation of what it leaves, in the unit of the heights.
    pub residual: f64,
    /// Schwarz' criterion, n ln(S/n) + p ln n, less that of the chosen sum.
    pub criterion: f64,
    /// αc of this sum; null where it has none.
    pub critical_alpha: Option<f64>,
}

/// Columns of equal length, by ascending position, in the units of the data.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FittedDocument {
    /// Position.
    pub x: Vec<f64>,
    /// As measured.
    pub f: Vec<f64>,
    /// As fitted, ground and all.
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
    /// Of a tip of which one unit of the positions is so many metres, if that is known.
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
    /// With what the image tells that the profile is of.
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

/// A residual so many times the noise is remarked on.
const ABOVE_NOISE: f64 = 1.3;

impl MeasuredTipFound {
    /// The ground at a position.
    pub fn ground(&self, x: f64) -> f64 {
        let curved = self.bend.iter().rev().fold(0.0, |sum, c| sum * x + c);
        self.offset + (self.tilt + curved * x) * x
    }
}

impl FittedDocument {
    /// What the fit leaves.
    pub fn residuals(&self) -> Vec<f64> {
        self.f.iter().zip(&self.fit).map(|(f, fit)| f - fit).collect()
    }
}

impl Tabular for MeasuredTipFound {
    /// The profile, the fit and what it leaves.
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
