//! The parameters of the page's sliders, and the questions of the libraries that they make.

use crate::refusal::Refusal;
use serde::Deserialize;
use stickslip::{Cycle, Indentation, Run, StartName, Tip};
use stickslip_tip::{Model, TipFunction, Wider};

/// Values of the sliders. Lengths in σ, times in Γ/k, heights in kσ²/a.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Parameters {
    pub(crate) alpha: f64,
    pub(crate) r: f64,
    /// Side-lobe weight of the triple Gaussian; 0 for a Gaussian.
    pub(crate) beta: f64,
    pub(crate) width: f64,
    /// Depth limit b.
    pub(crate) depth_limit: Option<f64>,
    /// Healing time T.
    pub(crate) healing_time: Option<f64>,
    /// Inertia M.
    #[serde(default)]
    pub(crate) inertia: Option<f64>,
    /// κ_y; absent if the tip is held on its line.
    #[serde(default)]
    pub(crate) stiffness_across: Option<f64>,
    /// Initial distance from the line; used only with κ_y.
    #[serde(default)]
    pub(crate) kick_across: f64,
    pub(crate) start: StartName,
    pub(crate) kick: f64,
    pub(crate) until: f64,
}

impl Parameters {
    pub(crate) fn read(text: &str) -> Result<Self, Refusal> {
        serde_json::from_str(text).map_err(Refusal::Json)
    }

    pub(crate) fn tip(&self) -> Result<TipFunction, Refusal> {
        // As in the program, a tip without side lobes is a Gaussian, not a sum with terms of weight 0.
        Ok(match self.beta {
            0.0 => TipFunction::gaussian(self.width)?,
            beta => TipFunction::triple_gaussian(beta, self.width)?,
        })
    }

    pub(crate) fn wider(&self) -> Wider {
        let Self { depth_limit, healing_time, inertia, .. } = *self;
        Wider { depth_limit, healing_time, inertia, ..Wider::default() }
    }

    pub(crate) fn model(&self) -> Result<Model, Refusal> {
        Ok(Model::under(self.wider(), self.tip()?, self.alpha, self.r)?)
    }

    /// The initial distance from the line, if the tip can leave it.
    pub(crate) fn pushed_across(&self) -> Option<f64> {
        let is_pushed = self.stiffness_across.is_some() && self.kick_across.abs() > 0.0;
        is_pushed.then_some(self.kick_across)
    }

    /// The cycle at these parameters.
    pub(crate) fn cycle(&self) -> Result<Cycle, Refusal> {
        let model = self.model()?;
        let cycle = Cycle::new(Tip(model.tip().clone()), Indentation::given(self.alpha), self.r);
        Ok(Cycle { law: self.wider().into(), ..cycle })
    }

    /// The run with these parameters.
    pub(crate) fn run(&self) -> Result<Run, Refusal> {
        let (start, kick, law) = (Some(self.start), self.kick, self.wider().into());
        let (stiffness_across, kick_across) = (self.stiffness_across, self.pushed_across());
        let run = Run::new(Tip(self.tip()?), Indentation::given(self.alpha), self.r, self.until);
        Ok(Run { start, kick, law, stiffness_across, kick_across, ..run })
    }
}
