//! The height under the tip in a series: how long it lets a step be, on which side of the corner the step is, and what
//! visits weigh.

use super::super::corner::Corner;
use super::super::{Integrator, Retry};
use super::series::Series;
use super::values::{Block, Outlook, Table};
use super::{length, visits};
use crate::collocation::STAGES;
use crate::elementary::exp;
use crate::history::Heights;

/// Heights as polynomials are wanted to the tolerance itself, of which an error of a series is allowed a small part.
const SHARE_OF_DENSE: f64 = 0.05;

/// What becomes of a step at the corner of |h|.
pub(crate) enum AtCorner {
    /// It keeps to its side.
    Apart,
    /// It is to end there, so long after its start.
    Ends(f64),
    /// It began there, and went the other way.
    OtherSide,
}

impl Integrator<'_> {
    /// w now and σ/b, from the series as it starts.
    pub(super) fn weight_now(&mut self) -> Option<(f64, f64)> {
        let corner = self.corner.as_mut()?;
        let limit = self.model.wider().depth_limit?;
        corner.stand_at(-self.taylor.chain.depth_now());
        Some((exp(-corner.side * corner.height / limit), corner.side / limit))
    }

    /// How long a step may be for its heights to err by so little that it does not show in the displacement.
    pub(super) fn length_by_heights(&self, error: f64) -> f64 {
        let Some((corner, limit)) = self.corner.as_ref().zip(self.model.wider().depth_limit) else {
            return f64::INFINITY;
        };
        let strength = (self.model.alpha() / limit).abs();
        length_by_heights(corner, self.taylor.chain.height(), strength, error)
    }

    /// How steep the heights over this length are, as an interpolant of them errs beside one of the displacement.
    pub(super) fn steepness_of_heights(&self, length: f64) -> f64 {
        let Some(corner) = &self.corner else { return 0.0 };
        steepness(corner, &self.taylor.chain.height().over(length))
    }

    /// Heights at the nodes of a step of this length, where there is a depth limit.
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

    /// Times spent at the nodes of a step of this length, each times what it weighs under a depth limit.
    pub(super) fn weigh(&self, table: &Table, length: f64, spent: &mut [f64]) {
        if self.corner.is_none() {
            return;
        }
        let weights = self.taylor.chain.weights().over(length);
        let mut room = visits::ROOM;
        let weights = table.sums(&weights, &mut room);
        spent.iter_mut().zip(weights).for_each(|(spent, weight)| *spent *= *weight);
    }

    /// The place of the corner |u| = 0 relative to a step whose pieces have these heights.
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

/// Ratio of the interpolation error of the heights over a step to that of the displacement.
pub(crate) fn steepness(corner: &Corner, over_step: &Series) -> f64 {
    Outlook::of(over_step).steepest / depth(corner)
}

/// The place of the corner |u| = 0 relative to a step from t whose pieces have these heights.
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

/// As large as a height is, its error counts relative to it.
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
    /// Of pieces.
    fn count(&self) -> usize {
        self.nodes.len() / STAGES
    }

    pub(crate) fn piece(&self, i: usize) -> Heights {
        let nodes = self.nodes.as_chunks().0;
        let start = if i == 0 { self.start } else { nodes[i - 1][STAGES - 1] };
        Heights { start, nodes: nodes[i] }
    }
}
