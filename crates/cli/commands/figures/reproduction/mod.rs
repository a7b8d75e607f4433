//! reproduction.json and reproduction.md: every number printed in the paper beside ours.

mod markdown;
mod numbers;
mod oscillations;
mod printed;

use super::open;
use crate::failure::Failure;
use std::path::Path;
use stickslip_documents::{FORMAT_VERSION, ReproductionDocument, ReproductionParameters, Software};

/// Writes both; their names.
pub(super) fn write(folder: &Path) -> Result<Vec<String>, Failure> {
    let mut entries = numbers::stability()?;
    entries.extend(numbers::formulas()?);
    entries.extend(oscillations::oscillations()?);
    let document = ReproductionDocument {
        format: ReproductionDocument::FORMAT.into(),
        format_version: FORMAT_VERSION,
        software: Software::this(),
        parameters: ReproductionParameters {},
        numbers: entries,
    };
    let (json, text) = ("reproduction.json", "reproduction.md");
    open(&folder.join(json))?.write_json(&document)?;
    open(&folder.join(text))?.write_bytes(markdown::page(&document).as_bytes())?;
    Ok(vec![json.into(), text.into()])
}
