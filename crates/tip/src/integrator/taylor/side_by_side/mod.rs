//! Several motions in SIMD lanes, each with its own step lengths and end.
//!
//! A step by series takes the same sums for every motion: derivatives, coefficients, contributions to the groove. Here
//! they are computed for several motions together, in the basic model without forces, noise or profiles, for one
//! footprint and one sum of exponentials. Where the tip moves forward the time is a series of the displacement
//! ([`series`]), which takes fewer sums and longer steps than the displacement as a series of time. When a motion ends,
//! the next one takes its lane. The numbers of a lane depend on its own motion only, so that the other motions do not
//! matter.
//!
//! Motions that nearly stop, or become too stiff for series, must be integrated by other means, from their start.

mod dense;
mod lanes;
mod past;
mod rest;
mod series;

use super::chain::INVERSE;
use super::length::{LAST, ORDER_PER_DIGIT};
use super::switch::Switch;
use crate::TipFunction;
use crate::collocation::STAGES;
use crate::history::Step;
use crate::integrator::Work;
use crate::integrator::landing::landing;
use crate::memory::Fit;
use crate::stop;
use dense::Pieces;
use lanes::{LANES, Lanes, exp2, log2};
use multiversion::multiversion;
use num_complex::Complex;
use past::{Exponentials, Past};
use series::{Acting, Series};

#[derive(Debug, Clone, Copy)]
pub(crate) struct Begin {
    /// The caller's number for this motion.
    pub(crate) number: usize,
    pub(crate) alpha: f64,
    pub(crate) r: f64,
    pub(crate) t: f64,
    /// R - x0 at the start.
    pub(crate) extension: f64,
    pub(crate) until: f64,
    /// Distance ahead of the tip at which steady motion before the run ended; `None` without steady motion.
    pub(crate) steady: Option<f64>,
}

/// An integrator of several motions with one footprint and one tolerance.
pub(crate) struct SideBySide {
    limits: Limits,
    exponentials: Exponentials,
    numbers: Numbers,
}

struct Limits {
    of_series: super::plan::Limits,
    /// Largest displacement in a step.
    longest: f64,
    /// Largest number of steps of a motion.
    most_steps: u64,
}

/// The numbers of all lanes.
struct Numbers {
    acting: Acting,
    past: Past,
    series: Series,
    /// Minus the stiffness of the groove at the start.
    curvature: Lanes,
    /// Displacements of the steps, and the times that they take.
    length: Lanes,
    duration: Lanes,
    /// The times as series of the covered fractions of the steps.
    time: Vec<Lanes>,
    pieces: Pieces,
}

/// A motion in progress.
struct Member<C> {
    begin: Begin,
    t: f64,
    /// R - x0 at the time t.
    extension: f64,
    /// Time by which the motion is ahead of t: steps end at representable times, displacements do not.
    ahead: f64,
    switch: Switch,
    collector: C,
    work: Work,
}

/// Cost of a step of collocation, relative to that of a series in one of eight lanes.
const COST_OF_COLLOCATION: f64 = 16.0;
/// Least velocity of a tip, relative to that of its support: near rest, steps become ever shorter.
const SLOWEST: f64 = 0.01;

impl SideBySide {
    /// The integrator for this footprint and the exponentials that represent it.
    pub(crate) fn new(tip: &TipFunction, fit: &Fit, tolerance: f64, most_steps: u64) -> Self {
        let exponentials = Exponentials::new(fit);
        let of_series = super::plan::Limits::new(tip.band(), tolerance, ORDER_PER_DIGIT);
        let zero = Lanes::ZERO;
        let numbers = Numbers {
            acting: Acting { alpha: zero, support: zero, extension: zero },
            past: Past::nothing(&exponentials),
            series: Series::new(of_series.order),
            curvature: zero,
            length: zero,
            duration: zero,
            time: vec![zero; of_series.order + 1],
            pieces: Pieces::new(of_series.of_piece, of_series.reach),
        };
        let longest = of_series.farthest(0.0).min(exponentials.farthest());
        let limits = Limits { of_series, longest, most_steps };
        Self { limits, exponentials, numbers }
    }

