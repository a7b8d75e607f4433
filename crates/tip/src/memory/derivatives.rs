//! The groove near the tip as a power series of the position.

use crate::TipFunction;

/// Largest number of derivatives.
pub const ROOM: usize = 32;

/// Derivatives of the groove at the tip, n = 0, 1, …: the result of
/// [`Policy::derivatives`](crate::memory::Policy::derivatives).
#[derive(Debug, Clone)]
pub struct Derivatives {
    /// ∫ f⁽ⁿ⁾(tip - x0(t'))dt' over the past.
    pub past: [f64; ROOM],
    /// The farthest-forward point of the past, as a displacement from the tip; -∞ without a past.
    pub farthest: f64,
    /// Allowed distance of the tip behind `farthest`.
    pub retreat: f64,
    /// Scratch space for the memories.
    pub(super) room: Vec<f64>,
}

/// The infinite past of a tip in steady motion up to a given point.
#[derive(Debug, Clone, Copy)]
pub struct SteadyPast {
    /// Distance that the tip has moved since the end of the steady motion.
    pub distance: f64,
    /// Velocity of the steady motion.
    pub velocity: f64,
    /// 1/T; 0 without healing.
    pub healing: f64,
    /// w0, multiplied by its undecayed part.
    pub weight: f64,
}

impl SteadyPast {
    /// Height, slope and curvature of the groove at a displacement from the tip: those of (w0/v) φ, where the profile φ
    /// of steady motion obeys φ' = sφ - f with s = 1/(vT).
    pub(crate) fn groove(&self, tip: &TipFunction, displacement: f64) -> [f64; 3] {
        let (x, s) = (displacement + self.distance, self.healing / self.velocity);
        if tip.reach().is_some_and(|reach| x >= reach) {
            return [0.0; 3];
        }
        let density = self.weight / self.velocity;
        let profile = tip.fading_tail(x, s);
        let (value, slope) = tip.value_and_slope(x);
        let steep = s * profile - value;
        [profile, steep, s * steep - slope].map(|value| density * value)
    }
}

impl Derivatives {
    /// No past.
    pub fn nothing() -> Self {
        Self { past: [0.0; ROOM], farthest: f64::NEG_INFINITY, retreat: 0.0, room: vec![] }
    }
}
