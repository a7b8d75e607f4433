//! Several motions in SIMD lanes, each with its own step lengths and end.
//!
//! A step by series takes the same sums for every motion: derivatives, coefficients, contributions of visits. Here they
//! are computed for several motions together, in the basic model without forces, noise or profiles, for one footprint
//! and one sum of exponentials. When a motion ends, the next one takes its lane. The numbers of a lane depend on its
//! own motion only, so that the other motions do not matter.
//!
//! Motions that become too stiff for series, or retreat too far, must be integrated by other means, from their start.

mod expansion;
mod lanes;
mod past;
mod plan;

use super::pieces::{self, MOST_PIECES};
use super::plan::to_end;
use super::switch::Switch;
use super::visits::{self, Rule};
use crate::collocation::{RADAU, STAGES, Stages};
use crate::history::Step;
use crate::integrator::Work;
use crate::integrator::landing::landing;
use crate::memory::Fit;
use crate::{TipFunction, stop};
use expansion::{Acting, Expansion};
use lanes::{LANES, Lanes};
use multiversion::multiversion;
use num_complex::Complex;
use past::{Exponentials, MOST_STRETCHES, Past, Visits};
use plan::Plan;

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
    /// Largest distance from the middle of a stretch at which polynomials represent all exponentials.
    expanded: f64,
    /// Largest distance of a tip behind its farthest position, within a step and between steps.
    retreat: f64,
    between_steps: f64,
    /// Largest number of steps of a motion.
    most_steps: u64,
}

/// The numbers of all lanes.
struct Numbers {
    acting: Acting,
    past: Past,
    expansion: Expansion,
    plan: Plan,
    length: Lanes,
    /// Coefficients of the displacements in powers of the elapsed fraction of a step.
    displacement: Vec<Lanes>,
    /// Numbers of pieces of the steps, displacements at the nodes of the pieces, and 1 where these never decrease.
    pieces: Lanes,
    nodes: [[Lanes; STAGES]; MOST_PIECES],
    moves_on: Lanes,
    visits: Visits,
}

/// A motion in progress.
struct Member<C> {
    begin: Begin,
    t: f64,
    extension: f64,
    /// The farthest position reached so far, relative to the present one.
    farthest: f64,
    switch: Switch,
    collector: C,
    work: Work,
}

/// Share of the error allowed in a step, and increase of the order for an error smaller by the factor e. The order is
/// lower than that of a single motion, as the triangle of products takes more of the time here.
const SERIES: (f64, f64) = (0.07, 0.9);
/// Cost of a step of collocation, relative to that of a series in one of eight lanes.
const COST_OF_COLLOCATION: f64 = 16.0;

