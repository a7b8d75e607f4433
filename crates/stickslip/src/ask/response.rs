//! The question `response`: the effect of weak pulses on steady motion, to first order.

use super::exponents::{failed, judge_count, remarks};
use crate::documents::table::{Array, Named, Tabular, as_arrays, columns};
use crate::parameter::option;
use crate::schema::JsonSchema;
use crate::{
    Ask, CertificateDocument, ComplexDocument, Context, Document, Failure, Indentation, Law,
    ModelParameters, Question, Refused, Run, Sampling, SteadyState, Tip,
};
use serde::{Deserialize, Serialize};
use stickslip_stability::{self as theory, ResponseMode};
use stickslip_tip::roots::bisected;
use stickslip_tip::{Model, Pulse, TipFunction};

/// Largest contribution of the omitted modes, relative to the leading one, at which the sum counts as valid.
const VALID_TO: f64 = 1e-6;
/// Half length of a pulse in standard deviations: exp(-5.5²/2) = 3e-7.
const WIDTHS_OF_PULSE: f64 = 5.5;
/// Largest deviation, in widths of the tip, that counts as small.
const SMALL: f64 = 0.01;

/// Linear response of steady motion to weak pulses. Lengths in σ, times in Γ/k.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ResponseFound {
    /// The steady motion that the pulses disturb.
    pub steady_state: SteadyState,
    /// Terms of (A.9) by falling Re λ.
    pub modes: Vec<ModeDocument>,
    /// Time t0, in Γ/k, to which the residues refer, the center of the last pulse: from `valid_from` on, l(t) - l0 =
    /// Σ residue e^{λ(t-t0)}.
    pub origin: f64,
    /// Time t after the last pulse, in Γ/k, from which the omitted modes contribute less than `valid_to` of the leading
    /// mode, by an estimate. Earlier samples come from the inverse Laplace transform, to 1e-9 of their largest: during
    /// a pulse the sum over modes is off by up to a half.
    pub valid_from: f64,
    /// Largest contribution of the omitted modes relative to the leading one; 1e-6.
    pub valid_to: f64,
    /// Evidence that no mode to the right of the last one is missing.
    pub certificate: CertificateDocument,
    /// l at the sample times.
    pub samples: ResponseSamples,
}

/// The linear response of steady motion to weak pulses, as a sum of modes (A.9).
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
pub struct Response {
    /// Footprint f(x) of the tip.
    #[schemars(extend("x-option" = option("NAME", "Model", 1)))]
    #[serde(default)]
    pub tip: Tip,
    /// α, or αc(r) + D.
    #[serde(flatten)]
    pub indentation: Indentation,
    /// Dimensionless support velocity r = Γ v0/(k σ), (12); above 0.
    #[schemars(extend("x-option" = option("R", "Model", 2)))]
    pub r: f64,
    /// Terms added to the basic model.
    #[serde(flatten)]
    pub law: Law,
    /// Gaussian pulses of external force.
    pub pulses: Vec<Pulse>,
    /// Least number of modes in the list. It has all modes to the right of a vertical line in the complex plane.
    #[schemars(extend("x-option" = option("N", "Accuracy", 50)))]
    #[serde(default = "default_modes")]
    pub modes: usize,
    /// X, in σ: the samples begin when a run from this start position with a steady start begins, so that both can be
    /// compared sample by sample.
    #[schemars(extend("x-option" = option("X", "Output", 62)))]
    #[serde(default = "super::run::default_start_position")]
    pub start_position: f64,
    /// Time of the last sample, in Γ/k.
    #[schemars(extend("x-option" = option("T", "Model", 5)))]
    pub until: f64,
    /// Times of the samples.
    #[serde(flatten)]
    pub sampling: Sampling,
}

fn default_modes() -> usize {
    10
}

/// A response and the question that it answers.
pub type ResponseDocument = Document<Response>;

impl Question for Response {
    const FORMAT: &'static str = "stickslip/response";
    type Answer = ResponseFound;
}

impl Response {
    /// Footprint, law, α and r in the form of other documents.
    pub fn model_parameters(&self) -> ModelParameters {
        ModelParameters::of_question(&self.tip, self.indentation, self.r, self.law)
    }

