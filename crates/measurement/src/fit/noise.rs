//! Noise with correlated neighbouring rows, as an autoregressive process.
//!
//! ```text
//!     e_i + a_1 e_(i-1) + … + a_p e_(i-p) = w_i,   w white
//! ```
//!
//! Burg's (1967) method estimates the coefficients; Akaike's criterion, corrected for few rows (Hurvich and Tsai
//! 1989), selects p. Lags are counted in rows, not in positions, because instruments sample at even times.

use std::ops::Range;

/// Covariance matrix of the rows of one track.
#[derive(Debug, Clone)]
pub(super) struct Noise {
    /// γ(0), γ(1), …, truncated where they are negligible.
    covariances: Vec<f64>,
    /// Ranges of rows for each line of the track; different lines are uncorrelated.
    lines: Vec<Range<usize>>,
}

/// Largest order.
const MOST: usize = 20;
/// Smallest decrease of the criterion at which rows count as correlated.
const GAIN: f64 = 6.0;
/// Covariances below this fraction of the variance, for as many lags as the order, are omitted.
const NOTHING: f64 = 1e-3;

impl Noise {
    /// The noise from residuals of a regression on periodic columns: `removed` parameters were fitted, out of the
    /// `within` degrees of freedom at the wave numbers of the columns. The estimated spectrum is raised to compensate for
    /// the regression.
    pub(super) fn of(
        residuals: &[f64],
        lines: &[Range<usize>],
        (removed, within): (usize, usize),
    ) -> Self {
        let rows = residuals.len() as f64;
        let longest = lines.iter().map(Range::len).max().unwrap_or(1);
        let mut reflections = reflections(residuals, lines);
        // Neighbours that seem to alternate would make waves quieter than independent rows are: that is taken for chance.
        let found = covariances(&reflections, 1.0, longest);
        if found[1..].iter().sum::<f64>() <= 0.0 {
            reflections.clear();
        }
        let order = reflections.len();
        let freedom = (rows - (removed + order) as f64).max(1.0);
        let whole = 1.0 - removed as f64 / rows;
        let band = 1.0 - removed.min(within) as f64 / (within.max(removed) + 1) as f64;
        let raised = if order > 0 { (whole / band).max(1.0) } else { 1.0 };
        let square = residuals.iter().map(|r| r * r).sum::<f64>() / freedom * raised;
        Self { covariances: covariances(&reflections, square, longest), lines: lines.to_vec() }
    }

    /// White noise of this variance.
    pub(super) fn white(rows: usize, variance: f64) -> Self {
        Self { covariances: vec![variance], lines: one_line(rows) }
    }

    /// The noise plus an independent error of this variance in every row.
    pub(super) fn and(mut self, variance: f64) -> Self {
        self.covariances[0] += variance;
        self
    }

    /// Whether rows are independent.
    pub(super) fn is_white(&self) -> bool {
        self.covariances.len() == 1
    }

    /// Standard deviation of a row.
    pub(super) fn deviation(&self) -> f64 {
        self.covariances[0].max(0.0).sqrt()
    }

    /// Number of independent rows with the same error of the mean: n over the integral correlation length.
    pub(super) fn effective(&self) -> f64 {
        let rows = self.lines.iter().map(Range::len).sum::<usize>() as f64;
        let sum: f64 = self.covariances[1..].iter().sum();
        let length = (1.0 + 2.0 * sum / self.covariances[0].max(f64::MIN_POSITIVE)).max(1.0);
        (rows / length).clamp(1.0, rows)
    }

    /// The product of the covariance matrix with `v`.
    pub(super) fn times(&self, v: &[f64]) -> Vec<f64> {
        let mut product: Vec<f64> = v.iter().map(|v| self.covariances[0] * v).collect();
        for line in &self.lines {
            let (from, to) = (&v[line.clone()], &mut product[line.clone()]);
            for (lag, covariance) in self.covariances.iter().enumerate().skip(1) {
                for i in lag..from.len() {
                    to[i] += covariance * from[i - lag];
                    to[i - lag] += covariance * from[i];
                }
            }
        }
        product
    }
}

/// A single line that contains all rows.
pub(super) fn one_line(rows: usize) -> Vec<Range<usize>> {
    std::iter::once(0..rows).collect()
}

