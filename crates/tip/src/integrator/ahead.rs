//! Prediction of a step: its displacements, and limits on its length.

use super::Integrator;
use super::corner::Corner;
use super::stage_equations::Unknowns;
use crate::collocation::{RADAU, STAGES, Stages};
use crate::step;

/// Predicts the displacements at the nodes of a step of length h: the polynomials of the last step, given with its
/// length, extrapolated where this is reliable, otherwise straight lines.
pub(crate) fn way_ahead<const N: usize>(
    last: Option<([Stages; N], f64)>,
    velocity: [f64; N],
    h: f64,
    longest: f64,
) -> [Stages; N] {
    if let Some((displacement, h_last)) = last.filter(|(_, h_last)| h <= 1.5 * h_last) {
        let guess = displacement.map(|d| RADAU.continued(&d, h / h_last));
        if guess.as_flattened().iter().all(|d| d.abs() < longest) {
            return guess;
        }
    }
    velocity.map(|v| RADAU.c.map(|c| (c * h * v).clamp(-longest, longest)))
}

impl Integrator<'_> {
    /// Predicts a step of length h.
    pub(super) fn predict(&self, h: f64, longest: f64) -> Unknowns {
        let last = self.last.map(|last| ([last.displacement], last.h));
        let [displacement] = way_ahead(last, [self.velocity], h, longest);
        let ahead = |corner: Corner| corner.ahead(self.last.as_ref(), h);
        Unknowns { displacement, height: self.corner.map_or([0.0; STAGES], ahead) }
    }

    /// Longest step to try: it does not skip a pulse, move the tip too far, or lead far beyond the stretch.
    pub(super) fn length_limit(&self) -> f64 {
        let (ends, speed) = (&self.stretch.ends, self.velocity.abs().max(1e-300));
        let ahead = ends.ahead(self.position(), self.velocity >= 0.0);
        let longest = step::longest_displacement(self.model.tip().band());
        let distance = longest.min(1.2 * ahead.max(ends.slack));
        self.force.longest_step(self.t).min(distance / speed)
    }
}
