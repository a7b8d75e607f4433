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
    let oscillation = outcome.oscillation.as_ref().map(|o| {
        let surface = Surface::new(&scenario.model, initial, &tail);
        OscillationDocument::of(o, ripple_behind(&surface, &tail, o.wavelength))
    });
    let memory = (running.memory(), running.memory_reason());
    let work = WorkDocument::of(&running.work(), memory, *seconds);
    let interrupted = interrupt.signal().is_some();
    Ok(RunEnd { interrupted, ..RunEnd::of(running.t(), outcome, oscillation, work) })
}
