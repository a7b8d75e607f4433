//! Sums of Gaussians a exp(-(x-c)²/(2w²)).

use super::lattice::Lattice;
use super::term::{Gaussian, WIDTHS_OF_REACH};
use super::{BAND_OF_A_GAUSSIAN, LARGEST, TipFunctionError};
use crate::Footprint;
use crate::elementary::{complex_exp, cos, exp, exp_within};
use num_complex::Complex;
use std::f64::consts::{FRAC_1_SQRT_2, PI};
use std::sync::Arc;

/// A sum of Gaussians, even or with its apex at 0, validated.
#[derive(Debug, Clone, PartialEq)]
pub struct GaussianSum {
    terms: Vec<Gaussian>,
    is_even: bool,
    /// The lattice of the terms, if they are those of a table.
    lattice: Option<Lattice>,
    /// The f(x,y) of which this is the section f(x,0).
    footprint: Option<Arc<Footprint>>,
}

impl GaussianSum {
    /// An even sum.
    ///
    /// # Errors
    /// As [`with_apex_at_0`](Self::with_apex_at_0), or the sum is not even.
    pub(super) fn new(terms: Vec<Gaussian>) -> Result<Self, TipFunctionError> {
        let sum = Self::validated(terms)?;
        if sum.is_even { Ok(sum) } else { Err(sum.not_even()) }
    }

    /// A sum that need not be even, but has f'(0) = 0.
    ///
    /// # Errors
    /// A term is not finite or far out of range, a width is not positive, the sum is zero everywhere or f'(0) is not 0.
    pub(super) fn with_apex_at_0(terms: Vec<Gaussian>) -> Result<Self, TipFunctionError> {
        let sum = Self::validated(terms)?;
        let steepest: f64 = sum.terms.iter().map(|g| g.amplitude.abs() / g.width).sum();
        let is_level = sum.is_even || sum.slope_and_curvature(0.0).0.abs() <= LEVEL * steepest;
        if is_level { Ok(sum) } else { Err(sum.not_even()) }
    }

    fn validated(terms: Vec<Gaussian>) -> Result<Self, TipFunctionError> {
        for (i, term) in terms.iter().enumerate() {
            let index = i + 1;
            if ![term.amplitude, term.center, term.width].iter().all(|v| v.is_finite()) {
                return Err(TipFunctionError::NotFinite { index });
            }
            if term.width <= 0.0 {
                return Err(TipFunctionError::Width { index, width: term.width });
            }
            let sizes = [term.amplitude, term.center, term.width, 1.0 / term.width];
            if sizes.iter().any(|size| size.abs() > LARGEST) {
                return Err(TipFunctionError::OutOfRange { index });
            }
        }
        if terms.iter().all(|term| term.amplitude.abs() <= 0.0) {
            return Err(TipFunctionError::Zero);
        }
        let is_even = terms.iter().all(|term| has_twin(&terms, term));
        Ok(Self { is_even, lattice: Lattice::of(&terms), terms, footprint: None })
    }

    fn not_even(&self) -> TipFunctionError {
        let single = self.terms.iter().find(|term| !has_twin(&self.terms, term));
        TipFunctionError::NotEven { center: single.map_or(0.0, |term| term.center) }
    }

    /// Whether f(-x) = f(x), and f(-x,y) = f(x,y) of a footprint, which may differ on other lines.
    pub(super) fn is_even(&self) -> bool {
        self.is_even && self.footprint().is_none_or(Footprint::is_even)
    }

    /// f(-x)
    pub(super) fn mirrored(&self) -> Self {
        let mirrored = |g: &Gaussian| Gaussian { center: -g.center, ..*g };
        let terms: Vec<Gaussian> = self.terms.iter().map(mirrored).collect();
        let footprint = self.footprint.as_ref().map(|footprint| Arc::new(footprint.mirrored()));
        Self { is_even: self.is_even, lattice: Lattice::of(&terms), terms, footprint }
    }

    /// The terms, as given.
    pub fn terms(&self) -> &[Gaussian] {
        &self.terms
    }

    pub(super) fn with_footprint(self, footprint: Footprint) -> Self {
        Self { footprint: Some(Arc::new(footprint)), ..self }
    }

    pub(super) fn footprint(&self) -> Option<&Footprint> {
        self.footprint.as_deref()
    }

    pub(super) fn value(&self, x: f64) -> f64 {
        let mut sum = 0.0;
        self.near(x, |_, _, value| sum += value);
        sum
    }

    /// Value and slope from the same exponentials, equal to those of single evaluations bit for bit.
    pub(super) fn value_and_slope(&self, x: f64) -> (f64, f64) {
        let (mut sum, mut slope) = (0.0, 0.0);
        self.near(x, |width, z, value| {
            sum += value;
            slope -= z * (value / width);
        });
        (sum, slope)
    }

