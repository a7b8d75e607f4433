//! The question `tip`: the footprint in a measured profile or image.

use crate::documents::table::{Named, Tabular, columns};
use crate::parameter::option;
use crate::schema::JsonSchema;
use crate::{Ask, Context, Document, Failure, Question, Refused};
use serde::{Deserialize, Serialize};
use stickslip_measurement::{
    Across, Candidate, Estimate, Fitted, Image, MeasuredTip as Measured, Profile, Request, Sides,
    TipError, sides, tip,
};
use stickslip_tip::Gaussian;

/// A footprint from a measured profile. The document is also a tip file: `gaussians` is f with f(0) = 1, lengths in
/// σ.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MeasuredTipFound {
    /// f as a sum of Gaussians, with f(0) = 1 and lengths in σ.
    pub gaussians: Vec<Gaussian>,
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
    /// Fits with several numbers of Gaussians, the chosen one among them.
    pub candidates: Vec<CandidateDocument>,
    /// αc at the r of the parameters, dimensionless.
    pub critical_alpha: EstimateDocument,
    /// ω at the critical point with `critical_alpha`, in k/Γ.
    pub critical_omega: EstimateDocument,
    /// Trapping threshold αt at the r of the parameters, dimensionless; null if there is none.
    pub trapping_alpha: Option<EstimateDocument>,
    /// Rows of the profile, and the fit.
    pub profile: Fitted,
    /// Footprints compatible with the noise, drawn at random: `fit` uses them to propagate the error of the shape.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub draws: Vec<Vec<Gaussian>>,
    /// Results for f(x,y) from an image, in addition to the profile through its middle.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub image: Option<Across>,
    /// The footprint of each direction of motion; present if both sides were fitted.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sides: Option<SidesDocument>,
}

/// A measured tip and the question that it answers.
pub type MeasuredTipDocument = Document<MeasuredTip>;

/// A footprint from a measured profile, which may be noisy, tilted and off centre, or from an image.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(default)]
pub struct MeasuredTip {
    /// Name of the data, such as that of their file.
    pub source: String,
    /// Unit of the positions: m, um, nm, Å, …; that of the data by default.
    #[schemars(extend("x-option" = option("UNIT", "Data", 1)))]
    pub unit: Option<String>,
    /// Unit of heights, such as nm or V; by default unknown.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub height_unit: Option<String>,
    /// The profile is one half of an even one, about position 0. This is the default if it begins at 0 with its apex.
    #[schemars(extend("x-option" = option("", "Data", 2)))]
    pub half: Option<bool>,
    /// Centre of symmetry, in the unit of the positions; fitted by default.
    pub centre: Option<f64>,
    /// Also fit each side of the profile: a moving tip meets the surface with its front side only, so that trace and
    /// retrace have different footprints.
    #[schemars(extend("x-option" = option("", "Data", 8)))]
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub both_sides: bool,
    /// σ, in the unit of the positions; computed by default.
    pub sigma: Option<f64>,
    /// Number of Gaussians, where a symmetric pair counts as one; chosen by Schwarz' criterion by default.
    #[schemars(extend("x-option" = option("N", "Accuracy", 4)))]
    pub terms: Option<usize>,
    /// Dimensionless support velocity at which onset and trapping threshold are computed.
    #[schemars(extend("x-option" = option("R", "Model", 5)))]
    pub r: f64,
    /// Number of resampled profiles for the intervals; at most 100,000.
    #[schemars(extend("x-option" = option("N", "Accuracy", 6)))]
    pub resamples: usize,
    /// Seed of the random numbers.
    #[schemars(extend("x-option" = option("N", "Accuracy", 7)))]
    pub seed: u64,
    /// The measured heights. Documents contain them in the answer instead.
    #[serde(skip_serializing)]
    pub profile: MeasuredProfile,
    /// An image in place of the profile; the profile is then taken through its middle.
    #[serde(skip_serializing)]
    pub image: Option<MeasuredImage>,
}

impl Default for MeasuredTip {
    fn default() -> Self {
        Self {
            source: String::new(),
            unit: None,
            height_unit: None,
            half: None,
            centre: None,
            both_sides: false,
            sigma: None,
            terms: None,
            r: 1.0,
            resamples: 400,
            seed: 0,
            profile: MeasuredProfile::default(),
            image: None,
        }
    }
}

/// Measured heights along a line, in rows of any order.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MeasuredProfile {
    /// Positions, in `unit`.
    pub x: Vec<f64>,
    /// Heights, in any unit; below their surroundings for a pit.
    pub f: Vec<f64>,
}

