//! The height under the tip in a series: how long it lets a step be, on which side of the corner the step is, and what
//! visits weigh.

use super::super::corner::Corner;
use super::super::{Integrator, Retry};
use super::chain::MOST_ORDER;
use super::pieces::{self, NODES};
use super::values::{Outlook, Scaled, Table};
use super::{length, visits};
use crate::collocation::STAGES;
use crate::elementary::exp;
use crate::history::Heights;
use crate::memory::Memory;

/// Heights as polynomials are wanted to the tolerance itself, of which an error of a series is allowed a small part.
const SHARE_OF_DENSE: f64 = 0.05;

/// What becomes of a step at the corner of |h|.
pub(super) enum AtCorner {
    /// It keeps to its side.
    Apart,
    /// It is to end there, so long after its start.
    Ends(f64),
    /// It began there, and went the other way.
    OtherSide,
}

impl<M: Memory> Integrator<'_, M> {
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
        let felt = (self.model.alpha() / limit).abs() + SHARE_OF_DENSE / depth(corner);
        let mut heights = [0.0; MOST_ORDER];
        let order = self.taylor.chain.heights(&mut heights);
        length::length(&heights[..order], error / felt)
    }

    /// The longest part of this length that may be a piece, for its heights.
    pub(super) fn piece_by_heights(&self, over: f64, error: f64) -> f64 {
        let Some((corner, height)) = self.corner.as_ref().zip(self.height_over(over)) else {
            return f64::INFINITY;
        };
        pieces::longest(&Outlook::of(&height), error * depth(corner))
    }

    /// The height over this length, where there is a depth limit.
    #[inline]
    pub(super) fn height_over(&self, length: f64) -> Option<Scaled> {
        self.corner.as_ref()?;
        let mut heights = [0.0; MOST_ORDER];
        let order = self.taylor.chain.heights(&mut heights);
        Some(Scaled::new(&heights[..order], length))
    }

    /// Times spent at the nodes of a step of this length, each times what it weighs under a depth limit.
    pub(super) fn weigh(&self, table: &Table, length: f64, spent: &mut [f64]) {
        if self.corner.is_none() {
            return;
        }
        let (mut coefficients, mut weights) = ([0.0; MOST_ORDER], [0.0; visits::MOST_NODES]);
        let order = self.taylor.chain.weights(&mut coefficients);
        let weights = &mut weights[..spent.len()];
        table.sums(&Scaled::new(&coefficients[..order], length), weights);
        spent.iter_mut().zip(weights).for_each(|(spent, weight)| *spent *= *weight);
    }

    /// Where the heights of the pieces of a step lead.
    pub(super) fn at_corner(&self, heights: &[Heights], total: f64) -> AtCorner {
        let Some(corner) = &self.corner else { return AtCorner::Apart };
        let h = total / heights.len() as f64;
        for (i, piece) in heights.iter().enumerate() {
            let before = i as f64 * h;
            match corner.passed(piece, (self.t + before, h)) {
                Ok(()) => {}
                Err(Retry::ToKnot(shorter)) => return AtCorner::Ends(before + shorter),
                Err(_) if i > 0 => return AtCorner::Ends(before),
                Err(_) => return AtCorner::OtherSide,
            }
        }
        AtCorner::Apart
    }
}

/// As large as a height is, its error counts relative to it.
fn depth(corner: &Corner) -> f64 {
    corner.height.abs().max(1.0)
}

/// Heights of pieces, from the table of their nodes.
pub(super) fn of_pieces<'a>(
    height: &Scaled,
    table: &Table,
    room: &'a mut [Heights],
) -> &'a [Heights] {
    let mut nodes = [0.0; NODES];
    let nodes = &mut nodes[..STAGES * room.len()];
    table.sums(height, nodes);
    let mut start = height.start();
    for (piece, nodes) in room.iter_mut().zip(nodes.as_chunks().0) {
        *piece = Heights { start, nodes: *nodes };
        start = nodes[STAGES - 1];
    }
    room
}
