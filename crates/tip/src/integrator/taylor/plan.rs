//! Length of a step by series, in one coordinate or in two.

use super::super::control::Control;
use super::super::corner::Corner;
use super::heights::length_by_heights;
use super::length::{length, order};
use super::pieces::{self, MOST_PIECES};
use super::series::{MOST_ORDER, Series};
use super::switch::Switch;
use super::values::Outlook;
use super::visits::Visits;
use crate::Wider;
use crate::elementary::{larger, smaller};
use crate::step::longest_displacement;

pub(crate) struct Plan {
    pub(crate) length: f64,
    pub(crate) pieces: usize,
    /// Largest speed in the step, approximately.
    pub(crate) fastest: f64,
}

/// Order of the series of a run, and limits on their steps.
#[derive(Debug, Clone)]
pub(crate) struct Limits {
    pub(crate) order: usize,
    /// Allowed truncation error of a series.
    pub(crate) error: f64,
    /// Allowed interpolation error of a piece.
    pub(crate) of_piece: f64,
    /// Largest displacement in a piece, whose nodes represent its contribution to the groove, and from which surfaces
    /// are computed.
    pub(crate) reach: f64,
    pub(crate) visits: Visits,
}

/// Allowed truncation error of a series, relative to the error allowed in a step of collocation: there are fewer steps,
/// but no other measure of their errors.
const SHARE_OF_SERIES: f64 = 0.1;
/// Allowed error of the weights of nodes, relative to the error allowed in a step of collocation.
const SHARE_OF_VISITS: f64 = 0.0005;
/// Allowed interpolation error of a piece, in units of the tolerance; it does not propagate.
const SHARE_OF_INTERPOLATION: f64 = 0.1;
/// Largest displacement in a piece, relative to that in a step of collocation.
const REACH_OF_PIECE: f64 = 0.7;
/// Largest displacement in a step by series, relative to that in a piece.
const FARTHEST: f64 = 3.0;
/// Largest number of times that a step is shortened to remain where its series is valid; then collocation continues.
pub(crate) const MOST_SHORTENINGS: usize = 8;

impl Limits {
    /// The limits for a footprint of this bandwidth. The order increases by `per_digit` for an error smaller by the
    /// factor e.
    pub(crate) fn new(band: f64, tolerance: f64, per_digit: f64) -> Self {
        let target = Control::new(tolerance).target();
        let error = SHARE_OF_SERIES * target;
        Self {
            order: order(error, per_digit),
            error,
            of_piece: SHARE_OF_INTERPOLATION * tolerance,
            reach: REACH_OF_PIECE * longest_displacement(band),
            visits: Visits::new(band, SHARE_OF_VISITS * target),
        }
    }

    /// The length over which the series of the displacement along the scan is accurate and, with a depth limit, that of
    /// the heights.
    pub(crate) fn accurate(
        &self,
        along: &Series,
        heights: Option<(&Corner, &Series)>,
        wider: &Wider,
    ) -> f64 {
        let mut over = length(along.coefficients(), self.error);
        if let Some(mass) = wider.inertia {
            // An error of the velocity leads so far astray before friction has used it up.
            let mut coasting = [0.0; MOST_ORDER + 1];
            for (k, c) in along.coefficients().iter().enumerate() {
                coasting[k] = mass * k as f64 * c;
            }
            over = smaller(length(&coasting[1..=self.order], self.error), over);
        }
        if let Some((corner, height)) = heights {
            over = smaller(length_by_heights(corner, height, self.error), over);
        }
        if let Some(time) = wider.healing_time {
            // The quadrature rules for nodes have a limited order, and beyond the order of the series the terms of
            // e^{-t/T} must decrease by half from one to the next.
            let times = smaller(0.5 * self.order as f64, self.visits.most_healing());
            over = smaller(times * time, over);
        }
        over
    }

    /// The largest displacement in a step of this number of healing times.
    pub(crate) fn farthest(&self, healing: f64) -> f64 {
        smaller(self.visits.farthest(healing), FARTHEST * self.reach)
    }

    /// The largest time of a step of collocation at this speed: it leads no farther than a few pieces either.
    pub(crate) fn longest_stages(&self, speed: f64) -> f64 {
        self.reach / (REACH_OF_PIECE * larger(speed, f64::MIN_POSITIVE))
    }

    /// The plan of a step that ends within this distance in time, from the properties of its series over the length
    /// `over`. `stiffness` is the largest rate at which the tip relaxes. `None` if a step of collocation is longer.
    pub(crate) fn plan(
        &self,
        switch: &mut Switch,
        (over, outlook): (f64, Outlook),
        stiffness: f64,
        distance: f64,
    ) -> Option<Plan> {
        let fewest = pieces::fewest(outlook.steepest, self.of_piece);
        let pieces = fewest.min(MOST_PIECES).max(count(outlook.moved.abs(), self.reach));
        let longest = if fewest > MOST_PIECES {
            over * MOST_PIECES as f64 * pieces::longest(outlook.steepest, self.of_piece)
        } else {
            over
        };
        let fastest = outlook.fastest / over;
        let most = self.longest_stages(fastest);
        if switch.leaves(stiffness * longest, stiffness * most, self.order) {
            return None;
        }
        let length = to_end(longest, distance);
        let is_shorter = length < longest;
        let fewer = if is_shorter { count(pieces as f64 * length, longest) } else { pieces };
        Some(Plan { length, pieces: fewer.min(pieces), fastest })
    }
}

/// The length of a step, at most `over`, with a displacement of at most `longest`, and the properties of the series
/// over it.
pub(crate) fn within(
    mut over: f64,
    longest: f64,
    outlook_over: impl Fn(f64) -> Outlook,
) -> (f64, Outlook) {
    let mut outlook = outlook_over(over);
    for _ in 0..MOST_SHORTENINGS {
        let moved = outlook.moved.abs();
        if moved <= longest {
            break;
        }
        over *= (0.9 * longest / moved).max(0.3);
        outlook = outlook_over(over);
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
