//! The height under the tip in a step by series: limits on the length of the step, its side of the kink, and the
//! weights w of visits.

use super::super::corner::Corner;
use super::super::{Integrator, Retry};
use super::series::Series;
use super::values::{Block, Outlook, Table};
use super::{length, visits};
use crate::collocation::STAGES;
use crate::elementary::exp;
use crate::history::Heights;

/// Weight of the error of heights between the nodes. It may reach the tolerance itself; the error of a series must stay
/// below a small part of the tolerance.
const SHARE_OF_DENSE: f64 = 0.05;

/// Position of a step relative to the kink of |h|.
pub(crate) enum AtCorner {
    /// The step stays on its side.
    Apart,
    /// The step must end at the kink, this time after its start.
    Ends(f64),
    /// The step began at the kink, and moved to the other side.
    OtherSide,
}

impl Integrator<'_> {
    /// w at the start of the series and σ/b; `None` without a depth limit.
    pub(super) fn weight_now(&mut self) -> Option<(f64, f64)> {
        let corner = self.corner.as_mut()?;
        let limit = self.model.wider().depth_limit?;
        corner.stand_at(-self.taylor.chain.depth_now());
        Some((exp(-corner.side * corner.height / limit), corner.side / limit))
    }

    /// As [`length_by_heights`]; infinite without a depth limit.
    pub(super) fn length_by_heights(&self, error: f64) -> f64 {
        let Some((corner, limit)) = self.corner.as_ref().zip(self.model.wider().depth_limit) else {
            return f64::INFINITY;
        };
        let strength = (self.model.alpha() / limit).abs();
        length_by_heights(corner, self.taylor.chain.height(), strength, error)
    }

    /// As [`steepness`], over a step of this length; 0 without a depth limit.
    pub(super) fn steepness_of_heights(&self, length: f64) -> f64 {
        let Some(corner) = &self.corner else { return 0.0 };
        steepness(corner, &self.taylor.chain.height().over(length))
    }

    /// Heights at the nodes of a step of this length; `None` without a depth limit.
    #[inline]
    pub(super) fn heights_over<'a>(
        &self,
        length: f64,
        table: &Table,
        room: &'a mut [Block],
    ) -> Option<Along<'a>> {
        self.corner.as_ref()?;
        let height = self.taylor.chain.height();
        Some(Along { start: height.start(), nodes: table.sums(&height.over(length), room) })
    }

    /// Multiplies the times spent at the nodes of a step of this length by w.
    pub(super) fn weigh(&self, table: &Table, length: f64, spent: &mut [f64]) {
        if self.corner.is_none() {
            return;
        }
        let weights = self.taylor.chain.weights().over(length);
        let mut room = visits::ROOM;
        let weights = table.sums(&weights, &mut room);
        spent.iter_mut().zip(weights).for_each(|(spent, weight)| *spent *= *weight);
    }

    /// As [`at_corner`]; `Apart` without a depth limit.
    pub(super) fn at_corner(&self, heights: Option<Along>, total: f64) -> AtCorner {
        let Some((corner, heights)) = self.corner.as_ref().zip(heights) else {
            return AtCorner::Apart;
        };
        at_corner(corner, &heights, (self.t, total))
    }
}

/// Longest step over which the error of the heights changes a displacement by at most `error`; `strength` is α/b.
pub(crate) fn length_by_heights(
    corner: &Corner,
    height: &Series,
    strength: f64,
    error: f64,
) -> f64 {
    let felt = strength + SHARE_OF_DENSE / depth(corner);
    length::length(height.coefficients(), error / felt)
}

/// Largest divided difference of the heights over a step, relative to the larger of 1 and the height.
pub(crate) fn steepness(corner: &Corner, over_step: &Series) -> f64 {
    Outlook::of(over_step).steepest / depth(corner)
}

/// Position, relative to the kink, of a step of length `total` from t whose pieces have these heights.
pub(crate) fn at_corner(corner: &Corner, heights: &Along, (t, total): (f64, f64)) -> AtCorner {
    if corner.keeps(heights.nodes) {
        return AtCorner::Apart;
    }
    let h = total / heights.count() as f64;
    for i in 0..heights.count() {
        let before = i as f64 * h;
        match corner.passed(&heights.piece(i), (t + before, h)) {
            Ok(()) => {}
            Err(Retry::ToKnot(shorter)) => return AtCorner::Ends(before + shorter),
            Err(_) if i > 0 => return AtCorner::Ends(before),
            Err(_) => return AtCorner::OtherSide,
        }
    }
    AtCorner::Apart
}

/// The scale of errors of the height: its absolute value, but at least 1.
fn depth(corner: &Corner) -> f64 {
    corner.height.abs().max(1.0)
}

/// Heights along a step, at the nodes of all its pieces.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Along<'a> {
    pub(crate) start: f64,
    pub(crate) nodes: &'a [f64],
}

impl Along<'_> {
    fn count(&self) -> usize {
        self.nodes.len() / STAGES
    }

    pub(crate) fn piece(&self, i: usize) -> Heights {
        let nodes = self.nodes.as_chunks().0;
        let start = if i == 0 { self.start } else { nodes[i - 1][STAGES - 1] };
        Heights { start, nodes: nodes[i] }
    }
}
