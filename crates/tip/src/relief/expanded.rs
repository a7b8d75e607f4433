//! A relief as power series about the points of a lattice: the groove of earlier scan lines.

use crate::memory::ROOM;
use multiversion::multiversion;
use std::fmt::Debug;
use std::sync::Arc;
use stickslip_convolution::{PowerSeries, TERMS};

/// A smooth height, 0 far away, as a power series about each point of a lattice.
pub trait Ground: Debug + Send + Sync {
    /// Distance between the points, a number with few significant bits. The points are at its multiples.
    fn spacing(&self) -> f64;
    /// Coefficients `c_n` of u = Σ `c_n` s^n, with s the distance from this point in spacings; accurate to round-off
    /// within half a spacing.
    fn about(&self, point: i64) -> PowerSeries;
}

/// A relief by power series. Unlike a relief on a lattice it has all derivatives that Taylor steps need.
#[derive(Debug, Clone)]
pub(super) struct Expanded {
    ground: Arc<dyn Ground>,
    /// The value at x is that of the ground at origin + sign x.
    origin: f64,
    sign: f64,
}

/// Number of terms that are not negligible within half a spacing. The product of spacing and bandwidth is at most π/2.
const NEAR: usize = 16;

/// Binomials (n + m over n), for every m.
static BINOMIALS: [PowerSeries; TERMS] = {
    let mut all = [[0.0; TERMS]; TERMS];
    let mut m = 0;
    while m < TERMS {
        let mut n = 0;
        while n < TERMS - m {
            all[m][n] = if n == 0 || m == 0 { 1.0 } else { all[m][n - 1] + all[m - 1][n] };
            n += 1;
        }
        m += 1;
    }
    all
};

impl Expanded {
    /// A relief along x from an origin or, if mirrored, against x.
    pub(super) fn new(ground: Arc<dyn Ground>, (origin, mirrored): (f64, bool)) -> Self {
        Self { ground, origin, sign: if mirrored { -1.0 } else { 1.0 } }
    }

    /// The series about the nearest point, and the distance from it, in spacings.
    fn near(&self, x: f64) -> (PowerSeries, f64) {
        let (at, spacing) = (self.origin + self.sign * x, self.ground.spacing());
        let point = (at / spacing).round();
        #[expect(clippy::cast_possible_truncation, reason = "a cell")]
        let series = self.ground.about(point as i64);
        (series, (at - point * spacing) / spacing)
    }

    pub(super) fn height(&self, x: f64) -> f64 {
        let (series, s) = self.near(x);
        series[..NEAR].iter().rev().fold(0.0, |sum, c| sum * s + c)
    }

    pub(super) fn slope_and_curvature(&self, x: f64) -> (f64, f64) {
        let (series, s) = self.near(x);
        let (mut slope, mut curvature) = (0.0, 0.0);
        for n in (1..NEAR).rev() {
            curvature = curvature * s + slope;
            slope = slope * s + n as f64 * series[n];
        }
        let spacing = self.ground.spacing();
        (self.sign * slope / spacing, curvature / (spacing * spacing))
    }

    /// The height and its derivatives at x.
    pub(super) fn derivatives(&self, x: f64) -> [f64; ROOM] {
        let (series, s) = self.near(x);
        let mut derivatives = shifted(&series, s);
        let (mut factor, step) = (1.0, self.sign / self.ground.spacing());
        for (n, derivative) in derivatives.iter_mut().enumerate() {
            *derivative *= factor;
            factor *= step * (n + 1) as f64;
        }
        derivatives
    }
}

/// The same power series about a point at the distance s.
#[multiversion(targets("x86_64+avx2"))]
fn shifted(series: &PowerSeries, s: f64) -> PowerSeries {
    let (mut sums, mut power) = ([0.0; TERMS], 1.0);
    let mut rest = [0.0; 2 * TERMS];
    rest[..TERMS].copy_from_slice(series);
    for (m, binomials) in BINOMIALS.iter().enumerate() {
        for n in 0..TERMS {
            sums[n] += binomials[n] * power * rest[m + n];
        }
        power *= s;
    }
    sums
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::TipFunction;

    /// The groove of a Gaussian that stood at a few places.
    #[derive(Debug)]
    struct Pits(f64);

    const PITS: [(f64, f64); 3] = [(1.3, 0.7), (2.9, -0.4), (6.1, 1.1)];

    /// Derivatives of e^{-x²/2} over n!.
    fn terms(x: f64) -> [f64; ROOM] {
        let mut terms = [0.0; ROOM];
        terms[0] = (-0.5 * x * x).exp();
        terms[1] = -x * terms[0];
        for n in 1..ROOM - 1 {
            terms[n + 1] = -(x * terms[n] + terms[n - 1]) / (n + 1) as f64;
        }
        terms
    }

    impl Ground for Pits {
        fn spacing(&self) -> f64 {
            self.0
        }

        fn about(&self, point: i64) -> PowerSeries {
            let at = |n: usize| {
                let of = |(x, weight): &(f64, f64)| weight * terms(point as f64 * self.0 - x)[n];
                PITS.iter().map(of).sum::<f64>() * self.0.powi(n as i32)
            };
            std::array::from_fn(at)
        }
    }

    #[test]
    fn heights_slopes_curvatures_and_all_derivatives_are_those_of_the_sum() {
        let tip = TipFunction::gaussian(1.0).unwrap();
        let there = Expanded::new(Arc::new(Pits(0.171_875)), (0.5, false));
        let back = Expanded::new(Arc::new(Pits(0.171_875)), (9.0, true));
        for i in 0..300 {
            let x = -2.0 + 0.041 * f64::from(i);
            let sum = |of: &dyn Fn(f64) -> f64| -> f64 {
                PITS.iter().map(|(at, weight)| weight * of(x - at)).sum()
            };
            let wanted = [
                sum(&|x| tip.value(x)),
                sum(&|x| tip.slope_and_curvature(x).0),
                sum(&|x| tip.slope_and_curvature(x).1),
            ];
            for (relief, at, sign) in [(&there, x - 0.5, 1.0), (&back, 9.0 - x, -1.0)] {
                let (slope, curvature) = relief.slope_and_curvature(at);
                let found = [relief.height(at), sign * slope, curvature];
                let derivatives = relief.derivatives(at);
                for n in 0..3 {
                    let same = sign.powi(n as i32) * derivatives[n];
                    assert!((found[n] - wanted[n]).abs() < 1e-13, "{n} {x}: {found:?} {wanted:?}");
                    assert!((same - wanted[n]).abs() < 1e-13, "{n} {x}");
                }
                // As far as a step leads, and to the orders that steps have.
                let mut factorial = 1.0;
                for (n, derivative) in derivatives.iter().enumerate().take(26) {
                    let exact = sum(&|x| terms(x)[n]);
                    let error = derivative * sign.powi(n as i32) / factorial - exact;
                    assert!(error.abs() < 1e-12, "{n} {x}: {error:e} of {exact:e}");
                    factorial *= (n + 1) as f64;
                }
            }
        }
    }
}
