//! Repetition of a run, observed step by step.

use super::VerificationError;
use std::ops::ControlFlow;
use stickslip_tip::{InitialSurface, MOST_STEPS, MemoryChoice, RunError, Running, Scenario, Step};

/// Largest number of steps repeated with direct sums, which take long.
const MOST_STEPS_OF_DIRECT: u64 = 3000;

/// Makes the steps of a run until the end of `span`, whose start is that of the run. Each step is passed to `see` with
/// the time before which it is valid. `share` is the begin and the end of this part of the whole work, from 0 to 1.
pub(super) fn follow<S: AsRef<Step>, E: Into<VerificationError>>(
    mut next: impl FnMut() -> Result<Option<S>, E>,
    (start, until): (f64, f64),
    (from, to): (f64, f64),
    mut see: impl FnMut(&S, f64) -> Result<(), RunError>,
    observe: &mut impl FnMut(f64) -> ControlFlow<()>,
) -> Result<(), VerificationError> {
    while let Some(step) = next().map_err(Into::into)? {
        let end = step.as_ref().end();
        let is_last = end >= until;
        see(&step, if is_last { until.next_up() } else { end })?;
        let part = from + (to - from) * (end - start) / (until - start);
        if observe(part.min(to)).is_break() {
            return Err(VerificationError::Interrupted);
        }
        if is_last {
            break;
        }
    }
    Ok(())
}

/// Adds a step to a history.
pub(super) fn keep<S: AsRef<Step> + Copy>(steps: &mut Vec<S>, step: &S) -> Result<(), RunError> {
    if steps.len() == MOST_STEPS {
        return Err(RunError::HistoryTooLong { t: step.as_ref().t });
    }
    steps.push(*step);
    Ok(())
}

/// Memories for the repetition of a run with this number of steps, the most independent first.
pub(super) fn another(used: &str, steps: u64) -> Vec<MemoryChoice> {
    let mut others = vec![
        ("modes", MemoryChoice::Modes),
        ("fft", MemoryChoice::Fft),
        ("direct", MemoryChoice::Direct),
    ];
    if steps <= MOST_STEPS_OF_DIRECT {
        others.rotate_right(1);
    }
    others.into_iter().filter(|(name, _)| *name != used).map(|(_, choice)| choice).collect()
}

/// Repeats a run with the first applicable memory, and returns the name of this memory. `begin` makes an empty record
/// for each memory that is tried; `see` adds a step to it, as for [`follow`].
pub(super) fn repeat<T>(
    (scenario, surface): (&Scenario, &InitialSurface),
    memories: Vec<MemoryChoice>,
    share: (f64, f64),
    begin: impl Fn() -> T,
    mut see: impl FnMut(&mut T, &Step, f64) -> Result<(), RunError>,
    observe: &mut impl FnMut(f64) -> ControlFlow<()>,
) -> Result<(&'static str, T), VerificationError> {
    let span = (scenario.start_time(), scenario.until);
    let mut failure = VerificationError::Interrupted;
    for memory in memories {
        let scenario = Scenario { memory, ..scenario.clone() };
        let mut seen = begin();
        let repeated =
            Running::new(&scenario, surface).map_err(Into::into).and_then(|mut running| {
                let see = |step: &Step, before| see(&mut seen, step, before);
                follow(|| running.step(), span, share, see, observe)?;
                Ok(running.memory())
            });
        match repeated {
            Ok(memory) => return Ok((memory, seen)),
            Err(VerificationError::Run(
                error @ (RunError::Modes(_) | RunError::Integration(_)),
            )) => {
                failure = error.into();
            }
            Err(error) => return Err(error),
        }
    }
    Err(failure)
}
