//! The cycle at the parameters, with its multipliers.

use crate::asked::Asked;
use crate::refusal::Refusal;
use stickslip_cycles::{DEFAULT_TOLERANCE, cycle};
use stickslip_documents::{CycleDocument, CycleParameters, ModelParameters};

/// Intervals of the profile, as `stickslip cycle` has them by default.
const POINTS: usize = 400;

pub(crate) fn cycle_document(asked: &Asked) -> Result<CycleDocument, Refusal> {
    let cycle = cycle(&asked.model()?, DEFAULT_TOLERANCE)?;
    let model = ModelParameters::of(cycle.model(), None);
    let parameters = CycleParameters { model, tolerance: DEFAULT_TOLERANCE };
    Ok(CycleDocument::of(&cycle, parameters, POINTS, 0.0))
}
