//! The displacement as a function of time within a step, from the series of the time.
//!
//! The displacements at the ends of pieces are given, and the times there with their derivatives. So the displacement has
//! four known derivatives with respect to time at both ends, those of the inverse function. The polynomial of degree 9
//! with these derivatives errs far less than that of degree 6 through its values at the nodes, in which steps are stored.

use super::super::chain::INVERSE;
use super::super::pieces::MOST_PIECES;
use super::super::plan::MOST_SHORTENINGS;
use super::lanes::{LANES, Lanes, exp2, log2};
use crate::collocation::{RADAU, STAGES};

/// A value and four derivatives over factorials, at one point.
type Jet = [Lanes; JET];
const JET: usize = 5;
const NOTHING: Jet = [Lanes::ZERO; JET];

/// Largest interpolation error, relative to that allowed: it is estimated from a polynomial of low degree.
const SAFETY: f64 = 0.7;

// Intermediate results are stored: compilers find vectors of lanes where numbers are written to memory.
/// Steps of all motions in pieces.
pub(super) struct Pieces {
    factors: Factors,
    /// Limit of the interpolation error, and largest displacement of a piece.
    error: f64,
    reach: f64,
    /// Numbers of pieces.
    count: Lanes,
    /// Covered fractions of the step where one piece ends and the next begins, from index 1 on.
    at: [Lanes; MOST_PIECES],
    /// At the ends of the pieces, the first at the start of the step: the times as functions of the fractions, and the fractions as functions of the times.
    time: [Jet; MOST_PIECES + 1],
    fraction: [Jet; MOST_PIECES + 1],
    /// At both ends of each piece, the fractions as functions of the part of its duration.
    ends: [[Jet; 2]; MOST_PIECES],
    /// The fraction as a function of the part of the duration of the step.
    whole: Hermite,
    /// Fractions at the nodes.
    nodes: [[Lanes; STAGES]; MOST_PIECES],
}

impl Pieces {
    pub(super) fn new(error: f64, reach: f64) -> Self {
        Self {
            factors: Factors::new(),
            error,
            reach,
            count: Lanes::all(1.0),
            at: [Lanes::ZERO; MOST_PIECES],
            time: [NOTHING; MOST_PIECES + 1],
            fraction: [NOTHING; MOST_PIECES + 1],
            ends: [[NOTHING; 2]; MOST_PIECES],
            whole: Hermite { start: NOTHING, rest: NOTHING },
            nodes: [[Lanes::ZERO; STAGES]; MOST_PIECES],
        }
    }

    /// The pieces of the step of this lane: times since its start at their ends, and fractions of its displacement at
    /// their nodes. `None` if the tip does not move forward.
    pub(super) fn of_lane(
        &self,
        lane: usize,
    ) -> Option<impl ExactSizeIterator<Item = (f64, [f64; STAGES])>> {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a count")]
        let count = self.count.0[lane] as usize;
        let pieces = self.time[1..=count].iter().zip(&self.nodes);
        let moves_on = self.time[..=count].iter().all(|[_, slowness, ..]| slowness.0[lane] > 0.0);
        moves_on.then(|| {
            pieces.map(move |([end, ..], nodes)| (end.0[lane], nodes.map(|node| node.0[lane])))
        })
    }

    /// Divides steps of these lengths into pieces. `time` are the times as series of the displacement, and become series
    /// of the covered fraction of the step. Steps that are too long for the pieces are shortened, to 0 if that does not help.
    #[inline(always)]
    pub(super) fn divide(&mut self, time: &mut [Lanes], length: &mut Lanes) {
        scale(time, *length);
        for shortenings in 0.. {
            let longest = self.longest(time, *length);
            let shorter = if shortenings < MOST_SHORTENINGS { 0.95 } else { 0.0 };
            let part = longest.map(|longest| {
                let most = longest * MOST_PIECES as f64;
                if most < 1.0 { most * shorter } else { 1.0 }
            });
            if part.0.iter().all(|part| *part >= 1.0) {
                self.count = count(longest);
                break;
            }
            *length *= part;
            scale(time, part);
        }
        let most = self.set_ends(time);
        for (i, ends) in self.ends[..most].iter_mut().enumerate() {
            let duration = self.time[i + 1][0] - self.time[i][0];
            set_in_units(&mut ends[0], &self.fraction[i], duration);
            set_in_units(&mut ends[1], &self.fraction[i + 1], duration);
        }
        for (nodes, ends) in self.nodes.iter_mut().zip(&self.ends[..most]) {
            self.factors.set_nodes(nodes, ends);
        }
    }

