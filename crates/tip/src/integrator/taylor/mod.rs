//! Steps by Taylor series, if the past is a sum of exponentials: long steps, returned in pieces.
//!
//! Collocation makes the other steps: if the groove is stiff ([`switch`]), and with another memory.

mod chain;
mod expansion;
pub(crate) mod heights;
pub(crate) mod length;
pub(crate) mod pieces;
mod plan;
mod series;
mod side_by_side;
pub(crate) mod switch;
pub(crate) mod values;
pub(crate) mod visits;

use super::Integrator;
use crate::collocation::STAGES;
use crate::elementary::exp;
use crate::history::Step;
use crate::memory::Derivatives;
use crate::model::Model;
use crate::state::{Damaged, Reader, State};
use chain::Chain;
pub(crate) use chain::INVERSE;
use heights::{Along, AtCorner};
use pieces::Pieces;
use plan::Plan;
pub(crate) use plan::{FARTHEST, REACH_OF_PIECE, SHARE_OF_INTERPOLATION};
pub(crate) use series::{MOST_ORDER, Series};
use switch::Switch;
use visits::Visits;

pub(crate) use side_by_side::{Begin as BeginBeside, Ended as EndedBeside, SideBySide};

/// Data of steps by series.
#[derive(Debug, Clone)]
pub(super) struct Taylor {
    order: usize,
    /// Relative indentation rate of a tip in steady motion.
    steady_weight: f64,
    derivatives: Derivatives,
    chain: Chain,
    pieces: Pieces,
    switch: Switch,
    visits: Visits,
}

/// Allowed truncation error of a series, relative to the error allowed in a step of collocation: there are fewer steps,
/// but no other measure of their errors.
pub(crate) const SHARE_OF_SERIES: f64 = 0.1;
/// Allowed error of the weights of nodes, relative to the error allowed in a step of collocation.
pub(crate) const SHARE_OF_VISITS: f64 = 0.0005;
/// Result of an attempt to make a planned step.
enum Made {
    Step,
    /// The step must be made on the other side of the kink of |h|.
    OtherSide,
    Nothing,
}

/// Number of sides of the kink.
const SIDES: usize = 2;
/// Largest number of times that a step is shortened to remain where its series is valid; then collocation continues.
pub(crate) const MOST_SHORTENINGS: usize = 8;

impl Taylor {
    pub(super) fn new(model: &Model, target: f64) -> Self {
        Self {
            order: length::order(SHARE_OF_SERIES * target, length::ORDER_PER_DIGIT),
            steady_weight: model.steady_weight(),
            derivatives: Derivatives::nothing(),
            chain: Chain::new(),
            pieces: Pieces::none(),
            switch: Switch::new(model.wider().inertia.is_some()),
            visits: Visits::new(model.tip().band(), SHARE_OF_VISITS * target),
        }
    }

    /// Records a step of collocation; `stiffness` is that of the groove times the length of the step.
    pub(super) fn made(&mut self, stiffness: f64) {
        self.switch.made(stiffness, self.order);
    }

    /// The piece returned last, if it was the last step.
    pub(super) fn taken(&self) -> Option<&Step> {
        self.pieces.taken()
    }

    pub(super) fn save(&self, state: &mut State) {
        self.pieces.save(state);
        self.switch.save(state);
    }

    /// Restores the data for a tip with the time and the extension of the spring in `place`.
    pub(super) fn restore(&mut self, state: &mut Reader, place: (f64, f64)) -> Result<(), Damaged> {
        self.pieces.restore(state, place)?;
        self.switch.restore(state)
    }
}