    /// Integrates all of these motions, and passes the steps of each to its collector. Reports each motion that is
    /// complete, by number and collector. Motions that must be integrated elsewhere are not reported, nor those that
    /// remain after a request to stop.
    pub(crate) fn run<C: Extend<Step>>(
        &mut self,
        mut begins: impl Iterator<Item = (Begin, C)>,
        mut ended: impl FnMut(usize, C, Work),
    ) {
        let mut members = [const { None }; LANES];
        loop {
            for (lane, place) in members.iter_mut().enumerate().filter(|(_, m)| m.is_none()) {
                *place = begins.next().map(|begin| self.enter(lane, begin));
            }
            if members.iter().all(Option::is_none) || stop::is_requested() {
                return;
            }
            self.step(&mut members, &mut ended);
        }
    }

    /// Starts a motion in a lane.
    fn enter<C: Extend<Step>>(
        &mut self,
        lane: usize,
        (begin, mut collector): (Begin, C),
    ) -> Member<C> {
        let Self { limits, exponentials, numbers: Numbers { acting, past, .. } } = self;
        let Begin { alpha, r, mut t, mut extension, steady, .. } = begin;
        (acting.alpha.0[lane], acting.support.0[lane]) = (alpha, r);
        let mut work = Work::default();
        match steady {
            Some(ahead) => past.set(lane, exponentials.steady(r, ahead)),
            None => past.set(lane, std::iter::repeat(Complex::ZERO)),
        }
        if steady.is_none() && extension <= SLOWEST * r {
            let limits = (&limits.of_series, limits.longest);
            if let Some((steps, states)) = rest::first_step(&begin, limits, exponentials) {
                past.set(lane, states.into_iter());
                (work.steps, work.series) = (steps.len() as u64, 1);
                collector.extend(steps.into_iter().inspect(|step| {
                    (t, extension) = (step.end(), step.extension_at_end(r));
                }));
            }
        }
        let switch = Switch::at_cost(COST_OF_COLLOCATION);
        Member { begin, t, extension, ahead: 0.0, switch, collector, work }
    }

    /// Makes one step of each motion.
    fn step<C: Extend<Step>>(
        &mut self,
        members: &mut [Option<Member<C>>; LANES],
        ended: &mut impl FnMut(usize, C, Work),
    ) {
        let Self { limits, exponentials, numbers } = self;
        for (lane, member) in members.iter().enumerate() {
            let extension = |m: &Member<C>| m.extension + m.begin.r * m.ahead;
            numbers.acting.extension.0[lane] = member.as_ref().map_or(0.0, extension);
        }
        expand(numbers, exponentials, limits);
        for (lane, member) in members.iter_mut().enumerate() {
            let length = member.as_mut().and_then(|member| member.length(limits, numbers, lane));
            numbers.length.0[lane] = length.unwrap_or(0.0);
        }
        follow(numbers);
        for (lane, place) in members.iter_mut().enumerate() {
            let Some(member) = place else { continue };
            let has_moved = member.advance(limits, numbers, lane).is_some();
            let goes_on = has_moved && member.t < member.begin.until;
            if let Some(Member { begin, collector, work, .. }) = place.take_if(|_| !goes_on)
                && has_moved
            {
                ended(begin.number, collector, work);
            }
        }
        remember(numbers, exponentials);
    }
}

impl<C: Extend<Step>> Member<C> {
    /// Displacement of the next step; `None` if the motion must be integrated elsewhere.
    fn length(&mut self, limits: &Limits, numbers: &Numbers, lane: usize) -> Option<f64> {
        let (length, duration) = (numbers.length.0[lane], numbers.duration.0[lane]);
        let velocity = numbers.series.velocity().0[lane];
        // Comparisons with NaN are false.
        if !(velocity > SLOWEST * self.begin.r && duration > 0.0) {
            return None;
        }
        let stiffness = 1.0 - numbers.curvature.0[lane];
        let most = limits.of_series.longest_stages(velocity.max(length / duration));
        if self.switch.leaves(stiffness * duration, stiffness * most, limits.of_series.order) {
            return None;
        }
        let left = self.begin.until - self.t - self.ahead;
        if duration < left * (1.0 - 1e-9) {
            return Some(length);
        }
        Some(position_at(left, (numbers.series.time(), lane), length * (left / duration)))
    }

