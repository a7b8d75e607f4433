//! Linear theory: where steady motion becomes unstable, and how fast small deviations grow.

use crate::asked::Asked;
use crate::refusal::Refusal;
use serde::Serialize;
use stickslip::{ComplexDocument, CriticalDocument, SteadyState};
use stickslip_stability::{
    Critical, OnsetKind, StabilityError, critical, leading_roots, trapping_alpha,
    unstable_count,
};
use stickslip_tip::{Model, TipFunction, Wider};

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
    /// Why something is null.
    remarks: Vec<String>,
}

/// αc(r) under any law, and whether linear theory decides there.
pub(crate) fn onset(
    wider: &Wider,
    tip: &TipFunction,
    r: f64,
) -> Result<(Critical, Option<OnsetKind>), StabilityError> {
    let found = critical(wider, tip, r)?;
    Ok((found, (!wider.is_papers()).then_some(found.kind)))
}

pub(crate) fn linear(asked: &Asked) -> Result<Linear, Refusal> {
    let model = asked.model()?;
    let onset = onset(model.wider(), model.tip(), model.r());
    let trapping = if model.wider().traps() {
        trapping_alpha(model.tip(), model.r())
    } else {
        Err(StabilityError::PapersLawOnly("trapping"))
    };
    let has_corner = matches!(onset, Ok((_, Some(OnsetKind::NonSmooth))));
    let roots = if has_corner { Err(StabilityError::Corner) } else { roots(&model) };
    let remark = |name: &str, error: Option<StabilityError>| error.map(|e| format!("{name}: {e}"));
    let remarks = remark("αc", onset.as_ref().err().copied())
        .into_iter()
        .chain(remark("exponents", roots.as_ref().err().copied()));
    Ok(Linear {
        remarks: remarks.collect(),
        critical: onset.ok().map(|(at, kind)| CriticalDocument::of(&at, kind)),
        trapping: trapping.ok(),
        stable: unstable_count(&model).ok().filter(|_| !has_corner).map(|count| count == 0),
        roots: roots.unwrap_or_default(),
        steady: SteadyState::of(&model),
    })
}

fn roots(model: &Model) -> Result<Vec<ComplexDocument>, StabilityError> {
    let spectrum = leading_roots(model, ROOTS)?;
    Ok(spectrum.roots.iter().map(|z| ComplexDocument { re: z.re, im: z.im }).collect())
}
