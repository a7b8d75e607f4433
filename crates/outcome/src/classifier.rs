//! What the outcome is read from, gathered as a run goes on: of bounded size, however long the run.

use super::thinned::Thinned;
use crate::creep;
use crate::{Outcome, Regime};
use std::collections::VecDeque;
use stickslip_tip::motion::Extrema;
use stickslip_tip::motion::Oscillation;
use stickslip_tip::state::{Damaged, Reader, State};
use stickslip_tip::{Model, Step, Trajectory};

/// The last fifth of a run must be steady for the run to count as steady.
const STEADY_SHARE: f64 = 0.2;
/// l within this distance of l0, or a hundred tolerances, is steady.
const STEADY_WITHIN: f64 = 1e-6;
/// Steps kept at the end at most; a slip takes some fifty of them, on noise of a fine grid a thousand.
const LONGEST_TAIL: usize = 1 << 15;

/// Watches the steps of a run go by.
#[derive(Debug, Clone)]
pub struct Classifier {
    r: f64,
    steady_l: f64,
    /// l at this distance of l0 is not steady.
    far: f64,
    /// Of tail behind the extrema, so that the ripple behind the tip has all that carved it.
    reaches: f64,
    /// Start of the run and the latest step, once there is one.
    span: Option<(f64, Step)>,
    /// Start of the latest step that was not steady.
    unsteady: f64,
    extrema: Extrema,
    /// Since the last extremum.
    risen: Thinned,
    tail: VecDeque<Step>,
}

impl Classifier {
    /// Before the first step.
    #[must_use]
    pub fn new(model: &Model, tolerance: f64) -> Self {
        Self {
            r: model.r(),
            steady_l: model.steady_l(),
            far: STEADY_WITHIN.max(100.0 * tolerance),
            reaches: 2.0 * model.tip().reach().unwrap_or(0.0),
            span: None,
            unsteady: f64::NEG_INFINITY,
            extrema: Extrema::default(),
            risen: Thinned::default(),
            tail: VecDeque::new(),
        }
    }

    /// Takes note of the next step.
    pub fn observe(&mut self, step: &Step) {
        let start = self.span.map_or(step.t, |(start, _)| start);
        self.span = Some((start, *step));
        let (l_at_start, middle) = (step.extension - self.r, step.t + 0.5 * step.h);
        if self.is_far(l_at_start) || self.is_far(step.l(self.r, middle)) {
            self.unsteady = step.t;
        }
        if self.extrema.observe(step, self.r) {
            self.risen.clear();
        }
        self.risen.observe(step);
        self.tail.push_back(*step);
        self.cut_tail();
    }

    fn is_far(&self, l: f64) -> bool {
        (l - self.steady_l).abs() > self.far
    }

    /// Drops steps that neither the extrema nor the ripple of their last period need.
    fn cut_tail(&mut self) {
        let start = |step: &Step| self.r * step.t - step.extension;
        while let Some(earliest) = self.extrema.earliest_needed() {
            // The first is not needed if the second begins far enough behind.
            let enough = start(&earliest.step) - self.reaches;
            let spare = |next: &Step| next.t <= earliest.step.t && start(next) <= enough;
            if !self.tail.get(1).is_some_and(spare) {
                break;
            }
            self.tail.pop_front();
        }
        if self.tail.len() > LONGEST_TAIL {
            self.tail.pop_front();
            self.extrema.forget_before(self.tail[0].t);
        }
    }

    /// Regime and oscillation, were the run to end with the last step.
    ///
    /// # Panics
    /// Before the first step.
    #[must_use]
    pub fn outcome(&self, model: &Model) -> Outcome {
        let (start, last) = self.span.expect("a run has at least one step");
        let regime = |regime| Outcome { regime, oscillation: None };
        let end = last.end();
        if !self.is_far(last.l(self.r, end)) && self.unsteady < end - STEADY_SHARE * (end - start) {
            return regime(Regime::Steady);
        }
        let extrema = self.extrema.latest_first(self.r);
        let since = extrema.first().map_or(start, |e| e.t.max(start));
        if creep::is_trapped(model, (start, since), &self.risen, &last) {
            return regime(Regime::Trapped);
        }
        let found = self.tail().and_then(|tail| Oscillation::of(&tail, &extrema));
        match found {
            None => regime(Regime::Transient),
            oscillation => Outcome { regime: Regime::StickSlip, oscillation },
        }
    }

    /// The latest step.
    #[must_use]
    pub fn last(&self) -> Option<Step> {
        self.span.map(|(_, last)| last)
    }

    /// The last steps; `None` before the first.
    #[must_use]
    pub fn tail(&self) -> Option<Trajectory> {
        let steps: Vec<Step> = self.tail.iter().copied().collect();
        (!steps.is_empty()).then(|| Trajectory::new(self.r, steps))
    }

    pub(crate) fn save(&self, state: &mut State) {
        state.flag(self.span.is_some());
        if let Some((start, last)) = &self.span {
            state.number(*start);
            state.step(last);
        }
        state.number(self.unsteady);
        self.extrema.save(state);
        self.risen.save(state);
        state.steps(self.tail.iter());
    }

    pub(crate) fn restore(&mut self, state: &mut Reader) -> Result<(), Damaged> {
        self.span = if state.flag()? { Some((state.finite()?, state.step()?)) } else { None };
        self.unsteady = state.number()?;
        self.extrema.restore(state)?;
        self.risen.restore(state)?;
        self.tail = state.steps()?.into();
        // The last step is the end of the tail.
        if self.tail.back() == self.last().as_ref() { Ok(()) } else { Err(Damaged::OutOfRange) }
    }
}
