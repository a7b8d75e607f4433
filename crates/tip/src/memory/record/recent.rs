//! The latest nodes, in chunks about origins of their own, so that neither a new origin nor the loss of the oldest
//! concerns each node.

use crate::elementary::larger;
use crate::sorting::ends_of;
use crate::state::{Damaged, Reader, State};
use std::collections::VecDeque;

/// Number of nodes at which the next chunk begins.
const CHUNK: usize = 1 << 10;
/// Number of chunks for which there is room at first: more of them are nodes of few steps between two origins.
const CHUNKS: usize = 1 << 8;

#[derive(Debug, Clone)]
pub(super) struct Recent {
    nodes: VecDeque<(f64, f64)>,
    chunks: VecDeque<Chunk>,
}

#[derive(Debug, Clone)]
struct Chunk {
    /// Number of nodes.
    len: usize,
    /// The largest position.
    farthest: f64,
    /// Distance from the origin of the chunk to the present one.
    moved: f64,
}

impl Recent {
    /// Room for this number of nodes.
    pub(super) fn with_capacity(nodes: usize) -> Self {
        let nodes = VecDeque::with_capacity(nodes);
        Self { nodes, chunks: VecDeque::with_capacity(CHUNKS) }
    }

    pub(super) fn len(&self) -> usize {
        self.nodes.len()
    }

    /// Adds nodes at displacements from `here`, and returns the least of their positions.
    pub(super) fn push(&mut self, here: f64, position: &[f64], weight: &[f64]) -> f64 {
        if self.chunks.back().is_none_or(|last| last.moved.abs() > 0.0 || last.len >= CHUNK) {
            self.chunks.push_back(Chunk::new());
        }
        let (low, high) = ends_of(position);
        if let Some(last) = self.chunks.back_mut() {
            self.nodes.extend(position.iter().zip(weight).map(|(p, w)| (here + p, *w)));
            last.farthest = larger(here + high, last.farthest);
            last.len += position.len();
        }
        here + low
    }

    /// Positions about the present origin, and weights.
    pub(super) fn iter(&self) -> impl Iterator<Item = (f64, f64)> + Clone {
        let moved =
            self.chunks.iter().flat_map(|chunk| std::iter::repeat_n(chunk.moved, chunk.len));
        self.nodes.iter().zip(moved).map(|((position, weight), moved)| (position - moved, *weight))
    }

    /// The largest position; -∞ without nodes.
    pub(super) fn farthest(&self) -> f64 {
        self.chunks.iter().fold(f64::NEG_INFINITY, |most, chunk| larger(chunk.end(), most))
    }

    /// Drops the oldest chunks that lie before this position, and returns whether there are any.
    pub(super) fn drop_before(&mut self, position: f64) -> bool {
        let mut gone = 0;
        while let Some(chunk) = self.chunks.front().filter(|chunk| chunk.end() < position) {
            gone += chunk.len;
            self.chunks.pop_front();
        }
        self.nodes.drain(..gone);
        gone > 0
    }

    pub(super) fn clear(&mut self) {
        self.nodes.clear();
        self.chunks.clear();
    }

    pub(super) fn move_origin(&mut self, shift: f64) {
        self.chunks.iter_mut().for_each(|chunk| chunk.moved += shift);
    }

    pub(super) fn scale(&mut self, factor: f64) {
        self.nodes.iter_mut().for_each(|(_, weight)| *weight *= factor);
    }

    pub(super) fn save(&self, state: &mut State) {
        state.count(self.chunks.len() as u64);
        for chunk in &self.chunks {
            state.count(chunk.len as u64);
            state.number(chunk.moved);
        }
        state.pairs(self.nodes.iter());
    }

    /// Restores at most this number of nodes.
    pub(super) fn restore(&mut self, state: &mut Reader, most: usize) -> Result<(), Damaged> {
        self.clear();
        for _ in 0..state.length(2)? {
            let len = usize::try_from(state.count()?).map_err(|_| Damaged::OutOfRange)?;
            self.chunks.push_back(Chunk { len, moved: state.finite()?, ..Chunk::new() });
        }
        let nodes = state.pairs()?;
        let mut rest = &nodes[..];
        for chunk in &mut self.chunks {
            let (own, others) = rest.split_at_checked(chunk.len).ok_or(Damaged::OutOfRange)?;
            chunk.farthest = own.iter().fold(f64::NEG_INFINITY, |most, node| larger(node.0, most));
            rest = others;
        }
        if !rest.is_empty() || nodes.len() > most {
            return Err(Damaged::OutOfRange);
        }
        self.nodes.extend(nodes);
        Ok(())
    }

    /// Number of nodes and of chunks for which there is room.
    #[cfg(test)]
    pub(super) fn capacity(&self) -> (usize, usize) {
        (self.nodes.capacity(), self.chunks.capacity())
    }
}

impl Chunk {
    fn new() -> Self {
        Self { len: 0, farthest: f64::NEG_INFINITY, moved: 0.0 }
    }

    /// The largest position about the present origin.
    fn end(&self) -> f64 {
        self.farthest - self.moved
    }
}
