//! Check of all values of a run except its motion: each value that follows from the parameters and the motion is
//! recomputed.
//!
//! Samples are evaluated from the dense history or, if none was kept, from a repetition of the run. The result of the run is
//! recomputed from a repetition in any case.

use super::motion::Motion;
use crate::commands::progress::Progress;
use crate::failure::Failure;
use crate::session::Session;
use serde::Serialize;
use serde_json::{Value, json};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use stickslip::{
    ClaimDocument, Indentation, ModelParameters, Moved, Moving, Physical, RegimeName, RunDocument,
    RunEnd, RunFound, RunHead, RunScenario, SampleLine, Sampling, SteadyState, Times,
};
use stickslip_outcome::{Watched, WatchedAcross};
use stickslip_tip::sorting::sort_by_number;
use stickslip_tip::{Scenario, Step, Support, Wider, stop};
use stickslip_verify::TOLERANCES_ALLOWED;

/// Largest relative difference of values of a polynomial whose coefficients were rounded when the document was
/// written.
const ROUNDINGS: f64 = 16.0 * f64::EPSILON;
/// Largest relative difference of a value between machines with different arithmetic.
const DIGITS: f64 = 1e-9;
/// Largest ratio between two error estimates in a document.
const ERRORS: f64 = 9.0;
/// Largest error of a slope within a step, in tolerances over the length of the step.
const SLOPES: f64 = 200.0;

/// The words of a warning without its numbers, whose last digits depend on the machine.
fn words(remark: &str) -> String {
    remark.chars().filter(|c| !(c.is_ascii_digit() || "+-.e".contains(*c))).collect()
}

/// Largest difference of a value between machines.
fn digits(_: &str, value: f64) -> f64 {
    DIGITS * (1.0 + value.abs())
}

/// A column of samples, with its recomputed values.
struct Column {
    field: &'static str,
    /// Difference over its limit.
    excess: f64,
    worst: Option<ClaimDocument>,
}

impl Column {
    fn new(field: &'static str) -> Self {
        Self { field, excess: 1.0, worst: None }
    }

    /// Compares a value; a missing value is not checked.
    fn see(&mut self, t: f64, claimed: Option<f64>, computed: Option<f64>, allowed: f64) {
        let Some(claimed) = claimed else { return };
        let excess =
            computed.map_or(f64::INFINITY, |computed| (claimed - computed).abs() / allowed);
        if excess <= 1.0 {
            return;
        }
        let count = self.worst.as_ref().map_or(0, |worst| worst.count) + 1;
        if self.worst.is_none() || excess > self.excess {
            self.excess = excess;
            self.worst = Some(ClaimDocument {
                field: self.field.into(),
                t: Some(t),
                claimed: json!(claimed),
                computed: json!(computed),
                allowed: Some(allowed),
                count,
            });
        }
        self.worst.iter_mut().for_each(|worst| worst.count = count);
    }
}

/// The columns of the samples of one run.
pub(super) struct Columns {
    support: Support,
    wider: Wider,
    tolerance: f64,
    columns: [Column; 8],
}

impl Columns {
    pub(super) fn of(scenario: &Scenario) -> Self {
        Self {
            support: scenario.support(),
            wider: *scenario.model.wider(),
            tolerance: scenario.tolerance,
            columns: [
                "samples.l",
                "samples.x0",
                "samples.lag",
                "samples.y0",
                "samples.velocity",
                "samples.height",
                "samples.weight",
                "samples.velocity_y",
            ]
            .map(Column::new),
        }
    }

    /// Compares a sample with the value of its step.
    fn of_history(&mut self, sample: &SampleLine, found: &SampleLine, step: &Step) {
        let rounding = ROUNDINGS * (1.0 + step.extension.abs() + sample.x0.abs());
        let [l, x0, lag, y0, ..] = &mut self.columns;
        let allowed = self.tolerance + rounding;
        l.see(sample.t, sample.l, found.l, allowed);
        x0.see(sample.t, Some(sample.x0), Some(found.x0), allowed);
        lag.see(sample.t, sample.lag, found.lag, allowed);
        y0.see(sample.t, sample.y0, found.y0, allowed);
        self.see(sample, found, (DIGITS + rounding / step.h, DIGITS));
    }

