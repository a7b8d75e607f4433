//! Effect of the noise of a raw table on its results.
//!
//! αc depends on f'' and therefore on the noise of neighbouring rows divided by their distance squared: 2 % of noise
//! can halve αc. The size of the noise is estimated from sixth differences, in which a smooth f nearly vanishes; its
//! effect, by adding as much noise again, and by αc of a fit with few Gaussians.

use crate::Profile;
use crate::tip::{Request, tip};
use chacha20::ChaCha8Rng;
use chacha20::rand_core::SeedableRng;
use rand::RngExt;
use std::f64::consts::PI;
use stickslip_stability::critical;
use stickslip_tip::{TipFunction, Wider};

/// Quality of a raw table x, f.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Verdict {
    /// The effect of noise is negligible.
    Sound,
    /// Too few rows to separate noise from shape.
    Few {
        /// Number of rows.
        rows: usize,
    },
    /// Noise changes αc noticeably.
    Felt {
        /// Estimated relative error of αc at r = 1.
        change: f64,
    },
    /// Noise, and not the footprint, determines αc.
    Decided {
        /// αc of the table, at r = 1.
        table: f64,
        /// αc of a fit with few Gaussians, at r = 1, if there is a fit.
        fitted: Option<f64>,
    },
}

/// Smallest number of rows for sixth differences.
const FEWEST_ROWS: usize = 16;
/// Relative change of αc at r = 1 that is reported, and the one above which a table is rejected.
const TOLD: f64 = 0.02;
const REFUSED: f64 = 0.1;
/// Bound on the relative change of αc below which the effect of noise is not computed.
const NOT_TOLD: f64 = 0.1 * TOLD;
/// Largest value of a sum over many random rows, in standard deviations.
const LARGEST_DRAW: f64 = 5.0;
/// Number of repetitions with added noise.
const DRAWS: u64 = 5;
/// Binomial coefficients of a sixth difference, and the root of the sum of their squares.
const SIXTH: [f64; 7] = [1.0, -6.0, 15.0, -20.0, 15.0, -6.0, 1.0];
const SIXTH_NORM: f64 = 30.397;

/// Classifies the table from which `tip` was made.
pub fn judge((x, f): (&[f64], &[f64]), tip: &TipFunction) -> Verdict {
    let rows = x.len();
    let Ok(at) = critical(&Wider::default(), tip, 1.0) else { return Verdict::Sound };
    if rows < FEWEST_ROWS {
        return Verdict::Few { rows };
    }
    let table = at.alpha;
    let noise = noise(f);
    if table * most_felt(x, noise, tip.band()) < NOT_TOLD {
        return Verdict::Sound;
    }
    let again = again((x, f), noise, table);
    let fitted = fitted((x, f));
    let off = fitted.map_or(0.0, |fitted| (table / fitted).ln().abs());
    let change = again.max(off);
    match change {
        change if change > REFUSED => Verdict::Decided { table, fitted },
        change if change > TOLD => Verdict::Felt { change },
        _ => Verdict::Sound,
    }
}

/// αc, at r = 1, of a sum of Gaussians through the rows.
fn fitted((x, f): (&[f64], &[f64])) -> Option<f64> {
    let profile = Profile::new(x.to_vec(), f.to_vec()).ok()?;
    let (centre, sigma) = (Some(0.0), Some(1.0));
    let found =
        tip(&profile, &Request { centre, sigma, resamples: 0, ..Request::default() }).ok()?;
    // α refers to f(0) = 1.
    (found.apex > 0.0).then(|| found.critical_alpha.value / found.apex)
}

/// Root mean square of the relative change of αc, at r = 1, with noise like that of the table added.
fn again((x, f): (&[f64], &[f64]), noise: f64, table: f64) -> f64 {
    let changes = (0..DRAWS).map(|draw| {
        let mut random = ChaCha8Rng::seed_from_u64(draw);
        let last = f.len() - 1;
        // Variance 1/3 on [-1, 1]; the end where f has faded stays.
        let amplitude = 3_f64.sqrt() * noise;
        let mut more =
            |i: usize| if i < last { amplitude * random.random_range(-1.0..=1.0) } else { 0.0 };
        let noisy: Vec<f64> = f.iter().enumerate().map(|(i, f)| f + more(i)).collect();
        let tip = TipFunction::table(x, &noisy).ok();
        let changed = tip.and_then(|tip| critical(&Wider::default(), &tip, 1.0).ok());
        // Noise that leaves no footprint changes all.
        changed.map_or(1.0, |changed| (changed.alpha / table).ln().abs())
    });
    let squares: Vec<f64> = changes.map(|change| change * change).collect();
    (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
}

/// Bound on the contribution of noise to ∫f''(y) e^{-iqy}dy, to which 1/αc is proportional at r = 1, for any wave number
/// q that the rows and the footprint resolve: q² times the transform of the noise, a sum over random rows, plus q times
/// its value at 0.
fn most_felt(x: &[f64], noise: f64, band: f64) -> f64 {
    let length = x[x.len() - 1];
    let spacing = length / (x.len() - 1) as f64;
    let q = band.min(PI / spacing);
    LARGEST_DRAW * noise * (q * q * (spacing * length).sqrt() + q)
}

/// Standard deviation of the noise from row to row.
fn noise(f: &[f64]) -> f64 {
    let difference = |rows: &[f64]| rows.iter().zip(SIXTH).map(|(f, c)| f * c).sum::<f64>();
    let squares: Vec<f64> = f.windows(7).map(|rows| difference(rows).powi(2)).collect();
    (squares.iter().sum::<f64>() / squares.len() as f64).sqrt() / SIXTH_NORM
}

#[cfg(test)]
#[path = "../tests/measurement/noisy_table.rs"]
mod noisy_table;

#[cfg(test)]
mod tests {
    use super::noisy_table::table;
    use super::*;

    /// If the bound excludes an effect of noise, there is none: neither in rows of all digits nor in rounded ones.
    #[test]
    fn noise_that_is_not_tried_changes_nothing() {
        let exact = |rows| table(rows, 0.0, 3);
        let noisy = |rows, noise: f64| (exact(rows), table(rows, noise, 3).1, noise / 3_f64.sqrt());
        let rounded = |rows, unit: f64| {
            let of_exact = exact(rows).1.iter().map(|f| (f / unit).round() * unit).collect();
            (exact(rows), of_exact, unit / 12_f64.sqrt())
        };
        let noisy = [(60, 1e-7), (60, 2e-6), (200, 1e-8), (200, 1e-7), (600, 1e-9)]
            .map(|(rows, n)| noisy(rows, n));
        let rounded =
            [(60, 1e-6), (600, 1e-5), (1500, 1e-6)].map(|(rows, unit)| rounded(rows, unit));
        for ((x, exact), felt, noise) in noisy.into_iter().chain(rounded) {
            let of = |f: &[f64]| TipFunction::table(&x, f).unwrap();
            let alpha = |f: &[f64]| critical(&Wider::default(), &of(f), 1.0).unwrap().alpha;
            let change = (alpha(&felt) / alpha(&exact) - 1.0).abs();
            let bound = alpha(&exact) * most_felt(&x, noise, of(&felt).band());
            assert!(change < bound, "{} {noise}: {change} above {bound}", x.len());
            assert!(bound < 1.0, "{} {noise}: {bound}", x.len());
        }
    }
}
