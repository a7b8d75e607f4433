//! All that the tip has visited, in a form of bounded size: what a retreat comes back to.
//!
//! New nodes are kept as they are. When there are many they are gathered: the weight w at y within a bin
//! acts on any g that is a polynomial of degree n < p over the bin as the moments `Σ w T_n(y)` do, and those
//! as p weights on the bin's Chebyshev points. A bin is at most 8/band long, little more than the shortest
//! wave in f: the coefficients beyond degree 15 are below 6e-9 of that wave, which itself is below round-off,
//! and below round-off for all that are longer.

mod saved;

use crate::TipFunction;
use crate::collocation::{STAGES, Stages};
use std::collections::VecDeque;
use std::f64::consts::PI;

const MOMENTS: usize = 16;
type Bin = [f64; MOMENTS];

/// Nodes kept as they are.
const MOST_NODES: usize = 1 << 14;
/// Bins kept: what is farther behind is forgotten.
const MOST_BINS: usize = 1 << 12;
/// The origin moves by so many bins.
const BINS_PER_ORIGIN: i64 = 64;

/// The record beside the state. It takes its room once: no step allocates.
#[derive(Debug, Clone)]
pub(super) struct Past {
    reach: f64,
    /// Length of a bin, a power of two: moving the origin by bins is exact.
    length: f64,
    /// Position of the tip, relative to an origin that follows it.
    position: f64,
    nodes: Vec<(f64, f64)>,
    bins: VecDeque<Bin>,
    /// Bin i of the deque is at [i + first, i + first + 1] lengths.
    first: i64,
    /// Whether bins have been dropped behind `first`.
    forgot: bool,
}

impl Past {
    pub(super) fn new(tip: &TipFunction, reach: f64) -> Self {
        let length = (8.0 / tip.band()).log2().floor().exp2();
        Self {
            reach,
            length,
            position: 0.0,
            nodes: Vec::with_capacity(MOST_NODES),
            bins: VecDeque::with_capacity(MOST_BINS),
            first: 0,
            forgot: false,
        }
    }

    /// How far behind the farthest point of the tip the past is kept.
    pub(super) fn kept(&self) -> f64 {
        MOST_BINS as f64 * self.length
    }

    /// Whether something dropped may lie within reach of a displacement from the tip.
    pub(super) fn forgot(&self, at: f64) -> bool {
        self.forgot && self.position + at - self.reach < self.first as f64 * self.length
    }

    /// A time spent at a displacement from the tip.
    pub(super) fn add(&mut self, position: f64, weight: f64) {
        if self.nodes.len() == MOST_NODES {
            self.gather();
        }
        self.nodes.push((self.position + position, weight));
    }

    pub(super) fn remember(&mut self, position: &Stages, weight: &Stages) {
        if self.nodes.len() + STAGES > MOST_NODES {
            self.gather();
        }
        let here = self.position;
        self.nodes.extend(position.iter().zip(weight).map(|(p, w)| (here + p, *w)));
        self.position += position[STAGES - 1];
        if self.position.abs() > 2.0 * BINS_PER_ORIGIN as f64 * self.length {
            self.move_origin(BINS_PER_ORIGIN * self.position.signum() as i64);
        }
    }

    fn move_origin(&mut self, bins: i64) {
        let shift = bins as f64 * self.length;
        self.position -= shift;
        self.first -= bins;
        self.nodes.iter_mut().for_each(|(x, _)| *x -= shift);
    }

    /// Moves the nodes into bins.
    fn gather(&mut self) {
        let nodes = std::mem::take(&mut self.nodes);
        for &(x, weight) in &nodes {
            let scaled = x / self.length;
            let cell = scaled.floor();
            let y = 2.0 * (scaled - cell) - 1.0;
            #[expect(clippy::cast_possible_truncation, reason = "a count of bins")]
            let Some(bin) = self.bin(cell as i64) else { continue };
            let (mut before, mut t) = (y, 1.0);
            for moment in bin {
                *moment += weight * t;
                (before, t) = (t, 2.0 * y * t - before);
            }
        }
        self.nodes = nodes;
        self.nodes.clear();
    }

    /// The bin of that number, made if need be; `None` if it is farther behind than is kept.
    fn bin(&mut self, number: i64) -> Option<&mut Bin> {
        if self.bins.is_empty() {
            self.first = number;
        }
        while number < self.first {
            if self.bins.len() == MOST_BINS {
                self.forgot = true;
                return None;
            }
            self.bins.push_front([0.0; MOMENTS]);
            self.first -= 1;
        }
        while number >= self.first + self.bins.len() as i64 {
            if self.bins.len() == MOST_BINS {
                self.bins.pop_front();
                self.first += 1;
                self.forgot = true;
            }
            self.bins.push_back([0.0; MOMENTS]);
        }
        self.bins.get_mut(usize::try_from(number - self.first).ok()?)
    }

    /// Displacements from the tip, and weights, of all that is kept.
    pub(super) fn all(&self) -> impl Iterator<Item = (f64, f64)> {
        let bins = self.bins.iter().enumerate().flat_map(move |(i, bin)| {
            let start = (self.first + i as i64) as f64 * self.length;
            points(bin).map(move |(y, w)| (start + 0.5 * (y + 1.0) * self.length, w))
        });
        bins.chain(self.nodes.iter().copied()).map(|(x, w)| (x - self.position, w))
    }

    /// Of what may be seen from displacements in [low, high].
    pub(super) fn near(&self, low: f64, high: f64) -> impl Iterator<Item = (f64, f64)> {
        let seen = low - self.reach..=high + self.reach;
        self.all().filter(move |(x, _)| seen.contains(x))
    }
}

/// The weights on Chebyshev points that have the moments of the bin.
fn points(bin: &Bin) -> impl Iterator<Item = (f64, f64)> {
    let n = MOMENTS as f64;
    (0..MOMENTS).map(move |k| {
        let angle = PI * (k as f64 + 0.5) / n;
        let term = |(m, moment): (usize, &f64)| moment * (m as f64 * angle).cos();
        let sum: f64 = bin.iter().enumerate().map(term).sum();
        (angle.cos(), (2.0 * sum - bin[0]) / n)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collocation::nodes_and_weights;

    fn carried(steps: usize, length: f64) -> Past {
        let tip = TipFunction::gaussian(1.0).unwrap();
        let mut past = Past::new(&tip, tip.reach().unwrap());
        let room = (past.nodes.capacity(), past.bins.capacity());
        let (c, b) = nodes_and_weights();
        for _ in 0..steps {
            past.remember(&c.map(|c| length * c), &b);
        }
        assert_eq!(room, (past.nodes.capacity(), past.bins.capacity()), "no room was added");
        past
    }

    #[test]
    fn room_is_taken_once_however_far_the_tip_goes() {
        assert!(carried(20_000, 0.4).forgot);
        assert!(!carried(20_000, 0.001).forgot);
    }

    #[test]
    fn gathered_nodes_act_as_they_did() {
        let tip = TipFunction::gaussian(1.0).unwrap();
        let mut past = carried(2000, 0.01);
        let slope =
            |past: &Past| past.near(0.0, 0.0).map(|(x, w)| w * tip.slope(0.3 - x)).sum::<f64>();
        let before = slope(&past);
        past.gather();
        assert!(past.nodes.is_empty());
        assert!((slope(&past) - before).abs() < 1e-13 * 2000.0, "{}", slope(&past) - before);
    }
}
