//! Summaries of runs and walkers.

use super::{Summary, again, amplitude_of_u, digits};
use crate::commands::job::Product;
use crate::commands::verify::claims::described;
use crate::commands::verify::kept;
use stickslip::{
    CircleDocument, Difference, Hold, Law, Loop, ModelParameters, OrbitDocument,
    OscillationDocument, RegimeName, RunDocument, RunEnd, VerifyDocument, WalkerDocument,
    WalkerRegime, to_its_digits,
};

/// The summary of a run with the result `end`.
pub(in crate::commands) fn of_run(document: &RunDocument, end: &RunEnd) -> Summary {
    if document.parameters.stiffness_across.is_some() {
        return of_across(document);
    }
    let verified = document.verification.as_ref().map_or(String::new(), kept);
    let summary = Summary::new(summary(end) + &verified);
    let summary = summary.row("α, r", parameters(&document.parameters.model_parameters()));
    let summary = match &end.oscillation {
        Some(found) => oscillation(summary, found, &document.parameters.law),
        None => summary,
    };
    let worked = |loops: &Vec<Loop>| {
        loops.last().map(|l| format!("{} kσ², t = {} to {}", digits(l.work, 7), l.from, l.to))
    };
    let summary = summary.maybe("work of a loop", document.loops.as_ref().and_then(worked));
    let peak = |holds: &Vec<Hold>| holds.last().map(peak_after);
    let summary = summary.maybe("peak after the hold", document.holds.as_ref().and_then(peak));
    let velocity = end.drifting.as_ref().map(|d| to_its_digits(d.velocity, d.velocity_error));
    let (creep, steady) = (end.creep.as_ref(), document.steady_state.as_ref());
    let summary = summary
        .maybe("velocity", velocity.map(|v| format!("{v} kσ/Γ")))
        .maybe("creep", creep.map(|c| format!("x0 ~ ln t / {}", digits(c.attracting, 7))))
        .maybe("l of steady motion", steady.map(|s| format!("{} σ", digits(s.l, 7))))
        .remarks(&end.remarks);
    // On a path there is nothing to wait for.
    if end.regime != RegimeName::Transient || document.parameters.support_path.is_some() {
        return summary.next(again("-o run.json --plot run.svg"));
    }
    let longer = end.transient.as_ref().and_then(|transient| transient.time);
    let longer = longer.map_or(3.0 * end.end.abs(), |time| 1.5 * time);
    summary.next(again(&format!("--until {}", digits(end.end + longer, 2))))
}

fn peak_after(hold: &Hold) -> String {
    let rest = format!("hold from t = {} to {}", hold.from, hold.to);
    match &hold.peak {
        Some(peak) => format!("{} kσ at t = {}, {rest}", digits(peak.lag, 7), digits(peak.t, 7)),
        None => format!("not reached: the lateral force still rises at the end, {rest}"),
    }
}

/// The summary of a run in two coordinates.
fn of_across(document: &RunDocument) -> Summary {
    let work = &document.work;
    let swing = document.snaking.as_ref();
    let motion = document.oscillation.as_ref();
    let period = swing.map(|s| (s.period, s.period_error));
    let period = period.or(motion.map(|o| (o.period, o.period_error.unwrap_or(0.0))));
    let period = period.map(|(period, error)| to_its_digits(period, error));
    let end = document.samples.t.last().copied().unwrap_or_default();
    let verified = document.verification.as_ref().map_or(String::new(), kept);
    let headline = format!(
        "{}{}: t = {} reached in {} steps with {}, {:.1} ms{verified}",
        document.regime,
        period.as_ref().map_or(String::new(), |period| format!(", period {period}")),
        digits(end, 10),
        work.steps,
        work.memory,
        1e3 * work.seconds
    );
    let held =
        |value: f64, error: f64, unit: &str| format!("{} {unit}", to_its_digits(value, error));
    let stiffness = document.parameters.stiffness_across.unwrap_or_default();
    let summary = Summary::new(headline)
        .row("α, r", parameters(&document.parameters.model_parameters()))
        .row("stiffness across", digits(stiffness, 10));
    let summary = match motion {
        Some(found) => oscillation(summary, found, &document.parameters.law),
        None => summary,
    };
    summary
        .maybe("period", swing.map(|s| held(s.period, s.period_error, "Γ/k")))
        .maybe("wavelength", swing.map(|s| held(s.wavelength, s.wavelength_error, "σ")))
        .maybe("amplitude of y0", swing.map(|s| held(s.amplitude_y0, s.amplitude_y0_error, "σ")))
        .maybe(
            "amplitude of x0",
            swing.map(|s| held(s.amplitude_x0, s.amplitude_x0_error.unwrap_or_default(), "σ")),
        )
        .remarks(&document.remarks)
        .next(again("-o run.json --plot run.svg"))
}

/// The summary of a run written as lines.
pub(in crate::commands) fn of_lines(end: &RunEnd) -> Summary {
    Summary::new(summary(end)).remarks(&end.remarks)
}

fn parameters(model: &ModelParameters) -> String {
    format!("{}, {}", digits(model.alpha, 10), digits(model.r, 10))
}

