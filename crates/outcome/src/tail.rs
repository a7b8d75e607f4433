//! The last steps of a run. Each takes only the room that its numbers need, as the integrator runs beside them in the
//! same cache.

use std::collections::VecDeque;
use stickslip_tip::{Heights, Stages, Step};

/// The last steps, all of them with heights or none.
#[derive(Debug, Clone, Default)]
pub(crate) struct Tail {
    motions: VecDeque<Motion>,
    /// Heights of each step under a depth limit, empty without one.
    heights: VecDeque<Heights>,
}

/// A step without its heights.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Motion {
    pub(crate) t: f64,
    h: f64,
    pub(crate) extension: f64,
    displacement: Stages,
}

impl Tail {
    pub(crate) fn push(&mut self, step: &Step) {
        let Step { t, h, extension, displacement, height } = *step;
        self.motions.push_back(Motion { t, h, extension, displacement });
        if let Some(height) = height {
            self.heights.push_back(height);
        }
    }

    /// Removes the first step.
    pub(crate) fn pop(&mut self) {
        self.motions.pop_front();
        self.heights.pop_front();
    }

    pub(crate) fn len(&self) -> usize {
        self.motions.len()
    }

    /// The step at index i, without its heights.
    pub(crate) fn motion(&self, i: usize) -> Option<&Motion> {
        self.motions.get(i)
    }

    pub(crate) fn last(&self) -> Option<Step> {
        Some(self.motions.back()?.with(self.heights.back()))
    }

    pub(crate) fn steps(&self) -> Vec<Step> {
        (0..).zip(&self.motions).map(|(i, motion)| motion.with(self.heights.get(i))).collect()
    }

    /// The tail of these steps; `None` if only some have heights.
    pub(crate) fn of(steps: &[Step]) -> Option<Self> {
        let mut tail = Self::default();
        steps.iter().for_each(|step| tail.push(step));
        (tail.heights.is_empty() || tail.heights.len() == tail.len()).then_some(tail)
    }
}

impl Motion {
    fn with(&self, height: Option<&Heights>) -> Step {
        let Self { t, h, extension, displacement } = *self;
        Step { t, h, extension, displacement, height: height.copied() }
    }
}
