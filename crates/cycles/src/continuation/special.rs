//! Points of a branch where something happens to its cycles.

use crate::{Cycle, Parameter};

/// A point where something happens to the cycles of a branch.
#[derive(Debug, Clone)]
pub struct Special {
    /// What.
    pub kind: SpecialKind,
    /// α
    pub alpha: f64,
    /// r
    pub r: f64,
    /// T
    pub period: f64,
    /// The cycle there, at a period halving that of half the period; `None` at a Hopf point.
    pub cycle: Option<Cycle>,
}

/// Kinds of special points.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SpecialKind {
    /// The cycle vanishes into steady motion.
    Hopf,
    /// The branch turns back in its parameter.
    Fold,
    /// A multiplier passes -1: a branch of twice the period begins.
    PeriodDoubling,
    /// The branch joins one of half the period, where that doubles it.
    PeriodHalving,
    /// A second multiplier passes 1, and the branch does not turn: another branch crosses.
    BranchPoint,
    /// A complex pair crosses the unit circle: a torus is born.
    Torus,
}

impl Special {
    pub(super) fn of(kind: SpecialKind, cycle: Cycle) -> Self {
        let (alpha, r) = (cycle.model().alpha(), cycle.model().r());
        Self { kind, alpha, r, period: cycle.period(), cycle: Some(cycle) }
    }

    /// The parameter.
    #[must_use]
    pub fn parameter(&self, which: Parameter) -> f64 {
        match which {
            Parameter::Alpha => self.alpha,
            Parameter::R => self.r,
        }
    }
}
