//! Kink crossings under a depth limit: a step should end where the height under the tip passes through 0.
//!
//! If a step ends a time δ from the crossing, w is wrong by 2|h|/b for this time. This shifts the force by 2α|h|δ/b,
//! which falls as δ²: after a few rounds of moving the mesh to the crossings the shift is negligible.

use super::carved::Heights;
use super::embedding::Embedding;
use super::orbit::Orbit;
use stickslip_tip::collocation::{RADAU, STAGES, Stages};
use stickslip_tip::roots::zero_between;

/// Heights below this fraction of the largest count as 0.
const ROUND_OFF: f64 = 1e-13;
/// Crossings closer than this, as a fraction of the period, are ignored.
const CLOSEST: f64 = 1e-7;
/// Largest shift of the force by steps close to the crossings, in units of the allowed residual.
const SHARE: f64 = 1e-4;

impl Heights {
    /// These heights, with the side of the kink on which most of them lie.
    pub(super) fn new(nodes: Stages) -> Self {
        let side = if nodes.iter().sum::<f64>() > 0.0 { 1.0 } else { -1.0 };
        Self { nodes, side }
    }
}

impl Orbit {
    /// Side of the kink of a step; 1 if there is no depth limit.
    pub(super) fn side(&self, step: usize) -> f64 {
        self.heights.get(step).map_or(1.0, |heights| heights.side)
    }

    /// The crossings, as fractions of the period.
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

    /// Whether steps end at these crossings, within a small fraction of the allowed residual, and lie on their assumed
    /// sides.
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

    /// The mesh with its nearest points moved to the crossings, and the points between them shifted accordingly;
    /// `None` if there is not one point for each crossing.
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

    /// The interior point of the mesh that is nearest to `at`.
    fn nearest(&self, at: f64) -> usize {
        let after = self.mesh.partition_point(|end| *end < at).clamp(1, self.mesh.len() - 1);
        let is_before = after > 1 && at - self.mesh[after - 1] < self.mesh[after] - at;
        if is_before { after - 1 } else { after.min(self.mesh.len() - 2).max(1) }
    }
}