    /// Makes the step; `None` if the motion must be integrated elsewhere.
    fn advance(&mut self, limits: &Limits, numbers: &Numbers, lane: usize) -> Option<()> {
        let Begin { r, until, .. } = self.begin;
        let (length, pieces) = (numbers.length.0[lane], numbers.pieces.of_lane(lane)?);
        let count = pieces.len() as u64;
        if self.work.steps + count > limits.most_steps {
            return None;
        }
        let (start, ahead, mut elapsed, mut before) = (self.t, self.ahead, 0.0, 0.0);
        let (mut t, mut extension, mut landed) = (self.t, self.extension, 0);
        self.collector.extend(pieces.map_while(|(end, nodes)| {
            let h = landing(t, (start - t) + (ahead + end), until)?;
            let displacement = nodes.map(|node| node * length - before);
            let step = Step { t, h, extension, displacement, height: None };
            (t, extension, elapsed) = (step.end(), step.extension_at_end(r), end);
            (before, landed) = (before + displacement[STAGES - 1], landed + 1);
            Some(step)
        }));
        (self.t, self.extension, self.ahead) = (t, extension, ahead + elapsed - (t - start));
        self.work.steps += count;
        self.work.series += 1;
        (landed == count).then_some(())
    }
}

/// The displacement at this time, near `x`.
fn position_at(time: f64, (series, lane): (&[Lanes], usize), mut x: f64) -> f64 {
    for _ in 0..MOST_ITERATIONS {
        let (mut value, mut slope) = (0.0, 0.0);
        for coefficient in series.iter().rev() {
            slope = slope * x + value;
            value = value * x + coefficient.0[lane];
        }
        let correction = (time - value) / slope;
        x += correction;
        if correction.abs() <= f64::EPSILON * x {
            break;
        }
    }
    x
}

/// Newton's method begins within a few per cent.
const MOST_ITERATIONS: usize = 8;

/// Computes the series, and from them the lengths of the steps. Also compiled for wider vectors: lanes are independent.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512dq", "x86_64+avx2"))]
fn expand(numbers: &mut Numbers, exponentials: &Exponentials, limits: &Limits) {
    let Numbers { acting, past, series, curvature, length, duration, .. } = numbers;
    past.slopes(exponentials, acting.alpha, series.start());
    *curvature = series.start()[1];
    series.run(acting, &exponentials.own);
    let accurate = accurate(series.time(), limits.of_series.error, acting.support);
    *length = accurate.smaller(Lanes::all(limits.longest));
    *duration = Lanes::ZERO;
    for coefficient in series.time().iter().rev() {
        *duration = *duration * *length + *coefficient;
    }
}

/// As [`length`](super::length::length), for the displacement: an error of the time counts by the mean velocity.
#[inline(always)]
fn accurate(series: &[Lanes], error: f64, velocity: Lanes) -> Lanes {
    let (order, wanted) = (series.len() - 1, log2(error));
    let mut shortest = Lanes::all(f64::INFINITY);
    for before in 0..LAST {
        let digits = |coefficient: f64| {
            let size = coefficient.abs().max(f64::MIN_POSITIVE);
            (wanted - log2(size) + before as f64) * INVERSE[order - before]
        };
        shortest = shortest.smaller((series[order - before] * velocity).map(digits));
    }
    shortest.map(exp2)
}

/// Divides the steps into pieces.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512dq", "x86_64+avx2"))]
fn follow(numbers: &mut Numbers) {
    let Numbers { series, length, time, pieces, .. } = numbers;
    time.copy_from_slice(series.time());
    pieces.divide(time, length);
}

#[multiversion(targets("x86_64+avx512f+avx512vl+avx512dq", "x86_64+avx2"))]
fn remember(numbers: &mut Numbers, exponentials: &Exponentials) {
    let Numbers { past, time, length, .. } = numbers;
    past.remember(exponentials, time, *length);
}
