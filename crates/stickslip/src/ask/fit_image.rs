//! The question `fit-image`: α and r that explain an image of ripples.

use super::lines::footprint;
use crate::documents::table::{Array, Named, Tabular, as_arrays, columns};
use crate::parameter::option;
use crate::schema::JsonSchema;
use crate::{
    Ask, Context, Document, EstimateDocument, Failure, MeasuredImage, Question, Refused, Tip,
};
use serde::{Deserialize, Serialize};
use stickslip_measurement::{
    Estimate, Image, Lateral, Retrace, RippleError, RippleProfile, RippleRequest, Ripples, Scan,
    has_lines_along_y, ripples,
};
use stickslip_stability::{Raster, RasterPath};
use stickslip_tip::{Footprint, Wider};
use stickslip_units::Unit;

/// Ripples of an image, and the numbers of the model that explain them, with 95 % intervals. Lengths and heights are
/// in the unit of the image.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FitImageFound {
    /// α, dimensionless.
    pub alpha: EstimateDocument,
    /// r, dimensionless.
    pub r: EstimateDocument,
    /// Distance of the crests, perpendicular to them.
    pub wavelength: EstimateDocument,
    /// Angle between crests and scan axis, in degrees.
    pub crest_angle: EstimateDocument,
    /// Half of the peak-to-peak of the first harmonic.
    pub amplitude: EstimateDocument,
    /// Wave number along the scan, in rad per unit of length; above 0.
    pub q: f64,
    /// Wave number across the scan, in rad per unit of length.
    pub kappa: f64,
    /// φ, in rad: crests lie where `q` x + `kappa` y + φ is a multiple of 2π.
    pub phase: f64,
    /// Fitted scale of the heights, k/a: heights are k/a times σ² times those of the model.
    pub height_gain: f64,
    /// αc of a raster of this pitch at the fitted r, dimensionless; null if there is none, or if the tip can leave its lines.
    pub critical_alpha: Option<f64>,
    /// α at which a wave with the wave vector (`q`, `kappa`) neither grows nor decays at the fitted r, dimensionless.
    pub neutral_alpha: f64,
    /// Direction in which the tip moved along the lines when it made the ripples.
    pub scan: Scan,
    /// Direction in which the lines followed each other.
    pub slow_scan: SlowScanName,
    /// The part of the image in which the ripples have settled, and which gives all numbers; null if the whole image
    /// does.
    #[serde(default)]
    pub settled_part: Option<SettledPart>,
    /// Whether the ripples are uniform and the model explains them; otherwise α and r have no intervals.
    pub explained: bool,
    /// Probability of an equally large deviation from settled ripples of the model by chance; below 0.005 the model does
    /// not explain the image.
    pub misfit: f64,
    /// Standard deviation of the first harmonic between parts of the image, without that of the noise, relative to its
    /// size. Above 0.05 the ripples have not settled.
    pub modulation: f64,
    /// Standard deviation of the residuals of all pixels.
    pub residual: f64,
    /// Fraction of the variance, without offsets and slopes of the lines, that the wave explains.
    pub explained_variance: f64,
    /// κ_y, the stiffness across the lines over that along them, if it was free.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stiffness_across: Option<EstimateDocument>,
    /// Comparison of the lateral image with the model, if there is one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lateral: Option<LateralDocument>,
    /// Comparison of the retrace with the trace; null without `retrace_image`.
    #[serde(default)]
    pub retrace: Option<Retrace>,
    /// The mean ripple, perpendicular to the crests.
    pub profile: RippleProfile,
    /// The image without offsets and slopes of its lines, averaged to at most 128 × 128 pixels.
    pub levelled: MeasuredImage,
}

/// A fit to an image and the question that it answers.
pub type FitImageDocument = Document<FitImage>;

