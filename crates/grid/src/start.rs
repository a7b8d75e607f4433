//! Where and when the motion starts, and on what surface.

use crate::footprint::{Footprint, Tail};

/// t1, x0(t1) and the surface u0 with its slope.
pub struct Start<'a> {
    pub(crate) time: f64,
    pub(crate) x0: f64,
    height: Box<dyn Fn(f64) -> f64 + 'a>,
    slope: Box<dyn Fn(f64) -> f64 + 'a>,
}

impl<'a> Start<'a> {
    /// Any start. `slope` must be the derivative of `height`; only the spectral grid uses it.
    pub fn new(
        time: f64,
        x0: f64,
        height: impl Fn(f64) -> f64 + 'a,
        slope: impl Fn(f64) -> f64 + 'a,
    ) -> Self {
        Self { time, x0, height: Box::new(height), slope: Box::new(slope) }
    }

    /// A flat surface, the support above the tip, the spring relaxed: t1 = X/r, u0 = 0.
    #[must_use]
    pub fn flat(r: f64, position: f64) -> Self {
        Self::new(position / r, position, |_| 0.0, |_| 0.0)
    }

    /// An infinite past of steady motion that ends at X: t1 = (X + r + l0)/r with l0 = α f(0)/r,
    ///
    /// u0(x) = -(α/r) ∫_{x-X}^∞ f,  u0'(x) = (α/r) f(x - X).
    ///
    /// The tip starts at X - `kick`; the surface remains that of X.
    #[must_use]
    pub fn steady(alpha: f64, r: f64, footprint: Footprint<'a>, position: f64, kick: f64) -> Self {
        let steady_l = alpha * footprint.value(0.0) / r;
        let tail = Tail::new(footprint);
        Self::new(
            (position + r + steady_l) / r,
            position - kick,
            move |x| -(alpha / r) * tail.value(x - position),
            move |x| (alpha / r) * footprint.value_within_reach(x - position),
        )
    }

    /// The same start on a surface with `height` added, whose derivative is `slope`.
    #[must_use]
    pub fn on_top_of(
        self,
        height: impl Fn(f64) -> f64 + 'a,
        slope: impl Fn(f64) -> f64 + 'a,
    ) -> Self {
        let Self { time, x0, height: height0, slope: slope0 } = self;
        Self::new(time, x0, move |x| height0(x) + height(x), move |x| slope0(x) + slope(x))
    }

    /// t1
    #[must_use]
    pub fn time(&self) -> f64 {
        self.time
    }

    /// x0(t1)
    #[must_use]
    pub fn x0(&self) -> f64 {
        self.x0
    }

    /// u0(x)
    #[must_use]
    pub fn height(&self, x: f64) -> f64 {
        (self.height)(x)
    }

    /// u0'(x)
    #[must_use]
    pub fn slope(&self, x: f64) -> f64 {
        (self.slope)(x)
    }
}
