//! The depth limit (61) within a step, with the heights under the tip as further unknowns.
//!
//! ```text
//!     η_i = outside_i - α (past_i + Σ_k b_ik w_k f(d_i - d_k))        w_k = e^{-|η_k|/b}
//! ```
//!
//! with b = hA; the contribution of the step to the groove contains the same w. |η| has a kink at 0. A step stays on
//! one side of it, where w is the smooth e^{-ση/b}, and the integrator ends steps where η = 0.

use super::law::Equations;
use super::linear_system::Factors;
use super::own::{Matrix, OwnGroove, OwnHeight};
use crate::collocation::{STAGES, Stages};
use crate::elementary::exp;

/// b of (61), and the side of the kink: σ = 1 above 0, -1 below.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Depth {
    /// Depth limit b, in kσ²/a.
    pub limit: f64,
    /// Side σ of the kink, 1 or -1.
    pub side: f64,
}

/// Data at the stages in addition to their displacements: slopes, curvatures, heights.
#[derive(Debug, Clone, Copy, Default)]
pub struct Known {
    /// ∫ f' over the undecayed past.
    pub past_slope: Stages,
    /// ∫ f'' over the undecayed past.
    pub past_curvature: Stages,
    /// ∫ f over the undecayed past.
    pub past_height: Stages,
    /// Undecayed part of the slope of the initial surface.
    pub relief_slope: Stages,
    /// Undecayed part of the curvature of the initial surface.
    pub relief_curvature: Stages,
    /// Undecayed part of the height of the initial surface.
    pub relief_height: Stages,
}

/// Residuals of the equations at given displacements and heights.
#[derive(Debug, Clone, Copy, Default)]
pub struct StageResiduals {
    /// Residual d - hAv of the displacements.
    pub displacement: Stages,
    /// Residual of the heights: η minus the right-hand side of the equation for η.
    pub height: Stages,
}

/// The Jacobian of both residuals, factored by blocks.
pub struct LimitedFactors {
    height: Factors,
    /// ∂(residual of heights)/∂d
    height_by_displacement: Matrix,
    /// ∂(residual of displacements)/∂η
    displacement_by_height: Matrix,
    /// The Schur complement for the displacements, after elimination of the heights.
    displacement: Factors,
}

impl Known {
    /// Multiplies past and relief by their undecayed parts at each stage.
    pub(crate) fn fade(&mut self, past: &Stages, relief: &Stages) {
        let scale = |told: &mut Stages, left: &Stages| {
            told.iter_mut().zip(left).for_each(|(told, left)| *told *= left);
        };
        scale(&mut self.past_slope, past);
        scale(&mut self.past_curvature, past);
        scale(&mut self.past_height, past);
        scale(&mut self.relief_slope, relief);
        scale(&mut self.relief_curvature, relief);
        scale(&mut self.relief_height, relief);
    }
}

impl Depth {
    /// w at the heights of the stages.
    pub fn weights(&self, height: &Stages) -> Stages {
        height.map(|height| exp(-self.side * height / self.limit))
    }

    /// Residuals of displacements and heights.
    pub fn missed(
        &self,
        equations: &Equations,
        (d, height): (&Stages, &Stages),
        known: &Known,
        (own, own_height): (&OwnGroove, &OwnHeight),
    ) -> StageResiduals {
        let weights = self.weights(height);
        let carving = by_columns(equations.carving(), &weights);
        let slopes = (&known.past_slope, &known.relief_slope);
        let velocity = equations.velocity_with(&carving, d, slopes, own);
        let mut groove = known.past_height;
        own_height.add(&carving, &mut groove);
        let alpha = equations.alpha();
        StageResiduals {
            displacement: equations.residual(d, &velocity),
            height: std::array::from_fn(|i| height[i] - known.relief_height[i] + alpha * groove[i]),
        }
    }

    /// The Jacobian of [`missed`](Self::missed); `None` if it is singular.
    pub fn factors(
        &self,
        equations: &Equations,
        height: &Stages,
        known: &Known,
        (own, own_height): (&OwnGroove, &OwnHeight),
    ) -> Option<LimitedFactors> {
        let weights = self.weights(height);
        let indenting = by_columns(&equations.indenting(), &weights);
        let curvatures = (&known.past_curvature, &known.relief_curvature);
        let by_displacement = equations.jacobian_with(&indenting, curvatures, own);
        // ∂w/∂η = -σ w/b
        let by_height = weights.map(|w| -self.side * w / self.limit);
        let changing = by_columns(&equations.indenting(), &by_height);
        let (slopes, values) = (own.slopes(), own_height.values());
        let displacement_by_height =
            equations.less_carried([[0.0; STAGES]; STAGES], &products(&changing, &slopes));
        let mut own_by_height = products(&changing, &values);
        for (i, row) in own_by_height.iter_mut().enumerate() {
            row[i] += 1.0;
        }
        let height_by_displacement = self.height_slopes(equations, known, &indenting, &slopes);
        let height = Factors::of(own_by_height)?;
        let mut reduced = by_displacement;
        let eliminated = height.solve_columns(&height_by_displacement);
        for (row, by) in reduced.iter_mut().zip(&displacement_by_height) {
            for k in 0..STAGES {
                row[k] -= (0..STAGES).map(|j| by[j] * eliminated[j][k]).sum::<f64>();
            }
        }
        let displacement = Factors::of(reduced)?;
        Some(LimitedFactors {
            height,
            height_by_displacement,
            displacement_by_height,
            displacement,
        })
    }

