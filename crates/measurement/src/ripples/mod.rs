//! Estimation of α and r from an image of ripples that a raster has made.
//!
//! Two steps: the wave in the image (wave vector and three harmonics, [`wave`]) and the settled pattern of the model with
//! the same wave (`travelling`). For a given pitch the wave vector alone determines α and r of the neutral wave; the
//! harmonics determine how far α is above this value. The gain of the heights and the phase of the wave are fitted too.

mod across;
mod direction;
mod explained;
mod lateral;
mod part;
mod retrace;
mod travelling;
mod wave;

use crate::image::{Image, ImageError};
use crate::interval::Estimate;
pub use direction::has_lines_along_y;
use explained::{Known, Problem};
use lateral::Seen;
pub use lateral::{Lag, Lateral, LateralFound};
use part::Part;
pub use retrace::Retrace;
use std::f64::consts::TAU;
use stickslip_tip::Footprint;
use thiserror::Error;
use travelling::{Lines, crest_angle};
use wave::coarse_image;

/// Known quantities of an image of ripples, and options of the estimation.
#[derive(Debug, Clone)]
pub struct RippleRequest {
    /// f(x,y), in σ.
    pub footprint: Footprint,
    /// σ, in the unit of the image.
    pub sigma: f64,
    /// Distance of the scan lines, in the unit of the image.
    pub pitch: f64,
    /// Whether the tip moved towards larger x when it made the ripples; both are tried by default.
    pub forward: Option<bool>,
    /// Whether the lines followed each other towards larger y; both are tried by default.
    pub upward: Option<bool>,
    /// Heights on the way back, at the same positions.
    pub retrace: Option<Image>,
    /// κ_y of a tip that gives way across the lines, over the stiffness along them; `None` for a rigid one.
    pub stiffness: Option<f64>,
    /// Whether κ_y is estimated; α or r must be known then.
    pub frees_stiffness: bool,
    /// α and r; `None` where unknown.
    pub known: [Option<f64>; 2],
    /// Lateral forces on the lines that made the ripples.
    pub lateral: Option<Lateral>,
}

impl RippleRequest {
    /// Ripples of a rigid tip with this footprint and σ, on lines of this distance, with nothing else known.
    pub fn new(footprint: Footprint, sigma: f64, pitch: f64) -> Self {
        Self {
            footprint,
            sigma,
            pitch,
            forward: None,
            upward: None,
            retrace: None,
            stiffness: None,
            frees_stiffness: false,
            known: [None; 2],
            lateral: None,
        }
    }
}

/// Ripples of an image, and the numbers of the model. Lengths and heights in the units of the image.
#[derive(Debug, Clone, PartialEq)]
pub struct Ripples {
    /// Dimensionless indentation rate.
    pub alpha: Estimate,
    /// Dimensionless support velocity.
    pub r: Estimate,
    /// κ_y, if it was free.
    pub stiffness: Option<Estimate>,
    /// The lag of the tip behind the support in the model, if there is a lateral image.
    pub lag: Option<Lag>,
    /// Comparison of the lateral image with the model.
    pub lateral: Option<LateralFound>,
    /// Distance of the crests, perpendicular to them.
    pub wavelength: Estimate,
    /// Angle between crests and scan axis, in degrees.
    pub crest_angle: Estimate,
    /// Half of the peak-to-peak of the first harmonic.
    pub amplitude: Estimate,
    /// Wave vector (q, κ) along x and y; q > 0.
    pub wave_vector: [f64; 2],
    /// φ: crests lie where qx + κy + φ is a multiple of 2π.
    pub phase: f64,
    /// The mean ripple.
    pub profile: RippleProfile,
    /// k/a: heights are k/a times σ² times those of the model.
    pub height_gain: f64,
    /// The α at which, by linear theory, a wave with this wave vector neither grows nor decays at this r.
    pub neutral_alpha: f64,
    /// Whether the tip moved towards larger x.
    pub forward: bool,
    /// Whether the lines followed each other towards larger y.
    pub upward: bool,
    /// First and last x and y of the part of the image in which the ripples have settled, from which all numbers are
    /// computed; `None` for the whole image.
    pub part: Option<[[f64; 2]; 2]>,
    /// Probability of so large a χ² by chance, if the ripples are a settled pattern of the model. Below
    /// [`Ripples::LEAST_MISFIT`] the model does not explain them.
    pub misfit: f64,
    /// Variation of the first harmonic from part to part of the image: its standard deviation, without that of the noise, over
    /// its size. Ripples that have settled are uniform.
    pub modulation: f64,
    /// Standard deviation of the residuals of all pixels.
    pub residual: f64,
    /// Fraction of the variance, without offsets and slopes of the rows, that the wave explains.
    pub explained: f64,
    /// Comparison of the retrace with the trace.
    pub retrace: Option<Retrace>,
}

