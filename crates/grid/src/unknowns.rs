//! The N + 1 unknowns of the paper's grid, in the form required by the crate of the integrator.

use differential_equations::{tolerance::Tolerance, traits::State};

/// x0, u(x_1), …, u(x_N). The error of a step is the largest error of any unknown, as in ode45; in the crate's root
/// mean square the many cells out of reach would hide the error of the tip.
#[derive(Debug, Clone)]
pub(crate) struct Unknowns(pub(crate) Vec<f64>);

impl State<f64> for Unknowns {
    fn len(&self) -> usize {
        self.0.len()
    }

    fn get_component(&self, index: usize) -> f64 {
        self.0[index]
    }

    fn set_component(&mut self, index: usize, value: f64) {
        self.0[index] = value;
    }

    fn map_components_mut<F: FnMut(usize, &mut f64)>(&mut self, mut f: F) {
        self.0.iter_mut().enumerate().for_each(|(i, value)| f(i, value));
    }

    fn zeros_like(&self) -> Self {
        Self(vec![0.0; self.0.len()])
    }

    fn zeros() -> Self {
        Self(Vec::new())
    }

    fn mul_add_assign(&mut self, alpha: f64, other: &Self) {
        for (own, its) in self.0.iter_mut().zip(&other.0) {
            *own += alpha * its;
        }
    }

    fn scale_mut(&mut self, alpha: f64) {
        self.0.iter_mut().for_each(|value| *value *= alpha);
    }

    // The defaults of these two go through `get_component` and do not vectorise.
    fn add_scaled(&mut self, alpha: f64, other: &Self) -> &mut Self {
        self.mul_add_assign(alpha, other);
        self
    }

    fn diff_norm_squared(&self, other: &Self) -> f64 {
        self.0.iter().zip(&other.0).map(|(a, b)| (a - b) * (a - b)).sum()
    }

    /// n max (error/allowed)²: the crate divides by n and takes the root.
    fn error_norm(
        &self,
        after: &Self,
        error: &Self,
        atol: &Tolerance<f64>,
        rtol: &Tolerance<f64>,
    ) -> f64 {
        let (atol, rtol) = (atol[0], rtol[0]);
        let relative = |((before, after), error): ((&f64, &f64), &f64)| {
            error.abs() / (atol + rtol * before.abs().max(after.abs()))
        };
        // `max` would swallow a NaN.
        let total: f64 = error.0.iter().sum();
        let unknowns = self.0.iter().zip(&after.0).zip(&error.0);
        let largest =
            if total.is_nan() { total } else { unknowns.map(relative).fold(0.0, f64::max) };
        largest * largest * self.0.len() as f64
    }
}
