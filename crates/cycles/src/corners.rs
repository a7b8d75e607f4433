//! The corners of |h| under a depth limit: where the height under the tip passes through 0, a step is to end.
//!
//! A step that ends a time δ beside the corner has w wrong by 2|h|/b for so long. That shifts the force by α times the
//! product, which falls as δ²: a mesh moved to where the corners have been found is right after a few rounds.

use super::carved::Heights;
use super::embedding::Embedding;
use super::orbit::Orbit;
use stickslip_tip::collocation::{RADAU, STAGES, Stages};
use stickslip_tip::roots::zero_between;

/// Heights below this part of the largest are 0.
const ROUND_OFF: f64 = 1e-13;
/// Corners nearer to each other, as a part of the period, are none.
const CLOSEST: f64 = 1e-7;
/// What steps beside the corners may shift the force by, over the residual allowed.
const SHARE: f64 = 1e-4;

impl Heights {
    /// On the side that most of them are on.
    pub(super) fn new(nodes: Stages) -> Self {
        let side = if nodes.iter().sum::<f64>() > 0.0 { 1.0 } else { -1.0 };
        Self { nodes, side }
    }
}

impl Orbit {
    /// On which side of the corner a step is; 1 where there is none.
    pub(super) fn side(&self, step: usize) -> f64 {
        self.heights.get(step).map_or(1.0, |heights| heights.side)
    }

    /// The corners, as fractions of the period.
    pub(super) fn corners(&self, r: f64) -> Vec<f64> {
        if self.heights.is_empty() {
            return vec![];
        }
        let motion = self.trajectory(r);
        let nodes = self.heights.iter().flat_map(|heights| heights.nodes);
        let largest = nodes.fold(0.0, |m: f64, height| m.max(height.abs()));
        let height = |t: f64| motion.height(t).unwrap_or_default();
        let (mut corners, mut last) = (vec![], None::<(f64, f64)>);
        for step in motion.steps() {
            let nodes = RADAU.c.iter().zip(step.height.map_or([0.0; STAGES], |h| h.nodes));
            for (c, here) in nodes.filter(|(_, height)| height.abs() > ROUND_OFF * largest) {
                let t = step.t + c * step.h;
                if let Some((before, _)) = last.filter(|(_, height)| height * here < 0.0) {
                    corners.push(zero_between(height, before, t) / self.period);
                }
                last = Some((t, here));
            }
        }
        // What is so near to the seam, or to the next, is not worth a step.
        let mut end = 0.0;
        corners.retain(|corner| {
            let apart = corner - end > CLOSEST && 1.0 - corner > CLOSEST;
            end = if apart { *corner } else { end };
            apart
        });
        corners
    }

    /// Whether steps end at these corners, to a small part of the residual allowed, and lie on the sides that they are
    /// taken for.
    pub(super) fn meets(&self, corners: &[f64], equation: &Embedding, allowed: f64) -> bool {
        let Some(limit) = equation.wider.depth_limit else { return true };
        let is_right = |h: &Heights| h.nodes.iter().sum::<f64>() * h.side >= 0.0;
        let is_met = |corner: &f64| {
            let nearest = self.nearest(*corner);
            let off = (self.mesh[nearest] - corner).abs() * self.period;
            let height = self.heights[nearest - 1].nodes[STAGES - 1].abs();
            2.0 * equation.alpha * height / limit * off <= SHARE * allowed
        };
        self.heights.iter().all(is_right) && corners.iter().all(is_met)
    }

    /// The mesh with its points beside the corners moved there, and those between along with them; `None` where there
    /// is not one point for each.
    pub(super) fn moved_to(&self, corners: &[f64]) -> Option<Vec<f64>> {
        let places: Vec<usize> = corners.iter().map(|corner| self.nearest(*corner)).collect();
        let last = self.mesh.len() - 1;
        let turns = (1..last).filter(|n| self.side(n - 1) * self.side(*n) < 0.0);
        if !turns.eq(places.iter().copied()) {
            return None;
        }
        let (mut mesh, mut from, mut start) = (vec![0.0], 0, 0.0);
        let ends = places.iter().copied().zip(corners.iter().copied()).chain([(last, 1.0)]);
        for (to, end) in ends {
            let (low, high) = (self.mesh[from], self.mesh[to]);
            let moved = |at: &f64| start + (at - low) / (high - low) * (end - start);
            mesh.extend(self.mesh[from + 1..to].iter().map(moved));
            mesh.push(end);
            (from, start) = (to, end);
        }
        Some(mesh)
    }

    /// The point of the mesh, between its ends, that is nearest.
    fn nearest(&self, at: f64) -> usize {
        let after = self.mesh.partition_point(|end| *end < at).clamp(1, self.mesh.len() - 1);
        let is_before = after > 1 && at - self.mesh[after - 1] < self.mesh[after] - at;
        if is_before { after - 1 } else { after.min(self.mesh.len() - 2).max(1) }
    }
}
