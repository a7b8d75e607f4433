//! What is told of a run.

use super::{Told, again, digits};
use crate::commands::verify::kept;
use stickslip_documents::{ModelParameters, RegimeName, RunDocument, RunEnd};
use stickslip_stability::unstable_count;

/// What is told of a run that became what `end` says.
pub(in crate::commands) fn of_run(document: &RunDocument, end: &RunEnd) -> Told {
    let model = &document.parameters.model;
    let verified = document.verification.as_ref().map_or(String::new(), kept);
    let told = Told::new(summary(end, model) + &verified);
    let parameters = format!("{}, {}", digits(model.alpha, 10), digits(model.r, 10));
    let told = oscillation(told.row("α, r", parameters), end);
    let told = told.row("l of steady motion", format!("{} σ", digits(document.steady_state.l, 7)));
    if end.regime == RegimeName::Transient {
        return told
            .next(again(&format!("--until {}", digits(4.0 * document.parameters.until, 4))));
    }
    told.next(again("-o run.json --plot run.svg"))
}

/// What is told of a run written as lines.
pub(in crate::commands) fn of_lines(end: &RunEnd, model: &ModelParameters) -> Told {
    Told::new(summary(end, model))
}

fn oscillation(told: Told, end: &RunEnd) -> Told {
    let Some(o) = &end.oscillation else { return told };
    told.row("period", format!("{:.9} Γ/k", o.period))
        .row("wavelength", format!("{:.9} σ", o.wavelength))
        .row("amplitude of x0", format!("{:.9} σ", o.amplitude_x0))
        .maybe("amplitude of u", o.amplitude_u.map(|u| format!("{} kσ²/a", digits(u, 7))))
        .row("slips in a period", o.slips.to_string())
}

/// One line for a person who sent the run to a file.
fn summary(end: &RunEnd, model: &ModelParameters) -> String {
    let work = &end.work;
    // A start in the steady state stays there for long where nothing disturbs it.
    let is_unstable = || model.model().is_ok_and(|m| unstable_count(&m).is_ok_and(|n| n > 0));
    let unstable = end.regime == RegimeName::Steady && is_unstable();
    let hint = if unstable { ", but unstable: --kick D shows what becomes of it" } else { "" };
    let motion = end.oscillation.as_ref().map_or(String::new(), |o| {
        let (period, amplitude) = (o.period, o.amplitude_x0);
        format!(", period {period:.9}, amplitude of x0 {amplitude:.9}")
    });
    format!(
        "{}{motion}{hint}: t = {} reached in {} steps with {}, {:.1} ms",
        end.regime,
        end.end,
        work.steps,
        work.memory,
        1e3 * work.seconds
    )
}
