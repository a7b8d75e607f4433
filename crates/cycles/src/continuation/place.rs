//! A cycle on a branch, and the way on from there.

use super::Continuation;
use crate::change::{Change, Direction};
use crate::embedding::Parameter;
use crate::solve::{Closed, Condition, NotClosed, close};
use crate::{Cycle, CycleError};

/// A cycle with the tangent of its branch.
#[derive(Clone)]
pub(super) struct Place {
    pub(super) cycle: Cycle,
    over: Parameter,
    /// Of length 1 in the scales of the place.
    pub(super) tangent: Change,
    pub(super) along: Direction,
}

impl Place {
    /// On the branch that goes on so that `along` grows.
    pub(super) fn new(closed: Closed, over: Parameter, along: &Direction) -> Option<Self> {
        let tangent = closed.linearisation.tangent(along)?;
        let scales = Scales::at(&closed, over);
        let tangent_length = scales.length(&tangent);
        if !tangent_length.is_finite() {
            return None;
        }
        let tangent = tangent.times(1.0 / tangent_length);
        let along = scales.along(&tangent);
        Some(Self { cycle: Cycle::new(closed).ok()?, over, tangent, along })
    }

    /// The parameter that varies.
    pub(super) fn parameter(&self) -> f64 {
        self.cycle.closed.equation.parameter(self.over)
    }

    /// The cycle at this distance along the tangent, and on the branch through it.
    pub(super) fn step(&self, settings: &Continuation, length: f64) -> Result<Self, NotClosed> {
        let Closed { mut equation, mut orbit, .. } = self.cycle.closed.clone();
        orbit.move_by(&self.tangent, length);
        equation.set(self.over, self.parameter() + length * self.tangent.parameter);
        equation.model().ok_or(NotClosed::Lost)?;
        let condition = Condition { free: self.over, fixed: self.along };
        let closed = close(equation, orbit, condition, settings.tolerance)?;
        if closed.is_steady() {
            return Err(NotClosed::Lost);
        }
        Self::new(closed, self.over, &self.along).ok_or(NotClosed::Lost)
    }

    /// How far along the tangent another cycle lies.
    pub(super) fn distance(&self, cycle: &Cycle) -> f64 {
        let (here, there) = (&self.cycle.closed, &cycle.closed);
        let l = |of: &Closed| of.orbit.extension - of.equation.r;
        self.along.l * (l(there) - l(here))
            + self.along.period * (there.orbit.period - here.orbit.period)
            + self.along.parameter * (there.equation.parameter(self.over) - self.parameter())
    }

    /// Cosine of the angle between the tangents here and there.
    pub(super) fn turn(&self, next: &Self) -> f64 {
        self.along.of(&next.tangent)
    }

    /// The cycle nearby at this value of the parameter.
    pub(super) fn at_parameter(&self, settings: &Continuation, value: f64) -> Option<Cycle> {
        let length = (value - self.parameter()) / self.tangent.parameter;
        let Closed { mut equation, mut orbit, .. } = self.cycle.closed.clone();
        orbit.move_by(&self.tangent, length);
        equation.set(self.over, value);
        let condition = Condition { free: self.over, fixed: Direction::PARAMETER };
        let closed = close(equation, orbit, condition, settings.tolerance).ok()?;
        Cycle::new(closed).ok()
    }
}

/// The cycle again, linearised with this parameter free.
pub(super) fn solved_again(cycle: &Cycle, settings: &Continuation) -> Result<Closed, CycleError> {
    let Closed { equation, orbit, .. } = cycle.closed.clone();
    let (alpha, r) = (equation.alpha, equation.r);
    let condition = Condition { free: settings.over, fixed: Direction::PARAMETER };
    close(equation, orbit, condition, settings.tolerance)
        .map_err(|error| error.told(settings.tolerance, CycleError::NotConverged { alpha, r }))
}

/// What a change of each quantity is measured by.
struct Scales {
    l: f64,
    period: f64,
    parameter: f64,
}

impl Scales {
    fn at(closed: &Closed, over: Parameter) -> Self {
        let Closed { equation, orbit, .. } = closed;
        Self {
            l: equation.width() + (orbit.extension - equation.r).abs(),
            period: orbit.period,
            parameter: equation.parameter(over),
        }
    }

    fn length(&self, change: &Change) -> f64 {
        self.along(change).of(change).sqrt()
    }

    /// The functional that is the inner product with a change.
    fn along(&self, change: &Change) -> Direction {
        Direction {
            l: change.state[0] / self.l.powi(2),
            period: change.period / self.period.powi(2),
            parameter: change.parameter / self.parameter.powi(2),
        }
    }
}
