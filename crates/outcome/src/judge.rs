//! Classification of a run: the regime that it has reached, or that it approaches.

use crate::creep::{Fate, Stuck, measured};
use crate::linear::{Linear, Slowest};
use crate::reference::Reference;
use crate::sequence::Sequence;
use crate::{Creeping, Observer, Oscillation, Outcome, Prospect, Regime, Remark};
use std::cell::OnceCell;
use stickslip_cycles::{Cycle, DEFAULT_TOLERANCE, small_cycle};
use stickslip_stability::{Criticality, creep, onset};
use stickslip_tip::motion::{self, Extremum};
use stickslip_tip::{InitialSurface, Scenario, Start, Step, Support, Trajectory, stop};

mod extrapolated;
mod free;
mod remarks;
mod steady;

/// A run is steady if this last fraction of it is close to steady motion.
const STEADY_SHARE: f64 = 0.2;
/// Oscillations that grow by less than this factor over several periods count as not growing.
const NOT_GROWN: f64 = 1.05;
/// A motion is periodic if its amplitude and period are within this relative distance of their limits.
const SETTLED: f64 = 1e-3;
/// Relative distance from a cycle, in amplitudes, beyond which its multipliers do not predict the motion.
const BESIDE: f64 = 0.3;
/// A motion counts as not approaching its cycle if it approaches by less than this fraction of what the multiplier
/// predicts.
const STANDS_STILL: f64 = 0.2;
/// Displacement of a cycle that the tolerance may cause, times 1 - |μ| of the multiplier μ, in units of the tolerance.
const DISPLACED: f64 = 300.0;
/// Oscillations below this amplitude, in widths, are compared with linear theory.
const SMALL: f64 = 0.3;
/// Small oscillations follow linear theory if they grow or decay at its rate within this fraction.
const AS_FORETOLD: f64 = 0.2;
/// Changes from period to period below this many tolerances are attributed to step errors.
const NOISE: f64 = 30.0;
/// Residual of the small cycle for a prediction of the time until a motion reaches it.
const ROUGH: f64 = 1e-5;
/// A deviation of l below this, in σ, is round-off.
const ROUND_OFF: f64 = 1e-12;
/// Multipliers closer to the unit circle than this cannot be distinguished from it.
const ON_THE_CIRCLE: f64 = 1e-7;

/// Classifies the motion at the end of a run.
///
/// # Panics
/// Before the first step.
pub fn judge(scenario: &Scenario, surface: &InitialSurface, observer: &Observer) -> Outcome {
    let last = observer.last().expect("a run has at least one step");
    let tail = observer.tail().expect("a run has at least one step");
    let extrema = observer.extrema();
    let linear = OnceCell::new();
    let end = End { scenario, surface, observer, last, tail, extrema, linear };
    let mut outcome = end.outcome();
    outcome.remarks.extend(end.remarks(outcome.regime));
    outcome
}

struct End<'a> {
    scenario: &'a Scenario,
    surface: &'a InitialSurface,
    observer: &'a Observer,
    last: Step,
    tail: Trajectory,
    /// Extrema of l, latest first.
    extrema: Vec<Extremum>,
    linear: OnceCell<Linear>,
}

impl Outcome {
    fn settled(regime: Regime) -> Self {
        Self {
            regime,
            oscillation: None,
            creep: None,
            drifting: None,
            prospect: None,
            remarks: vec![],
        }
    }

    fn trapped(creep: Creeping) -> Self {
        Self { creep: Some(creep), ..Self::settled(Regime::Trapped) }
    }

    fn transient(towards: Option<Regime>, time: Option<f64>) -> Self {
        let prospect = Prospect { towards, time: time.filter(|time| time.is_finite()) };
        Self { prospect: Some(prospect), ..Self::settled(Regime::Transient) }
    }

    fn remarked(mut self, remark: Remark) -> Self {
        self.remarks.push(remark);
        self
    }
}

