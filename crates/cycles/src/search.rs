//! Search for cycles, without a guess or from a motion close to one.

use super::embedding::{Embedding, dragged, embedding, judge};
use super::linearisation::Linearisation;
use super::multipliers::largest_multiplier;
use super::orbit::{Orbit, Profile};
use super::solve::{Condition, MOST_WORK, NotClosed, close_if};
use super::start::{from_onset, from_run, part, small_cycle_exists};
use super::{Continuation, Cycle, CycleError, End, Ended, UnsettledRun};
use std::ops::ControlFlow;
use stickslip_stability::{Critical, StabilityError, critical, onset_at, unstable_count};
use stickslip_tip::{Model, TipFunction, Trajectory, stop};

/// Two halves of a cycle with a smaller difference, in σ, are the same.
const REPEATS_WITHIN: f64 = 1e-7;

/// The motion that a tip settles into after a small disturbance of steady motion.
#[derive(Debug, Clone)]
pub enum Settled {
    /// Steady motion is stable. (If onset is subcritical, a large cycle may also be stable.)
    Steady,
    /// A stable cycle.
    Cycle(Box<Cycle>),
    /// A run that came close to no stable cycle: trapped, or undecided.
    Run(Box<UnsettledRun>),
}

/// Finds the motion that the tip settles into at the parameters of the model: by linear stability, by [`cycle`], or by
/// a run.
///
/// Close to trapping l grows with the period, and its round-off may raise the residual of (18) above `tolerance`. A
/// cycle with a residual of at most 1e-7 is returned even then; its residual and its errors state its accuracy.
///
/// # Errors
/// A tolerance out of range, or a run that fails.
pub fn settle(model: &Model, tolerance: f64) -> Result<Settled, CycleError> {
    dragged(model)?;
    judge(tolerance)?;
    let onset = SteadyMotion::of(model)?;
    if onset.is_stable {
        return Ok(Settled::Steady);
    }
    let Search { stable, ended, coarse, .. } =
        Search::above_onset(model, onset.critical, (tolerance, Sought::Stable))?;
    let stable = stable.or_else(|| coarse.and_then(Coarse::stable));
    Ok(match (unless_stopped(stable)?, ended) {
        (Some(cycle), _) => Settled::Cycle(Box::new(cycle)),
        (None, Some(run)) => Settled::Run(Box::new(run)),
        (None, None) => Settled::Steady,
    })
}

/// The cycle at the parameters of the model, found without a guess. The first choice is the cycle that bifurcates at αc,
/// if it is stable and Newton's method finds it from its leading order; the second is the cycle that a run settles into.
/// If neither is stable, an unstable cycle is returned.
///
/// The residual of (18) on this cycle is at most `tolerance` at all times. The period and the amplitudes are more
/// accurate, as collocation converges faster at the ends of steps.
///
/// # Errors
/// A tolerance out of range, a footprint that never fades, or no cycle close to any guess.
pub fn cycle(model: &Model, tolerance: f64) -> Result<Cycle, CycleError> {
    let equation = embedding(model, tolerance)?;
    let (alpha, r) = (model.alpha(), model.r());
    let SteadyMotion { critical, is_stable } = SteadyMotion::of(model)?;
    let followed = || {
        let critical = critical?;
        if model.wider().is_basic() {
            return followed_from_onset(&equation, model, critical, tolerance);
        }
        branch_from_onset(model, critical, tolerance)
    };
    if is_stable {
        let critical = critical.ok_or(StabilityError::NoCrossing { r })?;
        let none = CycleError::NoSmallCycle { alpha, r, critical: critical.alpha };
        if !model.wider().is_basic() {
            return unless_stopped(branch_from_onset(model, critical, tolerance))?.ok_or(none);
        }
        let Some(guess) = born(&equation, model, critical) else { return Err(none) };
        let found = unless_stopped(solve(&equation, guess, tolerance))?;
        return found.map_err(|error| error.into_error(tolerance, none));
    }
    let Search { stable, unstable, ended, coarse } =
        Search::above_onset(model, critical, (tolerance, Sought::Any))?;
    if let Some(found) = stable {
        return Ok(found);
    }
    if let (Some(_), Some(coarse)) = (&unstable, &coarse)
        && unless_stopped(coarse.clone().stable())?.is_some()
    {
        // The unstable one is not what a tip comes to.
        return Err(coarse.error());
    }
    let coarse = coarse.map(|coarse| coarse.error());
    let ended = ended.map(|run| run.ended());
    let is_stuck = ended == Some(Ended::Stuck);
    let followed = if is_stuck || coarse.is_some() { None } else { followed() };
    let found = match (followed, unstable) {
        (Some(cycle), other) if cycle.is_stable() || other.is_none() => Some(cycle),
        (_, other) => other,
    };
    let none = coarse.unwrap_or(CycleError::NoCycleReached { alpha, r, ended });
    unless_stopped(found)?.ok_or(none)
}

