//! Comparison of every number printed in the paper with ours.

mod markdown;
mod numbers;
mod oscillations;
mod printed;

pub use markdown::page;

use crate::failed::Failed;
use stickslip::{Document, ReproductionDocument, ReproductionFound, ReproductionParameters};

/// The comparison of all numbers.
///
/// # Errors
/// A number could not be computed.
pub fn table() -> Result<ReproductionDocument, Failed> {
    let mut entries = numbers::stability()?;
    entries.extend(numbers::formulas()?);
    entries.extend(oscillations::oscillations()?);
    Ok(Document::new(ReproductionParameters {}, ReproductionFound { numbers: entries }, vec![]))
}
