//! Newton's method for a cycle, on meshes that are refined until its residual is as small as asked.

use super::CycleError;
use super::change::{Change, Direction};
use super::embedding::{Embedding, Parameter};
use super::linearisation::Linearisation;
use super::mesh::{Aim, MOST_STEPS, MOST_STEPS_OF_GUESS, adapted, residuals};
use super::orbit::Orbit;
use nalgebra::DMatrix;
use std::sync::Arc;
use stickslip_tip::memory::Fit;
use stickslip_tip::stop;

/// A cycle: an orbit that solves the collocation equations on a mesh fine enough.
#[derive(Clone)]
pub(super) struct Closed {
    pub(super) equation: Embedding,
    pub(super) orbit: Orbit,
    pub(super) linearisation: Arc<Linearisation>,
    /// Estimate of the largest residual of (18).
    pub(super) residual: f64,
    /// Linearisations that it took.
    pub(super) iterations: usize,
}

/// Which unknown is free besides the motion and its period, and what does not change.
#[derive(Debug, Clone, Copy)]
pub(super) struct Condition {
    pub(super) free: Parameter,
    pub(super) fixed: Direction,
}

impl Condition {
    /// Both parameters given.
    pub(super) const GIVEN: Self = Self { free: Parameter::Alpha, fixed: Direction::PARAMETER };
}

/// Why there is no cycle near a guess.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum NotClosed {
    /// Newton's method did not converge, or the mesh needs too many steps.
    Lost,
    /// There is one, but no mesh brings its residual down to what is asked: round-off of the sum that stands for f
    /// does not let it. This much can be had.
    Coarse(f64),
}

const MOST_ITERATIONS: usize = 15;
const MOST_MESHES: usize = 8;
/// And under a wider law: to follow the corners of |h|, and where inertia rings.
const MOST_MESHES_OF_WIDER: usize = 20;
/// From so many meshes on each aims at this part of the residual of the one before.
const USUAL_MESHES: usize = 4;
const SHARPER: f64 = 0.5;
/// Steps times the square of the length of the state, summed over linearisations: some seconds of work.
pub(super) const MOST_WORK: f64 = 4e8;
/// Residuals within a step may exceed the estimate by as much.
const ESTIMATE_FALLS_SHORT: f64 = 0.7;
/// What can be had, over the residual at which meshes no longer help.
const MARGIN: f64 = 2.0;
/// A correction of this size leaves an error of its square.
const ENOUGH: f64 = 1e-9;
/// Enough to see how far the mesh must be refined.
const ENOUGH_FOR_A_MESH: f64 = 1e-6;
/// Corrections that no longer shrink are round-off if they are below this.
const ROUND_OFF: f64 = 1e-6;
/// A correction changes no position by more than this, in widths of the tip, and the period by no more
/// than that fraction.
const LONGEST_CORRECTION: f64 = 1.0;
const LARGEST_CHANGE_OF_PERIOD: f64 = 0.2;
/// And no height by more than this, over the depth limit: w depends on them as an exponential does.
const LARGEST_CHANGE_OF_HEIGHTS: f64 = 1.0;
/// A guess is given up after so many corrections in turn that hardly change and are longer than all that are left together.
const TOO_FAR: usize = 3;
/// Corrections below this that are no smaller part of the last show that the rough sum does not do: motions that amplify
/// deviations amplify its errors.
const SLOW: f64 = 0.1;
const NEAR: f64 = 1e-3;

