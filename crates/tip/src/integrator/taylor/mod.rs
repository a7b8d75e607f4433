//! Steps by Taylor series, where the past is told by exponentials: long ones, handed out in pieces.
//!
//! Collocation makes the other steps: where the groove is stiff ([`switch`]), and where its memory is another.

mod chain;
mod length;
mod pieces;
mod switch;
mod visits;

use super::Integrator;
use crate::collocation::{RADAU, STAGES};
use crate::history::Step;
use crate::memory::{Derivatives, Memory, ROOM, SteadyPast};
use crate::model::Model;
use crate::state::{Damaged, Reader, State};
use crate::step;
use chain::{Acting, Chain};
use pieces::{MOST_PIECES, Pieces};
use switch::Switch;
use visits::Visits;

/// What steps by series need.
#[derive(Debug, Clone)]
pub(super) struct Taylor {
    order: usize,
    /// A steady tip indents at this rate, over α.
    steady_weight: f64,
    told: Derivatives,
    chain: Chain,
    pieces: Pieces,
    switch: Switch,
    visits: Visits,
}

/// A step by series, before it is made.
struct Plan {
    length: f64,
    pieces: usize,
}

/// What a series leaves out may amount to, over the error allowed in a step of collocation: there are fewer steps, but
/// nothing else tells of their errors.
const SHARE_OF_SERIES: f64 = 0.02;
/// What a piece errs by as an interpolant is not carried on: this part of the tolerance.
const SHARE_OF_INTERPOLATION: f64 = 0.1;
/// What visits stand for is known to this part of the same.
const SHARE_OF_VISITS: f64 = 0.0005;
/// A piece leads no farther than this part of what a step of collocation may,
const REACH_OF_PIECE: f64 = 0.7;
/// and a step than so many pieces.
const FARTHEST: f64 = 3.0;
/// A step is shortened so often to stay where its series holds; collocation goes on from there.
const MOST_SHORTENINGS: usize = 8;
const NODES: usize = MOST_PIECES * STAGES;

impl Taylor {
    pub(super) fn new(model: &Model, target: f64) -> Self {
        Self {
            order: length::order(SHARE_OF_SERIES * target),
            steady_weight: model.steady_weight(),
            told: Derivatives::nothing(),
            chain: Chain::new(),
            pieces: Pieces::none(),
            switch: Switch::default(),
            visits: Visits::new(model.tip().band(), SHARE_OF_VISITS * target),
        }
    }

    /// A step of collocation has been made, of this stiffness over it.
    pub(super) fn made(&mut self, stiffness: f64) {
        self.switch.made(stiffness, self.order);
    }

    pub(super) fn save(&self, state: &mut State) {
        self.pieces.save(state);
        self.switch.save(state);
    }

    /// Of a tip that is at this time and so far behind its support.
    pub(super) fn restore(&mut self, state: &mut Reader, place: (f64, f64)) -> Result<(), Damaged> {
        self.pieces.restore(state, place)?;
        self.switch.restore(state)
    }
}

