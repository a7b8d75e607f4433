//! Is what a fit leaves noise? What a wrong model leaves repeats itself with the ripples.

use super::data::Track;
use crate::least_squares::squares;
use crate::projection::project;
use std::f64::consts::TAU;

/// Harmonics of the wavelength that are looked for in what is left.
const HARMONICS: usize = 6;

/// How many standard deviations the harmonics of a wavelength in what is left of a track are above what noise has,
/// by Wilson and Hilferty's normal form of χ².
pub(super) fn of_track(track: &Track, residuals: &[f64], length: f64) -> f64 {
    let x = &track.x;
    let mut columns = vec![];
    for k in 1..=HARMONICS {
        let turns = TAU * k as f64 / length;
        let (sin, cos): (Vec<f64>, Vec<f64>) = x.iter().map(|x| (turns * x).sin_cos()).unzip();
        columns.extend([cos, sin]);
    }
    let count = columns.len() as f64;
    let before = squares(residuals);
    let Some(left) = project(&columns, &residuals[..x.len()]) else { return 0.0 };
    let after = squares(&left.residuals) + squares(&residuals[x.len()..]);
    let freedom = (residuals.len() as f64 - count).max(1.0);
    let told = (before - after) / (after / freedom);
    let spread = 2.0 / (9.0 * count);
    ((told / count).max(0.0).cbrt() - (1.0 - spread)) / spread.sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_harmonic_that_is_left_is_seen_and_noise_is_not() {
        let x: Vec<f64> = (0..400).map(|i| 0.1 * f64::from(i)).collect();
        let mut state = 7_u32;
        let mut random = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            f64::from(state) / f64::from(u32::MAX) - 0.5
        };
        let noise: Vec<f64> = x.iter().map(|_| random()).collect();
        let track = Track { x: x.clone(), y: vec![0.0; 400], gain: None };
        assert!(of_track(&track, &noise, 6.3).abs() < 3.0);
        let with: Vec<f64> =
            x.iter().zip(&noise).map(|(x, n)| n + 0.15 * (TAU * 2.0 * x / 6.3).cos()).collect();
        assert!(of_track(&track, &with, 6.3) > 4.0, "{}", of_track(&track, &with, 6.3));
    }
}