/// Burg's reflection coefficients of the order selected by the criterion.
fn reflections(residuals: &[f64], lines: &[Range<usize>]) -> Vec<f64> {
    let rows = residuals.len() as f64;
    let mut forward: Vec<Vec<f64>> = lines.iter().map(|l| residuals[l.clone()].to_vec()).collect();
    let mut backward = forward.clone();
    let mut square = residuals.iter().map(|r| r * r).sum::<f64>() / rows.max(1.0);
    if square <= f64::MIN_POSITIVE {
        return vec![];
    }
    let criterion = |square: f64, order: usize| {
        let numbers = order as f64 + 1.0;
        rows * square.ln() + 2.0 * numbers * rows / (rows - numbers - 1.0).max(1.0)
    };
    let mut best = (criterion(square, 0) - GAIN, 0);
    let most = MOST.min(residuals.len() / (10 * lines.len().max(1)));
    let mut found = vec![];
    for order in 1..=most {
        let (mut along, mut sizes) = (0.0, 0.0);
        for (f, b) in forward.iter().zip(&backward).filter(|(f, _)| f.len() > 1) {
            for (f, b) in f[1..].iter().zip(b) {
                along += f * b;
                sizes += f * f + b * b;
            }
        }
        let k = if sizes > 0.0 { -2.0 * along / sizes } else { 0.0 };
        for (f, b) in forward.iter_mut().zip(&mut backward) {
            let last = f.len().saturating_sub(1);
            let (ahead, behind) = (f[f.len() - last..].to_vec(), b[..last].to_vec());
            *f = ahead.iter().zip(&behind).map(|(f, b)| f + k * b).collect();
            *b = ahead.iter().zip(&behind).map(|(f, b)| b + k * f).collect();
        }
        square *= 1.0 - k * k;
        found.push(k);
        if square <= 0.0 || square.is_nan() {
            break;
        }
        let here = criterion(square, order);
        if here < best.0 {
            best = (here, order);
        }
    }
    found.truncate(best.1);
    found
}

/// Autocovariances of a process with these reflection coefficients, by Levinson's recursion.
fn covariances(reflections: &[f64], variance: f64, longest: usize) -> Vec<f64> {
    let mut found = vec![variance];
    let (mut coefficients, mut square): (Vec<f64>, f64) = (vec![], variance);
    let next = |coefficients: &[f64], found: &[f64]| -> f64 {
        -coefficients.iter().zip(found.iter().rev()).map(|(a, g)| a * g).sum::<f64>()
    };
    for k in reflections {
        found.push(next(&coefficients, &found) - k * square);
        let turned: Vec<f64> = coefficients.iter().rev().copied().collect();
        coefficients.iter_mut().zip(turned).for_each(|(a, b)| *a += k * b);
        coefficients.push(*k);
        square *= 1.0 - k * k;
    }
    let mut small = 0;
    while found.len() < longest && small <= reflections.len() {
        let value = next(&coefficients, &found);
        small = if value.abs() < NOTHING * variance { small + 1 } else { 0 };
        found.push(value);
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    fn random(seed: u32) -> impl FnMut() -> f64 {
        let mut state = seed;
        move || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            12_f64.sqrt() * (f64::from(state >> 8) / f64::from(1 << 24) - 0.5)
        }
    }

    /// For e_i = ρ e_(i-1) + w_i: γ(h) = ρ^h/(1 - ρ²), and n rows have the information of n (1 - ρ)/(1 + ρ)
    /// independent ones.
    #[test]
    fn a_process_of_first_order_is_recovered() {
        let (rho, rows) = (0.8_f64, 20_000);
        let mut random = random(5);
        let mut last = 0.0;
        let noise: Vec<f64> = (0..rows)
            .map(|_| {
                last = rho * last + random();
                last
            })
            .collect();
        let found = Noise::of(&noise, &one_line(rows), (0, 0));
        for (lag, covariance) in found.covariances.iter().take(8).enumerate() {
            let truth = rho.powi(lag as i32) / (1.0 - rho * rho);
            assert!((covariance / truth - 1.0).abs() < 0.15, "{lag}: {covariance} for {truth}");
        }
        let share = found.effective() / rows as f64;
        assert!((share * 9.0 - 1.0).abs() < 0.25, "{share}");
        let mut unit = vec![0.0; 50];
        unit[20] = 1.0;
        let column = Noise { lines: vec![0..25, 25..50], ..found.clone() }.times(&unit);
        assert!((column[17] - found.covariances[3]).abs() < 1e-12 && column[25].abs() < 1e-12);
    }

    #[test]
    fn white_noise_stays_white() {
        let mut random = random(9);
        let noise: Vec<f64> = (0..500).map(|_| random()).collect();
        let found = Noise::of(&noise, &one_line(500), (0, 0));
        assert!(found.effective() > 380.0, "{}", found.effective());
        assert!((found.deviation() - 1.0).abs() < 0.1);
    }
}
