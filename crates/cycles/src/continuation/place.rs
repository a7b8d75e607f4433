//! A cycle on a branch, and steps along the branch.

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
    /// The tangent, of length 1 in the [`Scales`] of this place.
    pub(super) tangent: Change,
    /// The inner product with the tangent.
    pub(super) along: Direction,
}

impl Place {
    /// The place of a cycle, with the tangent on which `along` increases.
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

    /// The cycle of the branch at this distance along the tangent.
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

    /// Distance of another cycle along the tangent.
    pub(super) fn distance(&self, cycle: &Cycle) -> f64 {
        let (here, there) = (&self.cycle.closed, &cycle.closed);
        let l = |of: &Closed| of.orbit.extension - of.equation.r;
        self.along.l * (l(there) - l(here))
            + self.along.period * (there.orbit.period - here.orbit.period)
            + self.along.parameter * (there.equation.parameter(self.over) - self.parameter())
    }

    /// Cosine of the angle between the tangents of both places.
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

/// The cycle, linearised again with the parameter of the continuation free.
pub(super) fn solved_again(cycle: &Cycle, settings: &Continuation) -> Result<Closed, CycleError> {
    let Closed { equation, orbit, .. } = cycle.closed.clone();
    let lost = equation.lost();
    let condition = Condition { free: settings.over, fixed: Direction::PARAMETER };
    close(equation, orbit, condition, settings.tolerance)
        .map_err(|error| error.into_error(settings.tolerance, lost))
}

/// Units of the changes of l, of the period and of the parameter.
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
