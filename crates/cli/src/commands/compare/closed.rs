//! The closed equation's side of a comparison.

use super::Comparison;
use super::pace::{Unit, Watch, timed};
use crate::failure::Failure;
use stickslip::{ClosedDocument, ClosedWork};
use stickslip_surface::Surface;
use stickslip_tip::{Run, Scenario, Work, run_observed};

/// A finished run and its time.
pub(super) struct Closed {
    pub(super) run: Run,
    seconds: f64,
}

pub(super) fn run(comparison: &Comparison, scenario: &Scenario) -> Result<Closed, Failure> {
    let Comparison { question, time_limit, .. } = comparison;
    let span = (scenario.start_time(), scenario.until);
    let once = || {
        let mut watch = Watch::new(comparison.session, Unit::Time("--until"), span, *time_limit);
        watch = watch.of_short_steps();
        let run = run_observed(scenario, |so_far| watch.reached(so_far.end()));
        watch.ended(run.map_err(|error| question.refused(&error).into()))
    };
    let (run, seconds) = timed(once)?;
    Ok(Closed { run, seconds })
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
        let Self { run, seconds } = self;
        let trajectory = &run.trajectory;
        let surface = Surface::new(&scenario.model, &run.initial_surface, trajectory);
        let u = surface.heights(end.min(trajectory.end()), x);
        Ok(ClosedDocument {
            x0: t.iter().map(|t| trajectory.x0(*t)).collect(),
            y0: None,
            u: u.map_err(Failure::run)?.to_vec(),
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
