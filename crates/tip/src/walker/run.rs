//! A run of a walker.

use super::chain::Chain;
use super::directions::directions;
use super::scenario::{WalkerError, WalkerScenario};
use super::trajectory::{WalkerStep, WalkerTrajectory};
use crate::integrator::landing::landing;
use crate::integrator::taylor::length::{ORDER_PER_DIGIT, order};
use crate::run::MOST_STEPS;
use crate::stop;
use std::ops::ControlFlow;

/// Error of a step and of the directions, as fractions of the tolerance.
const SHARE_OF_SERIES: f64 = 1e-2;
const SHARE_OF_DIRECTIONS: f64 = 1e-3;
/// Smaller errors of the directions are round-off.
const LEAST_ERROR: f64 = 1e-16;
/// Speed for which the directions are sufficient, relative to the largest speed known at the start, or to a speed that
/// was too large.
const ROOM: f64 = 1.5;
/// Least speed for which the directions are sufficient, even for a particle at rest, times T.
const LEAST_RANGE: f64 = 0.2;

/// A finished run.
#[derive(Debug, Clone)]
pub struct WalkerRun {
    /// x0(t) and y0(t) at every t of the run.
    pub trajectory: WalkerTrajectory,
    /// Number of directions.
    pub directions: usize,
    /// Whether the run was [stopped](stop) before its end.
    pub interrupted: bool,
}

/// Integrates the motion from t = 0 to the end of a scenario.
///
/// The number of directions is sufficient for the largest speed that occurs: if the particle becomes faster than
/// expected, the run is repeated with more of them.
///
/// # Errors
/// A parameter is out of range, a step is lost in round-off, or the memory is too long for the available number of
/// directions.
pub fn run(scenario: &WalkerScenario) -> Result<WalkerRun, WalkerError> {
    run_observed(scenario, |_, _| ControlFlow::Continue(()))
}

/// As [`run`], with a callback after every step. It gets the step and the number of steps so far, and may end the run.
///
/// # Errors
/// As [`run`].
pub fn run_observed(
    scenario: &WalkerScenario,
    mut observe: impl FnMut(&WalkerStep, usize) -> ControlFlow<()>,
) -> Result<WalkerRun, WalkerError> {
    scenario.validate()?;
    let mut fastest = (ROOM * scenario.known_speed()).max(LEAST_RANGE / scenario.healing_time);
    loop {
        match attempt(scenario, fastest, &mut observe)? {
            Attempt::Done(run) => return Ok(run),
            Attempt::TooFast(speed) => fastest = ROOM * speed,
        }
    }
}

/// The result of a run with a number of directions.
enum Attempt {
    Done(WalkerRun),
    /// The particle was faster than the directions allow, at this speed.
    TooFast(f64),
}

fn attempt(
    scenario: &WalkerScenario,
    fastest: f64,
    observe: &mut dyn FnMut(&WalkerStep, usize) -> ControlFlow<()>,
) -> Result<Attempt, WalkerError> {
    let range = fastest * scenario.healing_time;
    let drive = (scenario.alpha * scenario.healing_time).abs().max(f64::MIN_POSITIVE);
    let allowed = (SHARE_OF_DIRECTIONS * scenario.tolerance / drive).max(LEAST_ERROR);
    let count = directions(range, allowed).ok_or(WalkerError::Range { t: 0.0, range })?;
    let error = SHARE_OF_SERIES * scenario.tolerance;
    let order = order(error, ORDER_PER_DIGIT);
    let mut chain = Chain::new(scenario, count, order);
    let (mut t, mut steps, mut interrupted) = (0.0, vec![], false);
    while t < scenario.until && !interrupted {
        if steps.len() == MOST_STEPS {
            return Err(WalkerError::TooLong { t, steps: MOST_STEPS });
        }
        for (force, series) in scenario.force.iter().zip(&mut chain.force) {
            if !force.series(t, series) {
                return Err(WalkerError::Force);
            }
        }
        chain.expand();
        let h = chain.length(error).min(longest_step(scenario, t));
        let ends = scenario.force.iter().map(|force| force.next_break(t));
        let end = ends.fold(scenario.until, f64::min);
        let h = landing(t, if t + h >= end { end - t } else { h }, end);
        let h = h.filter(|h| h.is_finite()).ok_or(WalkerError::Step { t })?;
        let speed = chain.largest_speed(h);
        if speed > fastest {
            return Ok(Attempt::TooFast(speed));
        }
        let step = WalkerStep { t, h, position: chain.position.clone() };
        chain.advance(h);
        t = step.end();
        interrupted = observe(&step, steps.len() + 1).is_break() || stop::is_requested();
        steps.push(step);
    }
    let trajectory = WalkerTrajectory::new(steps);
    Ok(Attempt::Done(WalkerRun { trajectory, directions: count, interrupted }))
}

fn longest_step(scenario: &WalkerScenario, t: f64) -> f64 {
    scenario.force.iter().map(|force| force.longest_step(t)).fold(f64::INFINITY, f64::min)
}
