//! Which way the next step is made.
//!
//! A step by series costs a fraction of one by collocation, but where the groove is stiff it is no longer than a few
//! times 1/K, K the stiffness, however smooth the motion is, while collocation is as long as the motion allows. What
//! fades as e^{-Kt} has the coefficients (-K)^k/k!, so that a series gets the farther beyond 1/K the less there is of
//! that: a long step over 1/K says that nothing moves so fast any more. Then collocation is tried, and its own lengths
//! say whether it stays; where it does not, it is the longer until the next trial.

use crate::state::{Damaged, Reader, State};

/// The way in use.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Switch {
    /// What a step of collocation costs, over one by series.
    cost: f64,
    collocation: bool,
    /// Steps of the way in use that are to be made before the other is tried.
    wait: u64,
    /// Steps by series until the next trial, should the one under way fail.
    patience: u64,
    /// Whether the last step was by series.
    in_series: bool,
}

/// What a step of collocation costs, over one by series; with inertia, where it takes more iterations.
const COST: f64 = 4.0;
const COST_WITH_INERTIA: f64 = 8.0;
/// Reach of a series of order p where the groove is stiff, in units of p/K.
const REACH: f64 = 0.25;
/// Steps of collocation before it is judged: their lengths grow from one to the next.
const TRIAL: u64 = 8;
/// Steps by series before the first trial, and at most between two.
const PATIENCE: (u64, u64) = (8, 1 << 10);

impl Switch {
    pub(crate) fn new(has_inertia: bool) -> Self {
        Self::at_cost(if has_inertia { COST_WITH_INERTIA } else { COST })
    }

    /// Cost of a step of collocation, in steps by series.
    pub(crate) fn at_cost(cost: f64) -> Self {
        let (patience, _) = PATIENCE;
        Self { cost, collocation: false, wait: patience, patience, in_series: false }
    }

    /// Whether the next step is to be tried by series.
    pub(crate) fn is_to_series(&self) -> bool {
        !self.collocation
    }

    /// Whether collocation is to take over from a series of this order, that is as long as accuracy allows and
    /// of this stiffness over its length; `most` is that over the longest step that collocation could make.
    pub(crate) fn leaves(&mut self, stiffness: f64, most: f64, order: usize) -> bool {
        if stiffness < REACH * order as f64 || !self.is_ahead(most, order) {
            return false;
        }
        if self.wait > 0 {
            self.wait -= 1;
            return false;
        }
        (self.collocation, self.wait) = (true, TRIAL);
        true
    }

    /// A step by series has been made.
    pub(crate) fn made_series(&mut self) {
        self.in_series = true;
    }

    /// A step of collocation has been made, of this stiffness over it, where a series is of this order.
    pub(crate) fn made(&mut self, stiffness: f64, order: usize) {
        if !self.collocation {
            return;
        }
        self.wait = self.wait.saturating_sub(1);
        if self.is_ahead(stiffness, order) {
            self.patience = PATIENCE.0;
        } else if self.wait == 0 {
            self.collocation = false;
            self.wait = self.patience;
            self.patience = (2 * self.patience).min(PATIENCE.1);
        }
    }

    /// Whether a step of collocation of this stiffness leads farther than the series that it costs.
    fn is_ahead(&self, stiffness: f64, order: usize) -> bool {
        stiffness > self.cost * REACH * order as f64
    }

    /// Whether the way changes from series to collocation just now.
    pub(crate) fn left_series(&mut self) -> bool {
        std::mem::take(&mut self.in_series)
    }

    pub(crate) fn save(&self, state: &mut State) {
        state.flag(self.collocation);
        state.flag(self.in_series);
        state.count(self.wait);
        state.count(self.patience);
    }

    pub(crate) fn restore(&mut self, state: &mut Reader) -> Result<(), Damaged> {
        (self.collocation, self.in_series) = (state.flag()?, state.flag()?);
        (self.wait, self.patience) = (state.count()?, state.count()?.min(PATIENCE.1));
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ORDER: usize = 20;

    /// A groove in which both methods always get equally far: trials become rare.
    #[test]
    fn where_neither_way_is_ahead_trials_become_rare() {
        let mut switch = Switch::new(false);
        let (mut series, mut trials) = (0, 0);
        while series < 20_000 {
            if switch.leaves(8.0, 50.0, ORDER) {
                trials += 1;
                while !switch.is_to_series() {
                    switch.made(8.0, ORDER);
                }
            }
            series += 1;
        }
        assert!((5..40).contains(&trials), "{trials}");
    }

    #[test]
    fn a_stiff_groove_is_left_to_collocation_until_it_is_no_longer_stiff() {
        let mut switch = Switch::new(false);
        while !switch.leaves(7.0, 50.0, ORDER) {}
        for _ in 0..1000 {
            switch.made(50.0, ORDER);
            assert!(!switch.is_to_series());
        }
        switch.made(3.0, ORDER);
        assert!(switch.is_to_series());
        // What moves about as fast as the groove relaxes is no reason to leave.
        assert!((0..1000).all(|_| !switch.leaves(2.0, 50.0, ORDER)));
    }
}
