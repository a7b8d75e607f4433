//! Power series of a sum about the points of its lattice, from the spread density.

use std::f64::consts::{PI, TAU};

use multiversion::multiversion;
use rustfft::num_complex::Complex;

use crate::lattice::dyadic_at_most;
use crate::plan::UPSAMPLING;
use crate::window::{WIDTH, Window};

/// Number of coefficients of a power series.
pub const TERMS: usize = 32;
/// Coefficients `c_n` of `S = Σ c_n s^n`, with `s` the distance in spacings.
pub type PowerSeries = [f64; TERMS];

/// Number of cells by which division by φ̂ extends the reach of a kernel.
const BEYOND: f64 = WIDTH as f64;
/// Period P of the sum over wave numbers, relative to the extended range of the kernel (twice its reach).
const PERIOD: f64 = 1.3;

/// The power series of `S(x) = Σ_j w_j K(x − y_j)` about the center of cell c, from the [`Density`](crate::Density) D_m
/// of the sources in the cells m around it:
///
/// ```text
/// c_n = Σ_m D_m h^n/n! K_n((c − m)h),      K_n(x) = (1/P) Σ_k (ik)^n K̂(k)/φ̂(k) e^{ikx}
/// ```
///
/// Here h is the spacing and P the period of the sum over k. Only the cells within reach are needed. Every derivative
/// is a sum of its own: in the derivatives of an interpolant round-off would grow with every order.
///
/// **Guarantee.** For a Gaussian kernel, the error of `c_n s^n` is at most 1e-12 Σ|w| max|K| up to two widths from the
/// cell.
#[derive(Clone, Debug)]
pub struct Expander {
    spacing: f64,
    reach: usize,
    /// Coefficients for unit density in each cell, from `reach` cells below to `reach` cells above.
    weights: Vec<Weights>,
}

/// The coefficients for one cell. Aligned to vectors of four: a load across two cache lines takes as long as two.
#[derive(Clone, Debug)]
#[repr(align(32))]
struct Weights(PowerSeries);

impl Expander {
    /// Power series for a kernel that is given by its transform K̂(k). K̂ is negligible beyond `band`, the kernel
    /// beyond `reach`. Densities must have the [`spacing`](Self::spacing) for the bandwidth `band_of_lattice`, at least
    /// `band`.
    ///
    /// # Panics
    /// `band` or `reach` is not positive, or `band_of_lattice` or `reach` is not finite.
    pub fn new(
        (band, band_of_lattice): (f64, f64),
        reach: f64,
        transform: impl Fn(f64) -> Complex<f64>,
    ) -> Self {
        assert!(band > 0.0 && band_of_lattice.is_finite() && reach > 0.0 && reach.is_finite());
        let spacing = dyadic_at_most(PI / (UPSAMPLING * band_of_lattice));
        let reach = (reach / spacing + BEYOND).ceil() as usize;
        let period = PERIOD * (2 * reach + 1) as f64;
        let lowest = TAU / period;
        let waves: Vec<(f64, Complex<f64>)> = (0..=(band * spacing / lowest) as usize)
            .map(|j| {
                let kappa = lowest * j as f64;
                // Both ±k have the same real part.
                let times = if j == 0 { 1.0 } else { 2.0 };
                let scale = times / (period * spacing * Window::shared().transform(kappa));
                (kappa, transform(kappa / spacing) * scale)
            })
            .collect();
        let weight = |m: usize| {
            let distance = reach as f64 - m as f64;
            let mut series = [0.0; TERMS];
            for (kappa, amplitude) in &waves {
                let mut term = amplitude * Complex::new(0.0, kappa * distance).exp();
                for (n, c) in series.iter_mut().enumerate() {
                    *c += term.re;
                    term *= Complex::new(0.0, kappa / (n + 1) as f64);
                }
            }
            Weights(series)
        };
        Self { spacing, reach, weights: (0..=2 * reach).map(weight).collect() }
    }

    /// The spacing required of densities.
    pub fn spacing(&self) -> f64 {
        self.spacing
    }

    /// Number of cells that the series about a cell needs on either side of it.
    pub fn reach(&self) -> usize {
        self.reach
    }

    /// Adds the power series about a cell, given the densities of that cell and of those within [`reach`](Self::reach)
    /// on either side.
    ///
    /// # Panics
    /// The number of cells is not 2 [`reach`](Self::reach) + 1.
    pub fn add(&self, cells: &[f64], series: &mut PowerSeries) {
        assert_eq!(cells.len(), self.weights.len(), "cells of a series");
        add(&self.weights, cells, series);
    }
}

/// Also compiled for wider vectors: each coefficient is a separate sum, so that the bits are the same.
#[multiversion(targets("x86_64+avx2"))]
fn add(weights: &[Weights], cells: &[f64], series: &mut PowerSeries) {
    let mut sums = *series;
    for (Weights(weights), cell) in weights.iter().zip(cells) {
        for (sum, weight) in sums.iter_mut().zip(weights) {
            *sum += weight * cell;
        }
    }
    *series = sums;
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Density;

    /// Derivatives of e^{-x²/2} over n!, by h_{n+1} = -(x h_n + h_{n-1})/(n+1).
    fn gaussian(x: f64) -> PowerSeries {
        let mut terms = [0.0; TERMS];
        terms[0] = (-0.5 * x * x).exp();
        terms[1] = -x * terms[0];
        for n in 1..TERMS - 1 {
            terms[n + 1] = -(x * terms[n] + terms[n - 1]) / (n + 1) as f64;
        }
        terms
    }

    /// Every coefficient against the derivatives of the kernel at all sources.
    #[test]
    fn every_coefficient_is_that_of_the_direct_sum() {
        let hat = |k: f64| Complex::new(TAU.sqrt() * (-0.5 * k * k).exp(), 0.0);
        for band_of_lattice in [8.7, 13.0] {
            let expander = Expander::new((8.7, band_of_lattice), 9.0, hat);
            let (h, reach) = (expander.spacing(), expander.reach() as i64);
            let sources: Vec<(f64, f64)> = (0..300)
                .map(|j| (30.0 * (0.618_034 * f64::from(j)).fract(), 1.0 + f64::from(j).sin()))
                .collect();
            let total: f64 = sources.iter().map(|(_, weight)| weight.abs()).sum();
            let mut density = Density::new(h);
            sources.iter().for_each(|(x, weight)| density.add(*x, *weight));
            let mut cells = vec![0.0; 2 * expander.reach() + 1];
            let mut worst = [0.0_f64; TERMS];
            for cell in (-80_i64..280).step_by(7) {
                density.copy_window(cell - reach, &mut cells);
                let mut found = [0.0; TERMS];
                expander.add(&cells, &mut found);
                let mut wanted = [0.0; TERMS];
                for (x, weight) in &sources {
                    let terms = gaussian(cell as f64 * h - x);
                    for n in 0..TERMS {
                        wanted[n] += weight * terms[n] * h.powi(n as i32);
                    }
                }
                for n in 0..TERMS {
                    worst[n] = worst[n].max((found[n] - wanted[n]).abs());
                }
            }
            // What each term adds to the sum two widths away: 6e-13 and 3e-13.
            let errors = (0..TERMS).map(|n| worst[n] * (2.0 / h).powi(n as i32) / total);
            let most = errors.fold(0.0, f64::max);
            assert!(most < 1e-12, "{most:e}");
        }
    }
}
