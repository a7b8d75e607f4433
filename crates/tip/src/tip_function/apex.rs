//! f and f' near the apex of an even f, as polynomials from their Taylor series.

use super::TipFunction;
use crate::elementary::{exp, ln, pow};

/// `f'(d) ≈ Σ_k c_k d^{2k+1}` for |d| up to a length that depends on the number of terms. The contribution of a step
/// to its own groove involves such short displacements only.
#[derive(Debug, Clone)]
pub(crate) struct Apex {
    /// `c_k`, and `(2k+1) c_k` for f''.
    slope: [f64; MOST_TERMS],
    curvature: [f64; MOST_TERMS],
    /// f(0), and `c_k/(2k+2)` for f.
    top: f64,
    value: [f64; MOST_TERMS],
    /// `lengths[n]` is the largest |d| for n + 1 terms.
    lengths: [f64; MOST_TERMS],
}

const MOST_TERMS: usize = 24;
/// Largest ratio of a term of the series to the largest |f'|: cancellation multiplies round-off by a hundred at most.
const CANCELLATION: f64 = 100.0;

impl Apex {
    /// Polynomials with an error of f' of at most `error` times the largest |f'|. If f is not even, they are valid for
    /// no displacement.
    pub(crate) fn new(tip: &TipFunction, error: f64) -> Self {
        let mut apex = Self {
            slope: [0.0; MOST_TERMS],
            curvature: [0.0; MOST_TERMS],
            top: tip.value(0.0),
            value: [0.0; MOST_TERMS],
            lengths: [-1.0; MOST_TERMS],
        };
        if !tip.is_even() {
            return apex;
        }
        let taylor = tip.taylor(2 * MOST_TERMS);
        for k in 0..MOST_TERMS {
            let degree = (2 * k + 1) as f64;
            apex.slope[k] = (degree + 1.0) * taylor[2 * k + 2];
            apex.curvature[k] = degree * apex.slope[k];
            apex.value[k] = taylor[2 * k + 2];
        }
        let size = tip.derivative_bound(1).max(f64::MIN_POSITIVE);
        let mut log_factorial = 0.0;
        let mut longest = f64::INFINITY;
        for k in 0..MOST_TERMS {
            let degree = (2 * k + 1) as f64;
            log_factorial += if k > 0 { ln(degree * (degree - 1.0)) } else { 0.0 };
            // c_k d^{2k+1} may not exceed the largest |f'| by more than is lost to round-off.
            longest =
                f64::min(longest, pow(CANCELLATION * size / apex.slope[k].abs(), 1.0 / degree));
            // What is left out: |f^{(2k+4)}| d^{2k+3}/(2k+3)! at most.
            let next = degree + 2.0;
            let log_next = log_factorial + ln(next * (next - 1.0));
            let bound = tip.derivative_bound(2 * k + 4).max(f64::MIN_POSITIVE);
            let length = exp((ln(error * size / bound) + log_next) / next);
            apex.lengths[k] = length.min(longest);
        }
        apex
    }

    /// f' and f'' at all of `d`; false if one of them is too far from the apex.
    pub(crate) fn slopes_and_curvatures<const N: usize>(
        &self,
        d: &[f64; N],
        slope: &mut [f64; N],
        curvature: &mut [f64; N],
    ) -> bool {
        let Some(terms) = self.terms(d) else { return false };
        let y = d.map(|d| d * d);
        (*slope, *curvature) = ([0.0; N], [0.0; N]);
        for (s, c) in self.slope[..terms].iter().zip(&self.curvature[..terms]).rev() {
            for i in 0..N {
                slope[i] = slope[i] * y[i] + s;
                curvature[i] = curvature[i] * y[i] + c;
            }
        }
        slope.iter_mut().zip(d).for_each(|(s, d)| *s *= d);
        true
    }

    /// f at all of `d`; false if one of them is too far from the apex.
    pub(crate) fn values<const N: usize>(&self, d: &[f64; N], value: &mut [f64; N]) -> bool {
        let Some(terms) = self.terms(d) else { return false };
        let y = d.map(|d| d * d);
        *value = [0.0; N];
        for c in self.value[..terms].iter().rev() {
            value.iter_mut().zip(&y).for_each(|(value, y)| *value = *value * y + c);
        }
        value.iter_mut().zip(y).for_each(|(value, y)| *value = *value * y + self.top);
        true
    }

    /// Number of terms needed for the farthest of these displacements; `None` if that is too far.
    fn terms(&self, d: &[f64]) -> Option<usize> {
        let farthest = d.iter().fold(0.0, |m: f64, d| m.max(d.abs()));
        // Lengths grow with the number of terms until round-off ends them.
        let enough = self.lengths.iter().position(|length| farthest <= *length)?;
        Some(enough + 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The closed forms are the oracle; each number of terms is tried at the end of its reach.
    #[test]
    fn the_polynomial_is_as_near_as_promised_wherever_it_says_it_holds() {
        let x: Vec<f64> = (0..60).map(|i| 0.15 * f64::from(i)).collect();
        let f: Vec<f64> = x.iter().map(|x| (1.0 - 0.3 * x * x) * (-x * x / 2.0).exp()).collect();
        let tips = [
            TipFunction::triple_gaussian(1.0, 1.0).unwrap(),
            TipFunction::triple_gaussian(0.7, 0.04).unwrap(),
            TipFunction::gaussian(30.0).unwrap(),
            TipFunction::table(&x, &f).unwrap(),
            TipFunction::Bessel,
        ];
        for tip in tips {
            let size = tip.derivative_bound(1);
            for error in [1e-6, 1e-10, 1e-15] {
                let apex = Apex::new(&tip, error);
                for length in apex.lengths {
                    let d = [length * (1.0 - 1e-12), -0.7 * length, 0.1 * length, 0.0];
                    let (mut slope, mut curvature) = ([0.0; 4], [0.0; 4]);
                    assert!(apex.slopes_and_curvatures(&d, &mut slope, &mut curvature));
                    let mut value = [0.0; 4];
                    assert!(apex.values(&d, &mut value));
                    for i in 0..4 {
                        let (f1, f2) = tip.slope_and_curvature(d[i]);
                        let allowed = (error + 1e-13) * size;
                        let miss = (value[i] - tip.value(d[i])).abs();
                        assert!(
                            miss < allowed * length.max(1.0),
                            "{tip:?} {error} {} {miss}",
                            d[i]
                        );
                        assert!(
                            (slope[i] - f1).abs() < allowed,
                            "{tip:?} {error} {} {f1} {}",
                            d[i],
                            slope[i]
                        );
                        // The derivative loses the degree over the length.
                        let steep = 60.0 * allowed / length.min(1.0);
                        assert!((curvature[i] - f2).abs() < steep, "{tip:?} {error} {}", d[i]);
                    }
                }
                let far = apex.lengths[MOST_TERMS - 1] * 1.01;
                assert!(!apex.slopes_and_curvatures(&[far], &mut [0.0], &mut [0.0]));
            }
        }
    }
}
