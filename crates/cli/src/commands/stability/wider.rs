//! Points under the wider law.

use super::Point;
use crate::arguments::StabilityArguments;
use crate::commands::model::{tip, wide_model, wider};
use crate::failure::{Failure, Typed};
use stickslip::{LimitsDocument, SolveFor};
use stickslip_stability::{
    Creep, Critical, Onset, OnsetKind, StabilityError, creep, critical, least_depth_limit,
    memory_length, onset_at, trapping_alpha,
};
use stickslip_tip::Model;

/// Said where the law has its corner at steady motion.
pub(super) const CORNER: &str = "critical: the height under the tip is 0 in steady motion, where |h| of the depth \
     limit has a corner: small deviations obey no linear law and have no exponents; at alpha of critical a small \
     oscillation keeps its amplitude, and at finite amplitude onset moves";

impl Point {
    /// Under the wider law, which αc is a function of too.
    pub(super) fn under_wider_law(arguments: &StabilityArguments) -> Result<Self, Failure> {
        let model = &arguments.model;
        if arguments.solve_for == SolveFor::R {
            let message = "rc(α) is of the paper's law: give --r R, for αc(r)";
            return Err(Failure::input("--solve-for r", message));
        }
        let r =
            model.r.ok_or_else(|| Failure::input("--r", "αc is a function of r: give --r R"))?;
        let (law, tip) = (wider(&model.wider), tip(&model.tip)?);
        let critical = critical(&law, &tip, r);
        let kind = critical.as_ref().ok().map(|found| found.kind);
        if model.alpha.is_some() || model.alpha_above.is_some() {
            return Ok(Self { critical, model: wide_model(model)?, at_critical: false, kind });
        }
        let at = critical.map_err(|error| {
            let advice = "give --alpha A for the growth exponents there";
            Failure::input(format!("--r {}", Typed(r)), format!("{error}; {advice}"))
        })?;
        let model = Model::under(law, tip, at.alpha, at.r)
            .map_err(|error| Failure::Run(error.to_string()))?;
        Ok(Self { critical, model, at_critical: true, kind })
    }

    pub(super) fn has_corner(&self) -> bool {
        self.kind == Some(OnsetKind::NonSmooth)
    }
}

/// Where tips are trapped, and how they creep: with inertia as without, but under a depth limit, or where the
/// surface heals, none is held for ever.
pub(super) fn trapping(
    model: &Model,
) -> (Result<f64, StabilityError>, Result<Creep, StabilityError>) {
    let papers = Model::new(model.tip().clone(), model.alpha(), model.r());
    match papers.ok().filter(|_| model.wider().traps()) {
        Some(papers) => (trapping_alpha(model.tip(), model.r()), creep(&papers)),
        None => {
            let error = StabilityError::PapersLawOnly("trapping");
            (Err(error), Err(error))
        }
    }
}

/// What leaves nothing unstable; nothing is said of it under the paper's law.
pub(super) fn limits(model: &Model) -> Option<LimitsDocument> {
    let (law, tip) = (model.wider(), model.tip());
    (!law.is_papers()).then(|| LimitsDocument {
        least_depth_limit: least_depth_limit(law, tip, model.r()).ok(),
        memory_length: memory_length(tip).ok(),
    })
}

/// What is born at the critical point, to leading order.
pub(super) fn onset(model: &Model, critical: Critical) -> Result<Onset, StabilityError> {
    if !model.wider().is_papers() {
        return Err(StabilityError::PapersLawOnly("the leading order of small cycles"));
    }
    onset_at(model.tip(), critical)
}