/// The cycle at the parameters of the model that is nearest to one period of a motion. The period must begin with a
/// maximum of l.
///
/// # Errors
/// As [`cycle`]; Newton's method does not converge.
pub fn cycle_near(model: &Model, period: &Trajectory, tolerance: f64) -> Result<Cycle, CycleError> {
    let equation = embedding(model, tolerance)?;
    let (start, length) = (period.start(), period.end() - period.start());
    let ends = period.steps().iter().map(|step| (step.end() - start) / length);
    let mesh = [0.0].into_iter().chain(ends).collect();
    let profile = Profile { l: |t| period.l(start + t), height: |t| period.height(start + t) };
    solved(&equation, Orbit::of_profile(equation.r, length, mesh, profile), tolerance)
}

/// As [`cycle_near`], for the part of a motion between two times one period apart, at both of which l has its maximum.
///
/// # Errors
/// As [`cycle_near`].
pub fn cycle_within(
    model: &Model,
    motion: &Trajectory,
    (from, to): (f64, f64),
    tolerance: f64,
) -> Result<Cycle, CycleError> {
    solved(&embedding(model, tolerance)?, part(motion, from, to), tolerance)
}

/// The cycle near a guess, or the reason why there is none.
fn solved(equation: &Embedding, guess: Orbit, tolerance: f64) -> Result<Cycle, CycleError> {
    unless_stopped(solve(equation, guess, tolerance))?
        .map_err(|error| error.into_error(tolerance, equation.lost()))
}

/// The small cycle that bifurcates at αc, on the side of αc where it exists; `None` if Newton's method finds no cycle
/// from its leading order.
///
/// # Errors
/// A tolerance out of range, a footprint that never fades, or no critical point.
pub fn small_cycle(model: &Model, tolerance: f64) -> Result<Option<Cycle>, CycleError> {
    let equation = embedding(model, tolerance)?;
    let guess = SteadyMotion::of(model)?.critical.and_then(|at| born(&equation, model, at));
    Ok(guess.and_then(|guess| solve(&equation, guess, tolerance).ok()))
}

/// The result of a search, or an error after a request to stop.
fn unless_stopped<T>(found: T) -> Result<T, CycleError> {
    if stop::is_requested() { Err(CycleError::Stopped) } else { Ok(found) }
}

/// The search ends after this number of guesses whose cycles have too large a residual.
const MOST_COARSE: usize = 3;

/// Results of a search above αc.
struct Search {
    stable: Option<Cycle>,
    unstable: Option<Cycle>,
    /// The run, if one was made.
    ended: Option<UnsettledRun>,
    /// A guess with a cycle whose residual is above the tolerance.
    coarse: Option<Coarse>,
}

/// The largest residual of a cycle that serves for classification: at the ends of its steps the error is much smaller.
pub const ROUGHEST_RESIDUAL: f64 = 1e-7;

/// A guess close to a cycle whose residual cannot be reduced to the tolerance.
#[derive(Clone)]
struct Coarse {
    equation: Embedding,
    guess: Orbit,
    allowed: f64,
    reached: f64,
}

impl Coarse {
    /// The cycle to the residual that can be reached, if it is stable.
    fn stable(self) -> Option<Cycle> {
        let Self { equation, guess, reached, .. } = self;
        let found = (reached <= ROUGHEST_RESIDUAL).then(|| solve(&equation, guess, reached));
        found?.ok().filter(Cycle::is_stable)
    }