    /// The longest parts of the durations of these steps that can be pieces.
    #[inline(always)]
    fn longest(&mut self, time: &[Lanes], length: Lanes) -> Lanes {
        let one = Lanes::all(1.0);
        self.time[0] = *time.first_chunk().expect("an order of several");
        set_jet(&mut self.time[1], time, one);
        set_inverse(&mut self.fraction[0], &self.time[0], Lanes::ZERO);
        set_inverse(&mut self.fraction[1], &self.time[1], one);
        let (duration, [start, end]) = (self.time[1][0], &mut self.ends[0]);
        set_in_units(start, &self.fraction[0], duration);
        set_in_units(end, &self.fraction[1], duration);
        self.whole.set_through(start, end);
        let bound = |steepest| log2(RADAU.interpolation_bound(steepest).max(f64::MIN_POSITIVE));
        let (error, order) = (log2(SAFETY * self.error), INVERSE[STAGES + 1]);
        let steepest = self.whole.steepest() * length;
        let by_error = steepest.map(|steepest| exp2((error - bound(steepest)) * order));
        by_error.smaller(length.map(|length| self.reach / length.max(f64::MIN_POSITIVE)))
    }

    /// Sets the ends of the pieces, about equally far apart in time, and returns the largest number of pieces.
    #[inline(always)]
    fn set_ends(&mut self, time: &[Lanes]) -> usize {
        let most = self.count.0.iter().fold(1.0, |most: f64, count| most.max(*count));
        let part = self.count.map(f64::recip);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a count")]
        let most = most as usize;
        // Of all steps the last of these is the end, which is known.
        (self.time[most], self.fraction[most]) = (self.time[1], self.fraction[1]);
        for (i, at) in self.at[..most].iter_mut().enumerate().skip(1) {
            let about = self.whole.at(part * i as f64);
            for lane in 0..LANES {
                let is_inside = (i as f64) < self.count.0[lane];
                at.0[lane] = if is_inside { about.0[lane] } else { 1.0 };
            }
        }
        for (jet, at) in self.time[..most].iter_mut().zip(&self.at).skip(1) {
            set_jet(jet, time, *at);
        }
        let jets = self.time[..most].iter().zip(&self.at);
        for (inverse, (jet, at)) in self.fraction.iter_mut().zip(jets).skip(1) {
            set_inverse(inverse, jet, *at);
        }
        most
    }
}

/// Numbers of pieces that are no longer than this.
#[inline(always)]
fn count(longest: Lanes) -> Lanes {
    let mut counts = Lanes::all(1.0);
    for lane in 0..LANES {
        for fewer in 1..MOST_PIECES {
            counts.0[lane] += if fewer as f64 * longest.0[lane] < 1.0 { 1.0 } else { 0.0 };
        }
    }
    counts
}

/// The series in units of this length.
#[inline(always)]
fn scale(series: &mut [Lanes], length: Lanes) {
    let mut power = length;
    for coefficient in &mut series[1..] {
        *coefficient *= power;
        power *= length;
    }
}

#[inline(always)]
fn set_jet(jet: &mut Jet, series: &[Lanes], at: Lanes) {
    let mut sums = NOTHING;
    for coefficient in series.iter().rev() {
        for i in (1..JET).rev() {
            sums[i] = sums[i] * at + sums[i - 1];
        }
        sums[0] = sums[0] * at + *coefficient;
    }
    *jet = sums;
}

/// Sets the jet of the inverse function, whose value is `at`.
#[inline(always)]
fn set_inverse(inverse: &mut Jet, jet: &Jet, at: Lanes) {
    inverse[0] = at;
    inverse[1] = jet[1].map(f64::recip);
    let slope = inverse[1];
    let [c2, c3, c4] = [jet[2] * slope, jet[3] * slope, jet[4] * slope];
    let (square, c2c2) = (slope * slope, c2 * c2);
    inverse[2] = Lanes::ZERO - c2 * square;
    inverse[3] = (c2c2 * 2.0 - c3) * (square * slope);
    inverse[4] = (c2 * c3 * 5.0 - c4 - c2 * c2c2 * 5.0) * (square * square);
}