/// The mean ripple; columns of equal length.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(rename = "RippleProfileDocument"))]
pub struct RippleProfile {
    /// Distance from the crest, perpendicular to it, in the direction of the wave vector.
    pub distance: Vec<f64>,
    /// Mean height.
    pub height: Vec<f64>,
    /// Standard deviation of `height`.
    pub error: Vec<f64>,
    /// Height of the model.
    pub model: Vec<f64>,
}

/// The reason why an image gives no numbers.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum RippleError {
    /// A size that is not above 0, or a footprint that does not fade.
    #[error("{0}")]
    Request(&'static str),
    /// The image is too small or damaged.
    #[error(transparent)]
    Image(#[from] ImageError),
    /// The retrace does not belong to the image.
    #[error("{0}")]
    Retrace(&'static str),
    /// The lateral image does not belong to the image of heights.
    #[error("{0}")]
    Lateral(&'static str),
    /// No wave is stronger than the noise.
    #[error("no ripples stand out of the noise")]
    Nothing,
    /// Amplitude or phase of the wave change across the image.
    #[error(
        "the ripples are not uniform: crop the image (in Gwyddion; in Python by .isel) to a part where they have settled, away from \
         the first lines and from the edge where the lines begin"
    )]
    NotUniform,
    /// The model has no settled pattern with this wave vector.
    #[error(
        "the model has no settled ripples with a wavelength of {wavelength:.4} σ and crests at {angle:.1}° for lines {pitch:.4} σ \
         apart: check σ, the pitch and the footprint"
    )]
    NoPattern {
        /// Wavelength, in σ.
        wavelength: f64,
        /// Crest angle, in degrees.
        angle: f64,
        /// Pitch, in σ.
        pitch: f64,
    },
}

impl Ripples {
    /// Least probability of χ² at which the model is said to explain the ripples.
    pub const LEAST_MISFIT: f64 = 0.005;
    /// Largest modulation of ripples that count as settled. Of images of rasters few lie between 0.046 and 0.055; from 0.06
    /// to 0.1 r may be off by ten times its error.
    pub const MOST_MODULATION: f64 = 0.05;

    /// The image without offsets and slopes of its rows, averaged to at most `most` rows and columns.
    ///
    /// # Errors
    /// The result is too small.
    pub fn levelled(image: &Image, most: usize) -> Result<Image, ImageError> {
        coarse_image(image, most)
    }

    /// Whether the model explains the ripples.
    pub fn is_explained(&self) -> bool {
        self.misfit >= Self::LEAST_MISFIT && self.modulation <= Self::MOST_MODULATION
    }

