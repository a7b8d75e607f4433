//! Lengths of the next steps of several motions in the basic model. For one motion see [`plan`](super::super::plan).

use super::super::length::{LAST, exp2, log2};
use super::super::pieces::MOST_PIECES;
use super::super::values::{BLOCK, outlook};
use super::super::{chain::INVERSE, plan::MOST_SHORTENINGS};
use super::Limits;
use super::lanes::{LANES, Lanes};
use crate::collocation::{RADAU, STAGES};

pub(super) struct Plan {
    /// Lengths up to which series, exponentials and quadrature rules are accurate, in at most [`MOST_PIECES`] pieces.
    pub(super) length: Lanes,
    /// Length of the longest piece.
    pub(super) piece: Lanes,
    /// Largest speed in the step, approximately.
    pub(super) fastest: Lanes,
    /// The largest time of a step of collocation.
    pub(super) by_stages: Lanes,
}

impl Plan {
    pub(super) const NONE: Self = Self {
        length: Lanes::ZERO,
        piece: Lanes::ZERO,
        fastest: Lanes::ZERO,
        by_stages: Lanes::ZERO,
    };

    /// The plan for these series of displacements.
    #[inline(always)]
    pub(super) fn of(limits: &Limits, series: &[Lanes]) -> Self {
        let mut over = length(series, limits.of_series.error);
        for _ in 0..MOST_SHORTENINGS {
            let moved = value(series, over).map(f64::abs);
            let too_far = |moved: f64| {
                if moved > limits.longest { (0.9 * limits.longest / moved).max(0.3) } else { 1.0 }
            };
            if moved.0.iter().all(|moved| too_far(*moved) >= 1.0) {
                break;
            }
            over *= moved.map(too_far);
        }
        let outlook = Outlook::of(series, over);
        let (error, order) = (log2(limits.of_series.of_piece), INVERSE[STAGES + 1]);
        let radau = &*RADAU;
        let bound = |steepest| log2(radau.interpolation_bound(steepest).max(f64::MIN_POSITIVE));
        let piece = outlook.steepest.map(|steepest| exp2((error - bound(steepest)) * order));
        let limited = |moved: f64| limits.of_series.reach / moved.abs().max(f64::MIN_POSITIVE);
        let piece = over * piece.smaller(outlook.moved.map(limited));
        let length = over.smaller(piece * MOST_PIECES as f64);
        let fastest = outlook.fastest * over.map(f64::recip);
        let by_stages = fastest.map(|fastest| limits.of_series.longest_stages(fastest));
        Self { length, piece, fastest, by_stages }
    }

    /// Numbers of pieces of steps of these lengths, as [`count`](super::super::plan::count).
    #[inline(always)]
    pub(super) fn pieces(&self, length: Lanes) -> Lanes {
        let mut counts = Lanes::all(1.0);
        for lane in 0..LANES {
            let pieces = length.0[lane] / self.piece.0[lane];
            for fewer in 1..MOST_PIECES {
                counts.0[lane] += if pieces > fewer as f64 { 1.0 } else { 0.0 };
            }
        }
        counts
    }
}

/// As [`length`](super::super::length::length).
#[inline(always)]
fn length(series: &[Lanes], error: f64) -> Lanes {
    let (order, wanted) = (series.len() - 1, log2(error));
    let mut shortest = Lanes::all(f64::INFINITY);
    for before in 0..LAST {
        let digits = |coefficient: f64| {
            let size = coefficient.abs().max(f64::MIN_POSITIVE);
            (wanted - log2(size) + before as f64) * INVERSE[order - before]
        };
        shortest = shortest.smaller(series[order - before].map(digits));
    }
    shortest.map(exp2)
}

/// Values of the series at these times.
#[inline(always)]
fn value(series: &[Lanes], at: Lanes) -> Lanes {
    series.iter().rev().fold(Lanes::ZERO, |value, coefficient| value * at + *coefficient)
}

/// As [`Outlook`](super::super::values::Outlook), for each motion.
struct Outlook {
    moved: Lanes,
    fastest: Lanes,
    steepest: Lanes,
}

impl Outlook {
    #[inline(always)]
    fn of(series: &[Lanes], over: Lanes) -> Self {
        let mut sums = [Lanes::ZERO; BLOCK];
        let mut power = over;
        for (coefficient, counts) in series[1..].iter().zip(&outlook()[1..]) {
            let scaled = *coefficient * power;
            power *= over;
            // Half of them at a time: see the block of an expansion.
            let halves = sums.as_chunks_mut::<{ BLOCK / 2 }>().0.iter_mut();
            for (sums, counts) in halves.zip(counts.as_chunks::<{ BLOCK / 2 }>().0) {
                for (sum, count) in sums.iter_mut().zip(counts) {
                    *sum += scaled * *count;
                }
            }
        }
        let [moved, rest @ ..] = sums.map(|sum| sum.map(f64::abs));
        let largest = |of: &[Lanes]| of.iter().fold(Lanes::ZERO, |most, sum| most.larger(*sum));
        Self { moved, fastest: largest(&rest[..3]), steepest: largest(&rest[3..]) }
    }
}