impl End<'_> {
    fn outcome(&self) -> Outcome {
        match self.scenario.support() {
            Support::Moving(_) => {}
            Support::Path(_) => {
                return Outcome::transient(None, None).remarked(Remark::OnAPath);
            }
            Support::None => return self.without_spring(),
        }
        if self.force_acts() {
            return Outcome::transient(None, None).remarked(Remark::ForceActs);
        }
        if self.is_steady() {
            return Outcome::settled(Regime::Steady);
        }
        if let Some(outcome) = self.stuck() {
            return outcome;
        }
        self.oscillates().unwrap_or_else(|| self.beside_steady())
    }

    /// Whether a force above a hundredth of the tolerance acts in the last fifth of the run.
    fn force_acts(&self) -> bool {
        let (force, end) = (&self.scenario.force, self.last.end());
        let from = end - STEADY_SHARE * (end - self.start());
        if force.ends() < from {
            return false;
        }
        let at = |i: u32| from + (end - from) * f64::from(i) / 1000.0;
        (0..=1000).any(|i| force.value(at(i)).abs() > 0.01 * self.scenario.tolerance)
    }

    fn start(&self) -> f64 {
        self.observer.start().unwrap_or(self.last.t)
    }

    /// Distance of l from l0 at the end, or in the latest oscillation if that is larger.
    fn deviation(&self) -> f64 {
        let steady = self.scenario.model.steady_l();
        let end = self.last.end();
        let now = (self.last.l(self.tail.r(), end) - steady).abs();
        // An extremum long ago says nothing of now.
        let [latest, before, ..] = self.extrema[..] else { return now };
        let recent = end - latest.t < 2.0 * (latest.t - before.t);
        let swings = [latest, before].into_iter().filter(|_| recent);
        swings.map(|e| (e.l - steady).abs()).fold(now, f64::max)
    }

    /// Whether oscillations above the tolerance grow.
    fn grows(&self) -> bool {
        let Some((swing, rate)) = Sequence(&self.extrema).swing() else { return false };
        let span = self.extrema.iter().take(12).map(|e| e.t);
        let lasted = span.clone().fold(0.0, f64::max) - span.fold(f64::INFINITY, f64::min);
        swing > self.scenario.tolerance && (rate * lasted).exp() > NOT_GROWN
    }

    /// Classifies a tip that hardly moves: trapped, or the time until it slips.
    fn stuck(&self) -> Option<Outcome> {
        let Scenario { model, tolerance, .. } = self.scenario;
        // Under a depth limit, or where the surface heals, no tip is trapped.
        if !model.wider().traps() {
            return None;
        }
        if model.tip().reach().is_none() {
            let since = self.extrema.first().map_or(self.start(), |e| e.t.max(self.start()));
            let risen = self.observer.risen();
            let creep = measured(model, (self.start(), since), risen, &self.last)?;
            return Some(Outcome::trapped(creep));
        }
        let (surface, tail) = (self.surface, &self.tail);
        let stuck = Stuck { model, surface, tail, tolerance: *tolerance };
        let remark = match stuck.fate()? {
            Fate::Held(creep) => return Some(Outcome::trapped(creep)),
            Fate::Slips(time) => Remark::SlipsAfter { time },
            Fate::Open => Remark::AtTheBorder,
        };
        // Within an oscillation that repeats itself every slip is foretold.
        let oscillates = self.oscillates().filter(|o| o.regime == Regime::StickSlip);
        Some(oscillates.unwrap_or_else(|| Outcome::transient(None, None).remarked(remark)))
    }

    /// Classifies an oscillation on or close to a cycle, or one that repeats itself.
    fn oscillates(&self) -> Option<Outcome> {
        let sequence = Sequence(&self.extrema);
        let (swing, _) = sequence.swing()?;
        if swing <= self.scenario.tolerance && !matches!(self.linear(), Linear::Unstable(_)) {
            return None;
        }
        if self.is_linear() {
            return None;
        }
        let Scenario { model, tolerance, .. } = self.scenario;
        let (mut unstable, mut missed): (Option<Reference>, Option<usize>) = (None, None);
        for slips in sequence.likely_slips(SETTLED * swing) {
            // A motion that repeats itself is on a cycle, and worth another try.
            let repeats = sequence.change(slips, 0).is_some_and(|change| change <= SETTLED * swing);
            let tries = if repeats { 2 } else { 1 };
            let (tail, extrema) = (&self.tail, &self.extrema);
            if stop::is_requested() {
                break;
            }
            let found = Reference::of(model, *tolerance, tail, extrema, slips, tries);
            let Some(found) = found else {
                missed.get_or_insert(slips);
                continue;
            };
            if found.distance() >= BESIDE {
                continue;
            }
            if found.gap() <= ON_THE_CIRCLE {
                unstable.get_or_insert(found);
            } else if found.distance() > SETTLED && missed.is_some() {
                // The motion may stay where another cycle was missed.
                let repeats = missed.and_then(|m| self.extrapolated(&sequence, m, Some(&found)));
                return Some(repeats.unwrap_or_else(|| self.beside_stable(found)));
            } else {
                return Some(self.beside_stable(found));
            }
        }
        // A cycle may be there that Newton's method did not reach.
        let repeats =
            missed.and_then(|slips| self.extrapolated(&sequence, slips, unstable.as_ref()));
        repeats.or_else(|| unstable.map(|unstable| self.beside_unstable(&unstable)))
    }

    /// Whether small oscillations about l0 grow or decay as linear theory predicts: then no cycle is close.
    fn is_linear(&self) -> bool {
        let Some((swing, rate)) = Sequence(&self.extrema).swing() else { return false };
        let agrees = |expected: f64| (rate / expected - 1.0).abs() < AS_FORETOLD;
        swing < self.small()
            && match self.linear() {
                Linear::Stable(slowest) => agrees(-slowest.rate),
                Linear::Unstable(slowest) => agrees(slowest.rate),
                Linear::Unknown => false,
            }
    }

    fn small(&self) -> f64 {
        self.scenario.model.tip().widths(SMALL)
    }

    /// Classifies a motion close to a stable cycle: on the cycle, as close as the tolerance permits, or approaching
    /// it.
    fn beside_stable(&self, near: Reference) -> Outcome {
        if near.distance() <= SETTLED {
            return Outcome {
                oscillation: Some(Oscillation::on(near)),
                ..Outcome::settled(Regime::StickSlip)
            };
        }
        let tolerance = self.scenario.tolerance;
        let slips = near.cycle.slips();
        let sequence = Sequence(&self.extrema);
        let change = (0..3).filter_map(|back| sequence.change(slips, back)).fold(0.0, f64::max);
        let foretold = near.gap() * near.off;
        let displaced = near.off < DISPLACED * tolerance / near.gap();
        let settled = SETTLED * near.cycle.amplitude_x0();
        let still = change < STANDS_STILL * foretold && change < settled;
        // It would be there within a period, were it not for the errors of its steps.
        let kept_away = near.periods_until(SETTLED) < 1.0 && change < NOISE * tolerance;
        if (still || kept_away) && displaced {
            let off = near.off;
            let oscillation = Some(Oscillation::on(near));
            let outcome = Outcome { oscillation, ..Outcome::settled(Regime::StickSlip) };
            return outcome.remarked(Remark::Coarse { off });
        }
        let time = near.periods_until(SETTLED) * near.cycle.period();
        Outcome::transient(Some(Regime::StickSlip), Some(time))
    }

    /// Classifies a motion close to an unstable cycle: inside the cycle it approaches steady motion; otherwise its
    /// limit cannot be predicted.
    fn beside_unstable(&self, near: &Reference) -> Outcome {
        let inside = near.measured.amplitude_x0 < near.cycle.amplitude_x0();
        let flips = near.cycle.nontrivial_multipliers().any(|m| m.re < -1.0);
        match self.linear() {
            Linear::Stable(_) if inside && !self.grows() => {
                Outcome::transient(Some(Regime::Steady), None)
            }
            // Beyond a period doubling, to a cycle of twice the slips, as a rule.
            _ if flips => Outcome::transient(Some(Regime::StickSlip), None),
            _ => Outcome::transient(None, None),
        }
    }

    /// Classifies a motion that is neither on a cycle nor stuck: it approaches steady motion or leaves it.
    fn beside_steady(&self) -> Outcome {
        let (deviation, near) = (self.deviation(), self.observer.near_steady());
        match self.linear() {
            Linear::Stable(_) if deviation <= near.min(self.small()) && !self.is_kept_steady() => {
                Outcome::transient(Some(Regime::Steady), None).remarked(Remark::TooCoarse)
            }
            Linear::Stable(Slowest { rate, .. }) if self.decays() => {
                let share = STEADY_SHARE / (1.0 - STEADY_SHARE) * (self.last.end() - self.start());
                let time = ((deviation / near).ln() / rate).max(0.0) + share;
                let time = self.is_kept_steady().then_some(time);
                Outcome::transient(Some(Regime::Steady), time)
            }
            Linear::Unstable(Slowest { rate, .. }) => self.leaves(deviation, rate),
            _ => Outcome::transient(None, None),
        }
    }

    fn decays(&self) -> bool {
        let Some((swing, rate)) = Sequence(&self.extrema).swing() else { return true };
        swing <= self.scenario.tolerance || rate < 0.0
    }

    /// Prediction where steady motion is unstable: the small cycle that bifurcates at αc attracts, if it exists.
    fn leaves(&self, deviation: f64, rate: f64) -> Outcome {
        let model = &self.scenario.model;
        if stop::is_requested() {
            return Outcome::transient(None, None);
        }
        let stable = |residual| small_cycle(model, residual).ok()?.filter(Cycle::is_stable);
        let Some(small) = stable(ROUGH) else {
            return Outcome::transient(None, None);
        };
        // Newton's method may miss from the motion what it finds from onset.
        let near = |cycle: Cycle| {
            let near = Reference::beside(cycle, &self.tail, &self.extrema)?;
            (near.distance() < BESIDE && near.gap() > ON_THE_CIRCLE).then_some(near)
        };
        if near(small.clone()).is_some()
            && let Some(near) = stable(DEFAULT_TOLERANCE).and_then(near)
        {
            return self.beside_stable(near);
        }
        let amplitude = small.amplitude_x0();
        if deviation > (1.0 + BESIDE) * amplitude {
            return Outcome::transient(None, None);
        }
        let away = ((amplitude / deviation).powi(2) - 1.0).abs().max(2.0 * SETTLED);
        // What is there of round-off does not grow from where it is, but from where it last was made.
        let time = (deviation > ROUND_OFF).then(|| (0.5 * away / SETTLED).ln() / (2.0 * rate));
        Outcome::transient(Some(Regime::StickSlip), time)
    }
}
