//! Linear theory: where steady motion becomes unstable, and how fast small deviations grow.

use crate::asked::Asked;
use crate::refusal::Refusal;
use serde::Serialize;
use stickslip::{
    Ask, ComplexDocument, Context, CriticalDocument, Indentation, OnsetKindName, SnakingDocument,
    Stability, SteadyState, Tip,
};

/// Exponents that the page lists.
const ROOTS: usize = 6;

/// What linear theory says at the parameters.
#[derive(Debug, Serialize)]
pub(crate) struct Linear {
    /// Where the first exponent reaches the imaginary axis at this r.
    critical: Option<CriticalDocument>,
    /// Above this α some motions end in a pit.
    trapping: Option<f64>,
    /// Whether all deviations die out; null where no linear law decides.
    stable: Option<bool>,
    /// λ by falling real part, in k/Γ.
    roots: Vec<ComplexDocument>,
    steady: Option<SteadyState>,
    /// Where a tip that can leave its line begins to snake; null if it never does, or is held.
    snaking: Option<SnakingDocument>,
    /// Why something is null.
    remarks: Vec<String>,
}

pub(crate) fn linear(asked: &Asked) -> Result<Linear, Refusal> {
    let question = Stability {
        indentation: Indentation::given(asked.alpha),
        law: asked.wider().into(),
        roots: Some(ROOTS),
        stiffness_across: asked.stiffness_across,
        ..Stability::new(Tip(asked.tip()?), asked.r)
    };
    let found = question.ask(&Context::default())?;
    let kind = found.critical.as_ref().and_then(|critical| critical.kind);
    Ok(Linear {
        trapping: found.trapping.alpha,
        stable: (kind != Some(OnsetKindName::NonSmooth)).then_some(found.stable),
        roots: found.roots.clone(),
        steady: SteadyState::of(&asked.model()?),
        snaking: found.snaking.flatten(),
        remarks: found.remarks.clone(),
        critical: found.answer.critical,
    })
}
