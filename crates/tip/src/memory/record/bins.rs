//! Nodes compressed in bins, with as many moments of each bin as act on f.

use super::recent::Recent;
use crate::TipFunction;
use crate::elementary::{cos, exp2, log2};
use std::collections::VecDeque;
use std::f64::consts::PI;
use std::sync::LazyLock;

pub(super) const MOMENTS: usize = 16;
pub(super) type Bin = [f64; MOMENTS];

/// Number of bins kept: the past farther behind is dropped.
pub(super) const MOST_BINS: usize = 1 << 11;
/// Number of bins by which the origin moves: rarely, as all nodes move with it, and not so far that the error of
/// their positions exceeds some 3e-14.
const BINS_PER_ORIGIN: i64 = 512;

/// Moments of the weights in each bin.
#[derive(Debug, Clone)]
pub(super) struct Bins {
    /// Length of a bin, a power of two: moving the origin by bins is exact.
    length: f64,
    pub(super) moments: VecDeque<Bin>,
    /// Bin i of the deque is at [i + first, i + first + 1] lengths.
    pub(super) first: i64,
    /// Whether bins have been dropped behind `first`.
    pub(super) dropped: bool,
    /// Whether the memory has been evaluated at dropped bins.
    pub(super) missed: bool,
}

impl Bins {
    pub(super) fn new(tip: &TipFunction) -> Self {
        let length = exp2(log2(8.0 / tip.band()).floor());
        // Few tips come back so often that visits are gathered: room is taken, for all bins at once, when they are.
        Self { length, moments: VecDeque::new(), first: 0, dropped: false, missed: false }
    }

    pub(super) fn origin_step(&self) -> f64 {
        BINS_PER_ORIGIN as f64 * self.length
    }

    /// Moves the origin by a whole number of bins.
    pub(super) fn move_origin(&mut self, shift: f64) {
        if self.moments.is_empty() && !self.dropped {
            return;
        }
        #[expect(clippy::cast_possible_truncation, reason = "a count of bins")]
        let bins = (shift / self.length) as i64;
        self.first -= bins;
    }

    /// Records how far back the memory is evaluated.
    pub(super) fn look_from(&mut self, x: f64) {
        self.missed |= self.dropped && x < self.first as f64 * self.length;
    }

    /// Distance behind the farthest point of the tip within which the past is kept, if positions beyond it were
    /// evaluated.
    pub(super) fn forgotten(&self) -> Option<f64> {
        self.missed.then_some(self.length_kept())
    }

    /// Distance behind the farthest point of the tip within which the past is kept.
    pub(super) fn length_kept(&self) -> f64 {
        MOST_BINS as f64 * self.length
    }

    /// Removes nodes and bins that are farther behind than the distance kept.
    pub(super) fn forget(&mut self, recent: &mut Recent) {
        let end = if self.moments.is_empty() { i64::MIN } else { self.end() };
        let end = end.max(self.number(recent.farthest()).saturating_add(1));
        let horizon = end.saturating_sub(MOST_BINS as i64);
        let horizon = if self.dropped { horizon.max(self.first) } else { horizon };
        let has_dropped = recent.drop_before(horizon as f64 * self.length);
        let gone = usize::try_from(horizon.saturating_sub(self.first)).unwrap_or(0);
        let gone = gone.min(self.moments.len());
        if gone == 0 && !has_dropped {
            return;
        }
        self.dropped = true;
        self.moments.drain(..gone);
        // The first bin says from where on the past is kept.
        if self.moments.is_empty() {
            self.first = horizon;
        } else {
            self.first += gone as i64;
        }
        while self.first > horizon {
            self.moments.push_front([0.0; MOMENTS]);
            self.first -= 1;
        }
    }

    #[expect(clippy::cast_possible_truncation, reason = "a count of bins")]
    fn number(&self, x: f64) -> i64 {
        (x / self.length).floor() as i64
    }

    /// Number of the last bin, plus one.
    fn end(&self) -> i64 {
        self.first.saturating_add(self.moments.len() as i64)
    }

