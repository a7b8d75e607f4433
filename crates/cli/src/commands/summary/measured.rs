//! Summaries of measured data.

use super::{Summary, again, digits};
use crate::commands::job::Product;
use serde_json::{Value, json};
use stickslip::{
    EstimateDocument, FitDocument, FitImageDocument, FrictionDocument, MeasuredTipDocument,
    NumberFitted,
};

/// A unit as it follows a number.
fn after_number(unit: Option<&str>) -> String {
    unit.map(|unit| format!(" {unit}")).unwrap_or_default()
}

impl Product for MeasuredTipDocument {
    fn summary(&self) -> Summary {
        let unit = after_number(self.parameters.unit.as_deref());
        let height_unit = after_number(self.parameters.height_unit.as_deref());
        let in_heights = |height: f64, count| format!("{}{height_unit}", digits(height, count));
        let r = digits(self.parameters.r, 6);
        let headline = format!(
            "a sum of {} Gaussian{} with σ = {}{unit}: critical α {} at r = {r}",
            self.terms,
            if self.terms == 1 { "" } else { "s" },
            in_digits(&self.sigma),
            with_interval(&self.critical_alpha),
        );
        let trapping = self.trapping_alpha.as_ref().map(with_interval);
        let [trace, retrace] = [false, true].map(|is_back| {
            let sides = self.sides.as_ref()?;
            Some(with_interval(&if is_back { &sides.retrace } else { &sides.trace }.critical_alpha))
        });
        let apex = self.sides.as_ref().map(|sides| format!("{}{unit}", digits(sides.apex, 6)));
        Summary::new(headline)
            .row("σ", format!("{}{unit}", with_interval(&self.sigma)))
            .row("centre", format!("{}{unit}", digits(self.centre, 6)))
            .row("height", in_heights(self.apex, 5))
            .row("noise from row to row", in_heights(self.noise, 3))
            .row("residual", in_heights(self.residual, 3))
            .row("critical α", with_interval(&self.critical_alpha))
            .row("ω there", format!("{} k/Γ", with_interval(&self.critical_omega)))
            .maybe("trapped from α", trapping)
            .maybe("apex between the sides", apex)
            .maybe("critical α of the trace", trace)
            .maybe("critical α of the retrace", retrace)
            .remarks(&self.remarks)
            .next(again("-o tip.json --plot tip.svg"))
            .next(format!("stickslip stability --tip-file tip.json --r {r}"))
    }
}

impl Product for FitDocument {
    fn summary(&self) -> Summary {
        let said = |n: &NumberFitted| {
            format!("{}{}", with_interval(&n.estimate), after_number(n.unit.as_deref()))
        };
        let short = self.numbers.iter().map(|n| format!("{} = {}", n.name, said(n)));
        let mut summary = Summary::new(short.collect::<Vec<String>>().join(", "));
        for number in &self.numbers {
            summary = summary.row(&number.name.replace('_', " "), said(number));
        }
        for (i, row) in self.correlations.iter().enumerate() {
            for (j, correlation) in row.iter().enumerate().skip(i + 1) {
                let name = format!("{}, {}", self.numbers[i].name, self.numbers[j].name);
                summary = summary.row(&name, format!("correlation {correlation:.3}"));
            }
        }
        for data in &self.data {
            // Residuals of a series, which has no scan, are relative.
            let unit = after_number(data.y_unit.as_deref().filter(|_| data.scan.is_some()));
            summary = summary
                .row(
                    &data.source,
                    format!("{} rows, residual {}{unit}", data.y.len(), digits(data.residual, 3)),
                )
                .maybe("scan", data.scan.clone())
                .maybe("noise", data.noise.map(|noise| format!("{}{unit}", digits(noise, 3))))
                .maybe("probability of the misfit", data.misfit.map(|p| digits(p, 2)))
                .maybe("gain", data.gain.map(|gain| digits(gain, 5)));
        }
        let at = self.critical_alpha.map(|alpha| digits(alpha, 6));
        summary.maybe("critical α at this r", at).remarks(&self.remarks)
    }
}

