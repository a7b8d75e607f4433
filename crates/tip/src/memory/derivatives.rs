//! The groove at the tip as a power series of the place.

/// Derivatives that are told of at most.
pub const ROOM: usize = 32;

/// All of the groove near the tip, n = 0, 1, …: what [`Memory::derivatives`](super::Memory::derivatives) tells.
#[derive(Debug, Clone)]
pub struct Derivatives {
    /// Derivatives of f at 0, on the side of the past: what a visit of the time 1 just now adds to `past`.
    pub of_tip: [f64; ROOM],
    /// ∫ f⁽ⁿ⁾(tip - x0(t'))dt' over the past.
    pub past: [f64; ROOM],
    /// The farthest point that the tip has been to, as a displacement from it; -∞ if it has not been anywhere.
    pub farthest: f64,
    /// How far behind its farthest point it may retreat.
    pub retreat: f64,
}

/// The past of a tip that moved steadily for ever, until it was somewhere.
#[derive(Debug, Clone, Copy)]
pub struct SteadyPast {
    /// How far the tip has moved on from there.
    pub distance: f64,
    /// The velocity that it had.
    pub velocity: f64,
    /// 1/T, 0 where nothing heals.
    pub healing: f64,
    /// w0, times what is left of it.
    pub weight: f64,
}

impl Derivatives {
    /// Nothing known yet.
    #[must_use]
    pub fn nothing() -> Self {
        Self { of_tip: [0.0; ROOM], past: [0.0; ROOM], farthest: f64::NEG_INFINITY, retreat: 0.0 }
    }
}
