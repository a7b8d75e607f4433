//! 95 % intervals by profile likelihood: the range over which a parameter can be fixed while the residuals, after a new
//! fit of the other parameters, stay below a limit.

use super::parameters::Name;
use super::problem::Problem;
use super::verdict::Verdict;
use crate::interval::{Estimate, crossing};
use crate::least_squares::{Minimum, matrix_of, minimum, squares};
use nalgebra::DMatrix;
use statrs::distribution::{ContinuousCDF, StudentsT};
use stickslip_tip::sorting::sort_by_number;
use stickslip_tip::symmetric_eigen;

/// A fitted parameter.
#[derive(Debug, Clone, PartialEq)]
pub struct Fitted {
    /// The parameter.
    pub name: Name,
    /// Estimate with interval; ends that the data do not exclude are 0 or infinite.
    pub estimate: Estimate,
    /// The profile likelihood: values at which the parameter was held, each with ±√(n (S/S0 - 1))/c. S is the least sum
    /// of squares at this value, and S0 that of the best fit; n is the number of degrees of freedom. Correlations widen
    /// the interval by the factor c.
    pub profile: Vec<(f64, f64)>,
}

/// Another minimum that the data hardly exclude.
pub(super) struct Rival {
    /// Excess of the sum of squares over the best, in units of the variance of the noise.
    pub(super) behind: f64,
    /// Logarithms of the parameters.
    pub(super) at: Vec<f64>,
    /// Standard deviations of the parameters for independent rows.
    pub(super) deviations: Vec<f64>,
}

/// Largest factor between a parameter and its best value in a profile.
const FARTHEST: f64 = 20.0;
/// The same factor for a parameter of the extended model with little effect at its best value.
const FARTHEST_OF_A_LAW: f64 = 1e5;

/// The best fit, and its neighbourhood.
pub(super) struct Around<'a> {
    pub(super) problem: &'a Problem<'a>,
    pub(super) best: &'a Minimum,
    /// Derivatives of the residuals by the searched parameters.
    pub(super) slopes: Vec<Vec<f64>>,
    /// Covariance of the searched parameters for independent rows with the variance of the residuals.
    independent: DMatrix<f64>,
    /// Covariance of the same parameters with the estimated noise.
    pub(super) covariance: DMatrix<f64>,
    /// Degrees of freedom: rows minus parameters.
    pub(super) freedom: f64,
    /// Half of a 95 % interval, in standard deviations.
    quantile: f64,
    /// Mean squares of the change of each logarithm over other possible footprints.
    moved: Vec<f64>,
    /// Other minima that the data hardly exclude.
    rivals: Vec<Rival>,
}

impl<'a> Around<'a> {
    /// The neighbourhood of a minimum; `None` if a derivative is not finite.
    pub(super) fn of(problem: &'a Problem, best: &'a Minimum) -> Option<Self> {
        let slopes = problem.slopes(&best.residuals, &best.parameters)?;
        let jacobian = matrix_of(slopes.clone());
        let mut normal = jacobian.tr_mul(&jacobian);
        // What no datum feels has no variance to speak of, and a huge one in numbers.
        let largest = normal.diagonal().max();
        for i in 0..normal.nrows() {
            normal[(i, i)] += 1e-14 * largest;
        }
        let freedom = (problem.rows() as f64 - problem.parameters() as f64).max(1.0);
        let independent = normal.lu().try_inverse()? * (best.sum / freedom);
        Some(Self {
            problem,
            best,
            slopes,
            covariance: independent.clone(),
            independent,
            freedom,
            quantile: quantile(freedom),
            moved: vec![0.0; problem.free.len()],
            rivals: vec![],
        })
    }

    /// Adds the estimated noise: (J'J)⁻¹ J'ΣJ (J'J)⁻¹, the covariance of least squares that ignore correlations.
    pub(super) fn judged(mut self, verdict: &Verdict) -> Self {
        let square = self.best.sum / self.freedom;
        let inverse = &self.independent / square.max(f64::MIN_POSITIVE);
        self.covariance = &inverse * verdict.between(&self.slopes) * &inverse;
        self.quantile = quantile(verdict.freedom.min(self.freedom));
        self
    }

    /// Adds the error of a measured footprint, from fits with other possible footprints.
    pub(super) fn with_footprints(mut self, fitted: &[Minimum]) -> Self {
        if fitted.is_empty() {
            return self;
        }
        for (i, moved) in self.moved.iter_mut().enumerate() {
            let off = |found: &Minimum| (found.parameters[i] - self.best.parameters[i]).powi(2);
            *moved = fitted.iter().map(off).sum::<f64>() / fitted.len() as f64;
        }
        self
    }

