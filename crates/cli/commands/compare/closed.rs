//! The closed equation's side of a comparison.

use crate::arguments::CompareArguments;
use crate::commands::model::model;
use crate::commands::progress::Progress;
use crate::commands::run::limits::within_range;
use crate::commands::run::option_at_fault;
use crate::commands::run::parameters::{memory, start};
use crate::documents::{ClosedDocument, ClosedWork};
use crate::failure::Failure;
use crate::interrupt::Interrupt;
use std::ops::ControlFlow;
use std::time::Instant;
use stickslip_surface::Surface;
use stickslip_tip::{Force, Run, RunError, Scenario, Trajectory, run_observed};

/// The shortest of so many runs is its time: a run may be as short as a millisecond.
const REPETITIONS: usize = 5;
/// Unless they would take longer than this, in seconds.
const PATIENCE: f64 = 1.0;

/// A finished run and its time.
pub(super) struct Closed {
    run: Run,
    pub(super) trajectory: Trajectory,
    seconds: f64,
}

/// The run that both sides make.
pub(super) fn scenario(arguments: &CompareArguments, force: Force) -> Result<Scenario, Failure> {
    let scenario = Scenario {
        start: start(arguments.start),
        start_position: arguments.start_position,
        kick: arguments.kick,
        force,
        tolerance: arguments.tolerance,
        memory: memory(arguments.memory),
        ..Scenario::new(model(&arguments.model)?, arguments.until)
    };
    within_range(&arguments.model, &scenario)?;
    scenario.validate().map_err(|error| explain(&error))?;
    Ok(scenario)
}

fn explain(error: &RunError) -> Failure {
    match option_at_fault(error) {
        Some(option) => Failure::input(option, error),
        None => Failure::Run(error.to_string()),
    }
}

pub(super) fn run(scenario: &Scenario, interrupt: &Interrupt) -> Result<Closed, Failure> {
    let once = || {
        let clock = Instant::now();
        let mut progress = Progress::new(scenario.start_time(), scenario.until);
        let run = run_observed(scenario, |step| {
            progress.reached(step.end());
            match interrupt.signal() {
                Some(_) => ControlFlow::Break(()),
                None => ControlFlow::Continue(()),
            }
        });
        let seconds = clock.elapsed().as_secs_f64();
        let run = run.map_err(|error| explain(&error))?;
        match interrupt.signal() {
            Some(signal) => Err(Failure::Stopped(signal)),
            None => Ok((run, seconds)),
        }
    };
    let (run, mut seconds) = once()?;
    let mut spent = seconds;
    for _ in 1..REPETITIONS {
        if spent < PATIENCE {
            let (_, again) = once()?;
            spent += again;
            seconds = seconds.min(again);
        }
    }
    Ok(Closed { trajectory: run.trajectory.clone(), run, seconds })
}

impl Closed {
    /// x0 at the times t, u at the positions x at the time `end`.
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
            u: u.map_err(|error| Failure::Run(error.to_string()))?.to_vec(),
            work: ClosedWork {
                memory: run.memory.into(),
                steps: run.work.steps,
                rejected: run.work.rejected,
                newton_iterations: run.work.newton_iterations,
                seconds: *seconds,
            },
        })
    }
}
