//! Initial conditions: time, position and surface.

use crate::Wider;
use crate::footprint::Footprint;

/// t1, x0(t1) and the surface u0 with its slope.
pub struct Start<'a> {
    /// Start time t1.
    pub time: f64,
    /// Start position x0(t1).
    pub x0: f64,
    height: Box<dyn Fn(f64) -> f64 + 'a>,
    slope: Box<dyn Fn(f64) -> f64 + 'a>,
}

impl<'a> Start<'a> {
    /// A general initial condition. `slope` must be the derivative of `height`; the second-order grids do not use it.
    pub fn new(
        time: f64,
        x0: f64,
        height: impl Fn(f64) -> f64 + 'a,
        slope: impl Fn(f64) -> f64 + 'a,
    ) -> Self {
        Self { time, x0, height: Box::new(height), slope: Box::new(slope) }
    }

    /// A flat surface, the support above the tip, the spring relaxed: t1 = X/r, u0 = 0.
    pub fn flat(r: f64, position: f64) -> Self {
        Self::new(position / r, position, |_| 0.0, |_| 0.0)
    }

    /// Steady motion for infinite time up to the position X: t1 = (X + r + l0)/r with l0 = α f(0)/r,
    ///
    /// u0(x) = -(α/r) ∫_{x-X}^∞ f,  u0'(x) = (α/r) f(x - X).
    ///
    /// The tip starts at X - `kick`; the surface remains that of X.
    pub fn steady(alpha: f64, r: f64, footprint: Footprint<'a>, position: f64, kick: f64) -> Self {
        let steady_l = alpha * footprint.value(0.0) / r;
        let tail = footprint.tail(0.0);
        Self::new(
            (position + r + steady_l) / r,
            position - kick,
            move |x| -(alpha / r) * tail.at(x - position),
            move |x| (alpha / r) * footprint.value_within_reach(x - position),
        )
    }

    /// As [`steady`](Self::steady) in the extended model: u0(x) = -(α w0/r) ∫_0^∞ f(x - X + y) e^{-y/(rT)}dy, with w0 the
    /// weight at this depth, and l0 the slope under the tip. On a path the start is at t = 0.
    pub fn steady_under(
        wider: &Wider,
        (alpha, r): (f64, f64),
        footprint: Footprint<'a>,
        position: f64,
        kick: f64,
    ) -> Self {
        let fading = wider.healing_time.map_or(0.0, |time| 1.0 / (r * time));
        let tail = footprint.tail(fading);
        let density = alpha / r * wider.steady_weight(alpha / r * tail.at(0.0));
        let slope_at = {
            let tail = footprint.tail(fading);
            move |x: f64| footprint.value_within_reach(x) - fading * tail.at(x)
        };
        let lag = r + density * slope_at(0.0);
        let time = if wider.path.is_some() { 0.0 } else { (position + lag) / r };
        Self::new(
            time,
            position - kick,
            move |x| -density * tail.at(x - position),
            move |x| density * slope_at(x - position),
        )
    }

    /// The same initial condition with `height` added to the surface; `slope` is its derivative.
    pub fn on_top_of(
        self,
        height: impl Fn(f64) -> f64 + 'a,
        slope: impl Fn(f64) -> f64 + 'a,
    ) -> Self {
        let Self { time, x0, height: height0, slope: slope0 } = self;
        Self::new(time, x0, move |x| height0(x) + height(x), move |x| slope0(x) + slope(x))
    }

    /// Initial height u0(x).
    pub fn height(&self, x: f64) -> f64 {
        (self.height)(x)
    }

    /// Initial slope u0'(x).
    pub fn slope(&self, x: f64) -> f64 {
        (self.slope)(x)
    }
}
