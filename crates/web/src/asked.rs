//! What is asked for: the sliders of the page.

use crate::refusal::Refusal;
use serde::Deserialize;
use stickslip::{Indentation, Run, StartName, Tip};
use stickslip_tip::{Model, TipFunction, Wider};

/// Lengths in σ, times in Γ/k, heights in kσ²/a.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Asked {
    pub(crate) alpha: f64,
    pub(crate) r: f64,
    /// Of the triple Gaussian, 0 for a Gaussian.
    pub(crate) beta: f64,
    pub(crate) width: f64,
    /// b
    pub(crate) depth_limit: Option<f64>,
    /// T
    pub(crate) healing_time: Option<f64>,
    pub(crate) start: StartName,
    pub(crate) kick: f64,
    pub(crate) until: f64,
}

impl Asked {
    pub(crate) fn read(text: &str) -> Result<Self, Refusal> {
        serde_json::from_str(text).map_err(Refusal::Json)
    }

    pub(crate) fn tip(&self) -> Result<TipFunction, Refusal> {
        // As the program has it: without side lobes it is the Gaussian itself, not a sum with terms of weight 0.
        Ok(match self.beta {
            0.0 => TipFunction::gaussian(self.width)?,
            beta => TipFunction::triple_gaussian(beta, self.width)?,
        })
    }

    pub(crate) fn wider(&self) -> Wider {
        let Self { depth_limit, healing_time, .. } = *self;
        Wider { depth_limit, healing_time, ..Wider::default() }
    }

    pub(crate) fn model(&self) -> Result<Model, Refusal> {
        Ok(Model::under(self.wider(), self.tip()?, self.alpha, self.r)?)
    }

    /// The run to these parameters.
    pub(crate) fn run(&self) -> Result<Run, Refusal> {
        let (start, kick, law) = (Some(self.start), self.kick, self.wider().into());
        let run = Run::new(Tip(self.tip()?), Indentation::given(self.alpha), self.r, self.until);
        Ok(Run { start, kick, law, ..run })
    }
}
