//! Data from which a run is classified, collected during the run; their size is bounded for runs of any length.

use crate::tail::{Motion, Tail};
use crate::thinned::Thinned;
use stickslip_tip::motion::{Extrema, Extremum};
use stickslip_tip::state::{Damaged, Reader, State};
use stickslip_tip::{Scenario, Step, Support, Trajectory, Wider};

/// Largest distance of l from l0 in steady motion, in σ, for small tolerances.
const STEADY_WITHIN: f64 = 1e-6;
/// Largest distance of l from l0 in steady motion, in units of the tolerance, for larger tolerances.
const STEADY_TOLERANCES: f64 = 100.0;
/// Upper limit of the distance for larger tolerances, in widths of the tip.
const STEADY_AT_MOST: f64 = 0.03;
/// Largest number of steps kept at the end. A slip takes some fifty; on noise of a fine grid a thousand.
const LONGEST_TAIL: usize = 1 << 15;

/// Collects the extrema and the last steps of a run.
#[derive(Debug, Clone)]
pub struct Observer {
    r: f64,
    support: Support,
    wider: Wider,
    steady_l: f64,
    /// Distance of l from l0 beyond which the motion is not steady.
    far: f64,
    /// Length of history kept behind the extrema, so that all contributions to the ripple behind the tip are
    /// available; 0 for a footprint without a reach.
    reaches: f64,
    /// Start time of the run; `None` before the first step.
    start: Option<f64>,
    /// Start of the latest step that was not steady.
    unsteady: f64,
    extrema: Extrema,
    /// Steps since the last extremum, of a footprint without a reach: only its creep is measured on them.
    risen: Thinned,
    tail: Tail,
}

impl Observer {
    /// An observer before the first step.
    pub fn new(scenario: &Scenario) -> Self {
        let Scenario { model, tolerance, .. } = scenario;
        let most = model.tip().widths(STEADY_AT_MOST);
        Self {
            r: model.r(),
            support: scenario.support(),
            wider: *model.wider(),
            steady_l: model.steady_l(),
            far: STEADY_WITHIN.max((STEADY_TOLERANCES * tolerance).min(most)),
            reaches: 2.0 * model.tip().reach().unwrap_or(0.0),
            start: None,
            unsteady: f64::NEG_INFINITY,
            extrema: Extrema::default(),
            risen: Thinned::default(),
            tail: Tail::default(),
        }
    }

    /// Adds the next step.
    pub fn observe(&mut self, step: &Step) {
        self.start.get_or_insert(step.t);
        let (l_at_start, middle) = (step.extension - self.r, step.t + 0.5 * step.h);
        if self.is_far(l_at_start) || self.is_far(step.l(self.r, middle)) {
            self.unsteady = step.t;
        }
        if self.extrema.observe(step, self.r) {
            self.risen.clear();
        }
        if self.reaches <= 0.0 {
            self.risen.observe(step);
        }
        self.tail.push(step);
        self.cut_tail();
    }

    fn is_far(&self, l: f64) -> bool {
        (l - self.steady_l).abs() > self.far
    }

    /// Removes steps that neither the extrema nor the ripple of their last period need.
    fn cut_tail(&mut self) {
        let position = |t: f64, extension: f64| self.r * t - extension;
        if let Some(earliest) = self.extrema.earliest_needed() {
            // The first is not needed if the second begins far enough behind.
            let Step { t, extension, .. } = earliest.step;
            let enough = position(t, extension) - self.reaches;
            let spare = |next: &Motion| next.t <= t && position(next.t, next.extension) <= enough;
            while self.tail.motion(1).is_some_and(spare) {
                self.tail.pop();
            }
        }
        if self.tail.len() > LONGEST_TAIL {
            self.tail.pop();
            self.tail.motion(0).iter().for_each(|first| self.extrema.forget_before(first.t));
        }
    }

    pub(crate) fn start(&self) -> Option<f64> {
        self.start
    }

    /// Distance of l from l0 within which the motion counts as steady.
    pub(crate) fn near_steady(&self) -> f64 {
        self.far
    }

    /// Time since which l has been within [`near_steady`](Self::near_steady) of l0.
    pub(crate) fn steady_since(&self) -> f64 {
        self.unsteady
    }

    /// The latest extrema of l, latest first.
    pub(crate) fn extrema(&self) -> Vec<Extremum> {
        self.extrema.latest_first(self.r)
    }

    /// Steps since the last extremum, of a footprint without a reach.
    pub(crate) fn risen(&self) -> &Thinned {
        &self.risen
    }

    /// The latest step.
    pub fn last(&self) -> Option<Step> {
        self.tail.last()
    }

    /// The last steps; `None` before the first.
    pub fn tail(&self) -> Option<Trajectory> {
        let steps = self.tail.steps();
        (!steps.is_empty()).then(|| Trajectory::under(self.wider, self.support.clone(), steps))
    }

    /// Time reached; `None` before the first step.
    pub fn t(&self) -> Option<f64> {
        self.last().map(|last| last.end())
    }

    pub(crate) fn save(&self, state: &mut State) {
        state.flag(self.start.is_some());
        if let (Some(start), Some(last)) = (self.start, self.last()) {
            state.number(start);
            state.step(&last);
        }
        state.number(self.unsteady);
        self.extrema.save(state);
        self.risen.save(state);
        state.steps(self.tail.steps().iter());
    }

    pub(crate) fn restore(&mut self, state: &mut Reader) -> Result<(), Damaged> {
        let span = if state.flag()? { Some((state.finite()?, state.step()?)) } else { None };
        self.unsteady = state.number()?;
        self.extrema.restore(state)?;
        self.risen.restore(state)?;
        self.tail = Tail::of(&state.steps()?).ok_or(Damaged::OutOfRange)?;
        self.start = span.map(|(start, _)| start);
        // The last step is the end of the tail.
        let last = span.map(|(_, last)| last);
        if self.last() == last { Ok(()) } else { Err(Damaged::OutOfRange) }
    }
}

impl Extend<Step> for Observer {
    fn extend<I: IntoIterator<Item = Step>>(&mut self, steps: I) {
        steps.into_iter().for_each(|step| self.observe(&step));
    }
}
