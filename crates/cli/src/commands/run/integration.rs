//! The integration, step by step to the end or to a signal.

use super::checkpoint::Checkpoints;
use super::motion::Motion;
use super::record::Record;
use crate::commands::progress::Progress;
use crate::failure::Failure;
use crate::interrupt::Interrupt;
use crate::session::Session;
use std::sync::Arc;
use std::time::Instant;
use stickslip_tip::{Scenario, stop};

/// A run in progress or finished, with its outputs.
pub(super) struct Integration<R: Motion> {
    pub(super) running: R,
    pub(super) record: Record<R::Step>,
    pub(super) checkpoints: Option<Checkpoints>,
    pub(super) interrupt: Interrupt,
    /// Time spent so far, in seconds.
    pub(super) seconds: f64,
}

/// Largest number of steps between two checks of the signals: some tens of microseconds.
const STEPS_PER_LOOK: usize = 64;

impl<R: Motion> Integration<R> {
    /// Writes a checkpoint, if requested.
    pub(super) fn checkpoint(&mut self) -> Result<(), Failure> {
        match &mut self.checkpoints {
            None => Ok(()),
            Some(checkpoints) => checkpoints.write(&self.running, &mut self.record, self.seconds),
        }
    }

    /// Makes the next step, or those to the next sample if no other is needed.
    fn step(&mut self) -> Result<Option<R::Step>, Failure> {
        let needed = self.checkpoints.is_some() || self.record.steps.is_some();
        let past = if needed { f64::NEG_INFINITY } else { self.record.next_sample() };
        self.running.step_past(past, STEPS_PER_LOOK).map_err(|error| {
            match self.record.keep_part() {
                None => Failure::run(error),
                Some(part) => Failure::Run(format!(
                    "{error}; the part written so far is in {}",
                    part.display()
                )),
            }
        })
    }

    /// Integrates to the end of the scenario.
    pub(super) fn finish(
        mut self,
        session: &Session,
        scenario: &Scenario,
    ) -> Result<Self, Failure> {
        let progress = Progress::new(session, scenario.start_time(), scenario.until);
        let (started, before) = (Instant::now(), self.seconds);
        let seconds = || before + started.elapsed().as_secs_f64();
        // Once for all steps: a step may be as short as this takes.
        let flag = Arc::clone(self.interrupt.flag());
        let is_whole = stop::with_flag(&flag, || self.advance(progress, seconds))?;
        self.seconds = seconds();
        self.record.end(self.running.last().filter(|_| is_whole).as_ref())?;
        Ok(self)
    }

    /// Makes and records steps to the end or to a signal; returns whether all samples of the last one were taken.
    fn advance(
        &mut self,
        mut progress: Progress,
        seconds: impl Fn() -> f64,
    ) -> Result<bool, Failure> {
        while let Some(step) = self.step()? {
            let interrupt = &self.interrupt;
            let is_whole = self.record.take(&step, || interrupt.signal().is_some())?;
            let end = step.as_ref().end();
            progress.counted(end, || format!("t = {end:.6}"));
            let is_stopped = self.interrupt.signal().is_some();
            // Of a step whose samples were not all taken there is no checkpoint: the last one is before it.
            if !is_whole {
                return Ok(false);
            }
            if self.checkpoints.as_ref().is_some_and(|c| is_stopped || c.is_due(end)) {
                self.seconds = seconds();
                self.checkpoint()?;
            }
            if is_stopped {
                break;
            }
        }
        Ok(true)
    }
}