    #[inline]
    pub(super) fn value_slope_and_curvature(&self, x: f64) -> [f64; 3] {
        let [mut sum, mut slope, mut curvature] = [0.0; 3];
        self.near(x, |width, z, value| {
            sum += value;
            let value = value / width;
            slope -= z * value;
            curvature += (z * z - 1.0) * value / width;
        });
        [sum, slope, curvature]
    }

    pub(super) fn slope_and_curvature(&self, x: f64) -> (f64, f64) {
        let [_, slope, curvature] = self.value_slope_and_curvature(x);
        (slope, curvature)
    }

    /// Slopes and curvatures at many x in SIMD lanes, equal to those of single evaluations bit for bit.
    #[inline(always)]
    pub(super) fn slopes_and_curvatures<const N: usize>(&self, x: &[f64; N]) -> [[f64; N]; 2] {
        let mut sums = [[0.0; N]; 2];
        if self.lattice.is_some() {
            for i in 0..N {
                (sums[0][i], sums[1][i]) = self.slope_and_curvature(x[i]);
            }
            return sums;
        }
        for g in &self.terms {
            // Loops throughout: `map` is none over lanes unless it happens to be inlined.
            let (mut z, mut near) = ([0.0; N], [0.0; N]);
            for i in 0..N {
                let far = (x[i] - g.center) / g.width;
                // What is out of reach is 0.
                let is_near = far.abs() < WIDTHS_OF_REACH;
                (z[i], near[i]) = if is_near { (far, 1.0) } else { (0.0, 0.0) };
            }
            let mut value = [0.0; N];
            for i in 0..N {
                let exponential = exp_within(-0.5 * z[i] * z[i]);
                value[i] = near[i] * (g.amplitude * exponential / g.width);
            }
            for i in 0..N {
                sums[0][i] -= z[i] * value[i];
            }
            for i in 0..N {
                sums[1][i] += (z[i] * z[i] - 1.0) * value[i] / g.width;
            }
        }
        sums
    }

    /// Taylor coefficients about 0. For each Gaussian g' = -(x-c)/w² g, hence (n+1) `g_{n+1}` = (c `g_n` -
    /// `g_{n-1}`)/w².
    pub(super) fn taylor(&self, degree: usize) -> Vec<f64> {
        let mut sum = vec![0.0; degree + 1];
        for g in &self.terms {
            let z = g.center / g.width;
            let (mut before, mut here) = (0.0, g.amplitude * exp(-0.5 * z * z));
            for (n, coefficient) in sum.iter_mut().enumerate() {
                *coefficient += here;
                let next = (g.center * here - before) / (g.width * g.width * (n + 1) as f64);
                (before, here) = (here, next);
            }
        }
        if self.is_even {
            // Odd ones cancel between twins, to round-off.
            sum.iter_mut().skip(1).step_by(2).for_each(|odd| *odd = 0.0);
        }
        sum
    }

    /// A bound on |f^{(n)}|, from Cramér's bound of Hermite functions: |d^n/dz^n e^{-z²/2}| < 1.0865 √(n!).
    pub(super) fn derivative_bound(&self, n: usize) -> f64 {
        let root_factorial: f64 = (1..=n).map(|k| (k as f64).sqrt()).product();
        let power = i32::try_from(n).unwrap_or(i32::MAX);
        let term = |g: &Gaussian| g.amplitude.abs() / g.width.powi(power);
        1.0865 * root_factorial * self.terms.iter().map(term).sum::<f64>()
    }

    pub(super) fn tail(&self, x: f64) -> f64 {
        let term = |g: &Gaussian| {
            let z = (x - g.center) / g.width;
            g.amplitude * g.width * (PI / 2.0).sqrt() * libm::erfc(z * FRAC_1_SQRT_2)
        };
        self.terms.iter().map(term).sum()
    }

    /// ∫ f cos(qξ)dξ of an even sum.
    pub(super) fn fourier(&self, q: f64) -> f64 {
        let term = |g: &Gaussian| {
            let qw = q * g.width;
            g.amplitude * g.width * (2.0 * PI).sqrt() * exp(-0.5 * qw * qw) * cos(q * g.center)
        };
        self.terms.iter().map(term).sum()
    }

    /// f̂(z) at z = q - iκ, κ = `fading`: the sum of `a w √(2π) e^{-z²w²/2} e^{-izc}`, where in an even sum cos(zc)
    /// replaces e^{-izc}.
    pub(super) fn fourier_fading(&self, q: f64, fading: f64) -> Complex<f64> {
        let z = Complex::new(q, -fading);
        let term = |g: &Gaussian| {
            let turned = Complex::new(0.0, g.center) * z;
            let shift = complex_exp(-turned);
            let shift = if self.is_even { 0.5 * (complex_exp(turned) + shift) } else { shift };
            complex_exp(-0.5 * g.width * g.width * z * z)
                * shift
                * (g.amplitude * g.width * (2.0 * PI).sqrt())
        };
        self.terms.iter().map(term).sum()
    }

    pub(super) fn reach(&self) -> f64 {
        self.terms.iter().map(|g| g.center.abs() + WIDTHS_OF_REACH * g.width).fold(0.0, f64::max)
    }

