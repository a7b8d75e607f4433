//! Heights under the tip for a guess that contains none.

use super::carved::Heights;
use super::embedding::Embedding;
use super::orbit::Orbit;
use super::past::Past;
use stickslip_tip::collocation::STAGES;
use stickslip_tip::step::OwnHeight;

/// Number of rounds of the fixed-point iteration for the heights.
const ROUNDS: usize = 12;
/// Relaxation factor of this iteration.
const SHARE: f64 = 0.5;

impl Orbit {
    /// Heights under a depth limit, none otherwise; `None` after a request to stop.
    pub(super) fn take_heights(&mut self, equation: &Embedding) -> Option<()> {
        if equation.wider.depth_limit.is_none() {
            self.heights.clear();
        } else if self.heights.is_empty() {
            let steady = equation.model()?.steady_height();
            self.heights = vec![Heights::new([steady; STAGES]); self.stages.len()];
            for _ in 0..ROUNDS {
                self.improve_heights(equation)?;
            }
        }
        Some(())
    }

    /// One relaxed step towards the heights that follow from the weights of the present heights.
    fn improve_heights(&mut self, equation: &Embedding) -> Option<()> {
        let carved = self.carved(&equation.wider);
        let past = Past::of(&equation.short, (self, &carved))?;
        let steps = self.stages.iter().zip(&carved).enumerate();
        let new = steps.map(|(n, (d, carved))| {
            let mut own = [0.0; STAGES];
            OwnHeight::new(&equation.tip, d).add(&carved.weighted(), &mut own);
            let told = past.of_step(n).height();
            let before = self.heights[n].nodes;
            Heights::new(std::array::from_fn(|i| {
                let now = -equation.alpha * (told[i] + own[i] * carved.times);
                before[i] + SHARE * (now - before[i])
            }))
        });
        let new = new.collect();
        self.heights = new;
        Some(())
    }
}
