//! `stickslip response`.

use super::job::{Job, judge_places};
use super::model::{refuse_endless, wide_model};
use super::run::disturbance::warn_of_idle_pulses;
use super::run::limits::within_range;
use super::run::parse_pulses;
use super::run::samples::times;
use crate::arguments::ResponseArguments;
use crate::commands::in_units::scales;
use crate::failure::{Failure, Typed};
use stickslip::exponents::{failed, judge_count, remarks};
use stickslip::{
    ComplexDocument, Document, ModeDocument, ModelParameters, Physical, ResponseDocument,
    ResponseFound, ResponseParameters, ResponseSamples,
};
use stickslip_stability::{Response, ResponseMode, response as respond};
use stickslip_tip::roots::bisected;
use stickslip_tip::{Model, Pulse, Scenario, TipFunction};

/// What the modes left out may add, relative to the leading one, where the sum counts as valid.
const VALID_TO: f64 = 1e-6;
/// exp(-5.5²/2) = 3e-7: after so many widths a pulse is over.
const WIDTHS_OF_PULSE: f64 = 5.5;

pub(crate) fn response(arguments: &ResponseArguments) -> Result<(), Failure> {
    let read = [("--tip-file", arguments.model.tip.tip_file.as_deref())];
    judge_places(&arguments.outlet, arguments.plot.as_deref(), &read)?;
    let asked = Asked::of(arguments)?;
    let tip_file = arguments.model.tip.tip_file.as_deref();
    let scales = scales(&arguments.in_units, tip_file, Some(asked.model.r()))?;
    let job = Job::open::<ResponseDocument>(&arguments.outlet, arguments.plot.as_deref())?;
    job.finish(document(arguments, &asked)?.in_units(scales.as_ref()))
}

/// The options, judged.
struct Asked {
    model: Model,
    pulses: Vec<Pulse>,
    /// When the samples are taken.
    times: Vec<f64>,
    /// Center of the last pulse.
    origin: f64,
}

impl Asked {
    fn of(arguments: &ResponseArguments) -> Result<Self, Failure> {
        refuse_endless(&arguments.model.tip, &arguments.model.wider)?;
        let model = wide_model(&arguments.model)?;
        let pulses: Vec<Pulse> = parse_pulses(&arguments.pulse)?;
        judge_count("modes", arguments.modes)?;
        let position = arguments.start_position;
        if !position.is_finite() {
            let message = "must be a finite number";
            return Err(Failure::input(format!("--start-position {}", Typed(position)), message));
        }
        let until = arguments.until;
        let scenario = Scenario { start_position: position, ..Scenario::new(model.clone(), until) };
        within_range(&arguments.model, &scenario)?;
        let start = scenario.start_time();
        if !(until.is_finite() && until > start) {
            let message =
                format!("the samples start at t = {}: it must be after that", Typed(start));
            return Err(Failure::input(format!("--until {}", Typed(until)), message));
        }
        // A pulse before the samples is felt in them.
        warn_of_idle_pulses(&arguments.pulse, &pulses, (f64::NEG_INFINITY, until));
        let times = times(&arguments.sampling, (start, until), "the response")?;
        let origin = pulses.iter().map(|p| p.time).fold(f64::NEG_INFINITY, f64::max);
        Ok(Self { model, pulses, times, origin })
    }

    /// Modes with residues that refer to the origin: e^{-λT} of a late pulse overflows.
    fn response(&self, modes: usize) -> Result<Response, Failure> {
        let shifted: Vec<Pulse> =
            self.pulses.iter().map(|p| Pulse { time: p.time - self.origin, ..*p }).collect();
        respond(&self.model, &shifted, modes).map_err(|error| {
            let advice = "ask for another number with {modes}";
            failed(&error, advice).into()
        })
    }