    fn error(&self) -> CycleError {
        CycleError::Rough { allowed: self.allowed, reached: self.reached }
    }
}

impl Search {
    fn above_onset(
        model: &Model,
        critical: Option<Critical>,
        (tolerance, sought): (f64, Sought),
    ) -> Result<Self, CycleError> {
        // Runs are made of tips that never fade, too.
        let equation = match embedding(model, tolerance) {
            Err(CycleError::NeverFades) => None,
            other => Some(other?),
        };
        let mut found = Self { stable: None, unstable: None, ended: None, coarse: None };
        let (mut coarse, mut times) = (None, 0);
        let mut take = |guess: Orbit| {
            let Some(equation) = &equation else { return false };
            let cycle = match solve_if(equation, guess.clone(), tolerance, sought) {
                Ok(cycle) => cycle,
                Err(NotClosed::Lost) => return false,
                // Another guess may have a better mesh; after some of them it is not that.
                Err(NotClosed::Coarse(reached)) => {
                    let equation = equation.clone();
                    coarse = Some(Coarse { equation, guess, allowed: tolerance, reached });
                    times += 1;
                    return times == MOST_COARSE;
                }
            };
            let is_stable = cycle.is_stable();
            let place = if is_stable { &mut found.stable } else { &mut found.unstable };
            place.get_or_insert(cycle);
            is_stable
        };
        let small = equation.as_ref().zip(critical).and_then(|(e, at)| born(e, model, at));
        if !small.is_some_and(&mut take) {
            let width = equation.as_ref().map_or(model.tip().widths(1.0), Embedding::width);
            let period = critical.map_or(0.0, |at| at.period);
            found.ended = Some(from_run(model, (width, period), take)?);
        }
        unless_stopped(Self { coarse, ..found })
    }
}

/// Position of the first cycle on the branch from onset, as a fraction of the distance from αc to the requested α.
const FIRST_SHARE: f64 = 0.02;
/// Length of the first step along this branch, as such a fraction.
const FIRST_STEP: f64 = 0.05;
const GROWTH: f64 = 1.5;
/// Number of steps that may fail; each failed step is repeated with half its length.
const MOST_FAILURES: usize = 4;

/// The cycle on the branch from αc at the requested α, if the branch does not turn back before.
fn followed_from_onset(
    equation: &Embedding,
    model: &Model,
    critical: Critical,
    tolerance: f64,
) -> Option<Cycle> {
    let at = |share: f64| {
        let alpha = critical.alpha + share * (model.alpha() - critical.alpha);
        let model = Model::new(model.tip().clone(), alpha, model.r()).ok()?;
        Some((Embedding { alpha, ..equation.clone() }, model))
    };
    let (nearby, small) = at(FIRST_SHARE)?;
    let mut cycle = solve(&nearby, born(&nearby, &small, critical)?, tolerance).ok()?;
    let (mut share, mut step, mut failures, mut work) = (FIRST_SHARE, FIRST_STEP, 0, 0.0);
    while share < 1.0 {
        let next = (share + step).min(1.0);
        if let Ok(found) = solve(&at(next)?.0, cycle.closed.orbit.clone(), tolerance) {
            work += found.work();
            (cycle, share, step) = (found, next, GROWTH * step);
        } else {
            failures += 1;
            step *= 0.5;
        }
        if failures > MOST_FAILURES || work > MOST_WORK || stop::is_requested() {
            return None;
        }
    }
    Some(cycle)
}

/// Largest number of cycles on a branch to the requested α.
const MOST_ON_THE_WAY: usize = 300;