/// Measured heights on a grid.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MeasuredImage {
    /// Positions along the scan, in `unit`.
    pub x: Vec<f64>,
    /// Positions across the scan, in `unit`.
    pub y: Vec<f64>,
    /// Heights, a row for each y.
    pub rows: Vec<Vec<f64>>,
}

impl Question for MeasuredTip {
    const FORMAT: &'static str = "stickslip/tip";
    type Answer = MeasuredTipFound;

    fn unit_of<'a>(&'a self, _: &'a MeasuredTipFound, column: &str) -> Option<&'a str> {
        if column == "x" { &self.unit } else { &self.height_unit }.as_deref()
    }
}

impl MeasuredTip {
    /// Largest number of resampled profiles.
    pub const MOST_RESAMPLES: usize = 100_000;

    /// The measured profile, and the image that it belongs to.
    fn data(&self) -> Result<(Profile, Option<Image>), Refused> {
        let Some(MeasuredImage { x, y, rows }) = self.image.clone() else {
            let MeasuredProfile { x, f } = self.profile.clone();
            let profile = Profile::new(x, f).map_err(|error| Refused::whole("profile", error))?;
            return Ok((profile, None));
        };
        let refused = |error| Refused::whole("image", error);
        let image = Image::new(x, y, rows).map_err(refused)?;
        Ok((image.profile().map_err(refused)?, Some(image)))
    }

    /// The unit of the positions in m, if it is known.
    fn metres(&self) -> Result<Option<f64>, Refused> {
        self.unit.as_deref().map(|unit| Refused::metres("unit", unit)).transpose()
    }

    /// Rejects numbers out of their range.
    fn judged(&self) -> Result<(), Refused> {
        if let Some(centre) = self.centre.filter(|centre| !centre.is_finite()) {
            return Err(Refused::number("centre", centre, "must be a finite number"));
        }
        if self.centre.is_some() && self.half == Some(true) {
            let why = "one half of an even profile has its centre at 0: leave one of them out";
            return Err(Refused::whole("half and centre", why));
        }
        for (name, value) in [("sigma", self.sigma), ("r", Some(self.r))] {
            value.map(|value| Refused::positive(name, value)).transpose()?;
        }
        if self.terms == Some(0) {
            return Err(Refused::number("terms", 0.0, "must be 1 or more"));
        }
        if self.resamples > Self::MOST_RESAMPLES {
            let why = format!("must be at most {}", Self::MOST_RESAMPLES);
            return Err(Refused::number("resamples", self.resamples as f64, why));
        }
        Ok(())
    }
}

impl Ask for MeasuredTip {
    fn resolved(self, _: &Context) -> Result<Self, Failure> {
        self.judged()?;
        self.metres()?;
        let (profile, _) = self.data()?;
        let half = self.half.unwrap_or_else(|| self.centre.is_none() && profile.is_half());
        if half && self.both_sides {
            let why = "the profile has one side only, as given by {half} or because it begins at 0 with its apex: leave it out";
            return Err(Refused::whole("both_sides", why).into());
        }
        Ok(Self { half: Some(half), ..self })
    }

    fn answer(&self, _: &Context) -> Result<(MeasuredTipFound, Vec<String>), Failure> {
        let (profile, image) = self.data()?;
        let named = if image.is_some() { "image" } else { "profile" };
        let request = Request {
            centre: if self.half == Some(true) { Some(0.0) } else { self.centre },
            sigma: self.sigma,
            terms: self.terms,
            r: self.r,
            resamples: self.resamples,
            seed: self.seed,
        };
        let failed = |error| match error {
            TipError::Stopped => Failure::Cancelled,
            TipError::NoOnset { r } => Refused::number("r", r, error).into(),
            error => Refused::whole(named, error).into(),
        };
        let found = tip(&profile, &request).map_err(failed)?;
        let mut remarks = found.remarks();
        let two = if self.both_sides {
            let known = Request { sigma: Some(found.sigma.value), ..request };
            Some(sides(&profile, &known).map_err(failed)?)
        } else {
            remarks.extend(found.asymmetry().map(symmetrised));
            None
        };
        remarks.extend(two.iter().flat_map(Sides::remarks));
        let across = image.map(|image| image.across(&found)).transpose();
        let across = across.map_err(|error| Refused::whole(named, error))?;
        remarks.extend(across.as_ref().and_then(unexplained));
        let answer = MeasuredTipFound::of(&found, self.metres()?);
        let sides = two.as_ref().map(Into::into);
        Ok((MeasuredTipFound { image: across, sides, ..answer }, remarks))
    }
}

