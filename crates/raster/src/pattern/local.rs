//! The ripple as it is from place to place.

use super::wave::{Sheet, Wave};
use ndarray::Array2;
use num_complex::Complex64;
use std::f64::consts::TAU;

/// ψ(x, n): u e^{-i(qx + κy)} averaged over a wavelength or so along the line.
pub(super) struct Local(Array2<Complex64>);

/// Standard deviation of the average, in wavelengths along the line, and at most such that the average takes half of the line; it ends at so
/// many of them.
const AVERAGED: f64 = 0.6;
const ENDS: f64 = 3.5;
/// ψ below this part of its mean is too weak for a phase.
const WEAK: f64 = 0.02;

impl Local {
    pub(super) fn of(sheet: &Sheet, wave: &Wave) -> Self {
        let most = sheet.u.ncols() as f64 / 4.0 / ENDS;
        let deviation = (AVERAGED * TAU / wave.q / sheet.spacing).min(most);
        let reach = (ENDS * deviation).ceil() as usize;
        let weight = |i: usize| {
            let z = (i as f64 - reach as f64) / deviation;
            (-0.5 * z * z).exp()
        };
        let weights: Vec<f64> = (0..=2 * reach).map(weight).collect();
        let (rows, columns) = sheet.u.dim();
        let demodulated = Array2::from_shape_fn((rows, columns), |(n, i)| {
            let (x, y) = (sheet.from + sheet.spacing * i as f64, sheet.pitch * n as f64);
            sheet.u[(n, i)] * Complex64::from_polar(1.0, -(wave.q * x + wave.kappa * y))
        });
        let inside = columns.saturating_sub(2 * reach);
        Self(Array2::from_shape_fn((rows, inside), |(n, i)| {
            let values = (0..weights.len()).map(|j| demodulated[(n, i + j)] * weights[j]);
            values.sum::<Complex64>() / weights.iter().sum::<f64>()
        }))
    }

    /// |Σ ψ_n* ψ_{n+m}| / √(Σ|ψ_n|² Σ|ψ_{n+m}|²), of every line with that m after it.
    pub(super) fn coherence(&self, after: usize) -> f64 {
        let (rows, columns) = self.0.dim();
        let mut product = Complex64::default();
        let mut squares = [0.0, 0.0];
        for n in after..rows {
            for i in 0..columns {
                let (before, after) = (self.0[(n - after, i)], self.0[(n, i)]);
                product += before.conj() * after;
                squares[0] += before.norm_sqr();
                squares[1] += after.norm_sqr();
            }
        }
        let all = (squares[0] * squares[1]).sqrt();
        if all > 0.0 { product.norm() / all } else { 0.0 }
    }

    /// Meshes around which the phase turns.
    pub(super) fn defects(&self) -> usize {
        let (rows, columns) = self.0.dim();
        let mean = self.0.iter().map(|psi| psi.norm()).sum::<f64>() / self.0.len().max(1) as f64;
        let turns = |n: usize, i: usize| {
            let corners = [(n, i), (n, i + 1), (n + 1, i + 1), (n + 1, i)].map(|at| self.0[at]);
            // In a flat stretch the phase is that of round-off.
            if corners.iter().all(|psi| psi.norm() < WEAK * mean) {
                return false;
            }
            let turn: f64 = (0..4).map(|k| (corners[k].conj() * corners[(k + 1) % 4]).arg()).sum();
            turn.abs() > 3.0
        };
        let meshes = (1..rows).flat_map(|n| (1..columns).map(move |i| (n - 1, i - 1)));
        meshes.filter(|(n, i)| turns(*n, *i)).count()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sheet(u: impl Fn(f64, f64) -> f64) -> Sheet {
        let heights = Array2::from_shape_fn((60, 240), |(n, i)| u(0.25 * i as f64, 0.5 * n as f64));
        Sheet::new(heights, (0.0, 0.25), 0.5, 8.7)
    }

    /// q and κ of a wave that is put in are found again, with its harmonic beside it.
    #[test]
    fn a_wave_is_found() {
        let (q, kappa) = (0.937, -0.871);
        let phase = move |x: f64, y: f64| q * x + kappa * y + 0.3;
        let sheet = sheet(|x, y| {
            0.7 * phase(x, y).cos() + 0.2 * (2.0 * phase(x, y)).cos() - 3.0 + 0.01 * x
        });
        let wave = Wave::of_ripples(&sheet).unwrap();
        assert!((wave.q - q).abs() < 2e-4 && (wave.kappa - kappa).abs() < 4e-4, "{wave:?}");
        let local = Local::of(&sheet, &wave);
        assert!(local.coherence(1) > 0.999, "{}", local.coherence(1));
        assert_eq!(local.defects(), 0);
        assert!(sheet.straightness() > 0.99, "{}", sheet.straightness());
    }

    /// Two waves are a lattice of pits, and lines that have nothing to do with each other are no pattern.
    #[test]
    fn pits_and_disorder_are_told_from_ripples() {
        let pits = sheet(|x, y| (0.9 * x + 0.9 * y).cos() + 0.9 * (0.9 * x - 0.9 * y).cos());
        assert!(pits.straightness() < 0.3, "{}", pits.straightness());
        let chaos = sheet(|x, y| (0.9 * x + 40.0 * (7.3 * y).sin()).cos());
        let wave = Wave::of_ripples(&chaos).unwrap();
        let coherence = Local::of(&chaos, &wave).coherence(1);
        assert!(coherence < 0.7, "{coherence}");
    }

    /// A crest that ends: e^{iφ} around (x, y) = (30, 15).
    #[test]
    fn a_defect_is_counted() {
        let sheet = sheet(|x, y| (0.9 * x + 0.6 * y + (y - 15.1).atan2(x - 30.1)).cos());
        let wave = Wave { q: 0.9, kappa: 0.6, power: 1.0 };
        assert_eq!(Local::of(&sheet, &wave).defects(), 1);
    }
}
