//! Displacements in a step as a linear function of the force at its stages.

use super::blocks::{Square, Vector, inverted};
use std::sync::LazyLock;
use stickslip_tip::Wider;
use stickslip_tip::collocation::{RADAU, STAGES};
use stickslip_tip::step::{Inertia, healing_rate};

/// d = `by_force` times the force (hA without inertia) + `glide`, with the derivatives with respect to the step
/// length.
pub(super) struct Carrying {
    pub(super) by_force: Square,
    /// The inverse of `by_force`.
    pub(super) to_force: Square,
    pub(super) by_force_rate: Square,
    /// Displacement without a force; 0 without inertia.
    pub(super) glide: Vector,
    pub(super) glide_rate: Vector,
    /// With inertia: displacement at the velocity 1.
    pub(super) by_velocity: Option<Vector>,
}

/// A and its inverse.
static BUTCHER: LazyLock<(Square, Square)> = LazyLock::new(|| {
    let a = Square::from_fn(|i, k| RADAU.a[i][k]);
    (a, inverted(a).expect("the matrix of Radau IIA is regular"))
});

impl Carrying {
    /// The matrices of a step of length h that begins with this velocity; `None` if they are singular.
    pub(super) fn new(wider: &Wider, h: f64, velocity: f64) -> Option<Self> {
        let (a, inverse) = *BUTCHER;
        let Some(mass) = wider.inertia else {
            let (by_force, to_force, by_force_rate) = (a * h, inverse / h, a);
            let still = Vector::zeros();
            let (glide, glide_rate, by_velocity) = (still, still, None);
            return Some(Self {
                by_force,
                to_force,
                by_force_rate,
                glide,
                glide_rate,
                by_velocity,
            });
        };
        // A force carries by hA - H, a velocity by H = (1 + hA/M)⁻¹hA: what would fade within M.
        let unit = Inertia::new(mass, h, 1.0);
        let carried = unit.carried();
        let rate = healing_rate(h, mass);
        let rate = Square::from_fn(|i, k| rate[i][k]);
        let glide = Vector::from(*unit.glide());
        let glide_rate = rate * Vector::from([1.0; STAGES]);
        let by_force = Square::from_fn(|i, k| carried[i][k]);
        Some(Self {
            by_force,
            to_force: inverted(by_force)?,
            by_force_rate: a - rate,
            glide: glide * velocity,
            glide_rate: glide_rate * velocity,
            by_velocity: Some(glide),
        })
    }
}