    /// Warnings about the result.
    pub fn remarks(&self) -> Vec<String> {
        let mut remarks = vec![];
        if let Some([[left, right], [low, high]]) = self.part {
            remarks.push(format!(
                "the ripples have not settled everywhere: all numbers are from x = {left:.4} to {right:.4}, y = {low:.4} to {high:.4}"
            ));
        }
        if self.modulation > Self::MOST_MODULATION {
            remarks.push(format!(
                "the ripples differ by {:.0} % between the parts of the image: they have not settled, and α and r get no intervals; \
                 crop the image (in Gwyddion; in Python by .isel) to a part away from the first lines and from the edge where the \
                 lines begin",
                100.0 * self.modulation
            ));
        }
        if self.misfit < Self::LEAST_MISFIT {
            remarks.push(format!(
                "the model does not explain these ripples (probability {:.1e}): they are not settled or not uniform in this image, \
                 the lines were scanned to and fro, or σ, pitch or footprint are others",
                self.misfit
            ));
        }
        if let Some(Retrace { ratio, agreement, .. }) = self.retrace
            && agreement < Self::LEAST_MISFIT
        {
            remarks.push(format!(
                "trace and retrace differ by more than noise (probability {agreement:.1e}, amplitude of the retrace {ratio:.3} of that \
                 of the trace): all numbers are of their mean, and intervals do not contain the difference; a slow feedback or an uneven \
                 tip makes one"
            ));
        }
        if let Some(LateralFound { shift, shift_error, .. }) = self.lateral
            && shift.abs() > 3.0 * shift_error
        {
            remarks.push(format!(
                "the lateral image lies {shift:.4} further along the lines than the model predicts: it is of another scan, \
                 has the other sign, or the scanner has a hysteresis; α, r and k do not depend on this shift"
            ));
        }
        if self.amplitude.value < 2.0 * self.residual {
            remarks.push(format!(
                "the residual, {:.2e}, is more than half of the amplitude, {:.2e}",
                self.residual, self.amplitude.value
            ));
        }
        remarks
    }
}

/// Estimates α and r from an image of settled ripples made by a one-way raster under the basic model.
///
/// # Errors
/// An unusable request or image, no uniform ripples above the noise, or ripples that the model does not have.
pub fn ripples(image: &Image, request: &RippleRequest) -> Result<Ripples, RippleError> {
    let positive = [request.sigma, request.pitch].iter().all(|v| v.is_finite() && *v > 0.0);
    let lines = Lines::new(&request.footprint, request.pitch / request.sigma)
        .filter(|_| positive)
        .map(|lines| lines.with_stiffness(request.stiffness))
        .ok_or(RippleError::Request("needs σ and pitch above 0, and a footprint that fades"))?;
    let (pair, retrace) = self::retrace::pair(image, request.retrace.as_ref())?;
    let part = Part::settled(&pair)?;
    let wave = &part.wave;
    let lateral = request.lateral.as_ref();
    let lateral = lateral.map(|lateral| Seen::of(lateral, (image, part.ends), wave)).transpose()?;
    let known = Known {
        numbers: request.known,
        frees_stiffness: request.frees_stiffness,
        seeks_lag: lateral.is_some(),
        lag: lateral.as_ref().and_then(|seen| seen.in_widths(request.sigma)),
    };
    let ways = [(true, true), (true, false), (false, true), (false, false)];
    let admitted = ways.into_iter().filter(|(forward, upward)| {
        request.forward.is_none_or(|known| known == *forward)
            && request.upward.is_none_or(|known| known == *upward)
    });
    let closest = admitted.filter_map(|way| {
        let problem = Problem::new(&lines, wave, (request.sigma, known), way)?;
        let closest = problem.closest()?;
        Some((problem, closest))
    });
    let best = closest.min_by(|a, b| a.1.sum.total_cmp(&b.1.sum));
    let found = best.and_then(|(problem, closest)| problem.solved(&closest));
    let found = found.ok_or_else(|| RippleError::NoPattern {
        wavelength: TAU / wave.q().hypot(wave.kappa()) / request.sigma,
        angle: crest_angle(wave.q(), wave.kappa()),
        pitch: request.pitch / request.sigma,
    })?;
    let middle = |[first, last]: [f64; 2]| 0.5 * (first + last);
    let ([q, kappa], [x, y]) = (found.wave_vector, part.ends);
    let phase = (found.phase - q * middle(x) - kappa * middle(y)).rem_euclid(TAU);
    let is_whole = part.ends == part::ends(image);
    let lateral = lateral.zip(found.lag);
    let lateral = lateral.map(|(seen, lag)| seen.beside(&lag, found.forward, request.sigma));
    Ok(Ripples { phase, lateral, part: (!is_whole).then_some(part.ends), retrace, ..found })
}
