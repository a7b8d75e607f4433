//! A bounded number of steps from a part of the run of any length.

use stickslip_tip::Step;
use stickslip_tip::state::{Damaged, Reader, State};

/// Every n-th step since a given time; n doubles when the number of steps exceeds its limit.
#[derive(Debug, Clone)]
pub(crate) struct Thinned {
    steps: Vec<Step>,
    every: u64,
    seen: u64,
}

const MOST: usize = 512;

impl Default for Thinned {
    fn default() -> Self {
        Self { steps: vec![], every: 1, seen: 0 }
    }
}

impl Thinned {
    /// Removes all steps; the next one is the first again.
    pub(crate) fn clear(&mut self) {
        self.steps.clear();
        (self.every, self.seen) = (1, 0);
    }

    pub(crate) fn observe(&mut self, step: &Step) {
        if self.seen.is_multiple_of(self.every) {
            if self.steps.len() == MOST {
                let mut index = 0;
                self.steps.retain(|_| {
                    index += 1;
                    index % 2 == 1
                });
                self.every *= 2;
            }
            self.steps.push(*step);
        }
        self.seen += 1;
    }

    /// The last kept step that begins at or before t.
    pub(crate) fn at(&self, t: f64) -> Option<&Step> {
        self.steps[..self.steps.partition_point(|step| step.t <= t)].last()
    }

    pub(crate) fn save(&self, state: &mut State) {
        state.count(self.every);
        state.count(self.seen);
        state.steps(self.steps.iter());
    }

    pub(crate) fn restore(&mut self, state: &mut Reader) -> Result<(), Damaged> {
        (self.every, self.seen) = (state.count()?, state.count()?);
        self.steps = state.steps()?;
        if self.every == 0 || self.steps.len() > MOST {
            return Err(Damaged::OutOfRange);
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn however_many_steps_pass_a_bounded_number_spans_them_all() {
        let mut thinned = Thinned::default();
        for i in 0..100_000 {
            thinned.observe(&Step {
                t: f64::from(i),
                h: 1.0,
                extension: 0.0,
                displacement: [0.0; 6],
                height: None,
            });
        }
        assert!(thinned.steps.len() <= MOST);
        for t in [0.0, 10.0, 50_000.0, 99_990.0] {
            let kept = thinned.at(t).unwrap().t;
            assert!(kept <= t && t - kept <= 100_000.0 * 2.0 / MOST as f64, "{kept} for {t}");
        }
    }
}