/// Sets the jet of the same function of its variable in this unit.
#[inline(always)]
fn set_in_units(scaled: &mut Jet, jet: &Jet, unit: Lanes) {
    let square = unit * unit;
    scaled[0] = jet[0];
    scaled[1] = jet[1] * unit;
    scaled[2] = jet[2] * square;
    scaled[3] = jet[3] * (square * unit);
    scaled[4] = jet[4] * (square * square);
}

/// The polynomial of degree 9 with given jets at 0 and 1: `Σ_j start_j τ^j + τ^5 Σ_j rest_j (τ - 1)^j`.
struct Hermite {
    start: Jet,
    rest: Jet,
}

impl Hermite {
    #[inline(always)]
    fn set_through(&mut self, start: &Jet, end: &Jet) {
        self.start = *start;
        // What the first sum lacks at 1, times the series of τ^-5 about 1.
        set_jet(&mut self.rest, start, Lanes::all(1.0));
        let lacks = |i: usize| end[i] - self.rest[i];
        let lacks = [lacks(0), lacks(1), lacks(2), lacks(3), lacks(4)];
        self.rest[0] = lacks[0];
        self.rest[1] = lacks[1] - lacks[0] * 5.0;
        self.rest[2] = lacks[2] - lacks[1] * 5.0 + lacks[0] * 15.0;
        self.rest[3] = lacks[3] - lacks[2] * 5.0 + lacks[1] * 15.0 - lacks[0] * 35.0;
        self.rest[4] =
            lacks[4] - lacks[3] * 5.0 + lacks[2] * 15.0 - lacks[1] * 35.0 + lacks[0] * 70.0;
    }

    #[inline(always)]
    fn at(&self, tau: Lanes) -> Lanes {
        let off = tau - Lanes::all(1.0);
        let (mut start, mut rest) = (Lanes::ZERO, Lanes::ZERO);
        for i in (0..JET).rev() {
            start = start * tau + self.start[i];
            rest = rest * off + self.rest[i];
        }
        let square = tau * tau;
        start + square * square * tau * rest
    }

    /// The largest seventh derivative over 7! at the start, the middle and the end: that of the divided differences in an
    /// interpolation error of degree 6.
    #[inline(always)]
    fn steepest(&self) -> Lanes {
        let [_, _, a, b, c] = &self.rest;
        let start = *a - *b * 3.0 + *c * 6.0;
        let middle = *a + *b - *c;
        let end = *a + *b * 5.0 + *c * 10.0;
        start.map(f64::abs).larger(middle.map(f64::abs)).larger(end.map(f64::abs))
    }
}

/// Factors of the jets at 0 and 1 in the values at the nodes of the polynomial of degree 9.
struct Factors([[[f64; JET]; 2]; STAGES]);

impl Factors {
    fn new() -> Self {
        Self(RADAU.c.map(|c| {
            let of_end = |j: usize| if j.is_multiple_of(2) { 1.0 } else { -1.0 };
            [
                std::array::from_fn(|j| of_start(j, c)),
                std::array::from_fn(|j| of_end(j) * of_start(j, 1.0 - c)),
            ]
        }))
    }

    #[inline(always)]
    fn set_nodes(&self, nodes: &mut [Lanes; STAGES], [start, end]: &[Jet; 2]) {
        for (node, [of_start, of_end]) in nodes.iter_mut().zip(&self.0) {
            // In one sum: compilers make vectors of the entries of loops.
            let mut sum = start[0] * of_start[0] + end[0] * of_end[0];
            sum += start[1] * of_start[1] + end[1] * of_end[1];
            sum += start[2] * of_start[2] + end[2] * of_end[2];
            sum += start[3] * of_start[3] + end[3] * of_end[3];
            sum += start[4] * of_start[4] + end[4] * of_end[4];
            *node = sum;
        }
        // To the last bit.
        nodes[STAGES - 1] = end[0];
    }
}

