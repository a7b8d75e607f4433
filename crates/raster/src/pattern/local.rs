//! The local amplitude and phase of the ripple.

use super::estimate::Estimate;
use super::sheet::{Sheet, cut, participating, quarters};
use super::wave::Wave;
use ndarray::{Array2, ArrayView2};
use num_complex::Complex64;
use rayon::prelude::*;
use std::f64::consts::TAU;

/// ψ(x, n): u e^{-i(qx + κy)} averaged over about a wavelength along the line.
pub(super) struct Local {
    psi: Array2<Complex64>,
    wave: Wave,
    spacing: f64,
    pitch: f64,
}

/// Effective extent of a wave within the windows of an area: along the lines, and across them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Extent {
    pub(super) along: f64,
    pub(super) across: f64,
}

/// Standard deviation of the average, in wavelengths along the line; it is limited so that the average covers at most
/// half of the line.
const AVERAGED: f64 = 0.6;
/// Cutoff of the average, in standard deviations.
const ENDS: f64 = 3.5;
/// Magnitude of ψ relative to its mean below which its phase is undetermined.
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
        let inside = columns.saturating_sub(2 * reach);
        let total: f64 = weights.iter().sum();
        let mut psi = Array2::zeros((rows, inside));
        let cells = psi.as_slice_mut().unwrap_or_default();
        cells.par_chunks_mut(inside.max(1)).enumerate().for_each(|(n, psi)| {
            let turned = |(i, u): (usize, &f64)| {
                let (x, y) = (sheet.from + sheet.spacing * i as f64, sheet.pitch * n as f64);
                u * Complex64::from_polar(1.0, -(wave.q * x + wave.kappa * y))
            };
            let turned: Vec<Complex64> = sheet.u.row(n).iter().enumerate().map(turned).collect();
            for (psi, near) in psi.iter_mut().zip(turned.windows(weights.len())) {
                let values = near.iter().zip(&weights).map(|(value, weight)| value * weight);
                *psi = values.sum::<Complex64>() / total;
            }
        });
        Self { psi, wave: *wave, spacing: sheet.spacing, pitch: sheet.pitch }
    }

    /// |Σ ψ_n* ψ_{n+m}| / √(Σ|ψ_n|² Σ|ψ_{n+m}|²) over all pairs of lines at the distance m, with its error.
    pub(super) fn coherence(&self, after: usize) -> Estimate {
        let of = |(value, _): (f64, f64)| value;
        let quarters = self.quarters().map(|quarter| coherence(&quarter, after));
        Estimate::of_quarters(of(coherence(&self.psi.view(), after)), &quarters)
    }

    /// As [`Self::coherence`], for pairs of points at this distance along the lines.
    pub(super) fn coherence_along(&self, after: usize) -> Estimate {
        let quarters = self.quarters().map(|quarter| coherence(&quarter.t(), after));
        Estimate::of_quarters(coherence(&self.psi.t(), after).0, &quarters)
    }

    fn quarters(&self) -> [ArrayView2<'_, Complex64>; 4] {
        let (rows, columns) = self.psi.dim();
        quarters(rows, columns).map(|(rows, columns)| cut(self.psi.view(), rows, columns))
    }

    /// The wave in each quarter, from the gradient of the local phase, with its power there.
    pub(super) fn waves(&self) -> [Wave; 4] {
        let turn = |pairs: (ArrayView2<Complex64>, ArrayView2<Complex64>)| -> f64 {
            pairs.0.iter().zip(pairs.1).map(|(a, b)| a.conj() * b).sum::<Complex64>().arg()
        };
        self.quarters().map(|quarter| {
            let (rows, columns) = quarter.dim();
            let (row, column) = (rows.saturating_sub(1), columns.saturating_sub(1));
            let along = (
                cut(quarter, 0..rows, 0..column),
                cut(quarter, 0..rows, columns - column..columns),
            );
            let across =
                (cut(quarter, 0..row, 0..columns), cut(quarter, rows - row..rows, 0..columns));
            Wave {
                q: self.wave.q + turn(along) / self.spacing,
                kappa: self.wave.kappa + turn(across) / self.pitch,
                power: quarter.iter().map(Complex64::norm_sqr).sum(),
            }
        })
    }

    /// The extent of a wave; a uniform wave has the extent of the area.
    pub(super) fn extent(&self, sheet: &Sheet) -> Extent {
        let (rows, columns) = self.psi.dim();
        let trimmed = (sheet.u.ncols() - columns) / 2;
        let mut powers = (vec![0.0; columns], vec![0.0; rows]);
        for ((n, i), psi) in self.psi.indexed_iter() {
            powers.0[i] += psi.norm_sqr();
            powers.1[n] += psi.norm_sqr();
        }
        let part = |powers: &[f64], window: &[f64]| {
            let even: Vec<f64> = window.iter().map(|w| w * w).collect();
            let seen: Vec<f64> = powers.iter().zip(&even).map(|(power, w)| power * w).collect();
            (participating(&seen) / participating(&even)).clamp(f64::MIN_POSITIVE, 1.0)
        };
        let (along, across) = (&sheet.windows.0[trimmed..trimmed + columns], &sheet.windows.1);
        Extent {
            along: sheet.spacing * sheet.u.ncols() as f64 * part(&powers.0, along),
            across: sheet.pitch * rows as f64 * part(&powers.1, across),
        }
    }

    /// Root mean square of ψ in the first, the middle and the last third of the length of the lines.
    pub(super) fn thirds(&self) -> [f64; 3] {
        let (rows, columns) = self.psi.dim();
        let third = columns / 3;
        [0..third, third..columns - third, columns - third..columns].map(|part| {
            let count = (rows * part.len()).max(1) as f64;
            let psi = cut(self.psi.view(), 0..rows, part);
            (psi.iter().map(Complex64::norm_sqr).sum::<f64>() / count).sqrt()
        })
    }

    /// Number of cells around which the phase turns once.
    pub(super) fn defects(&self) -> usize {
        let (rows, columns) = self.psi.dim();
        let mean =
            self.psi.iter().map(|psi| psi.norm()).sum::<f64>() / self.psi.len().max(1) as f64;
        let turns = |n: usize, i: usize| {
            let corners = [(n, i), (n, i + 1), (n + 1, i + 1), (n + 1, i)].map(|at| self.psi[at]);
            // In a flat stretch the phase is that of round-off.
            if corners.iter().all(|psi| psi.norm() < WEAK * mean) {
                return false;
            }
            let turn: f64 = (0..4).map(|k| (corners[k].conj() * corners[(k + 1) % 4]).arg()).sum();
            turn.abs() > 3.0
        };
        let in_row = |n: usize| (1..columns).filter(|i| turns(n - 1, i - 1)).count();
        (1..rows).into_par_iter().map(in_row).sum()
    }
}

