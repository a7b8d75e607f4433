//! Special points of a branch: bifurcations and folds.

use crate::{Cycle, Parameter};

/// A bifurcation or fold on a branch.
#[derive(Debug, Clone)]
pub struct Special {
    /// Kind of the point.
    pub kind: SpecialKind,
    /// α
    pub alpha: f64,
    /// r
    pub r: f64,
    /// Period T.
    pub period: f64,
    /// The cycle at this point; at a period halving, the one of half the period; `None` at a Hopf point.
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
    /// The branch joins a branch of half the period, at a period doubling of the latter.
    PeriodHalving,
    /// A second multiplier passes 1, and the branch does not turn: another branch crosses.
    BranchPoint,
    /// A complex pair crosses the unit circle: a torus bifurcates.
    Torus,
}

impl Special {
    pub(super) fn of(kind: SpecialKind, cycle: Cycle) -> Self {
        let (alpha, r) = (cycle.model().alpha(), cycle.model().r());
        Self { kind, alpha, r, period: cycle.period(), cycle: Some(cycle) }
    }

    /// The value of the parameter at this point.
    pub fn parameter(&self, which: Parameter) -> f64 {
        match which {
            Parameter::Alpha => self.alpha,
            Parameter::R => self.r,
        }
    }
}