/// As [`followed_from_onset`] in the extended model, where the position of the small cycle is not known. `None` if the
/// branch first leads away from the requested α.
fn branch_from_onset(model: &Model, critical: Critical, tolerance: f64) -> Option<Cycle> {
    let settings = Continuation {
        to: model.alpha(),
        tolerance,
        most_points: MOST_ON_THE_WAY,
        ..Continuation::default()
    };
    let ahead = model.alpha() - critical.alpha;
    let mut work = 0.0;
    let observe = |cycle: &Cycle| {
        work += cycle.work();
        let away = (cycle.model().alpha() - critical.alpha) * ahead < 0.0;
        if away || work > MOST_WORK { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    };
    let law = (model.wider(), model.tip());
    let branch = settings.from_onset_under(law, model.r(), observe).ok()?;
    (branch.end == End::Reached).then_some(branch.last)
}

/// A guess for the small cycle on this side of onset, if its leading order is known.
fn born(equation: &Embedding, model: &Model, critical: Critical) -> Option<Orbit> {
    if !model.wider().is_basic() {
        return None;
    }
    let onset = onset_at(model.tip(), critical).ok()?;
    from_onset(equation, &onset).filter(|_| small_cycle_exists(equation, &onset))
}

/// The cycles that a search is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Sought {
    Any,
    /// Stable cycles; those that are clearly unstable are not solved for to the end.
    Stable,
}

/// A cycle is clearly unstable if a multiplier of its first solution, on the mesh of its guess and in the rough sum, is
/// above this. In a phase diagram of 14 × 14 points these multipliers were within 1e-5 of those of the cycle.
const CLEARLY_UNSTABLE: f64 = 1.01;

impl Sought {
    fn wants(self, linearisation: &Linearisation) -> bool {
        self == Self::Any || largest_multiplier(linearisation) < CLEARLY_UNSTABLE
    }
}

/// The cycle near a guess, with its smallest period: a guess with two slips may consist of two equal periods.
fn solve(equation: &Embedding, guess: Orbit, tolerance: f64) -> Result<Cycle, NotClosed> {
    solve_if(equation, guess, tolerance, Sought::Any)
}

/// As [`solve`], if the cycle is one of those sought.
fn solve_if(
    equation: &Embedding,
    guess: Orbit,
    tolerance: f64,
    sought: Sought,
) -> Result<Cycle, NotClosed> {
    let is_wanted = |linearisation: &Linearisation| sought.wants(linearisation);
    let closed = close_if(equation.clone(), guess, Condition::GIVEN, tolerance, is_wanted)?;
    if closed.is_steady() {
        return Err(NotClosed::Lost);
    }
    let r = equation.r;
    if closed.orbit.difference_of_halves(r) < REPEATS_WITHIN {
        return solve_if(equation, closed.orbit.halved(r), tolerance, sought);
    }
    // What swings by no more than its error is steady motion.
    let swings = |cycle: &Cycle| cycle.slips() > 0 && cycle.amplitude_x0() > cycle.error();
    Cycle::new(closed).ok().filter(swings).ok_or(NotClosed::Lost)
}

/// Linear stability at the parameters of a model.
pub(super) struct SteadyMotion {
    /// αc(r); `None` if it does not exist or cannot be found.
    pub(super) critical: Option<Critical>,
    /// Whether small deviations from steady motion decay.
    pub(super) is_stable: bool,
}

impl SteadyMotion {
    /// # Errors
    /// r out of range; in the extended model, roots that cannot be counted.
    pub(super) fn of(model: &Model) -> Result<Self, StabilityError> {
        let (wider, tip, r) = (model.wider(), model.tip(), model.r());
        let critical = match critical(wider, tip, r) {
            Ok(found) => Some(found),
            Err(StabilityError::NoCrossing { .. } | StabilityError::Unsettled { .. }) => None,
            Err(error) => return Err(error),
        };
        // In the basic model α alone decides: no roots are counted.
        if wider.is_basic() && *tip != TipFunction::Cosine {
            let is_stable = critical.is_none_or(|at| model.alpha() <= at.alpha);
            return Ok(Self { critical, is_stable });
        }
        let is_stable = match unstable_count(model) {
            Ok(count) => count == 0,
            // On the corner of |h| there are no roots to count: small deviations grow from αc on.
            Err(StabilityError::Corner) => critical.is_some_and(|at| model.alpha() <= at.alpha),
            Err(error) => return Err(error),
        };
        Ok(Self { critical, is_stable })
    }
}