/// A warning about an even fit to a profile whose sides differ.
fn symmetrised(asymmetry: f64) -> String {
    let wider = if asymmetry > 0.0 { "larger" } else { "smaller" };
    format!(
        "the profile is wider at {wider} positions by {:.0} %, beyond its noise: the even f is right for neither trace nor \
         retrace; --both-sides fits each",
        100.0 * asymmetry.abs()
    )
}

/// The footprints of a tip that is not symmetric, one for each direction of motion.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SidesDocument {
    /// Position of the apex between the sides, in the unit of the positions.
    pub apex: f64,
    /// Footprint of motion towards larger positions: the side at larger positions, and its mirror image.
    pub trace: SideDocument,
    /// Footprint of motion towards smaller positions: the side at smaller positions, and its mirror image.
    pub retrace: SideDocument,
    /// Difference of the αc of trace and retrace, relative to their mean.
    pub asymmetry: f64,
    /// f with the side of the trace at x > 0, that of the retrace at x < 0, and f(0) = 1. Printed alone, it is a tip
    /// file; it is also the footprint if the whole document is given as a tip file. Null if the sides are too different
    /// in scale; missing in documents of older versions.
    #[serde(default)]
    pub footprint: Option<GaussianSumDocument>,
}

/// A footprint in the form of a tip file.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GaussianSumDocument {
    /// f as a sum of Gaussians.
    pub gaussians: Vec<Gaussian>,
}

/// The footprint of one direction of motion, an even function.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SideDocument {
    /// f with f(0) = 1, lengths in the σ of the even fit. Printed alone, it is a tip file.
    pub footprint: GaussianSumDocument,
    /// Height that corresponds to f(0) = 1, in the unit of the heights; negative for a pit.
    pub apex: f64,
    /// Standard deviation of the residuals, in the unit of the heights.
    pub residual: f64,
    /// αc at the r of the parameters, dimensionless.
    pub critical_alpha: EstimateDocument,
    /// ω at the critical point with `critical_alpha`, in k/Γ.
    pub critical_omega: EstimateDocument,
    /// Trapping threshold αt at the r of the parameters, dimensionless; null if there is none.
    pub trapping_alpha: Option<EstimateDocument>,
}

impl From<&Sides> for SidesDocument {
    fn from(sides: &Sides) -> Self {
        let (trace, retrace) = ((&sides.forward).into(), (&sides.backward).into());
        let footprint = sides.footprint().map(|gaussians| GaussianSumDocument { gaussians });
        Self { apex: sides.apex, trace, retrace, asymmetry: sides.asymmetry(), footprint }
    }
}

impl From<&Measured> for SideDocument {
    fn from(side: &Measured) -> Self {
        let trapping = side.trapping_alpha;
        Self {
            footprint: GaussianSumDocument { gaussians: side.gaussians.clone() },
            apex: side.apex,
            residual: side.residual,
            critical_alpha: side.critical_alpha.into(),
            critical_omega: side.critical_omega.into(),
            trapping_alpha: trapping.value.is_finite().then(|| trapping.into()),
        }
    }
}

/// A warning if the residual of the image is larger than its noise.
fn unexplained(across: &Across) -> Option<String> {
    (across.residual > ABOVE_NOISE * across.noise).then(|| {
        format!(
            "the residual of the image, {:.2e}, is larger than its noise, {:.2e}: the background is not a plane, or f(x,y) is \
             not a sum of Gaussians across the scan that is even about the path of the tip",
            across.residual, across.noise
        )
    })
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
    /// Schwarz' criterion minus that of the chosen fit: n ln(S/n) + p ln n with n rows, p parameters and the sum S of
    /// squared residuals.
    pub criterion: f64,
    /// αc of this sum; null if it has none.
    pub critical_alpha: Option<f64>,
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
    fn of(found: &Measured, metres: Option<f64>) -> Self {
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
            gaussians: found.gaussians.clone(),
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
            profile: found.fitted.clone(),
            draws: found.draws.clone(),
            image: None,
            sides: None,
        }
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

impl Tabular for MeasuredTipFound {
    /// The profile, the fit and the residuals, as a table.
    fn columns(&self) -> Vec<Named<'_>> {
        let Fitted { x, f, fit } = &self.profile;
        let residual = self.profile.residuals();
        columns!(x, f, fit, residual)
    }
}
