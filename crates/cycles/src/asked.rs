//! What can be asked for.

use super::embedding::Embedding;
use super::{CycleError, TOLERANCES};
use stickslip_tip::Model;

/// Refuses a tip that nothing drags.
pub(super) fn dragged(model: &Model) -> Result<(), CycleError> {
    if model.wider().spring { Ok(()) } else { Err(CycleError::NoSpring) }
}

/// The equations of a model, to this residual.
pub(super) fn embedding(model: &Model, tolerance: f64) -> Result<Embedding, CycleError> {
    dragged(model)?;
    judge(tolerance)?;
    Embedding::new(model, tolerance)
}

/// Refuses a residual that cannot be had.
pub(super) fn judge(tolerance: f64) -> Result<(), CycleError> {
    let usable = (TOLERANCES.0..=TOLERANCES.1).contains(&tolerance);
    if usable { Ok(()) } else { Err(CycleError::Tolerance(tolerance)) }
}