    /// Compares a sample with a repetition to the same tolerance. l, x0 and y0 are checked by the repetition to a tighter
    /// tolerance; the lag follows from x0.
    fn of_repetition(&mut self, sample: &SampleLine, found: &SampleLine, step: &Step) {
        let support = self.support.position(sample.t);
        let rounding = ROUNDINGS * (1.0 + support.abs() + sample.x0.abs());
        let lag = found.lag.map(|_| support - sample.x0);
        let [_, _, lags, ..] = &mut self.columns;
        lags.see(sample.t, sample.lag, lag, TOLERANCES_ALLOWED * self.tolerance + rounding);
        let off = SLOPES * self.tolerance;
        self.see(sample, found, (DIGITS + off / step.h, DIGITS + off));
    }

    /// Compares velocities and height with these limits plus a relative round-off; the limit of the weight follows from
    /// that of the height.
    fn see(&mut self, sample: &SampleLine, found: &SampleLine, (velocity, height): (f64, f64)) {
        let t = sample.t;
        let [.., velocities, heights, weights, across] = &mut self.columns;
        let largest = velocity + DIGITS * found.velocity_y.unwrap_or(0.0).abs();
        across.see(t, sample.velocity_y, found.velocity_y, largest);
        let allowed = velocity + DIGITS * found.velocity.abs();
        velocities.see(t, Some(sample.velocity), Some(found.velocity), allowed);
        let allowed = height + DIGITS * found.height.unwrap_or(0.0).abs();
        heights.see(t, sample.height, found.height, allowed);
        let limited = sample.height.filter(|_| found.height.is_some());
        weights.see(t, sample.weight, limited.map(|height| self.wider.weight(height)), DIGITS);
    }

    fn worst(self) -> impl Iterator<Item = ClaimDocument> {
        self.columns.into_iter().filter_map(|column| column.worst)
    }
}

/// The times of samples, compared with those that the parameters define.
struct SampleTimes {
    expected: Option<Times>,
    /// Number of samples so far.
    number: u64,
    column: Column,
}

impl SampleTimes {
    fn of(sampling: &Sampling, scenario: &Scenario) -> Self {
        let times = sampling.times((scenario.start_time(), scenario.until), "the run", false);
        let expected = times.ok().map(|times| times.in_order().0);
        Self { expected, number: 0, column: Column::new("samples.t") }
    }

    /// Compares the time of the next sample, of samples by ascending time.
    fn see(&mut self, t: f64) {
        if let Some(expected) = &self.expected {
            let allowed = ROUNDINGS * (1.0 + t.abs());
            self.column.see(t, Some(t), expected.at(self.number), allowed);
            self.number += 1;
        }
    }

    /// Adds the first time that differs, or a sample that is missing at the end of a whole run.
    fn end(self, is_whole: bool, claims: &mut Claims) {
        let missing = self.expected.filter(|_| is_whole).and_then(|times| times.at(self.number));
        match self.column.worst {
            Some(worst) => claims.0.push(worst),
            None => claims.judge_if("samples.t", None, missing.as_ref(), &|_, _| 0.0),
        }
    }
}

/// The values that differ from the recomputed ones.
#[derive(Default)]
pub(super) struct Claims(Vec<ClaimDocument>);

impl Claims {
    /// Compares a value with the recomputed one: numbers within their limit, all else exactly.
    fn judge(
        &mut self,
        field: &str,
        claimed: &Value,
        computed: &Value,
        allowed: &dyn Fn(&str, f64) -> f64,
    ) {
        match (claimed, computed) {
            (Value::Object(ours), Value::Object(theirs)) => {
                let names: std::collections::BTreeSet<&String> =
                    ours.keys().chain(theirs.keys()).collect();
                for name in names {
                    let inner = format!("{field}.{name}");
                    self.judge(&inner, &claimed[name], &computed[name], allowed);
                }
            }
            (Value::Array(ours), Value::Array(theirs)) if ours.len() == theirs.len() => {
                let before = self.0.len();
                for (ours, theirs) in ours.iter().zip(theirs) {
                    self.judge(field, ours, theirs, allowed);
                }
                // Of a list one entry stands for all.
                let count = self.0.len() - before;
                self.0.truncate(before + usize::from(count > 0));
                self.0[before..].iter_mut().for_each(|first| first.count = count as u64);
            }
            _ => {
                let numbers = claimed.as_f64().zip(computed.as_f64());
                let bound = numbers.map(|(_, computed)| allowed(field, computed));
                let follows = match (numbers, bound) {
                    (Some((claimed, computed)), Some(bound)) => (claimed - computed).abs() <= bound,
                    _ => claimed == computed,
                };
                if !follows {
                    self.0.push(ClaimDocument {
                        field: field.into(),
                        t: None,
                        claimed: claimed.clone(),
                        computed: computed.clone(),
                        allowed: bound,
                        count: 1,
                    });
                }
            }
        }
    }