impl Product for FitImageDocument {
    fn summary(&self) -> Summary {
        let unit = after_number(self.parameters.unit.as_deref());
        let height_unit = after_number(self.parameters.height_unit.as_deref());
        let headline = format!(
            "alpha = {}, r = {}: ripples of {}{unit} with crests at {}° to the scan",
            with_interval(&self.alpha),
            with_interval(&self.r),
            in_digits(&self.wavelength),
            in_digits(&self.crest_angle)
        );
        let word = |name: Value| name.as_str().map(str::to_owned);
        let lateral = self.lateral.as_ref();
        let lateral_unit = after_number(self.parameters.lateral_unit.as_deref());
        let of_lever = lateral.and_then(|found| {
            let unit = found.stiffness_unit.as_deref().unwrap_or_default();
            Some(
                format!("{} {unit}", with_interval(found.stiffness.as_ref()?))
                    .trim_end()
                    .to_owned(),
            )
        });
        Summary::new(headline)
            .row("alpha", with_interval(&self.alpha))
            .row("r", with_interval(&self.r))
            .maybe("stiffness across", self.stiffness_across.as_ref().map(with_interval))
            .maybe("critical α at this r", self.critical_alpha.map(|alpha| digits(alpha, 6)))
            .row("wavelength", format!("{}{unit}", with_interval(&self.wavelength)))
            .row("crests to the scan axis", format!("{}°", with_interval(&self.crest_angle)))
            .row("amplitude", format!("{}{height_unit}", with_interval(&self.amplitude)))
            .row("height gain k/a", digits(self.height_gain, 5))
            .maybe("scan", word(json!(self.scan)))
            .maybe("lines", word(json!(self.slow_scan)))
            .maybe(
                "retrace shifted by",
                self.retrace.map(|r| format!("{}{unit}", digits(r.shift, 3))),
            )
            .maybe(
                "amplitude of the lateral image",
                lateral.map(|l| format!("{}{lateral_unit}", with_interval(&l.amplitude))),
            )
            .maybe("lag of the model", lateral.map(|l| format!("{}{unit}", with_interval(&l.lag))))
            .maybe("stiffness k of the lever", of_lever)
            .maybe(
                "lateral image shifted by",
                lateral.map(|l| {
                    format!("{} ± {}{unit}", digits(l.shift, 3), digits(l.shift_error, 2))
                }),
            )
            .maybe("retrace over trace", self.retrace.map(|r| digits(r.ratio, 4)))
            .row("probability of the misfit", digits(self.misfit, 2))
            .row("residual", format!("{}{height_unit}", digits(self.residual, 3)))
            .remarks(&self.remarks)
    }
}

impl Product for FrictionDocument {
    fn summary(&self) -> Summary {
        let [force, work, length] = [&self.force_unit, &self.work_unit, &self.length_unit]
            .map(|unit| after_number(unit.as_deref()));
        let headline = format!(
            "kinetic friction {}{force}, static peak {}{force}, work {}{work}",
            with_interval(&self.kinetic),
            with_interval(&self.static_peak),
            with_interval(&self.work)
        );
        let mut summary = Summary::new(headline);
        for (name, estimate, unit) in self.estimates() {
            let value = format!("{} {unit}", with_interval(estimate));
            summary = summary.row(name, value.trim_end());
        }
        summary
            .row("static over kinetic", digits(self.peak_ratio, 4))
            .row("reversal", format!("{}{length}", digits(self.reversal, 4)))
            .row("noise from row to row", format!("{}{force}", digits(self.noise, 3)))
            .remarks(&self.remarks)
    }
}

/// A value with its interval, such as "1.879 (1.85 to 1.91)".
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

/// A value with one digit more than its interval determines.
fn in_digits(estimate: &EstimateDocument) -> String {
    let width = estimate.high.zip(estimate.low).map(|(high, low)| 0.5 * (high - low));
    let relative = width.map_or(0.0, |width| width / estimate.value.abs());
    let count = if relative > 0.0 { 1.0 - relative.log10().floor() } else { 6.0 };
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a count")]
    let count = count.clamp(2.0, 10.0) as usize;
    digits(estimate.value, count)
}
