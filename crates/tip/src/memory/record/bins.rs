//! Visits gathered in bins: as many moments of each as act on f.

use crate::TipFunction;
use std::collections::VecDeque;
use std::f64::consts::PI;

pub(super) const MOMENTS: usize = 16;
pub(super) type Bin = [f64; MOMENTS];

/// Bins kept: what is farther behind is forgotten.
pub(super) const MOST_BINS: usize = 1 << 12;
/// The origin moves by so many bins: rarely, as all nodes move with it, and not so far that their positions lose more than
/// some 3e-14.
const BINS_PER_ORIGIN: i64 = 512;

/// Moments of what was visited, bin by bin.
#[derive(Debug, Clone)]
pub(super) struct Bins {
    /// Length of a bin, a power of two: moving the origin by bins is exact.
    length: f64,
    pub(super) moments: VecDeque<Bin>,
    /// Bin i of the deque is at [i + first, i + first + 1] lengths.
    pub(super) first: i64,
    /// Whether bins have been dropped behind `first`,
    pub(super) dropped: bool,
    /// and whether they have been looked for since.
    pub(super) missed: bool,
}

impl Bins {
    pub(super) fn new(tip: &TipFunction) -> Self {
        let length = (8.0 / tip.band()).log2().floor().exp2();
        let moments = VecDeque::with_capacity(MOST_BINS);
        Self { length, moments, first: 0, dropped: false, missed: false }
    }

    pub(super) fn origin_step(&self) -> f64 {
        BINS_PER_ORIGIN as f64 * self.length
    }

    /// By whole bins.
    pub(super) fn move_origin(&mut self, shift: f64) {
        #[expect(clippy::cast_possible_truncation, reason = "a count of bins")]
        let bins = (shift / self.length) as i64;
        self.first -= bins;
    }

    /// Notes that the tip sees back to x.
    pub(super) fn look_from(&mut self, x: f64) {
        self.missed |= self.dropped && x < self.first as f64 * self.length;
    }

    /// How far behind the farthest point of the tip the past is kept, if it looked farther.
    pub(super) fn forgotten(&self) -> Option<f64> {
        self.missed.then_some(MOST_BINS as f64 * self.length)
    }

    /// A time spent at x.
    pub(super) fn add(&mut self, (x, weight): (f64, f64)) {
        let scaled = x / self.length;
        let cell = scaled.floor();
        let y = 2.0 * (scaled - cell) - 1.0;
        #[expect(clippy::cast_possible_truncation, reason = "a count of bins")]
        let Some(bin) = self.bin(cell as i64) else { return };
        let (mut before, mut t) = (y, 1.0);
        for moment in bin {
            *moment += weight * t;
            (before, t) = (t, 2.0 * y * t - before);
        }
    }

    /// The bin of that number, made if need be; `None` if it is farther behind than is kept.
    fn bin(&mut self, number: i64) -> Option<&mut Bin> {
        let end = self.first.saturating_add(self.moments.len() as i64);
        if !self.moments.is_empty() && number.saturating_sub(end) >= MOST_BINS as i64 {
            // So far ahead that nothing of what there is will be kept.
            self.moments.clear();
            self.dropped = true;
        }
        if self.moments.is_empty() {
            self.first = number.min(i64::MAX - 2 * MOST_BINS as i64);
            if self.first < number {
                return None;
            }
        }
        while number < self.first {
            if self.moments.len() == MOST_BINS {
                self.dropped = true;
                return None;
            }
            self.moments.push_front([0.0; MOMENTS]);
            self.first -= 1;
        }
        while number >= self.first + self.moments.len() as i64 {
            if self.moments.len() == MOST_BINS {
                self.moments.pop_front();
                self.first += 1;
                self.dropped = true;
            }
            self.moments.push_back([0.0; MOMENTS]);
        }
        self.moments.get_mut(usize::try_from(number - self.first).ok()?)
    }

    /// Positions and weights that act as all that was gathered.
    pub(super) fn points(&self) -> impl Iterator<Item = (f64, f64)> + Clone {
        self.moments.iter().enumerate().flat_map(move |(i, bin)| {
            let start = (self.first + i as i64) as f64 * self.length;
            points(bin).map(move |(y, w)| (start + 0.5 * (y + 1.0) * self.length, w))
        })
    }
}

/// The weights on Chebyshev points that have the moments of the bin.
fn points(bin: &Bin) -> impl Iterator<Item = (f64, f64)> + Clone {
    let n = MOMENTS as f64;
    (0..MOMENTS).map(move |k| {
        let angle = PI * (k as f64 + 0.5) / n;
        let term = |(m, moment): (usize, &f64)| moment * (m as f64 * angle).cos();
        let sum: f64 = bin.iter().enumerate().map(term).sum();
        (angle.cos(), (2.0 * sum - bin[0]) / n)
    })
}