    /// The same for an optional value; a missing one is not checked.
    fn judge_if<T: Serialize>(
        &mut self,
        field: &str,
        claimed: Option<&T>,
        computed: Option<&T>,
        allowed: &dyn Fn(&str, f64) -> f64,
    ) {
        if claimed.is_some() || computed.is_some() {
            self.judge(field, &json!(claimed), &json!(computed), allowed);
        }
    }

    /// Checks values that follow from the parameters alone.
    fn of_parameters(
        &mut self,
        parameters: &ModelParameters,
        scenario: &Scenario,
        steady: Option<&SteadyState>,
    ) {
        let computed = SteadyState::of(&scenario.model);
        self.judge_if("steady_state", steady, computed.as_ref(), &digits);
        let (law, tip) = (*scenario.model.wider(), scenario.model.tip());
        let above = parameters.alpha_above.filter(|_| law.spring);
        let resolved = |d| Indentation::above_critical(d).resolved(tip, law, parameters.r).ok();
        if let Some(Indentation { alpha: Some(alpha), .. }) = above.and_then(resolved) {
            let (claimed, computed) = (json!(parameters.alpha), json!(alpha));
            self.judge("parameters.alpha", &claimed, &computed, &digits);
        }
    }

    /// Checks the result of the run.
    fn of_end(&mut self, claimed: &RunEnd, computed: &RunEnd, tolerance: f64) {
        let names = (&claimed.work.memory, &computed.work.memory);
        self.judge("work.memory", &json!(names.0), &json!(names.1), &digits);
        // A run that was stopped may have had no time to judge its motion.
        if claimed.interrupted && claimed.regime == RegimeName::Transient {
            return;
        }
        self.judge("regime", &json!(claimed.regime), &json!(computed.regime), &digits);
        let oscillation = computed.oscillation.as_ref();
        let amplitude = oscillation.map_or(1.0, |o| o.amplitude_x0);
        let errors = json!(oscillation);
        let within = |field: &str, value: f64| {
            let name = field.trim_start_matches("oscillation.");
            match name {
                _ if name.ends_with("_error") => ERRORS * value.abs() + DIGITS,
                "slips" => 0.0,
                "drift" => DIGITS + 0.01 * value.abs() + SLOPES * tolerance / amplitude,
                _ => {
                    let error = errors[format!("{name}_error")].as_f64().unwrap_or(0.0);
                    2.0 * error + DIGITS * (1.0 + value.abs())
                }
            }
        };
        self.judge_if("oscillation", claimed.oscillation.as_ref(), oscillation, &within);
        let snaking = computed.snaking.as_ref();
        let errors = json!(snaking);
        let of_swing = |field: &str, value: f64| {
            let name = field.trim_start_matches("snaking.");
            match (name, errors[format!("{name}_error")].as_f64()) {
                _ if name.ends_with("_error") => ERRORS * value.abs() + DIGITS,
                (_, Some(error)) => 2.0 * error + DIGITS * (1.0 + value.abs()),
                _ => DIGITS + 0.01 * value.abs() + SLOPES * tolerance,
            }
        };
        self.judge_if("snaking", claimed.snaking.as_ref(), snaking, &of_swing);
        let creep = |field: &str, value: f64| match field {
            "creep.rate" => 1e-3 * value.abs(),
            _ => 1e-6 * value.abs(),
        };
        self.judge_if("creep", claimed.creep.as_ref(), computed.creep.as_ref(), &creep);
        let error = computed.drifting.as_ref().map_or(0.0, |drifting| drifting.velocity_error);
        let velocity = |field: &str, value: f64| match field {
            "drifting.velocity" => 2.0 * error,
            _ => ERRORS * value.abs() + DIGITS,
        };
        self.judge_if("drifting", claimed.drifting.as_ref(), computed.drifting.as_ref(), &velocity);
        // An extrapolation.
        let rough = |_: &str, value: f64| 1.0 + 0.1 * value.abs();
        self.judge_if("transient", claimed.transient.as_ref(), computed.transient.as_ref(), &rough);
        let (ours, theirs) = (&claimed.remarks, &computed.remarks);
        let in_words = |remarks: &[String]| remarks.iter().map(|r| words(r)).collect::<Vec<_>>();
        if in_words(ours) != in_words(theirs) {
            self.judge("remarks", &json!(ours.join("; ")), &json!(theirs.join("; ")), &digits);
        }
    }