impl Integrator<'_> {
    /// Takes the next piece of a step by series, or of a new step; false if collocation must make the step.
    #[inline]
    pub(super) fn step_by_series(&mut self, until: f64) -> bool {
        if self.taylor.pieces.left().is_empty() && !self.is_expanded(until) {
            return false;
        }
        let velocity = self.support.velocity(self.t);
        let Some(step) = self.taylor.pieces.take(until, velocity) else { return false };
        self.extension = step.extension_at_end(velocity);
        self.t = step.end();
        self.work.steps += 1;
        true
    }

    /// Makes a new step by series if possible; returns whether it was made.
    #[inline(never)]
    fn is_expanded(&mut self, until: f64) -> bool {
        if self.control.is_fixed() || self.rests() || !self.taylor.switch.is_to_series() {
            return false;
        }
        let made = self.expand(until);
        if !made && self.taylor.switch.left_series() {
            self.hand_over();
        }
        made
    }

    /// Makes a step: its pieces are stored, and the memory contains the whole step.
    fn expand(&mut self, until: f64) -> bool {
        let (x, accuracy) = (self.position(), self.control.target());
        self.surface.enter(&mut self.stretch, x, self.velocity >= 0.0, accuracy);
        let end = self.next_end(until);
        for _ in 0..SIDES {
            if !self.look_ahead() {
                return false;
            }
            let Some(plan) = self.plan(end) else { return false };
            match self.make(&plan, end) {
                Made::Step => return true,
                Made::OtherSide if self.turn() => {}
                Made::OtherSide | Made::Nothing => return false,
            }
        }
        false
    }

    /// Makes the pieces of a step, shortened to where its series, the stretch of u0 and the side of the kink are valid.
    fn make(&mut self, plan: &Plan, end: f64) -> Made {
        let Plan { mut length, mut pieces, .. } = *plan;
        for _ in 0..MOST_SHORTENINGS {
            let Some(total) = self.landing(length, end) else { return Made::Nothing };
            let nodes = pieces::nodes(pieces);
            let mut room = pieces::ROOM_FOR_NODES;
            let heights = self.heights_over(total, &nodes.table, &mut room);
            let shorter = match self.at_corner(heights, total) {
                AtCorner::Apart => {
                    let displacement = self.taylor.chain.displacement().over(total);
                    let mut room = pieces::ROOM_FOR_NODES;
                    let positions = nodes.table.sums(&displacement, &mut room);
                    let Some(shorter) = self.broken(&nodes.parts, positions, total) else {
                        self.accept_series(positions, heights, total);
                        self.remember_series(&displacement, plan.fastest, total);
                        return Made::Step;
                    };
                    shorter
                }
                AtCorner::Ends(at) => at,
                AtCorner::OtherSide => return Made::OtherSide,
            };
            pieces = ((pieces as f64 * shorter / length).ceil() as usize).clamp(1, pieces);
            length = shorter;
        }
        Made::Nothing
    }

    /// A shorter length for a step that leaves the stretch, retreats too far, or overflows; `None` for a valid step.
    fn broken(&self, parts: &[f64], positions: &[f64], total: f64) -> Option<f64> {
        let displacement = self.taylor.chain.displacement().coefficients();
        let value = |part: f64| pieces::value(displacement, part * total);
        if let Some(part) = self.leaves(parts, positions, value) {
            return Some(part * total);
        }
        let derivatives = &self.taylor.derivatives;
        let mut farthest = derivatives.farthest;
        for (part, position) in parts.iter().zip(positions) {
            farthest = farthest.max(*position);
            // A comparison with NaN is false.
            let is_held = *position >= farthest - derivatives.retreat;
            if !(is_held && position.is_finite()) {
                return Some(0.5 * part * total);
            }
        }
        None
    }

    fn accept_series(&mut self, positions: &[f64], heights: Option<Along>, total: f64) {
        let support = self.support.velocity(self.t);
        let (mut t, mut extension, mut before) = (self.t, self.extension, 0.0);
        let (pieces, _) = positions.as_chunks::<STAGES>();
        self.taylor.pieces.clear();
        for (i, positions) in pieces.iter().enumerate() {
            let part = (i + 1) as f64 / pieces.len() as f64;
            // Ends are representable times.
            let end = if i + 1 < pieces.len() { self.t + part * total } else { self.t + total };
            let displacement = positions.map(|position| position - before);
            let height = heights.map(|heights| heights.piece(i));
            let step = Step { t, h: end - t, extension, displacement, height };
            self.taylor.pieces.push(step);
            if i + 1 == pieces.len()
                && let Some((corner, height)) = self.corner.as_mut().zip(height)
            {
                corner.arrive(&height, (t, step.h));
            }
            before = positions[STAGES - 1];
            (t, extension) = (step.end(), step.extension_at_end(support));
        }
        self.taylor.switch.made_series();
        self.work.series += 1;
    }

    fn remember_series(&mut self, displacement: &Series, fastest: f64, total: f64) {
        self.velocity = displacement.slope_at_end() / total;
        // What moves faster and faster is no wave of one length: at its fastest it is the shortest.
        let healing = self.model.wider().healing_time.map_or(0.0, |time| total / time);
        let rule = self.taylor.visits.rule(fastest * total, healing).unwrap_or_else(visits::last);
        let (mut room, mut weights) = (visits::ROOM, [0.0; visits::MOST_NODES]);
        let positions = rule.table.sums(displacement, &mut room);
        let weights = &mut weights[..positions.len()];
        weights.iter_mut().zip(&rule.weights).for_each(|(weight, spent)| *weight = spent * total);
        self.weigh(&rule.table, total, weights);
        if let Some(time) = self.model.wider().healing_time {
            visits::fade(&rule.nodes, total / time, weights);
            self.memory.fade(exp(-total / time));
        }
        self.memory.remember(positions, weights);
    }

    /// Sets the data from which collocation continues.
    fn hand_over(&mut self) {
        self.work.switches += 1;
        self.last = self.last().copied();
        self.taylor.pieces.clear();
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