    /// Factor by which correlations of the noise change the standard deviation of this parameter.
    fn factor(&self, i: usize) -> f64 {
        let ratio = self.covariance[(i, i)] / self.independent[(i, i)];
        if ratio.is_finite() && ratio > 0.0 { ratio.sqrt() } else { 1.0 }
    }

    /// Excess of the sum of squares at another minimum over the best, in units of the variance of the noise.
    pub(super) fn behind(&self, other: &Minimum) -> f64 {
        let count = self.problem.free.len();
        let square = (0..count).map(|i| self.factor(i).powi(2)).sum::<f64>() / count.max(1) as f64;
        (other.sum / self.best.sum - 1.0) * self.freedom / square
    }

    /// Adds the minima that the data hardly exclude, over which intervals are extended.
    pub(super) fn with_rivals(self, rivals: Vec<Rival>) -> Self {
        Self { rivals, ..self }
    }

    /// Largest excess of a minimum that 95 % intervals include.
    pub(super) fn most(&self) -> f64 {
        self.quantile.powi(2)
    }

    /// Standard deviation of each parameter for independent rows.
    pub(super) fn deviations(&self) -> Vec<f64> {
        (0..self.problem.free.len()).map(|i| self.independent[(i, i)].max(0.0).sqrt()).collect()
    }

    /// Standard deviation of the logarithm of a searched parameter.
    pub(super) fn deviation(&self, i: usize) -> f64 {
        self.covariance[(i, i)].max(0.0).sqrt()
    }

    /// Correlations of the parameters.
    pub(super) fn correlations(&self) -> Vec<Vec<f64>> {
        correlations(&self.covariance, self.problem.free.len())
    }

    /// The interval of the i-th parameter.
    pub(super) fn fitted(&self, i: usize) -> Fitted {
        let name = self.problem.free[i];
        let value = self.best.parameters[i].exp();
        let mut profile = vec![(value, 0.0)];
        let mut end = |side: f64| {
            let (end, points) = self.end(i, side);
            profile.extend(
                points.into_iter().map(|(offset, root)| (value * offset.exp(), side * root)),
            );
            end
        };
        let (low, high) = (end(-1.0), end(1.0));
        let (low, high) = (self.farther(i, low, -1.0), self.farther(i, high, 1.0));
        sort_by_number(&mut profile, |item| item.0);
        let estimate = Estimate {
            value,
            low: low.map_or(0.0, |offset| value * offset.exp()),
            high: high.map_or(f64::INFINITY, |offset| value * offset.exp()),
        };
        Fitted { name, estimate, profile }
    }

    /// Largest offset of the logarithm of this parameter in a profile.
    fn farthest(&self, i: usize) -> f64 {
        if self.problem.free[i].is_of_extended_model() { FARTHEST_OF_A_LAW } else { FARTHEST }.ln()
    }

    /// An end of an interval, extended in quadrature by the error of the footprint, and over other minima.
    fn farther(&self, i: usize, end: Option<f64>, side: f64) -> Option<f64> {
        let footprint = quantile(FOOTPRINTS) * self.moved[i].sqrt();
        let mut length = f64::hypot(end?, footprint);
        for Rival { behind, at, deviations } in &self.rivals {
            let left = self.quantile.powi(2) - behind;
            if left > 0.0 {
                let own = left.sqrt() * deviations[i] * self.factor(i);
                let reach = f64::hypot(own, footprint);
                length = length.max(side * (at[i] - self.best.parameters[i]) + reach);
            }
        }
        (length < self.farthest(i)).then_some(side * length)
    }

    /// The parameter without an interval.
    pub(super) fn without_interval(&self, i: usize) -> Fitted {
        let value = self.best.parameters[i].exp();
        let estimate = Estimate { value, low: 0.0, high: f64::INFINITY };
        Fitted { name: self.problem.free[i], estimate, profile: vec![(value, 0.0)] }
    }

    /// The offset at which the residual reaches the limit, and the points on the way there.
    fn end(&self, i: usize, side: f64) -> (Option<f64>, Vec<(f64, f64)>) {
        let most = self.farthest(i);
        let deviation = self.independent[(i, i)].max(0.0).sqrt() * self.factor(i);
        let guess = side * (self.quantile * deviation).clamp(1e-9, most);
        crossing(|offset| self.root(i, offset), self.quantile, (guess, most))
    }

