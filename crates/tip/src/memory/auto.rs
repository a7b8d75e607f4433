//! The cheaper of the memories, by the number of nodes within reach.

use super::{Direct, Fft, Memory};
use crate::TipFunction;
use crate::collocation::Stages;
use crate::state::{Damaged, Reader, State};

/// `direct` while few nodes lie within reach of the tip and few steps have been made, `fft` from then on.
///
/// `modes` is not among the choices yet: it is cheaper per step at tolerances above 1e-9, dearer below.
pub struct Auto {
    tip: TipFunction,
    now: Now,
}

enum Now {
    Direct(Direct),
    Fft(Box<Fft>),
}

/// Nodes within reach from which `fft` is the cheaper one. A step costs it less than a direct sum over
/// six nodes, but its plan takes some 30 µs, as much as the first eight steps of a direct sum
/// (benches/memory.rs); anything from 30 to 100 does as well.
pub const CROSSOVER_NODES: usize = 48;

/// Remembered steps from which `fft` is the cheaper one, wherever they lie: `direct` looks through them all.
pub const CROSSOVER_STEPS: usize = 1024;

impl Auto {
    /// Nothing remembered yet.
    #[must_use]
    pub fn new(tip: TipFunction) -> Self {
        Self { now: Now::Direct(Direct::new(tip.clone())), tip }
    }
}

impl Memory for Auto {
    fn groove(&mut self, at: &Stages, slope: &mut Stages, curvature: &mut Stages) {
        match &mut self.now {
            Now::Direct(memory) => memory.groove(at, slope, curvature),
            Now::Fft(memory) => memory.groove(at, slope, curvature),
        }
    }

    fn remember(&mut self, position: &Stages, weight: &Stages) {
        match &mut self.now {
            Now::Direct(direct) => {
                direct.remember(position, weight);
                let is_long = direct.steps() > CROSSOVER_STEPS;
                if is_long || direct.nodes_within_reach() > CROSSOVER_NODES {
                    let past: Vec<_> = direct.past().collect();
                    self.now = Now::Fft(Box::new(Fft::with_past(self.tip.clone(), &past)));
                }
            }
            Now::Fft(memory) => memory.remember(position, weight),
        }
    }

    fn name(&self) -> &'static str {
        match &self.now {
            Now::Direct(memory) => memory.name(),
            Now::Fft(memory) => memory.name(),
        }
    }

    fn save(&self, state: &mut State) {
        match &self.now {
            Now::Direct(memory) => {
                state.flag(false);
                memory.save(state);
            }
            Now::Fft(memory) => {
                state.flag(true);
                memory.save(state);
            }
        }
    }

    fn restore(&mut self, state: &mut Reader) -> Result<(), Damaged> {
        if state.flag()? {
            let mut fft = Box::new(Fft::new(self.tip.clone()));
            fft.restore(state)?;
            self.now = Now::Fft(fft);
            return Ok(());
        }
        let mut direct = Direct::new(self.tip.clone());
        direct.restore(state)?;
        self.now = Now::Direct(direct);
        Ok(())
    }

    fn forgotten(&self) -> Option<f64> {
        match &self.now {
            Now::Direct(memory) => memory.forgotten(),
            Now::Fft(memory) => memory.forgotten(),
        }
    }

    fn note(&self) -> Option<String> {
        Some(match &self.now {
            Now::Direct(_) => {
                format!("at most {CROSSOVER_NODES} nodes lay within reach: a direct sum costs less")
            }
            Now::Fft(_) => format!(
                "more than {CROSSOVER_NODES} nodes lay within reach, or {CROSSOVER_STEPS} steps were to be looked through"
            ),
        })
    }
}