impl SideBySide {
    /// The integrator for this footprint and the exponentials that represent it.
    pub(crate) fn new(tip: &TipFunction, fit: &Fit, tolerance: f64, most_steps: u64) -> Self {
        let exponentials = Exponentials::new(fit);
        let of_series = super::plan::Limits::new(tip.band(), tolerance, SERIES);
        let order = of_series.order;
        let farthest = MOST_STRETCHES as f64 * exponentials.longest();
        let limits = Limits {
            longest: of_series.farthest(0.0).min(farthest),
            of_series,
            expanded: exponentials.longest(),
            retreat: fit.retreat(),
            between_steps: fit.retreat_between_steps(),
            most_steps,
        };
        let zero = Lanes::ZERO;
        let numbers = Numbers {
            acting: Acting { alpha: zero, support: zero, extension: zero },
            past: Past::nothing(&exponentials),
            expansion: Expansion::new(order),
            plan: Plan::NONE,
            length: zero,
            displacement: vec![zero; order + 1],
            pieces: Lanes::all(1.0),
            nodes: [[zero; STAGES]; MOST_PIECES],
            moves_on: zero,
            visits: Visits::none(),
        };
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
    fn enter<C>(&mut self, lane: usize, (begin, collector): (Begin, C)) -> Member<C> {
        let Begin { alpha, r, t, extension, steady, .. } = begin;
        let Numbers { acting, past, .. } = &mut self.numbers;
        (acting.alpha.0[lane], acting.support.0[lane]) = (alpha, r);
        match steady {
            Some(ahead) => past.set(lane, self.exponentials.steady(r, ahead)),
            None => past.set(lane, std::iter::repeat(Complex::ZERO)),
        }
        let farthest = steady.unwrap_or(f64::NEG_INFINITY);
        let switch = Switch::at_cost(COST_OF_COLLOCATION);
        Member { begin, t, extension, farthest, switch, collector, work: Work::default() }
    }

    /// Makes one step of each motion.
    fn step<C: Extend<Step>>(
        &mut self,
        members: &mut [Option<Member<C>>; LANES],
        ended: &mut impl FnMut(usize, C, Work),
    ) {
        let Self { limits, exponentials, numbers } = self;
        for (lane, member) in members.iter().enumerate() {
            numbers.acting.extension.0[lane] = member.as_ref().map_or(0.0, |m| m.extension);
        }
        expand(numbers, exponentials, limits);
        for (lane, member) in members.iter_mut().enumerate() {
            let length = member.as_mut().and_then(|member| member.length(limits, numbers, lane));
            numbers.length.0[lane] = length.unwrap_or(0.0);
        }
        follow(numbers);
        for (lane, place) in members.iter_mut().enumerate() {
            let Some(member) = place else { continue };
            let rule = member.advance(limits, numbers, lane);
            if let Some(rule) = rule {
                numbers.visits.set(lane, rule);
            }
            let goes_on = rule.is_some() && member.t < member.begin.until;
            if let Some(Member { begin, collector, work, .. }) = place.take_if(|_| !goes_on)
                && rule.is_some()
            {
                ended(begin.number, collector, work);
            }
        }
        remember(numbers, exponentials);
    }
}

impl<C: Extend<Step>> Member<C> {
    /// Length of the next step; `None` if the motion must be integrated elsewhere.
    fn length(&mut self, limits: &Limits, numbers: &Numbers, lane: usize) -> Option<f64> {
        let Plan { length, by_stages, .. } = &numbers.plan;
        let (length, most) = (length.0[lane], by_stages.0[lane]);
        let fades = 1.0 - numbers.expansion.curvature().0[lane];
        if self.switch.leaves(fades * length, fades * most, limits.of_series.order) {
            return None;
        }
        let until = self.begin.until;
        landing(self.t, to_end(length, until - self.t), until)
    }

    /// Makes the step, and returns the rule for its visits; `None` if the motion must be integrated elsewhere.
    fn advance(
        &mut self,
        limits: &Limits,
        numbers: &Numbers,
        lane: usize,
    ) -> Option<&'static Rule> {
        let total = numbers.length.0[lane];
        if total <= 0.0 {
            return None;
        }
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a count")]
        let pieces = &numbers.nodes[..numbers.pieces.0[lane] as usize];
        let nodes = Nodes { pieces, lane };
        self.passes(limits, nodes, numbers.moves_on.0[lane] > 0.0)?;
        self.take(nodes, total);
        let rule = limits.of_series.visits.rule(numbers.plan.fastest.0[lane] * total, 0.0);
        Some(rule.unwrap_or_else(visits::last))
    }

    /// Checks the positions of a step; `None` if the tip retreats too far or the number of steps exceeds its limit.
    fn passes(&mut self, limits: &Limits, nodes: Nodes<'_>, moves_on: bool) -> Option<()> {
        let end = nodes.end();
        let mut farthest = self.farthest.max(end);
        if !(moves_on && end <= limits.longest) {
            farthest = self.farthest;
            for position in nodes.positions() {
                farthest = farthest.max(position);
                // All in one stretch.
                let is_near = (position - 0.5 * end).abs() <= limits.expanded;
                if !(is_near && position >= farthest - limits.retreat) {
                    return None;
                }
            }
        }
        self.farthest = farthest - end;
        let has_room = self.work.steps + MOST_PIECES as u64 <= limits.most_steps;
        (self.farthest <= limits.between_steps && has_room).then_some(())
    }

