//! The cycle that `cycle` is about and `continue` begins with.

use crate::arguments::{CycleStart, ModelArguments};
use crate::commands::model::{dragged_model, model_under, refuse_endless, tip};
use crate::failure::{Failure, Typed};
use crate::files::input::read_document;
use stickslip_cycles::{Cycle, CycleError, TOLERANCES, cycle, cycle_near};
use stickslip_documents::{CycleDocument, Unusable};
use stickslip_tip::{Model, Support, Trajectory, Wider};

/// Parameters, and the motion to start from if there is one.
pub(crate) struct Start {
    model: Model,
    period: Option<Trajectory>,
    tolerance: f64,
}

impl Start {
    /// # Errors
    /// Options that do not fit, a document that cannot be read.
    pub(crate) fn asked(arguments: &CycleStart) -> Result<Self, Failure> {
        let tolerance = Self::judge_tolerance(arguments)?;
        let Some(path) = &arguments.from else {
            return Ok(Self { model: dragged_model(&arguments.model)?, period: None, tolerance });
        };
        let document: CycleDocument = read_document("--from", path, CycleDocument::FORMAT)?;
        let refused =
            |message: String| Failure::input(format!("--from {}", path.display()), message);
        let unusable = |error: Unusable| refused(error.to_string());
        let before = document.parameters.model.model().map_err(unusable)?;
        let period = document.history.under(*before.wider(), Support::Moving(before.r()));
        let period = period.map_err(unusable)?;
        if period.start().abs() > 0.0 {
            return Err(refused("history: a cycle starts at t = 0".into()));
        }
        Ok(Self { model: changed(&before, &arguments.model)?, period: Some(period), tolerance })
    }

    /// The tolerance, if it can be had.
    pub(crate) fn judge_tolerance(arguments: &CycleStart) -> Result<f64, Failure> {
        let tolerance = arguments.tolerance;
        if (TOLERANCES.0..=TOLERANCES.1).contains(&tolerance) {
            return Ok(tolerance);
        }
        let error = CycleError::Tolerance(tolerance);
        Err(Failure::input(format!("--tolerance {}", Typed(tolerance)), error))
    }

    /// Footprint, α and r.
    pub(crate) fn model(&self) -> &Model {
        &self.model
    }

    /// # Errors
    /// There is no cycle where it was looked for.
    pub(crate) fn solve(&self) -> Result<Cycle, Failure> {
        let found = match &self.period {
            Some(period) => cycle_near(&self.model, period, self.tolerance),
            None => cycle(&self.model, self.tolerance),
        };
        found.map_err(|error| explain(&error))
    }
}

/// A model with what was given in place of its own.
fn changed(before: &Model, arguments: &ModelArguments) -> Result<Model, Failure> {
    refuse_endless(&arguments.tip, &arguments.wider)?;
    let ModelArguments { tip: asked, r, alpha, alpha_above, wider } = arguments;
    let given = asked.tip.is_some()
        || asked.beta.is_some()
        || asked.width.is_some()
        || asked.tip_file.is_some();
    if given {
        let tip = tip(asked)?;
        if tip != *before.tip() {
            let message = "the footprint is that of the document: leave --tip and its options out";
            return Err(Failure::input("--from", message));
        }
    }
    let (r, alpha) = (r.unwrap_or(before.r()), *alpha);
    let alpha = if alpha.is_none() && alpha_above.is_none() { Some(before.alpha()) } else { alpha };
    let law = Wider {
        depth_limit: wider.depth_limit.or(before.wider().depth_limit),
        healing_time: wider.healing_time.or(before.wider().healing_time),
        inertia: wider.inertia.or(before.wider().inertia),
        spring: true,
    };
    model_under((law, before.tip().clone()), r, (alpha, *alpha_above))
}

/// What cannot be had at these parameters is no fault of the input, unless it is never there.
pub(crate) fn explain(error: &CycleError) -> Failure {
    match error {
        CycleError::NeverFades => Failure::input("--tip bessel", error),
        CycleError::NoSmallCycle { .. } => {
            let advice = "a large one, if there is any, can be reached with --from";
            Failure::Run(format!("{error}; {advice}"))
        }
        _ => Failure::Run(error.to_string()),
    }
}
