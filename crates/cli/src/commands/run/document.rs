//! What became of a run, for its document.

use super::integration::Integrated;
use crate::failure::Failure;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use stickslip::{OscillationDocument, RunEnd, WorkDocument};
use stickslip_outcome::Watched;
use stickslip_surface::{Surface, ripple_behind};
use stickslip_tip::{InitialSurface, Scenario, stop};

/// What became of the run.
pub(super) fn end(
    scenario: &Scenario,
    initial: &InitialSurface,
    integrated: &Integrated,
) -> Result<RunEnd, Failure> {
    let Integrated { running, seconds, interrupt, .. } = integrated;
    let end = became(scenario, initial, running, interrupt.flag())?;
    let work = WorkDocument { seconds: *seconds, ..end.work };
    Ok(RunEnd { work, interrupted: interrupt.signal().is_some(), ..end })
}

/// The outcome of a run up to this point. Once the flag is raised, only what is known without further work is returned.
pub(crate) fn became(
    scenario: &Scenario,
    initial: &InitialSurface,
    running: &Watched,
    flag: &Arc<AtomicBool>,
) -> Result<RunEnd, Failure> {
    let tail = running.tail().ok_or_else(|| Failure::Run("the run has no steps".into()))?;
    let outcome = stop::where_asked_by(flag, || running.outcome());
    let oscillation = outcome.oscillation.as_ref().map(|o| {
        let surface = Surface::new(&scenario.model, initial, &tail);
        OscillationDocument::of(o, ripple_behind(&surface, &tail, o.wavelength))
    });
    let memory = (running.memory(), running.memory_reason());
    let work = WorkDocument::of(&running.work(), memory, 0.0);
    Ok(RunEnd::of(running.t(), outcome, oscillation, work))
}