    /// A run over the same time, for comparison.
    fn run(&self) -> Run {
        let start_position = self.start_position;
        let run = Run::new(self.tip.clone(), self.indentation, self.r, self.until);
        Run { law: self.law, start_position, sampling: self.sampling.clone(), ..run }
    }

    /// Times of the first and the last sample.
    ///
    /// # Errors
    /// The first would be after the last.
    pub fn span(&self) -> Result<(f64, f64), Failure> {
        let start = self.run().started_at()?;
        Ok((start, self.until))
    }
}

impl Ask for Response {
    fn support_velocity(&self) -> Option<f64> {
        Some(self.r)
    }

    fn resolved(self, context: &Context) -> Result<Self, Failure> {
        self.law.dragged(&self.tip.0)?;
        judge_count("modes", self.modes)?;
        if self.pulses.is_empty() {
            return Err(Refused::whole("pulses", "at least one is needed").into());
        }
        let Run { indentation, .. } = self.run().resolved(context)?;
        let question = Self { indentation, ..self };
        question.sampling.times(question.span()?, "the response", true)?;
        Ok(question)
    }

    fn answer(&self, _: &Context) -> Result<(ResponseFound, Vec<String>), Failure> {
        let pulsed = Pulsed::of(self)?;
        let response = pulsed.response(self.modes)?;
        let mut said = remarks(&response.spectrum, Some(self.modes), "modes");
        if matches!(self.tip.0, TipFunction::Bessel) {
            let message = "modes: the branch points ±ir of J0 add a term that falls like t^(-3/2), \
                           which is left out here and in valid_from";
            said.push(message.into());
        }
        let valid_from = pulsed.valid_from(&response)?;
        let times = self.sampling.times(self.span()?, "the response", true)?;
        let samples = pulsed.samples(&response, valid_from, times.all());
        said.extend(pulsed.beyond_linear(&response, &samples));
        let found = ResponseFound {
            steady_state: (&pulsed.model).into(),
            modes: response.modes.iter().map(mode).collect::<Result<_, _>>()?,
            origin: pulsed.origin,
            valid_from,
            valid_to: VALID_TO,
            certificate: (&response.spectrum.certificate).into(),
            samples,
        };
        Ok((found, said))
    }
}

/// Steady motion and the pulses that disturb it.
struct Pulsed {
    model: Model,
    pulses: Vec<Pulse>,
    /// Center of the last pulse.
    origin: f64,
}

impl Pulsed {
    fn of(question: &Response) -> Result<Self, Refused> {
        let law = question.law.dragged(&question.tip.0)?;
        let model = question.indentation.model(&question.tip.0, law, question.r)?;
        let pulses = question.pulses.clone();
        let origin = pulses.iter().map(|p| p.time).fold(f64::NEG_INFINITY, f64::max);
        Ok(Self { model, pulses, origin })
    }

    /// The modes, with residues that refer to the origin: at t = 0 those of a late pulse would overflow.
    fn response(&self, modes: usize) -> Result<theory::Response, Failure> {
        let shifted = self.pulses.iter().map(|p| Pulse { time: p.time - self.origin, ..*p });
        let shifted: Vec<Pulse> = shifted.collect();
        let found = theory::response(&self.model, &shifted, modes);
        found.map_err(|error| failed(&error, "ask for another number with {modes}"))
    }

    /// The time from which the modes beyond those of `listed` are negligible compared with the leading one.
    fn valid_from(&self, listed: &theory::Response) -> Result<f64, Failure> {
        let more = self.response(listed.modes.len() + 20)?;
        let beyond = more.modes.get(listed.modes.len()..).unwrap_or_default();
        let size =
            |mode: &ResponseMode, since: f64| mode.residue.norm() * (mode.lambda.re * since).exp();
        let fading = |since: f64| {
            let leading = listed.modes.first().map_or(0.0, |mode| size(mode, since));
            beyond.iter().map(|mode| size(mode, since)).sum::<f64>() <= VALID_TO * leading
        };
        let over = self.pulses.iter().map(|p| p.time - self.origin + WIDTHS_OF_PULSE * p.width);
        let over = over.fold(0.0, f64::max);
        if fading(over) {
            return Ok(self.origin + over);
        }
        let doubled = (0..60).map(|n| 0.01 * 2.0_f64.powi(n)).find(|d| fading(over + d));
        let is_narrow = |(low, high): (f64, f64)| high - low <= 1e-3 * high;
        let lasts = |longer: f64| !fading(over + longer);
        let (_, longer) = bisected((0.0, doubled.unwrap_or(0.0)), lasts, is_narrow);
        Ok(self.origin + over + longer)
    }

