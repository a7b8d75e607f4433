//! Sums of Gaussians a exp(-(x-c)²/(2w²)).

use super::{BAND_OF_A_GAUSSIAN, LARGEST, TipFunctionError};
use crate::Footprint;
use crate::elementary::{cos, exp};
use std::f64::consts::{FRAC_1_SQRT_2, PI};
use std::sync::Arc;

/// A Gaussian is below 1e-17 of its peak beyond this many widths: exp(-8.8²/2) = 1.5e-17. The factor
/// x that a derivative brings keeps that below round-off too.
const WIDTHS_OF_REACH: f64 = 8.8;

/// One term a exp(-(x-c)²/(2w²)). Lengths in units of σ.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gaussian {
    /// a
    pub amplitude: f64,
    /// c
    pub center: f64,
    /// w
    pub width: f64,
}

/// An even sum of Gaussians, validated.
#[derive(Debug, Clone, PartialEq)]
pub struct GaussianSum {
    terms: Vec<Gaussian>,
    /// Distance of the terms, where they are those of a table.
    lattice: Option<f64>,
    /// The f(x,y) that this is f(x,0) of.
    footprint: Option<Arc<Footprint>>,
}

impl GaussianSum {
    /// # Errors
    /// Not finite or far out of range, a width ≤ 0, zero everywhere, or not even.
    pub(super) fn new(terms: Vec<Gaussian>) -> Result<Self, TipFunctionError> {
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
        if let Some(term) = terms.iter().find(|term| !has_twin(&terms, term)) {
            return Err(TipFunctionError::NotEven { center: term.center });
        }
        Ok(Self { lattice: lattice(&terms), terms, footprint: None })
    }

    /// The terms, as given.
    #[must_use]
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
        self.near(x).map(|(g, z)| g.amplitude * exp(-0.5 * z * z)).sum()
    }

    pub(super) fn slope_and_curvature(&self, x: f64) -> (f64, f64) {
        self.near(x).fold((0.0, 0.0), |(slope, curvature), (g, z)| {
            let value = g.amplitude * exp(-0.5 * z * z) / g.width;
            (slope - z * value, curvature + (z * z - 1.0) * value / g.width)
        })
    }

    /// From g' = -(x-c)/w² g: (n+1) `g_{n+1}` = (c `g_n` - `g_{n-1}`)/w².
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
        // Odd ones cancel between twins, to round-off.
        sum.iter_mut().skip(1).step_by(2).for_each(|odd| *odd = 0.0);
        sum
    }

    /// Cramér's bound of Hermite functions: |d^n/dz^n e^{-z²/2}| < 1.0865 √(n!).
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

    pub(super) fn fourier(&self, q: f64) -> f64 {
        let term = |g: &Gaussian| {
            let qw = q * g.width;
            g.amplitude * g.width * (2.0 * PI).sqrt() * exp(-0.5 * qw * qw) * cos(q * g.center)
        };
        self.terms.iter().map(term).sum()
    }

    pub(super) fn reach(&self) -> f64 {
        self.terms.iter().map(|g| g.center.abs() + WIDTHS_OF_REACH * g.width).fold(0.0, f64::max)
    }

    pub(super) fn band(&self) -> f64 {
        self.terms.iter().map(|g| BAND_OF_A_GAUSSIAN / g.width).fold(0.0, f64::max)
    }

    /// The terms that matter at x, each with z = (x-c)/w: a table's many narrow ones are mostly far.
    fn near(&self, x: f64) -> impl Iterator<Item = (&Gaussian, f64)> {
        self.looked_at(x)
            .iter()
            .map(move |g| (g, (x - g.center) / g.width))
            .filter(|(_, z)| z.abs() < WIDTHS_OF_REACH)
    }

    /// All terms that may matter at x: of a table those of the lattice points about |x|, in their order.
    fn looked_at(&self, x: f64) -> &[Gaussian] {
        let Some(spacing) = self.lattice else { return &self.terms };
        let reach = WIDTHS_OF_REACH * self.terms[0].width;
        let (low, high) = ((x.abs() - reach) / spacing, (x.abs() + reach) / spacing);
        // Point k has the terms 2k - 1 and 2k. One point more on either side: what is rounded here is not missed.
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates")]
        let (first, last) = ((low as usize).saturating_sub(1), (high as usize).saturating_add(2));
        let end = last.saturating_mul(2).saturating_add(1).min(self.terms.len());
        &self.terms[first.saturating_mul(2).saturating_sub(1).min(end)..end]
    }
}

/// The distance of terms that are on an even lattice as those of a table are, of one width, in the order 0, -1, 1, -2,
/// 2 and so on.
fn lattice(terms: &[Gaussian]) -> Option<f64> {
    /// Fewer are looked at as soon as chosen.
    const MANY: usize = 32;
    let (first, spacing) = (terms.first()?, terms.get(2)?.center);
    let same = |a: f64, b: f64| (a - b).abs() <= 0.0;
    let at = |(i, g): (usize, &Gaussian)| {
        #[expect(clippy::cast_precision_loss, reason = "a table has 2000 rows")]
        let distance = i.div_ceil(2) as f64 * spacing;
        same(g.center, if i.is_multiple_of(2) { distance } else { -distance })
            && same(g.width, first.width)
    };
    let is_lattice = terms.len() >= MANY && spacing > 0.0 && terms.iter().enumerate().all(at);
    is_lattice.then_some(spacing)
}

/// Whether the mirror image of `term` is among `terms` as often as it is itself, to round-off.
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
            for i in -3000..=3000 {
                let x = 0.005 * f64::from(i);
                assert_eq!(sum.value(x).to_bits(), all.value(x).to_bits(), "{x}");
                let bits = |(a, b): (f64, f64)| (a.to_bits(), b.to_bits());
                let here = |sum: &GaussianSum| bits(sum.slope_and_curvature(x));
                assert_eq!(here(&sum), here(&all), "{x}");
            }
            for x in [f64::NAN, f64::INFINITY, 1e300, -1e300] {
                assert!(sum.value(x).abs() <= 0.0, "{x}");
            }
        }
        let few = [0.0, -1.0, 1.0].map(|center| Gaussian { amplitude: 1.0, center, width: 1.0 });
        assert_eq!(GaussianSum::new(few.to_vec()).unwrap().lattice, None);
    }
}
