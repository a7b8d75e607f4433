//! Sums of Gaussians a exp(-(x-c)²/(2w²)).

use super::{BAND_OF_A_GAUSSIAN, LARGEST, TipFunctionError};
use crate::Footprint;
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
        Ok(Self { terms, footprint: None })
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
        self.near(x).map(|(g, z)| g.amplitude * (-0.5 * z * z).exp()).sum()
    }

    pub(super) fn slope_and_curvature(&self, x: f64) -> (f64, f64) {
        self.near(x).fold((0.0, 0.0), |(slope, curvature), (g, z)| {
            let value = g.amplitude * (-0.5 * z * z).exp() / g.width;
            (slope - z * value, curvature + (z * z - 1.0) * value / g.width)
        })
    }

    /// From g' = -(x-c)/w² g: (n+1) `g_{n+1}` = (c `g_n` - `g_{n-1}`)/w².
    pub(super) fn taylor(&self, degree: usize) -> Vec<f64> {
        let mut sum = vec![0.0; degree + 1];
        for g in &self.terms {
            let z = g.center / g.width;
            let (mut before, mut here) = (0.0, g.amplitude * (-0.5 * z * z).exp());
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
            g.amplitude
                * g.width
                * (2.0 * PI).sqrt()
                * (-0.5 * qw * qw).exp()
                * (q * g.center).cos()
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
        self.terms
            .iter()
            .map(move |g| (g, (x - g.center) / g.width))
            .filter(|(_, z)| z.abs() < WIDTHS_OF_REACH)
    }
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
