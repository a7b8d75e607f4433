//! Steps by Taylor series: long steps, returned in pieces.

use super::super::chain::Acting;
use super::super::history::Step;
use super::super::part::Part;
use super::super::scenario::PlanarError;
use super::PlanarRunning;
use crate::collocation::STAGES;
use crate::integrator::corner::Corner;
use crate::integrator::landing::landing;
use crate::integrator::taylor::heights::{self, Along, AtCorner, at_corner};
use crate::integrator::taylor::plan::{self, Plan};
use crate::integrator::taylor::values::Outlook;
use crate::integrator::taylor::{Made, SIDES, length, pieces, visits};

impl PlanarRunning<'_> {
    /// Makes a step: its pieces are stored, and the memory contains the whole step. False if collocation must make the
    /// step.
    pub(super) fn step_by_series(&mut self) -> Result<bool, PlanarError> {
        if self.control.is_fixed() || !self.switch.is_to_series() {
            return Ok(false);
        }
        let end = self.next_end();
        let made = self.expand(end)?;
        if !made && self.switch.left_series() {
            self.work.switches += 1;
            if let Some(last) = &self.last {
                self.control.resume(last.along.h);
            }
        }
        Ok(made)
    }

    /// Makes a step if there is a series that is longer than a step of collocation.
    fn expand(&mut self, end: f64) -> Result<bool, PlanarError> {
        self.enter_field();
        for _ in 0..SIDES {
            let plan = if self.look_ahead() { self.plan(end) } else { None };
            let Some(plan) = plan else { return Ok(false) };
            match self.make(&plan, end)? {
                Made::Step => return Ok(true),
                Made::OtherSide if self.corner.as_mut().is_some_and(Corner::turn) => {}
                Made::OtherSide | Made::Nothing => return Ok(false),
            }
        }
        Ok(false)
    }

    /// Computes the series from the present time on; false if there is none.
    fn look_ahead(&mut self) -> bool {
        // Grooves of earlier lines have derivatives up to the second only.
        if self.earlier.is_some() || !self.parts.iter().all(|part| part.past.knows_series()) {
            return false;
        }
        let (order, alpha) = (self.chain.order(), self.model.alpha());
        for (i, Part { bells, past, frame, .. }) in self.parts.iter().enumerate() {
            past.derivatives(alpha, self.chain.start(i, past.groups(), (alpha, past.of_tip())));
            self.chain.stand_at(i, bells, frame.eta(self.y), &mut self.room);
        }
        for (force, series) in self.force.iter().zip(&mut self.chain.force) {
            if !force.series(self.t, &mut series[..order]) {
                return false;
            }
        }
        let relief = self.relief_now();
        let height = relief.map_or(0.0, |jet| jet[0][0]) - self.chain.depth_now();
        let acting = Acting {
            depth: self.corner.as_mut().map(|corner| corner.stand_at(height)),
            relief,
            stiffness: self.stiffness,
            support: self.support.velocity(self.t),
            healing: self.wider().healing_rate(),
            inertia: self.wider().inertia.map(|mass| (mass, self.velocity[0])),
            extension: self.extension,
            y: self.y,
        };
        self.chain.run(&acting);
        true
    }

    /// Length of a step, and number of its pieces; `None` if a step of collocation is longer.
    fn plan(&mut self, end: f64) -> Option<Plan> {
        let mut curvatures = self.chain.curvatures(&self.parts, &mut self.room);
        if let Some(jet) = self.relief_now() {
            let relief = [jet[2][0], jet[1][1], jet[0][2]];
            curvatures.iter_mut().zip(relief).for_each(|(sum, relief)| *sum += relief);
        }
        let (limits, [along, across]) = (&self.limits, self.chain.displacement());
        let heights = self.corner.as_ref().map(|corner| (corner, self.chain.height()));
        let over = limits.accurate(along, heights, self.wider());
        let over = over.min(length::length(across.coefficients(), limits.error));
        let over = over.min(self.longest_step());
        // Not by a map of the array, which copies series.
        let outlook = |over: f64| {
            let [x, y] = [Outlook::over(along, over), Outlook::over(across, over)];
            Outlook {
                moved: self.effective([x.moved, y.moved]),
                fastest: self.effective([x.fastest, y.fastest]),
                steepest: x.steepest.max(y.steepest),
            }
        };
        let longest = limits.farthest(over * self.wider().healing_rate());
        let (over, mut outlook) = plan::within(over, longest, outlook);
        let of_heights = heights::steepness(self.corner.as_ref(), self.chain.height(), over);
        outlook.steepest = outlook.steepest.max(of_heights);
        let stiffness = self.fastest(curvatures);
        limits.plan(&mut self.switch, (over, outlook), stiffness, end - self.t)
    }

    /// Makes the pieces of a step, shortened to where exponentials, layers and the side of the kink are valid.
    fn make(&mut self, plan: &Plan, end: f64) -> Result<Made, PlanarError> {
        let Plan { mut length, mut pieces, fastest } = *plan;
        for _ in 0..plan::MOST_SHORTENINGS {
            let Some(total) = landing(self.t, length, end) else { return Ok(Made::Nothing) };
            let nodes = pieces::nodes(pieces);
            let [x, y] = self.chain.displacement();
            let mut room = [pieces::ROOM_FOR_NODES; 3];
            let [room_x, room_y, room_height] = &mut room;
            let along = nodes.table.sums(&x.over(total), room_x);
            let across = nodes.table.sums(&y.over(total), room_y);
            let height = self.chain.height();
            let height = self.corner.map(|_| Along::over(height, total, &nodes.table, room_height));
            let shorter = match at_corner(self.corner.as_ref(), height, (self.t, total)) {
                AtCorner::Apart => {
                    let at = (&*nodes.parts, total);
                    let Some(shorter) = self.broken(at, (along, across)) else {
                        self.remember_series(fastest, total)?;
                        self.accept_series((along, across), height, total);
                        return Ok(Made::Step);
                    };
                    shorter * total
                }
                AtCorner::Ends(at) => at,
                AtCorner::OtherSide => return Ok(Made::OtherSide),
            };
            (pieces, length) = (plan::count(pieces as f64 * shorter, length).min(pieces), shorter);
        }
        Ok(Made::Nothing)
    }

    /// A shorter fraction for a step that leaves the field, retreats too far for the exponentials, moves too far across
    /// for the layers, or overflows; `None` for a valid step.
    fn broken(
        &self,
        (parts, total): (&[f64], f64),
        (along, across): (&[f64], &[f64]),
    ) -> Option<f64> {
        let displacement = self.chain.displacement();
        let at = |j: usize, part: f64| pieces::value(displacement[j].coefficients(), part * total);
        if let Some(part) = self.leaves_field(parts, [along, across], at) {
            return Some(part);
        }
        let mut farthest = self.behind();
        for ((part, x), y) in parts.iter().zip(along).zip(across) {
            farthest = farthest.max(*x);
            let is_held = |part: &Part| part.frame.eta(self.y + y).abs() <= part.frame.radius();
            let is_here = *x >= self.lowest(farthest) && x.is_finite() && y.is_finite();
            if !(is_here && self.parts.iter().all(is_held)) {
                return Some(0.7 * part);
            }
        }
        None
    }

    /// Stores the pieces, and moves the tip to the end of the last one.
    fn accept_series(
        &mut self,
        (along, across): (&[f64], &[f64]),
        heights: Option<Along>,
        total: f64,
    ) {
        let (mut before, across) = (0.0, across.as_chunks::<STAGES>().0);
        let springs = (self.extension, self.support.velocity(self.t));
        let steps =
            pieces::steps((self.t, total), springs, along.as_chunks().0.iter().copied(), heights);
        for (along, across) in steps.zip(across) {
            let step = Step { along, y: self.y, across: across.map(|y| y - before) };
            before = across[STAGES - 1];
            self.accept(step);
        }
        self.switch.made_series();
        self.work.series += 1;
    }

    /// Adds the whole step, from the present position of the tip, to the memory.
    fn remember_series(&mut self, fastest: f64, total: f64) -> Result<(), PlanarError> {
        let healing = total * self.wider().healing_rate();
        let rule = self.limits.visits.rule(fastest * total, healing).unwrap_or_else(visits::last);
        let [x, y] = self.chain.displacement();
        let (x, y) = (x.over(total), y.over(total));
        self.velocity = [x.slope_at_end() / total, y.slope_at_end() / total];
        let (mut room_x, mut room_y) = (visits::ROOM, visits::ROOM);
        let (along, across) = (rule.table.sums(&x, &mut room_x), rule.table.sums(&y, &mut room_y));
        let felt = self.corner.map(|_| self.chain.weights());
        let mut room = [0.0; visits::MOST_NODES];
        let weights = rule.weights((total, healing), felt, &mut room);
        self.remember((along, across), weights, total)
    }
}
