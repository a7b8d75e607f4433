//! Newton's method for a cycle, on meshes that are refined until its residual is small enough.

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
    pub(super) iterations: usize,
}

/// The free unknown besides the motion and its period, and the fixed quantity.
#[derive(Debug, Clone, Copy)]
pub(super) struct Condition {
    pub(super) free: Parameter,
    pub(super) fixed: Direction,
}

impl Condition {
    /// Both parameters are given.
    pub(super) const GIVEN: Self = Self { free: Parameter::Alpha, fixed: Direction::PARAMETER };
}

/// The reason why there is no cycle near a guess.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum NotClosed {
    /// Newton's method did not converge, or the mesh needs too many steps.
    Lost,
    /// A cycle exists, but no mesh reduces its residual to the allowed one, because of the round-off of the sum for
    /// f'. This residual can be reached.
    Coarse(f64),
}

const MOST_ITERATIONS: usize = 15;
const MOST_MESHES: usize = 8;
/// Largest number of meshes in the extended model, where they must follow kink crossings and resonant motions.
const MOST_MESHES_OF_WIDER: usize = 20;
/// Number of meshes after which, with inertia, further ones aim at ever smaller residuals.
const USUAL_MESHES: usize = 4;
/// Factor between the residuals that successive meshes then aim at.
const SHARPER: f64 = 0.5;
/// Steps times the square of the length of the state, summed over linearisations: some seconds of work.
pub(super) const MOST_WORK: f64 = 4e8;
/// Largest estimated residual as a fraction of the allowed one, because the residual within a step may exceed the
/// estimate.
const ESTIMATE_FALLS_SHORT: f64 = 0.7;
/// Residual that is reported as possible, over the one below which finer meshes do not reduce it.
const MARGIN: f64 = 2.0;
/// Largest size of the last correction: the remaining error is of the order of its square.
const ENOUGH: f64 = 1e-8;
/// Size of a correction that is sufficient for the refinement of the mesh.
const ENOUGH_FOR_A_MESH: f64 = 1e-6;
/// Corrections below this that no longer decrease are round-off.
const ROUND_OFF: f64 = 1e-6;
/// Largest change of a position by a correction, in widths of the tip.
const LONGEST_CORRECTION: f64 = 1.0;
/// Largest relative change of the period by a correction.
const LARGEST_CHANGE_OF_PERIOD: f64 = 0.2;
/// Largest change of a height by a correction, in units of the depth limit: w depends on heights exponentially.
const LARGEST_CHANGE_OF_HEIGHTS: f64 = 1.0;
/// Number of successive corrections of nearly equal size, each longer than all remaining ones together can be, after
/// which a guess is given up.
const TOO_FAR: usize = 3;
/// Corrections longer than this many times all remaining ones together count as well, whatever their sizes.
const FAR_BEYOND: f64 = 30.0;
/// If the residual of a mesh is below this many times the allowed one, the next mesh most probably meets it. The solution
/// on the next mesh then begins with the fine sum.
const NEARLY_MET: f64 = 100.0;
/// Residual, relative to the allowed one, beyond which a mesh gives only a rough estimate of the necessary one.
const FAR_OFF: f64 = 3000.0;
/// The next mesh then aims at this multiple of the allowed residual, and costs half as much.
const HALFWAY: f64 = 40.0;
/// Retreat for which the sums of a resonant tip are valid, over the retreat found with the usual sums.
const MARGIN_OF_RETREAT: f64 = 1.05;
/// If a correction below [`NEAR`] exceeds this fraction of the one before, the rough sum is not sufficient: motions that
/// amplify deviations amplify its errors.
const SLOW: f64 = 0.1;
const NEAR: f64 = 1e-3;

/// The cycle near a guess.
pub(super) fn close(
    equation: Embedding,
    orbit: Orbit,
    condition: Condition,
    allowed: f64,
) -> Result<Closed, NotClosed> {
    close_if(equation, orbit, condition, allowed, |_| true)
}

/// The cycle near a guess, if it is wanted: the first solution, on the mesh of the guess, decides. Its linearisation is
/// in the rough sum.
pub(super) fn close_if(
    equation: Embedding,
    orbit: Orbit,
    condition: Condition,
    allowed: f64,
    is_wanted: impl Fn(&Linearisation) -> bool,
) -> Result<Closed, NotClosed> {
    let closed = close_in_sums(equation, orbit, condition, allowed, &is_wanted)?;
    let Closed { equation, orbit, .. } = &closed;
    if orbit.retreat() <= equation.retreat() || equation.wider.inertia.is_none() {
        return Ok(closed);
    }
    // A tip with inertia overshoots, and swings back after each slip.
    let retreat = MARGIN_OF_RETREAT * orbit.retreat();
    let far = equation.reaching_back(retreat, allowed).map_err(|error| match error {
        CycleError::Rough { reached, .. } => NotClosed::Coarse(reached),
        _ => NotClosed::Lost,
    })?;
    close_in_sums(far, closed.orbit, condition, allowed, &is_wanted)
}

