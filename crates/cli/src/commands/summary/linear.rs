//! Summaries of linear theory: stability, walks, boundary, response.

use super::{Summary, again, digits, extremes};
use crate::commands::job::Product;
use stickslip::{
    BoundaryDocument, CertificateDocument, ComplexDocument, Criticality, LimitColumns,
    ResponseDocument, SnakingDocument, StabilityDocument, WalkDocument, WalkingDocument,
    to_its_digits,
};

/// Number of significant digits of a critical point.
const CRITICAL: usize = 10;

impl Product for StabilityDocument {
    fn summary(&self) -> Summary {
        let model = self.parameters.model_parameters();
        let [alpha, r] = [model.alpha, model.r].map(|value| digits(value, CRITICAL));
        let stable = if self.stable { "stable" } else { "unstable" };
        let state = if self.parameters.at_critical_point { "critical" } else { stable };
        let critical = self.critical.as_ref();
        let snaking = self.snaking.as_ref().map(Option::as_ref);
        let along = if snaking.is_some() { "along the scan " } else { "" };
        let headline = match critical {
            Some(at) if self.parameters.at_critical_point => format!(
                "stick-slip sets in at α = {alpha}, r = {r}, with ω = {}",
                digits(at.omega, CRITICAL)
            ),
            Some(at) => format!(
                "steady motion at α = {alpha}, r = {r} is {state}; {along}it loses its stability at α = {}, r = {}",
                digits(at.alpha, CRITICAL),
                digits(at.r, CRITICAL)
            ),
            None => format!("steady motion at α = {alpha}, r = {r} is {state}"),
        };
        let snakes = snaking.flatten();
        let snakes =
            snakes.map(|at| format!("; the line snakes above α = {}", digits(at.alpha, CRITICAL)));
        let summary = Summary::new(headline + &snakes.unwrap_or_default())
            .maybe("critical α", critical.map(|at| digits(at.alpha, CRITICAL)))
            .maybe("critical r", critical.map(|at| digits(at.r, CRITICAL)))
            .maybe("ω there", critical.map(|at| format!("{} k/Γ", digits(at.omega, CRITICAL))))
            .maybe(
                "period there",
                critical.map(|at| format!("{} Γ/k", digits(at.period, CRITICAL))),
            )
            .maybe(
                "wavelength there",
                critical.map(|at| format!("{} σ", digits(at.wavelength, CRITICAL))),
            )
            .maybe("onset", self.onset.as_ref().map(|onset| criticality(onset.criticality).into()))
            .maybe("trapped from", self.trapping.alpha.map(|a| format!("α = {}", digits(a, 7))));
        let summary = match snaking {
            Some(snaking) => across(summary, snaking),
            None => summary,
        };
        let limits = self.limits.as_ref();
        let least = limits.and_then(|limits| limits.least_depth_limit);
        let length = limits.and_then(|limits| limits.memory_length);
        let least = least.map(|b| format!("b = {}", digits(b, 7)));
        let summary = always_stable(summary, least, length);
        exponents(summary, self.roots.first(), self.roots.len(), &self.certificate)
            .remarks(&self.remarks)
            .next(again("-o stability.json --plot roots.svg"))
    }
}

/// Adds the limits below which steady motion is stable at every α.
fn always_stable(summary: Summary, depth: Option<String>, length: Option<f64>) -> Summary {
    let length = length.map(|l| format!("{} σ, without a depth limit", digits(l, 7)));
    summary.maybe("always stable below", depth).maybe("always stable below rT", length)
}

/// Adds the leading growth exponent and the number of all.
fn exponents(
    summary: Summary,
    leading: Option<&ComplexDocument>,
    count: usize,
    certificate: &CertificateDocument,
) -> Summary {
    let leading = leading.map(|root| {
        let [re, im] =
            [root.re, root.im].map(|part| to_its_digits(part, certificate.largest_error));
        format!("({re}) + ({im}) i k/Γ")
    });
    let certain = if certificate.complete { "none is missing" } else { "some may be missing" };
    summary
        .maybe("leading growth exponent", leading)
        .row("growth exponents", format!("{count}, {certain}"))
}

/// Adds the onset of snaking of a line, if there is one.
fn across(summary: Summary, snaking: Option<&SnakingDocument>) -> Summary {
    let Some(at) = snaking else { return summary.row("snakes above", "no α") };
    summary
        .row("snakes above", format!("α = {}", digits(at.alpha, CRITICAL)))
        .row("ω of snaking", format!("{} k/Γ", digits(at.omega, CRITICAL)))
        .row("wavelength of snaking", format!("{} σ", digits(at.wavelength, CRITICAL)))
}

