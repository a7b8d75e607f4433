//! Maxima and minima of l(t), the latest of them.

use crate::collocation::{RADAU, apply};
use crate::roots::zero_between;
use crate::state::{Damaged, Reader, State};
use crate::{Step, Trajectory};
use std::collections::VecDeque;

/// A time and the value of l there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Extremum {
    pub(crate) t: f64,
    pub(crate) l: f64,
    pub(crate) is_maximum: bool,
    /// Start of the step that it lies in.
    pub(crate) step: f64,
}

/// The latest extrema of l, in order.
#[derive(Debug, Clone, Default)]
pub(crate) struct Extrema {
    latest: VecDeque<Extremum>,
}

/// So many are enough to compare three cycles of up to eight slips.
const MOST: usize = 64;

impl Extrema {
    pub(crate) fn at_the_end_of(trajectory: &Trajectory) -> Self {
        let mut extrema = Self::default();
        for step in trajectory.steps() {
            extrema.observe(step, trajectory.r());
        }
        extrema
    }

    /// Adds those of a step; says whether there were any.
    pub(crate) fn observe(&mut self, step: &Step, r: f64) -> bool {
        let before = self.latest.len();
        turning_points(step, r, |extremum| self.latest.push_back(extremum));
        let found = self.latest.len() > before;
        while self.latest.len() > MOST {
            self.latest.pop_front();
        }
        found
    }

    /// Forgets those of steps before t.
    pub(crate) fn forget_before(&mut self, t: f64) {
        while self.latest.front().is_some_and(|e| e.step < t) {
            self.latest.pop_front();
        }
    }

    /// The earliest one kept, if as many are kept as are needed.
    pub(crate) fn earliest_needed(&self) -> Option<Extremum> {
        self.latest.front().filter(|_| self.latest.len() == MOST).copied()
    }

    /// The latest one.
    pub(crate) fn last(&self) -> Option<Extremum> {
        self.latest.back().copied()
    }

    /// The maxima, latest first.
    pub(crate) fn maxima(&self) -> Vec<Extremum> {
        self.latest_first().filter(|e| e.is_maximum).copied().collect()
    }

    /// All that are kept, latest first.
    pub(crate) fn latest_first(&self) -> impl Iterator<Item = &Extremum> + Clone {
        self.latest.iter().rev()
    }

    pub(crate) fn save(&self, state: &mut State) {
        state.count(self.latest.len() as u64);
        for e in &self.latest {
            [e.t, e.l, e.step].into_iter().for_each(|number| state.number(number));
            state.flag(e.is_maximum);
        }
    }

    pub(crate) fn restore(&mut self, state: &mut Reader) -> Result<(), Damaged> {
        let one = |state: &mut Reader| {
            let (t, l, step) = (state.finite()?, state.finite()?, state.finite()?);
            Ok(Extremum { t, l, is_maximum: state.flag()?, step })
        };
        self.latest = (0..state.length(4)?).map(|_| one(state)).collect::<Result<_, _>>()?;
        Ok(())
    }
}

/// Where l' = r - x0' changes sign between collocation nodes of the step.
fn turning_points(step: &Step, r: f64, mut found: impl FnMut(Extremum)) {
    let at_nodes = apply(&RADAU.derivative, &step.displacement);
    let l_slope = |tau: f64| r - RADAU.between(&at_nodes, tau) / step.h;
    let mut before = (0.0, l_slope(0.0));
    for (c, moving) in RADAU.c.iter().zip(at_nodes) {
        let after = (*c, r - moving / step.h);
        if before.1 * after.1 < 0.0 {
            let t = step.t + zero_between(l_slope, before.0, after.0) * step.h;
            found(Extremum { t, l: step.l(r, t), is_maximum: before.1 > 0.0, step: step.t });
        }
        before = after;
    }
}