/// The cycle near a guess.
pub(super) fn close(
    mut equation: Embedding,
    mut orbit: Orbit,
    condition: Condition,
    allowed: f64,
) -> Result<Closed, NotClosed> {
    if orbit.stages.len() > MOST_STEPS_OF_GUESS {
        return Err(NotClosed::Lost);
    }
    orbit.take_heights(&equation).ok_or(NotClosed::Lost)?;
    let (short, fine) = (Arc::clone(&equation.short), Arc::clone(&equation.fine));
    // The mesh is found with the short sum, if it is good enough and any shorter, and the solution on it with the fine one.
    let is_shorter = short.terms().len() < fine.terms().len();
    let first = if equation.short_is_precise && is_shorter { &short } else { &fine };
    equation.short = Arc::clone(&equation.rough);
    let (mut iterations, mut work, mut reached) = (0, 0.0, 0.0);
    let meshes = if equation.wider.is_papers() { MOST_MESHES } else { MOST_MESHES_OF_WIDER };
    let mut short_of_it = 0;
    for _ in 0..meshes {
        for (solved, enough) in [(first, ENOUGH_FOR_A_MESH), (&fine, ENOUGH)] {
            let before = Arc::clone(&equation.short);
            if enough <= ENOUGH {
                // The last linearisation is kept.
                equation.short = Arc::clone(&short);
            }
            let (e, o) = (&mut equation, &mut orbit);
            let mut newton = Newton { equation: e, orbit: o, condition, precise: &short };
            let Converged { linearisation, count, size } = newton.solve(solved, enough)?;
            iterations += count;
            work += equation.work((count * orbit.stages.len()) as f64);
            if work > MOST_WORK || stop::is_asked() {
                return Err(NotClosed::Lost);
            }
            let residuals = residuals(&orbit, &linearisation.of_steps);
            let residual = residuals.iter().copied().fold(0.0, f64::max);
            reached = residual;
            let corners = orbit.corners(equation.r);
            let met = orbit.meets(&corners, &equation, allowed);
            if residual > ESTIMATE_FALLS_SHORT * allowed || !met {
                let is_fine = residual <= ESTIMATE_FALLS_SHORT * allowed;
                let moved = if is_fine { orbit.moved_to(&corners) } else { None };
                short_of_it += usize::from(!is_fine);
                let aim = Aim::of_round(short_of_it, allowed, equation.wider.inertia.is_some());
                let mesh = moved
                    .unwrap_or_else(|| adapted(&orbit, equation.band, (&residuals, aim), &corners));
                if mesh.len() > MOST_STEPS {
                    return Err(NotClosed::Lost);
                }
                orbit = orbit.on_mesh(equation.r, mesh);
                if enough <= ENOUGH && size <= ENOUGH {
                    equation.short = before;
                }
                break;
            }
            if enough <= ENOUGH || (Arc::ptr_eq(first, &fine) && size <= ENOUGH) {
                let is_of_orbit = Arc::ptr_eq(&equation.short, &short) && size <= ENOUGH;
                equation.short = Arc::clone(&short);
                let linearisation = if is_of_orbit {
                    linearisation
                } else {
                    iterations += 1;
                    let again = Linearisation::new(&equation, &orbit, condition.free, &fine);
                    again.map_err(|_| NotClosed::Lost)?
                };
                let linearisation = Arc::new(linearisation);
                return Ok(Closed { equation, orbit, linearisation, residual, iterations });
            }
        }
    }
    // Corners that are not met are met on another cycle nearby.
    let is_coarse = reached > ESTIMATE_FALLS_SHORT * allowed;
    let reached = MARGIN / ESTIMATE_FALLS_SHORT * reached;
    Err(if is_coarse { NotClosed::Coarse(reached) } else { NotClosed::Lost })
}

impl Aim {
    /// Where inertia rings, a mesh that does not resolve it says too little of the one that would: after some that fell
    /// short they only become finer.
    fn of_round(round: usize, allowed: f64, has_inertia: bool) -> Self {
        let late = if has_inertia { round.saturating_sub(USUAL_MESHES) } else { 0 };
        let sharper = (0..late).fold(1.0, |sharper, _| SHARPER * sharper);
        Self { allowed, sharper, only_finer: late > 0, may_ring: has_inertia }
    }
}

/// Newton's method on one mesh.
struct Newton<'a> {
    equation: &'a mut Embedding,
    orbit: &'a mut Orbit,
    condition: Condition,
    /// What to go by where the rough sum leads nowhere.
    precise: &'a Arc<Fit>,
}

