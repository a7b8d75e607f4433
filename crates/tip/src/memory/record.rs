//! The history buffer: positions of the tip and times spent there, from which every memory is built.
//!
//! New nodes are kept unchanged. A buffer of bounded size compresses them when there are many: a weight w at y within
//! a bin acts on any g that is a polynomial of degree n < p over the bin in the same way as the moments `Σ w T_n(y)`.
//! These act in the same way as p weights on the Chebyshev points of the bin. The length of a bin is at most 8/band,
//! slightly more than the shortest wave in f. The coefficients beyond degree 15 are below 6e-9 of that wave, which
//! itself is below round-off; for all longer waves they are below round-off.

mod bins;
mod recent;
mod saved;

use crate::TipFunction;
use crate::collocation::STAGES;
use crate::sorting::ends;
use bins::Bins;
use recent::Recent;
use std::ops::Range;

/// Number of nodes kept unchanged in a buffer of bounded size: for a tip that moves on, twice as many as lie within
/// the distance kept, so that most are dropped without compression.
const MOST_NODES: usize = 1 << 15;
/// Distance by which the origin of an unbounded buffer moves, in σ.
const ORIGIN_STEP: f64 = 64.0;

/// Positions with the times spent there.
#[derive(Debug, Clone)]
pub(crate) struct Record {
    reach: f64,
    /// Position of the tip, relative to an origin that moves with it: positions remain small, so that their
    /// differences keep full precision however far the tip travels.
    position: f64,
    /// The nodes of an unbounded buffer.
    nodes: Vec<(f64, f64)>,
    kept: Kept,
}

/// Treatment of nodes when there are many.
#[derive(Debug, Clone)]
enum Kept {
    /// All nodes are kept, in blocks of at most the number of nodes of a step.
    All(Vec<Block>),
    /// The latest nodes are kept, those before are compressed in bins.
    Gathered(Bins, Recent),
    /// All nodes are kept; the origin is that of a lattice, which determines when it moves.
    OnLattice,
}

/// Consecutive nodes, and the interval that they span.
#[derive(Debug, Clone, Copy)]
struct Block {
    low: f64,
    high: f64,
    end: usize,
}

impl Record {
    /// An unbounded buffer.
    pub(crate) fn whole(tip: &TipFunction) -> Self {
        Self::new(tip, Kept::All(vec![]))
    }

    /// A buffer of bounded length. It allocates its memory once, and that of its bins at the first compression; later
    /// operations do not allocate.
    pub(super) fn bounded(tip: &TipFunction) -> Self {
        let recent = Recent::with_capacity(MOST_NODES);
        Self::new(tip, Kept::Gathered(Bins::new(tip), recent))
    }

    /// An unbounded buffer about the origin of a lattice.
    pub(super) fn on_lattice(tip: &TipFunction) -> Self {
        Self::new(tip, Kept::OnLattice)
    }

    fn new(tip: &TipFunction, kept: Kept) -> Self {
        let reach = tip.reach().unwrap_or(f64::INFINITY);
        Self { reach, position: 0.0, nodes: vec![], kept }
    }

    /// Position of the tip, about the origin of the nodes.
    pub(crate) fn position(&self) -> f64 {
        self.position
    }

    /// The nodes of an unbounded buffer, about their origin.
    pub(crate) fn nodes(&self) -> &[(f64, f64)] {
        &self.nodes
    }

    /// Adds the nodes of another buffer: displacements from the tip, and times spent there.
    pub(super) fn with(mut self, visits: impl Iterator<Item = (f64, f64)>) -> Self {
        visits.for_each(|(position, weight)| self.push(&[position], &[weight]));
        self
    }

    /// As [`Policy::remember`](crate::memory::Policy::remember).
    pub(crate) fn remember(&mut self, position: &[f64], weight: &[f64]) {
        let Some(moved) = position.last() else { return };
        match &mut self.kept {
            Kept::All(_) => self.push_blocks(position, weight),
            Kept::OnLattice => self.push(position, weight),
            Kept::Gathered(bins, recent) => {
                let lowest = keep((bins, recent), self.position, position, weight);
                bins.look_from(lowest - self.reach);
            }
        }
        self.position += moved;
        self.follow();
    }

    /// Adds blocks of at most one step.
    fn push_blocks(&mut self, position: &[f64], weight: &[f64]) {
        for (position, weight) in position.chunks(STAGES).zip(weight.chunks(STAGES)) {
            self.push(position, weight);
            self.close_block(position.len());
        }
    }