fn criticality(name: Criticality) -> &'static str {
    match name {
        Criticality::Supercritical => "supercritical: a small stable oscillation above",
        Criticality::Subcritical => "subcritical: an unstable oscillation below",
    }
}

impl Product for BoundaryDocument {
    fn summary(&self) -> Summary {
        let points = self.r.len();
        let [low, high] = extremes(self.alpha.iter().copied()).map(|alpha| digits(alpha, 7));
        let [first, last] = self.parameters.r_range.map(|r| digits(r, 7));
        let limits = self.limits.as_ref();
        if points == 0 {
            let stable = format!("steady motion is stable at every α and r from {first} to {last}");
            return least(Summary::new(stable), limits).remarks(&self.remarks);
        }
        let summary =
            Summary::new(format!("αc from {low} to {high} at {points} r from {first} to {last}"));
        let sub = self.onset.criticality.iter();
        let sub = sub.filter(|c| **c == Some(Criticality::Subcritical)).count();
        let summary = summary
            .row("r", format!("{points} from {first} to {last}"))
            .row("αc", format!("from {low} to {high}"));
        let summary = match limits {
            Some(_) => least(summary, limits),
            None => summary
                .row("subcritical at", format!("{sub} of them"))
                .row("stretches of the curve", self.branches.len().to_string()),
        };
        summary.remarks(&self.remarks).next(again("-o boundary.csv --plot boundary.svg"))
    }
}

/// Adds the conditions under which steady motion is stable at every α.
fn least(summary: Summary, limits: Option<&LimitColumns>) -> Summary {
    let depths = limits.map(|limits| limits.least_depth_limit.iter().copied().flatten());
    let depths: Vec<f64> = depths.into_iter().flatten().collect();
    let [low, high] = extremes(depths.iter().copied()).map(|b| digits(b, 7));
    let range = (!depths.is_empty()).then(|| format!("b = {low} to {high}, by r"));
    always_stable(summary, range, limits.and_then(|limits| limits.memory_length))
}

impl Product for ResponseDocument {
    fn summary(&self) -> Summary {
        let model = self.parameters.model_parameters();
        let [alpha, r] = [model.alpha, model.r].map(|value| digits(value, 7));
        let leading = self.modes.first().map(|mode| {
            let [re, im] = [mode.lambda.re, mode.lambda.im].map(|part| digits(part, 7));
            format!("{re} + {im} i k/Γ")
        });
        let from = digits(self.valid_from, 7);
        let summary = Summary::new(format!(
            "{} modes at α = {alpha}, r = {r}: from t = {from} on their sum is accurate to {:.0e} of the first",
            self.modes.len(),
            self.valid_to
        ));
        let deviations = self.samples.deviation.iter().flatten();
        let largest = deviations.fold(0.0_f64, |most, d| most.max(d.abs()));
        summary
            .maybe("leading mode", leading)
            .row("valid from", format!("t = {from}"))
            .row("largest deviation", format!("{} σ", digits(largest, 7)))
            .remarks(&self.remarks)
            .next(again("-o response.csv --plot response.svg"))
    }
}

/// Number of significant digits of a walk.
const WALK: usize = 10;

impl Product for WalkingDocument {
    fn summary(&self) -> Summary {
        let alpha = digits(self.parameters.indentation.alpha.unwrap_or(f64::NAN), WALK);
        let stable = self.walks.iter().filter(|walk| walk.stable == Some(true)).count();
        let headline = match self.walks.len() {
            0 => format!("no steady walk at α = {alpha}"),
            1 => format!("one steady walk at α = {alpha}: {}", self.walks[0].stability()),
            more => format!("{more} steady walks at α = {alpha}, {stable} of them stable"),
        };
        let begins = self.walking_alpha.map(|least| format!("α = {}", digits(least, WALK)));
        let summary = Summary::new(headline).maybe("a tip at rest walks below", begins);
        let walks = self.walks.iter();
        walks
            .fold(summary, tell)
            .remarks(&self.remarks)
            .next(again("-o walking.json --plot roots.svg"))
    }
}

fn tell(summary: Summary, walk: &WalkDocument) -> Summary {
    // The first of the others: 0 is that of a shift.
    let leading = walk.roots.iter().find(|root| root.re != 0.0 || root.im != 0.0);
    let speed = format!("{} kσ/Γ, {}", digits(walk.speed, WALK), walk.stability());
    exponents(summary.row("speed", speed), leading, walk.roots.len(), &walk.certificate)
}
