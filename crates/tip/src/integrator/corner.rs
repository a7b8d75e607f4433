//! The kink of |h| with a depth limit: a step stays on one side of it, and ends where h = 0.

use super::Retry;
use crate::collocation::{RADAU, STAGES, Stages};
use crate::elementary::exp;
use crate::history::Heights;
use crate::roots::zero_to;
use crate::state::{Damaged, Reader, State};
use crate::step::{self, Depth};
use crate::{Model, Step};

/// The height under the tip, and the side of the kink on which the next step lies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Corner {
    pub(crate) height: f64,
    /// 1 above, -1 below.
    pub(crate) side: f64,
    /// Whether the last step ended at the kink: polynomials are not extrapolated across it.
    turned: bool,
    /// Largest distance of a step beyond the kink.
    slack: f64,
    /// Round-off of a height.
    round_off: f64,
    /// Depth limit b, and indentation rate α.
    limit: f64,
    alpha: f64,
}

/// Accuracy of the end time of a step, in roundings of t.
const ROUNDINGS_OF_TIME: f64 = 8.0;
/// Weight of the error of heights between the nodes. It may reach the tolerance itself; the error of a step must stay
/// below a small part of the tolerance.
const SHARE_OF_DENSE: f64 = 0.1;
/// Accuracy of heights, in units of α: they are sums of terms of this size, at positions rounded by up to 3e-14.
const ROUND_OFF: f64 = 4e-13;
/// Share of the allowed error for a step on the wrong side of the kink, whose indentation has a relative error of
/// 2|h|/b.
const SHARE: f64 = 0.1;
/// Accuracy of the zero of a height, in units of the slack.
const SHARE_OF_SLACK: f64 = 0.1;

impl Corner {
    /// The kink for a tip that starts at this height; `None` without a depth limit.
    pub(crate) fn of(model: &Model, height: f64, target: f64) -> Option<Self> {
        let limit = model.wider().depth_limit?;
        let size = model.alpha().abs().max(1.0);
        let round_off = ROUND_OFF * size;
        let slack = (SHARE * target * limit / size).max(round_off);
        let side = if height > slack { 1.0 } else { -1.0 };
        Some(Self { height, side, turned: false, slack, round_off, limit, alpha: model.alpha() })
    }

    /// The depth limit on the side of the next step.
    pub(crate) fn depth(&self) -> Depth {
        Depth { limit: self.limit, side: self.side }
    }

    /// Largest change of a velocity per change of h: |α/b|.
    pub(crate) fn strength(&self) -> f64 {
        (self.alpha / self.limit).abs()
    }

    /// Heights in a step from here.
    pub(crate) fn heights(&self, nodes: Stages) -> Heights {
        Heights { start: self.height, nodes }
    }

    /// Largest |height| that counts as 0 in a step of length h from t; it allows for the rounding of t.
    fn slack(&self, heights: &Heights, (t, h): (f64, f64)) -> f64 {
        let rise = heights.rise().iter().fold(0.0, |m: f64, rise| m.max(rise.abs()));
        self.slack.max(ROUNDINGS_OF_TIME * f64::EPSILON * t.abs() * rise / h)
    }

    /// Whether all these heights are on the side of the step, as in most steps.
    pub(crate) fn keeps(&self, heights: &[f64]) -> bool {
        heights.iter().all(|height| self.side * height >= 0.0)
    }

    /// Checks that a step of length h from t stays on its side.
    pub(crate) fn passed(&self, heights: &Heights, (t, h): (f64, f64)) -> Result<(), Retry> {
        if self.keeps(&heights.nodes) {
            return Ok(());
        }
        let slack = self.slack(heights, (t, h));
        let beyond = |height: f64| self.side * height < -slack;
        let Some(after) = heights.nodes.iter().position(|height| beyond(*height)) else {
            return Ok(());
        };
        if heights.start.abs() <= slack {
            return Err(Retry::OtherSide);
        }
        let (end, beyond) = (heights.nodes[STAGES - 1], RADAU.about_the_end(&heights.rise()));
        let (from, to) = self.bracket(heights, after);
        let height = |tau: f64| end + beyond(tau - 1.0);
        let tau = zero_to(height, (from, to), SHARE_OF_SLACK * slack);
        Err(Retry::ToKnot(tau * h))
    }