    /// Adds nodes given as displacements from the last position of the tip.
    fn push(&mut self, position: &[f64], weight: &[f64]) {
        let here = self.position;
        if let Kept::Gathered(bins, recent) = &mut self.kept {
            keep((bins, recent), here, position, weight);
        } else {
            self.nodes.extend(position.iter().zip(weight).map(|(p, w)| (here + p, *w)));
        }
    }

    fn close_block(&mut self, nodes: usize) {
        let end = self.nodes.len();
        let Kept::All(blocks) = &mut self.kept else { return };
        let (low, high) = ends(self.nodes[end - nodes..].iter().map(|(x, _)| *x));
        blocks.push(Block { low, high, end });
    }

    /// Moves the origin towards the tip.
    fn follow(&mut self) {
        let step = match &self.kept {
            Kept::All(_) => ORIGIN_STEP,
            Kept::Gathered(bins, _) => bins.origin_step(),
            Kept::OnLattice => return,
        };
        if self.position.abs() > 2.0 * step {
            self.move_origin(step.copysign(self.position));
        }
    }

    /// Moves the origin; exact for a shift of few significant bits.
    pub(super) fn move_origin(&mut self, shift: f64) {
        self.position -= shift;
        self.nodes.iter_mut().for_each(|(x, _)| *x -= shift);
        match &mut self.kept {
            Kept::All(blocks) => {
                for block in blocks {
                    block.low -= shift;
                    block.high -= shift;
                }
            }
            Kept::Gathered(bins, recent) => {
                bins.move_origin(shift);
                recent.move_origin(shift);
            }
            Kept::OnLattice => {}
        }
    }

    pub(crate) fn scale(&mut self, factor: f64) {
        self.nodes.iter_mut().for_each(|(_, weight)| *weight *= factor);
        if let Kept::Gathered(bins, recent) = &mut self.kept {
            bins.moments.iter_mut().flatten().for_each(|moment| *moment *= factor);
            recent.scale(factor);
        }
    }

    /// Displacements from the tip, and weights, of all nodes kept.
    pub(super) fn all(&self) -> impl Iterator<Item = (f64, f64)> + Clone {
        self.within(f64::NEG_INFINITY, f64::INFINITY)
    }

    /// Displacements and weights of the nodes between two displacements.
    fn within(&self, low: f64, high: f64) -> impl Iterator<Item = (f64, f64)> + Clone {
        let gathered = match &self.kept {
            Kept::Gathered(bins, recent) => {
                let points = bins.points(self.position + low, self.position + high);
                Some(points.chain(recent.iter()))
            }
            Kept::All(_) | Kept::OnLattice => None,
        };
        let nodes = gathered.into_iter().flatten().chain(self.nodes.iter().copied());
        let displacements = nodes.map(|(x, w)| (x - self.position, w));
        displacements.filter(move |(x, _)| (low..=high).contains(x))
    }

    /// Displacements and weights of the nodes within reach of displacements in [low, high].
    pub(super) fn near(&self, low: f64, high: f64) -> impl Iterator<Item = (f64, f64)> + Clone {
        self.within(low - self.reach, high + self.reach)
    }

    /// The blocks with any node within reach of positions in [low, high], for an unbounded buffer.
    pub(super) fn blocks_near(
        &self,
        low: f64,
        high: f64,
    ) -> impl Iterator<Item = &[(f64, f64)]> + Clone {
        self.places_near(low, high).map(|places| &self.nodes[places])
    }

    /// The blocks of [`blocks_near`](Self::blocks_near) as ranges of indices in [`nodes`](Self::nodes).
    pub(crate) fn places_near(
        &self,
        low: f64,
        high: f64,
    ) -> impl Iterator<Item = Range<usize>> + Clone {
        let seen = move |b: &Block| b.high >= low - self.reach && b.low <= high + self.reach;
        let mut start = 0;
        self.blocks().iter().filter_map(move |block| {
            let places = start..block.end;
            start = block.end;
            seen(block).then_some(places)
        })
    }

    fn blocks(&self) -> &[Block] {
        match &self.kept {
            Kept::All(blocks) => blocks,
            Kept::Gathered(..) | Kept::OnLattice => &[],
        }
    }

    pub(super) fn steps(&self) -> usize {
        self.blocks().len()
    }

    /// Number of nodes within reach of the tip.
    pub(super) fn nodes_within_reach(&self) -> usize {
        self.blocks_near(self.position, self.position).map(<[_]>::len).sum()
    }