    /// ∂(residual of heights)/∂d: minus the slope of the surface under the tip, and the contributions that move with
    /// each stage.
    fn height_slopes(
        &self,
        equations: &Equations,
        known: &Known,
        indenting: &Matrix,
        slopes: &Matrix,
    ) -> Matrix {
        let own = products(indenting, slopes);
        let mut derivatives = own.map(|row| row.map(|entry| -entry));
        for i in 0..STAGES {
            let here: f64 = own[i].iter().sum();
            derivatives[i][i] +=
                equations.alpha() * known.past_slope[i] - known.relief_slope[i] + here;
        }
        derivatives
    }
}

impl LimitedFactors {
    /// Newton's corrections, to be subtracted.
    pub fn corrections(&self, missed: &StageResiduals) -> StageResiduals {
        let by_height = self.height.solve(&missed.height);
        let right = std::array::from_fn(|i| {
            let through = self.displacement_by_height[i].iter().zip(&by_height);
            missed.displacement[i] - through.map(|(a, b)| a * b).sum::<f64>()
        });
        let displacement = self.displacement.solve(&right);
        let left = std::array::from_fn(|i| {
            let through = self.height_by_displacement[i].iter().zip(&displacement);
            missed.height[i] - through.map(|(a, b)| a * b).sum::<f64>()
        });
        StageResiduals { displacement, height: self.height.solve(&left) }
    }
}

/// The matrix with each column multiplied by a factor.
fn by_columns(matrix: &Matrix, factors: &Stages) -> Matrix {
    matrix.map(|row| std::array::from_fn(|k| row[k] * factors[k]))
}

/// The product of two matrices, entry by entry.
fn products(a: &Matrix, b: &Matrix) -> Matrix {
    std::array::from_fn(|i| std::array::from_fn(|k| a[i][k] * b[i][k]))
}

#[cfg(test)]
mod tests {
    use super::super::inertia::Inertia;
    use super::super::law::Law;
    use super::*;
    use crate::TipFunction;
    use crate::collocation::RADAU;

    /// A past and a relief of known heights, slopes and curvatures.
    fn known(d: &Stages) -> Known {
        Known {
            past_slope: d.map(|d| 0.6 * (0.7 * d + 0.2).cos()),
            past_curvature: d.map(|d| -0.42 * (0.7 * d + 0.2).sin()),
            past_height: d.map(|d| 0.6 / 0.7 * (0.7 * d + 0.2).sin()),
            relief_slope: d.map(|d| 0.3 * d * d),
            relief_curvature: d.map(|d| 0.6 * d),
            relief_height: d.map(|d| 0.1 * d * d * d - 2.0),
        }
    }

    /// A Newton step from far is compared with one by differences: blocks and signs.
    #[test]
    fn corrections_are_those_of_the_whole_jacobian() {
        let tip = TipFunction::triple_gaussian(1.0, 1.0).unwrap();
        let law = Law { alpha: 1.3, r: 0.8, spring: 1.0 };
        for (time, mass) in [(None, None), (Some(0.9), Some(0.4))] {
            let (h, depth) = (0.6, Depth { limit: 1.7, side: -1.0 });
            let inertia = mass.map(|mass| Inertia::new(mass, h, 0.7));
            let equations = Equations::new(law, h, law.pull(0.9, h), time, inertia.as_ref());
            let d: Stages = RADAU.c.map(|c| 0.8 * c * (1.0 - 0.4 * c));
            let height: Stages = RADAU.c.map(|c| -1.8 - 0.9 * c);
            let missed = |d: &Stages, height: &Stages| {
                let own = (OwnGroove::new(&tip, d), OwnHeight::new(&tip, d));
                depth.missed(&equations, (d, height), &known(d), (&own.0, &own.1))
            };
            let own = (OwnGroove::new(&tip, &d), OwnHeight::new(&tip, &d));
            let factors = depth.factors(&equations, &height, &known(&d), (&own.0, &own.1)).unwrap();
            let step = factors.corrections(&missed(&d, &height));
            // The Jacobian times the corrections is what was missed: by a difference along them.
            let along = |by: f64| {
                let d = std::array::from_fn(|i| d[i] + by * step.displacement[i]);
                missed(&d, &std::array::from_fn(|i| height[i] + by * step.height[i]))
            };
            let (e, wanted) = (1e-3, missed(&d, &height));
            let points = [along(e), along(-e), along(2.0 * e), along(-2.0 * e)];
            for i in 0..STAGES {
                let by = |part: fn(&StageResiduals) -> &Stages| {
                    let p = points.map(|m| part(&m)[i]);
                    (8.0 * (p[0] - p[1]) - (p[2] - p[3])) / (12.0 * e)
                };
                let (d, height) = (by(|m| &m.displacement), by(|m| &m.height));
                assert!((d - wanted.displacement[i]).abs() < 1e-9, "{i} {d}");
                assert!((height - wanted.height[i]).abs() < 1e-9, "{i} {height}");
            }
        }
    }
}
