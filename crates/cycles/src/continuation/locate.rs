//! Special points between two cycles of a branch.

use super::begin::{halved, small};
use super::place::Place;
use super::signs::{Counts, circle, difference_of_halves, doubling, fold, second_one};
use super::{Continuation, Special, SpecialKind};
use crate::Cycle;

/// Whether and how the branch ends between two cycles.
pub(super) enum Located {
    /// The branch continues.
    OnTheWay,
    /// It ends in steady motion.
    Steady,
    /// It joins the branch of half the period.
    Halved,
}

const MOST_ITERATIONS: usize = 60;
/// Distance along the branch to which points are located.
const CLOSE: f64 = 1e-11;
/// Amplitudes from which a Hopf point is extrapolated, in widths.
const AMPLITUDES: [f64; 2] = [5e-3, 1e-2];
/// Shortest step along the branch of half the period in the search for its period doubling.
const NEAREST: f64 = 1e-4;
/// Number of steps tried in this search, each twice as long as the one before.
const SEARCHES: i32 = 12;
/// A cycle with less amplitude, in widths, is about to vanish.
const SMALL: f64 = 0.05;

impl Continuation {
    /// Locates special points between a place and a cycle next to it, and adds them to the list.
    pub(super) fn special_between(
        &self,
        place: &Place,
        next: &Cycle,
        special: &mut Vec<Special>,
    ) -> Located {
        if difference_of_halves(next) * difference_of_halves(&place.cycle) < 0.0 {
            return self.vanishing(place, next, special);
        }
        let Some(next) = self.place_of(place, next) else { return Located::OnTheWay };
        let (before, after) = (Counts::of(&place.cycle), Counts::of(&next.cycle));
        let mut add = |kind, test: fn(&Place) -> f64| {
            special.extend(self.locate(place, &next, test).map(|at| Special::of(kind, at.cycle)));
        };
        let turns = fold(place) * fold(&next) < 0.0;
        if turns {
            add(SpecialKind::Fold, fold);
        }
        if before.below != after.below {
            add(SpecialKind::PeriodDoubling, doubling);
        }
        if before.above != after.above && !turns {
            add(SpecialKind::BranchPoint, second_one);
        }
        if before.around != after.around && circle(place) * circle(&next) < 0.0 {
            add(SpecialKind::Torus, circle);
        }
        Located::OnTheWay
    }

    /// A cycle that is linearised along this branch, as a place of the branch.
    fn place_of(&self, place: &Place, next: &Cycle) -> Option<Place> {
        Place::new(next.closed.clone(), self.over, &place.along)
    }

    /// The zero of a test function between two places: the rule of false position, halving the weight of an
    /// end that stays (Illinois).
    fn locate(&self, place: &Place, next: &Place, test: fn(&Place) -> f64) -> Option<Place> {
        let (mut low, mut high) = ((0.0, test(place)), (place.distance(&next.cycle), test(next)));
        if low.1 * high.1 > 0.0 {
            return None;
        }
        let mut best = next.clone();
        for _ in 0..MOST_ITERATIONS {
            let at = (low.0 * high.1 - high.0 * low.1) / (high.1 - low.1);
            let found = place.step(self, at).ok()?;
            let value = test(&found);
            let step = (at - high.0).abs();
            best = found;
            if value * high.1 < 0.0 {
                low = high;
            } else {
                low.1 *= 0.5;
            }
            high = (at, value);
            if value.abs() <= 0.0 || step <= CLOSE || (high.0 - low.0).abs() <= CLOSE {
                break;
            }
        }
        Some(best)
    }

    /// Two branches meet where the difference of the halves is zero, and the equations are singular there. Therefore
    /// the point is located on the other branch.
    fn vanishing(&self, place: &Place, next: &Cycle, special: &mut Vec<Special>) -> Located {
        let width = place.cycle.closed.equation.width();
        let smaller = place.cycle.amplitude_x0().min(next.amplitude_x0());
        if smaller < SMALL * width {
            special.extend(self.hopf_near(&place.cycle));
            return Located::Steady;
        }
        // Else the start is no longer the highest maximum, which ends nothing.
        let Some(doubling) = self.doubling_near(&place.cycle) else { return Located::OnTheWay };
        special.push(doubling);
        Located::Halved
    }

    /// The Hopf point at which a small cycle vanishes, by extrapolation in the square of its amplitude.
    fn hopf_near(&self, cycle: &Cycle) -> Option<Special> {
        let width = cycle.closed.equation.width();
        let of = |amplitude: f64| {
            let closed = small(self, cycle.model(), cycle.period(), amplitude).ok()?;
            Cycle::new(closed).ok()
        };
        let (a, b) = (of(AMPLITUDES[0] * width)?, of(AMPLITUDES[1] * width)?);
        let squares = [&a, &b].map(|c| c.amplitude_x0().powi(2));
        let share = squares[0] / (squares[1] - squares[0]);
        let limit = |of: &dyn Fn(&Cycle) -> f64| of(&a) - (of(&b) - of(&a)) * share;
        Some(Special {
            kind: SpecialKind::Hopf,
            alpha: limit(&|c| c.model().alpha()),
            r: limit(&|c| c.model().r()),
            period: limit(&Cycle::period),
            cycle: None,
        })
    }

    /// The period doubling on the branch of half the period.
    fn doubling_near(&self, cycle: &Cycle) -> Option<Special> {
        let half = halved(self, cycle)?;
        let sign = doubling(&half).signum();
        let lengths = (0..SEARCHES).map(|n| NEAREST * 2_f64.powi(n)).flat_map(|ds| [ds, -ds]);
        let beyond = lengths
            .filter_map(|ds| half.step(self, ds).ok())
            .find(|other| doubling(other) * sign < 0.0)?;
        let at = self.locate(&half, &beyond, doubling)?;
        Some(Special::of(SpecialKind::PeriodHalving, at.cycle))
    }
}