/// As [`close_if`], in the sums of the embedding whatever the retreat of the tip.
fn close_in_sums(
    mut equation: Embedding,
    mut orbit: Orbit,
    condition: Condition,
    allowed: f64,
    is_wanted: &impl Fn(&Linearisation) -> bool,
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
    let meshes = if equation.wider.is_basic() { MOST_MESHES } else { MOST_MESHES_OF_WIDER };
    let (mut short_of_it, mut is_near) = (0, false);
    for round in 0..meshes {
        let passes = [(first, ENOUGH_FOR_A_MESH), (&fine, ENOUGH)];
        for (solved, enough) in passes.into_iter().skip(usize::from(is_near)) {
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
            if work > MOST_WORK || stop::is_requested() {
                return Err(NotClosed::Lost);
            }
            if round == 0 && enough > ENOUGH && !is_wanted(&linearisation) {
                return Err(NotClosed::Lost);
            }
            let residuals = residuals(&orbit, &linearisation.of_steps);
            let residual = residuals.iter().copied().fold(0.0, f64::max);
            reached = residual;
            let corners = orbit.corners(equation.r);
            let met = orbit.meets(&corners, &equation, allowed);
            is_near = met && residual <= NEARLY_MET * allowed;
            if residual > ESTIMATE_FALLS_SHORT * allowed || !met {
                let is_fine = residual <= ESTIMATE_FALLS_SHORT * allowed;
                let moved = if is_fine { orbit.moved_to(&corners) } else { None };
                short_of_it += usize::from(!is_fine);
                let is_far = equation.wider.is_basic() && residual > FAR_OFF * allowed;
                let wanted = if is_far { HALFWAY * allowed } else { allowed };
                let aim = Aim::of_round(short_of_it, wanted, equation.wider.inertia.is_some());
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
    /// For resonant motions, an insufficient mesh gives no reliable estimate of the necessary one: after several of
    /// them meshes are only refined.
    fn of_round(round: usize, allowed: f64, has_inertia: bool) -> Self {
        let late = if has_inertia { round.saturating_sub(USUAL_MESHES) } else { 0 };
        let sharper = (0..late).fold(1.0, |sharper, _| SHARPER * sharper);
        Self { allowed, sharper, only_finer: late > 0, may_ring: has_inertia }
    }
}

struct Newton<'a> {
    equation: &'a mut Embedding,
    orbit: &'a mut Orbit,
    condition: Condition,
    /// The alternative sum, if the rough one leads to no solution.
    precise: &'a Arc<Fit>,
}

/// The end of an iteration of Newton's method.
struct Converged {
    /// Linearisation about the last iterate but one.
    linearisation: Linearisation,
    /// Number of linearisations.
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
            let excess = size / (reach * self.equation.width());
            let stays = size > 0.5 * last && size < 2.0 * last;
            far = if excess > FAR_BEYOND || (stays && excess > 1.0) { far + 1 } else { 0 };
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

/// Fraction of a correction that is applied.
fn damping(change: &Change, period: f64, width: f64) -> f64 {
    let by_size = LONGEST_CORRECTION * width / change.size();
    let by_period = LARGEST_CHANGE_OF_PERIOD * period / change.period.abs();
    by_size.min(by_period).min(1.0)
}

impl NotClosed {
    /// The error to return: `Rough` if there is a cycle with a larger residual, else `lost`.
    pub(super) fn into_error(self, allowed: f64, lost: CycleError) -> CycleError {
        match self {
            Self::Lost => lost,
            Self::Coarse(reached) => CycleError::Rough { allowed, reached },
        }
    }
}

impl Closed {
    /// The monodromy matrix ∂X(T)/∂X(0) in another sum than that of the linearisation; `None` if the equations are singular.
    pub(super) fn monodromy_in(&self, sum: &Arc<Fit>) -> Option<DMatrix<f64>> {
        let Self { equation, orbit, .. } = self;
        let precise = Embedding { short: Arc::clone(sum), ..equation.clone() };
        let again = Linearisation::new(&precise, orbit, Parameter::Alpha, &equation.fine);
        again.ok().map(|linearisation| linearisation.monodromy())
    }
}
