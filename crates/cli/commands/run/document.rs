//! What became of a run, for its document.

use super::integration::Integrated;
use crate::failure::Failure;
use stickslip_documents::{OscillationDocument, RunEnd, WorkDocument};
use stickslip_surface::{Surface, ripple_behind};
use stickslip_tip::{InitialSurface, Scenario, stop};

/// What became of the run.
pub(super) fn end(
    scenario: &Scenario,
    initial: &InitialSurface,
    integrated: &Integrated,
) -> Result<RunEnd, Failure> {
    let Integrated { running, seconds, interrupt, .. } = integrated;
    let tail = running.tail().ok_or_else(|| Failure::Run("the run has no steps".into()))?;
    // Whoever stops the judgement too, or stopped the run, is told what can be said at once.
    let outcome = stop::where_asked_by(interrupt.flag(), || running.outcome());
    let work = running.work();
    Ok(RunEnd {
        end: running.t(),
        regime: outcome.regime.into(),
        oscillation: outcome.oscillation.map(|o| {
            let surface = Surface::new(&scenario.model, initial, &tail);
            OscillationDocument::of(&o, ripple_behind(&surface, &tail, o.wavelength))
        }),
        creep: outcome.creep.map(Into::into),
        transient: outcome.prospect.map(Into::into),
        remarks: outcome.remarks.iter().map(ToString::to_string).collect(),
        interrupted: interrupt.signal().is_some(),
        work: WorkDocument {
            memory: running.memory().into(),
            memory_reason: running.memory_reason(),
            steps: work.steps,
            rejected: work.rejected,
            newton_iterations: work.newton_iterations,
            series: work.series,
            switches: work.switches,
            seconds: *seconds,
        },
    })
}