impl<M: Memory> Integrator<'_, M> {
    /// The next piece of a step by series, or of a new one; `None` where collocation is to make the step.
    pub(super) fn step_by_series(&mut self, until: f64) -> Option<Step> {
        if self.taylor.pieces.left().is_empty() {
            if self.control.is_fixed() || !self.taylor.switch.is_to_series() {
                return None;
            }
            if !self.expand(until) {
                if self.taylor.switch.left_series() {
                    self.hand_over();
                }
                return None;
            }
        }
        let velocity = self.support.velocity(self.t);
        let step = self.taylor.pieces.take(until, velocity)?;
        self.extension = step.extension_at_end(velocity);
        self.t = step.end();
        self.last = Some(step);
        self.work.steps += 1;
        Some(step)
    }

    /// Makes a step: its pieces wait, the memory knows of all of it.
    fn expand(&mut self, until: f64) -> bool {
        let (x, accuracy) = (self.position(), self.control.target());
        self.surface.enter(&mut self.stretch, x, self.velocity >= 0.0, accuracy);
        let end = self.next_end(until);
        if !self.look_ahead() {
            return false;
        }
        let Some(plan) = self.plan(end) else { return false };
        self.make(&plan, end)
    }

    /// The series from here on; false where there is none.
    fn look_ahead(&mut self) -> bool {
        let order = self.taylor.order;
        if self.model.wider().depth_limit.is_some() {
            return false;
        }
        let Some(jet) = self.surface.jet_on(&self.stretch, self.position()) else { return false };
        let steady = self.steady_past();
        let told = &mut self.taylor.told;
        if !self.memory.derivatives(steady.as_ref(), order + 1, told) {
            return false;
        }
        if let Some(steady) = steady {
            told.farthest = told.farthest.max(-steady.distance);
        }
        let age = self.t - self.start;
        let relief = self.model.wider().left_after(age);
        let alpha = self.model.alpha();
        let (groove, sources) = self.taylor.chain.start(order);
        for n in 0..order.min(ROOM - 1) {
            groove[n] = alpha * told.past[n + 1];
            sources[n] = alpha * told.of_tip[n + 1];
        }
        for (groove, jet) in groove.iter_mut().zip(jet) {
            *groove -= relief * jet;
        }
        if !self.force.series(self.t, &mut self.taylor.chain.force[..order]) {
            return false;
        }
        let wider = self.model.wider();
        let acting = Acting {
            spring: if wider.spring { 1.0 } else { 0.0 },
            support: self.support.velocity(self.t),
            healing: wider.healing_time.map_or(0.0, |time| 1.0 / time),
            inertia: wider.inertia.map(|mass| (mass, self.velocity)),
            extension: self.extension,
        };
        self.taylor.chain.run(&acting);
        true
    }

    /// What is left of the steady past that the run began with, as far as it can be felt.
    fn steady_past(&self) -> Option<SteadyPast> {
        if self.stretch.flat {
            return None;
        }
        let distance = self.position() - self.surface.steady_position()?;
        let wider = self.model.wider();
        let weight = self.taylor.steady_weight * wider.left_after(self.t - self.start);
        let healing = wider.healing_time.map_or(0.0, |time| 1.0 / time);
        Some(SteadyPast { distance, velocity: self.model.r(), healing, weight })
    }

    /// How long a step, in how many pieces; `None` where collocation gets farther.
    fn plan(&mut self, end: f64) -> Option<Plan> {
        let displacement = self.taylor.chain.displacement();
        let error = SHARE_OF_SERIES * self.control.target();
        let mut length = length::length(displacement, error).min(self.force.longest_step(self.t));
        let limited = self.reach_of_piece();
        let longest = (FARTHEST * limited).min(self.taylor.visits.farthest());
        for _ in 0..MOST_SHORTENINGS {
            let moved = pieces::value(displacement, length).abs();
            if moved <= longest {
                break;
            }
            length *= (0.9 * longest / moved).max(0.3);
        }
        let error = SHARE_OF_INTERPOLATION * self.control.tolerance();
        let moved = pieces::value(displacement, length).abs();
        let piece = pieces::longest(displacement, length, error);
        let piece = piece.min(length * limited / moved.max(f64::MIN_POSITIVE));
        length = length.min(MOST_PIECES as f64 * piece);
        let stiffness = length * self.fastest(-self.taylor.chain.curvature());
        if self.taylor.switch.leaves(stiffness, self.taylor.order) {
            return None;
        }
        // As in collocation: the end is met, or enough left for another step.
        let distance = end - self.t;
        if length >= distance * (1.0 - 1e-9) {
            length = distance;
        } else if 2.0 * length > distance {
            length = 0.5 * distance;
        }
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a count")]
        let pieces = (length / piece).ceil() as usize;
        Some(Plan { length, pieces: pieces.clamp(1, MOST_PIECES) })
    }

    /// How far a piece may lead: its nodes stand for what it carves, and what a surface is made of.
    fn reach_of_piece(&self) -> f64 {
        REACH_OF_PIECE * step::longest_displacement(self.model.tip().band())
    }

    /// The pieces of a step, shortened to where its series and the stretch of u0 hold.
    fn make(&mut self, plan: &Plan, end: f64) -> bool {
        let Plan { mut length, mut pieces } = *plan;
        for _ in 0..MOST_SHORTENINGS {
            let Some(total) = self.landing(length, end) else { return false };
            let mut positions = [0.0; NODES];
            let mut times = [0.0; NODES];
            let mut lengths = [0.0; MOST_PIECES];
            let displacement = self.taylor.chain.displacement();
            let mut from = 0.0;
            for i in 0..pieces {
                let to = if i + 1 < pieces {
                    (self.t + total * ((i + 1) as f64 / pieces as f64)) - self.t
                } else {
                    total
                };
                lengths[i] = to - from;
                let nodes = pieces::nodes(displacement, from, to - from);
                for (j, (node, c)) in nodes.into_iter().zip(RADAU.c).enumerate() {
                    positions[STAGES * i + j] = node;
                    times[STAGES * i + j] = from + c * (to - from);
                }
                from = to;
            }
            let nodes = STAGES * pieces;
            match self.broken(&times[..nodes], &positions[..nodes]) {
                None => {
                    self.accept_series(&lengths[..pieces], &positions[..nodes], total);
                    return true;
                }
                Some(shorter) => {
                    pieces = ((pieces as f64 * shorter / length).ceil() as usize).clamp(1, pieces);
                    length = shorter;
                }
            }
        }
        false
    }

    /// A shorter length for a step that leaves the stretch, or retreats too far.
    fn broken(&self, times: &[f64], positions: &[f64]) -> Option<f64> {
        let displacement = self.taylor.chain.displacement();
        let value = |t: f64| pieces::value(displacement, t);
        if let Some(at) = self.leaves(times, positions, value) {
            return Some(at);
        }
        let told = &self.taylor.told;
        let mut farthest = told.farthest;
        for (t, position) in times.iter().zip(positions) {
            farthest = farthest.max(*position);
            if *position < farthest - told.retreat {
                return Some(0.5 * t);
            }
        }
        None
    }

    fn accept_series(&mut self, lengths: &[f64], positions: &[f64], total: f64) {
        let support = self.support.velocity(self.t);
        let (mut t, mut extension, mut before) = (self.t, self.extension, 0.0);
        self.taylor.pieces.clear();
        for (i, h) in lengths.iter().enumerate() {
            let nodes = STAGES * i..STAGES * (i + 1);
            let displacement = std::array::from_fn(|j| positions[nodes.start + j] - before);
            let step = Step { t, h: *h, extension, displacement, height: None };
            self.taylor.pieces.push(step);
            before = positions[nodes.end - 1];
            (t, extension) = (step.end(), step.extension_at_end(support));
        }
        self.remember_series(total);
        self.velocity = pieces::value(self.taylor.chain.velocity(), total);
        self.taylor.switch.made_series();
        self.work.series += 1;
    }

    /// Tells the memory of the whole step.
    fn remember_series(&mut self, total: f64) {
        let displacement = self.taylor.chain.displacement();
        let velocity = |part: f64| pieces::value(self.taylor.chain.velocity(), part * total).abs();
        // What moves faster and faster is no wave of one length: at its fastest it is the shortest.
        let fastest = velocity(0.0).max(velocity(0.5)).max(velocity(1.0));
        let rule = self.taylor.visits.rule(fastest * total).unwrap_or_else(visits::last);
        let mut at = [(0.0, 0.0); visits::MOST_NODES];
        let (mut positions, mut weights) = ([0.0; visits::MOST_NODES], [0.0; visits::MOST_NODES]);
        let count = rule.nodes.len();
        for (i, (node, weight)) in rule.nodes.iter().zip(&rule.weights).enumerate() {
            at[i] = (node * total, weight * total);
        }
        pieces::values(displacement, &at[..count], &mut positions[..count]);
        let healing = self.model.wider().healing_time;
        for (weight, (t, spent)) in weights.iter_mut().zip(&at[..count]) {
            *weight = spent * self.model.wider().left_after(total - t);
        }
        if let Some(time) = healing {
            self.memory.fade((-total / time).exp());
        }
        self.memory.remember(&positions[..count], &weights[..count]);
    }

    /// What collocation is to go on from.
    fn hand_over(&mut self) {
        self.work.switches += 1;
        let mut slope = [0.0];
        let mut curvature = [0.0];
        let mut groove = crate::memory::Groove::new(&mut slope, &mut curvature);
        self.memory.groove(&[0.0], &mut groove);
        let left = self.model.wider().left_after(self.t - self.start);
        let relief = self.surface.slope_and_curvature_on(&self.stretch, self.position());
        self.curvature = left * relief.1 - self.model.alpha() * curvature[0];
        let force = self.force.value(self.t.next_up());
        if self.model.wider().inertia.is_none() {
            let pull = if self.model.wider().spring { self.extension } else { 0.0 };
            self.velocity = self.model.alpha() * slope[0] - left * relief.0 + pull + force;
        }
        self.limits_from_before = (left * relief.0, force);
        if let Some(last) = &self.last {
            self.control.resume(last.h);
        }
    }
}