    /// Distance behind the farthest point of the tip within which the past is kept, if the tip has returned to
    /// positions that were dropped; `None` otherwise.
    pub(super) fn forgotten(&self) -> Option<f64> {
        match &self.kept {
            Kept::Gathered(bins, _) => bins.forgotten(),
            Kept::All(_) | Kept::OnLattice => None,
        }
    }
}

/// Keeps nodes at displacements from `here`, and returns the least of their positions.
fn keep(
    (bins, recent): (&mut Bins, &mut Recent),
    here: f64,
    position: &[f64],
    weight: &[f64],
) -> f64 {
    if recent.len() + position.len() > MOST_NODES {
        thin(bins, recent);
    }
    recent.push(here, position, weight)
}

/// Drops nodes farther behind than the distance kept, and compresses the others unless this drops half of them.
#[cold]
fn thin(bins: &mut Bins, recent: &mut Recent) {
    bins.forget(recent);
    if recent.len() > MOST_NODES / 2 {
        gather(bins, recent);
    }
}

fn gather(bins: &mut Bins, recent: &mut Recent) {
    recent.iter().for_each(|node| bins.add(node));
    recent.clear();
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collocation::nodes_and_weights;

    fn carried(steps: usize, length: f64) -> Record {
        let tip = TipFunction::gaussian(1.0).unwrap();
        let mut record = Record::bounded(&tip);
        let room = |record: &Record| match &record.kept {
            Kept::Gathered(bins, recent) => (recent.capacity(), bins.moments.capacity()),
            _ => unreachable!("the record is bounded"),
        };
        let (nodes, _) = room(&record);
        let (c, b) = nodes_and_weights();
        for _ in 0..steps {
            record.remember(&c.map(|c| length * c), &b);
        }
        // Of bins all or none.
        let bins = if matches!(&record.kept, Kept::Gathered(bins, _) if bins.moments.is_empty()) {
            0
        } else {
            bins::MOST_BINS
        };
        assert_eq!(room(&record), (nodes, bins), "no room was added");
        record
    }

    fn dropped(record: &Record) -> bool {
        matches!(&record.kept, Kept::Gathered(bins, _) if bins.dropped)
    }

    #[test]
    fn room_is_taken_once_however_far_the_tip_goes() {
        assert!(dropped(&carried(20_000, 0.4)));
        assert!(!dropped(&carried(20_000, 0.001)));
    }

    /// Nothing of what is kept is gathered where the tip goes on; what is behind is dropped, which is said when it is seen.
    #[test]
    fn what_is_far_behind_is_dropped_ungathered() {
        let mut record = carried(20_000, 0.4);
        let Kept::Gathered(bins, _) = &record.kept else { unreachable!("the record is bounded") };
        assert!(bins.moments.is_empty() && bins.dropped);
        let kept = bins.length_kept();
        let first = record.all().map(|(x, _)| x).fold(0.0, f64::min);
        assert!(first < 1.0 - kept && first > -3.0 * kept, "{first} {kept}");
        assert_eq!(record.forgotten(), None);
        record.remember(&[first - 50.0], &[0.1]);
        assert!(record.forgotten().is_some());
    }

    #[test]
    fn gathered_nodes_act_as_they_did() {
        let tip = TipFunction::gaussian(1.0).unwrap();
        let mut record = carried(2000, 0.01);
        let slope = |record: &Record| {
            record.near(0.0, 0.0).map(|(x, w)| w * tip.slope(0.3 - x)).sum::<f64>()
        };
        let before = slope(&record);
        let Kept::Gathered(bins, recent) = &mut record.kept else { unreachable!("it is bounded") };
        gather(bins, recent);
        assert_eq!(recent.len(), 0);
        assert!((slope(&record) - before).abs() < 1e-13 * 2000.0, "{}", slope(&record) - before);
    }

    /// The same visits one by one, and as one long slice.
    #[test]
    fn visits_may_come_in_any_number() {
        let tip = TipFunction::gaussian(1.0).unwrap();
        let visits: Vec<f64> = (0..50).map(|i| 0.3 * f64::from(i).sin()).collect();
        let mut at_once = Record::whole(&tip);
        at_once.remember(&visits, &vec![0.5; 50]);
        let mut one_by_one = Record::whole(&tip);
        let mut last = 0.0;
        for x in visits {
            one_by_one.remember(&[x - last], &[0.5]);
            last = x;
        }
        assert_eq!(at_once.nodes_within_reach(), 50);
        for (a, b) in at_once.all().zip(one_by_one.all()) {
            assert!((a.0 - b.0).abs() < 1e-14 && (a.1 - b.1).abs() < 1e-16);
        }
    }
}