    /// Passes the pieces of a step to the collector.
    fn take(&mut self, nodes: Nodes<'_>, total: f64) {
        let (mut t, mut extension) = (self.t, self.extension);
        let r = self.begin.r;
        let pieces = nodes.pieces.iter().map(|piece| nodes.of(piece));
        let steps = pieces::steps((t, total), (extension, r), pieces, None).inspect(|step| {
            (t, extension) = (step.end(), step.extension_at_end(r));
        });
        self.collector.extend(steps);
        (self.t, self.extension) = (t, extension);
        self.work.steps += nodes.pieces.len() as u64;
        self.work.series += 1;
    }
}

/// The displacements of one motion at the nodes of the pieces of its step.
#[derive(Clone, Copy)]
struct Nodes<'a> {
    pieces: &'a [[Lanes; STAGES]],
    lane: usize,
}

impl Nodes<'_> {
    fn of(&self, piece: &[Lanes; STAGES]) -> Stages {
        let mut positions = [0.0; STAGES];
        for (position, node) in positions.iter_mut().zip(piece) {
            *position = node.0[self.lane];
        }
        positions
    }

    fn positions(&self) -> impl Iterator<Item = f64> {
        self.pieces.iter().flat_map(|piece| self.of(piece))
    }

    fn end(&self) -> f64 {
        self.pieces[self.pieces.len() - 1][STAGES - 1].0[self.lane]
    }
}

/// Computes the series, and from them the lengths of the steps. Also compiled for wider vectors: lanes are independent.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512dq", "x86_64+avx2"))]
fn expand(numbers: &mut Numbers, exponentials: &Exponentials, limits: &Limits) {
    let Numbers { acting, past, expansion, plan, .. } = numbers;
    past.derivatives(exponentials, acting.alpha, expansion.start());
    expansion.run(acting, &exponentials.of_tip);
    *plan = Plan::of(limits, expansion.displacement());
}

/// Computes the displacements at the nodes of the pieces, up to the largest number of pieces of any lane.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512dq", "x86_64+avx2"))]
fn follow(numbers: &mut Numbers) {
    let Numbers { expansion, plan, length, displacement, pieces, nodes, moves_on, .. } = numbers;
    let mut power = *length;
    for (scaled, coefficient) in displacement[1..].iter_mut().zip(&expansion.displacement()[1..]) {
        *scaled = *coefficient * power;
        power *= *length;
    }
    *pieces = plan.pieces(*length);
    let most = pieces.0.iter().fold(1.0, |most: f64, count| most.max(*count));
    let part = pieces.map(f64::recip);
    let mut before = Lanes::ZERO;
    *moves_on = Lanes::all(1.0);
    for (i, nodes) in nodes.iter_mut().enumerate() {
        if i as f64 >= most {
            break;
        }
        // Not by `map` of arrays: see `Lanes::map`.
        let mut at = [Lanes::ZERO; STAGES];
        for (at, c) in at.iter_mut().zip(&RADAU.c) {
            *at = part * (i as f64 + c);
        }
        let mut values = [Lanes::ZERO; STAGES];
        for coefficient in displacement.iter().rev() {
            for (value, at) in values.iter_mut().zip(&at) {
                *value = *value * *at + *coefficient;
            }
        }
        for value in &values {
            for lane in 0..LANES {
                let rises = value.0[lane] >= before.0[lane] || i as f64 >= pieces.0[lane];
                moves_on.0[lane] = if rises { moves_on.0[lane] } else { 0.0 };
            }
            before = *value;
        }
        *nodes = values;
    }
}

#[multiversion(targets("x86_64+avx512f+avx512vl+avx512dq", "x86_64+avx2"))]
fn remember(numbers: &mut Numbers, exponentials: &Exponentials) {
    let Numbers { past, displacement, visits, length, .. } = numbers;
    past.remember(exponentials, displacement, (visits, *length));
}
