//! Comparison of every number printed in the paper with ours.

mod numbers;
mod oscillations;
mod printed;

use crate::parts::Failed;
use stickslip::{
    Document, NumberDocument, ReproductionDocument, ReproductionFound, ReproductionParameters,
};

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

const HEAD: &str = "# The paper's numbers beside ours

Printed decimals are taken to half a unit of their last digit, whole numbers as exact. What
differs is explained by an entry of `docs/findings/corrections.md`, whose number is given; each entry has a test.

| quantity | for | where | printed | ours | relative difference | |
|---|---|---|---|---|---|---|
";

/// Absolute value below which a number is round-off of 0.
const ROUND_OFF: f64 = 1e-9;

/// The table as a page of Markdown.
pub fn page(document: &ReproductionDocument) -> String {
    let rows: String = document.numbers.iter().map(row).collect();
    let agreeing = document.numbers.iter().filter(|number| number.agrees).count();
    let explained = document.numbers.len() - agreeing;
    format!("{HEAD}{rows}\n{agreeing} agree, {explained} differ for the reason given.\n")
}

fn row(number: &NumberDocument) -> String {
    let NumberDocument { quantity, case, place, printed, ours, .. } = number;
    let difference = match number.relative_difference {
        Some(d) if d.abs() < ROUND_OFF => "0".into(),
        Some(d) => format!("{d:+.1e}"),
        None => String::new(),
    };
    let verdict = match (number.agrees, number.correction, &number.remark) {
        (true, ..) => "agrees".into(),
        (false, Some(entry), Some(remark)) => format!("correction {entry}: {remark}"),
        (false, ..) => "**differs**".into(),
    };
    // Bars would end the cell.
    let cells = [quantity, case, place].map(|cell| cell.replace('|', "\\|"));
    let [quantity, case, place] = cells;
    let ours = if ours.abs() < ROUND_OFF { 0.0 } else { *ours };
    format!(
        "| {quantity} | {case} | {place} | {printed} | {ours:.9} | {difference} | {verdict} |\n"
    )
}
