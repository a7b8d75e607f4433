//! The heights under the tip in a step, linearised: a depth limit makes each visit count by what they are.
//!
//! ```text
//!     η_i = -α g_i,    g_i = past_i + Σ_k b_ik w_k f(d_i - d_k)
//! ```
//!
//! Changes of η follow from those of d and of what the past tells: Qδη = δF - Rδd, with F what the right-hand side is
//! changed by besides.

use super::blocks::{Square, Vector};
use super::carved::{Carved, Heights};
use super::embedding::{Embedding, Parameter};
use super::sensitivity::Sensitivity;
use stickslip_tip::collocation::{STAGES, Stages};
use stickslip_tip::step::{OwnGroove, OwnHeight};

/// Of one step.
pub(super) struct LinearHeights {
    alpha: f64,
    /// Q⁻¹
    inverse: Square,
    /// Q⁻¹R
    by_displacement: Square,
    /// ∂v/∂η
    pull: Square,
    /// g, and its derivative by the length of the step.
    groove: Vector,
    groove_rate: Vector,
    /// η + α g
    missed: Vector,
}

impl LinearHeights {
    /// `told` is the past of g, `slope` that of the groove under the stages; `None` if the equations are singular.
    pub(super) fn new(
        equation: &Embedding,
        told: Stages,
        (slope, own): (&Vector, &OwnGroove),
        (d, heights, carved): (&Stages, &Heights, &Carved),
    ) -> Option<Self> {
        let own_height = OwnHeight::new(&equation.tip, d);
        let (values, slopes) = (own_height.values(), own.slopes());
        let (weighted, changing, times) = (carved.weighted(), carved.by_height(), carved.times);
        let alpha = equation.alpha;
        let (mut groove, mut rate) = ([0.0; STAGES], [0.0; STAGES]);
        own_height.add(&weighted, &mut groove);
        own_height.add(&carved.rate(), &mut rate);
        let groove = Vector::from_fn(|i, _| told[i] + groove[i] * times);
        let groove_rate = Vector::from_fn(|i, _| rate[i] + carved.fading[i] * told[i]);
        let q = Square::from_fn(|i, k| alpha * changing[i][k] * values[i][k]) + Square::identity();
        let inverse = q.try_inverse()?;
        // A stage that moves on sees the slope where it is, and the others see it move.
        let along = Square::from_fn(|i, k| alpha * weighted[i][k] * times * slopes[i][k]);
        let by_displacement = Square::from_diagonal(&(slope * alpha)) - along;
        Some(Self {
            alpha,
            inverse,
            by_displacement: inverse * by_displacement,
            pull: Square::from_fn(|i, k| alpha * changing[i][k] * slopes[i][k]),
            groove,
            groove_rate,
            missed: Vector::from(heights.nodes) + groove * alpha,
        })
    }

    /// By how much the slope of the force is less as the heights follow the displacements.
    pub(super) fn stiffness(&self) -> Square {
        self.pull * self.by_displacement
    }

    /// What a change of g makes of the force.
    pub(super) fn force(&self, groove: &Vector) -> Vector {
        self.pull * (self.inverse * (groove * -self.alpha))
    }

    /// What the change of g with the length of the step makes of it.
    pub(super) fn force_by_length(&self) -> Vector {
        self.force(&self.groove_rate)
    }

    /// What a change of α makes of it by the heights.
    pub(super) fn force_by_alpha(&self) -> Vector {
        -(self.pull * (self.inverse * self.groove))
    }

    /// What the heights miss makes of it.
    pub(super) fn force_missed(&self) -> Vector {
        self.pull * (self.inverse * self.missed)
    }

    /// The changes of the heights, from those of g by the state, and those of the displacements.
    pub(super) fn follow(
        &self,
        by_state: &[Vector],
        (free, share): (Parameter, f64),
        state: &Sensitivity,
        stages: &Sensitivity,
    ) -> Sensitivity {
        let follows = |groove: &Vector| Stages::from(self.inverse * (groove * -self.alpha));
        let factors: Vec<Stages> = by_state.iter().map(follows).collect();
        let mut heights = state.contracted(&factors);
        let by_parameter = match free {
            Parameter::Alpha => -(self.inverse * self.groove),
            Parameter::R => Vector::zeros(),
        };
        let by_length = self.inverse * (self.groove_rate * (-self.alpha * share));
        let constants = [by_length, by_parameter, -(self.inverse * self.missed)];
        for i in 0..STAGES {
            for (column, constant) in heights.constants(i).iter_mut().zip(&constants) {
                *column += constant[i];
            }
        }
        let less: [Stages; STAGES] =
            std::array::from_fn(|i| std::array::from_fn(|k| -self.by_displacement[(i, k)]));
        heights.add_expanded(&less, stages);
        heights
    }
}
