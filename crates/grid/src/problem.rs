//! Equations (10) and (11) with their data.

use crate::{Footprint, GridError, Start, Wider};

/// A tip dragged by a spring over a surface that it carves:
///
/// x0'(t) = -u_x(x0(t), t) + r t - x0(t) + Fext(t),  u_t(x, t) = -α f(x - x0(t)).
pub struct Problem<'a> {
    pub(crate) alpha: f64,
    pub(crate) r: f64,
    pub(crate) footprint: Footprint<'a>,
    pub(crate) start: Start<'a>,
    force: Option<&'a dyn Fn(f64) -> f64>,
    pub(crate) wider: Wider<'a>,
}

impl<'a> Problem<'a> {
    /// A problem without external force.
    ///
    /// # Errors
    /// α < 0, r ≤ 0, or a number is not finite.
    pub fn new(
        alpha: f64,
        r: f64,
        footprint: Footprint<'a>,
        start: Start<'a>,
    ) -> Result<Self, GridError> {
        Self::under(Wider::default(), (alpha, r), footprint, start)
    }

    /// A problem of the extended model; without a spring α may be below 0, and r is ignored.
    ///
    /// # Errors
    /// As [`new`](Self::new); or a parameter of the extended model is not finite or not above 0.
    pub fn under(
        wider: Wider<'a>,
        (alpha, r): (f64, f64),
        footprint: Footprint<'a>,
        start: Start<'a>,
    ) -> Result<Self, GridError> {
        wider.check((alpha, r))?;
        if !(start.time.is_finite() && start.x0.is_finite()) {
            return Err(GridError::Start { time: start.time, x0: start.x0 });
        }
        Ok(Self { alpha, r, footprint, start, force: None, wider })
    }

    /// Adds an external force Fext.
    #[must_use]
    pub fn with_force(self, force: &'a dyn Fn(f64) -> f64) -> Self {
        Self { force: Some(force), ..self }
    }

    /// Right-hand side of (10), the force on the tip, for a given slope under the tip.
    pub(crate) fn velocity(&self, t: f64, x0: f64, slope: f64) -> f64 {
        let pull = match &self.wider.path {
            _ if !self.wider.spring => 0.0,
            Some(path) => (path.position)(t) - x0,
            None => self.r * t - x0,
        };
        pull - slope + self.force.map_or(0.0, |force| force(t))
    }

    /// Fraction of the initial surface that remains at t.
    pub(crate) fn left_of_start(&self, t: f64) -> f64 {
        self.wider.left_after(t - self.start.time)
    }
}