    /// The samples: the sum over modes from `valid_from` on, and the inverse transform before. For J0, whose modes
    /// are never complete, the inverse transform throughout.
    fn samples(
        &self,
        response: &theory::Response,
        valid_from: f64,
        t: Vec<f64>,
    ) -> ResponseSamples {
        let l0 = self.model.steady_l();
        let finite = |value: f64| value.is_finite().then_some(value);
        let until = match self.model.tip() {
            TipFunction::Bessel => t.iter().copied().fold(valid_from, f64::max),
            _ => valid_from,
        };
        let early = response.while_pulses_last(&self.model, until - self.origin);
        let at = |t: f64| match &early {
            Some(early) if t < until => early.at(t - self.origin),
            _ => response.at(t - self.origin),
        };
        let deviation: Vec<Option<f64>> = t.iter().map(|t| finite(at(*t))).collect();
        let l = deviation.iter().map(|d| d.and_then(|d| finite(l0 + d))).collect();
        ResponseSamples { t, l, deviation }
    }

    /// A warning if linear theory does not describe the motion of the tip.
    fn beyond_linear(&self, response: &theory::Response, samples: &ResponseSamples) -> Vec<String> {
        let sizes = samples.deviation.iter().flatten().map(|d| d.abs());
        let widths = sizes.fold(0.0, f64::max) / self.model.tip().widths(1.0);
        let strong = (widths > SMALL).then(|| {
            format!(
                "samples: l leaves l0 by up to {widths:.1e} widths of the tip; linear theory has a relative error of \
                 about this size: make the pulses weaker, or integrate with `stickslip run --pulse A,T,W`"
            )
        });
        let grows = response.modes.first().filter(|mode| mode.lambda.re > 0.0).map(|mode| {
            format!(
                "samples: steady motion is unstable here (α is above αc): the response grows at the rate {:.3} and is \
                 valid only while it is small",
                mode.lambda.re
            )
        });
        strong.into_iter().chain(grows).collect()
    }
}

fn mode(mode: &ResponseMode) -> Result<ModeDocument, Refused> {
    let ResponseMode { lambda, residue } = mode;
    if !(residue.re.is_finite() && residue.im.is_finite()) {
        let why = "a mode overflows between the first pulse and the last, or within a pulse: bring the pulses closer \
        together, or make them shorter";
        return Err(Refused::whole("pulses", why));
    }
    Ok(ModeDocument {
        lambda: ComplexDocument::new(lambda.re, lambda.im),
        residue: ComplexDocument::new(residue.re, residue.im),
    })
}

/// One mode, residue e^{λ(t-t0)}.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ModeDocument {
    /// λ, in k/Γ.
    pub lambda: ComplexDocument,
    /// Residue of the mode, in σ.
    pub residue: ComplexDocument,
}

/// Columns of equal length.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ResponseSamples {
    /// Times, in Γ/k.
    pub t: Vec<f64>,
    /// l = rt - r - x0, in σ; null where it overflows.
    pub l: Vec<Option<f64>>,
    /// l - l0, in σ, without cancellation where it is small; null where it overflows.
    pub deviation: Vec<Option<f64>>,
}

impl Tabular for ResponseFound {
    fn columns(&self) -> Vec<Named<'_>> {
        let ResponseSamples { t, l, deviation } = &self.samples;
        columns!(t, l, deviation)
    }

    /// The samples and the modes, as arrays.
    fn arrays(&self) -> Vec<(&'static str, Array<'_>)> {
        let of = |name, of: fn(&ModeDocument) -> f64| {
            (name, Array::vector(self.modes.iter().map(of).collect::<Vec<_>>()))
        };
        let modes = [
            of("lambda_re", |m| m.lambda.re),
            of("lambda_im", |m| m.lambda.im),
            of("residue_re", |m| m.residue.re),
            of("residue_im", |m| m.residue.im),
        ];
        as_arrays(self.columns()).chain(modes).collect()
    }
}
