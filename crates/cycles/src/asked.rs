//! Checks of models and residuals.

use super::embedding::Embedding;
use super::{CycleError, TOLERANCES};
use stickslip_tip::Model;

/// An error for a tip without a spring, which nothing drags.
pub(super) fn dragged(model: &Model) -> Result<(), CycleError> {
    if model.wider().spring { Ok(()) } else { Err(CycleError::NoSpring) }
}

/// The equations of a model, for this residual.
pub(super) fn embedding(model: &Model, tolerance: f64) -> Result<Embedding, CycleError> {
    dragged(model)?;
    judge(tolerance)?;
    Embedding::new(model, tolerance)
}

/// An error for a residual out of range.
pub(super) fn judge(tolerance: f64) -> Result<(), CycleError> {
    let usable = (TOLERANCES.0..=TOLERANCES.1).contains(&tolerance);
    if usable { Ok(()) } else { Err(CycleError::Tolerance(tolerance)) }
}