    /// Adds a time spent at x.
    pub(super) fn add(&mut self, (x, weight): (f64, f64)) {
        let scaled = x / self.length;
        let cell = scaled.floor();
        let y = 2.0 * (scaled - cell) - 1.0;
        #[expect(clippy::cast_possible_truncation, reason = "a count of bins")]
        let Some(bin) = self.bin(cell as i64) else { return };
        add_polynomials(bin, y, weight);
    }

    /// The bin with this number, created if necessary; `None` if it is farther behind than the distance kept.
    fn bin(&mut self, number: i64) -> Option<&mut Bin> {
        if !self.moments.is_empty() && number.saturating_sub(self.end()) >= MOST_BINS as i64 {
            // So far ahead that nothing of what there is will be kept.
            self.moments.clear();
            self.dropped = true;
        }
        if self.moments.is_empty() {
            self.moments.reserve_exact(MOST_BINS);
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
        while number >= self.end() {
            if self.moments.len() == MOST_BINS {
                self.moments.pop_front();
                self.first += 1;
                self.dropped = true;
            }
            self.moments.push_back([0.0; MOMENTS]);
        }
        self.moments.get_mut(usize::try_from(number - self.first).ok()?)
    }

    /// Positions and weights that act like all nodes in bins that overlap [low, high].
    pub(super) fn points(&self, low: f64, high: f64) -> impl Iterator<Item = (f64, f64)> + Clone {
        let starts = (self.first..).map(|number| number as f64 * self.length);
        let seen = move |start: f64| start + self.length >= low && start <= high;
        let bins = starts.zip(&self.moments).filter(move |(start, _)| seen(*start));
        bins.flat_map(move |(start, bin)| {
            points(bin).map(move |(y, w)| (start + 0.5 * (y + 1.0) * self.length, w))
        })
    }
}

const LANES: usize = 4;

/// Adds `weight T_m(y)`, m = 0, 1, …: by `T_{m+4} = 2 T_4 T_m - T_{|m-4|}` four at a time.
fn add_polynomials(bin: &mut Bin, y: f64, weight: f64) {
    let t2 = 2.0 * y * y - 1.0;
    let (t3, t4) = (2.0 * y * t2 - y, 2.0 * t2 * t2 - 1.0);
    let (mut before, mut here) = ([t4, t3, t2, y], [1.0, y, t2, t3]);
    for moments in bin.as_chunks_mut::<LANES>().0 {
        for i in 0..LANES {
            moments[i] += weight * here[i];
            (before[i], here[i]) = (here[i], 2.0 * t4 * here[i] - before[i]);
        }
    }
}

/// The weights on Chebyshev points with the moments of the bin.
fn points(bin: &Bin) -> impl Iterator<Item = (f64, f64)> + Clone {
    COSINES.iter().map(move |cosines| {
        let sum: f64 = bin.iter().zip(cosines).map(|(moment, cos)| moment * cos).sum();
        (cosines[1], (2.0 * sum - bin[0]) / MOMENTS as f64)
    })
}

/// `T_m` at the Chebyshev points, a row for each of them.
static COSINES: LazyLock<[Bin; MOMENTS]> = LazyLock::new(|| {
    let angle = |k: usize| PI * (k as f64 + 0.5) / MOMENTS as f64;
    std::array::from_fn(|k| std::array::from_fn(|m| cos(m as f64 * angle(k))))
});

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn moments_are_those_of_chebyshev_polynomials() {
        for y in [-1.0, -0.73, -0.1, 0.0, 0.4, 0.99] {
            let mut bin = [0.5; MOMENTS];
            add_polynomials(&mut bin, y, 1.7);
            for (m, moment) in bin.iter().enumerate() {
                let wanted = 0.5 + 1.7 * (m as f64 * y.acos()).cos();
                assert!((moment - wanted).abs() < 1e-13, "{y} {m}: {moment} {wanted}");
            }
        }
    }
}
