//! The Levenberg-Marquardt method, from the crate `levenberg-marquardt` (MINPACK's `lmder`).

use levenberg_marquardt::{LeastSquaresProblem, LevenbergMarquardt};
use nalgebra::{DMatrix, DVector, Dyn, storage::Owned};
use stickslip_tip::stop;

/// Residuals as a function of parameters of order 1.
pub(crate) trait Residuals {
    /// The residuals at these parameters; `None` outside of the domain, which the search avoids.
    fn at(&self, parameters: &[f64]) -> Option<Vec<f64>>;

    /// The derivatives of the residuals, a column for each parameter; `here` are the residuals.
    fn derivatives(&self, here: &[f64], parameters: &[f64]) -> Option<Vec<Vec<f64>>>;

    /// Relative changes of the sum and of the parameters at which a search ends.
    fn enough(&self) -> f64 {
        1e-9
    }
}

/// Derivatives by forward differences, or backward ones at the edge of the domain.
pub(crate) fn forward(
    model: &(impl Residuals + ?Sized),
    (here, at): (&[f64], &[f64]),
    step: f64,
) -> Option<Vec<Vec<f64>>> {
    let column = |i: usize| {
        let one_sided = |by: f64| Some(slope(&beside(model, at, (i, by))?, here, by));
        one_sided(step).or_else(|| one_sided(-step))
    };
    (0..at.len()).map(column).collect()
}

/// The residuals with `by` added to the i-th parameter.
fn beside(
    model: &(impl Residuals + ?Sized),
    at: &[f64],
    (i, by): (usize, f64),
) -> Option<Vec<f64>> {
    let mut parameters = at.to_vec();
    parameters[i] += by;
    model.at(&parameters)
}

fn slope(a: &[f64], b: &[f64], length: f64) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| (a - b) / length).collect()
}

/// The end point of a search.
#[derive(Debug, Clone)]
pub(crate) struct Minimum {
    pub(crate) parameters: Vec<f64>,
    pub(crate) residuals: Vec<f64>,
    /// Sum of the squared residuals.
    pub(crate) sum: f64,
}

impl Minimum {
    /// The given point; `None` outside of the domain.
    pub(crate) fn at(model: &dyn Residuals, parameters: &[f64]) -> Option<Self> {
        let residuals = model.at(parameters)?;
        let sum = squares(&residuals);
        Some(Self { parameters: parameters.to_vec(), residuals, sum })
    }
}

/// Factor of the residuals reported for a failed trial, which makes the search shorten its step.
const FAILED: f64 = 10.0;
/// Largest number of evaluations per parameter.
const PATIENCE: usize = 40;

/// The local minimum of the sum of squares found from `start`; `None` outside of the domain, or if the work is
/// [cancelled](stop).
pub(crate) fn minimum(model: &dyn Residuals, start: &[f64]) -> Option<Minimum> {
    if stop::is_requested() {
        return None;
    }
    let residuals = model.at(start)?;
    let sum = squares(&residuals);
    let begin = Minimum { parameters: start.to_vec(), residuals, sum };
    // Nothing to vary, or nothing left.
    if start.is_empty() || sum <= f64::MIN_POSITIVE {
        return Some(begin);
    }
    let worst = FAILED * (sum / begin.residuals.len() as f64).sqrt();
    let at = DVector::from_column_slice(start);
    let here = Some(begin.residuals.clone());
    let problem = Problem { model, at, here, best: begin, worst };
    let method = LevenbergMarquardt::new()
        .with_ftol(model.enough())
        .with_xtol(model.enough())
        .with_gtol(model.enough())
        .with_stepbound(0.3)
        .with_patience(PATIENCE);
    // Whatever ended it, the best that it met is no worse than the start.
    Some(method.minimize(problem).0.best)
}

pub(crate) fn squares(residuals: &[f64]) -> f64 {
    residuals.iter().map(|v| v * v).sum()
}

/// Derivatives by central differences, one-sided at the edge of the domain.
pub(crate) fn differences(
    model: &(impl Residuals + ?Sized),
    (here, at): (&[f64], &[f64]),
    step: f64,
) -> Option<Vec<Vec<f64>>> {
    let column = |i: usize| match [step, -step].map(|by| beside(model, at, (i, by))) {
        [Some(after), Some(before)] => Some(slope(&after, &before, 2.0 * step)),
        [Some(after), None] => Some(slope(&after, here, step)),
        [None, Some(before)] => Some(slope(here, &before, step)),
        [None, None] => None,
    };
    (0..at.len()).map(column).collect()
}

/// The matrix of these columns.
pub(crate) fn matrix_of(columns: Vec<Vec<f64>>) -> DMatrix<f64> {
    let columns: Vec<DVector<f64>> = columns.into_iter().map(DVector::from_vec).collect();
    DMatrix::from_columns(&columns)
}

struct Problem<'a> {
    model: &'a dyn Residuals,
    at: DVector<f64>,
    /// Residuals at `at`, if it is in the domain.
    here: Option<Vec<f64>>,
    /// The best point so far.
    best: Minimum,
    worst: f64,
}

impl LeastSquaresProblem<f64, Dyn, Dyn> for Problem<'_> {
    type ResidualStorage = Owned<f64, Dyn>;
    type JacobianStorage = Owned<f64, Dyn, Dyn>;
    type ParameterStorage = Owned<f64, Dyn>;

    fn set_params(&mut self, at: &DVector<f64>) {
        self.at.copy_from(at);
        let found = self.model.at(at.as_slice());
        self.here = found.filter(|found| found.iter().all(|v| v.is_finite()));
        if let Some(here) = &self.here {
            let sum = squares(here);
            if sum < self.best.sum {
                let parameters = at.as_slice().to_vec();
                self.best = Minimum { parameters, residuals: here.clone(), sum };
            }
        }
    }

    fn params(&self) -> DVector<f64> {
        self.at.clone()
    }

    fn residuals(&self) -> Option<DVector<f64>> {
        let rows = self.best.residuals.len();
        let none = || DVector::from_element(rows, self.worst);
        Some(self.here.as_ref().map_or_else(none, |here| DVector::from_column_slice(here)))
    }

    fn jacobian(&self) -> Option<DMatrix<f64>> {
        if stop::is_requested() {
            return None;
        }
        self.model.derivatives(self.here.as_ref()?, self.at.as_slice()).map(matrix_of)
    }
}
