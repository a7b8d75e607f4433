//! Every number printed in the paper beside ours.

mod markdown;
mod numbers;
mod oscillations;
mod printed;

pub use markdown::page;

use crate::failed::Failed;
use stickslip::{Document, ReproductionDocument, ReproductionFound, ReproductionParameters};

/// The numbers.
///
/// # Errors
/// One of them could not be computed.
pub fn table() -> Result<ReproductionDocument, Failed> {
    let mut entries = numbers::stability()?;
    entries.extend(numbers::formulas()?);
    entries.extend(oscillations::oscillations()?);
    Ok(Document::new(ReproductionParameters {}, ReproductionFound { numbers: entries }, vec![]))
}
