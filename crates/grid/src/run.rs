//! What is asked of a run, and what it returns.

use crate::GridError;
use std::ops::ControlFlow;

/// Told the time t that each accepted step has come to, and x0(t); may stop the run there.
pub type Observer<'a> = dyn FnMut(f64, f64) -> ControlFlow<()> + 'a;

/// Times at which x0 is wanted, and points at which u is wanted at the last of them.
#[derive(Debug, Clone, Copy)]
pub struct Request<'a> {
    /// Ascending, none before the start; the last one ends the run. Every one is hit by a step.
    pub times: &'a [f64],
    /// Anywhere, in any order.
    pub points: &'a [f64],
}

impl Request<'_> {
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

/// Trajectory, surface and effort.
#[derive(Debug, Clone, PartialEq)]
pub struct Run {
    /// x0 at the requested times.
    pub x0: Vec<f64>,
    /// u at the requested points, at the last requested time.
    pub u: Vec<f64>,
    /// What it took.
    pub work: Work,
}

/// Counts that do not depend on the machine.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Work {
    /// Steps taken.
    pub steps: u64,
    /// Steps tried in vain.
    pub rejected: u64,
    /// Evaluations of the right-hand side of (10).
    pub right_hand_sides: u64,
    /// Evaluations of the right-hand side of (11), summed over the cells.
    pub cells_updated: u64,
}
