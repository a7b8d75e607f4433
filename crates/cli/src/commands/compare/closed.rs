//! The closed equation's side of a comparison.

use super::Asked;
use super::pace::{Pace, stopped, timed};
use crate::commands::progress::Progress;
use crate::failure::Failure;
use std::ops::ControlFlow;
use stickslip::{ClosedDocument, ClosedWork};
use stickslip_surface::Surface;
use stickslip_tip::{Run, Scenario, Trajectory, Work, run_observed};

/// Steps between two readings of the clock: a step takes microseconds.
pub(super) const STEPS_PER_LOOK: u32 = 256;

/// A finished run and its time.
pub(super) struct Closed {
    run: Run,
    pub(super) trajectory: Trajectory,
    seconds: f64,
}

pub(super) fn run(asked: &Asked, scenario: &Scenario) -> Result<Closed, Failure> {
    let Asked { question, time_limit, .. } = asked;
    let span = (scenario.start_time(), scenario.until);
    let once = || {
        let pace = Pace::new("--until", span, *time_limit);
        let mut progress = Progress::new(asked.session, span.0, span.1);
        let (mut steps, mut failure) = (0_u32, None);
        let run = run_observed(scenario, |step| {
            progress.reached(step.end());
            steps = steps.wrapping_add(1);
            if steps.is_multiple_of(STEPS_PER_LOOK) {
                failure = pace.too_slow(step.end());
            }
            if failure.is_some() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        });
        let seconds = pace.seconds();
        // The run looks at every step whether anybody waits for it, and this at some.
        match failure.or_else(stopped) {
            Some(failure) => Err(failure),
            None => Ok((run.map_err(|error| question.refused(&error))?, seconds)),
        }
    };
    let (run, seconds) = timed(once)?;
    Ok(Closed { trajectory: run.trajectory.clone(), run, seconds })
}

impl Closed {
    /// The document: x0 at the times t, u at the positions x at the time `end`.
    pub(super) fn document(
        &self,
        scenario: &Scenario,
        t: &[f64],
        end: f64,
        x: &[f64],
    ) -> Result<ClosedDocument, Failure> {
        let Self { run, trajectory, seconds } = self;
        let surface = Surface::new(&scenario.model, &run.initial_surface, trajectory);
        let u = surface.heights(end.min(trajectory.end()), x);
        Ok(ClosedDocument {
            x0: t.iter().map(|t| trajectory.x0(*t)).collect(),
            y0: None,
            u: u.map_err(|error| Failure::Run(error.to_string()))?.to_vec(),
            work: closed_work(&run.work, run.memory.into(), *seconds),
        })
    }
}

/// The counts of a run with this memory that took this many seconds.
pub(super) fn closed_work(work: &Work, memory: String, seconds: f64) -> ClosedWork {
    ClosedWork {
        memory,
        steps: work.steps,
        rejected: work.rejected,
        newton_iterations: work.newton_iterations,
        series: work.series,
        switches: work.switches,
        seconds,
    }
}
