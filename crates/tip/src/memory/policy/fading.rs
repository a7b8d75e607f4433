//! How much of the past is left, where the surface heals.
//!
//! Sums over the past are linear in its weights, so that nothing of them is touched when all fades by one
//! factor: what is remembered later counts by so much more, and what is told is multiplied by the factor. Only
//! when that leaves the range of floating point are the sums themselves multiplied.

use super::{Now, Policy};
use crate::state::{Damaged, Reader, State};

/// The factor by which what was remembered first has faded; `None` as long as nothing fades.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Fading(Option<f64>);

/// Below this the sums are multiplied.
const LEAST: f64 = 1e-60;

impl Fading {
    pub(super) fn left(self) -> Option<f64> {
        self.0
    }

    /// Lets all fade by a factor; the factor for the sums, once they are to be multiplied.
    pub(super) fn by(&mut self, factor: f64) -> Option<f64> {
        let left = self.0.unwrap_or(1.0) * factor;
        let due = left < LEAST;
        self.0 = Some(if due { 1.0 } else { left });
        due.then_some(left)
    }

    pub(super) fn save(self, state: &mut State) {
        state.number(self.0.unwrap_or(1.0));
    }

    pub(super) fn restore(&mut self, state: &mut Reader) -> Result<(), Damaged> {
        let left = state.within(1.0)?;
        if left < LEAST {
            return Err(Damaged::OutOfRange);
        }
        self.0 = (left < 1.0).then_some(left);
        Ok(())
    }
}

impl Policy {
    /// All sums times a factor.
    #[cold]
    pub(super) fn scale(&mut self, factor: f64) {
        self.record.iter_mut().for_each(|record| record.scale(factor));
        match &mut self.now {
            Now::Direct => {}
            Now::Fft(fft, _) => fft.scale(factor),
            Now::Modes(modes, retreats) => {
                modes.scale(factor);
                retreats.fft.iter_mut().for_each(|fft| fft.scale(factor));
            }
        }
    }
}
