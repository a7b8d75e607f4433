//! The height under the tip in a step by series: limits on the length of the step, and its side of the kink.

use super::super::Retry;
use super::super::corner::Corner;
use super::length;
use super::series::Series;
use super::values::{Block, Outlook, Table};
use crate::collocation::STAGES;
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

/// Longest step over which the error of the heights changes a displacement by at most `error`.
pub(super) fn length_by_heights(corner: &Corner, height: &Series, error: f64) -> f64 {
    let felt = corner.strength() + SHARE_OF_DENSE / depth(corner);
    length::length(height.coefficients(), error / felt)
}

/// Largest divided difference of the heights over a step of this length, relative to the larger of 1 and the height; 0
/// without a depth limit.
pub(crate) fn steepness(corner: Option<&Corner>, height: &Series, length: f64) -> f64 {
    corner.map_or(0.0, |corner| Outlook::over(height, length).steepest / depth(corner))
}

/// Position, relative to the kink, of a step of length `total` from t whose pieces have these heights; `Apart` without
/// a depth limit.
pub(crate) fn at_corner(
    corner: Option<&Corner>,
    heights: Option<Along>,
    (t, total): (f64, f64),
) -> AtCorner {
    let Some((corner, heights)) = corner.zip(heights) else { return AtCorner::Apart };
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
    start: f64,
    nodes: &'a [f64],
}

impl<'a> Along<'a> {
    /// The heights of this series over a step of length `total`, stored in `room`.
    #[inline]
    pub(crate) fn over(height: &Series, total: f64, table: &Table, room: &'a mut [Block]) -> Self {
        Self { start: height.at(0), nodes: table.sums(&height.over(total), room) }
    }

    fn count(&self) -> usize {
        self.nodes.len() / STAGES
    }

    pub(crate) fn piece(&self, i: usize) -> Heights {
        let nodes = self.nodes.as_chunks().0;
        let start = if i == 0 { self.start } else { nodes[i - 1][STAGES - 1] };
        Heights { start, nodes: nodes[i] }
    }
}