fn oscillation(summary: Summary, found: &OscillationDocument, law: &Law) -> Summary {
    let held = |value: f64, error: Option<f64>, unit: &str| {
        format!("{} {unit}", to_its_digits(value, error.unwrap_or(0.0)))
    };
    summary
        .row("period", held(found.period, found.period_error, "Γ/k"))
        .row("wavelength", held(found.wavelength, found.wavelength_error, "σ"))
        .row("amplitude of x0", held(found.amplitude_x0, found.amplitude_x0_error, "σ"))
        .maybe(
            amplitude_of_u(law),
            found.amplitude_u.map(|u| held(u, found.amplitude_u_error, "kσ²/a")),
        )
        .row("slips in a period", found.slips.to_string())
}

/// The one-line summary of a run that was written to a file.
fn summary(end: &RunEnd) -> String {
    let work = &end.work;
    let digits = |value: f64, error: Option<f64>| to_its_digits(value, error.unwrap_or(0.0));
    let motion = end.oscillation.as_ref().map(|o| {
        let period = digits(o.period, o.period_error);
        let amplitude = digits(o.amplitude_x0, o.amplitude_x0_error);
        format!(", period {period}, amplitude of x0 {amplitude}")
    });
    let drift = end.drifting.as_ref();
    let drift = drift.map(|d| format!(", velocity {}", digits(d.velocity, Some(d.velocity_error))));
    let prospect = end.transient.as_ref().and_then(|transient| {
        let time = transient.time.map_or(String::new(), |time| format!(" in about {time:.1e}"));
        transient.towards.map(|towards| format!(", towards {towards}{time}"))
    });
    format!(
        "{}{}: t = {} reached in {} steps with {}, {:.1} ms",
        end.regime,
        motion.or(drift).or(prospect).unwrap_or_default(),
        end.end,
        work.steps,
        work.memory,
        1e3 * work.seconds
    )
}

impl Product for VerifyDocument {
    fn summary(&self) -> Summary {
        let found = &self.verification;
        let l = &found.l;
        let verdict = if found.kept { "kept" } else { "not kept" };
        let summary = Summary::new(format!(
            "the tolerance of {:e} is {verdict}: l is off by {:.1e} at most, {:.1e} is allowed; repeated with {} at {:.0e}",
            self.parameters.tolerance, l.largest, l.allowed, found.memory, found.tolerance
        ));
        let off = self.differences.iter();
        let summary =
            off.fold(summary, |summary, off| summary.row("does not follow", described(off)));
        summary
            .row("l", difference(l, "t"))
            .maybe("y0", found.y0.as_ref().map(|y0| difference(y0, "t")))
            .maybe("u", found.u.as_ref().map(|u| difference(u, "x")))
            .maybe("trusted until", found.trusted_until.map(|t| format!("t = {}", digits(t, 10))))
            .row("errors amplified", format!("{:.1e} times", found.amplification))
            .maybe(
                "Lyapunov exponent",
                found.lyapunov_exponent.map(|exponent| format!("{} k/Γ", digits(exponent, 3))),
            )
            .maybe("samples", self.lines.as_ref().map(|lines| lines.samples.to_string()))
    }
}

fn difference(found: &Difference, at: &str) -> String {
    let Difference { largest, at: place, allowed } = found;
    format!("{largest:.1e} at {at} = {}, {allowed:.1e} allowed", digits(*place, 7))
}

/// Number of significant digits of a speed or radius.
const DIGITS: usize = 10;
/// Largest number of orbits in a summary.
const ORBITS: usize = 12;

impl Product for WalkerDocument {
    fn summary(&self) -> Summary {
        let motion = match (self.regime, &self.circle) {
            (WalkerRegime::Circling, Some(circle)) => {
                format!("circling, radius {}", digits(circle.radius, DIGITS))
            }
            (WalkerRegime::Resting, _) => "resting".into(),
            (WalkerRegime::Straight, _) => {
                format!("walking straight on, speed {}", digits(self.speed, DIGITS))
            }
            _ => "irregular".into(),
        };
        let end = self.samples.t.last().copied().unwrap_or_default();
        let work = &self.work;
        let headline = format!(
            "{motion}: t = {} reached in {} steps with {} directions, {:.1} ms",
            digits(end, DIGITS),
            work.steps,
            work.directions,
            1e3 * work.seconds
        );
        let speed = |speed: f64| format!("{} kσ/Γ", digits(speed, DIGITS));
        let circle = self.circle.as_ref();
        let omega = |circle: &CircleDocument| format!("{} k/Γ", digits(circle.omega, DIGITS));
        let summary = Summary::new(headline)
            .row("speed of a free walker", speed(self.free_speed))
            .row("speed", speed(self.speed))
            .maybe("angular frequency", circle.map(omega))
            .maybe("distance from the circle", circle.map(|c| format!("{:.1e} σ", c.deviation)));
        let orbits = self.orbits.iter().flatten().take(ORBITS);
        orbits
            .fold(summary, tell)
            .remarks(&self.remarks)
            .next(again("-o walker.json --plot walker.svg"))
    }
}

fn tell(summary: Summary, orbit: &OrbitDocument) -> Summary {
    let state = match orbit.stable {
        Some(true) => ", stable",
        Some(false) => ", unstable",
        None => "",
    };
    let radius = digits(orbit.radius, DIGITS);
    summary.row(
        "circular orbit",
        format!("radius {radius} σ, ω = {} k/Γ{state}", digits(orbit.omega, DIGITS)),
    )
}
