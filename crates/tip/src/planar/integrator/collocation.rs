//! Steps by collocation, with their error control.

use super::super::history::Step;
use super::super::jet::Jet;
use super::super::part::Part;
use super::super::scenario::PlanarError;
use super::super::stages::{Solution, StageEquations, Under, Unknowns};
use super::PlanarRunning;
use crate::collocation::{RADAU, STAGES, Stages};
use crate::history::Heights;
use crate::integrator::ahead::way_ahead;
use crate::integrator::control::OVERSHOOT;
use crate::integrator::corner::Corner;
use crate::integrator::landing::landing;
use crate::integrator::{COASTING, ENOUGH, IntegrationError, Retry};
use crate::memory::longest_look;
use crate::step::{self, Inertia, carving, healing};

/// Weight of the defect of the motion across; it allows for the change from step to step, which is not evaluated.
const WEIGHT_OF_DEFECT: f64 = 1.5;

impl PlanarRunning<'_> {
    /// Makes a step that ends at the end of the scenario at the latest.
    pub(super) fn step_by_collocation(&mut self) -> Result<(), PlanarError> {
        self.enter_field();
        let now = self.forces_now();
        if self.wider().inertia.is_none() {
            self.velocity[0] = now[0];
        }
        self.velocity[1] = now[1];
        let end = self.next_end();
        let mut h = self.control.proposal(self.length_limit(), end - self.t);
        loop {
            let (t, tolerance) = (self.t, self.control.tolerance());
            h = landing(t, h, end).ok_or(IntegrationError::StepTooSmall { t, h, tolerance })?;
            match self.attempt(h) {
                Ok(solution) => return self.accept_stages(&solution, h),
                Err(retry) => h = retry.length((t, h), self.corner.as_mut(), &mut self.work),
            }
        }
    }

    /// Longest step to try: it does not skip a pulse, move the tip too far, or lead far beyond the field.
    fn length_limit(&self) -> f64 {
        let speed = self.effective(self.velocity).max(1e-300);
        let mut limit = self.longest_step().min(self.longest_displacement() / speed);
        let at = [self.position(), self.y];
        for ((ends, x), v) in self.field.ends.iter().zip(at).zip(self.velocity) {
            let ahead = ends.ahead(x, v >= 0.0);
            if ahead.is_finite() {
                limit = limit.min(1.2 * ahead.max(ends.slack) / v.abs().max(1e-300));
            }
        }
        limit
    }

    fn longest_displacement(&self) -> f64 {
        step::longest_displacement(self.model.tip().band())
    }

    /// Attempts a step of length h; an error says how to repeat the attempt.
    fn attempt(&mut self, h: f64) -> Result<Solution, Retry> {
        let longest = self.longest_displacement();
        let mass = self.wider().inertia;
        let inertia = mass.map(|mass| Inertia::new(mass, h, self.velocity[0]));
        let enough = ENOUGH * self.control.target();
        // As far as exponentials and layers hold.
        let look = longest_look(self.model.tip());
        let room = |Part { frame, bells, .. }: &Part| {
            (frame.radius() - frame.eta(self.y).abs()) * bells.width()
        };
        let room = self.parts.iter().map(room).fold(f64::INFINITY, f64::min);
        let surface = |at| self.initial(at);
        let equations = self.equations(h, inertia.as_ref(), &surface);
        let mut count = 0;
        let solution = equations.solve(self.guess(h, longest), (enough, look), &mut count);
        self.work.newton_iterations += count;
        let solution = solution.ok_or(Retry::Shorter(0.3 * h))?;
        let [along, across] = &solution.displacement;
        let moves = along.iter().zip(across).map(|(d, e)| self.effective([*d, *e]));
        let moved = moves.fold(0.0, f64::max);
        if moved > OVERSHOOT * longest && !self.control.is_fixed() {
            return Err(Retry::Shorter(h * (0.8 * OVERSHOOT * longest / moved).max(0.1)));
        }
        let at = |j: usize, tau: f64| RADAU.value(&solution.displacement[j], tau);
        if let Some(tau) = self.leaves_field(&RADAU.c, [along, across], at) {
            return Err(Retry::ToKnot(tau * h));
        }
        let farthest = across.iter().fold(0.0, |most: f64, e| most.max(e.abs()));
        let lowest = along.iter().copied().fold(0.0, f64::min);
        if farthest > room || lowest < self.lowest(self.behind()) {
            return Err(Retry::Shorter(0.5 * h));
        }
        if let Some((corner, heights)) = self.corner.as_ref().zip(self.heights(&solution)) {
            corner.passed(&heights, (self.t, h))?;
        }
        self.judge(&solution, h).map_err(Retry::Shorter)?;
        Ok(solution)
    }

    fn heights(&self, solution: &Solution) -> Option<Heights> {
        self.corner.zip(solution.height).map(|(corner, nodes)| corner.heights(nodes))
    }

    fn equations<'b>(
        &'b self,
        h: f64,
        inertia: Option<&'b Inertia>,
        surface: &'b dyn Fn([f64; 2]) -> Jet,
    ) -> StageEquations<'b> {
        // At the end of a step forces are their limits from before: they may jump there.
        let last = (self.t + h).next_down();
        let force = |j: usize, c: f64| self.force[j].value((self.t + h * c).min(last));
        let moved = self.support.velocity(self.t) * h;
        let along = RADAU.c.map(|c| self.extension + moved * c + force(0, c));
        let across = RADAU.c.map(|c| force(1, c) - self.stiffness * self.y);
        let wider = self.wider();
        StageEquations {
            parts: &self.parts,
            alpha: self.model.alpha(),
            stiffness: self.stiffness,
            y: self.y,
            h,
            pull: [along, across],
            carving: wider.healing_time.map_or_else(|| carving(h), |time| healing(h, time)),
            left: RADAU.c.map(|c| wider.left_after(h * c)),
            inertia,
            depth: self.corner.map(|corner| corner.depth()),
            under: (self.earlier.is_some() || !self.field.is_flat()).then(|| Under {
                surface,
                from: [self.position(), self.y],
                left: RADAU.c.map(|c| self.left(self.t + h * c)),
            }),
        }
    }

    /// Predicts a step of length h.
    fn guess(&self, h: f64, longest: f64) -> Unknowns {
        let last = self.last.map(|last| ([last.along.displacement, last.across], last.along.h));
        let [along, across] = way_ahead(last, self.velocity, h, longest);
        let heights = |corner: &Corner| corner.ahead(self.last.as_ref().map(|last| &last.along), h);
        [along, across, self.corner.as_ref().map_or([0.0; STAGES], heights)]
    }

    /// Accepts both polynomials, or returns the length to try instead.
    fn judge(&mut self, solution: &Solution, h: f64) -> Result<(), f64> {
        let [[_, mixed, across], [along, ..]] = [solution.curvatures; 2];
        let [d, e] = &solution.displacement;
        let before = |d: &Stages, of: fn(&Step) -> &Stages| {
            self.last
                .as_ref()
                .map_or(0.0, |last| step::interpolation_error(d, h, (of(last), last.along.h)))
        };
        let coasting = self.wider().inertia.map_or(1.0, |mass| 1.0 + COASTING * mass / h);
        let signs = (
            coasting * step::defect(d, h, self.velocity[0]),
            coasting * before(d, |last| &last.along.displacement),
        );
        // Across, by the same rule; see `Control::judge`.
        let stiffness = (self.stiffness + across + mixed.abs()).max(0.0);
        let soft = 1.0 / (1.0 + RADAU.defect_to_error * h * stiffness);
        let defect = WEIGHT_OF_DEFECT * h * step::defect(e, h, self.velocity[1]).abs();
        let interpolation = before(e, |last| &last.across);
        let beside = soft * RADAU.defect_to_error * defect + (1.0 - soft) * interpolation;
        let last = self.last.as_ref().map(|last| &last.along);
        let of_heights = self.corner.as_ref().zip(self.heights(solution));
        let of_heights =
            of_heights.map_or(0.0, |(corner, heights)| corner.error(&heights, last, h));
        // NaN remains NaN.
        let beside = if of_heights <= beside { beside } else { of_heights };
        self.control.judge(signs, h, (1.0 + along + mixed.abs()).max(0.0), beside)
    }

    fn accept_stages(&mut self, solution: &Solution, h: f64) -> Result<(), PlanarError> {
        let [d, e] = solution.displacement;
        let heights = self.heights(solution);
        let (t, extension) = (self.t, self.extension);
        let along = crate::Step { t, h, extension, displacement: d, height: heights };
        let step = Step { along, y: self.y, across: e };
        self.remember((&d, &e), &solution.spent, h)?;
        self.velocity = [d, e].map(|d| step::velocity_at_end(&d, h));
        self.switch.made(h * self.fastest(solution.curvatures), self.chain.order());
        self.accept(step);
        match self.earlier.filter(|grooves| self.y.abs() > grooves.wide()) {
            Some(_) => Err(PlanarError::BeyondGrooves { t: self.t, y: self.y }),
            None => Ok(()),
        }
    }
}
