//! The past of a retreating tip: Gaussians on a lattice along the scan, for each layer across.
//!
//! As [rows](super::earlier) represent the grooves of earlier scans, points `x_j` = jh of a lattice along the scan
//! represent the past. With q² = w² - s²,
//!
//! ```text
//!     e^{-(x-x')²/2w²} = (w h/(√(2π) s q)) Σ_j e^{-(x-x_j)²/2q²} e^{-(x_j-x')²/2s²}
//! ```
//!
//! So the contributions of each node to the lattice points close to it represent the whole past, for motion in both
//! directions. They cost more than exponentials, which are valid on one side only, and yield no series.

use super::earlier::{self, NOTHING, Reading, RowLattice, reach};
use super::layered::{Integrals, Layered};
use super::layers::{LANES, Lanes, add_all, recenter, resized};
use crate::TipFunction;
use crate::elementary::exp;
use crate::memory::SteadyPast;
use crate::state::{Damaged, Reader, State};

/// Distance behind the farthest point within which lattice points are kept: the larger of this number of smallest
/// widths and this number of reaches of f, some 700 points for (48).
const KEPT: (f64, f64) = (250.0, 4.0);

/// Lattice points that have been close to the tip, in their order along the scan.
#[derive(Debug, Clone)]
pub(super) struct Lattice {
    /// h and s
    spacing: f64,
    spread: f64,
    /// The Gaussian of the contribution of a node.
    left: TipFunction,
    /// The Gaussians of f.
    terms: Vec<Reading>,
    /// Distance beyond which lattice points have no effect; distance behind the farthest point within which they are
    /// kept.
    reach: f64,
    kept: f64,
    groups: usize,
    /// Layers of successive lattice points.
    nodes: Vec<Lanes>,
    /// The first lattice point, as a displacement from the tip.
    first: f64,
    farthest: f64,
}

impl Lattice {
    /// The lattice for this footprint along the scan; `None` if it is not a sum of Gaussians.
    pub(super) fn new(tip: &TipFunction) -> Option<Self> {
        let TipFunction::Gaussians(sum) = tip else { return None };
        let smallest = sum.terms().iter().map(|g| g.width).fold(f64::INFINITY, f64::min);
        let lattice = RowLattice::for_widths(std::iter::once(smallest));
        let (spacing, spread) = lattice.lengths();
        let terms: Vec<Reading> = sum.terms().iter().map(|g| lattice.reading(*g)).collect();
        let reach = reach(&terms);
        Some(Self {
            left: TipFunction::gaussian(spread).ok()?,
            kept: (KEPT.0 * smallest).max(KEPT.1 * reach),
            spacing,
            spread,
            terms,
            reach,
            groups: 0,
            nodes: vec![],
            first: 0.0,
            farthest: f64::NEG_INFINITY,
        })
    }

    fn count(&self) -> usize {
        self.nodes.len().checked_div(self.groups).unwrap_or(0)
    }

    /// Adds the missing lattice points between these displacements.
    fn hold(&mut self, low: f64, high: f64) {
        let (groups, spacing) = (self.groups, self.spacing);
        if self.nodes.is_empty() {
            self.first = low;
        }
        let before = index((self.first - low) / spacing + 1.0);
        if self.first > low {
            let nodes = vec![[0.0; LANES]; before * groups];
            self.nodes.splice(0..0, nodes);
            self.first -= before as f64 * spacing;
        }
        let needed = index((high - self.first) / spacing) + 2;
        if needed > self.count() {
            self.nodes.resize(needed * groups, [0.0; LANES]);
        }
    }

    /// Drops lattice points that are too far behind, many at a time.
    fn forget(&mut self) {
        let behind = (self.farthest - self.first) / self.spacing;
        let kept = self.kept / self.spacing;
        if behind > 1.1 * kept {
            let dropped = index(behind - kept).min(self.count());
            self.nodes.drain(..dropped * self.groups);
            self.first += dropped as f64 * self.spacing;
        }
    }
}

impl Layered for Lattice {
    fn retreat(&self) -> f64 {
        self.kept - self.reach
    }

    fn behind(&self) -> f64 {
        self.farthest
    }

    fn groups(&self) -> usize {
        self.groups
    }

    fn size(&self) -> usize {
        self.nodes.len() * LANES
    }

    fn save(&self, state: &mut State) {
        state.number(self.first);
        state.number(self.farthest);
        state.numbers(self.nodes.as_flattened().iter().copied());
    }

    fn restore(&mut self, state: &mut Reader, groups: Option<usize>) -> Result<(), Damaged> {
        (self.first, self.farthest) = (state.finite()?, state.number()?);
        let (nodes, groups) = (state.numbers()?, groups.ok_or(Damaged::OutOfRange)?);
        if !nodes.len().is_multiple_of(groups * LANES) {
            return Err(Damaged::OutOfRange);
        }
        self.nodes = nodes.as_chunks::<LANES>().0.to_vec();
        self.groups = groups;
        Ok(())
    }

    fn resize(&mut self, groups: usize) {
        self.nodes = resized(&self.nodes, self.groups, (self.count(), groups));
        self.groups = groups;
    }

    fn recenter(&mut self, distance: f64) {
        recenter(distance, &mut self.nodes, self.groups);
    }

    fn fade(&mut self, factor: f64) {
        self.nodes.as_flattened_mut().iter_mut().for_each(|z| *z *= factor);
    }