/// α and r from an image of settled ripples that a one-way raster has made.
#[derive(Debug, Clone, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default)]
pub struct FitImage {
    /// Name of the image, such as that of its file.
    pub source: String,
    /// Footprint f(x,y), or f(x), with lengths in σ; by default the triple Gaussian with β = 1.
    #[schemars(extend("x-option" = option("NAME", "Model", 1)))]
    pub tip: Option<Tip>,
    /// V in f(x,y) = f(x) exp(-y²/(2V²)), in σ, for a tip without its own f(x,y); by default the width of the tip's
    /// Gaussians.
    #[schemars(extend("x-option" = option("V", "Model", 2)))]
    pub width_y: Option<f64>,
    /// σ in the unit of the image.
    pub width: Option<f64>,
    /// 95 % interval of σ, in the unit of the image: its error is added to those of α and r. By default σ is exact.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub width_interval: Option<[f64; 2]>,
    /// Distance of the scan lines that made the ripples, in the unit of the image; by default the distance of its rows.
    pub pitch: Option<f64>,
    /// α, dimensionless, if known.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-option" = option("A", "Known", 21)))]
    pub alpha: Option<f64>,
    /// r, dimensionless, if known.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-option" = option("R", "Known", 20)))]
    pub r: Option<f64>,
    /// κ_y, the spring constant across the lines of an image over that along them, if known; above 0. By default the tip
    /// cannot leave its lines.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-option" = option("K", "Known", 25)))]
    pub stiffness_across: Option<f64>,
    /// Estimate κ_y from an image, for which α or r must be known.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    #[schemars(extend("x-option" = option("", "Fitted", 31)))]
    pub free_stiffness_across: bool,
    /// k, if known: lateral forces in their unit are k times deflections in the unit of the image.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub force_gain: Option<f64>,
    /// Unit of the lateral image, such as N or nm: of a force, or of the deflection of the lever.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub lateral_unit: Option<String>,
    /// Unit of lengths; that of the image by default.
    #[schemars(extend("x-option" = option("UNIT", "Data", 11)))]
    pub unit: Option<String>,
    /// Unit of heights, such as nm or V; by default unknown.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub height_unit: Option<String>,
    /// Direction in which the tip moved along the lines when it made the ripples; both are tried by default.
    #[schemars(extend("x-option" = option("DIRECTION", "Data", 13)))]
    pub scan: Option<Scan>,
    /// Direction in which the lines of an image followed each other; both are tried by default.
    #[schemars(extend("x-option" = option("DIRECTION", "Data", 14)))]
    pub slow_scan: Option<SlowScanName>,
    /// Measured heights. Documents contain them, levelled, in the answer.
    #[serde(skip_serializing)]
    pub image: MeasuredImage,
    /// Heights of the same area on the way back, at the same positions; both are fitted together.
    #[serde(skip_serializing)]
    pub retrace_image: Option<MeasuredImage>,
    /// Lateral forces, or deflections of the lever, on the lines that made the ripples, at the same positions: positive
    /// where the tip hangs back from the support towards smaller x.
    #[serde(skip_serializing)]
    pub lateral_image: Option<MeasuredImage>,
}

/// Comparison of the lateral image with the model of the ripples.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LateralDocument {
    /// Half of the peak-to-peak of the first harmonic, in the unit of the lateral image.
    pub amplitude: EstimateDocument,
    /// Half of the peak-to-peak of the first harmonic of the lag in the model, in the unit of the image.
    pub lag: EstimateDocument,
    /// k, the stiffness of the lever, from both amplitudes; null for deflections, which the fit of α and r uses.
    pub stiffness: Option<EstimateDocument>,
    /// Unit of k; null if it is unknown.
    pub stiffness_unit: Option<String>,
    /// Phase of the lateral image minus that of the heights, in degrees.
    pub phase: f64,
    /// Phase of the lag in the model minus that of the heights, in degrees.
    pub model_phase: f64,
    /// Distance along the lines by which the lateral image is ahead of the model, in the unit of the image.
    pub shift: f64,
    /// Standard deviation of `shift`.
    pub shift_error: f64,
}

/// A direction across the lines.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum SlowScanName {
    /// Towards larger y.
    Up,
    /// Towards smaller y.
    Down,
}

