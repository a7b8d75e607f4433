//! Changes of all unknowns of a cycle, and directions in this space.

use stickslip_tip::collocation::Stages;

/// A linear functional of the quantities that define the position on a branch of cycles: the largest l, the period and
/// the parameter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Direction {
    pub(super) l: f64,
    pub(super) period: f64,
    pub(super) parameter: f64,
}

impl Direction {
    /// The parameter alone.
    pub(super) const PARAMETER: Self = Self { l: 0.0, period: 0.0, parameter: 1.0 };
    /// The largest l alone.
    pub(super) const L: Self = Self { l: 1.0, period: 0.0, parameter: 0.0 };

    pub(super) fn of(&self, change: &Change) -> f64 {
        self.l * change.state[0] + self.period * change.period + self.parameter * change.parameter
    }

    pub(super) fn times(&self, factor: f64) -> Self {
        let Self { l, period, parameter } = *self;
        Self { l: factor * l, period: factor * period, parameter: factor * parameter }
    }
}

/// A change of all unknowns.
#[derive(Debug, Clone)]
pub(super) struct Change {
    /// Change of the state X at t = 0.
    pub(super) state: Vec<f64>,
    pub(super) period: f64,
    pub(super) parameter: f64,
    pub(super) stages: Vec<Stages>,
    /// Changes of the heights under the tip, under a depth limit.
    pub(super) heights: Vec<Stages>,
}

impl Change {
    pub(super) fn times(mut self, factor: f64) -> Self {
        let stages = self.stages.iter_mut().chain(&mut self.heights).flatten();
        self.state.iter_mut().chain(stages).for_each(|c| *c *= factor);
        self.period *= factor;
        self.parameter *= factor;
        self
    }

    /// Largest change of a position.
    pub(super) fn size(&self) -> f64 {
        let stages = self.stages.iter().flatten();
        stages.chain(&self.state[..1]).fold(0.0, |m: f64, d| m.max(d.abs()))
    }

    pub(super) fn of_heights(&self) -> f64 {
        self.heights.iter().flatten().fold(0.0, |m: f64, change| m.max(change.abs()))
    }
}
