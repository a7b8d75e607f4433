//! All that the past does to the tip: the groove that it left.
//!
//! A memory answers one question, the slope and curvature of ∫ f(x - x0(t'))dt' about the tip, and is
//! told of each step once it is accepted. It is indifferent to time: what the tip left at a distance
//! beyond the reach of f is out of sight, what it left nearby is never forgotten.

mod auto;
mod direct;
mod fft;
mod modes;

pub use auto::{Auto, CROSSOVER_NODES, CROSSOVER_STEPS};
pub use direct::Direct;
pub use fft::Fft;
pub use modes::{Fit, FitCertificate, FitError, Modes, Term, accuracy_needed};

use crate::TipFunction;
use crate::collocation::Stages;
use crate::state::{Damaged, Reader, State};

/// Memory of the tip's past. Positions are displacements from where the tip stands now, at most
/// [`longest_look`] of them.
pub trait Memory {
    /// ∫ f'(x - x0(t'))dt' and ∫ f''(x - x0(t'))dt' over the remembered past, at the points
    /// x = tip + `at`.
    fn groove(&mut self, at: &Stages, slope: &mut Stages, curvature: &mut Stages);

    /// Remembers a step: the tip spent the time `weight[j]` at `position[j]`, and now stands at the
    /// last of these positions.
    fn remember(&mut self, position: &Stages, weight: &Stages);

    /// Its name on the command line and in documents.
    fn name(&self) -> &'static str;

    /// Writes down all that it holds: what [`restore`](Self::restore) takes up to the last bit.
    fn save(&self, state: &mut State);

    /// Takes up what [`save`](Self::save) wrote, on a memory made by the same choices.
    ///
    /// # Errors
    /// A state of something else.
    fn restore(&mut self, state: &mut Reader) -> Result<(), Damaged>;

    /// What is worth knowing of how it fared.
    fn note(&self) -> Option<String> {
        None
    }

    /// Whether the tip has come back to what was dropped as too far behind to matter, and how far the
    /// past is kept: the motion since then is not to be trusted.
    fn forgotten(&self) -> Option<f64> {
        None
    }
}

/// The farthest from the tip that a memory is asked about the groove, ahead or behind: 4.6 widths of
/// a Gaussian. The integrator rejects steps that would lead further.
#[must_use]
pub fn longest_look(tip: &TipFunction) -> f64 {
    (40.0 / tip.band()).min(12.0)
}
