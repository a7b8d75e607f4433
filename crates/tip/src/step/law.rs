//! The velocity of the tip, and the equations for the stages of a step.

use super::healing::healing;
use super::inertia::Inertia;
use super::own::{Matrix, OwnGroove, carving};
use crate::Model;
use crate::collocation::{RADAU, STAGES, Stages, apply};

/// The force on a tip, (15), as a function of its position: α g - u0' + p - κd, with g = ∫ f' over the past. Without
/// inertia it equals the velocity of the tip.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Law {
    /// Indentation rate α.
    pub alpha: f64,
    /// Velocity of the support: r, if it is constant.
    pub r: f64,
    /// κ: 1, or 0 without a spring.
    pub spring: f64,
}

impl Law {
    /// The law of a model.
    pub fn of(model: &Model) -> Self {
        let spring = if model.wider().spring { 1.0 } else { 0.0 };
        Self { alpha: model.alpha(), r: model.r(), spring }
    }

    /// The pull of the support at the nodes on a tip that stays at its start position. The spring has the extension
    /// `extension` at the start of the step, and rh c more at the node c.
    #[inline]
    pub fn pull(&self, extension: f64, h: f64) -> Stages {
        RADAU.c.map(|c| self.spring * (extension + self.r * h * c))
    }

    /// Velocity at a displacement d with this pull, and these slopes of relief and groove.
    #[inline]
    pub fn velocity(&self, pull: f64, d: f64, relief: f64, groove: f64) -> f64 {
        pull - self.spring * d - relief + self.alpha * groove
    }

    /// ∂v/∂d, for these curvatures of relief and groove.
    #[inline]
    pub fn velocity_slope(&self, relief: f64, groove: f64) -> f64 {
        self.alpha * groove - relief - self.spring
    }
}

/// The equations of one step, d = hAv.
#[derive(Debug, Clone)]
pub struct Equations<'a> {
    law: Law,
    h: f64,
    /// κ(R - x0(start)) and forces at the nodes: the part of the velocity that does not depend on d.
    pull: Stages,
    /// hA, or its counterpart with healing.
    carving: Matrix,
    heals: bool,
    inertia: Option<&'a Inertia>,
}

impl<'a> Equations<'a> {
    /// The equations of a step of length h with this pull, for a surface with a healing time and a tip with inertia.
    #[inline]
    pub fn new(
        law: Law,
        h: f64,
        pull: Stages,
        healing_time: Option<f64>,
        inertia: Option<&'a Inertia>,
    ) -> Self {
        let carving = healing_time.map_or_else(|| carving(h), |time| healing(h, time));
        Self { law, h, pull, carving, heals: healing_time.is_some(), inertia }
    }

    /// Weights of each stage in the groove at each stage; the last row belongs to the end of the step.
    pub fn carving(&self) -> &Matrix {
        &self.carving
    }

    /// The matrix of [`carving`](Self::carving), multiplied by α.
    pub fn indenting(&self) -> Matrix {
        if self.heals {
            return self.carving.map(|row| row.map(|b| self.law.alpha * b));
        }
        carving(self.law.alpha * self.h)
    }

    /// α
    pub(super) fn alpha(&self) -> f64 {
        self.law.alpha
    }

    /// The force at the stages, which is v without inertia. `past` and `relief` are the slopes of the groove before
    /// the step and of the initial surface.
    #[inline]
    pub fn velocity(&self, d: &Stages, past: &Stages, relief: &Stages, own: &OwnGroove) -> Stages {
        self.velocity_with(&self.carving, d, (past, relief), own)
    }

    /// As [`velocity`](Self::velocity), with another matrix of weights.
    #[inline]
    pub(super) fn velocity_with(
        &self,
        carving: &Matrix,
        d: &Stages,
        (past, relief): (&Stages, &Stages),
        own: &OwnGroove,
    ) -> Stages {
        let mut groove = *past;
        own.add_slope(carving, &mut groove);
        std::array::from_fn(|i| self.law.velocity(self.pull[i], d[i], relief[i], groove[i]))
    }

    /// d - hAv, or its counterpart with inertia.
    #[inline]
    pub fn residual(&self, d: &Stages, velocity: &Stages) -> Stages {
        if let Some(inertia) = self.inertia {
            return inertia.residual(d, velocity);
        }
        let carried = apply(&RADAU.a, velocity);
        std::array::from_fn(|i| d[i] - self.h * carried[i])
    }

    /// 1 - hA ∂v/∂d, for these curvatures.
    #[inline]
    pub fn jacobian(&self, past: &Stages, relief: &Stages, own: &OwnGroove) -> Matrix {
        self.jacobian_with(&self.indenting(), (past, relief), own)
    }

