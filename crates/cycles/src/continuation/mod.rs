//! Branches of cycles: pseudo-arclength continuation in α or r.
//!
//! A branch is a curve in the space of the largest l, the period and the parameter. Steps are taken along this curve,
//! so that folds are regular points. If a [test function](signs) changes sign from one cycle to the next, the special
//! point between them is [located](locate).

mod begin;
mod locate;
mod place;
mod signs;
mod switch;

use super::solve::NotClosed;
use super::{Cycle, CycleError, Parameter};
use locate::Located;
use num_complex::Complex;
use place::Place;
use std::ops::ControlFlow;
use stickslip_tip::{TipFunction, Wider, stop};

/// Range and step size of a continuation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Continuation {
    /// The parameter that varies.
    pub over: Parameter,
    /// Last value of the parameter: the branch ends there.
    pub to: f64,
    /// Largest residual of (18).
    pub tolerance: f64,
    /// Largest period, at which the branch ends: the period diverges towards trapping.
    pub longest_period: f64,
    /// Longest step along the branch, in relative changes of l, period and parameter.
    pub longest_step: f64,
    /// Largest number of cycles, at which the branch ends.
    pub most_points: usize,
}

/// Properties of a cycle on a branch.
#[derive(Debug, Clone, PartialEq)]
pub struct Point {
    /// α
    pub alpha: f64,
    /// r
    pub r: f64,
    /// Period T.
    pub period: f64,
    /// Half the peak-to-peak value of l.
    pub amplitude_x0: f64,
    /// Half the peak-to-peak value of the surface far behind the tip.
    pub amplitude_u: f64,
    /// Whether small deviations decay.
    pub stable: bool,
    /// The largest multiplier except that of a shift in time; 0 if none is above 1e-6.
    pub leading: Complex<f64>,
}

/// A branch, in the order of the continuation.
#[derive(Debug, Clone)]
pub struct Branch {
    /// Cycles of the branch.
    pub points: Vec<Point>,
    /// Special points, in order.
    pub special: Vec<Special>,
    /// The last cycle.
    pub last: Cycle,
    /// Reason for the end of the branch.
    pub end: End,
}

/// The reason why a branch ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(rename = "EndName"))]
pub enum End {
    /// The continuation parameter reached its last value.
    Reached,
    /// The period exceeds the longest one.
    LongPeriod,
    /// The cycle has shrunk to steady motion.
    Steady,
    /// The branch has joined that of half the period.
    Halved,
    /// The branch has the largest number of cycles.
    ManyPoints,
    /// No cycle was found even with the shortest step.
    Lost,
    /// A signal stopped the computation.
    Interrupted,
}

/// A bifurcation or fold on a branch.
#[derive(Debug, Clone)]
pub struct Special {
    /// Kind of the point.
    pub kind: SpecialKind,
    /// α
    pub alpha: f64,
    /// r
    pub r: f64,
    /// Period T.
    pub period: f64,
    /// The cycle at this point; at a period halving, the one of half the period; `None` at a Hopf point.
    pub cycle: Option<Cycle>,
}

/// Kinds of special points.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(rename = "SpecialName"))]
pub enum SpecialKind {
    /// Hopf point: the amplitude of the cycle goes to 0.
    Hopf,
    /// Fold: the branch turns back.
    Fold,
    /// A multiplier passes -1: a branch of twice the period begins.
    PeriodDoubling,
    /// The branch ends at the period doubling of a branch of half its period; period and amplitude are those of that
    /// branch.
    PeriodHalving,
    /// A second multiplier passes 1 without a fold: another branch crosses.
    BranchPoint,
    /// A complex pair crosses the unit circle: quasi-periodic motion on a torus begins.
    Torus,
}

impl Special {
    fn of(kind: SpecialKind, cycle: Cycle) -> Self {
        let (alpha, r) = (cycle.model().alpha(), cycle.model().r());
        Self { kind, alpha, r, period: cycle.period(), cycle: Some(cycle) }
    }

    /// The value of the parameter at this point.
    pub fn parameter(&self, which: Parameter) -> f64 {
        match which {
            Parameter::Alpha => self.alpha,
            Parameter::R => self.r,
        }
    }
}

const FIRST_STEP: f64 = 0.005;
/// Number of further steps to cycles whose residual cannot be reduced to the tolerance, after the first.
const MOST_COARSE: usize = 2;
const SHORTEST_STEP: f64 = 1e-8;
const GROWTH: f64 = 1.5;
/// A step is repeated with half its length if the cosine of the angle between its tangents is smaller.
const SHARPEST_TURN: f64 = 0.9;
/// The step length may grow if this cosine is larger.
const STRAIGHT: f64 = 0.98;

impl Default for Continuation {
    /// α without an upper limit: up to cycles of a period of 300.
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
    /// The branch that bifurcates at onset, at the value `other` of the fixed parameter. `observe` receives each
    /// cycle, and may end the continuation.
    ///
    /// # Errors
    /// No onset, or no cycle close to it.
    pub fn from_onset(
        &self,
        tip: &TipFunction,
        other: f64,
        observe: impl FnMut(&Cycle) -> ControlFlow<()>,
    ) -> Result<Branch, CycleError> {
        self.from_onset_under((&Wider::default(), tip), other, observe)
    }

    /// As [`from_onset`](Self::from_onset), also in the extended model, where only α can vary.
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
    /// Newton's method does not converge at the given cycle.
    pub fn from_cycle(
        &self,
        cycle: &Cycle,
        observe: impl FnMut(&Cycle) -> ControlFlow<()>,
    ) -> Result<Branch, CycleError> {
        self.follow(begin::at_cycle(self, cycle)?, vec![], observe)
    }

    /// The branch of twice the period that bifurcates at a period doubling.
    ///
    /// # Errors
    /// The point is not a period doubling, or there is no cycle close to it.
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
                break if stop::is_requested() { End::Interrupted } else { End::Lost };
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

    /// The next cycle, and the cosine of the angle between the tangents; the step is shortened until a cycle is found.
    fn step(&self, place: &Place, length: &mut f64) -> Option<(Place, f64)> {
        let mut coarse = 0;
        while *length >= SHORTEST_STEP && !stop::is_requested() {
            match place.step(self, *length) {
                Ok(next) => {
                    let turn = place.turn(&next);
                    if turn > SHARPEST_TURN {
                        return Some((next, turn));
                    }
                }
                // Round-off keeps a cycle at a shorter step as far from the requested residual.
                Err(NotClosed::Coarse(_)) if coarse == MOST_COARSE => return None,
                Err(NotClosed::Coarse(_)) => coarse += 1,
                Err(NotClosed::Lost) => {}
            }
            *length *= 0.5;
        }
        None
    }

    /// The cycle at the last value of the parameter, if this value lies between two cycles.
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