    /// Checks values that follow from the history of a document, and their conversions to other units.
    fn of_document(&mut self, run: &RunDocument, motion: Option<&Motion>) {
        if let Some(motion) = motion {
            let steps = motion.count();
            self.judge("work.steps", &json!(run.work.steps), &json!(steps), &|_, _| 0.0);
            let (loops, holds) = match motion {
                Motion::Along(trajectory) => RunFound::of_path(trajectory),
                Motion::Across(_) => (None, None),
            };
            self.judge_if("loops", run.loops.as_ref(), loops.as_ref(), &digits);
            // Older documents have none.
            if run.holds.is_some() {
                self.judge_if("holds", run.holds.as_ref(), holds.as_ref(), &digits);
            }
            let (_, end) = motion.span();
            let ended = end < run.parameters.until * (1.0 - DIGITS);
            let ended = ended && run.parameters.until - end > DIGITS;
            self.judge("interrupted", &json!(run.interrupted), &json!(ended), &digits);
        }
        if let Some(physical) = &run.physical {
            let again = run.clone().in_units(Some(&physical.scales)).physical;
            let digits = |_: &str, value: f64| DIGITS * value.abs();
            self.judge_if("physical", Some(physical), again.as_ref(), &digits);
        }
    }
}

/// The result of a repetition of the run with its own options; `witness` is called with each step and the motion
/// within it.
fn again(
    session: &Session,
    scenario: &RunScenario,
    until: f64,
    witness: impl FnMut(&Step, &dyn Fn(f64) -> SampleLine),
) -> Result<RunEnd, Failure> {
    match scenario {
        RunScenario::Along(scenario) => {
            let surface = scenario.initial_surface().map_err(Failure::run)?;
            let running = Watched::new(scenario, &surface).map_err(Failure::run)?;
            repeated(session, scenario, until, running, witness)
        }
        RunScenario::Across(scenario) => {
            let running = WatchedAcross::new(scenario).map_err(Failure::run)?;
            repeated(session, &scenario.along, until, running, witness)
        }
    }
}

fn repeated<R: Moving>(
    session: &Session,
    scenario: &Scenario,
    until: f64,
    mut running: R,
    mut witness: impl FnMut(&Step, &dyn Fn(f64) -> SampleLine),
) -> Result<RunEnd, Failure> {
    let law = (&scenario.support(), scenario.model.wider());
    let mut progress = Progress::new(session, scenario.start_time(), until);
    let is_cut = until < scenario.until;
    while let Some(step) = running.step().map_err(Failure::run)? {
        let along = step.as_ref();
        witness(along, &|t| step.sample(law, t));
        progress.reached(along.end());
        if stop::is_requested() {
            return Err(Failure::Run("the verification was interrupted".into()));
        }
        if is_cut && along.end() >= until * (1.0 - ROUNDINGS) {
            break;
        }
    }
    // A run that ended early is judged as one that a signal ended.
    let flag = Arc::new(AtomicBool::new(is_cut && running.t() < scenario.until));
    Ok(stop::with_flag(&flag, || running.became(0.0))?)
}

