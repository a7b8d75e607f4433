//! Choice between series and collocation for the next step.
//!
//! A step by series costs a fraction of one by collocation. But in a groove of stiffness K its length is limited to a
//! few times 1/K even if the motion is smooth, whereas a step of collocation is as long as the motion allows. A part of
//! the motion that decays as e^{-Kt} has the coefficients (-K)^k/k!. The smaller this part is, the longer a series can
//! be. So a step much longer than 1/K shows that the fast part has decayed. Then collocation is tried, and its step
//! lengths decide whether it continues. After each failed trial the next one comes later.

use crate::state::{Damaged, Reader, State};

/// The method in use.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Switch {
    /// Cost of a step of collocation, relative to a step by series.
    cost: f64,
    collocation: bool,
    /// Number of steps by the method in use before the other one is tried.
    wait: u64,
    /// Number of steps by series before the next trial, if the present one fails.
    patience: u64,
    /// Whether the last step was by series.
    in_series: bool,
}

/// Cost of a step of collocation, relative to a step by series. With inertia there are more iterations.
const COST: f64 = 4.0;
const COST_WITH_INERTIA: f64 = 8.0;
/// Longest step by a series of order p in a groove of stiffness K, in units of p/K.
const REACH: f64 = 0.25;
/// Number of steps of collocation in a trial: their lengths grow from step to step.
const TRIAL: u64 = 8;
/// Number of steps by series before the first trial, and largest number between two trials.
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

    /// Whether collocation takes over from a series of this order. `stiffness` is K times the length of the series,
    /// which is limited by accuracy; `most` is K times the longest possible step of collocation.
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

    pub(crate) fn made_series(&mut self) {
        self.in_series = true;
    }

    /// Records a step of collocation; `stiffness` is K times its length, `order` that of the series.
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

    /// Whether a step of collocation is longer than the series of the same total cost; `stiffness` is K times its
    /// length.
    fn is_ahead(&self, stiffness: f64, order: usize) -> bool {
        stiffness > self.cost * REACH * order as f64
    }

    /// Whether the last step was by series. The next call returns false, unless a step by series is made in between.
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
