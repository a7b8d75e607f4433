//! The first ripple that neither grows nor fades: the largest T = r/a at which the determinant Q(T, q, θ) vanishes.
//!
//! Branch and bound. The half-strip of all wave numbers and phases is divided into cells. On each cell Q is known to first
//! order, with a bound of the remainder ([`Patch`](super::patch)). A cell is discarded if Q has no zero on it at any
//! T > T' (1 + 1e-10), where T' is the largest known T: for example if Re (1 - iμ)Q > 0 for some μ at all these T. Other
//! cells are halved, and Newton's method searches the most promising ones for larger T. Therefore the search ends only
//! when no ripple can grow at a smaller α, however narrow its band. It does end, because near the largest T both the
//! bounds and the decrease of T are of second order in the size of a cell. The bounds do not include round-off.

use super::determinant::{Lines, Phase, Wave};
use super::on_cell::Determinant;
use super::optimum::{Place, candidate};
use crate::StabilityError;
use stickslip_tip::sorting::sort_by_number;
use stickslip_tip::stop;

/// Relative accuracy to which a threshold is certified as the lowest.
pub(super) const MARGIN: f64 = 1e-10;
/// Largest number of cells, at which the search is given up.
const MOST_CELLS: usize = 4_000_000;
/// Number of cells of each round in which Newton's method is tried.
const TRIED: usize = 3;

/// An interval of wave numbers or of phases; its halves are computed at the first request.
struct Interval<F> {
    centre: f64,
    half: f64,
    of: F,
    halves: Option<[usize; 2]>,
}

struct Tree<'a, F> {
    of: &'a dyn Fn(f64, f64) -> F,
    all: Vec<Interval<F>>,
}

/// The result of a search.
#[derive(Debug, Clone, Copy)]
pub(super) struct Found {
    /// The wave with the largest T, if this is above the floor.
    pub(super) place: Option<Place>,
    pub(super) cells: usize,
}

impl<'a, F> Tree<'a, F> {
    fn new(of: &'a dyn Fn(f64, f64) -> F, (centre, half): (f64, f64)) -> Self {
        let root = Interval { centre, half, of: of(centre, half), halves: None };
        Self { of, all: vec![root] }
    }

    fn halves(&mut self, index: usize) -> [usize; 2] {
        if let Some(halves) = self.all[index].halves {
            return halves;
        }
        let (centre, half) = (self.all[index].centre, 0.5 * self.all[index].half);
        let halves = [centre - half, centre + half].map(|centre| {
            self.all.push(Interval { centre, half, of: (self.of)(centre, half), halves: None });
            self.all.len() - 1
        });
        self.all[index].halves = Some(halves);
        halves
    }
}

/// The largest T above `floor`.
///
/// # Errors
/// [`StabilityError::Uncertified`] if there are too many cells, [`StabilityError::Stopped`].
pub(super) fn largest(lines: &Lines, floor: f64) -> Result<Found, StabilityError> {
    let (mut best, mut least): (Option<Place>, f64) = (None, floor);
    let farthest = farthest(lines, least);
    let (wave, phase) = (|q, half| lines.wave(q, half), |theta, half| lines.phase(theta, half));
    let mut waves: Tree<'_, Wave> = Tree::new(&wave, (0.5 * farthest, 0.5 * farthest));
    let mut phases: Tree<'_, Phase> = Tree::new(&phase, lines.phases());
    let mut cells = vec![(0, 0)];
    let mut looked_at = 0;
    while !cells.is_empty() {
        looked_at += cells.len();
        if stop::is_requested() {
            return Err(StabilityError::Stopped);
        }
        if looked_at > MOST_CELLS {
            return Err(StabilityError::Uncertified { cells: MOST_CELLS });
        }
        let above = least * (1.0 + MARGIN);
        let at = |(i, j): &(usize, usize)| -> Determinant {
            lines.determinant(&waves.all[*i].of, &phases.all[*j].of, above)
        };
        let left = cells.into_iter().map(|cell| (cell, at(&cell)));
        let mut left: Vec<_> = left.filter(|(_, here)| !here.has_no_zero()).collect();
        sort_by_number(&mut left, |item| -item.1.promise());
        let cell = |(i, j): (usize, usize)| {
            let (q, theta) = (&waves.all[i], &phases.all[j]);
            [(q.centre, q.half), (theta.centre, theta.half)]
        };
        let known = best;
        let is_open = |cell: &[(f64, f64); 2]| !known.is_some_and(|best| best.settles(*cell));
        for cell in left.iter().map(|(at, _)| cell(*at)).filter(is_open).take(TRIED) {
            let found = candidate(lines, cell, least).filter(|found| found.t > least);
            if let Some(found) = found {
                (least, best) = (found.t, Some(found));
            }
        }
        cells = Vec::with_capacity(2 * left.len());
        for ((i, j), _) in left {
            let [along_q, along_phase] = waves.all[i].of.spreads(&phases.all[j].of);
            if along_phase > along_q && along_q.is_finite() {
                cells.extend(phases.halves(j).map(|j| (i, j)));
            } else {
                cells.extend(waves.halves(i).map(|i| (i, j)));
            }
        }
    }
    Ok(Found { place: best, cells: looked_at })
}

/// The q beyond which no T reaches `least`.
fn farthest(lines: &Lines, least: f64) -> f64 {
    let mut q = 1e-6;
    while lines.largest_beyond(q) > least && q < 1e12 {
        q *= 1.5;
    }
    q
}