    fn remember_steady(&mut self, past: &SteadyPast, phi: &[Lanes]) {
        let end = -past.distance;
        self.hold(end - self.kept, end + NOTHING * self.spread);
        for (j, node) in self.nodes.chunks_exact_mut(self.groups).enumerate() {
            let x = self.first + j as f64 * self.spacing;
            let left = self.left.fading_tail(x - end, past.healing / past.velocity);
            let weight = past.weight * left / past.velocity;
            add_all(node, phi, weight);
        }
        self.farthest = self.farthest.max(end);
    }

    fn remember(&mut self, position: &[f64], weighted: &[Lanes]) {
        let Some(moved) = position.last() else { return };
        let near = NOTHING * self.spread;
        for (position, weighted) in position.iter().zip(weighted.chunks_exact(self.groups)) {
            self.hold(position - near, position + near);
            let from = index((position - near - self.first) / self.spacing);
            let nodes = self.nodes.chunks_exact_mut(self.groups).enumerate().skip(from);
            for (j, node) in nodes.take(index(2.0 * near / self.spacing) + 2) {
                let z = (self.first + j as f64 * self.spacing - position) / self.spread;
                add_all(node, weighted, exp(-0.5 * z * z));
            }
            self.farthest = self.farthest.max(*position);
        }
        self.first -= moved;
        self.farthest -= moved;
        self.forget();
    }

    fn at(&self, displacement: f64, jet: &mut Integrals<'_>) {
        jet.iter_mut().for_each(|told| told.fill([0.0; LANES]));
        let from = index((displacement - self.reach - self.first) / self.spacing);
        let nodes = self.nodes.chunks_exact(self.groups).enumerate().skip(from);
        for (j, node) in nodes.take(index(2.0 * self.reach / self.spacing) + 2) {
            let distance = displacement - (self.first + j as f64 * self.spacing);
            let sums = earlier::jet(self.terms.iter().copied(), distance);
            for (integral, sum) in jet.iter_mut().zip(sums) {
                add_all(integral, node, sum);
            }
        }
    }
}

/// Conversion to a count; 0 for negative numbers.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "held above 0")]
fn index(x: f64) -> usize {
    x.max(0.0) as usize
}

#[cfg(test)]
mod tests {
    use super::super::layers::values;
    use super::*;
    use crate::Gaussian;

    /// Visits by themselves are the oracle, on a way forth and back; of a steady past a fine sum of them.
    #[test]
    fn nodes_stand_for_all_visits() {
        let widths = [(1.0, 0.0, 1.0), (-0.4, 2.0, 0.7), (-0.4, -2.0, 0.7)];
        let terms = widths.map(|(amplitude, center, width)| Gaussian { amplitude, center, width });
        let tip = TipFunction::gaussian_sum(terms.to_vec()).unwrap();
        let mut lattice = Lattice::new(&tip).unwrap();
        lattice.resize(4);
        let mut phi = vec![[0.0; LANES]; 4];
        let (healing, velocity) = (0.2, 0.8);
        values(0.3, 1.0, &mut phi);
        let past = SteadyPast { distance: -0.4, velocity, healing, weight: 0.9 };
        lattice.remember_steady(&past, &phi);
        let dt = 1e-3;
        let steady = (0..60_000).map(|i| {
            let ago = dt * (f64::from(i) + 0.5);
            (0.4 - velocity * ago, 0.3, 0.9 * dt * (-healing * ago).exp())
        });
        let mut visits: Vec<(f64, f64, f64)> = steady.collect();
        for n in 0..30 {
            let way = |part: f64| part * if n < 20 { 0.8 } else { -1.3 };
            let positions = [0.25, 0.6, 1.0].map(way);
            let mut weighted = vec![[0.0; LANES]; 12];
            for (k, weighted) in weighted.chunks_exact_mut(4).enumerate() {
                let (eta, weight) = (0.5 * (0.7 * (3 * n + k) as f64).sin(), 0.3);
                values(eta, weight, weighted);
                visits.push((positions[k], eta, weight));
            }
            lattice.remember(&positions, &weighted);
            visits.iter_mut().for_each(|visit| visit.0 -= positions[2]);
        }
        let mut told = vec![[0.0; LANES]; 12];
        for (d, eta) in [(0.0, 0.1), (0.7, -0.5), (-2.3, 0.6)] {
            lattice.at(d, &mut told.get_disjoint_mut([0..4, 4..8, 8..12]).unwrap());
            values(eta, 1.0, &mut phi);
            for (n, told) in told.chunks_exact(4).enumerate() {
                let of = |xi: f64| [tip.value(xi), tip.slope(xi), tip.slope_and_curvature(xi).1][n];
                let h = |y: f64| (-0.5 * (eta - y) * (eta - y)).exp();
                let exact: f64 = visits.iter().map(|(x, y, w)| w * of(d - x) * h(*y)).sum();
                let pairs = phi.as_flattened().iter().zip(told.as_flattened());
                let sum: f64 = pairs.map(|(a, b)| a * b).sum();
                // The steady past is summed by the midpoint rule, and cut at its end.
                assert!((sum - exact).abs() < 3e-7, "{d} {n}: {sum} {exact}");
            }
        }
    }

    #[test]
    fn nodes_far_behind_are_forgotten() {
        let mut lattice = Lattice::new(&TipFunction::default()).unwrap();
        lattice.resize(2);
        let weighted = vec![[1.0; LANES]; 2];
        let mut most = 0;
        for _ in 0..2000 {
            lattice.remember(&[1.0], &weighted);
            most = most.max(lattice.count());
        }
        assert!((680..820).contains(&most), "{most}");
    }
}
