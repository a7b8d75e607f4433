//! Branches of cycles: pseudo-arclength continuation in α or r.
//!
//! A branch is a curve in the space of the largest l, the period and the parameter, and it is along this
//! curve that steps are taken, so that folds are points like any other. Where a [test function](signs)
//! changes sign from one cycle to the next, the special point between them is [located](locate).

mod begin;
mod locate;
mod place;
mod signs;
mod special;
mod switch;

pub use special::{Special, SpecialKind};

use super::solve::NotClosed;
use super::{Cycle, CycleError, Parameter};
use locate::Located;
use num_complex::Complex;
use place::Place;
use std::ops::ControlFlow;
use stickslip_tip::{TipFunction, Wider, stop};

/// How far, and how finely, a branch is followed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Continuation {
    /// What varies.
    pub over: Parameter,
    /// Its last value: the branch ends where it is reached.
    pub to: f64,
    /// Largest residual of (18).
    pub tolerance: f64,
    /// The branch ends where the period exceeds this: towards trapping it has no bound.
    pub longest_period: f64,
    /// Longest step along the branch, in relative changes of l, period and parameter.
    pub longest_step: f64,
    /// The branch ends with so many cycles.
    pub most_points: usize,
}

/// What is kept of a cycle on a branch.
#[derive(Debug, Clone, PartialEq)]
pub struct Point {
    /// α
    pub alpha: f64,
    /// r
    pub r: f64,
    /// T
    pub period: f64,
    /// Half peak-to-peak of l.
    pub amplitude_x0: f64,
    /// Half peak-to-peak of the surface left behind.
    pub amplitude_u: f64,
    /// Whether small deviations die out.
    pub stable: bool,
    /// The largest multiplier but that of a shift in time; 0 where none is above 1e-6.
    pub leading: Complex<f64>,
}

/// A branch, in the order in which it was followed.
#[derive(Debug, Clone)]
pub struct Branch {
    /// Its cycles.
    pub points: Vec<Point>,
    /// Special points, in order.
    pub special: Vec<Special>,
    /// The last cycle.
    pub last: Cycle,
    /// Why it ends there.
    pub end: End,
}

/// Why a branch ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum End {
    /// The parameter has its last value.
    Reached,
    /// The period exceeds the longest one.
    LongPeriod,
    /// The cycle has shrunk to steady motion: a Hopf bifurcation.
    Steady,
    /// The two halves of the cycle have become the same: it joins the branch of half the period.
    Halved,
    /// Enough cycles.
    ManyPoints,
    /// No cycle was found a shortest step further on.
    Lost,
    /// The observer stopped it.
    Interrupted,
}

const FIRST_STEP: f64 = 0.005;
/// Steps to cycles that close, but not to the residual asked for, beyond the first.
const MOST_COARSE: usize = 2;
const SHORTEST_STEP: f64 = 1e-8;
const GROWTH: f64 = 1.5;
/// A step that turns by more than this, as the cosine, is tried again at half its length.
const SHARPEST_TURN: f64 = 0.9;
/// One that turns by less may grow.
const STRAIGHT: f64 = 0.98;

impl Default for Continuation {
    /// α up to infinity: as far as there are cycles of a period below 300.
    fn default() -> Self {
        Self {
            over: Parameter::Alpha,
            to: f64::INFINITY,
            tolerance: super::DEFAULT_TOLERANCE,
            longest_period: 300.0,
            longest_step: 0.05,
            most_points: 2000,
        }
    }
}

impl Continuation {
    /// The branch that is born where steady motion becomes unstable, at the value `other` of the parameter that
    /// does not vary. `observe` is shown each cycle, and may stop the branch.
    ///
    /// # Errors
    /// No such point, or no cycle near it.
    pub fn from_onset(
        &self,
        tip: &TipFunction,
        other: f64,
        observe: impl FnMut(&Cycle) -> ControlFlow<()>,
    ) -> Result<Branch, CycleError> {
        self.from_onset_under((&Wider::default(), tip), other, observe)
    }