/// Checks a document.
pub(super) fn of_document(
    session: &Session,
    run: &RunDocument,
    whole: &RunScenario,
    history: Option<&Motion>,
) -> Result<Vec<ClaimDocument>, Failure> {
    let scenario = whole.along();
    let mut claims = Claims::default();
    claims.of_parameters(&run.parameters.model_parameters(), scenario, run.steady_state.as_ref());
    claims.of_document(run, history);
    let mut columns = Columns::of(scenario);
    let mut samples: Vec<SampleLine> = run.samples.lines().collect();
    sort_by_number(&mut samples, |item| item.t);
    let mut times = SampleTimes::of(&run.parameters.sampling, scenario);
    samples.iter().for_each(|sample| times.see(sample.t));
    times.end(!run.interrupted, &mut claims);
    if let Some(motion) = history {
        let law = (&scenario.support(), scenario.model.wider());
        for sample in samples.drain(..) {
            let (step, found) = motion.at(law, sample.t);
            columns.of_history(&sample, &found, step);
        }
    }
    let last = samples.last().map(|sample| sample.t);
    let until = match history {
        Some(history) => history.span().1,
        None if run.interrupted => last.unwrap_or(scenario.until),
        None => scenario.until,
    };
    let mut due = samples.iter().peekable();
    let computed = again(session, whole, until, |step, found| {
        while let Some(sample) = due.next_if(|sample| sample.t <= step.end()) {
            columns.of_repetition(sample, &found(sample.t), step);
        }
    })?;
    claims.0.extend(columns.worst());
    // Of a run that was stopped, and of which no history says when, only the samples can be judged.
    if history.is_some() || !run.interrupted {
        let claimed = RunEnd { end: run.parameters.until, ..run.into() };
        claims.of_end(&claimed, &computed, scenario.tolerance);
    }
    Ok(claims.0)
}

/// Checks a run written as lines.
pub(super) fn of_lines(
    session: &Session,
    whole: &RunScenario,
    head: &RunHead,
    samples: impl Iterator<Item = SampleLine>,
    (until, end): (f64, Option<&RunEnd>),
) -> Result<Vec<ClaimDocument>, Failure> {
    let scenario = whole.along();
    let mut claims = Claims::default();
    let parameters = head.parameters.model_parameters();
    claims.of_parameters(&parameters, scenario, head.steady_state.as_ref());
    let mut columns = Columns::of(scenario);
    let mut times = SampleTimes::of(&head.parameters.sampling, scenario);
    let mut due = samples.inspect(|sample| times.see(sample.t)).peekable();
    let until = end.map_or(until, |end| end.end.min(scenario.until));
    let computed = again(session, whole, until, |step, found| {
        while let Some(sample) = due.next_if(|sample| sample.t <= step.end()) {
            columns.of_repetition(&sample, &found(sample.t), step);
        }
    })?;
    due.for_each(drop);
    times.end(end.is_some_and(|end| !end.interrupted), &mut claims);
    claims.0.extend(columns.worst());
    if let Some(end) = end {
        claims.of_end(end, &computed, scenario.tolerance);
        let is_cut = computed.end < scenario.until && scenario.until - computed.end > DIGITS;
        claims.judge("interrupted", &json!(end.interrupted), &json!(is_cut), &digits);
        if !end.interrupted {
            claims.judge("end", &json!(end.end), &json!(computed.end), &digits);
        }
    }
    Ok(claims.0)
}

/// A line for each value that differs, and a list of their names.
pub(super) fn report_differences(
    session: &Session,
    differences: &[ClaimDocument],
) -> Option<String> {
    let first = differences.first()?;
    let each = differences.iter().filter(|_| differences.len() > 1);
    each.for_each(|d| session.say(format_args!("stickslip: does not follow: {}", described(d))));
    let names: Vec<&str> = differences.iter().map(|d| &*d.field).collect();
    Some(match names.len() {
        1 => format!("a value does not follow from the run: {}", described(first)),
        count => format!("{count} values do not follow from the run: {}", names.join(", ")),
    })
}

/// A line such as `samples.lag at t = 20: 3.2, computed 2.1, 1e-9 allowed (2 entries are off)`.
pub(in crate::commands) fn described(difference: &ClaimDocument) -> String {
    let ClaimDocument { field, t, claimed, computed, allowed, count } = difference;
    let at = t.map_or(String::new(), |t| format!(" at t = {t}"));
    let allowed = allowed.map_or(String::new(), |allowed| format!(", {allowed:.1e} allowed"));
    let all = if *count > 1 { format!(" ({count} entries are off)") } else { String::new() };
    format!("{field}{at}: {claimed}, computed {computed}{allowed}{all}")
}