/// The polynomial with the jet τ^j at 0 and nothing at 1: `τ^j (1 - τ)^5` times the series of `(1 - τ)^-5` up to τ^(4-j).
fn of_start(j: usize, tau: f64) -> f64 {
    let binomials = [1.0, 5.0, 15.0, 35.0, 70.0];
    let series = binomials[..JET - j].iter().rev().fold(0.0, |sum, c| sum * tau + c);
    tau.powi(j as i32) * (1.0 - tau).powi(JET as i32) * series
}

#[cfg(test)]
mod tests {
    use super::*;

    /// t = x/(1 - x), so that x = t/(1 + t); each lane in another unit of time.
    fn time(unit: f64) -> Vec<Lanes> {
        let lanes = Lanes(std::array::from_fn(|lane| (lane + 1) as f64 * unit));
        (0..=28).map(|k| if k == 0 { Lanes::ZERO } else { lanes }).collect()
    }

    fn displacement(t: f64, lane: usize) -> f64 {
        t / ((lane + 1) as f64 + t)
    }

    #[test]
    fn pieces_have_the_displacements_at_their_nodes() {
        for (error, least) in [(1e-4, 1), (1e-7, 2), (1e-11, 5)] {
            let mut pieces = Pieces::new(error, 10.0);
            let mut length = Lanes::all(0.3);
            let mut series = time(1.0);
            pieces.divide(&mut series, &mut length);
            assert!(length == Lanes::all(0.3));
            for lane in 0..LANES {
                let of_lane = pieces.of_lane(lane).unwrap();
                assert!(of_lane.len() >= least, "{error:e}: {}", of_lane.len());
                let mut start = 0.0;
                for (end, nodes) in of_lane {
                    for (node, c) in nodes.iter().zip(RADAU.c) {
                        let exact = displacement(start + c * (end - start), lane);
                        assert!((0.3 * node - exact).abs() < 0.03 * error + 1e-14);
                    }
                    // As stored: relative to the start of the piece.
                    let from = displacement(start, lane) / 0.3;
                    let stored = nodes.map(|node| node - from);
                    for i in 1..20 {
                        let tau = 0.05 * f64::from(i);
                        let exact = displacement(start + tau * (end - start), lane);
                        let off = 0.3 * (from + RADAU.value(&stored, tau)) - exact;
                        assert!(off.abs() < error, "{error:e}, {lane}: {off:e}");
                    }
                    start = end;
                }
                assert!((displacement(start, lane) - 0.3).abs() < 1e-14);
            }
        }
    }

    #[test]
    fn a_step_too_long_for_its_pieces_becomes_shorter() {
        let mut pieces = Pieces::new(1e-13, 10.0);
        let mut length = Lanes::all(0.3);
        length.0[2] = 0.1;
        let mut series = time(1.0);
        pieces.divide(&mut series, &mut length);
        assert_eq!(pieces.of_lane(0).unwrap().len(), MOST_PIECES);
        assert!(length.0[0] < 0.29 && length.0[0] > 0.15);
        assert_eq!(length.0[2].to_bits(), 0.1_f64.to_bits());
        let (end, _) = pieces.of_lane(0).unwrap().last().unwrap();
        assert!((displacement(end, 0) - length.0[0]).abs() < 1e-15);
    }

    #[test]
    fn a_tip_that_turns_has_no_pieces() {
        let mut pieces = Pieces::new(1e-6, 10.0);
        pieces.divide(&mut time(-1.0), &mut Lanes::all(0.3));
        assert!(pieces.of_lane(0).is_none());
    }

    /// (1 + τ)^-1: its jets at 0 and 1, and its seventh derivative over 7!.
    #[test]
    fn the_polynomial_is_near_the_function_between_its_jets() {
        let jet = |x: f64| {
            std::array::from_fn(|j| Lanes::all((-1.0_f64).powi(j as i32) * x.powi(-1 - j as i32)))
        };
        let mut polynomial = Hermite { start: NOTHING, rest: NOTHING };
        polynomial.set_through(&jet(1.0), &jet(2.0));
        for i in 0..=10 {
            let tau = 0.1 * f64::from(i);
            let off = polynomial.at(Lanes::all(tau)).0[0] - 1.0 / (1.0 + tau);
            assert!(off.abs() < 3e-5 && (off != 0.0 || i == 0 || i == 10), "{tau}: {off:e}");
        }
        let steepest = polynomial.steepest().0[0];
        assert!((0.3..1.0).contains(&steepest), "{steepest}");
    }
}
