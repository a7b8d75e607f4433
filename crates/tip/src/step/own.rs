//! The contribution of a step to the groove.

use crate::TipFunction;
use crate::collocation::{RADAU, STAGES, Stages};
use crate::tip_function::Apex;
use multiversion::multiversion;

/// A matrix with a row for each stage.
pub type Matrix = [Stages; STAGES];

/// f' and f'' at `d_i - d_k` and `d_k - d_i` for all pairs of stages. They determine the contribution of the step to the groove under
/// its own stages, `Σ_k b_ik f'(d_i - d_k)`, and its derivatives.
#[derive(Debug, Clone, Copy, Default)]
pub struct OwnGroove {
    slope: Both,
    curvature: Both,
}

/// Pairs of stages i > k, and one idle pair (0, 0) that fills the SIMD vectors.
const PAIRS: [(usize, usize); 16] = pairs();
const IDLE: usize = PAIRS.len() - 1;
type Pairs = [f64; PAIRS.len()];
/// Values at `d_i - d_k`, and at `d_k - d_i`.
type Both = [Pairs; 2];

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
#[inline]
pub fn carving(factor: f64) -> Matrix {
    RADAU.a.map(|row| row.map(|a| factor * a))
}

impl OwnGroove {
    /// The values for stages at the displacements d.
    pub fn new(tip: &TipFunction, d: &Stages) -> Self {
        let ahead = side_by_side(tip, &PAIRS.map(|(i, k)| d[i] - d[k]));
        if tip.is_even() {
            return Self::even(ahead);
        }
        let behind = side_by_side(tip, &PAIRS.map(|(i, k)| d[k] - d[i]));
        Self { slope: [ahead[0], behind[0]], curvature: [ahead[1], behind[1]] }
    }

    /// The contribution for an even f, whose f' is odd.
    #[inline]
    fn even([slope, curvature]: [Pairs; 2]) -> Self {
        Self { slope: [slope, slope.map(|slope| -slope)], curvature: [curvature; 2] }
    }

    /// As [`new`](Self::new), from the polynomial about the apex if that is accurate.
    #[inline]
    pub(crate) fn near(apex: &Apex, tip: &TipFunction, d: &Stages) -> Self {
        let distance = PAIRS.map(|(i, k)| d[i] - d[k]);
        let (mut slope, mut curvature) = ([0.0; PAIRS.len()], [0.0; PAIRS.len()]);
        if apex.slopes_and_curvatures(&distance, &mut slope, &mut curvature) {
            return Self::even([slope, curvature]);
        }
        Self::new(tip, d)
    }

    /// `f'(d_i - d_k)`
    pub fn slopes(&self) -> Matrix {
        let mut slopes = [[0.0; STAGES]; STAGES];
        let [ahead, behind] = &self.slope;
        for ((ahead, behind), (i, k)) in ahead[..IDLE].iter().zip(behind).zip(PAIRS) {
            (slopes[i][k], slopes[k][i]) = (*ahead, *behind);
        }
        slopes
    }

    /// Adds `Σ_k b_ik f'(d_i - d_k)`.
    #[inline]
    pub fn add_slope(&self, b: &Matrix, groove: &mut Stages) {
        let [ahead, behind] = &self.slope;
        for ((ahead, behind), (i, k)) in ahead.iter().zip(behind).zip(PAIRS) {
            groove[i] += b[i][k] * ahead;
            groove[k] += b[k][i] * behind;
        }
    }

    /// Adds the derivatives of `Σ_k b_ik f'(d_i - d_k)` with respect to d. (The idle pair adds and subtracts the same
    /// value.)
    #[inline]
    pub fn add_derivatives(&self, b: &Matrix, derivatives: &mut Matrix) {
        let [ahead, behind] = &self.curvature;
        for ((ahead, behind), (i, k)) in ahead.iter().zip(behind).zip(PAIRS) {
            let (to_i, to_k) = (b[i][k] * ahead, b[k][i] * behind);
            derivatives[i][i] += to_i;
            derivatives[i][k] -= to_i;
            derivatives[k][k] += to_k;
            derivatives[k][i] -= to_k;
        }
    }
}

/// f' and f'' at these distances; also compiled for wider vectors.
#[multiversion(targets("x86_64+avx2"))]
fn side_by_side(tip: &TipFunction, distance: &Pairs) -> [Pairs; 2] {
    tip.slopes_and_curvatures(distance)
}

/// f at `d_i - d_k` and `d_k - d_i`: the height of the contribution of the step to the groove, `Σ_k b_ik f(d_i - d_k)`.
#[derive(Debug, Clone, Copy, Default)]
pub struct OwnHeight {
    value: Both,
    apex: f64,
}

impl OwnHeight {
    /// The heights under stages at these displacements.
    pub fn new(tip: &TipFunction, d: &Stages) -> Self {
        let ahead = PAIRS.map(|(i, k)| tip.value(d[i] - d[k]));
        let behind = || PAIRS.map(|(i, k)| tip.value(d[k] - d[i]));
        let behind = if tip.is_even() { ahead } else { behind() };
        Self { value: [ahead, behind], apex: tip.value(0.0) }
    }

    /// As [`new`](Self::new), from the polynomial about the apex if that is accurate.
    pub(crate) fn near(apex: &Apex, tip: &TipFunction, d: &Stages) -> Self {
        let mut value = [0.0; PAIRS.len()];
        if apex.values(&PAIRS.map(|(i, k)| d[i] - d[k]), &mut value) {
            return Self { value: [value; 2], apex: value[IDLE] };
        }
        Self::new(tip, d)
    }

    /// `f(d_i - d_k)`
    pub fn values(&self) -> Matrix {
        let mut values = [[self.apex; STAGES]; STAGES];
        let [ahead, behind] = &self.value;
        for ((ahead, behind), (i, k)) in ahead[..IDLE].iter().zip(behind).zip(PAIRS) {
            (values[i][k], values[k][i]) = (*ahead, *behind);
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
