//! Displacement of a tip with inertia, from the force on it.

use super::healing::{columns, implicit};
use super::own::Matrix;
use crate::collocation::{RADAU, STAGES, Stages, apply};

/// Collocation of M v' + v = φ, x' = v with the Butcher matrix A: v = S(v(start) + (hA/M)φ) with S = (1 + hA/M)⁻¹, and
/// d = hAv. So d is linear in the force φ at the stages, and one unknown per stage is sufficient.
#[derive(Debug, Clone)]
pub struct Inertia {
    /// hA S hA/M: derivative of d by φ.
    carried: Matrix,
    /// hA S v(start): displacement without a force.
    glide: Stages,
}

impl Inertia {
    /// The equations of a step of length h with this velocity at its start.
    pub fn new(mass: f64, h: f64, velocity: f64) -> Self {
        let share = h / mass;
        let factors = implicit(share);
        let along = |v: Stages| apply(&RADAU.a, &v).map(|d| h * d);
        let by_force = |k: usize| factors.solve(&std::array::from_fn(|i| share * RADAU.a[i][k]));
        Self {
            carried: columns(|k| along(by_force(k))),
            glide: along(factors.solve(&[velocity; STAGES])),
        }
    }

    /// d minus its value from force and initial velocity.
    pub(crate) fn residual(&self, d: &Stages, force: &Stages) -> Stages {
        let carried = apply(&self.carried, force);
        std::array::from_fn(|i| d[i] - self.glide[i] - carried[i])
    }

    /// Displacements d at the stages without a force.
    pub fn glide(&self) -> &Stages {
        &self.glide
    }

    /// Derivative of the displacements d with respect to the force.
    pub fn carried(&self) -> &Matrix {
        &self.carried
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// M v' + v = cos t from v0 has a closed solution.
    #[test]
    fn a_tip_glides_as_its_differential_equation_says() {
        for (mass, h, start) in [(0.3, 0.1, 2.0), (10.0, 0.3, -1.0), (1e-8, 0.05, 1.0)] {
            let force = RADAU.c.map(|c| (h * c).cos());
            let inertia = Inertia::new(mass, h, start);
            let d = inertia.residual(&[0.0; STAGES], &force).map(|d| -d);
            let size: f64 = 1.0 + mass * mass;
            let free = start - 1.0 / size;
            for (c, d) in RADAU.c.iter().zip(d) {
                let t = h * c;
                let forced = (t.sin() + mass * (1.0 - t.cos())) / size;
                let exact = forced - free * mass * (-t / mass).exp_m1();
                assert!((d - exact).abs() < 1e-7 * (1.0 + start.abs()), "{mass} {c}: {d} {exact}");
            }
        }
    }
}
