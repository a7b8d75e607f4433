//! One step of the collocation equations on the modes' state, and its linearisation.
//!
//! With X = (e, ζ) at the start of a step of length h, displacements d at its nodes and A, b of the method,
//!
//! ```text
//!     v_i = α (Σ_j Re(ζ_j e^{s_j d_i}) + h Σ_k a_ik f'(d_i - d_k)) + e + r h c_i - d_i
//!     0   = d_i - h Σ_k a_ik v_k
//!     e'  = e + r h - d_s,        ζ_j' = e^{s_j d_s} (ζ_j + w_j h Σ_k b_k e^{-s_j d_k})
//! ```

use super::embedding::{Embedding, Parameter};
use super::past::PastOfStep;
use super::sensitivity::Sensitivity;
use nalgebra::{SMatrix, SVector};
use num_complex::Complex;
use stickslip_tip::TipFunction;
use stickslip_tip::collocation::{RADAU, STAGES, Stages};

type Square = SMatrix<f64, STAGES, STAGES>;
type Vector = SVector<f64, STAGES>;

/// A step linearised about its displacements.
pub(super) struct LinearStep<'a> {
    equation: &'a Embedding,
    past: PastOfStep<'a>,
    d: &'a Stages,
    h: f64,
    velocity: Vector,
    /// ∂v/∂d
    velocity_slope: Square,
    /// Slope of the groove over α, past and own: ∂v/∂α.
    groove: Vector,
    /// `Σ_k a_ik f'(d_i - d_k)`
    own: Vector,
}

impl<'a> LinearStep<'a> {
    /// Of length h, from this extension; `past_slope` is that in which the equations are solved, `past` that
    /// in which they are linearised.
    pub(super) fn new(
        equation: &'a Embedding,
        (past, past_slope): (PastOfStep<'a>, &Stages),
        (extension, h, d): (f64, f64, &'a Stages),
    ) -> Self {
        let (own, own_slope) = own_groove(&equation.tip, d);
        let groove = Vector::from(*past_slope) + own * h;
        let pull = Vector::from_fn(|i, _| extension + equation.r * h * RADAU.c[i] - d[i]);
        let velocity = groove * equation.alpha + pull;
        let curvature = Square::from_diagonal(&Vector::from(past.curvature()));
        let velocity_slope = (curvature + own_slope * h) * equation.alpha - Square::identity();
        Self { equation, past, d, h, velocity, velocity_slope, groove, own }
    }

    /// 1 + u_xx, the largest within the step.
    pub(super) fn stiffness(&self) -> f64 {
        self.velocity_slope.diagonal().iter().fold(1.0, |m: f64, s| m.max(s.abs()))
    }

    /// Carries the sensitivities of the state over the step, which is the fraction `share` of the period,
    /// and returns those of its displacements. `None` if the stage equations are singular.
    pub(super) fn carry(
        &self,
        free: Parameter,
        share: f64,
        state: &mut Sensitivity,
    ) -> Option<Sensitivity> {
        let a = Square::from_fn(|i, k| RADAU.a[i][k]);
        let ha = a * self.h;
        let inverse = (Square::identity() - ha * self.velocity_slope).try_inverse()?;
        let gain = inverse * ha;
        let advance = Vector::from_fn(|i, _| self.equation.r * RADAU.c[i]);
        let by_length = self.own * self.equation.alpha + advance;
        let by_parameter = match free {
            Parameter::Alpha => self.groove,
            Parameter::R => Vector::from(RADAU.c) * self.h,
        };
        let missed = ha * self.velocity - Vector::from(*self.d);
        let constants = [
            (inverse * (a * self.velocity) + gain * by_length) * share,
            gain * by_parameter,
            inverse * missed,
        ];
        let mut stages = state.contracted(&self.stages_by_state(&gain));
        for i in 0..STAGES {
            for (column, constant) in stages.constants(i).iter_mut().zip(&constants) {
                *column += constant[i];
            }
        }
        self.carry_state(free, share, &stages, state);
        Some(stages)
    }

    /// ∂d/∂X = gain ∂v/∂X, by component of X.
    fn stages_by_state(&self, gain: &Square) -> Vec<Stages> {
        let alpha = self.equation.alpha;
        let by = |part: &dyn Fn(usize) -> f64| Stages::from(gain * Vector::from_fn(|i, _| part(i)));
        let exponentials = self.past.exponentials;
        let re = exponentials.iter().map(|e| by(&|i| alpha * e[i].re));
        let im = exponentials.iter().map(|e| by(&|i| -alpha * e[i].im));
        [by(&|_| 1.0)].into_iter().chain(re).chain(im).collect()
    }

    /// δX' from δX and δd.
    fn carry_state(
        &self,
        free: Parameter,
        share: f64,
        stages: &Sensitivity,
        state: &mut Sensitivity,
    ) {
        let modes = self.past.terms.len();
        let mut by_stages = vec![[0.0; STAGES]; 1 + 2 * modes];
        by_stages[0][STAGES - 1] = -1.0;
        state.constants(0)[0] += self.equation.r * share;
        if free == Parameter::R {
            state.constants(0)[1] += self.h;
        }
        for (j, term) in self.past.terms.iter().enumerate() {
            let e = &self.past.exponentials[j];
            let (re, im) = (1 + j, 1 + modes + j);
            state.multiply_pair(re, im, e[STAGES - 1]);
            let weight = term.weight * e[STAGES - 1];
            let spent: [Complex<f64>; STAGES] =
                std::array::from_fn(|k| weight * e[k].inv() * RADAU.b()[k]);
            for k in 0..STAGES {
                let mut change = -term.exponent * spent[k] * self.h;
                if k == STAGES - 1 {
                    change += term.exponent * self.past.after[j];
                }
                (by_stages[re][k], by_stages[im][k]) = (change.re, change.im);
            }
            let spent: Complex<f64> = spent.iter().sum();
            state.constants(re)[0] += spent.re * share;
            state.constants(im)[0] += spent.im * share;
        }
        state.add_expanded(&by_stages, stages);
    }
}

/// `Σ_k a_ik f'(d_i - d_k)`, what the step itself has carved until each node over h, and its derivatives
/// with respect to d.
fn own_groove(tip: &TipFunction, d: &Stages) -> (Vector, Square) {
    let (mut slope, mut derivative) = (Vector::zeros(), Square::zeros());
    for i in 0..STAGES {
        for k in 0..i {
            let (f1, f2) = tip.slope_and_curvature(d[i] - d[k]);
            let (to_i, to_k) = (RADAU.a[i][k], RADAU.a[k][i]);
            slope[i] += to_i * f1;
            slope[k] -= to_k * f1;
            derivative[(i, i)] += to_i * f2;
            derivative[(i, k)] -= to_i * f2;
            derivative[(k, k)] += to_k * f2;
            derivative[(k, i)] -= to_k * f2;
        }
    }
    (slope, derivative)
}
