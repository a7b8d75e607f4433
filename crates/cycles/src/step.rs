//! One step of the collocation equations on the modes' state, and its linearisation.
//!
//! With X = (e, ζ) at the start of a step of length h, displacements d at its nodes and A, b of the method,
//!
//! ```text
//!     v_i = α (Σ_j Re(ζ_j e^{s_j d_i}) + h Σ_k a_ik f'(d_i - d_k)) + e + r h c_i - d_i
//!     0   = d_i - h Σ_k a_ik v_k                           (stickslip_tip::step)
//!     e'  = e + r h - d_s,        ζ_j' = e^{s_j d_s} (ζ_j + w_j h Σ_k b_k e^{-s_j d_k})
//! ```

use super::embedding::{Embedding, Parameter};
use super::past::PastOfStep;
use super::sensitivity::Sensitivity;
use nalgebra::{SMatrix, SVector};
use num_complex::Complex;
use stickslip_tip::collocation::{RADAU, STAGES, Stages};
use stickslip_tip::step::{Law, OwnGroove, carving};

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
        let law = Law { alpha: equation.alpha, r: equation.r, spring: 1.0 };
        let between = OwnGroove::new(&equation.tip, d);
        // What is carved in a unit step: of one of length h it is h times as much.
        let (mut own, mut own_slope) = ([0.0; STAGES], [[0.0; STAGES]; STAGES]);
        between.add_slope(&carving(1.0), &mut own);
        between.add_derivatives(&carving(1.0), &mut own_slope);
        let (own, pull) = (Vector::from(own), law.pull(extension, h));
        let groove = Vector::from(*past_slope) + own * h;
        let velocity = Vector::from_fn(|i, _| law.velocity(pull[i], d[i], 0.0, groove[i]));
        let curvature = past.curvature();
        let velocity_slope = Square::from_fn(|i, k| match own_slope[i][k] * h {
            own if i == k => law.velocity_slope(0.0, curvature[i] + own),
            own => law.alpha * own,
        });
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

#[cfg(test)]
mod tests {
    use super::super::past::Past;
    use super::*;
    use stickslip_tip::memory::{Groove, Memory, Policy};
    use stickslip_tip::step::Equations;
    use stickslip_tip::{Model, TipFunction};

    /// The integrator's equations, with the past from its memory, on the steps of a cycle: what memory and
    /// state say of the past agrees, and all that is made of it.
    #[test]
    fn a_step_of_a_cycle_and_of_the_integrator_are_the_same() {
        let tip = TipFunction::triple_gaussian(1.0, 1.0).unwrap();
        let model = Model::new(tip.clone(), 1.2, 1.0).unwrap();
        let found = crate::cycle(&model, 1e-9).unwrap();
        let (equation, orbit) = (&found.closed.equation, &found.closed.orbit);
        let law = Law::of(&model);
        let past = Past::of(&equation.fine, orbit).unwrap();
        let mut memory = Policy::with_fit(tip.clone(), equation.fine.clone()).unwrap();
        let steps = || orbit.lengths().zip(&orbit.stages);
        for _ in 0..8 {
            steps().for_each(|(h, d)| memory.remember(d, &RADAU.b().map(|b| b * h)));
        }
        let mut extension = orbit.extension;
        let zero = [0.0; STAGES];
        for (n, (h, d)) in steps().enumerate() {
            let slope = past.of_step(n).slope();
            let step = LinearStep::new(equation, (past.of_step(n), &slope), (extension, h, d));
            let (mut told, mut curvature) = (zero, zero);
            memory.groove(d, &mut Groove::new(&mut told, &mut curvature));
            let near = |a: f64, b: f64, allowed: f64, what: &str| {
                assert!((a - b).abs() < allowed, "{what} of step {n}: {a} {b}");
            };
            let equations = Equations::new(law, h, law.pull(extension, h));
            let own = OwnGroove::new(&tip, d);
            let velocity = equations.velocity(d, &told, &zero, &own);
            let residual = equations.residual(d, &velocity);
            let jacobian = equations.jacobian(&curvature, &zero, &own);
            let ha = Square::from_fn(|i, k| h * RADAU.a[i][k]);
            let missed = Vector::from(*d) - ha * step.velocity;
            let ours = Square::identity() - ha * step.velocity_slope;
            for i in 0..STAGES {
                near(slope[i], told[i], 1e-9, "past");
                near(step.velocity[i], velocity[i], 1e-9, "velocity");
                near(missed[i], residual[i], 1e-9, "residual");
                near(residual[i], 0.0, 1e-8, "solution");
                (0..STAGES).for_each(|k| near(ours[(i, k)], jacobian[i][k], 1e-9, "jacobian"));
            }
            extension += equation.r * h - d[STAGES - 1];
            memory.remember(d, &RADAU.b().map(|b| b * h));
        }
    }
}
