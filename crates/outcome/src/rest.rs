//! A tip without a spring at rest: whether a small displacement grows, and by which factor until a given time.
//!
//! A tip that has been at rest since t = 0 sits in its own groove -αθ(t) f(x), θ' = w - θ/T, with the weight w of the
//! depth limit and the healing time T. With I = ∫ w (x(t) - x(t')) e^{-(t-t')/T}dt' and v = x', a small displacement obeys
//!
//! ```text
//!     M v' + v = α f''(0) I,   I' = θ v - I/T,
//! ```
//!
//! so that deviations grow at the rate λ(t), the larger root of (Mλ + 1)(λ + 1/T) = α f''(0) θ(t).

use stickslip_tip::roots::halved_between;
use stickslip_tip::{Model, Wider};

/// Coefficients of this problem for a model without a spring.
pub(crate) struct Rest {
    wider: Wider,
    /// α f''(0), positive where rest may be unstable.
    push: f64,
    /// α f(0): the digging rate of a tip at rest.
    digs: f64,
}

/// Number of steps in the sum for the growth.
const STEPS: u32 = 2000;

impl Rest {
    pub(crate) fn of(model: &Model) -> Self {
        let (f, curvature) = (model.tip().value(0.0), model.tip().slope_and_curvature(0.0).1);
        Self { wider: *model.wider(), push: model.alpha() * curvature, digs: model.alpha() * f }
    }

    /// The rate at which deviations grow after this time at rest; negative if they decay.
    pub(crate) fn rate(&self, time: f64) -> f64 {
        self.rate_on(self.depth(time))
    }

    /// θ after this time at rest.
    fn depth(&self, time: f64) -> f64 {
        let heals = self.wider.healing_time;
        match self.wider.depth_limit {
            None => heals.map_or(time, |healing| -healing * (-time / healing).exp_m1()),
            // |h|' = |αf(0)| e^{-|h|/b} - |h|/T
            Some(limit) => {
                let dig = self.digs.abs();
                let free =
                    if dig > 0.0 { limit / dig * (dig * time / limit).ln_1p() } else { time };
                match heals {
                    None => free,
                    Some(healing) => free.min(settled(dig, limit, healing)),
                }
            }
        }
    }

    fn rate_on(&self, depth: f64) -> f64 {
        let heals = self.wider.healing_rate();
        let push = self.push * depth;
        match self.wider.inertia {
            None => push - heals,
            Some(mass) => {
                let (sum, product) = (mass * heals + 1.0, heals - push);
                let root = sum * sum - 4.0 * mass * product;
                if root < 0.0 { -sum / (2.0 * mass) } else { -2.0 * product / (sum + root.sqrt()) }
            }
        }
    }

    /// Logarithm of the growth factor of a deviation between two times, counted from the moment when the tip came to
    /// rest.
    pub(crate) fn growth(&self, from: f64, to: f64) -> f64 {
        let step = (to - from) / f64::from(STEPS);
        let rates = (0..STEPS).map(|i| self.rate(from + step * (f64::from(i) + 0.5)).max(0.0));
        step * rates.sum::<f64>()
    }
}

/// |h|/|αf(0)| at the balance of digging and healing: y = T e^{-dig y/b}.
fn settled(dig: f64, limit: f64, healing: f64) -> f64 {
    halved_between(|y| healing * (-dig * y / limit).exp() - y, 0.0, healing)
}

#[cfg(test)]
mod tests {
    use super::*;
    use stickslip_tip::TipFunction;

    fn rest(wider: Wider) -> Rest {
        let wider = Wider { spring: false, ..wider };
        Rest::of(&Model::under(wider, TipFunction::gaussian(1.0).unwrap(), -3.0, 0.0).unwrap())
    }

    /// The two linear equations, stepped by Euler's method.
    #[test]
    fn a_push_grows_as_its_equations_have_it() {
        for wider in [
            Wider { healing_time: Some(1.0), ..Wider::default() },
            Wider { healing_time: Some(2.0), inertia: Some(1.5), ..Wider::default() },
            Wider { inertia: Some(0.5), ..Wider::default() },
            Wider { healing_time: Some(1.5), depth_limit: Some(2.0), ..Wider::default() },
        ] {
            let rest = rest(wider);
            let (mass, heals) = (wider.inertia.unwrap_or(0.01), wider.healing_rate());
            let (mut v, mut moved, mut depth, h) = (1.0, 0.0, 0.0, 1e-4);
            let mut at_first = 0.0_f64;
            for i in 0..80_000 {
                let w = wider.depth_limit.map_or(1.0, |b| (-(3.0 * depth) / b).exp());
                let next =
                    (v + h * (3.0 * moved - v) / mass, moved + h * (depth * v - heals * moved));
                depth += h * (w - heals * depth);
                (v, moved) = next;
                if i == 40_000 {
                    at_first = v;
                }
            }
            let grown = (v / at_first).ln();
            let foretold = rest.growth(4.0, 8.0);
            assert!((grown / foretold - 1.0).abs() < 0.1, "{wider:?}: {grown} {foretold}");
        }
    }
}