    /// The same under a wider law, in α.
    ///
    /// # Errors
    /// As [`from_onset`](Self::from_onset).
    pub fn from_onset_under(
        &self,
        law: (&Wider, &TipFunction),
        other: f64,
        observe: impl FnMut(&Cycle) -> ControlFlow<()>,
    ) -> Result<Branch, CycleError> {
        let (hopf, place) = begin::at_onset(self, law, other)?;
        self.follow(place, vec![hopf], observe)
    }

    /// The branch through a cycle, in the direction of `to`.
    ///
    /// # Errors
    /// The cycle cannot be solved for again.
    pub fn from_cycle(
        &self,
        cycle: &Cycle,
        observe: impl FnMut(&Cycle) -> ControlFlow<()>,
    ) -> Result<Branch, CycleError> {
        self.follow(begin::at_cycle(self, cycle)?, vec![], observe)
    }

    /// The branch of twice the period that begins at a period doubling.
    ///
    /// # Errors
    /// Not a period doubling, or no cycle near it.
    pub fn switched(
        &self,
        special: &Special,
        observe: impl FnMut(&Cycle) -> ControlFlow<()>,
    ) -> Result<Branch, CycleError> {
        self.follow(switch::to_doubled(self, special)?, vec![], observe)
    }

    fn follow(
        &self,
        mut place: Place,
        mut special: Vec<Special>,
        mut observe: impl FnMut(&Cycle) -> ControlFlow<()>,
    ) -> Result<Branch, CycleError> {
        let mut points = vec![Point::of(&place.cycle)];
        let mut length = FIRST_STEP.min(self.longest_step);
        let mut stopped = observe(&place.cycle).is_break();
        let end = loop {
            if stopped {
                break End::Interrupted;
            }
            if place.cycle.period() > self.longest_period {
                break End::LongPeriod;
            }
            if points.len() >= self.most_points {
                break End::ManyPoints;
            }
            let Some((next, turn)) = self.step(&place, &mut length) else {
                break if stop::is_asked() { End::Interrupted } else { End::Lost };
            };
            if let Some(at_end) = self.at_the_end(&place, &next) {
                points.push(Point::of(&at_end));
                self.special_between(&place, &at_end, &mut special);
                place.cycle = at_end;
                break End::Reached;
            }
            match self.special_between(&place, &next.cycle, &mut special) {
                Located::OnTheWay => {}
                Located::Steady => break End::Steady,
                Located::Halved => break End::Halved,
            }
            points.push(Point::of(&next.cycle));
            stopped = observe(&next.cycle).is_break();
            place = next;
            let growth = if turn > STRAIGHT { GROWTH } else { 1.0 };
            length = (length * growth).min(self.longest_step);
        };
        Ok(Branch { points, special, last: place.cycle, end })
    }

    /// The next cycle, and the cosine by which the branch turns; shortens the step until there is one.
    fn step(&self, place: &Place, length: &mut f64) -> Option<(Place, f64)> {
        let mut coarse = 0;
        while *length >= SHORTEST_STEP && !stop::is_asked() {
            match place.step(self, *length) {
                Ok(next) => {
                    let turn = place.turn(&next);
                    if turn > SHARPEST_TURN {
                        return Some((next, turn));
                    }
                }
                // A shorter step leads to a cycle that round-off keeps as far from the residual asked for.
                Err(NotClosed::Coarse(_)) if coarse == MOST_COARSE => return None,
                Err(NotClosed::Coarse(_)) => coarse += 1,
                Err(NotClosed::Lost) => {}
            }
            *length *= 0.5;
        }
        None
    }

    /// The cycle at the last value of the parameter, if that lies between two.
    fn at_the_end(&self, place: &Place, next: &Place) -> Option<Cycle> {
        let (before, after) = (place.parameter(), next.parameter());
        let passed = (before - self.to) * (after - self.to) <= 0.0;
        if !passed || (after - before).abs() <= 0.0 {
            return None;
        }
        next.at_parameter(self, self.to)
    }
}

impl Point {
    fn of(cycle: &Cycle) -> Self {
        Self {
            alpha: cycle.model().alpha(),
            r: cycle.model().r(),
            period: cycle.period(),
            amplitude_x0: cycle.amplitude_x0(),
            amplitude_u: cycle.amplitude_u(),
            stable: cycle.is_stable(),
            leading: cycle.nontrivial_multipliers().next().unwrap_or_default(),
        }
    }
}
