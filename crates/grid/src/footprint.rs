//! The tip function f, given by its values, and its integral.

use crate::GridError;
use gauss_quad::legendre::GaussLegendre;
use std::num::NonZeroUsize;

/// f and the distance beyond which it is negligible.
#[derive(Clone, Copy)]
pub struct Footprint<'a> {
    value: &'a dyn Fn(f64) -> f64,
    reach: f64,
}

impl<'a> Footprint<'a> {
    /// `value` is f; |f| beyond `reach` must be below round-off, about 1e-17 of its largest value.
    /// For Gaussians that is 8.8 widths beyond the outermost center.
    ///
    /// # Errors
    /// `reach` not finite or not positive.
    pub fn new(value: &'a dyn Fn(f64) -> f64, reach: f64) -> Result<Self, GridError> {
        if reach.is_finite() && reach > 0.0 {
            Ok(Self { value, reach })
        } else {
            Err(GridError::Reach(reach))
        }
    }

    /// f(x), without a cutoff.
    pub fn value(&self, x: f64) -> f64 {
        (self.value)(x)
    }

    /// f(x), 0 beyond the reach.
    pub(crate) fn value_within_reach(&self, x: f64) -> f64 {
        if x.abs() <= self.reach { self.value(x) } else { 0.0 }
    }

    /// ∫_x^∞ f(y) e^{-s(y-x)}dy for this s.
    pub(crate) fn tail(&self, fading: f64) -> Tail<&'a dyn Fn(f64) -> f64> {
        Tail::new(self.value, self.reach, fading)
    }

    /// Distance beyond which f is taken as 0.
    pub fn reach(&self) -> f64 {
        self.reach
    }
}

/// ∫_x^∞ f(y) e^{-s(y-x)}dy by Gauss–Legendre quadrature with 16 nodes on 64 panels over the
/// reach: exact to round-off if f is smooth on the scale reach/32.
pub(crate) struct Tail<F> {
    value: F,
    reach: f64,
    /// s
    fading: f64,
    rule: GaussLegendre,
    /// Tail at the right edge of each panel.
    right: Vec<f64>,
    panel: f64,
}

impl<F: Fn(f64) -> f64> Tail<F> {
    const PANELS: usize = 64;
    const NODES: NonZeroUsize = NonZeroUsize::MIN.saturating_add(15);

    /// The tail of f, 0 beyond a reach.
    pub(crate) fn new(value: F, reach: f64, fading: f64) -> Self {
        let panel = 2.0 * reach / Self::PANELS as f64;
        let mut tail = Self {
            value,
            reach,
            fading,
            rule: GaussLegendre::new(Self::NODES),
            right: vec![0.0; Self::PANELS],
            panel,
        };
        for k in (1..Self::PANELS).rev() {
            let own = tail.integral(tail.edge(k), tail.edge(k), tail.edge(k + 1));
            tail.right[k - 1] = tail.right[k] * tail.left_over(panel) + own;
        }
        tail
    }

    fn edge(&self, k: usize) -> f64 {
        k as f64 * self.panel - self.reach
    }

    /// e^{-s length}
    fn left_over(&self, length: f64) -> f64 {
        (-self.fading * length).exp()
    }

    /// The integral from `from` to `to`, with the exponential relative to x.
    fn integral(&self, x: f64, from: f64, to: f64) -> f64 {
        self.rule.integrate(from, to, |y| (self.value)(y) * self.left_over(y - x))
    }

    /// ∫_x^∞ f(y) e^{-s(y-x)}dy
    pub(crate) fn at(&self, x: f64) -> f64 {
        let from = x.max(-self.reach);
        if from >= self.reach {
            return 0.0;
        }
        self.left_over(from - x) * self.value_from(from)
    }

    fn value_from(&self, x: f64) -> f64 {
        let k = (((x + self.reach) / self.panel) as usize).min(Self::PANELS - 1);
        let edge = self.edge(k + 1);
        self.right[k] * self.left_over(edge - x) + self.integral(x, x, edge)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn gaussian(x: f64) -> f64 {
        (-0.5 * x * x).exp()
    }

    #[test]
    fn the_tail_of_a_gaussian_is_its_error_function() -> Result<(), GridError> {
        let tail = Tail::new(gaussian, 8.8, 0.0);
        let total = std::f64::consts::TAU.sqrt();
        // √(π/2) erfc(1/√2) and √(π/2) erfc(3/√2), from 30-digit arithmetic.
        let known = [
            (-20.0, total),
            (0.0, 0.5 * total),
            (1.0, 0.397_689_745_423_351_45),
            (3.0, 0.003_383_692_573_952_727_6),
            (9.0, 0.0),
        ];
        for (x, exact) in known {
            assert!((tail.at(x) - exact).abs() < 2e-15, "tail({x}) = {}", tail.at(x));
        }
        Ok(())
    }
}
