//! Length of a step by series.

use super::super::Integrator;
use super::pieces::{self, MOST_PIECES};
use super::series::{MOST_ORDER, Series};
use super::values::Outlook;
use super::{MOST_SHORTENINGS, SHARE_OF_SERIES, length};
use crate::step;

pub(super) struct Plan {
    pub(super) length: f64,
    pub(super) pieces: usize,
    /// Largest speed in the step, approximately.
    pub(super) fastest: f64,
}

/// Allowed interpolation error of a piece, in units of the tolerance; it does not propagate.
pub(crate) const SHARE_OF_INTERPOLATION: f64 = 0.1;
/// Largest displacement in a piece, relative to that in a step of collocation.
pub(crate) const REACH_OF_PIECE: f64 = 0.7;
/// Largest displacement in a step by series, relative to that in a piece.
pub(crate) const FARTHEST: f64 = 3.0;

/// The length of a step, at most `over`, with a displacement of at most `longest`, and the properties of the series
/// over it.
pub(crate) fn within(series: &Series, mut over: f64, longest: f64) -> (f64, Outlook) {
    let mut outlook = Outlook::of(&series.over(over));
    for _ in 0..MOST_SHORTENINGS {
        let moved = outlook.moved.abs();
        if moved <= longest {
            break;
        }
        over *= (0.9 * longest / moved).max(0.3);
        outlook = Outlook::of(&series.over(over));
    }
    (over, outlook)
}

/// The length, adapted as in collocation: the step ends at `distance`, or leaves enough for another step.
pub(crate) fn to_end(length: f64, distance: f64) -> f64 {
    if length >= distance * (1.0 - 1e-9) {
        distance
    } else if 2.0 * length > distance {
        0.5 * distance
    } else {
        length
    }
}

/// Number of pieces of at most this length.
pub(crate) fn count(length: f64, piece: f64) -> usize {
    let pieces = length / piece;
    // Not by `ceil`, for which older processors have no instruction.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a count")]
    let whole = pieces as usize;
    let begun = usize::from((whole as f64) < pieces);
    whole.saturating_add(begun).clamp(1, MOST_PIECES)
}

impl Integrator<'_> {
    /// Length of a step, and number of its pieces; `None` if a step of collocation is longer.
    pub(super) fn plan(&mut self, end: f64) -> Option<Plan> {
        let series = self.taylor.chain.displacement();
        let displacement = series.coefficients();
        let error = SHARE_OF_SERIES * self.control.target();
        let mut over = length::length(displacement, error).min(self.force.longest_step(self.t));
        if let Some(mass) = self.model.wider().inertia {
            // An error of the velocity leads so far astray before friction has used it up.
            let coasting = displacement.iter().zip(0_u32..).map(|(c, k)| mass * f64::from(k) * c);
            let mut coefficients = [0.0; MOST_ORDER + 1];
            coefficients.iter_mut().zip(coasting).for_each(|(c, coasting)| *c = coasting);
            over = over.min(length::length(&coefficients[1..displacement.len()], error));
        }
        over = over.min(self.length_by_heights(error)).min(self.longest_healing());
        let limited = self.reach_of_piece();
        let healing = self.model.wider().healing_time.map_or(0.0, |time| over / time);
        let longest = (FARTHEST * limited).min(self.taylor.visits.farthest(healing));
        let (over, outlook) = within(series, over, longest);
        let error = SHARE_OF_INTERPOLATION * self.control.tolerance();
        let steepest = outlook.steepest.max(self.steepness_of_heights(over));
        let piece = pieces::longest(steepest, error);
        let piece = over * piece.min(limited / outlook.moved.abs().max(f64::MIN_POSITIVE));
        let length = over.min(MOST_PIECES as f64 * piece);
        let fastest = outlook.fastest / over;
        let fades = self.fastest(-self.taylor.chain.curvature());
        // A step of collocation leads no farther either.
        let most = self.reach_of_piece() / (REACH_OF_PIECE * fastest.max(f64::MIN_POSITIVE));
        if self.taylor.switch.leaves(fades * length, fades * most, self.taylor.order) {
            return None;
        }
        let length = to_end(length, end - self.t);
        Some(Plan { length, pieces: count(length, piece), fastest })
    }

    /// Longest step on a surface that heals: the quadrature rules for nodes have a limited order, and beyond the
    /// order of the series the terms of e^{-t/T} must decrease by half from one to the next.
    fn longest_healing(&self) -> f64 {
        let by_order = 0.5 * self.taylor.order as f64;
        let times = self.taylor.visits.most_healing().min(by_order);
        self.model.wider().healing_time.map_or(f64::INFINITY, |time| times * time)
    }

    /// Largest displacement in a piece, whose nodes represent its contribution to the groove, and from which surfaces
    /// are computed.
    fn reach_of_piece(&self) -> f64 {
        REACH_OF_PIECE * step::longest_displacement(self.model.tip().band())
    }
}
