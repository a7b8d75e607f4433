//! The cheaper of the memories, by the number of nodes within reach and by what the footprint allows.

use super::{Direct, Fft, FitError, Memory, Modes};
use crate::TipFunction;
use crate::collocation::Stages;
use crate::state::{Damaged, Reader, State};

/// `direct` while few nodes lie within reach of the tip and few steps have been made; from then on `modes`
/// where f' can be fitted by exponentials as well as is needed, else `fft`.
pub struct Auto {
    tip: TipFunction,
    accuracy: f64,
    now: Now,
}

enum Now {
    Direct(Direct),
    Modes(Box<Modes>),
    Fft(Box<Fft>, FitError),
}

/// Nodes within reach from which a direct sum is the dearer one. A step costs the others less than a direct
/// sum over six nodes, but the plan of `fft` takes some 30 µs and the fit of `modes`, made once for a
/// footprint and an accuracy, some 300 µs: as much as the first 8 or 20 steps of a direct sum
/// (benches/memory.rs).
pub const CROSSOVER_NODES: usize = 48;

/// Remembered steps from which a direct sum is the dearer one, wherever they lie: `direct` looks through them all.
pub const CROSSOVER_STEPS: usize = 1024;

impl Auto {
    /// Nothing remembered yet; modes, if it comes to them, fit f' to an error of at most `accuracy`.
    #[must_use]
    pub fn new(tip: TipFunction, accuracy: f64) -> Self {
        Self { now: Now::Direct(Direct::new(tip.clone())), accuracy, tip }
    }

    fn with_more(&self, direct: &Direct) -> Now {
        let past: Vec<_> = direct.past().collect();
        match Modes::with_past(self.tip.clone(), self.accuracy, &past) {
            Ok(modes) => Now::Modes(Box::new(modes)),
            Err(why) => Now::Fft(Box::new(Fft::with_past(self.tip.clone(), &past)), why),
        }
    }
}

impl Now {
    fn memory(&self) -> &dyn Memory {
        match self {
            Self::Direct(memory) => memory,
            Self::Modes(memory) => memory.as_ref(),
            Self::Fft(memory, _) => memory.as_ref(),
        }
    }

    fn memory_mut(&mut self) -> &mut dyn Memory {
        match self {
            Self::Direct(memory) => memory,
            Self::Modes(memory) => memory.as_mut(),
            Self::Fft(memory, _) => memory.as_mut(),
        }
    }
}

impl Memory for Auto {
    fn groove(&mut self, at: &Stages, slope: &mut Stages, curvature: &mut Stages) {
        self.now.memory_mut().groove(at, slope, curvature);
    }

    fn remember(&mut self, position: &Stages, weight: &Stages) {
        self.now.memory_mut().remember(position, weight);
        if let Now::Direct(direct) = &self.now
            && (direct.nodes_within_reach() > CROSSOVER_NODES || direct.steps() > CROSSOVER_STEPS)
        {
            self.now = self.with_more(direct);
        }
    }

    fn name(&self) -> &'static str {
        self.now.memory().name()
    }

    fn save(&self, state: &mut State) {
        state.flag(matches!(self.now, Now::Direct(_)));
        self.now.memory().save(state);
    }

    fn restore(&mut self, state: &mut Reader) -> Result<(), Damaged> {
        let direct = Direct::new(self.tip.clone());
        self.now = if state.flag()? { Now::Direct(direct) } else { self.with_more(&direct) };
        self.now.memory_mut().restore(state)
    }

    fn forgotten(&self) -> Option<f64> {
        self.now.memory().forgotten()
    }

    fn note(&self) -> Option<String> {
        let many = format!(
            "more than {CROSSOVER_NODES} nodes lay within reach, or {CROSSOVER_STEPS} steps were to be looked through"
        );
        Some(match &self.now {
            Now::Direct(_) => {
                format!("at most {CROSSOVER_NODES} nodes lay within reach: a direct sum costs less")
            }
            Now::Modes(modes) => many + "; " + &modes.note().unwrap_or_default(),
            Now::Fft(_, FitError::NeverFades) => many + ", and modes need a footprint that fades",
            Now::Fft(_, FitError::NotMet { .. } | FitError::Terms) => {
                format!("{many}, and modes do not fit f' to {:.1e}", self.accuracy)
            }
        })
    }
}
