//! The contribution of a step to the groove.

use crate::TipFunction;
use crate::collocation::{RADAU, STAGES, Stages};
use crate::tip_function::Apex;
use multiversion::multiversion;

/// A matrix with a row for each stage.
pub type Matrix = [Stages; STAGES];

/// f' and f'' at `d_i - d_k` for all pairs of stages. They determine the contribution of the step to the groove under
/// its own stages, `Σ_k b_ik f'(d_i - d_k)`, and its derivatives.
#[derive(Debug, Clone, Copy)]
pub struct OwnGroove {
    slope: Pairs,
    curvature: Pairs,
}

/// Pairs of stages i > k, and one idle pair (0, 0) that fills the SIMD vectors.
const PAIRS: [(usize, usize); 16] = pairs();
const IDLE: usize = PAIRS.len() - 1;
type Pairs = [f64; PAIRS.len()];

const fn pairs() -> [(usize, usize); 16] {
    let mut all = [(0, 0); 16];
    let (mut n, mut i) = (0, 1);
    while i < STAGES {
        let mut k = 0;
        while k < i {
            all[n] = (i, k);
            n += 1;
            k += 1;
        }
        i += 1;
    }
    all
}

/// Weights of each stage in the groove at each stage: the Butcher matrix times a factor, h for the groove of a step
/// of that length.
#[must_use]
#[inline]
pub fn carving(factor: f64) -> Matrix {
    RADAU.a.map(|row| row.map(|a| factor * a))
}

impl OwnGroove {
    /// All values 0.
    pub(crate) fn nothing() -> Self {
        Self { slope: [0.0; PAIRS.len()], curvature: [0.0; PAIRS.len()] }
    }

    /// The contribution under stages at these displacements.
    #[must_use]
    pub fn new(tip: &TipFunction, d: &Stages) -> Self {
        let [slope, curvature] = side_by_side(tip, &PAIRS.map(|(i, k)| d[i] - d[k]));
        Self { slope, curvature }
    }

    /// The same from the polynomial about the apex, where that is accurate.
    #[inline]
    pub(crate) fn near(apex: &Apex, tip: &TipFunction, d: &Stages) -> Self {
        let distance = PAIRS.map(|(i, k)| d[i] - d[k]);
        let (mut slope, mut curvature) = ([0.0; PAIRS.len()], [0.0; PAIRS.len()]);
        if apex.slopes_and_curvatures(&distance, &mut slope, &mut curvature) {
            return Self { slope, curvature };
        }
        Self::new(tip, d)
    }

    /// `f'(d_i - d_k)`
    #[must_use]
    pub fn slopes(&self) -> Matrix {
        let mut slopes = [[0.0; STAGES]; STAGES];
        for (slope, (i, k)) in self.slope[..IDLE].iter().zip(PAIRS) {
            (slopes[i][k], slopes[k][i]) = (*slope, -slope);
        }
        slopes
    }

    /// Adds `Σ_k b_ik f'(d_i - d_k)`.
    #[inline]
    pub fn add_slope(&self, b: &Matrix, groove: &mut Stages) {
        for (slope, (i, k)) in self.slope.iter().zip(PAIRS) {
            groove[i] += b[i][k] * slope;
            groove[k] -= b[k][i] * slope;
        }
    }

    /// Adds the derivatives of this sum with respect to d. (The idle pair adds and subtracts the same value.)
    #[inline]
    pub fn add_derivatives(&self, b: &Matrix, derivatives: &mut Matrix) {
        for (curvature, (i, k)) in self.curvature.iter().zip(PAIRS) {
            let (to_i, to_k) = (b[i][k] * curvature, b[k][i] * curvature);
            derivatives[i][i] += to_i;
            derivatives[i][k] -= to_i;
            derivatives[k][k] += to_k;
            derivatives[k][i] -= to_k;
        }
    }
}

/// f' and f'' at these distances; compiled for wider vectors too.
#[multiversion(targets("x86_64+avx2"))]
fn side_by_side(tip: &TipFunction, distance: &Pairs) -> [Pairs; 2] {
    tip.slopes_and_curvatures(distance)
}

/// f at `d_i - d_k`: the height of the contribution of the step to the groove, `Σ_k b_ik f(d_i - d_k)`.
#[derive(Debug, Clone, Copy)]
pub struct OwnHeight {
    value: Pairs,
    apex: f64,
}

impl OwnHeight {
    /// All values 0.
    pub(crate) fn nothing() -> Self {
        Self { value: [0.0; PAIRS.len()], apex: 0.0 }
    }

    /// The heights under stages at these displacements.
    #[must_use]
    pub fn new(tip: &TipFunction, d: &Stages) -> Self {
        let value = PAIRS.map(|(i, k)| tip.value(d[i] - d[k]));
        Self { value, apex: tip.value(0.0) }
    }

    /// The same from the polynomial about the apex, where that is accurate.
    pub(crate) fn near(apex: &Apex, tip: &TipFunction, d: &Stages) -> Self {
        let mut value = [0.0; PAIRS.len()];
        if apex.values(&PAIRS.map(|(i, k)| d[i] - d[k]), &mut value) {
            return Self { value, apex: value[IDLE] };
        }
        Self::new(tip, d)
    }

    /// `f(d_i - d_k)`
    #[must_use]
    pub fn values(&self) -> Matrix {
        let mut values = [[self.apex; STAGES]; STAGES];
        for (value, (i, k)) in self.value[..IDLE].iter().zip(PAIRS) {
            (values[i][k], values[k][i]) = (*value, *value);
        }
        values
    }

    /// Adds `Σ_k b_ik f(d_i - d_k)`.
    pub fn add(&self, b: &Matrix, height: &mut Stages) {
        for (height, (b, values)) in height.iter_mut().zip(b.iter().zip(self.values())) {
            *height += b.iter().zip(values).map(|(b, value)| b * value).sum::<f64>();
        }
    }
}
