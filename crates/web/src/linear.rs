//! Linear theory: the onset of instability, and growth rates of small deviations.

use crate::parameters::Parameters;
use crate::refusal::Refusal;
use serde::Serialize;
use stickslip::{
    Ask, ComplexDocument, Context, CriticalDocument, Indentation, OnsetKind, SnakingDocument,
    Stability, SteadyState, Tip,
};

/// Number of exponents that the page lists.
const ROOTS: usize = 6;

/// Results of linear theory.
#[derive(Debug, Serialize)]
pub(crate) struct Linear {
    /// The point at the given r at which the first exponent reaches the imaginary axis.
    critical: Option<CriticalDocument>,
    /// Trapping threshold: above this α some motions end in a pit.
    trapping: Option<f64>,
    /// Whether all small deviations decay; null where linear theory does not decide.
    stable: Option<bool>,
    /// λ by falling real part, in k/Γ.
    roots: Vec<ComplexDocument>,
    steady: Option<SteadyState>,
    /// Onset of snaking; null without such an onset, or if the tip is held on its line.
    snaking: Option<SnakingDocument>,
    /// The reasons for null fields.
    remarks: Vec<String>,
}

pub(crate) fn linear(parameters: &Parameters) -> Result<Linear, Refusal> {
    let question = Stability {
        indentation: Indentation::given(parameters.alpha),
        law: parameters.wider().into(),
        roots: Some(ROOTS),
        stiffness_across: parameters.stiffness_across,
        ..Stability::new(Tip(parameters.tip()?), parameters.r)
    };
    let found = question.ask(&Context::default())?;
    let kind = found.critical.as_ref().and_then(|critical| critical.kind);
    Ok(Linear {
        trapping: found.trapping.alpha,
        stable: (kind != Some(OnsetKind::NonSmooth)).then_some(found.stable),
        roots: found.roots.clone(),
        steady: SteadyState::of(&parameters.model()?),
        snaking: found.snaking.flatten(),
        remarks: found.remarks.clone(),
        critical: found.answer.critical,
    })
}
