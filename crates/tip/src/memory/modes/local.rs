//! The groove about a point near the tip, as a polynomial.

use crate::collocation::{STAGES, Stages};

pub(crate) const HIGHEST_DEGREE: usize = 40;

/// The slope of the groove about a point near the tip: `Σ_k c_k (x - center)^k`.
#[derive(Debug, Clone)]
pub(super) struct LocalGroove {
    center: f64,
    radius: f64,
    degree: usize,
    coefficients: [f64; HIGHEST_DEGREE + 1],
    /// The height at the center, once it has been evaluated.
    pub(super) height: Option<f64>,
}

impl LocalGroove {
    /// A polynomial that is valid nowhere.
    pub(super) fn nowhere() -> Self {
        let coefficients = [0.0; HIGHEST_DEGREE + 1];
        Self { center: 0.0, radius: -1.0, degree: 0, coefficients, height: None }
    }

    /// Sets the range and the degree. Returns the coefficients, all 0, to be filled in.
    pub(super) fn about(&mut self, center: f64, radius: f64, degree: usize) -> &mut [f64] {
        (self.center, self.radius, self.degree, self.height) = (center, radius, degree, None);
        self.coefficients[..=degree].fill(0.0);
        &mut self.coefficients[..=degree]
    }

    pub(super) fn forget(&mut self) {
        self.radius = -1.0;
    }

    pub(super) fn holds(&self, at: &[f64]) -> bool {
        at.iter().all(|at| (at - self.center).abs() <= self.radius)
    }

    /// Slope and curvature at these points, computed for as many at a time as a step has stages.
    pub(super) fn read(&self, at: &[f64], slope: &mut [f64], curvature: &mut [f64]) {
        let (whole, rest) = at.as_chunks();
        let (slopes, slope_rest) = slope.as_chunks_mut();
        let (curvatures, curvature_rest) = curvature.as_chunks_mut();
        for (at, (slope, curvature)) in whole.iter().zip(slopes.iter_mut().zip(curvatures)) {
            self.read_stages(at, slope, curvature);
        }
        if !rest.is_empty() {
            let mut last = [self.center; STAGES];
            last[..rest.len()].copy_from_slice(rest);
            let (mut slope, mut curvature) = ([0.0; STAGES], [0.0; STAGES]);
            self.read_stages(&last, &mut slope, &mut curvature);
            slope_rest.copy_from_slice(&slope[..rest.len()]);
            curvature_rest.copy_from_slice(&curvature[..rest.len()]);
        }
    }

    /// Horner's rule for the polynomial and its derivative.
    fn read_stages(&self, at: &Stages, slope: &mut Stages, curvature: &mut Stages) {
        let y = at.map(|at| at - self.center);
        (*slope, *curvature) = ([0.0; STAGES], [0.0; STAGES]);
        for c in self.coefficients[..=self.degree].iter().rev() {
            for i in 0..STAGES {
                curvature[i] = curvature[i] * y[i] + slope[i];
                slope[i] = slope[i] * y[i] + c;
            }
        }
    }

    /// The height at these points, `h + Σ_k c_k/(k+1) (x - center)^{k+1}` with the height h at the center.
    pub(super) fn read_height(
        &mut self,
        at: &[f64],
        height: &mut [f64],
        at_center: impl Fn(f64) -> f64,
    ) {
        let from = *self.height.get_or_insert_with(|| at_center(self.center));
        for (at, height) in at.iter().zip(height) {
            let y = at - self.center;
            let powers = self.coefficients[..=self.degree].iter().enumerate().rev();
            let sum = powers.fold(0.0, |sum, (k, c)| sum * y + c / (k + 1) as f64);
            *height = from + sum * y;
        }
    }
}