    /// When the modes beyond those of `listed` have faded against the leading one.
    fn valid_from(&self, listed: &Response) -> Result<f64, Failure> {
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
}

fn document(arguments: &ResponseArguments, asked: &Asked) -> Result<ResponseDocument, Failure> {
    let model = &asked.model;
    let response = asked.response(arguments.modes)?;
    let mut said = remarks(&response.spectrum, Some(arguments.modes), "modes");
    if matches!(model.tip(), TipFunction::Bessel) {
        let message = "modes: the branch points ±ir of J0 add a term that falls like t^(-3/2), \
                       which is left out here and in valid_from";
        said.push(message.into());
    }
    let valid_from = asked.valid_from(&response)?;
    let samples = samples(asked, &response, valid_from);
    said.extend(beyond_linear(asked, &response, &samples));
    let parameters = ResponseParameters {
        model: ModelParameters::of(model, arguments.model.alpha_above),
        pulses: asked.pulses.iter().copied().map(Into::into).collect(),
        modes: arguments.modes,
        start_position: arguments.start_position,
        until: arguments.until,
    };
    let found = ResponseFound {
        steady_state: model.into(),
        modes: response.modes.iter().map(mode).collect::<Result<_, _>>()?,
        origin: asked.origin,
        valid_from,
        valid_to: VALID_TO,
        certificate: (&response.spectrum.certificate).into(),
        samples,
    };
    Ok(Document::new(parameters, found, said))
}

fn mode(mode: &ResponseMode) -> Result<ModeDocument, Failure> {
    let ResponseMode { lambda, residue } = mode;
    if !(residue.re.is_finite() && residue.im.is_finite()) {
        let message = "a mode grows beyond all numbers between the first pulse and the last, or \
                       within a pulse: bring the pulses nearer to each other, or make them shorter";
        return Err(Failure::input("--pulse", message));
    }
    Ok(ModeDocument {
        lambda: ComplexDocument::new(lambda.re, lambda.im),
        residue: ComplexDocument::new(residue.re, residue.im),
    })
}

/// From `valid_from` on the sum over modes, and before that the inverse transform: for J0, to whose modes something
/// is missing at any time, throughout.
fn samples(asked: &Asked, response: &Response, valid_from: f64) -> ResponseSamples {
    let l0 = asked.model.steady_l();
    let finite = |value: f64| value.is_finite().then_some(value);
    let until = if matches!(asked.model.tip(), TipFunction::Bessel) {
        asked.times.iter().copied().fold(valid_from, f64::max)
    } else {
        valid_from
    };
    let early = response.while_pulses_last(&asked.model, until - asked.origin);
    let at = |t: f64| match &early {
        Some(early) if t < until => early.at(t - asked.origin),
        _ => response.at(t - asked.origin),
    };
    let deviation: Vec<Option<f64>> = asked.times.iter().map(|t| finite(at(*t))).collect();
    ResponseSamples {
        t: asked.times.clone(),
        l: deviation.iter().map(|d| d.and_then(|d| finite(l0 + d))).collect(),
        deviation,
    }
}

/// Deviations above this part of the tip's width are no longer small.
const SMALL: f64 = 0.01;

/// Where linear theory is not what the tip does.
fn beyond_linear(asked: &Asked, response: &Response, samples: &ResponseSamples) -> Vec<String> {
    let largest = samples.deviation.iter().flatten().fold(0.0, |most: f64, d| most.max(d.abs()));
    let widths = largest / asked.model.tip().widths(1.0);
    let strong = (widths > SMALL).then(|| {
        format!(
            "samples: l leaves l0 by up to {widths:.1e} widths of the tip; linear theory is off by about that part \
             of itself: make the pulses weaker, or integrate with `stickslip run --pulse A,T,W`"
        )
    });
    let grows = response.modes.first().filter(|mode| mode.lambda.re > 0.0).map(|mode| {
        format!(
            "samples: steady motion is unstable here (α is above αc): the response grows at the rate {:.3} and holds \
             only as long as it is small",
            mode.lambda.re
        )
    });
    strong.into_iter().chain(grows).collect()
}
