//! What a wider law adds to (10) and (11), as the grids solve it.
//!
//! ```text
//! M x0'' + x0' = -u_x(x0, t) + κ (R(t) - x0) + Fext(t)
//! u_t(x, t) = -α w f(x - x0(t)) - u(x, t)/T,   w = exp(-|u(x0, t)|/b)      (61)
//! ```
//!
//! The cells hold e^{(t - s)/T} u, which no cell out of reach changes (J. D. Lawson, SIAM J. Numer. Anal. 4
//! (1967) 372), and s follows t. The corner of |u| is left to the control of the step size.

use crate::GridError;

/// Motion of the support: R(t), and the times at which R' jumps.
pub struct Path<'a> {
    /// R
    pub position: &'a dyn Fn(f64) -> f64,
    /// Ascending.
    pub knots: &'a [f64],
}

/// b, T, M and κ; the default is (10), (11) themselves.
pub struct Wider<'a> {
    /// b
    pub depth_limit: Option<f64>,
    /// T
    pub healing_time: Option<f64>,
    /// M, and the velocity at the start.
    pub inertia: Option<(f64, f64)>,
    /// κ = 1 or, without a spring, 0.
    pub spring: bool,
    /// `None`: R = rt.
    pub path: Option<Path<'a>>,
}

impl Default for Wider<'_> {
    fn default() -> Self {
        Self { depth_limit: None, healing_time: None, inertia: None, spring: true, path: None }
    }
}

impl Wider<'_> {
    pub(crate) fn check(&self) -> Result<(), GridError> {
        let numbers = [self.depth_limit, self.healing_time, self.inertia.map(|(mass, _)| mass)];
        match numbers.iter().flatten().find(|value| !(value.is_finite() && **value > 0.0)) {
            Some(value) => Err(GridError::Wider(*value)),
            None => Ok(()),
        }
    }

    /// w, where the surface has this height.
    pub(crate) fn weight(&self, height: f64) -> f64 {
        self.depth_limit.map_or(1.0, |limit| (-height.abs() / limit).exp())
    }

    /// e^{-time/T}
    pub(crate) fn left_after(&self, time: f64) -> f64 {
        self.healing_time.map_or(1.0, |healing| (-time / healing).exp())
    }

    /// The next time after t at which R' jumps.
    pub(crate) fn next_knot(&self, t: f64) -> f64 {
        let knots = self.path.iter().flat_map(|path| path.knots);
        knots.copied().find(|knot| *knot > t).unwrap_or(f64::INFINITY)
    }
}