    /// Bracket of the zero of the height within a step, if this node is the first beyond the kink.
    fn bracket(&self, heights: &Heights, after: usize) -> (f64, f64) {
        let before = after.checked_sub(1).filter(|i| self.side * heights.nodes[*i] > 0.0);
        (before.map_or(0.0, |i| RADAU.c[i]), RADAU.c[after])
    }

    /// Sets the height under the tip, as evaluated by its memory. Returns w there, and σ/b on this side of the kink.
    pub(crate) fn stand_at(&mut self, height: f64) -> (f64, f64) {
        self.height = height;
        if self.side * height < -self.slack {
            self.side = -self.side;
        }
        (exp(-self.side * height / self.limit), self.side / self.limit)
    }

    pub(crate) fn save(&self, state: &mut State) {
        state.number(self.height);
        state.number(self.side);
        state.flag(self.turned);
    }

    pub(crate) fn restore(&mut self, state: &mut Reader) -> Result<(), Damaged> {
        (self.height, self.side) = (state.finite()?, state.within(1.0)?);
        self.turned = state.flag()?;
        if self.side.abs() < 1.0 { Err(Damaged::OutOfRange) } else { Ok(()) }
    }

    /// Updates height and side after a step has been accepted.
    pub(crate) fn arrive(&mut self, step: &Step) {
        let Some(heights) = &step.height else { return };
        self.height = heights.nodes[STAGES - 1];
        let slack = self.slack(heights, (step.t, step.h));
        // A height that stays where it is, as in steady motion, goes to no side: its rate is round-off.
        let rate = (self.height.abs() <= slack).then(|| RADAU.slope(&heights.rise(), 1.0));
        let turns = rate.filter(|rate| rate.abs() > slack);
        self.turned = turns.is_some();
        self.side = if turns.unwrap_or(self.height) > 0.0 { 1.0 } else { -1.0 };
    }

    /// Changes the side for the next attempt; false if the other side has already been tried.
    pub(crate) fn turn(&mut self) -> bool {
        self.side = -self.side;
        !std::mem::replace(&mut self.turned, true)
    }

    /// The heights of the last step, extrapolated over a step of length h.
    pub(crate) fn ahead(&self, last: Option<&Step>, h: f64) -> Stages {
        let Some((last, heights)) = self.same_side(last).filter(|(last, _)| h <= 1.5 * last.h)
        else {
            return [self.height; STAGES];
        };
        RADAU.continued(&heights.rise(), h / last.h).map(|rise| self.height + rise)
    }

    /// The last step with its heights, if it is on the same side of the kink.
    fn same_side<'b>(&self, last: Option<&'b Step>) -> Option<(&'b Step, Heights)> {
        let last = last.filter(|_| !self.turned)?;
        Some((last, last.height?))
    }

    /// Error of the heights as a polynomial of time, estimated with the last step and converted to an error of the
    /// displacement.
    pub(crate) fn error(&self, heights: &Heights, last: Option<&Step>, h: f64) -> f64 {
        let Some((last, before)) = self.same_side(last) else { return 0.0 };
        let error = step::interpolation_error(&heights.rise(), h, (&before.rise(), last.h));
        let error = (error - self.round_off).max(0.0);
        let depth = heights.nodes[STAGES - 1].abs().max(1.0);
        // Error of the displacement per error of h in the step.
        let weight = 1.0 + self.alpha / self.limit;
        SHARE_OF_DENSE * error * weight.min(1.0).max(weight / depth) / depth
    }
}
