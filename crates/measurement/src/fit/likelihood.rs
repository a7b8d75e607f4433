//! 95 % intervals by profile likelihood: how far a number can be held off its best value before the rest, fitted anew,
//! leaves too much.

use super::parameters::Name;
use super::problem::Problem;
use crate::Estimate;
use crate::least_squares::{Minimum, minimum, squares};
use nalgebra::{DMatrix, DVector};

/// A number as fitted.
#[derive(Debug, Clone, PartialEq)]
pub struct Fitted {
    /// Which.
    pub name: Name,
    /// With its interval; ends that the data do not exclude are 0 or infinite.
    pub estimate: Estimate,
    /// Its profile: values, and the root of what each leaves over the best, less 1, times the degrees of freedom.
    pub profile: Vec<(f64, f64)>,
}

/// A number is followed to this many times, or part of, its best value.
const FARTHEST: f64 = 20.0;
/// A number of a wider law that is next to unfelt where it is best, down to where it is.
const FARTHEST_OF_A_LAW: f64 = 1e5;
/// Points on the way to an end.
const MOST_POINTS: usize = 7;
/// The root that is looked for is met to this.
const MET: f64 = 0.02;

/// The best fit, and how it may vary.
pub(super) struct Around<'a> {
    pub(super) problem: &'a Problem<'a>,
    pub(super) best: &'a Minimum,
    /// Of what is searched, in units of the variance of the residuals.
    pub(super) covariance: DMatrix<f64>,
    /// Rows less numbers.
    pub(super) freedom: f64,
}

impl<'a> Around<'a> {
    /// `None` where the derivatives have no end.
    pub(super) fn of(problem: &'a Problem, best: &'a Minimum) -> Option<Self> {
        let columns = problem.slopes(&best.residuals, &best.parameters)?;
        let columns: Vec<DVector<f64>> = columns.into_iter().map(DVector::from_vec).collect();
        let jacobian = DMatrix::from_columns(&columns);
        let mut normal = jacobian.tr_mul(&jacobian);
        // What no datum feels has no variance to speak of, and a huge one in numbers.
        let largest = normal.diagonal().max();
        for i in 0..normal.nrows() {
            normal[(i, i)] += 1e-14 * largest;
        }
        let freedom = (problem.rows() as f64 - problem.parameters() as f64).max(1.0);
        let covariance = normal.try_inverse()? * (best.sum / freedom);
        Some(Self { problem, best, covariance, freedom })
    }

    /// Standard deviation of the logarithm of one that is searched.
    pub(super) fn deviation(&self, i: usize) -> f64 {
        self.covariance[(i, i)].max(0.0).sqrt()
    }

    /// Correlations of the numbers.
    pub(super) fn correlations(&self) -> Vec<Vec<f64>> {
        let count = self.problem.free.len();
        let of = |i: usize, j: usize| {
            if i == j {
                return 1.0;
            }
            self.covariance[(i, j)] / (self.deviation(i) * self.deviation(j))
        };
        (0..count).map(|i| (0..count).map(|j| of(i, j)).collect()).collect()
    }

    /// The interval of the i-th number.
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
        profile.sort_by(|a, b| a.0.total_cmp(&b.0));
        let estimate = Estimate {
            value,
            low: low.map_or(0.0, |offset| value * offset.exp()),
            high: high.map_or(f64::INFINITY, |offset| value * offset.exp()),
        };
        Fitted { name, estimate, profile }
    }

    /// The offset at which too much is left, and the points on the way there.
    fn end(&self, i: usize, side: f64) -> (Option<f64>, Vec<(f64, f64)>) {
        let wanted = quantile_of_student(self.freedom);
        let most =
            if self.problem.free[i].is_of_a_law() { FARTHEST_OF_A_LAW } else { FARTHEST }.ln();
        let deviation = self.deviation(i);
        let mut offset = side * (wanted * deviation).clamp(1e-9, most);
        // Below it too little is left, above it too much.
        let (mut inside, mut outside): ((f64, f64), Option<(f64, f64)>) = ((0.0, 0.0), None);
        let mut points = vec![];
        for _ in 0..MOST_POINTS {
            let root = self.root(i, offset).unwrap_or(f64::INFINITY);
            if root.is_finite() {
                points.push((offset, root));
            }
            if (root - wanted).abs() < MET * wanted {
                return (Some(offset), points);
            }
            if root < wanted {
                if offset.abs() >= most {
                    return (None, points);
                }
                inside = (offset, root);
            } else {
                outside = Some((offset, root));
            }
            offset = match outside {
                Some((far, root)) if root.is_finite() => {
                    let part = (wanted - inside.1) / (root - inside.1);
                    inside.0 + part.clamp(0.05, 0.95) * (far - inside.0)
                }
                Some((far, _)) => 0.5 * (inside.0 + far),
                None => {
                    let further = wanted / inside.1.max(0.2 * wanted) * 1.05;
                    side * (offset.abs() * further).min(most)
                }
            };
        }
        (outside.map(|_| offset), points)
    }

    /// √((S/S0 - 1)(n - p)) with one number held at an offset of its logarithm.
    fn root(&self, i: usize, offset: f64) -> Option<f64> {
        let problem = self.problem;
        let others = problem.holding(i, (self.best.parameters[i] + offset).exp());
        // Where the others go if all is linear.
        let variance = self.covariance[(i, i)].max(f64::MIN_POSITIVE);
        let moved = |(j, at): (usize, &f64)| {
            let along = self.covariance[(i, j)] / variance * offset;
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
        Some((more * self.freedom).sqrt())
    }
}

/// 97.5 % of Student's distribution lie below, by Cornish and Fisher's expansion.
pub(super) fn quantile_of_student(freedom: f64) -> f64 {
    const Z: f64 = 1.959_963_985;
    let (z3, z5) = (Z.powi(3), Z.powi(5));
    Z + (z3 + Z) / (4.0 * freedom) + (5.0 * z5 + 16.0 * z3 + 3.0 * Z) / (96.0 * freedom * freedom)
}

/// The combination of logarithms that the data feel least: its powers, the largest 1, and its deviation.
pub(super) fn least_felt(around: &Around) -> Option<(Vec<f64>, f64)> {
    let count = around.problem.free.len();
    let part = around.covariance.view((0, 0), (count, count)).into_owned();
    let found = part.symmetric_eigen();
    let i = found.eigenvalues.imax();
    let powers: Vec<f64> = found.eigenvectors.column(i).iter().copied().collect();
    let largest = powers.iter().copied().max_by(|a, b| a.abs().total_cmp(&b.abs()))?;
    let powers = powers.into_iter().map(|p| p / largest).collect();
    Some((powers, found.eigenvalues[i].max(0.0).sqrt()))
}

/// Σ of squares with the rows weighted no more.
pub(super) fn plain(residuals: &[f64], weights: &[f64]) -> f64 {
    squares(&residuals.iter().zip(weights).map(|(r, w)| r / w.max(1e-6)).collect::<Vec<f64>>())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Abramowitz and Stegun, table 26.10.
    #[test]
    fn quantiles_of_student_are_those_of_tables() {
        for (freedom, quantile) in [(10.0, 2.228), (30.0, 2.042), (1e9, 1.960)] {
            assert!((quantile_of_student(freedom) - quantile).abs() < 3e-3, "{freedom}");
        }
    }
}
