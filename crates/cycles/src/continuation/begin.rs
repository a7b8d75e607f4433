//! The first cycles of branches, at onset or at a given cycle.

use super::place::{Place, solved_again};
use super::{Continuation, Special, SpecialKind};
use crate::change::Direction;
use crate::embedding::embedding;
use crate::orbit::{Orbit, Profile, even_mesh};
use crate::solve::{Closed, Condition, close};
use crate::start::{mode, steps_of_mode};
use crate::{Cycle, CycleError, Parameter};
use stickslip_stability::{critical, critical_r};
use stickslip_tip::{Model, TipFunction, Wider};

/// Amplitude of the first cycle, in widths.
const FIRST_AMPLITUDE: f64 = 0.02;

/// The Hopf point at the value of the other parameter, and the first cycle of its branch.
pub(super) fn at_onset(
    settings: &Continuation,
    (wider, tip): (&Wider, &TipFunction),
    other: f64,
) -> Result<(Special, Place), CycleError> {
    let born = match settings.over {
        Parameter::Alpha => critical(wider, tip, other)?,
        Parameter::R => critical_r(wider, tip, other)?,
    };
    let (alpha, r) = (born.alpha, born.r);
    let hopf = Special { kind: SpecialKind::Hopf, alpha, r, period: born.period, cycle: None };
    let lost = CycleError::NotConverged { alpha, r };
    let model = Model::under(*wider, tip.clone(), alpha, r).map_err(|_| lost.clone())?;
    let closed = small(settings, &model, born.period, tip.widths(FIRST_AMPLITUDE))?;
    let place = Place::new(closed, settings.over, &Direction::L).ok_or(lost)?;
    Ok((hopf, place))
}

/// The cycle of a given small amplitude, near these parameters and this period.
pub(super) fn small(
    settings: &Continuation,
    model: &Model,
    period: f64,
    amplitude: f64,
) -> Result<Closed, CycleError> {
    let equation = embedding(model, settings.tolerance)?;
    let lost = equation.lost();
    let mesh = even_mesh(steps_of_mode(&equation, period, amplitude).ok_or(lost.clone())?);
    let l = mode(model.steady_l(), amplitude, period);
    let guess = Orbit::of_profile(model.r(), period, mesh, Profile { l, height: |_| None });
    let condition = Condition { free: settings.over, fixed: Direction::L };
    close(equation, guess, condition, settings.tolerance)
        .map_err(|error| error.into_error(settings.tolerance, lost))
}

/// The cycle of half the period, for a cycle whose halves are nearly the same.
pub(super) fn halved(settings: &Continuation, cycle: &Cycle) -> Option<Place> {
    let guess = cycle.closed.orbit.halved(cycle.model().r());
    let condition = Condition { free: settings.over, fixed: Direction::PARAMETER };
    let equation = cycle.closed.equation.clone();
    let closed = close(equation, guess, condition, settings.tolerance).ok()?;
    Place::new(closed, settings.over, &Direction::PARAMETER)
}

/// The place of a cycle, with the direction in which the parameter approaches its last value.
pub(super) fn at_cycle(settings: &Continuation, cycle: &Cycle) -> Result<Place, CycleError> {
    let closed = solved_again(cycle, settings)?;
    let lost = closed.equation.lost();
    let ahead = settings.to - closed.equation.parameter(settings.over);
    let along = Direction::PARAMETER.times(ahead.signum());
    Place::new(closed, settings.over, &along).ok_or(lost)
}