    /// √((S/S0 - 1)(n - p)) with one parameter fixed at an offset of its logarithm, divided by the factor of
    /// correlations.
    fn root(&self, i: usize, offset: f64) -> Option<f64> {
        let problem = self.problem;
        let others = problem.holding(i, (self.best.parameters[i] + offset).exp());
        // Where the others go if all is linear.
        let variance = self.independent[(i, i)].max(f64::MIN_POSITIVE);
        let moved = |(j, at): (usize, &f64)| {
            let along = self.independent[(i, j)] / variance * offset;
            at + along.clamp(-1.0, 1.0)
        };
        let all: Vec<f64> = self.best.parameters.iter().enumerate().map(moved).collect();
        let without = |all: &[f64]| {
            let mut some = all.to_vec();
            some.remove(i);
            some
        };
        let found = minimum(&others, &without(&all))
            .or_else(|| minimum(&others, &without(&self.best.parameters)))?;
        let more = (found.sum / self.best.sum - 1.0).max(0.0);
        Some((more * self.freedom).sqrt() / self.factor(i))
    }
}

/// Degrees of freedom of the mean squares over a few dozen footprints.
const FOOTPRINTS: f64 = 23.0;

/// 97.5 % quantile of Student's distribution, by bisection: `inverse_cdf` may not terminate for many degrees of
/// freedom.
fn quantile(freedom: f64) -> f64 {
    let Ok(law) = StudentsT::new(0.0, 1.0, freedom.clamp(1.0, 1e6)) else { return f64::INFINITY };
    let (mut low, mut high) = (1.9, 13.0);
    for _ in 0..40 {
        let middle = 0.5 * (low + high);
        *(if law.cdf(middle) < 0.975 { &mut low } else { &mut high }) = middle;
    }
    0.5 * (low + high)
}

/// Correlations of the first `count` parameters. Where the data hardly tell parameters apart, round-off makes their
/// covariance unsymmetric and larger than their variances; correlations are symmetric and at most 1 there too.
fn correlations(covariance: &DMatrix<f64>, count: usize) -> Vec<Vec<f64>> {
    let of = |i: usize, j: usize| {
        if i == j {
            return 1.0;
        }
        let mean = 0.5 * (covariance[(i, j)] + covariance[(j, i)]);
        let deviation = |i: usize| covariance[(i, i)].max(0.0).sqrt();
        (mean / (deviation(i) * deviation(j))).clamp(-1.0, 1.0)
    };
    (0..count).map(|i| (0..count).map(|j| of(i, j)).collect()).collect()
}

/// The least determined combination of logarithms: its exponents, the largest being 1, and its standard deviation.
pub(super) fn least_determined(around: &Around) -> Option<(Vec<f64>, f64)> {
    let count = around.problem.free.len();
    let part = around.covariance.view((0, 0), (count, count)).into_owned();
    let found = symmetric_eigen(part)?;
    let i = found.eigenvalues.imax();
    let powers: Vec<f64> = found.eigenvectors.column(i).iter().copied().collect();
    let largest = powers.iter().copied().max_by(|a, b| a.abs().total_cmp(&b.abs()))?;
    let powers = powers.into_iter().map(|p| p / largest).collect();
    Some((powers, found.eigenvalues[i].max(0.0).sqrt()))
}

/// Sum of squares with the weights of the rows removed.
pub(super) fn plain(residuals: &[f64], weights: &[f64]) -> f64 {
    squares(&residuals.iter().zip(weights).map(|(r, w)| r / w.max(1e-6)).collect::<Vec<f64>>())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Comparison with Abramowitz and Stegun, table 26.10.
    #[test]
    fn quantiles_of_student_are_those_of_tables() {
        for (freedom, value) in [(1.0, 12.706), (2.0, 4.303), (10.0, 2.228), (1e9, 1.960)] {
            assert!((quantile(freedom) - value).abs() < 1e-3, "{freedom}: {}", quantile(freedom));
        }
    }

    /// A covariance as a fit of α and r to nearly sinusoidal ripples leaves it.
    #[test]
    fn correlations_are_symmetric_and_at_most_1_despite_round_off() {
        let covariance = DMatrix::from_row_slice(2, 2, &[4.0, 2.0001, 1.9999, 1.0]);
        assert_eq!(correlations(&covariance, 2), [[1.0, 1.0], [1.0, 1.0]]);
        let covariance = DMatrix::from_row_slice(2, 2, &[4.0, -2.0002, -2.0001, 1.0]);
        assert_eq!(correlations(&covariance, 2), [[1.0, -1.0], [-1.0, 1.0]]);
    }
}
