//! Steps by Taylor series: long steps, returned in pieces.

use super::super::chain::Acting;
use super::super::part::Part;
use super::super::scenario::PlanarError;
use super::PlanarRunning;
use crate::collocation::STAGES;
use crate::elementary::exp;
use crate::integrator::landing::landing;
use crate::integrator::taylor::heights::{self, Along, AtCorner, at_corner};
use crate::integrator::taylor::pieces::{self, MOST_PIECES};
use crate::integrator::taylor::values::Outlook;
use crate::integrator::taylor::visits;
use crate::integrator::taylor::{
    FARTHEST, MOST_ORDER, MOST_SHORTENINGS, REACH_OF_PIECE, SHARE_OF_INTERPOLATION,
    SHARE_OF_SERIES, length,
};
use crate::step;

struct Plan {
    length: f64,
    pieces: usize,
    /// Largest [effective](PlanarRunning::effective) speed in the step, approximately.
    fastest: f64,
}

/// Number of sides of the kink of |h|.
const SIDES: usize = 2;

/// Result of an attempt to make a planned step.
enum Made {
    Step,
    /// The step must be made on the other side of the kink.
    OtherSide,
    Nothing,
}

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
                Made::OtherSide if self.turn() => {}
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
        let acting = Acting {
            depth: self.weight_now(),
            relief: self.relief_now(),
            stiffness: self.stiffness,
            support: self.support.velocity(self.t),
            healing: self.healing(),
            inertia: self.wider().inertia.map(|mass| (mass, self.velocity[0])),
            extension: self.extension,
            y: self.y,
        };
        self.chain.run(&acting);
        true
    }

    /// w at the start of the series and ±1/b for the side of the kink; `None` without a depth limit.
    fn weight_now(&mut self) -> Option<(f64, f64)> {
        let relief = self.relief_now().map_or(0.0, |jet| jet[0][0]);
        let (corner, limit) = self.corner.as_mut().zip(self.model.wider().depth_limit)?;
        corner.stand_at(relief - self.chain.depth_now());
        Some((exp(-corner.side * corner.height / limit), corner.side / limit))
    }

    /// Length of a step, and number of its pieces; `None` if a step of collocation is longer.
    fn plan(&mut self, end: f64) -> Option<Plan> {
        let [along, across] = self.chain.displacement();
        let error = SHARE_OF_SERIES * self.control.target();
        let of = |series: &[f64]| length::length(series, error);
        let mut over = of(along.coefficients()).min(of(across.coefficients()));
        if let Some(mass) = self.wider().inertia {
            // An error of the velocity leads so far astray before friction has used it up.
            let mut coasting = [0.0; MOST_ORDER + 1];
            let order = self.chain.order();
            for (k, c) in along.coefficients().iter().enumerate() {
                coasting[k] = mass * k as f64 * c;
            }
            over = over.min(of(&coasting[1..=order]));
        }
        if let Some((corner, limit)) = self.corner.as_ref().zip(self.wider().depth_limit) {
            let strength = (self.model.alpha() / limit).abs();
            let height = self.chain.height();
            over = over.min(heights::length_by_heights(corner, height, strength, error));
        }
        over = over.min(self.longest_step()).min(self.longest_healing());
        let limited = self.reach_of_piece();
        let longest = (FARTHEST * limited).min(self.visits.farthest(over * self.healing()));
        // Not by a map of the array, which copies series.
        let outlook = |over: f64| [Outlook::over(along, over), Outlook::over(across, over)];
        let moved = |outlook: &[Outlook; 2]| self.effective([outlook[0].moved, outlook[1].moved]);
        let mut ahead = outlook(over);
        for _ in 0..MOST_SHORTENINGS {
            let moved = moved(&ahead);
            if moved <= longest {
                break;
            }
            over *= (0.9 * longest / moved).max(0.3);
            ahead = outlook(over);
        }
        let error = SHARE_OF_INTERPOLATION * self.control.tolerance();
        let of_heights = |corner| heights::steepness(corner, &self.chain.height().over(over));
        let of_heights = self.corner.as_ref().map_or(0.0, of_heights);
        let steepest = ahead[0].steepest.max(ahead[1].steepest).max(of_heights);
        let part = pieces::longest(steepest, error);
        let piece = over * part.min(limited / moved(&ahead).max(f64::MIN_POSITIVE));
        let length = over.min(MOST_PIECES as f64 * piece);
        let fastest = self.effective([ahead[0].fastest, ahead[1].fastest]) / over;
        let mut curvatures = self.chain.curvatures(&self.parts, &mut self.room);
        if let Some(jet) = self.relief_now() {
            let relief = [jet[2][0], jet[1][1], jet[0][2]];
            curvatures.iter_mut().zip(relief).for_each(|(sum, relief)| *sum += relief);
        }
        let fades = self.fastest(curvatures);
        // A step of collocation leads no farther either.
        let most = limited / (REACH_OF_PIECE * fastest.max(f64::MIN_POSITIVE));
        let order = self.chain.order();
        if self.switch.leaves(fades * length, fades * most, order) {
            return None;
        }
        // As in collocation: the end is met, or enough left for another step.
        let distance = end - self.t;
        let length = if length >= distance * (1.0 - 1e-9) {
            distance
        } else if 2.0 * length > distance {
            0.5 * distance
        } else {
            length
        };
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a count")]
        let pieces = ((length / piece).ceil() as usize).clamp(1, MOST_PIECES);
        Some(Plan { length, pieces, fastest })
    }

    /// Longest step on a surface that heals: the quadrature rules for nodes have a limited order, and beyond the order
    /// of the series the terms of e^{-t/T} must decrease by half from one to the next.
    fn longest_healing(&self) -> f64 {
        let times = self.visits.most_healing().min(0.5 * self.chain.order() as f64);
        self.wider().healing_time.map_or(f64::INFINITY, |time| times * time)
    }

    /// Largest displacement in a piece, whose nodes represent its contribution to the groove.
    fn reach_of_piece(&self) -> f64 {
        REACH_OF_PIECE * step::longest_displacement(self.model.tip().band())
    }

    /// Makes the pieces of a step, shortened to where exponentials, layers and the side of the kink are valid.
    fn make(&mut self, plan: &Plan, end: f64) -> Result<Made, PlanarError> {
        let Plan { mut length, mut pieces, fastest } = *plan;
        for _ in 0..MOST_SHORTENINGS {
            let Some(total) = landing(self.t, length, end) else { return Ok(Made::Nothing) };
            let nodes = pieces::nodes(pieces);
            let [x, y] = self.chain.displacement();
            let mut room = [pieces::ROOM_FOR_NODES; 3];
            let [room_x, room_y, room_height] = &mut room;
            let along = nodes.table.sums(&x.over(total), room_x);
            let across = nodes.table.sums(&y.over(total), room_y);
            let height = self.corner.map(|corner| Along {
                start: corner.height,
                nodes: nodes.table.sums(&self.chain.height().over(total), room_height),
            });
            let met =
                self.corner.as_ref().zip(height).map_or(AtCorner::Apart, |(corner, height)| {
                    at_corner(corner, &height, (self.t, total))
                });
            let shorter = match met {
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
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a count")]
            let fewer = (pieces as f64 * shorter / length).ceil() as usize;
            (pieces, length) = (fewer.clamp(1, pieces), shorter);
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
        let start = self.t;
        let (along, across) = (along.as_chunks::<STAGES>().0, across.as_chunks::<STAGES>().0);
        let mut before = [0.0; 2];
        for (i, (x, y)) in along.iter().zip(across).enumerate() {
            let part = (i + 1) as f64 / along.len() as f64;
            // Ends are representable times.
            let end = if i + 1 < along.len() { start + part * total } else { start + total };
            let moved = [x.map(|x| x - before[0]), y.map(|y| y - before[1])];
            let height = heights.map(|heights| heights.piece(i));
            let step = self.step_to(end - self.t, moved, height);
            if i + 1 == along.len()
                && let Some((corner, height)) = self.corner.as_mut().zip(height)
            {
                corner.arrive(&height, (step.along.t, step.along.h));
            }
            before = [x[STAGES - 1], y[STAGES - 1]];
            self.accept(step);
        }
        self.switch.made_series();
        self.work.series += 1;
    }

    /// Adds the whole step, from the present position of the tip, to the memory.
    fn remember_series(&mut self, fastest: f64, total: f64) -> Result<(), PlanarError> {
        let healing = total * self.healing();
        let rule = self.visits.rule(fastest * total, healing).unwrap_or_else(visits::last);
        let [x, y] = self.chain.displacement();
        let (x, y) = (x.over(total), y.over(total));
        self.velocity = [x.slope_at_end() / total, y.slope_at_end() / total];
        let (mut room_x, mut room_y) = (visits::ROOM, visits::ROOM);
        let (along, across) = (rule.table.sums(&x, &mut room_x), rule.table.sums(&y, &mut room_y));
        let mut room = [0.0; visits::MOST_NODES];
        let weights = &mut room[..along.len()];
        weights.iter_mut().zip(&rule.weights).for_each(|(weight, spent)| *weight = spent * total);
        if self.corner.is_some() {
            let mut room = visits::ROOM;
            let felt = rule.table.sums(&self.chain.weights().over(total), &mut room);
            weights.iter_mut().zip(felt).for_each(|(weight, felt)| *weight *= *felt);
        }
        if healing > 0.0 {
            visits::fade(&rule.nodes, healing, weights);
        }
        self.remember((along, across), weights, total)
    }
}
