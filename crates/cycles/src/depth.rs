//! Linearised heights under the tip in a step: under a depth limit they determine the weight of each visit.
//!
//! ```text
//!     η_i = -α g_i,    g_i = past_i + Σ_k b_ik w_k f(d_i - d_k)
//! ```
//!
//! Changes of η follow from the changes of d and of the history: Qδη = δF - Rδd, where δF is the remaining change of
//! the right-hand side.

use super::blocks::{Square, Vector};
use super::carved::{Carved, Heights};
use super::embedding::{Embedding, Parameter};
use super::sensitivity::Sensitivity;
use stickslip_tip::collocation::{STAGES, Stages};
use stickslip_tip::step::{OwnGroove, OwnHeight};

pub(super) struct LinearHeights {
    alpha: f64,
    /// Q⁻¹
    inverse: Square,
    /// Q⁻¹R
    by_displacement: Square,
    /// ∂v/∂η
    pull: Square,
    /// g
    groove: Vector,
    /// Derivative of g with respect to the step length.
    groove_rate: Vector,
    /// Residual η + α g.
    missed: Vector,
}

impl LinearHeights {
    /// `history` is the contribution of the history to g, `slope` the slope of the whole groove at the stages, divided by
    /// α. `None` if the equations are singular.
    pub(super) fn new(
        equation: &Embedding,
        history: &Stages,
        (slope, own): (&Vector, &OwnGroove),
        (d, heights, carved): (&Stages, &Heights, &Carved),
    ) -> Option<Self> {
        let own_height = OwnHeight::new(&equation.tip, d);
        let (values, slopes) = (own_height.values(), own.slopes());
        let (weighted, changing, times) = (carved.weighted(), carved.by_height(), carved.times);
        let alpha = equation.alpha;
        let (mut groove, mut rate) = ([0.0; STAGES], [0.0; STAGES]);
        own_height.add(&weighted, &mut groove);
        own_height.add(carved.rate().as_ref().unwrap_or(&weighted), &mut rate);
        let groove = Vector::from_fn(|i, _| history[i] + groove[i] * times);
        let groove_rate = Vector::from_fn(|i, _| rate[i] + carved.fading()[i] * history[i]);
        let q = Square::from_fn(|i, k| alpha * changing[i][k] * values[i][k]) + Square::identity();
        let inverse = q.lu().try_inverse()?;
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

    /// Reduction of the slope of the force, as the heights follow the displacements.
    pub(super) fn stiffness(&self) -> Square {
        self.pull * self.by_displacement
    }

    /// Change of the force for this change of g.
    pub(super) fn force(&self, groove: &Vector) -> Vector {
        self.pull * (self.inverse * (groove * -self.alpha))
    }

    /// Change of the force for the change of g with the step length.
    pub(super) fn force_by_length(&self) -> Vector {
        self.force(&self.groove_rate)
    }

    /// Change of the force with α through the heights.
    pub(super) fn force_by_alpha(&self) -> Vector {
        -(self.pull * (self.inverse * self.groove))
    }

    /// Change of the force by the residual of the heights.
    pub(super) fn force_missed(&self) -> Vector {
        self.pull * (self.inverse * self.missed)
    }

    /// Appends the changes of the heights, from those of g with the state and those of the displacements.
    pub(super) fn follow(
        &self,
        by_state: &[Vector],
        (free, share): (Parameter, f64),
        state: &Sensitivity,
        (stages, heights): (&Sensitivity, &mut Sensitivity),
    ) {
        let follows = |groove: &Vector| Stages::from(self.inverse * (groove * -self.alpha));
        let factors: Vec<Stages> = by_state.iter().map(follows).collect();
        let by_parameter = match free {
            Parameter::Alpha => -(self.inverse * self.groove),
            Parameter::R => Vector::zeros(),
        };
        let by_length = self.inverse * (self.groove_rate * (-self.alpha * share));
        let constants = [by_length, by_parameter, -(self.inverse * self.missed)];
        heights.append_contracted(state, &factors, &constants);
        let less: [Stages; STAGES] =
            std::array::from_fn(|i| std::array::from_fn(|k| -self.by_displacement[(i, k)]));
        heights.add_to_last(&less, stages);
    }
}