/// Where Newton's method ended.
struct Converged {
    /// About the last iterate but one.
    linearisation: Linearisation,
    /// Linearisations that it took.
    count: usize,
    /// The last correction.
    size: f64,
}

impl Newton<'_> {
    /// Solves the equations in one of the sums until a correction is below `enough`.
    fn solve(&mut self, solved: &Fit, enough: f64) -> Result<Converged, NotClosed> {
        let free = self.condition.free;
        let (mut last, mut far) = (f64::INFINITY, 0);
        for count in 1..=MOST_ITERATIONS {
            let linearisation = Linearisation::new(self.equation, self.orbit, free, solved);
            let linearisation = linearisation.map_err(|_| NotClosed::Lost)?;
            let change = linearisation.correction(&self.condition.fixed).ok_or(NotClosed::Lost)?;
            self.apply(&change)?;
            let limit = self.equation.wider.depth_limit.unwrap_or(1.0);
            let size = change.size().max(change.of_heights() / limit.max(1.0));
            let slow = size > SLOW * last && size < NEAR;
            let is_rough = !Arc::ptr_eq(&self.equation.short, self.precise);
            let settled = size > 0.5 * last && size < ROUND_OFF && !is_rough;
            if size <= enough || settled {
                return Ok(Converged { linearisation, count, size });
            }
            if slow && is_rough {
                self.equation.short = Arc::clone(self.precise);
            }
            let reach = (MOST_ITERATIONS - count) as f64 * LONGEST_CORRECTION;
            let stays = size > 0.5 * last && size < 2.0 * last;
            far = if stays && size > reach * self.equation.width() { far + 1 } else { 0 };
            if far == TOO_FAR {
                break;
            }
            last = size;
        }
        Err(NotClosed::Lost)
    }

    fn apply(&mut self, change: &Change) -> Result<(), NotClosed> {
        let width = self.equation.width();
        let limit = self.equation.wider.depth_limit.unwrap_or(f64::INFINITY);
        let by_heights = LARGEST_CHANGE_OF_HEIGHTS * limit / change.of_heights();
        let factor = damping(change, self.orbit.period, width);
        // Without heights that is no number.
        let factor = if by_heights < factor { by_heights } else { factor };
        let free = self.condition.free;
        self.orbit.move_by(change, factor);
        self.equation.set(free, self.equation.parameter(free) + factor * change.parameter);
        let usable = change.size().is_finite() && self.orbit.period > 0.0;
        if usable && self.equation.model().is_some() { Ok(()) } else { Err(NotClosed::Lost) }
    }
}

/// How much of a correction is made.
fn damping(change: &Change, period: f64, width: f64) -> f64 {
    let by_size = LONGEST_CORRECTION * width / change.size();
    let by_period = LARGEST_CHANGE_OF_PERIOD * period / change.period.abs();
    by_size.min(by_period).min(1.0)
}

impl NotClosed {
    /// What is told of it where there is a cycle to a looser tolerance; else `lost`.
    pub(super) fn told(self, allowed: f64, lost: CycleError) -> CycleError {
        match self {
            Self::Lost => lost,
            Self::Coarse(reached) => CycleError::Rough { allowed, reached },
        }
    }
}

impl Closed {
    /// The monodromy matrix ∂X(T)/∂X(0), in the short sum.
    pub(super) fn monodromy(&self) -> DMatrix<f64> {
        self.linearisation.monodromy()
    }

    /// The same in another sum.
    pub(super) fn monodromy_in(&self, sum: &Arc<Fit>) -> Option<DMatrix<f64>> {
        let Self { equation, orbit, .. } = self;
        let precise = Embedding { short: Arc::clone(sum), ..equation.clone() };
        let again = Linearisation::new(&precise, orbit, Parameter::Alpha, &equation.fine);
        again.ok().map(|linearisation| linearisation.monodromy())
    }
}
