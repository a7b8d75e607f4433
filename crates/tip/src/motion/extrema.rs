//! The latest maxima and minima of l(t).

use crate::collocation::{RADAU, apply};
use crate::elementary::{larger, smaller};
use crate::roots::zero_between;
use crate::state::{Damaged, Reader, State};
use crate::{Step, Trajectory};
use std::collections::VecDeque;

/// An extremum of l(t): its time and value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extremum {
    /// Time, in Γ/k.
    pub t: f64,
    /// Value of l, in σ.
    pub l: f64,
    /// Whether it is a maximum.
    pub is_maximum: bool,
}

/// The place of an extremum within a step; its exact time is computed only on request.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Turn {
    pub step: Step,
    /// Bracket of the extremum, in fractions of the step.
    between: (f64, f64),
    is_maximum: bool,
}

/// The latest extrema of l, in order of time.
#[derive(Debug, Clone, Default)]
pub struct Extrema {
    latest: VecDeque<Turn>,
}

/// Largest number of extrema kept: enough to compare three cycles of up to eight slips.
const MOST: usize = 64;

impl Extrema {
    /// Adds the extrema within a step; returns whether there are any.
    pub fn observe(&mut self, step: &Step, r: f64) -> bool {
        let mut found = false;
        turns(step, r, |turn| {
            self.latest.push_back(turn);
            found = true;
        });
        while self.latest.len() > MOST {
            self.latest.pop_front();
        }
        found
    }

    /// Removes the extrema within steps that begin before t.
    pub fn forget_before(&mut self, t: f64) {
        while self.latest.front().is_some_and(|turn| turn.step.t < t) {
            self.latest.pop_front();
        }
    }

    /// The earliest extremum kept; `None` while fewer than the largest number are kept.
    pub fn earliest_needed(&self) -> Option<&Turn> {
        if self.latest.len() == MOST { self.latest.front() } else { None }
    }

    /// All extrema kept, latest first.
    pub fn latest_first(&self, r: f64) -> Vec<Extremum> {
        self.latest.iter().rev().map(|turn| turn.extremum(r)).collect()
    }

    /// Writes all its data to a state.
    pub fn save(&self, state: &mut State) {
        state.count(self.latest.len() as u64);
        for turn in &self.latest {
            state.step(&turn.step);
            state.number(turn.between.0);
            state.number(turn.between.1);
            state.flag(turn.is_maximum);
        }
    }

    /// Reads the data that [`save`](Self::save) wrote.
    ///
    /// # Errors
    /// A state that does not contain extrema.
    pub fn restore(&mut self, state: &mut Reader) -> Result<(), Damaged> {
        let one = |state: &mut Reader| {
            let (step, between) = (state.step()?, (state.finite()?, state.finite()?));
            Ok(Turn { step, between, is_maximum: state.flag()? })
        };
        self.latest = (0..state.length(1)?).map(|_| one(state)).collect::<Result<_, _>>()?;
        Ok(())
    }
}

/// Calls `found` with each extremum of l within a step, in order of time.
pub fn extrema_within(step: &Step, r: f64, mut found: impl FnMut(Extremum)) {
    turns(step, r, |turn| found(turn.extremum(r)));
}

/// The last extrema of a trajectory, latest first.
pub fn latest_extrema(trajectory: &Trajectory) -> Vec<Extremum> {
    let mut extrema = Extrema::default();
    for step in trajectory.steps() {
        extrema.observe(step, trajectory.r());
    }
    extrema.latest_first(trajectory.r())
}

impl Turn {
    fn extremum(&self, r: f64) -> Extremum {
        let Self { step, between, is_maximum } = *self;
        let at_nodes = apply(&RADAU.derivative, &step.displacement);
        let l_slope = |tau: f64| r - RADAU.between(&at_nodes, tau) / step.h;
        let t = step.t + zero_between(l_slope, between.0, between.1) * step.h;
        Extremum { t, l: step.l(r, t), is_maximum }
    }
}

/// Finds sign changes of l' = r - x0' between collocation nodes of the step.
fn turns(step: &Step, r: f64, mut found: impl FnMut(Turn)) {
    let (radau, advance) = (&*RADAU, r * step.h);
    let slopes = radau.slopes(&step.displacement);
    let ends = |(low, high), slope: &f64| (smaller(*slope, low), larger(*slope, high));
    let (slowest, fastest) = slopes.iter().fold((f64::INFINITY, f64::NEG_INFINITY), ends);
    // Most steps have none.
    if slowest > advance || fastest < advance {
        return;
    }
    let mut start = 0.0;
    for (c, slopes) in radau.c.iter().zip(slopes.windows(2)) {
        let [before, after] = [slopes[0], slopes[1]].map(|slope| advance - slope);
        if before * after < 0.0 {
            found(Turn { step: *step, between: (start, *c), is_maximum: before > 0.0 });
        }
        start = *c;
    }
}