/// The coherence of lines at the distance `after`, and their power.
fn coherence(psi: &ArrayView2<Complex64>, after: usize) -> (f64, f64) {
    let (rows, columns) = psi.dim();
    let pairs = rows.saturating_sub(after);
    let (before, after) =
        (cut(*psi, 0..pairs, 0..columns), cut(*psi, rows - pairs..rows, 0..columns));
    let product: Complex64 = before.iter().zip(&after).map(|(a, b)| a.conj() * b).sum();
    let squares = [before, after].map(|half| half.iter().map(Complex64::norm_sqr).sum::<f64>());
    let all = (squares[0] * squares[1]).sqrt();
    if all > 0.0 { (product.norm() / all, all) } else { (0.0, 0.0) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sheet(u: impl Fn(f64, f64) -> f64) -> Sheet {
        let heights = Array2::from_shape_fn((60, 240), |(n, i)| u(0.25 * i as f64, 0.5 * n as f64));
        Sheet::new(heights, (0.0, 0.25), 0.5, 8.7)
    }

    /// q and κ of a given wave with a harmonic are recovered.
    #[test]
    fn a_wave_is_found() {
        let (q, kappa) = (0.937, -0.871);
        let phase = move |x: f64, y: f64| q * x + kappa * y + 0.3;
        let sheet = sheet(|x, y| {
            0.7 * phase(x, y).cos() + 0.2 * (2.0 * phase(x, y)).cos() - 3.0 + 0.01 * x
        });
        let wave = Wave::strongest(&sheet, 2.0)[0];
        assert!((wave.q - q).abs() < 2e-4 && (wave.kappa - kappa).abs() < 4e-4, "{wave:?}");
        let local = Local::of(&sheet, &wave);
        assert!(local.coherence(1).value > 0.999, "{:?}", local.coherence(1));
        assert_eq!(local.defects(), 0);
        assert!(sheet.straightness() > 0.99, "{}", sheet.straightness());
    }

    /// Two waves form a lattice of pits, and unrelated lines are no pattern.
    #[test]
    fn pits_and_disorder_are_told_from_ripples() {
        let pits = sheet(|x, y| (0.9 * x + 0.9 * y).cos() + 0.9 * (0.9 * x - 0.9 * y).cos());
        assert!(pits.straightness() < 0.3, "{}", pits.straightness());
        let chaos = sheet(|x, y| (0.9 * x + 40.0 * (7.3 * y).sin()).cos());
        let wave = Wave::strongest(&chaos, 2.0)[0];
        let coherence = Local::of(&chaos, &wave).coherence(1).value;
        assert!(coherence < 0.7, "{coherence}");
    }

    /// A crest that ends: e^{iφ} around (x, y) = (30, 15) counts as a defect.
    #[test]
    fn a_defect_is_counted() {
        let sheet = sheet(|x, y| (0.9 * x + 0.6 * y + (y - 15.1).atan2(x - 30.1)).cos());
        let wave = Wave { q: 0.9, kappa: 0.6, power: 1.0 };
        assert_eq!(Local::of(&sheet, &wave).defects(), 1);
    }
}