/// A part of an image: its first and last position along each axis, in the unit of the image.
#[derive(Debug, Clone, Copy, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SettledPart {
    /// Along the lines.
    pub x: [f64; 2],
    /// Across the lines.
    pub y: [f64; 2],
}

/// Largest number of rows and columns of the levelled image.
const MOST: usize = 128;
/// Largest deviation of positions from even spacing, in spacings.
const UNEVEN: f64 = 1e-3;
/// Warnings about assumptions.
const TRANSPOSED: &str = "heights step from column to column, as between scan lines, and not from row to row: the image seems to be \
                          transposed; its rows must be the scan lines";
const ASSUMED_TIP: &str = "no footprint is given: the triple Gaussian of the paper, β = 1, is assumed; give the measured one with --tip-file";
const ASSUMED_PITCH: &str = "no pitch is given: the lines that made the ripples are assumed to be as far apart as the rows of the image; \
                             --pitch sets it";

impl Question for FitImage {
    const FORMAT: &'static str = "stickslip/fit-image";
    type Answer = FitImageFound;

    fn unit_of<'a>(&'a self, _: &'a FitImageFound, column: &str) -> Option<&'a str> {
        let is_length = ["distance", "x", "y"].contains(&column);
        if is_length { &self.unit } else { &self.height_unit }.as_deref()
    }
}

impl FitImage {
    /// A fit to this image with this σ, with everything else unknown.
    pub fn new(image: MeasuredImage, width: f64) -> Self {
        Self { image, width: Some(width), ..Self::default() }
    }

    /// f(x,y), and its width across if it is f(x) times a Gaussian.
    fn footprint(&self) -> Result<(Footprint, Option<f64>), Refused> {
        footprint(self.width_y, &self.tip.clone().unwrap_or_default().0)
    }

    /// σ, in the unit of the image.
    fn sigma(&self) -> Result<f64, Refused> {
        let why = "σ of the tip is needed: the ripples contain lengths only in relation to it";
        Refused::positive("width", self.width.ok_or_else(|| Refused::whole("width", why))?)
    }

    /// The distance of the scan lines, in the unit of the image.
    fn distance(&self) -> Result<f64, Refused> {
        let y = &self.image.y;
        match self.pitch {
            Some(pitch) => Refused::positive("pitch", pitch),
            None => Ok((y[y.len() - 1] - y[0]) / (y.len() - 1) as f64),
        }
    }

    /// The image, on an even grid.
    fn heights(&self) -> Result<Image, Refused> {
        heights("image", &self.image)
    }

    /// The lateral image, with its unit over that of the lengths if that is known.
    fn lateral(&self) -> Result<Option<Lateral>, Refused> {
        let Some(image) = &self.lateral_image else { return Ok(None) };
        let image = heights("lateral_image", image)?;
        let one = |unit: &Option<String>| unit.as_ref().and_then(|unit| Unit::Length.one(unit));
        let of_lengths = one(&self.lateral_unit).map(|own| own / one(&self.unit).unwrap_or(own));
        match (of_lengths, self.force_gain) {
            (Some(_), Some(gain)) => {
                let why = "the lateral image has deflections, in a unit of length: leave it out";
                Err(Refused::number("force_gain", gain, why))
            }
            (length, Some(gain)) => Ok(Some(Lateral {
                image,
                length: length.or(Some(1.0 / Refused::positive("force_gain", gain)?)),
            })),
            (length, None) => Ok(Some(Lateral { image, length })),
        }
    }

    /// The unit of k: force over length.
    fn stiffness_unit(&self) -> Option<String> {
        let (force, length) = (self.lateral_unit.as_deref()?, self.unit.as_deref()?);
        Some(match (force, length) {
            ("nN", "nm") => "N/m".into(),
            _ => format!("{force}/{length}"),
        })
    }

