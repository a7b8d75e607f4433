//! Request and result of a run.

use crate::GridError;
use std::ops::ControlFlow;

/// Callback after each accepted step, with its time t and x0(t); may stop the run.
pub type Observer<'a> = dyn FnMut(f64, f64) -> ControlFlow<()> + 'a;

/// Times at which the position of the tip is requested, and points at which u is requested at the last of them.
#[derive(Debug, Clone, Copy)]
pub struct Request<'a, P = f64> {
    /// Times, ascending, none before the start; the last one ends the run. A step ends at each of them.
    pub times: &'a [f64],
    /// Points in any order.
    pub points: &'a [P],
}

impl<P> Request<'_, P> {
    pub(crate) fn check(&self, start: f64) -> Result<(), GridError> {
        let mut before = start;
        for &t in self.times {
            if !t.is_finite() || t < before {
                return Err(GridError::Time(t));
            }
            before = t;
        }
        Ok(())
    }
}

/// Result of a run: trajectory, surface and cost.
#[derive(Debug, Clone, PartialEq)]
pub struct Run {
    /// x0 at the requested times.
    pub x0: Vec<f64>,
    /// u at the requested points, at the last requested time.
    pub u: Vec<f64>,
    /// Cost of the run.
    pub work: Work,
}

/// Counts that do not depend on the machine.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Work {
    /// Number of accepted steps.
    pub steps: u64,
    /// Number of rejected steps.
    pub rejected: u64,
    /// Number of evaluations of the right-hand side of (10).
    pub right_hand_sides: u64,
    /// Number of evaluations of the right-hand side of (11), summed over the cells.
    pub cells_updated: u64,
}

impl Work {
    pub(crate) fn plus(&self, other: &Self) -> Self {
        Self {
            steps: self.steps + other.steps,
            rejected: self.rejected + other.rejected,
            right_hand_sides: self.right_hand_sides + other.right_hand_sides,
            cells_updated: self.cells_updated + other.cells_updated,
        }
    }
}
