//! A line scanned by a tip that is free in both coordinates.

use super::product::{self, Product};
use super::start::PlaneStart;
use crate::{GridError, Wider};

/// A tip on two springs over a surface that it carves, with f(x,y) = Σ g(x) h(y):
///
/// ```text
/// M x0'' + x0' = -u_x(x0, y0, t) + κ (R(t) - x0) + F_x(t)
///         y0' = -u_y(x0, y0, t) + κ_y (Y - y0) + F_y(t)
/// u_t(x, y, t) = -α w f(x - x0, y - y0) - u/T,   w = exp(-|u(x0, y0, t)|/b)
/// ```
pub struct PlaneProblem<'a> {
    /// α and r. Without a spring α may be below 0, and r is ignored.
    pub model: (f64, f64),
    /// Stiffness κ_y of the spring across the line.
    pub stiffness_across: f64,
    /// Y, the y of the line.
    pub line: f64,
    /// The terms of f(x,y).
    pub products: &'a [Product],
    /// b, T, M, κ and R(t).
    pub wider: Wider<'a>,
    /// (F_x, F_y) at a time.
    pub force: &'a dyn Fn(f64) -> [f64; 2],
    /// The initial condition.
    pub start: PlaneStart<'a>,
}

impl PlaneProblem<'_> {
    /// # Errors
    /// The first number that is not finite or out of its range.
    pub(super) fn check(&self) -> Result<(), GridError> {
        self.wider.check(self.model)?;
        product::check(self.products)?;
        if !(self.stiffness_across.is_finite() && self.stiffness_across >= 0.0) {
            return Err(GridError::StiffnessAcross(self.stiffness_across));
        }
        let (time, [x0, y0]) = (self.start.time, self.start.position);
        if !(time.is_finite() && x0.is_finite() && (y0 - self.line).is_finite()) {
            return Err(GridError::Start { time, x0 });
        }
        Ok(())
    }

    /// The forces on a tip at a point with this gradient of the surface.
    pub(super) fn force(&self, t: f64, [x0, y0]: [f64; 2], gradient: [f64; 2]) -> [f64; 2] {
        let pull = match &self.wider.path {
            _ if !self.wider.spring => 0.0,
            Some(path) => (path.position)(t) - x0,
            None => self.model.1 * t - x0,
        };
        let pull_across = self.stiffness_across * (self.line - y0);
        let force = (self.force)(t);
        [pull - gradient[0] + force[0], pull_across - gradient[1] + force[1]]
    }

    /// Fraction of the initial surface that remains at t.
    pub(super) fn left_of_start(&self, t: f64) -> f64 {
        self.wider.left_after(t - self.start.time)
    }
}
