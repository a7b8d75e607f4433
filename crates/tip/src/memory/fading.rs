//! The undecayed part of the past, if the surface heals.
//!
//! The history integral is linear in its weights, so that a common decay can be kept as a separate factor. Later nodes
//! get correspondingly larger weights, and results are multiplied by the factor. The sums themselves are multiplied
//! only when the factor would leave the range of floating point.

use crate::state::{Damaged, Reader, State};

/// The factor by which the first nodes have decayed; `None` without healing.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Fading(Option<f64>);

/// Smallest factor before the sums are multiplied.
const LEAST: f64 = 1e-60;

impl Fading {
    pub(crate) fn left(self) -> Option<f64> {
        self.0
    }

    /// Applies a decay by this factor; returns the factor for the sums when they must be multiplied.
    pub(crate) fn by(&mut self, factor: f64) -> Option<f64> {
        let left = self.0.unwrap_or(1.0) * factor;
        let due = left < LEAST;
        self.0 = Some(if due { 1.0 } else { left });
        due.then_some(left)
    }

    pub(crate) fn save(self, state: &mut State) {
        state.number(self.0.unwrap_or(1.0));
    }

    pub(crate) fn restore(&mut self, state: &mut Reader) -> Result<(), Damaged> {
        let left = state.within(1.0)?;
        if left < LEAST {
            return Err(Damaged::OutOfRange);
        }
        self.0 = (left < 1.0).then_some(left);
        Ok(())
    }
}
