//! Steps by Taylor series, if the past is a sum of exponentials: long steps, returned in pieces.
//!
//! Collocation makes the other steps: if the groove is stiff ([`switch`]), and with another memory.

mod chain;
mod expansion;
pub(crate) mod heights;
pub(crate) mod length;
pub(crate) mod pieces;
pub(crate) mod plan;
mod series;
mod side_by_side;
pub(crate) mod switch;
pub(crate) mod values;
pub(crate) mod visits;

use super::Integrator;
use super::corner::Corner;
use super::landing::landing;
use crate::elementary::{exp, larger, smaller};
use crate::history::Step;
use crate::memory::Derivatives;
use crate::model::Model;
use crate::sorting::ends_of;
use crate::state::{Damaged, Reader, State};
use crate::step;
use chain::Chain;
pub(crate) use chain::INVERSE;
use heights::{Along, AtCorner, at_corner};
use pieces::Pieces;
use plan::{Limits, Plan};
pub(crate) use series::{MOST_ORDER, Series};
use switch::Switch;
use values::Outlook;

pub(crate) use side_by_side::{Begin as BeginBeside, SideBySide};

/// Data of steps by series.
#[derive(Debug, Clone)]
pub(super) struct Taylor {
    limits: Limits,
    /// Relative indentation rate of a tip in steady motion.
    steady_weight: f64,
    derivatives: Derivatives,
    chain: Chain,
    pieces: Pieces,
    switch: Switch,
}

/// Result of an attempt to make a planned step.
pub(crate) enum Made {
    Step,
    /// The step must be made on the other side of the kink of |h|.
    OtherSide,
    Nothing,
}

/// Number of sides of the kink.
pub(crate) const SIDES: usize = 2;

impl Taylor {
    pub(super) fn new(model: &Model, tolerance: f64) -> Self {
        Self {
            limits: Limits::new(model.tip().band(), tolerance, length::ORDER_PER_DIGIT),
            steady_weight: model.steady_weight(),
            derivatives: Derivatives::nothing(),
            chain: Chain::new(),
            pieces: Pieces::default(),
            switch: Switch::new(model.wider().inertia.is_some()),
        }
    }

    /// Records a step of collocation; `stiffness` is that of the groove times the length of the step.
    pub(super) fn made(&mut self, stiffness: f64) {
        self.switch.made(stiffness, self.limits.order);
    }

    /// The piece returned last, if it was the last step.
    pub(super) fn taken(&self) -> Option<&Step> {
        self.pieces.taken()
    }

