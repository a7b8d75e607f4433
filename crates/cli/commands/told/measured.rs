//! What is told of measured data.

use super::{Told, digits};
use crate::commands::job::Product;
use stickslip_documents::{EstimateDocument, MeasuredTipDocument};

impl Product for MeasuredTipDocument {
    fn told(&self) -> Told {
        let unit = self.parameters.unit.as_deref().map(|unit| format!(" {unit}"));
        let unit = unit.unwrap_or_default();
        let r = digits(self.parameters.r, 6);
        let headline = format!(
            "a sum of {} Gaussian{} with σ = {}{unit}: critical α {} at r = {r}",
            self.terms,
            if self.terms == 1 { "" } else { "s" },
            in_digits(&self.sigma),
            with_interval(&self.critical_alpha),
        );
        let trapping = self.trapping_alpha.as_ref().map(with_interval);
        Told::new(headline)
            .row("σ", format!("{}{unit}", with_interval(&self.sigma)))
            .row("centre", format!("{}{unit}", digits(self.centre, 6)))
            .row("height", digits(self.apex, 5))
            .row("noise from row to row", digits(self.noise, 3))
            .row("residual", digits(self.residual, 3))
            .row("critical α", with_interval(&self.critical_alpha))
            .row("ω there", format!("{} k/Γ", with_interval(&self.critical_omega)))
            .maybe("trapped for ever from α", trapping)
            .remarks(&self.remarks)
            .next(format!("stickslip stability --tip-file tip.json --r {r}"))
    }
}

/// Such as "1.879 (1.85 to 1.91)".
fn with_interval(estimate: &EstimateDocument) -> String {
    let value = in_digits(estimate);
    let end = |end: f64| digits(end, 4);
    match (estimate.low, estimate.high) {
        (Some(low), Some(high)) => format!("{value} ({} to {})", end(low), end(high)),
        (Some(low), None) => format!("{value} (above {})", end(low)),
        (None, Some(high)) => format!("{value} (below {})", end(high)),
        (None, None) => format!("{value} (no interval)"),
    }
}

/// With one digit more than hold.
fn in_digits(estimate: &EstimateDocument) -> String {
    let width = estimate.high.zip(estimate.low).map(|(high, low)| 0.5 * (high - low));
    let relative = width.map_or(0.0, |width| width / estimate.value.abs());
    let count = if relative > 0.0 { 1.0 - relative.log10().floor() } else { 6.0 };
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a count")]
    let count = count.clamp(2.0, 10.0) as usize;
    digits(estimate.value, count)
}