    pub(super) fn band(&self) -> f64 {
        self.terms.iter().map(|g| BAND_OF_A_GAUSSIAN / g.width).fold(0.0, f64::max)
    }

    /// Passes width, z = (x-c)/w and value of each term that is not negligible at x. Most of the narrow terms of a
    /// table are negligible.
    fn near(&self, x: f64, mut take: impl FnMut(f64, f64, f64)) {
        if let Some(lattice) = &self.lattice {
            return lattice.near(&self.terms, x, take);
        }
        for g in &self.terms {
            let z = (x - g.center) / g.width;
            if z.abs() < WIDTHS_OF_REACH {
                take(g.width, z, g.amplitude * exp_within(-0.5 * z * z));
            }
        }
    }
}

/// Largest slope at the apex, relative to a bound on the slope of the terms.
const LEVEL: f64 = 1e-10;

/// Whether the mirror image of `term` is among `terms` as often as `term` itself, to round-off.
fn has_twin(terms: &[Gaussian], term: &Gaussian) -> bool {
    let close = |a: f64, b: f64, scale: f64| (a - b).abs() <= 1e-12 * scale;
    let total = |center: f64| -> f64 {
        terms
            .iter()
            .filter(|g| {
                close(g.width, term.width, term.width) && close(g.center, center, term.width)
            })
            .map(|g| g.amplitude)
            .sum()
    };
    close(total(term.center), total(-term.center), term.amplitude.abs().max(1e-300))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One at a time they are the oracle, to the last bit: also out of reach of all terms or some, and where no x is.
    #[test]
    fn many_side_by_side_are_what_each_is_alone() {
        let lobes = crate::TipFunction::triple_gaussian(0.7, 1.3).unwrap();
        let (x, f): (Vec<f64>, Vec<f64>) =
            (0..40).map(|i| 0.2 * f64::from(i)).map(|x| (x, (-0.5 * x * x).exp())).unzip();
        let table = crate::TipFunction::table(&x, &f).unwrap();
        for tip in [lobes, table, crate::TipFunction::Bessel] {
            for i in -400_i32..400 {
                let mut x = [0, 1, 2, 3, 4].map(|k| 0.0417 * f64::from(i) + 1.618 * f64::from(k));
                x[3] = [f64::INFINITY, 1e300, -1e300, f64::NAN, 0.0][i.unsigned_abs() as usize % 5];
                let [slope, curvature] = tip.slopes_and_curvatures(&x);
                for k in [0, 1, 2, 4] {
                    let alone = tip.slope_and_curvature(x[k]);
                    assert_eq!(
                        (slope[k].to_bits(), curvature[k].to_bits()),
                        (alone.0.to_bits(), alone.1.to_bits()),
                        "{}",
                        x[k]
                    );
                    let both = tip.value_and_slope(x[k]);
                    assert_eq!(both.0.to_bits(), tip.value(x[k]).to_bits(), "{}", x[k]);
                    assert_eq!(both.1.to_bits(), alone.0.to_bits(), "{}", x[k]);
                }
            }
        }
    }

    /// The same terms in another order, of which all are looked at.
    #[test]
    fn of_a_table_no_term_that_matters_is_passed_over() {
        for rows in [20, 300] {
            let x: Vec<f64> = (0..rows).map(|i| 9.0 * f64::from(i) / f64::from(rows - 1)).collect();
            let f: Vec<f64> =
                x.iter().map(|x| (1.0 - 0.2 * x * x) * (-0.5 * x * x).exp()).collect();
            let crate::TipFunction::Gaussians(sum) = crate::TipFunction::table(&x, &f).unwrap()
            else {
                unreachable!("a table is a sum")
            };
            assert!(sum.lattice.is_some());
            let all = GaussianSum { lattice: None, ..sum.clone() };
            // What f'' is rounded by: amplitudes are some times as large as f, and so are their terms.
            let size: f64 = sum.terms.iter().map(|g| g.amplitude.abs()).fold(0.0, f64::max);
            let width = sum.terms[0].width;
            for i in -3000..=3000 {
                let x = 0.005 * f64::from(i);
                let close = |a: f64, b: f64, size: f64| (a - b).abs() < 1e-14 * size;
                assert!(close(sum.value(x), all.value(x), size), "{x}");
                let (here, there) = (sum.slope_and_curvature(x), all.slope_and_curvature(x));
                assert!(close(here.0, there.0, size / width), "{x}: {here:?} {there:?}");
                assert!(close(here.1, there.1, size / width.powi(2)), "{x}: {here:?} {there:?}");
            }
            for x in [f64::NAN, f64::INFINITY, 1e300, -1e300] {
                assert!(sum.value(x).abs() <= 0.0, "{x}");
            }
        }
        let few = [0.0, -1.0, 1.0].map(|center| Gaussian { amplitude: 1.0, center, width: 1.0 });
        assert_eq!(GaussianSum::new(few.to_vec()).unwrap().lattice, None);
    }
}