    /// The result with the error of σ: α and r are fitted again at both ends of the interval of σ.
    fn with_error_of_sigma(
        &self,
        found: Ripples,
        (image, mut request): (&Image, RippleRequest),
    ) -> Ripples {
        request.forward = Some(found.forward);
        request.upward = Some(found.upward);
        let at = |sigma: &f64| ripples(image, &RippleRequest { sigma: *sigma, ..request.clone() });
        let ends: Vec<Ripples> =
            self.width_interval.iter().flatten().filter_map(|sigma| at(sigma).ok()).collect();
        let wider = |of: fn(&Ripples) -> Estimate| {
            let moved = ends.iter().map(|end| (of(end).value / of(&found).value).ln().abs());
            of(&found).wider_by(moved.fold(0.0, f64::max).exp())
        };
        let (alpha, r) = (wider(|found| found.alpha), wider(|found| found.r));
        Ripples { alpha, r, ..found }
    }

    fn request(&self) -> Result<RippleRequest, Refused> {
        let one = |name, value: Option<f64>| value.map(|v| Refused::positive(name, v)).transpose();
        Ok(RippleRequest {
            stiffness: one("stiffness_across", self.stiffness_across)?,
            frees_stiffness: self.free_stiffness_across,
            known: [one("alpha", self.alpha)?, one("r", self.r)?],
            lateral: self.lateral()?,
            forward: self.scan.map(|scan| scan == Scan::Right),
            upward: self.slow_scan.map(|scan| scan == SlowScanName::Up),
            retrace: self
                .retrace_image
                .as_ref()
                .map(|i| heights("retrace_image", i))
                .transpose()?,
            ..RippleRequest::new(self.footprint()?.0, self.sigma()?, self.distance()?)
        })
    }
}

fn heights(name: &'static str, image: &MeasuredImage) -> Result<Image, Refused> {
    let MeasuredImage { x, y, rows } = image.clone();
    if !(is_even(&x) && is_even(&y)) {
        let why = "the positions of columns and rows must ascend evenly";
        return Err(Refused::whole(name, why));
    }
    Image::new(x, y, rows).map_err(|error| Refused::whole(name, error))
}

fn is_even(at: &[f64]) -> bool {
    let [first, .., last] = at else { return false };
    let step = (last - first) / (at.len() - 1) as f64;
    let off = |(i, v): (usize, &f64)| {
        !v.is_finite() || (v - first - step * i as f64).abs() > UNEVEN * step
    };
    step > 0.0 && !at.iter().enumerate().any(off)
}

impl Ask for FitImage {
    fn resolved(self, _: &Context) -> Result<Self, Failure> {
        self.tip.iter().try_for_each(|tip| tip.judge_even("a fit"))?;
        self.heights()?;
        let sigma = self.request()?.sigma;
        if self.free_stiffness_across {
            if let Some(stiffness) = self.stiffness_across {
                let why = "is both known and free: leave one of them out";
                return Err(Refused::number("stiffness_across", stiffness, why).into());
            }
            if self.alpha.is_none() && self.r.is_none() {
                let why = "an image determines two of α, r and κ_y: give {alpha} or {r}";
                return Err(Refused::whole("free_stiffness_across", why).into());
            }
        }
        if let Some([low, high]) = self.width_interval
            && !(low > 0.0 && low <= sigma && sigma <= high && high.is_finite())
        {
            let why = "must be a low and a high end above 0 with {width} between them";
            return Err(Refused::whole("width_interval", why).into());
        }
        Ok(self)
    }

