//! The cheapest of the memories that apply.

use super::{Direct, Fft, FitError, Memory, Modes};
use crate::TipFunction;
use crate::collocation::Stages;

/// `modes` where f' can be fitted well enough; else `direct` while few nodes lie within reach of the
/// tip, and `fft` from then on.
pub struct Auto {
    tip: TipFunction,
    /// Why not `modes`.
    refused: Option<FitError>,
    now: Now,
}

enum Now {
    Modes(Box<Modes>),
    Direct(Direct),
    Fft(Box<Fft>),
}

/// Nodes within reach from which a step with `fft` is the cheaper one: benches/memory.rs.
pub const CROSSOVER_NODES: usize = 48;

impl Auto {
    /// Nothing remembered yet; f' is to be known to an error of at most `accuracy`.
    #[must_use]
    pub fn new(tip: TipFunction, accuracy: f64) -> Self {
        match Modes::new(tip.clone(), accuracy) {
            Ok(modes) => Self { tip, refused: None, now: Now::Modes(Box::new(modes)) },
            Err(why) => {
                Self { now: Now::Direct(Direct::new(tip.clone())), refused: Some(why), tip }
            }
        }
    }

    fn now(&self) -> &dyn Memory {
        match &self.now {
            Now::Modes(memory) => memory.as_ref(),
            Now::Direct(memory) => memory,
            Now::Fft(memory) => memory.as_ref(),
        }
    }
}

impl Memory for Auto {
    fn groove(&mut self, at: &Stages, slope: &mut Stages, curvature: &mut Stages) {
        match &mut self.now {
            Now::Modes(memory) => memory.groove(at, slope, curvature),
            Now::Direct(memory) => memory.groove(at, slope, curvature),
            Now::Fft(memory) => memory.groove(at, slope, curvature),
        }
    }

    fn remember(&mut self, position: &Stages, weight: &Stages) {
        match &mut self.now {
            Now::Modes(memory) => memory.remember(position, weight),
            Now::Direct(direct) => {
                direct.remember(position, weight);
                if direct.nodes_within_reach() > CROSSOVER_NODES {
                    let past: Vec<_> = direct.past().collect();
                    self.now = Now::Fft(Box::new(Fft::with_past(self.tip.clone(), &past)));
                }
            }
            Now::Fft(memory) => memory.remember(position, weight),
        }
    }

    fn name(&self) -> &'static str {
        self.now().name()
    }

    fn note(&self) -> Option<String> {
        let chosen = match &self.now {
            Now::Modes(_) => "the cheapest that meets the tolerance".to_string(),
            Now::Direct(_) => {
                format!("at most {CROSSOVER_NODES} nodes lay within reach: a direct sum costs less")
            }
            Now::Fft(_) => format!("more than {CROSSOVER_NODES} nodes lay within reach"),
        };
        let refused = self.refused.map(|why| format!("no modes: {why}"));
        let parts = [Some(chosen), self.now().note(), refused];
        Some(parts.into_iter().flatten().collect::<Vec<_>>().join("; "))
    }

    fn forgotten(&self) -> Option<f64> {
        self.now().forgotten()
    }
}