    /// As [`jacobian`](Self::jacobian), with another matrix instead of [`indenting`](Self::indenting).
    #[inline]
    pub(super) fn jacobian_with(
        &self,
        indenting: &Matrix,
        (past, relief): (&Stages, &Stages),
        own: &OwnGroove,
    ) -> Matrix {
        let mut derivatives = [[0.0; STAGES]; STAGES];
        for (i, row) in derivatives.iter_mut().enumerate() {
            row[i] = self.law.velocity_slope(relief[i], past[i]);
        }
        own.add_derivatives(indenting, &mut derivatives);
        let mut jacobian = [[0.0; STAGES]; STAGES];
        jacobian.iter_mut().enumerate().for_each(|(i, row)| row[i] = 1.0);
        self.less_carried(jacobian, &derivatives)
    }

    /// A matrix minus hA times a matrix of derivatives of the force.
    #[inline]
    pub(super) fn less_carried(&self, mut matrix: Matrix, derivatives: &Matrix) -> Matrix {
        let (carried, h) = match self.inertia {
            None => (&RADAU.a, self.h),
            Some(inertia) => (inertia.carried(), 1.0),
        };
        for (row, carried) in matrix.iter_mut().zip(carried) {
            for (a, derivatives) in carried.iter().zip(derivatives) {
                let factor = h * a;
                row.iter_mut().zip(derivatives).for_each(|(entry, d)| *entry -= factor * d);
            }
        }
        matrix
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::TipFunction;
    use crate::tip_function::Apex;

    /// A past and a relief with known derivatives, by displacement.
    fn past(d: f64) -> (f64, f64) {
        ((0.7 * d + 0.2).sin(), 0.7 * (0.7 * d + 0.2).cos())
    }

    fn relief(d: f64) -> (f64, f64) {
        (0.3 * d * d - 0.1, 0.6 * d)
    }

    #[test]
    fn the_jacobian_is_that_of_the_residual() {
        let tip = TipFunction::triple_gaussian(1.0, 1.0).unwrap();
        let law = Law { alpha: 1.3, r: 0.8, spring: 1.0 };
        for (h, length) in [(0.4, 0.3), (3.0, 2.5), (0.01, -1.0)] {
            let equations = Equations::new(law, h, law.pull(0.9, h), None, None);
            let d: Stages = RADAU.c.map(|c| length * c * (1.0 - 0.4 * c));
            let residual = |d: &Stages| {
                let (past, relief) = (d.map(|d| past(d).0), d.map(|d| relief(d).0));
                let velocity = equations.velocity(d, &past, &relief, &OwnGroove::new(&tip, d));
                equations.residual(d, &velocity)
            };
            let (past, relief) = (d.map(|d| past(d).1), d.map(|d| relief(d).1));
            let jacobian = equations.jacobian(&past, &relief, &OwnGroove::new(&tip, &d));
            for k in 0..STAGES {
                let moved = |by: f64| {
                    let mut d = d;
                    d[k] += by;
                    residual(&d)
                };
                let step = 1e-3;
                let (near, far) =
                    ([moved(step), moved(-step)], [moved(2.0 * step), moved(-2.0 * step)]);
                for i in 0..STAGES {
                    let difference = 8.0 * (near[0][i] - near[1][i]) - (far[0][i] - far[1][i]);
                    let difference = difference / (12.0 * step);
                    let miss = (jacobian[i][k] - difference).abs();
                    assert!(miss < 1e-10 * (1.0 + h), "{h} {i} {k}: {miss:e}");
                }
            }
        }
    }

    #[test]
    fn the_polynomial_of_the_apex_gives_the_same_equations() {
        let tip = TipFunction::triple_gaussian(0.5, 1.0).unwrap();
        let (apex, law) = (Apex::new(&tip, 1e-14), Law { alpha: 1.3, r: 0.8, spring: 1.0 });
        let equations = Equations::new(law, 0.5, law.pull(0.9, 0.5), None, None);
        // Near, and beyond where any polynomial holds.
        for length in [0.1, 1.0, 30.0] {
            let d = RADAU.c.map(|c| length * c);
            let (a, b) = (OwnGroove::near(&apex, &tip, &d), OwnGroove::new(&tip, &d));
            let zero = [0.0; STAGES];
            let (va, vb) = (
                equations.velocity(&d, &zero, &zero, &a),
                equations.velocity(&d, &zero, &zero, &b),
            );
            let (ja, jb) =
                (equations.jacobian(&zero, &zero, &a), equations.jacobian(&zero, &zero, &b));
            for i in 0..STAGES {
                assert!((va[i] - vb[i]).abs() < 1e-13, "{length} {i}");
                for k in 0..STAGES {
                    assert!((ja[i][k] - jb[i][k]).abs() < 1e-11, "{length} {i} {k}");
                }
            }
        }
    }
}