    fn answer(&self, _: &Context) -> Result<(FitImageFound, Vec<String>), Failure> {
        let (image, request) = (self.heights()?, self.request()?);
        let is_transposed = has_lines_along_y(&image);
        let refused = |error| match error {
            RippleError::Retrace(_) => Refused::whole("retrace_image", error),
            RippleError::Lateral(_) => Refused::whole("lateral_image", error),
            RippleError::Request(_) => Refused::whole("tip", error),
            _ if is_transposed => Refused::whole("image", format!("{error}; {TRANSPOSED}")),
            _ => Refused::whole("image", error),
        };
        let found = ripples(&image, &request).map_err(refused)?;
        let found = self.with_error_of_sigma(found, (&image, request.clone()));
        let at = (found.r.value, request.pitch / request.sigma);
        let raster = Raster::new(&request.footprint, Wider::default(), at, 1.0);
        // The threshold across the lines is another question.
        let is_rigid = request.stiffness.is_none() && !request.frees_stiffness;
        let critical = raster.ok().filter(|_| is_rigid);
        let critical = critical.and_then(|raster| raster.critical(RasterPath::OneWay).ok());
        let levelled = Ripples::levelled(&image, MOST).map_err(|e| Refused::whole("image", e))?;
        let critical_alpha = critical.map(|at| at.alpha);
        let answer = FitImageFound::of(&found, critical_alpha, &levelled, self.stiffness_unit());
        let assumed = [
            is_transposed.then(|| TRANSPOSED.into()),
            self.tip.is_none().then(|| ASSUMED_TIP.into()),
            self.pitch.is_none().then(|| ASSUMED_PITCH.into()),
        ];
        Ok((answer, assumed.into_iter().flatten().chain(found.remarks()).collect()))
    }

    fn answered(self, context: &Context) -> Result<Document<Self>, Failure> {
        let (answer, remarks) = context.within(|| self.answer(context))?;
        let (width_y, pitch) = (self.footprint()?.1, Some(self.distance()?));
        let tip = Some(self.tip.clone().unwrap_or_default());
        Ok(Document::new(Self { tip, width_y, pitch, ..self }, answer, remarks))
    }
}

impl FitImageFound {
    fn of(
        found: &Ripples,
        critical_alpha: Option<f64>,
        levelled: &Image,
        stiffness_unit: Option<String>,
    ) -> Self {
        let explained = found.is_explained();
        let judged = |estimate: Estimate| {
            let estimate = EstimateDocument::from(estimate);
            if explained {
                estimate
            } else {
                EstimateDocument { low: None, high: None, ..estimate }
            }
        };
        let [q, kappa] = found.wave_vector;
        Self {
            alpha: judged(found.alpha),
            r: judged(found.r),
            wavelength: found.wavelength.into(),
            crest_angle: found.crest_angle.into(),
            amplitude: found.amplitude.into(),
            q,
            kappa,
            phase: found.phase,
            height_gain: found.height_gain,
            critical_alpha,
            neutral_alpha: found.neutral_alpha,
            scan: if found.forward { Scan::Right } else { Scan::Left },
            slow_scan: if found.upward { SlowScanName::Up } else { SlowScanName::Down },
            settled_part: found.part.map(|[x, y]| SettledPart { x, y }),
            explained,
            misfit: found.misfit,
            modulation: found.modulation,
            residual: found.residual,
            explained_variance: found.explained,
            stiffness_across: found.stiffness.map(judged),
            lateral: found.lateral.map(|lateral| LateralDocument {
                amplitude: lateral.amplitude.into(),
                lag: judged(lateral.lag),
                stiffness: lateral.stiffness.map(judged),
                stiffness_unit: lateral.stiffness.and(stiffness_unit),
                phase: lateral.phase[0],
                model_phase: lateral.phase[1],
                shift: lateral.shift,
                shift_error: lateral.shift_error,
            }),
            retrace: found.retrace,
            profile: found.profile.clone(),
            levelled: MeasuredImage {
                x: levelled.x().to_vec(),
                y: levelled.y().to_vec(),
                rows: levelled.rows().to_vec(),
            },
        }
    }
}

impl Tabular for FitImageFound {
    /// The mean ripple.
    fn columns(&self) -> Vec<Named<'_>> {
        let RippleProfile { distance, height, error, model } = &self.profile;
        columns!(distance, height, error, model)
    }

    /// The columns, and the levelled image.
    fn arrays(&self) -> Vec<(&'static str, Array<'_>)> {
        let mut arrays: Vec<_> = as_arrays(self.columns()).collect();
        let MeasuredImage { x, y, rows } = &self.levelled;
        arrays.extend([
            ("x", Array::vector(x)),
            ("y", Array::vector(y)),
            ("z", Array::matrix(rows)),
        ]);
        arrays
    }
}
