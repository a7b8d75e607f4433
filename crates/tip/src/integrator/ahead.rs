//! Prediction of a step: its displacements, and limits on its length.

use super::Integrator;
use super::corner::Corner;
use super::stage_equations::Unknowns;
use crate::collocation::{RADAU, STAGES, Stages};
use crate::step;

impl Integrator<'_> {
    /// Predicts a step of length h: the last polynomials, extrapolated where this is reliable, otherwise straight
    /// lines.
    pub(super) fn predict(&self, h: f64, longest: f64) -> Unknowns {
        let ahead = |corner: Corner| corner.ahead(self.last.as_ref(), h);
        let height = self.corner.map_or([0.0; STAGES], ahead);
        Unknowns { displacement: self.way_ahead(h, longest), height }
    }

    fn way_ahead(&self, h: f64, longest: f64) -> Stages {
        if let Some(last) = self.last.filter(|last| h <= 1.5 * last.h) {
            let guess = RADAU.continued(&last.displacement, h / last.h);
            if guess.iter().all(|d| d.abs() < longest) {
                return guess;
            }
        }
        RADAU.c.map(|c| (c * h * self.velocity).clamp(-longest, longest))
    }

    /// Longest step to try: it does not skip a pulse, move the tip too far, or lead far beyond the stretch.
    pub(super) fn length_limit(&self) -> f64 {
        let stretch = &self.stretch;
        let speed = self.velocity.abs().max(1e-300);
        let ahead = if self.velocity >= 0.0 {
            stretch.high - self.position()
        } else {
            self.position() - stretch.low
        };
        let longest = step::longest_displacement(self.model.tip().band());
        let distance = longest.min(1.2 * ahead.max(stretch.slack));
        self.force.longest_step(self.t).min(distance / speed)
    }
}