    /// The pieces that have not been returned.
    pub(super) fn left(&self) -> &[Step] {
        self.pieces.left()
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
    pub(super) fn step_by_series(&mut self) -> bool {
        if self.taylor.pieces.left().is_empty() && !self.is_expanded() {
            return false;
        }
        let velocity = self.support.velocity(self.t);
        let Some(step) = self.taylor.pieces.take() else { return false };
        self.extension = step.extension_at_end(velocity);
        self.t = step.end();
        self.work.steps += 1;
        true
    }

    /// Makes a new step by series if possible; returns whether it was made.
    #[inline(never)]
    fn is_expanded(&mut self) -> bool {
        if self.control.is_fixed() || self.rests() || !self.taylor.switch.is_to_series() {
            return false;
        }
        let made = self.expand();
        if !made && self.taylor.switch.left_series() {
            self.hand_over();
        }
        made
    }

    /// Makes a step: its pieces are stored, and the memory contains the whole step.
    fn expand(&mut self) -> bool {
        let (x, accuracy) = (self.position(), self.control.target());
        self.surface.enter(&mut self.stretch, x, self.velocity >= 0.0, accuracy);
        let end = self.next_end();
        for _ in 0..SIDES {
            if !self.look_ahead() {
                return false;
            }
            let Some(plan) = self.plan(end) else { return false };
            match self.make(&plan, end) {
                Made::Step => return true,
                Made::OtherSide if self.corner.as_mut().is_some_and(Corner::turn) => {}
                Made::OtherSide | Made::Nothing => return false,
            }
        }
        false
    }

    /// Length of a step, and number of its pieces; `None` if a step of collocation is longer.
    fn plan(&mut self, end: f64) -> Option<Plan> {
        let Taylor { chain, limits, switch, .. } = &mut self.taylor;
        let (series, wider) = (chain.displacement(), self.model.wider());
        let heights = self.corner.as_ref().map(|corner| (corner, chain.height()));
        let over =
            smaller(limits.accurate(series, heights, wider), self.force.longest_step(self.t));
        let longest = limits.farthest(wider.healing_time.map_or(0.0, |time| over / time));
        let (over, mut outlook) = plan::within(over, longest, |over| Outlook::over(series, over));
        let of_heights = heights::steepness(self.corner.as_ref(), chain.height(), over);
        outlook.steepest = larger(of_heights, outlook.steepest);
        let stiffness = step::fastest(1.0 - chain.curvature(), wider.inertia);
        limits.plan(switch, (over, outlook), stiffness, end - self.t)
    }

    /// Makes the pieces of a step, shortened to where its series, the stretch of u0 and the side of the kink are valid.
    fn make(&mut self, plan: &Plan, end: f64) -> Made {
        let Plan { mut length, mut pieces, .. } = *plan;
        for _ in 0..plan::MOST_SHORTENINGS {
            let Some(total) = landing(self.t, length, end) else { return Made::Nothing };
            let nodes = pieces::nodes(pieces);
            let mut room = pieces::ROOM_FOR_NODES;
            let height = self.taylor.chain.height();
            let heights = self.corner.map(|_| Along::over(height, total, &nodes.table, &mut room));
            let shorter = match at_corner(self.corner.as_ref(), heights, (self.t, total)) {
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
            (pieces, length) = (plan::count(pieces as f64 * shorter, length).min(pieces), shorter);
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
        // Most steps are far from any limit, which the least and the largest position tell.
        let (least, most) = ends_of(positions);
        let is_finite = least <= most && (most - least).is_finite();
        if is_finite && least >= larger(most, farthest) - derivatives.retreat {
            return None;
        }
        for (part, position) in parts.iter().zip(positions) {
            farthest = larger(*position, farthest);
            // A comparison with NaN is false.
            let is_held = *position >= farthest - derivatives.retreat;
            if !(is_held && position.is_finite()) {
                return Some(0.5 * part * total);
            }
        }
        None
    }

    fn accept_series(&mut self, positions: &[f64], heights: Option<Along>, total: f64) {
        let springs = (self.extension, self.support.velocity(self.t));
        self.taylor.pieces.clear();
        for step in pieces::steps(
            (self.t, total),
            springs,
            positions.as_chunks().0.iter().copied(),
            heights,
        ) {
            self.taylor.pieces.push(step);
        }
        if let Some(corner) = &mut self.corner {
            self.taylor.pieces.left().iter().for_each(|step| corner.arrive(step));
        }
        self.taylor.switch.made_series();
        self.work.series += 1;
    }

    fn remember_series(&mut self, displacement: &Series, fastest: f64, total: f64) {
        self.velocity = displacement.slope_at_end() / total;
        // What moves faster and faster is no wave of one length: at its fastest it is the shortest.
        let healing = self.model.wider().healing_time.map_or(0.0, |time| total / time);
        let Taylor { limits, chain, .. } = &self.taylor;
        let rule = limits.visits.rule(fastest * total, healing).unwrap_or_else(visits::last);
        let (mut room, mut room_for_weights) = (visits::ROOM, [0.0; visits::MOST_NODES]);
        let positions = rule.table.sums(displacement, &mut room);
        let felt = self.corner.map(|_| chain.weights());
        let weights = rule.weights((total, healing), felt, &mut room_for_weights);
        if healing > 0.0 {
            self.memory.fade(exp(-healing));
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
