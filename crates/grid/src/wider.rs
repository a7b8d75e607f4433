//! Extended model: its terms in (10) and (11), as the grids solve them.
//!
//! ```text
//! M x0'' + x0' = -u_x(x0, t) + κ (R(t) - x0) + Fext(t)
//! u_t(x, t) = -α w f(x - x0(t)) - u(x, t)/T,   w = exp(-|u(x0, t)|/b)      (61)
//! ```
//!
//! The cells contain e^{(t - s)/T} u, which is constant for cells out of reach (J. D. Lawson, SIAM J. Numer. Anal. 4
//! (1967) 372); the reference time s is moved along with t. The kink of |u| is handled by the step-size control.

use crate::GridError;

/// Path of the support: R(t), and the times at which R' jumps.
pub struct Path<'a> {
    /// Position R(t)
    pub position: &'a dyn Fn(f64) -> f64,
    /// Times of the jumps, ascending.
    pub knots: &'a [f64],
}

/// b, T, M and κ; by default the basic model (10), (11).
pub struct Wider<'a> {
    /// Depth limit b.
    pub depth_limit: Option<f64>,
    /// Healing time T.
    pub healing_time: Option<f64>,
    /// Inertia M, and the initial velocity.
    pub inertia: Option<(f64, f64)>,
    /// Whether there is a spring: κ = 1, or 0 without.
    pub spring: bool,
    /// Path of the support; by default R = rt.
    pub path: Option<Path<'a>>,
}

impl Default for Wider<'_> {
    fn default() -> Self {
        Self { depth_limit: None, healing_time: None, inertia: None, spring: true, path: None }
    }
}

impl Wider<'_> {
    /// # Errors
    /// A number out of range. Without a spring α may be below 0, and r is ignored.
    pub(crate) fn check(&self, (alpha, r): (f64, f64)) -> Result<(), GridError> {
        let numbers = [self.depth_limit, self.healing_time, self.inertia.map(|(mass, _)| mass)];
        if let Some(value) = numbers.iter().flatten().find(|v| !(v.is_finite() && **v > 0.0)) {
            return Err(GridError::Wider(*value));
        }
        if !(alpha.is_finite() && (alpha >= 0.0 || !self.spring)) {
            return Err(GridError::Alpha(alpha));
        }
        if self.spring && !(r.is_finite() && r > 0.0) {
            return Err(GridError::R(r));
        }
        Ok(())
    }

    /// w at this height of the surface.
    pub(crate) fn weight(&self, height: f64) -> f64 {
        self.depth_limit.map_or(1.0, |limit| (-height.abs() / limit).exp())
    }

    /// The weight w0 of steady motion whose groove is this deep for w = 1.
    pub(crate) fn steady_weight(&self, depth: f64) -> f64 {
        if self.depth_limit.is_none() {
            return 1.0;
        }
        // w e^{w depth/b} = 1 has one root in (0, 1], which halving finds.
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            let above = middle > self.weight(middle * depth);
            *(if above { &mut high } else { &mut low }) = middle;
        }
        0.5 * (low + high)
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
